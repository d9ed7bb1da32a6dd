// A folder of runs, or a file in it, that is swapped for a symbolic link while it is read: nothing from
// outside of the root is ever answered.
#include <fcntl.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <thread>

#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/View/Api.h"
#include "Tools/View/NameText.h"
#include "Tools/View/RunState.h"

namespace pendular::swappedFolderTest {
namespace {

namespace fs = std::filesystem;
using namespace pendular::view;

const std::string token(32, 'a');

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

void writeFrames(const fs::path& folder, const std::string& mark) {
    PolyData grains;
    grains.points = {{0, 0, 0}};
    grains.corners = {0}, grains.ends = {1};
    grains.pointFields = {{"radius_m", 1, std::vector<float>{1}}, {mark, 1, std::vector<float>{1}}};
    writePolyData(folder / "run-particles-000000000.vtp", grains);
    write(folder / "run.pvd",
          "<VTKFile>\n<DataSet timestep=\"0\" part=\"0\" name=\"particles\" "
          "file=\"run-particles-000000000.vtp\"/>\n</VTKFile>\n");
    if (!Hdf5File::isAvailable()) return;
    FieldFile list(folder / "other-fields.h5");
    list.column("/", {"step", 1, std::vector<double>{1}});
    list.column("/", {"time_s", 1, std::vector<double>{0}});
    list.close();
    FieldFile frame(folder / "other-fields-000000001.h5");
    frame.column("particles", {"position_m", 3, std::vector<double>{0, 0, 0}});
    for (const PolyDataField& field : grains.pointFields) frame.column("particles", field);
    frame.close();
}

/// A run whose every file has a word in it.
void writeRun(const fs::path& folder, const std::string& mark) {
    fs::create_directories(folder);
    write(folder / "run-summary.csv",
          "quantity,value,unit\nstate,stopped by an error,\nreason," + mark + ",\n");
    write(folder / "table.csv", "time_s," + mark + "\n0,1\n");
    write(folder / "view-output.txt", "Error: " + mark + ".\n");
    write(folder / "view-start.json", R"({"driver": ")" + mark + R"(", "options": {}})");
    write(folder / (mark + ".csv"), "time_s\n");
    writeFrames(folder, mark);
}

/// The root has a folder "run", and the hidden name of a link to a folder outside.
class SwappedFolder : public testing::Test {
protected:
    SwappedFolder() {
        writeRun(root / "run", "inside");
        writeRun(outside, "secret");
        fs::create_symlink(outside, root / ".link");
    }
    /// The two names lead to what the other one led to, at one moment.
    [[nodiscard]] bool swap(const char* one = "run", const char* other = ".link") const {
        return renameat2(AT_FDCWD, (root / one).c_str(), AT_FDCWD, (root / other).c_str(), RENAME_EXCHANGE) ==
               0;
    }
    [[nodiscard]] static Request request(const std::string& path, std::map<std::string, std::string> query) {
        Request asked;
        asked.method = "GET", asked.path = path, asked.query = std::move(query);
        asked.host = "localhost", asked.cookie = token;
        return asked;
    }

