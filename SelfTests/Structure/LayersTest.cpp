#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "BuildFolders.h"

namespace pendular::layersTest {
namespace {

namespace fs = std::filesystem;
const fs::path kernel = folders::source / "Kernel";

/// What still goes up, and what will mend it. Each row goes with its mend; none comes.
const std::set<std::string> knownUpwards{
    // An observer of contacts.
    "Core/Contacts/ContactSystem.h: Features/ContactEvents/ContactEvents.h",
    "Core/Contacts/ContactSystem.h: Features/LiquidTransport/ContactLiquid.h",
    "Core/Contacts/ContactSystem.h: Features/Meshes/WallPatches.h",
    "Core/Particles/ParticleHandler.h: Features/LiquidTransport/GrainFilms.h",
    // Contacts that ranks share, or that go through a periodic face, behind an interface.
    "Core/Contacts/ContactSystem.cpp: Features/DomainDecomposition/ContactMigration.h",
    "Core/Contacts/ContactSystem.cpp: Features/PeriodicWalls/FacePassage.h",
    // Which body a grain belongs to, and an observer of the particle store.
    "Core/Motion/GrainSizes.h: Features/RigidBodies/BodySizes.h",
    "Core/Particles/ParticleStore.h: Features/RigidBodies/RigidBodies.h",
    "Core/Step/GrainPart.cpp: Features/RigidBodies/RigidBodyMotion.h",
    // A wall that answers for what moves it: its response to a force, its motion, its wear.
    "Core/Contacts/ContactChanges.cpp: Features/Wear/WornWall.h",
    "Core/Motion/SceneLimits.cpp: Features/Membranes/Membrane.h",
    "Core/Motion/SceneLimits.cpp: Features/MovingWalls/PlaneDrive.h",
    "Core/Motion/SceneLimits.cpp: Features/MovingWalls/WallBody.h",
    "Core/Motion/SceneLimits.cpp: Features/RigidBodies/BodyLimits.h",
    "Core/Walls/RigidWall.h: Features/MovingWalls/WallBody.h",
    "Core/Walls/Wall.cpp: Features/MovingWalls/PlaneDrive.h",
    "Core/Walls/Wall.cpp: Features/MovingWalls/WallBody.h",
    // A forward declaration.
    "Core/Contacts/GrainShapes.h: Features/Superquadrics/Superquadric.h",
    "Core/Walls/Wall.h: Features/MovingWalls/PlaneDrive.h",
    "Laws/Species/LiquidLaws.h: Features/LiquidBridges/BridgeSurface.h",
    // A part that asks another one by its type.
    "Features/RigidBodies/BodyPart.cpp: Features/Inlets/Inlet.h",
};

/// The names in the first column of the first table of a page, behind a heading: `NAME/`.
std::vector<std::string> namesOf(const fs::path& page, const std::string& heading) {
    std::ifstream file(page);
    const std::regex row(R"(^\| `(\w+)/` \|.*)");
    std::vector<std::string> found;
    bool isBehind = heading.empty();
    for (std::string line; std::getline(file, line);) {
        isBehind |= line == heading;
        if (std::smatch match; isBehind && std::regex_match(line, match, row)) found.push_back(match[1]);
        else if (!found.empty()) break;
    }
    return found;
}

const std::vector<std::string>& layers() {
    static const std::vector<std::string> names = namesOf(kernel / "README.md", "");
    return names;
}
/// In the order in which they may include each other.
const std::vector<std::string>& features() {
    static const std::vector<std::string> names = namesOf(kernel / "ARCHITECTURE.md", "## Features");
    return names;
}

std::vector<std::string> foldersIn(const fs::path& folder) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory()) found.push_back(entry.path().filename().string());
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
}

bool isSource(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

/// Calls of(file, included) for each include of a file of the kernel in a file of a layer, both below
/// Kernel/.
void forEachInclude(const std::function<void(const std::string&, const std::string&)>& of) {
    const std::string before = "#include \"Kernel/";
    for (const std::string& layer : layers())
        for (const auto& entry : fs::recursive_directory_iterator(kernel / layer)) {
            if (!isSource(entry.path())) continue;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                if (line.starts_with(before))
                    of(entry.path().lexically_relative(kernel).string(),
                       line.substr(before.size(), line.find('"', before.size()) - before.size()));
        }
}

/// The place of a file in the order of layers, and within Features of features.
std::pair<std::ptrdiff_t, std::ptrdiff_t> heightOf(const std::string& file) {
    const auto placeIn = [](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    const std::size_t first = file.find('/'), second = file.find('/', first + 1);
    const std::string layer = first == std::string::npos ? "Mercury" : file.substr(0, first);
    if (layer != "Features" || second == std::string::npos)  // what CMake writes belongs to no feature
        return {placeIn(layers(), layer), -1};
    return {placeIn(layers(), layer), placeIn(features(), file.substr(first + 1, second - first - 1))};
}

TEST(Layers, areAllFoldersOfTheKernel) { EXPECT_EQ(sorted(layers()), foldersIn(kernel)); }

TEST(Layers, featuresAreThoseOfThePage) { EXPECT_EQ(sorted(features()), foldersIn(kernel / "Features")); }

TEST(Layers, includeOnlyFromTheirOwnOrOneBelow) {
    std::size_t seen = 0;
    std::set<std::string> upwards;
    forEachInclude([&](const std::string& file, const std::string& included) {
        ++seen;
        if (heightOf(included) > heightOf(file)) upwards.insert(file + ": " + included);
    });
    EXPECT_GT(seen, 2000u);
    for (const std::string& one : upwards) EXPECT_TRUE(knownUpwards.contains(one)) << "goes up: " << one;
    for (const std::string& one : knownUpwards)
        EXPECT_TRUE(upwards.contains(one)) << "goes up no longer; take its row away: " << one;
}

// What a scene of spheres and plain walls needs stays small. Lines that are neither blank nor a comment.
TEST(Layers, ofTheCoreAreSmall) {
    std::size_t files = 0, lines = 0;
    for (const char* layer : {"Foundation", "Laws", "Core"})
        for (const auto& entry : fs::recursive_directory_iterator(kernel / layer)) {
            if (!isSource(entry.path())) continue;
            ++files;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);) {
                const std::size_t at = line.find_first_not_of(" \t");
                lines += at != std::string::npos && line.compare(at, 2, "//") != 0;
            }
        }
    EXPECT_LE(files, 290u);
    EXPECT_LE(lines, 22000u);
    EXPECT_GT(lines, 10000u);
}

// Else a change of the scene's header compiles all again that uses an output.
TEST(Layers, headersOfOutputsOnlyNameTheScene) {
    const std::regex scene(R"(^\s*#\s*include "Kernel/Scene/(Scene|Simulation)\.h".*)");
    std::size_t headers = 0;
    std::string including;
    for (const char* folder : {"Output", "CoarseGraining"})
        for (const auto& entry : fs::directory_iterator(kernel / "Analysis" / folder)) {
            if (entry.path().extension() != ".h") continue;
            ++headers;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                if (std::regex_match(line, scene)) including += entry.path().string() + '\n';
        }
    EXPECT_GT(headers, 20u);
    EXPECT_EQ(including, "");
}

}  // namespace
}  // namespace pendular::layersTest
