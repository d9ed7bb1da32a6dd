// Failures of the file system are sentences with path and reason, and never those of the C++ library.
#include "Kernel/Foundation/Files/FileFault.h"

#include <gtest/gtest.h>

#include <fstream>
#include <new>
#include <vector>

#include "Kernel/Foundation/Files/WrittenBeside.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fileFaultTest {
namespace {

namespace fs = std::filesystem;
using namespace support;

void expectSentence(const std::string& text, const fs::path& path, const std::string& reason) {
    EXPECT_TRUE(isOneSentence(text)) << text;
    EXPECT_TRUE(contains(text, path.string())) << text;
    EXPECT_TRUE(contains(text, reason)) << text;
    EXPECT_FALSE(contains(text, "filesystem error")) << text;
}

/// What the library throws: with one path, with two, with none.
TEST(FileFault, isASentence) {
    const TestFolder folder;
    const fs::path none = folder.path() / "none", other = folder.path() / "other";
    const auto thrownBy = [](auto&& body) -> std::string {
        try {
            body();
        } catch (const std::exception& problem) {
            return sentenceOf(problem);
        }
        return {};
    };
    expectSentence(thrownBy([&] { static_cast<void>(fs::file_size(none)); }), none,
                   "No such file or directory");
    const std::string two = thrownBy([&] { fs::rename(none, other); });
    expectSentence(two, none, "No such file or directory");
    EXPECT_TRUE(contains(two, other.string())) << two;
    expectSentence(
        thrownBy(
            [] { throw fs::filesystem_error("cannot", std::make_error_code(std::errc::permission_denied)); }),
        "", "Permission denied");
    const std::string ofMemory = thrownBy([] { throw std::bad_alloc(); });
    EXPECT_TRUE(isOneSentence(ofMemory) && contains(ofMemory, "not enough memory")) << ofMemory;
    EXPECT_EQ(thrownBy([] { std::vector<double>().reserve(~std::size_t{0}); }), ofMemory);
    EXPECT_EQ(thrownBy([] { throw InputError("As it is."); }), "As it is.");
}

TEST(FileFault, namesPathAndReason) {
    const TestFolder folder;
    const fs::path none = folder.path() / "none", file = folder.path() / "file";
    std::ofstream(file) << "text";
    EXPECT_EQ(sizeOf(file), 4u);
    expectSentence(refusal([&] { static_cast<void>(sizeOf(none)); }), none, "No such file or directory");
    fs::create_directory(folder.path() / "empty");
    expectSentence(refusal([&] { renameFile(file, folder.path() / "empty"); }), file, "Is a directory");
    expectSentence(refusal([&] { makeFolder(file / "inner"); }), file / "inner", "Not a directory");
    makeFolder(folder.path() / "a" / "b");
    EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
}

/// A folder comes under the name of a restart file while it is written.
TEST(FileFault, ofARestartFileThatCannotHaveItsName) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "no HDF5";
    const TestFolder folder;
    const fs::path file = folder.path() / "run-restart.h5";
    const std::string text =
        refusal([&] { writeRestartFile(file, [&](StateArchive&) { fs::create_directory(file); }); });
    expectSentence(text, file, "Is a directory");
    EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

/// Also of a table that is completed, and that is gone when its length is asked for.
TEST(FileFault, ofAFileThatIsWrittenBesideItsName) {
    const TestFolder folder;
    const fs::path file = folder.path() / "table.csv";
    WrittenBeside table(file);
    table.write("x\n");
    fs::create_directory(file);
    expectSentence(refusal([&] { table.close(); }), file, "Is a directory");
    expectSentence(refusal([&] { requireBytes(folder.path() / "none", 1); }), folder.path() / "none",
                   "No such file or directory");
}

}  // namespace
}  // namespace pendular::fileFaultTest
