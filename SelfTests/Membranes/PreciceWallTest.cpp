// The adapter for preCICE against a stand-in, and compiled against preCICE where it is found.
#include "Kernel/Walls/PreciceWall.h"

#include <gtest/gtest.h>

#include <span>
#include <string_view>

#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"

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

/// An elastic ball and the plate of the partner part as the laws of collision say, to the share by which the
/// plate is late: (m - M)/(m + M) of the speed; momentum to round-off.
TEST(PreciceWall, collidesWithThePlateOfItsPartner) {
    constexpr double speed = 0.2, step = 1e-6;
    const double mass = 0.7 * grainMass;
    MembraneScene scene(ball(speed), step, material(0, 0));
    HostWall* const wall = scene.add(flat());
    scene.initialise();
    StandIn partner{.mass = mass, .window = 4 * step, .end = 0.02};
    PreciceWall coupling(partner, *wall, {.mesh = "Wall"});
    EXPECT_EQ(partner.calls, "vwi");
    int steps = 0;
    while (coupling.isOngoing()) {
        coupling.beforeStep(step);
        scene.step();
        coupling.afterStep();
        ++steps;
    }
    EXPECT_EQ(steps, 20000);
    EXPECT_EQ(partner.calls.size(), 3U + 5000U);
    const double left = scene.motion(0).velocity.z();
    EXPECT_NEAR(grainMass * left + mass * partner.speed, -grainMass * speed, 1e-12 * grainMass * speed);
    EXPECT_NEAR(left / -speed, (grainMass - mass) / (grainMass + mass), 0.005);
    EXPECT_NEAR(wall->getPosition(0).z(), partner.height, 1e-12);
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
