// What is no whole restart file of this scene is refused, with a sentence that says which, and what to do.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>

#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::refusedFileTest {
namespace {

using scenes::SettlingBox;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, Mindlin>;
using Hertzian = Species<HertzianViscoelastic>;

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}
void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// A scene that may differ from another in one thing.
template <class S>
struct Box : SettlingBox<S> {
    Box() : SettlingBox<S>(2) {}
};

class RestartFile : public testing::Test {
protected:
    RestartFile() : file(folder.path() / "run-restart.h5") {
        Box<Smooth> scene;
        scene.initialise();
        for (int k = 0; k < 200; ++k) scene.step();
        scene.writeRestart(file);
    }
    /// The sentence with which a scene refuses the file.
    template <class S>
    std::string refusalBy(Box<S>& scene) const {
        scene.restartFrom(file);
        const std::string text = refusal([&] { scene.initialise(); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, file.string()));
        return text;
    }
    template <class S = Smooth>
    std::string refusalBy() const {
        Box<S> scene;
        return refusalBy(scene);
    }

    TestFolder folder;
    std::filesystem::path file;
};

TEST_F(RestartFile, isTakenByTheSceneThatWroteIt) {
    Box<Smooth> scene;
    scene.restartFrom(file);
    EXPECT_EQ(refusal([&] { scene.initialise(); }), "");
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 200u);
}

TEST_F(RestartFile, thatIsNotThereIsRefused) {
    std::filesystem::remove(file);
    EXPECT_TRUE(contains(refusalBy(), "does not exist"));
}

TEST_F(RestartFile, thatIsTruncatedIsRefused) {
    const std::string whole = bytesOf(file);
    for (const std::size_t left : {whole.size() - 1, whole.size() / 2, std::size_t{513}, std::size_t{512}}) {
        writeBytes(file, whole.substr(0, left));
        EXPECT_TRUE(contains(refusalBy(), fmt::format("truncated, {} of its {} bytes", left, whole.size())));
    }
    for (const std::size_t left : {std::size_t{0}, std::size_t{10}, std::size_t{100}}) {
        writeBytes(file, whole.substr(0, left));
        EXPECT_NE(refusalBy(), "") << left;
    }
    writeBytes(file, whole + '\0');
    EXPECT_TRUE(contains(refusalBy(), "damaged"));
}

/// Every bit of the first bytes, and one bit of every 499th byte behind them.
TEST_F(RestartFile, withAnyDamagedByteIsRefused) {
    const std::string whole = bytesOf(file);
    std::size_t tried = 0;
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](std::size_t at, char byte) {
        stream.seekp(static_cast<std::streamoff>(at)).put(byte).flush();
    };
    const auto damage = [&](std::size_t at, int bit) {
        put(at, static_cast<char>(whole[at] ^ (1 << bit)));
        const std::string text = refusal([&] { checkRestartFile(file); });
        EXPECT_TRUE(isOneSentence(text)) << at << ' ' << bit;
        put(at, whole[at]);
        ++tried;
    };
    for (std::size_t at = 0; at < 100; ++at)
        for (int bit = 0; bit < 8; ++bit) damage(at, bit);
    for (std::size_t at = 100; at < whole.size(); at += 499) damage(at, static_cast<int>(at % 8));
    EXPECT_GT(tried, 900u);
    EXPECT_EQ(refusal([&] { checkRestartFile(file); }), "");
    put(whole.size() / 2, static_cast<char>(whole[whole.size() / 2] ^ 1));
    EXPECT_TRUE(contains(refusalBy(), "damaged"));
}

TEST_F(RestartFile, ofAnotherFormatIsRefused) {
    const std::string bytes = bytesOf(file), current = fmt::format("format {}\n", restartFormat);
    const std::size_t at = bytes.find(current);
    ASSERT_NE(at, std::string::npos);
    for (const int other : {restartFormat - 1, restartFormat + 1}) {
        writeBytes(file, std::string(bytes).replace(at, current.size(), fmt::format("format {}\n", other)));
        const std::string text = refusalBy();
        EXPECT_TRUE(contains(text, fmt::format("has the format {}", other)));
        EXPECT_TRUE(contains(text, "take the version that wrote it"));
    }
}

TEST_F(RestartFile, ofAnotherKindIsRefused) {
    writeBytes(file, "time_s,x_m\n0,1\n");
    EXPECT_TRUE(contains(refusalBy(), "is not a restart file of Pendular"));
    std::filesystem::remove(file);
    std::filesystem::create_directory(file);
    EXPECT_TRUE(contains(refusalBy(), "not a regular file"));
}

