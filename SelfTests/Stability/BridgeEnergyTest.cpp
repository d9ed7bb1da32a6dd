#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Foundation/Math/GaussLegendre.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/Collision.h"

// The exact bridge above 90 degrees between two elastic grains: it pushes near contact (pinned contact lines)
// or does nothing there (in equilibrium), and pulls farther away. While it lasts the pair is an oscillator
// without loss. When it forms and when it ruptures energy changes by its work, by design.

namespace pendular::bridgeEnergyTest {
namespace {

using scenes::Approach;
using scenes::Collision;
using Wet = Species<LinearViscoelastic, NoFriction, LiquidBridgeYoungLaplace>;

constexpr double radius = 1e-3;  // m
constexpr Bodies bodies{radius, radius};

Wet wetElastic(double degrees, double volume, bool pinned) {
    Wet species;
    species.setStiffness(1);  // N/m: so soft that a period is only some ten contact times
    species.setDissipation(0);
    species.setLiquidBridgeVolume(volume * radius * radius * radius);
    species.setContactAngle(degrees * std::numbers::pi / 180);
    species.setSurfaceTension(0.07);
    species.setPinned(pinned);
    return species;
}

/// The force of the bridge and its integral.
class BridgeWork {
public:
    explicit BridgeWork(const Wet& species)
        : bridge(static_cast<const LiquidBridgeYoungLaplace&>(species).prepare(bodies)) {
        double low = 0, high = bridge.range();  // the force of equilibrium is zero up to where the curve is
        while (low < 0.5 * (low + high) && 0.5 * (low + high) < high)
            (bridge.curve.at(0.5 * (low + high)) > 0 ? high : low) = 0.5 * (low + high);
        joint = high;
    }
    [[nodiscard]] double range() const { return bridge.range(); }
    [[nodiscard]] double force(double separation) const { return bridge.force(separation); }
    /// J, from contact to a separation (m).
    [[nodiscard]] double to(double separation) const {
        if (separation <= joint) return integral(0, separation);
        return integral(0, joint) + integral(joint, separation);
    }

private:
    /// A rational function without poles near: 32 nodes are exact to rounding.
    [[nodiscard]] double integral(double from, double to) const {
        double sum = 0;
        for (const auto [position, weight] : gaussLegendre(32))
            sum += weight * bridge.force(from + 0.5 * (to - from) * (1 + position));
        return 0.5 * (to - from) * sum;
    }

    LiquidBridgeYoungLaplace::Interaction<double> bridge;
    double joint;  // m, where the force of pinned contact lines changes its sign
};

constexpr double stepsPerContact = 200;

/// m* v^2 / 2 = energy (J) at the first touch.
Approach approachWith(const Wet& species, double energy) {
    Approach approach{.radius1 = radius, .radius2 = radius};
    const double mass = approach.reducedMass();
    approach.speed = std::sqrt(2 * energy / mass);
    approach.step = std::numbers::pi * std::sqrt(mass / species.getStiffness()) / stepsPerContact;
    return approach;
}

/// What a touch may change of the energy of the pair, as a share of that at contact, E = m* v^2 / 2. The
/// first and the last sample of a touch stand for forces that grow linearly in time (SampleTiming); within
/// their one and a half steps (h = w dt each) the overlap of a linear contact departs from that by up to (1.5
/// h)^2 / 2 of it. Such a sample's impulse is up to k v dt^2 1.5^2 / 2, and its work against E 2.25 h^2: 2.5
/// h^4 at either end. Between them velocity Verlet is symplectic, and its energy at the turning points always
/// differs from the true one by the same.
constexpr double touchError() {
    constexpr double h = std::numbers::pi / stepsPerContact;
    return 5 * h * h * h * h;
}

/// What the bridge's force (N) at contact adds to it at most: the start of a touch is reckoned from the
/// overlap and the speed alone, t' = x / v (in steps), so that with the acceleration a = F / m* it errs by a
/// t^2 dt / (2 v) and the sample's impulse, k v dt^2 (t + 1/2)^2 / 2, by k a dt^3 (t^3 - t/4) / 4, at most
/// 3/16 k a dt^3 (1/32 in the mean over t). Under a push (a < 0) the first sample
/// repels too strongly on the way in, and the energy falls.
double beginError(double force, const Approach& approach) {
    constexpr double h = std::numbers::pi / stepsPerContact;
    return 0.375 * h * h * std::abs(force) * approach.step / (approach.reducedMass() * approach.speed);
}

/// What is seen of many periods at their turning points, where the grains are farthest apart.
struct Oscillation {
    int periods = 0;
    double first = 0, last = 0, highest = 0;  // J, energy

