// What ParaView is given of a scene, read back from the files.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::paraViewTest {
namespace {

using scenes::FewGrains;
using support::TestFolder;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;
using Smooth = Species<LinearViscoelastic>;

constexpr double floatError = 6e-8;  // relative, of a number written with 24 bits

double number(const PolyData& data, std::string_view name, std::size_t k) {
    const PolyDataField* field =
        data.kind == PolyData::Cells::Vertices ? data.pointField(name) : data.cellField(name);
    return field ? field->at(k) : std::nan("");
}
Vec3D vector(const PolyData& data, std::string_view name, std::size_t k) {
    return {number(data, name, 3 * k), number(data, name, 3 * k + 1), number(data, name, 3 * k + 2)};
}
Vec3D endOf(const PolyData& lines, std::size_t k) {
    return toEigen(lines.points[static_cast<std::size_t>(lines.corners[k])]);
}
double area(const PolyData& walls, int wall) {
    double sum = 0;
    for (std::size_t cell = 0, begin = 0; cell < walls.ends.size(); ++cell) {
        const auto end = static_cast<std::size_t>(walls.ends[cell]);
        Vector<double> doubled{0, 0, 0};
        const auto corner = [&](std::size_t k) {
            return walls.points[static_cast<std::size_t>(walls.corners[k])];
        };
        for (std::size_t k = begin + 1; k + 1 < end; ++k)
            doubled += cross(corner(k) - corner(begin), corner(k + 1) - corner(begin));
        if (number(walls, "wall", cell) == wall) sum += 0.5 * norm(doubled);
        begin = end;
    }
    return sum;
}

TEST(ParaView, seesTheGrainsAndContactsOfAScene) {
    const TestFolder folder;
    scenes::SettlingBox<Wet> scene(3);
    scene.setName(folder.name());
    scene.setTimeMax(1500 * 0x1p-17);
    scene.addOutput(ParaViewOutput().withContactPoints());
    scene.solve();
    const PolyData grains = readPolyData(folder.name() + "-particles-000001500.vtp");
    const PolyData contacts = readPolyData(folder.name() + "-contacts-000001500.vtp");
    ASSERT_EQ(grains.points.size(), 48u);
    EXPECT_EQ(grains.time, scene.getTime());
    EXPECT_EQ(contacts.time, scene.getTime());

    std::vector<Vec3D> sums;
    for (std::size_t k = 0; k < 48; ++k) {
        const auto grain = scene.particleHandler.getObject(k);
        EXPECT_EQ(toEigen(grains.points[k]), grain.getPosition());
        EXPECT_EQ(number(grains, "identity", k), static_cast<double>(k));
        EXPECT_EQ(number(grains, "radius_m", k), static_cast<float>(grain.getRadius()));
        EXPECT_EQ(number(grains, "mass_kg", k), static_cast<float>(grain.getMass()));
        EXPECT_EQ(number(grains, "fixed", k), 0);
        EXPECT_EQ(vector(grains, "velocity_m_per_s", k), grain.getVelocity().cast<float>().cast<double>());
        EXPECT_EQ(vector(grains, "spin_rad_per_s", k),
                  grain.getAngularVelocity().cast<float>().cast<double>());
        EXPECT_EQ(number(grains, "species", k), grain.getRadius() > 1.2e-3 ? 1 : 0);
        sums.push_back(grain.getMass() * scene.getGravity());
    }
    ASSERT_GT(contacts.ends.size(), 30u);
    int bridged = 0, atWalls = 0;
    for (std::size_t k = 0; k < contacts.ends.size(); ++k) {
        const auto first = static_cast<std::size_t>(number(contacts, "particle1", k));
        const int second = static_cast<int>(number(contacts, "particle2", k));
        const int wall = static_cast<int>(number(contacts, "wall", k));
        const double overlap = number(contacts, "overlap_m", k);
        const Vec3D begin = endOf(contacts, 2 * k), end = endOf(contacts, 2 * k + 1);
        const Vec3D force = vector(contacts, "force_N", k);
        EXPECT_EQ(begin, toEigen(grains.points[first]));
        sums[first] += force;
        double length = scene.particleHandler.getObject(first).getRadius();
        if (second >= 0) {
            const auto other = scene.particleHandler.getObject(static_cast<std::size_t>(second));
            EXPECT_LT((end - other.getPosition()).norm(), 1e-17);
            EXPECT_EQ(wall, -1);
            length += other.getRadius();
            sums[static_cast<std::size_t>(second)] -= force;
        } else {
            const auto& plane = scene.planes.at(static_cast<std::size_t>(wall));
            EXPECT_NEAR(plane.normal.dot(end - plane.point), 0, 1e-17);
            ++atWalls;
        }
        EXPECT_NEAR((end - begin).norm(), length - overlap, 1e-17 + floatError * std::abs(overlap));
        // Along the normal, from body 1 to body 2: friction has no part in it. A bridge pulls.
        EXPECT_NEAR(-force.dot((end - begin).normalized()),
                    number(contacts, "normal_force_N", k) - number(contacts, "adhesive_force_N", k),
                    3 * floatError * (force.norm() + std::abs(number(contacts, "adhesive_force_N", k))));
        // The rest of the force is friction; each of the two sums loses bits where it is small beside them.
        const Vec3D normal = (end - begin).normalized();
        EXPECT_NEAR((force - force.dot(normal) * normal).norm(), number(contacts, "tangential_force_N", k),
                    3 * floatError * force.norm());
        // In the middle of the overlap or of the gap, at a wall on its surface: half the overlap from the end
        // of a grain's radius, and in 24 bits of a box of 13 mm.
        const double radius = scene.particleHandler.getObject(first).getRadius();
        EXPECT_LT((vector(contacts, "contact_point_m", k) -
                   (begin + (radius - (second < 0 ? 1 : 0.5) * overlap) * normal))
                      .norm(),
                  2 * floatError * 0.0125);
        const bool isBridged = number(contacts, "bridged", k) == 1;
        bridged += isBridged ? 1 : 0;
        EXPECT_EQ(number(contacts, "adhesive_force_N", k) > 0, isBridged);
        EXPECT_EQ(number(contacts, "bridge_volume_m3", k) > 0, isBridged);
    }
    EXPECT_GT(bridged, 20);
    EXPECT_GT(atWalls, 10);
    // Contacts and weight make the whole force on each grain.
    for (std::size_t k = 0; k < 48; ++k)
        EXPECT_LT((sums[k] - vector(grains, "force_N", k)).norm(), 12 * floatError * 5e-3) << k;
}

TEST(ParaView, seesTheMassOfAHeldGrainAndNoFrictionOfSmoothOnes) {
    const TestFolder folder;
    Smooth species;
    species.setDensity(2000), species.setStiffness(1e3), species.setDissipation(0);
    FewGrains<Smooth> scene(species, {{.position = {0, 0, 0}, .fixed = true}, {.position = {1.99e-3, 0, 0}}},
                            1e-6);
    scene.setName(folder.name());
    scene.addOutput(ParaViewOutput());
    scene.setTimeMax(0);
    scene.solve();
    const PolyData grains = readPolyData(folder.name() + "-particles-000000000.vtp"),
                   contacts = readPolyData(folder.name() + "-contacts-000000000.vtp");
    const double mass = 4.0 / 3.0 * std::numbers::pi * 1e-9 * 2000;  // kg
    for (const std::size_t k : {0, 1}) {
        EXPECT_NEAR(number(grains, "mass_kg", k) / mass, 1, 2 * floatError);
        EXPECT_EQ(number(grains, "fixed", k), k == 0 ? 1 : 0);
    }
    ASSERT_EQ(contacts.ends.size(), 1u);
    for (const char* absent : {"tangential_force_N", "contact_point_m"})
        EXPECT_EQ(contacts.cellField(absent), nullptr) << absent;
}

TEST(ParaView, doesNotChangeTheTrajectory) {
    const TestFolder folder;
    const auto hashOf = [&](bool watched) {
        scenes::SettlingBox<Wet> scene(2);
        scene.setName(folder.name());
        scene.setSaveCount(7);
        scene.setTimeMax(700 * 0x1p-17);
        if (watched) scene.addOutput(ParaViewOutput().withStress());
        scene.solve();
        return stateHash(scene.particleHandler.store());
    };
    EXPECT_EQ(hashOf(true), hashOf(false));
}

/// A box whose lid is far above the grains is shown whole.
TEST(ParaView, seesPlanesCutOffByEachOther) {
    const TestFolder folder;
    scenes::SettlingBox<Smooth> scene(2);
    scene.setName(folder.name());
    scene.setTimeMax(0);
    scene.addOutput(ParaViewOutput());
    scene.solve();
    double top = 0;
    for (const TranslationRecord& grain : scene.particleHandler.store().translation)
        top = std::max(top, grain.position.z + 2 * grain.radius);
    const PolyData walls = readPolyData(folder.name() + "-walls-000000000.vtp");
    const double width = scenes::SettlingBox<Smooth>::width, height = scene.planes[4].point.z();
    ASSERT_LT(top, height);
    for (int wall = 0; wall < 4; ++wall) EXPECT_NEAR(area(walls, wall) / (width * height), 1, 1e-8) << wall;
    for (int wall = 4; wall < 6; ++wall) EXPECT_NEAR(area(walls, wall) / (width * width), 1, 1e-8) << wall;
}

/// A floor in a cylinder, and the cylinder on it, as a regular polygon of 64 corners.
TEST(ParaView, seesACylinderOnItsFloor) {
    const TestFolder folder;
    constexpr double r = 1e-3, wide = 0.02;
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(100);
    FewGrains<Smooth> scene(species, {{.radius = r, .position = {0.01, 0, 1.5 * r}}}, 1e-5,
                            {{{0, 0, -1}, {0, 0, 0}}});
    InfiniteCylinder cylinder;
    cylinder.setSpecies(scene.speciesHandler.getObject(0));
    cylinder.set({0, 0, 3}, {0, 0, 7}, wide, CylinderSide::Inside);
    scene.wallHandler.copyAndAddObject(cylinder);
    TriangleWall fin;  // widens the box beyond the cylinder
    fin.setSpecies(scene.speciesHandler.getObject(0));
    fin.set(std::vector<Triangle>{{{{-0.1, -0.1, 0.05}, {0.1, 0.1, 0.05}, {0.1, 0.1, 0.06}}}});
    scene.wallHandler.copyAndAddObject(fin);
    scene.setName(folder.name());
    scene.addOutput(ParaViewOutput());
    scene.setTimeMax(0);
    scene.solve();
    const PolyData walls = readPolyData(folder.name() + "-walls-000000000.vtp");
    const double corner = 2 * std::numbers::pi / 64;
    EXPECT_NEAR(area(walls, 0), 32 * wide * wide * std::sin(corner), 1e-15);
    EXPECT_NEAR(area(walls, 1), 64 * 2 * wide * std::sin(0.5 * corner) * 0.06, 1e-15);
    EXPECT_NEAR(area(walls, 2), 0.5 * 0.01 * 0.2 * std::numbers::sqrt2, 1e-15);
}

/// A grain of radius r between two planes, each of which presses with F: the stress across is -F 2 r / V.
TEST(ParaView, seesTheStressOfASqueezedGrain) {
    const TestFolder folder;
    constexpr double r = 1e-3, overlap = 1e-5, stiffness = 1000;
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(stiffness);
    FewGrains<Smooth> scene(species, {{.radius = r}}, 1e-6,
                            {{{0, 0, -1}, {0, 0, -r + overlap}}, {{0, 0, 1}, {0, 0, r - overlap}}});
    scene.setName(folder.name());
    scene.addOutput(
        ParaViewOutput()
            .withStress()
            .addField("twice_identity", [](std::size_t k) { return 2.0 * static_cast<double>(k); })
            .addField("place_m",
                      [&scene](std::size_t k) { return scene.particleHandler.getObject(k).getPosition(); }));
    scene.setTimeMax(0);
    scene.solve();
    const PolyData grains = readPolyData(folder.name() + "-particles-000000000.vtp");
    // The branch ends in the middle of the overlap.
    const double expected = -2 * stiffness * overlap * (r - 0.5 * overlap) / sphereMass(r, 1);
    for (std::size_t k = 0; k < 9; ++k)
        EXPECT_NEAR(number(grains, "stress_Pa", k), k == 8 ? expected : 0, 1e-6 * std::abs(expected)) << k;
    EXPECT_EQ(number(grains, "twice_identity", 0), 0);
    EXPECT_EQ(vector(grains, "place_m", 0), Vec3D(0, 0, 0));
}

TEST(ParaView, seesAContactThroughAPeriodicFaceAsAShortLine) {
    const TestFolder folder;
    constexpr double r = 1e-3;
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(1000);
    FewGrains<Smooth> scene(
        species, {{.radius = r, .position = {0.1 * r, 0, 0}}, {.radius = r, .position = {8.14 * r, 0, 0}}},
        1e-6);
    scene.setPeriodic(0, 0, 10 * r);
    scene.setName(folder.name());
    scene.addOutput(ParaViewOutput());
    scene.setTimeMax(0);
    scene.solve();
    const PolyData contacts = readPolyData(folder.name() + "-contacts-000000000.vtp");
    ASSERT_EQ(contacts.ends.size(), 1u);
    EXPECT_NEAR((endOf(contacts, 1) - endOf(contacts, 0)).norm(), 1.96 * r, 1e-17);
    EXPECT_NEAR(number(contacts, "overlap_m", 0), 0.04 * r, floatError * 0.04 * r + 1e-17);
}

TEST(ParaView, hasOneSeriesOfARunThatGoesOn) {
    const TestFolder folder;
    ParaViewSeries first(folder.name(), -INFINITY);
    std::filesystem::create_directories(folder.path());
    for (const int k : {0, 1, 2, 3}) {
        std::ofstream(folder.path() / fmt::format("run-walls-{:09}.vtp", 10 * k)) << "a wall";
        EXPECT_EQ(first.add("particles", 0.5 * k, 10 * k).filename(),
                  fmt::format("run-particles-{:09}.vtp", 10 * k));
        first.add("walls", 0.5 * k, 10 * k);
    }
    first.write();
    ParaViewSeries second(folder.name(), 0.5);  // from step 10 on
    for (const int k : {0, 1, 2, 3})
        EXPECT_EQ(std::filesystem::exists(folder.path() / fmt::format("run-walls-{:09}.vtp", 10 * k)),
                  k <= 1);
    second.add("particles", 1.0, 20);
    second.write();
    std::ifstream file(folder.name() + ".pvd");
    std::vector<std::string> entries;
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("<DataSet")) entries.push_back(line);
    ASSERT_EQ(entries.size(), 5u);
    EXPECT_EQ(entries[3],
              "<DataSet timestep=\"0.5\" part=\"1\" name=\"walls\" file=\"run-walls-000000010.vtp\"/>");
    EXPECT_EQ(entries[4],
              "<DataSet timestep=\"1\" part=\"0\" name=\"particles\" file=\"run-particles-000000020.vtp\"/>");
    const std::vector<ParaViewEntry> read = readParaViewSeries(folder.name() + ".pvd");
    ASSERT_EQ(read.size(), 5u);
    EXPECT_EQ(read[3].time, 0.5);
    EXPECT_EQ(read[3].kind, "walls");
    EXPECT_EQ(read[3].file, folder.path() / "run-walls-000000010.vtp");
    EXPECT_EQ(ParaViewSeries(folder.name(), -INFINITY).add("a", 0, 0).filename(), "run-a-000000000.vtp");
}

