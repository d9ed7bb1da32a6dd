#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::stoppedRunTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::contains;
using support::isOneSentence;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<HertzianViscoelastic, Mindlin>;

constexpr double r = 1e-3;  // m

/// The sentence with which a run ends; empty if it comes to its end.
std::string stopOf(Scene& scene) {
    try {
        scene.solve();
    } catch (const RunError& stop) {
        return stop.what();
    }
    return {};
}

struct Table {
    std::string header, comment;
    std::vector<std::vector<double>> rows;
};

Table read(const std::string& path) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    Table table;
    std::getline(file, table.header);
    std::getline(file, table.comment);
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        table.rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) table.rows.back().push_back(std::stod(cell));
    }
    return table;
}

Smooth soft(double stiffness) {
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(stiffness);
    return species;
}

/// Counts outputs, and fails at one of them if asked to.
class Head : public FewGrains<Smooth> {
public:
    using FewGrains<Smooth>::FewGrains;
    void writeOutput() override {
        outputs.push_back(getNumberOfTimeSteps());
        if (failsAtTheEnd && getNumberOfTimeSteps() > 0) throw InputError("The disk is full.");
    }
    std::vector<std::size_t> outputs;
    bool failsAtTheEnd = false;
};

constexpr double softStiffness = 1;  // N/m
constexpr double softStep = 1e-5;    // s
double softMass() { return sphereMass(r, 2000); }

/// Two soft grains that meet with the speed at which they would overlap by a share of the radius.
std::vector<GrainMotion> headOn(double share) {
    const double speed = share * r * std::sqrt(softStiffness / (0.5 * softMass()));
    return {{.radius = r, .position = {-1.1 * r, 0, 0}, .velocity = {0.5 * speed, 0, 0}},
            {.radius = r, .position = {1.1 * r, 0, 0}, .velocity = {-0.5 * speed, 0, 0}}};
}

TEST(DeepOverlap, endsTheRunBeforeItIsDeeperThanTheSkinAllows) {
    const TestFolder folder;
    Head scene(soft(softStiffness), headOn(0.9), softStep);
    scene.setName(folder.name());
    scene.setTimeMax(0.1);
    const std::string text = stopOf(scene);
    EXPECT_TRUE(isOneSentence(text));
    for (const char* part : {"particles 0 and 1 overlap", "% of the smaller radius", "more than 50 %",
                             "run-last-state.csv", "run-last-contacts.csv"})
        EXPECT_TRUE(contains(text, part));
    const Table contacts = read(folder.name() + "-last-contacts.csv");
    ASSERT_EQ(contacts.rows.size(), 1u);
    const double overlap = -contacts.rows[0][3];
    // Half the radius, and no more than the skin of 0.15 radii deeper; at the step before, not yet a step's
    // way more.
    EXPECT_GT(overlap, (0.5 - 0.02) * r);
    EXPECT_LT(overlap, 0.65 * r);
    EXPECT_NEAR(contacts.rows[0][4] / (softStiffness * overlap), 1, 1e-9);  // the force that goes with it
}

TEST(DeepOverlap, thatStaysBelowHalfTheRadiusDoesNotEndTheRun) {
    Head scene(soft(softStiffness), headOn(0.49), softStep);
    scene.setTimeMax(0.1);
    EXPECT_EQ(stopOf(scene), "");
    EXPECT_GT(scene.motion(1).velocity.x(), 0);
}

/// Two grains that no force keeps apart, at any speed that the time step allows: they never change sides
/// unnoticed.
TEST(Tunnelling, ofGrainsThroughGrainsEndsTheRun) {
    const TestFolder folder;
    int stopped = 0;
    for (double small : {0.05, 0.3, 1.0})                                   // radii of the one, of the other
        for (double share : {0.003, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.999})  // of the smaller radius a step
            for (double offset : {0.0, 0.21, 0.48, 0.83}) {
                const double speed = share * small * r / softStep;
                FewGrains<Smooth> scene(
                    soft(1e-9),
                    {{.radius = r, .position = {-1.1 * r, 0, 0}, .velocity = {offset * speed, 0, 0}},
                     {.radius = small * r,
                      .position = {(0.1 + small + offset * share) * r, 1e-3 * small * r, 0},
                      .velocity = {-speed, 0, 0}}},
                    softStep);
                scene.setName(folder.name());
                scene.setTimeMax(10 * r / speed);
                const std::string text = stopOf(scene);
                EXPECT_TRUE(contains(text, "particles 0 and 1 overlap"))
                    << small << ' ' << share << ' ' << offset;
                stopped += text.empty() ? 0 : 1;
            }
    EXPECT_EQ(stopped, 96);
}