    [[nodiscard]] double change() const { return last / first - 1; }
    [[nodiscard]] double largestGain() const { return highest / first - 1; }
};

Oscillation oscillate(const Wet& species, double energy, int periods) {
    const BridgeWork work(species);
    Collision<Wet> pair(species, approachWith(species, energy));
    const double mass = pair.scene.reducedMass();
    Oscillation seen;
    double speed = -1;
    const long mostSteps = 5000L * periods;
    for (long step = 0; seen.periods < periods && step < mostSteps; ++step) {
        pair.step();
        const double before = std::exchange(speed, pair.partingSpeed());
        if (!(before > 0 && speed <= 0)) continue;
        seen.last = 0.5 * mass * speed * speed + work.to(pair.separation());
        if (seen.periods++ == 0) seen.first = seen.last;
        seen.highest = std::max(seen.highest, seen.last);
    }
    return seen;
}

constexpr int periods = 10000;

TEST(HeavyBridgeEnergy, aPairInEquilibriumKeepsItsEnergyAboveRightAngle) {
    for (const auto& [degrees, volume] : {std::pair{95.0, 0.1}, {110.0, 0.5}}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, V* = " << volume);
        const Wet species = wetElastic(degrees, volume, false);
        const BridgeWork work(species);
        EXPECT_EQ(work.force(0), 0);
        const Oscillation seen = oscillate(species, 0.3 * work.to(work.range()), periods);
        EXPECT_EQ(seen.periods, periods);
        EXPECT_LT(seen.largestGain(), periods * touchError());
        EXPECT_GT(seen.change(), -periods * touchError());
    }
}

TEST(HeavyBridgeEnergy, aPinnedPairGainsNoneAboveRightAngle) {
    for (const auto& [degrees, volume] : {std::pair{91.0, 0.1}, {95.0, 0.01}}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, V* = " << volume);
        const Wet species = wetElastic(degrees, volume, true);
        const BridgeWork work(species);
        ASSERT_LT(work.force(0), 0);
        const double energy = 0.3 * work.to(work.range());
        const Oscillation seen = oscillate(species, energy, periods);
        EXPECT_EQ(seen.periods, periods);
        EXPECT_LT(seen.largestGain(), periods * touchError());
        EXPECT_GT(seen.change(),
                  -periods * (touchError() + beginError(work.force(0), approachWith(species, energy))));
        RecordProperty("change", fmt::format("{:.2g}", seen.change()));
    }
}

// A free collision: the bridge forms at the touch with the force that it has there, and takes with it at the
// rupture what it then holds. In equilibrium that is never negative, so that collisions only lose. A bridge
// with pinned contact lines that pushes more than it pulls gives its work to the grains in every collision:
// by design, and only where grains come together again.
TEST(BridgeEnergy, aCollisionLosesTheWorkOfTheBridge) {
    for (const bool pinned : {false, true})
        for (const double degrees : {30.0, 95.0, 120.0, 150.0}) {
            SCOPED_TRACE(testing::Message() << degrees << " degrees" << (pinned ? ", pinned" : ""));
            Wet species = wetElastic(degrees, 0.1, pinned);
            species.setStiffness(100);
            const BridgeWork work(species);
            const double rupture = work.range(), lost = work.to(rupture);
            EXPECT_EQ(lost < 0, pinned && degrees >= 120);
            const double energy = 3 * std::max(std::abs(lost), 1e-9);
            Collision<Wet> pair(species, approachWith(species, energy));
            for (int step = 0; step < 100000 && pair.separation() < rupture; ++step) pair.step();
            ASSERT_GE(pair.separation(), rupture);
            const double after = 0.5 * pair.scene.reducedMass() * pair.partingSpeed() * pair.partingSpeed();
            // The force begins and ends within a step but acts in whole ones.
            const double tolerance = 0.5 * pair.scene.step *
                                         (std::abs(work.force(0)) * pair.scene.speed +
                                          work.force(std::nextafter(rupture, 0)) * pair.partingSpeed()) +
                                     energy * (touchError() + beginError(work.force(0), pair.scene));
            EXPECT_NEAR(after, energy - lost, tolerance);
            EXPECT_LT(tolerance, 0.1 * std::abs(lost));
        }
}

}  // namespace
}  // namespace pendular::bridgeEnergyTest