    const support::TestFolder folder = support::TestFolder::inMemory();
    const fs::path root = folder.path() / "root", outside = folder.path() / "outside";
};

TEST_F(SwappedFolder, showsNothingFromOutside) {
    const RunFolder runs(root);
    Api api({token, {"localhost"}, "pendular"}, runs, {root, root, {}, "'none'"}, 1);
    if (!swap() || !swap()) GTEST_SKIP() << "this file system cannot exchange two names";
    const std::array requests{request("/api/run", {{"id", "run/run"}}),
                              request("/api/table", {{"id", "run/run"}, {"name", "table.csv"}}),
                              request("/api/row", {{"id", "run/run"}, {"frame", "0"}, {"row", "0"}}),
                              request("/api/row", {{"id", "run/other"}, {"frame", "0"}, {"row", "0"}}),
                              request("/api/runs", {})};
    for (const Request& asked : requests) {  // what is asked for can be had
        if (asked.asked("id") == "run/other" && !Hdf5File::isAvailable()) continue;
        const Reply reply = api.answer(asked);
        EXPECT_EQ(reply.status, 200) << reply.body;
        EXPECT_NE(reply.body.find("inside"), std::string::npos) << reply.body;
    }
    std::atomic<int> swaps{0};
    std::atomic<bool> isOver{false};
    std::thread swapper([&] {
        while (!isOver || swaps < 10000) swaps += swap() ? 1 : 0;
    });
    int shown = 0, secret = 0;
    for (int k = 0; k < 8000 || swaps < 10000; ++k) {
        const Reply reply = api.answer(requests[static_cast<std::size_t>(k) % requests.size()]);
        if (reply.body.find("inside") != std::string::npos) ++shown;
        if (reply.body.find("secret") != std::string::npos) ++secret;
    }
    isOver = true;
    swapper.join();
    EXPECT_EQ(secret, 0);
    EXPECT_GT(shown, 0);
}

TEST_F(SwappedFolder, isReadToItsEndOnceItIsOpen) {
    const RunFolder runs(root);
    const auto run = runs.find("run/run");
    ASSERT_TRUE(run);
    fs::rename(root / "run", root / ".away");
    fs::create_symlink(outside, root / "run");
    EXPECT_FALSE(runs.find("run/run"));
    EXPECT_TRUE(runs.list().empty());
    const std::string all = details(*run).dump() + tableRows(*run, "table.csv", 0);
    EXPECT_NE(all.find("inside"), std::string::npos) << all;
    EXPECT_EQ(all.find("secret"), std::string::npos) << all;
}

/// Also a file of the run, and not its folder, may have become a link.
TEST_F(SwappedFolder, hasFilesThatBecomeLinks) {
    const RunFolder runs(root);
    const auto run = runs.find("run/run");
    ASSERT_TRUE(run);
    for (const char* name : {"run-summary.csv", "table.csv", "view-output.txt", "view-start.json", "run.pvd",
                             "run-particles-000000000.vtp", "other-fields.h5", "other-fields-000000001.h5"}) {
        fs::remove(root / "run" / name);
        fs::create_symlink(outside / name, root / "run" / name);
    }
    EXPECT_EQ(details(*run).dump().find("secret"), std::string::npos);
    EXPECT_THROW(tableRows(*run, "table.csv", 0), InputError);
    EXPECT_TRUE(startOf(*run).is_null());
    fs::remove(root / "run" / "view-start.json.part");
    fs::create_symlink(outside / "new", root / "run" / "view-start.json.part");
    run->folder->write(startFile, "new");  // in the place of the link, not where it leads
    EXPECT_EQ(run->folder->file(startFile).value().bytes(0, 100), "new");
    EXPECT_FALSE(fs::exists(outside / "new"));
    EXPECT_THROW(static_cast<void>(run->folder->append(logFile)), InputError);
}

/// A sentence names the file as the user knows it, not as the process has opened it.
TEST_F(SwappedFolder, isCalledByItsName) {
    const RunFolder runs(root);
    write(root / "run" / "run.pvd", "nothing");
    const std::string told = details(runs.find("run/run").value())["frameProblem"];
    EXPECT_NE(told.find((root / "run" / "run.pvd").string()), std::string::npos) << told;
    EXPECT_EQ(told.find("/proc/"), std::string::npos) << told;
    EXPECT_EQ(withName("/proc/self/fd/1 and /proc/self/fd/12.", "/proc/self/fd/1", "a"),
              "a and /proc/self/fd/12.");
}

/// Every name has a text of UTF-8 of its own, which leads back to it.
TEST(NameText, leadsBackToTheName) {
    const std::array<std::string, 9> parts{
        "a", "%", "\xC3\xA9", "\xE9", "\xF0\x9F\x98", "\xED\xA0\x80", "\xC0\x80", "41", "/"};
    for (const std::string& one : parts)
        for (const std::string& two : parts)
            for (const std::string& three : parts) {
                const std::string name = one + two + three, text = textOfName(name);
                EXPECT_EQ(nameOfText(text), name) << text;
                EXPECT_NO_THROW(
                    static_cast<void>(nlohmann::json(text).dump()));  // it throws where it is no UTF-8
            }
    EXPECT_EQ(textOfName("caf\xE9/100%"), "caf%E9/100%25");
    EXPECT_EQ(textOfName("caf\xC3\xA9"), "caf\xC3\xA9");
    for (const char* none : {"%", "%4", "%41", "%e9", "%2F", "%C3%A9", "%+9", "\xE9"})
        EXPECT_FALSE(nameOfText(none)) << none;
}

}  // namespace
}  // namespace pendular::swappedFolderTest