TEST(LastState, isThatOfTheLastWholeStep) {
    const TestFolder folder;
    // A twin takes the same steps and is looked at after each of them.
    Head scene(soft(softStiffness), headOn(0.9), softStep), twin(soft(softStiffness), headOn(0.9), softStep);
    for (Head* each : {&scene, &twin}) each->setName(folder.name()), each->setTimeMax(0.1);
    const std::string text = stopOf(scene);
    twin.run(static_cast<int>(scene.getNumberOfTimeSteps()));
    EXPECT_EQ(scene.outputs.back(), scene.getNumberOfTimeSteps());
    EXPECT_EQ(scene.outputs.size(), 2u);  // at the start and at the stop

    const Table grains = read(folder.name() + "-last-state.csv");
    EXPECT_TRUE(contains(grains.header, "identity,species,radius_m,x_m,y_m,z_m,vx_m_per_s"));
    EXPECT_TRUE(contains(grains.comment, fmt::format("At time {:.6g} s", scene.getTime())));
    EXPECT_TRUE(contains(text, fmt::format("At time {:.6g} s", scene.getTime())));
    ASSERT_EQ(grains.rows.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::vector<double>& row = grains.rows[k];
        ASSERT_EQ(row.size(), 17u);
        const GrainMotion expected = twin.motion(k), kept = scene.motion(k);
        EXPECT_EQ(row[0], static_cast<double>(k));
        EXPECT_EQ(row[2], r);
        EXPECT_EQ(Vec3D(row[3], row[4], row[5]), kept.position);  // all digits are written
        EXPECT_EQ(Vec3D(row[6], row[7], row[8]), kept.velocity);
        // The step is taken back up to the rounding of a few sums.
        EXPECT_LT((kept.position - expected.position).norm(), 1e-18);
        EXPECT_LT((kept.velocity - expected.velocity).norm(), 1e-15 * expected.velocity.norm());
        EXPECT_EQ(row[15], twin.particleHandler.getObject(k).getMass());
        EXPECT_EQ(row[16], 0);  // not held
        EXPECT_EQ(row[12], twin.particleHandler.getObject(k).getForce().x());
    }
}

TEST(LastState, hasSpinsAndWalls) {
    const TestFolder folder;
    struct Kick : scenes::SettlingBox<Rough> {
        using SettlingBox::SettlingBox;
        void actionsAfterTimeStep() override {
            if (getNumberOfTimeSteps() == 1500) particleHandler.getObject(7).setVelocity({0, 200, 0});
        }
    } kicked(3);
    kicked.setName(folder.name());
    kicked.setTimeMax(0.05);
    EXPECT_TRUE(contains(stopOf(kicked), "particle 7 moves at 200 m/s"));
    EXPECT_EQ(kicked.getNumberOfTimeSteps(), 1500u);
    const Table grains = read(folder.name() + "-last-state.csv"),
                contacts = read(folder.name() + "-last-contacts.csv");
    ASSERT_EQ(grains.rows.size(), 48u);
    EXPECT_EQ(grains.rows[7][7], 200);
    EXPECT_EQ(grains.rows[7][9], kicked.particleHandler.getObject(7).getAngularVelocity().x());
    EXPECT_NE(grains.rows[7][9], 0);
    int walls = 0, tangential = 0;
    for (const auto& row : contacts.rows) {
        walls += row[2] >= 0 ? 1 : 0;
        EXPECT_EQ(row[2] >= 0, row[1] == -1);  // a wall or a second grain
        ASSERT_EQ(row.size(), 11u);
        tangential += row[7] > 0 ? 1 : 0;
        // The contact point is as far from the centre as the radius, less half the overlap, or all of it.
        const auto& grain = grains.rows.at(static_cast<std::size_t>(row[0]));
        const Vec3D branch = Vec3D(row[8], row[9], row[10]) - Vec3D(grain[3], grain[4], grain[5]);
        EXPECT_NEAR(branch.norm(), grain[2] + (row[2] >= 0 ? 1 : 0.5) * row[3],
                    1e-16);  // 1e-16 of a box of cm
    }
    EXPECT_GT(walls, 4);
    EXPECT_GT(static_cast<int>(contacts.rows.size()), walls);
    EXPECT_GT(tangential, walls);
}

TEST(LastState, thatCannotBeWrittenIsSaidAfterTheReason) {
    Head scene(soft(softStiffness), headOn(0.9), softStep);
    scene.setName("/dev/null/run");
    scene.setTimeMax(0.1);
    const std::string text = stopOf(scene);
    EXPECT_TRUE(isOneSentence(text));
    for (const char* part : {"particles 0 and 1 overlap", "writing the last state failed", "/dev/null/run"})
        EXPECT_TRUE(contains(text, part));

    const TestFolder folder;
    Head failing(soft(softStiffness), headOn(0.9), softStep);
    failing.setName(folder.name());
    failing.setTimeMax(0.1);
    failing.failsAtTheEnd = true;
    const std::string both = stopOf(failing);
    EXPECT_TRUE(isOneSentence(both));
    for (const char* part : {"particles 0 and 1 overlap", "The disk is full"})
        EXPECT_TRUE(contains(both, part));
    EXPECT_EQ(read(folder.name() + "-last-state.csv").rows.size(), 2u);
}

TEST(LastState, isNotWrittenByARunThatEnds) {
    const TestFolder folder;
    Head scene(soft(softStiffness), headOn(0.3), softStep);
    scene.setName(folder.name());
    scene.setTimeMax(0.01);
    EXPECT_EQ(stopOf(scene), "");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_TRUE(contains(support::refusal([&] { scene.setName(""); }), "name is empty"));
}

}  // namespace
}  // namespace pendular::stoppedRunTest
