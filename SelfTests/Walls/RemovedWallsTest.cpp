#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <string>
#include <vector>

#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Walls that come and go: a step, the memory and a restart file have what is there.

namespace pendular::removedWallsTest {
namespace {

using scenes::FewGrains;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

constexpr double r = 1e-3, dt = 1e-6;  // m, s

LinearViscoelasticSpecies material() {
    LinearViscoelasticSpecies species;
    species.setDensity(2500);
    species.setStiffness(1e3);
    species.setDissipation(1e-3);
    return species;
}

/// A grain that bounces on a floor.
struct Bouncing : FewGrains<LinearViscoelasticSpecies> {
    Bouncing()
        : FewGrains(material(), {{.position = {0, 0, 1.01 * r}, .velocity = {0.1, 0, -0.2}}}, dt,
                    {{{0, 0, -1}, {0, 0, 0}}}) {
        setQuiet();
    }
    void addFarWall() {
        InfiniteWall wall;
        wall.setSpecies(speciesHandler.getObject(0));
        wall.set({0, 0, 1}, {0, 0, 1});
        wall.setVelocity({0, 0, 0.1});
        wallHandler.copyAndAddObject(wall);
    }
    /// So many walls come, each for a step.
    void letWallsComeAndGo(int count) {
        for (int k = 0; k < count; ++k) {
            addFarWall();
            step();
            wallHandler.removeObject(wallHandler.getSize() - 1);
            step();
        }
    }
    [[nodiscard]] std::vector<std::size_t> presentNumbers() const {
        std::vector<std::size_t> found;
        for (const PresentWall& wall : wallHandler.present()) found.push_back(wall.number);
        return found;
    }
};

TEST(RemovedWalls, areSkipped) {
    Bouncing scene;
    for (int k = 1; k < 5; ++k) scene.addFarWall();
    scene.initialise();
    for (const std::size_t number : {3, 1}) scene.wallHandler.removeObject(number);
    scene.addFarWall();
    scene.step();
    EXPECT_EQ(scene.presentNumbers(), (std::vector<std::size_t>{0, 2, 4, 5}));
    EXPECT_EQ(scene.wallHandler.getSize(), 6u);
    for (const PresentWall& wall : scene.wallHandler.present())
        EXPECT_EQ(wall.object.get(), &scene.wallHandler.getObject(wall.number));
    EXPECT_TRUE(scene.wallHandler.isRemoved(1));
    EXPECT_FALSE(scene.wallHandler.isRemoved(2));
    // One object stands for all of them.
    EXPECT_EQ(&scene.wallHandler.getObject(1), &scene.wallHandler.getObject(3));
    EXPECT_TRUE(isOneSentence(refusal([&] { scene.wallHandler.removeObject(3); })));
    scene.wallHandler.clear();
    EXPECT_TRUE(scene.wallHandler.present().empty());
    scene.addFarWall();
    EXPECT_EQ(scene.presentNumbers(), (std::vector<std::size_t>{0}));
}

// A pointer of eight bytes and a bit or two are left of a wall, and vectors that grow by doubling take twice
// that. (It was an object of some 140 bytes. Without glibc's heap, as under the sanitizers, nothing is seen.)
TEST(RemovedWalls, takeNoMemory) {
    constexpr int count = 4000;
    Bouncing scene;
    scene.initialise();
    scene.letWallsComeAndGo(10);
    const std::size_t before = mallinfo2().uordblks;
    scene.letWallsComeAndGo(count);
    const std::size_t after = mallinfo2().uordblks;
    EXPECT_LT(after, before + 24 * count);
}

TEST(RemovedWalls, changeNoBit) {
    Bouncing scene, without;
    scene.initialise(), without.initialise();
    scene.letWallsComeAndGo(500);
    for (int k = 0; k < 1000; ++k) without.step();
    EXPECT_EQ(scene.motion(0).position, without.motion(0).position);
    EXPECT_EQ(scene.motion(0).velocity, without.motion(0).velocity);
    EXPECT_GT(scene.motion(0).velocity.z(), 0);  // it has bounced
}

// A number of four bytes each, and what is left free in blocks of HDF5 (2 kB); the group that the file had of
// each took 2 kB.
TEST(RemovedWalls, takeAFewBytesOfARestartFile) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    constexpr int count = 500;
    const TestFolder folder;
    const auto sizeAfter = [&](int removals) {
        Bouncing scene;
        scene.initialise();
        scene.letWallsComeAndGo(1 + removals);
        const std::string file = folder.name() + "-" + std::to_string(removals) + ".h5";
        scene.writeRestart(file);
        return std::filesystem::file_size(file);
    };
    const auto few = sizeAfter(0), many = sizeAfter(count);
    EXPECT_LT(many, few + 16 * count);
}

/// The walls of a file: those of `removed` have no species, as files of earlier versions had it.
void writeEarlierFile(const std::string& path, std::size_t count, std::size_t removed, Wall& wall) {
    Hdf5File file(path, Hdf5File::Access::Create);
    StateArchive archive(file, StateArchive::Direction::Write);
    archive.value("count", count);
    double time = 0;
    archive.value("time", time);
    for (std::size_t w = 0; w < count; ++w)
        archive.group(std::to_string(w), [&] {
            int none = -1;
            if (w == removed) archive.value("species", none);
            else wall.visitState(archive);
        });
    file.close();
}

TEST(RemovedWalls, areReadFromEarlierFiles) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    const std::string path = folder.name() + "-earlier.h5";
    Bouncing scene;
    scene.wallHandler.clear();
    for (int k = 0; k < 4; ++k) scene.addFarWall();
    writeEarlierFile(path, 4, 2, scene.wallHandler.getObject(0));
    Hdf5File file(path, Hdf5File::Access::Read);
    StateArchive archive(file, StateArchive::Direction::Read);
    scene.wallHandler.visitState(archive);
    EXPECT_EQ(scene.presentNumbers(), (std::vector<std::size_t>{0, 1, 3}));
}

TEST(RemovedWalls, areRefusedWhereTheFileIsDamaged) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    const std::string path = folder.name() + "-damaged.h5";
    for (const std::vector<std::uint32_t>& numbers :
         {std::vector<std::uint32_t>{1, 1}, {2, 1}, {0, 2}, {4'000'000'000u}}) {
        {
            Hdf5File file(path, Hdf5File::Access::Create);
            StateArchive archive(file, StateArchive::Direction::Write);
            std::size_t count = 2;
            archive.value("count", count);
            std::vector<std::uint32_t> removed = numbers;
            archive.column<std::uint32_t>("removed", removed);
            file.close();
        }
        Bouncing scene;
        scene.addFarWall();
        Hdf5File file(path, Hdf5File::Access::Read);
        StateArchive archive(file, StateArchive::Direction::Read);
        const std::string sentence = refusal([&] { scene.wallHandler.visitState(archive); });
        EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "removed")) << sentence;
    }
}

}  // namespace
}  // namespace pendular::removedWallsTest
