// The adapter for preCICE against a stand-in, and compiled against preCICE where it is found.
#include "Kernel/Features/Membranes/PreciceWall.h"

#include <gtest/gtest.h>

#include <span>
#include <string_view>

#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

#if __has_include(<precice/precice.hpp>)
    #include <precice/precice.hpp>
template class pendular::PreciceWall<precice::Participant>;
#endif

namespace pendular::preciceWallTest {
namespace {

using namespace membraneTests;

/// A participant whose partner is a plate of a mass that slides along z. It has the calls of version 3.
struct StandIn {
    double mass, window, end;  // kg, s, s
    int dimensions = 3;
    bool isImplicit = false;

    double time = 0, speed = 0, height = 0;  // s, m/s, m: of the plate
    std::vector<double> forces{};
    std::string calls{};

    [[nodiscard]] int getMeshDimensions(std::string_view mesh) const {
        EXPECT_EQ(mesh, "Wall");
        return dimensions;
    }
    void setMeshVertices(std::string_view mesh, std::span<const double> coordinates, std::span<int> ids) {
        EXPECT_EQ(mesh, "Wall");
        EXPECT_EQ(coordinates.size(), 3 * ids.size());
        for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = static_cast<int>(k) + 7;
        calls += 'v';
    }
    [[nodiscard]] static bool requiresInitialData() { return true; }
    void initialize() { calls += 'i'; }
    [[nodiscard]] bool isCouplingOngoing() const { return time < end - 1e-12; }
    [[nodiscard]] double getMaxTimeStepSize() const { return window; }
    [[nodiscard]] bool requiresWritingCheckpoint() const { return isImplicit; }
    void readData(std::string_view, std::string_view data, std::span<const int> ids, double at,
                  std::span<double> values) const {
        EXPECT_EQ(data, "Displacement");
        EXPECT_EQ(at, window);
        EXPECT_EQ(values.size(), 3 * ids.size());
        for (std::size_t k = 0; k < values.size(); ++k) values[k] = k % 3 == 2 ? height + speed * at : 0;
    }
    void writeData(std::string_view, std::string_view data, std::span<const int> ids,
                   std::span<const double> values) {
        EXPECT_EQ(data, "Force");
        EXPECT_EQ(ids[0], 7);
        forces.assign(values.begin(), values.end());
        calls += 'w';
    }
    void advance(double length) {
        height += speed * length;
        for (std::size_t k = 2; k < forces.size(); k += 3) speed += forces[k] * length / mass;
        time += length;
    }
};

HostWall flat() {
    HostWall wall;
    wall.set(membraneSheet(10, 10, edge));
    return wall;
}

std::vector<GrainMotion> ball(double speed) {
    return {{.radius = radius, .position = {0.011, 0.009, radius + 1e-5}, .velocity = {0, 0, -speed}}};
}

/// A ball over the wall that a partner moves, in windows of four steps.
struct Coupled : MembraneScene {
    explicit Coupled(double speed) : MembraneScene(ball(speed), step, material(0, 0)), wall(add(flat())) {}
    /// Until the partner's time is this, or the end.
    void runWith(StandIn& partner, double until) {
        PreciceWall coupling(partner, *wall, {.mesh = "Wall"});
        while (coupling.isOngoing() && partner.time < until - 1e-12) {
            coupling.beforeStep(step);
            MembraneScene::step();
            coupling.afterStep();
        }
    }
    static constexpr double step = 1e-6, window = 4 * step;  // s
    HostWall* wall;
};

/// An elastic ball and the plate of the partner part as the laws of collision say, to the share by which the
/// plate is late: (m - M)/(m + M) of the speed; momentum to round-off.
TEST(PreciceWall, collidesWithThePlateOfItsPartner) {
    constexpr double speed = 0.2;
    const double mass = 0.7 * grainMass;
    Coupled scene(speed);
    scene.initialise();
    StandIn partner{.mass = mass, .window = Coupled::window, .end = 0.02};
    scene.runWith(partner, infinity);
    EXPECT_EQ(partner.calls.substr(0, 4), "vwiw");
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 20000U);
    EXPECT_EQ(partner.calls.size(), 3U + 5000U);
    const double left = scene.motion(0).velocity.z();
    EXPECT_NEAR(grainMass * left + mass * partner.speed, -grainMass * speed, 1e-12 * grainMass * speed);
    EXPECT_NEAR(left / -speed, (grainMass - mass) / (grainMass + mass), 0.005);
    EXPECT_NEAR(scene.wall->getPosition(0).z(), partner.height, 1e-12);
}

/// Displacements are those from the shape as it was set, also where the wall has moved before a restart: it
/// stays where the partner is, and both go on bit for bit.
TEST(PreciceWall, goesOnWithItsPartner) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    Coupled whole(0.2);
    whole.initialise();
    StandIn partner{.mass = 0.7 * grainMass, .window = Coupled::window, .end = 2e-3, .speed = -0.05};
    whole.runWith(partner, 5e-4);  // in the middle of the touch
    ASSERT_GT(std::abs(partner.height), 1e-5);
    ASSERT_GT(whole.contactForceOn(0).norm(), 0);
    whole.writeRestart(file);
    StandIn again = partner;
    whole.runWith(partner, infinity);

    Coupled resumed(0.2);
    resumed.restartFrom(file);
    resumed.initialise();
    resumed.runWith(again, infinity);
    EXPECT_EQ(resumed.getNumberOfTimeSteps(), 2000U);
    EXPECT_NEAR(resumed.wall->getPosition(0).z(), again.height, 1e-12);
    EXPECT_EQ(again.height, partner.height);
    EXPECT_EQ(again.speed, partner.speed);
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
}

/// Where a window begins, the step may be another one; within it, not: the wall would go further or less far
/// than its partner.
TEST(PreciceWall, refusesAnotherStepWithinAWindow) {
    Coupled scene(0.1);
    scene.initialise();
    StandIn partner{.mass = 1, .window = Coupled::window, .end = 1};
    PreciceWall coupling(partner, *scene.wall, {.mesh = "Wall"});
    const auto go = [&](double step) {
        coupling.beforeStep(step);
        scene.steps(1);
        coupling.afterStep();
    };
    go(1e-6), go(1e-6);
    const std::string text = support::refusal([&] { go(2e-6); });
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "from 1e-06 to 2e-06 s in a window"));
    go(1e-6), go(1e-6);
    scene.setTimeStep(2e-6);
    go(2e-6), go(2e-6);
    EXPECT_NEAR(partner.time, 2 * Coupled::window, 1e-18);
}

TEST(PreciceWall, refusesWhatItCannotDo) {
    MembraneScene scene(ball(0.1), 1e-6);
    HostWall* const wall = scene.add(flat());
    scene.initialise();
    const auto refusal = [&](StandIn partner) {
        const std::string text = support::refusal([&] {
            PreciceWall coupling(partner, *wall, {.mesh = "Wall"});
            coupling.beforeStep(1e-6);
        });
        EXPECT_TRUE(support::isOneSentence(text));
        return text;
    };
    EXPECT_TRUE(support::contains(refusal({.mass = 1, .window = 2.5e-6, .end = 1}), "multiple"));
    EXPECT_TRUE(
        support::contains(refusal({.mass = 1, .window = 1e-6, .end = 1, .dimensions = 2}), "2 dimensions"));
    EXPECT_TRUE(
        support::contains(refusal({.mass = 1, .window = 1e-6, .end = 1, .isImplicit = true}), "implicit"));
}

}  // namespace
}  // namespace pendular::preciceWallTest