TEST_F(RestartFile, ofAnotherSpeciesIsRefused) {
    for (const std::string& text : {refusalBy<Rough>(), refusalBy<Hertzian>()})
        EXPECT_TRUE(contains(text, "species/name is LinearViscoelasticSpecies in the file"));
}

TEST_F(RestartFile, ofOtherValuesIsRefused) {
    Box<Smooth> stiffer;
    stiffer.speciesHandler.getObject(1)->setStiffness(500);
    EXPECT_TRUE(
        contains(refusalBy(stiffer),
                 "species/1/LinearViscoelastic/stiffness is 400 N/m in the file and 500 N/m in the scene"));
    Box<Smooth> pair;
    pair.speciesHandler.getMixedObject(0, 1)->setStiffness(350);
    EXPECT_TRUE(contains(refusalBy(pair), "species/countOfPairsWithOwnValues is 0 in the file and 1"));
    Box<Smooth> slower;
    slower.setTimeStep(0x1p-18);
    EXPECT_TRUE(contains(refusalBy(slower), "timeStep is"));
    Box<Smooth> account;
    account.keepEnergyLedger();
    const std::string text = refusalBy(account);
    EXPECT_TRUE(contains(text, "ledgerKept is 0 in the file and 1 in the scene"));
    EXPECT_TRUE(contains(text, "give --energy-interval-s (or keepEnergyLedger()) as it was"));
}

/// Content that no run writes, under a checksum that fits.
TEST_F(RestartFile, withAnEnergyAtTheStartThatIsNoNumberIsRefused) {
    Box<Smooth> scene, again;
    scene.keepEnergyLedger(), again.keepEnergyLedger();
    scene.initialise();
    const double atStart = scene.energyLedger().total(), none = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < 20; ++k) scene.step();
    scene.writeRestart(file);
    std::string bytes = bytesOf(file);
    const auto raw = [](const double& x) {
        return std::string(reinterpret_cast<const char*>(&x), sizeof(double));
    };
    const std::size_t at = bytes.find(raw(atStart));
    ASSERT_NE(at, std::string::npos);
    writeBytes(file, bytes.replace(at, sizeof(double), raw(none)));
    sealRestartFile(file);
    EXPECT_TRUE(contains(refusalBy(again), "energyAtStart has a number that is not finite"));
}

TEST_F(RestartFile, withALargestOverlapThatNoRunMeetsIsRefused) {
    for (double largest : {-1e-3, std::numeric_limits<double>::quiet_NaN()}) {
        std::uint64_t above = 0;
        const auto refused = refusal([&] {
            writeRestartFile(file, [&](StateArchive& archive) {
                archive.value("largest", largest);
                archive.value("above", above);
            });
            readRestartFile(file, [](StateArchive& archive) { OverlapWatch(0.1).visitState(archive); });
        });
        EXPECT_TRUE(
            contains(refused, largest < 0 ? "largest is negative" : "largest has a number that is not"));
    }
}

TEST_F(RestartFile, ofOtherWallsIsRefused) {
    Box<Smooth> more;
    InfiniteWall wall;
    wall.setSpecies(more.speciesHandler.getObject(0));
    wall.set({0, 0, 1}, {0, 0, 1});
    more.wallHandler.copyAndAddObject(wall);
    EXPECT_TRUE(contains(refusalBy(more), "walls/count is 6 in the file and 7 in the scene"));
    Box<Smooth> moved;
    dynamic_cast<InfiniteWall&>(moved.wallHandler.getObject(2)).set({0, 0, 1}, {0, 0, 1});
    EXPECT_TRUE(
        contains(refusalBy(moved), "walls/2/normal is (0, 1, 0) in the file and (0, 0, 1) in the scene"));
}

/// A file is not replaced by a state from which no run goes on.
TEST_F(RestartFile, isNotReplacedByAStateThatIsNotFinite) {
    const std::string good = bytesOf(file);
    Box<Smooth> scene;
    scene.restartFrom(file);
    scene.initialise();
    scene.particleHandler.store().translation[3].velocity.y = std::numeric_limits<double>::quiet_NaN();
    const std::string text = refusal([&] { scene.writeRestart(file); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text,
                         "particles/translation has a number that is not finite; the restart file of "
                         "before is kept"));
    EXPECT_TRUE(bytesOf(file) == good);
}

TEST_F(RestartFile, ofAnotherDriverIsRefused) {
    struct Counting : Box<Smooth> {
        void visitState(StateArchive& archive) override { archive.value("count", count); }
        int count = 0;
    } other;
    EXPECT_TRUE(contains(refusalBy<Smooth>(other), "has no driver/count"));
}

}  // namespace
}  // namespace pendular::refusedFileTest