/// 29.6, 59.2 and 88.8 steps, whenever other outputs are due; and the last state.
TEST(ParaView, writesTheFrameNearestToEachMultipleOfItsInterval) {
    for (const std::size_t saveCount : {0, 1, 11, 100}) {
        const TestFolder folder;
        FewGrains<Smooth> scene(scenes::boxMaterial<Smooth>(0), {{.radius = 1e-3}}, 1e-5);
        scene.setTimeMax(100e-5);
        scene.setSaveCount(saveCount);
        scene.addOutput(ParaViewOutput(folder.name()).withInterval(29.6e-5).withContacts(false));
        scene.solve();
        std::vector<int> steps;
        for (const ParaViewEntry& entry : readParaViewSeries(folder.name() + ".pvd"))
            steps.push_back(static_cast<int>(std::lround(entry.time / 1e-5)));
        EXPECT_EQ(steps, (std::vector<int>{0, 30, 59, 89, 100})) << saveCount;
    }
}

TEST(ParaView, thatCannotBeWrittenEndsTheRunInOneSentence) {
    FewGrains<Smooth> scene(scenes::boxMaterial<Smooth>(0), {{.radius = 1e-3}}, 1e-6);
    scene.setName("/dev/null/run");
    scene.addOutput(ParaViewOutput());
    scene.setTimeMax(0);
    EXPECT_THROW(scene.solve(), InputError);
}

}  // namespace
}  // namespace pendular::paraViewTest
