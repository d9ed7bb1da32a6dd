// Planes that count in shear and strain; the oracles are straight ways, and images that are looked for one by
// one.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fluxTest {
namespace {

using Smooth = Species<LinearViscoelastic>;
using scenes::GrainMotion;

constexpr double side = 0x1p-6;         // m
constexpr double r = 1e-5;              // m, so that grains do not meet
constexpr double stepLength = 0x1p-18;  // s
constexpr double rate = 40;             // 1/s

Smooth softMaterial() {
    Smooth species;
    species.setDensity(2500);
    species.setStiffness(1e-3);
    species.setDissipation(0);
    return species;
}

class Flying : public scenes::FewGrains<Smooth> {
public:
    explicit Flying(const std::vector<GrainMotion>& grains)
        : FewGrains<Smooth>(softMaterial(), grains, stepLength) {
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, side);
        setQuiet();
        setTimeMax(10);
    }
    std::size_t addPlane(const Vec3D& normal, const Vec3D& point) {
        return fluxPlaneHandler.copyAndAddObject(FluxPlane{normal, point});
    }
    [[nodiscard]] const FluxCount& at(std::size_t plane) const { return fluxPlaneHandler.countOf(plane); }
};

/// Grains with their own velocities on top of the shear.
std::vector<GrainMotion> someGrains(int count, double speed) {
    support::Random random(11);
    std::vector<GrainMotion> grains;
    for (int k = 0; k < count; ++k) {
        const Vec3D place = Vec3D::Constant(side / 2) + random.inCube(0.49 * side);
        const Vec3D flow(rate * (place.y() - side / 2), 0, 0);
        grains.push_back({.radius = r, .position = place, .velocity = flow + random.inCube(speed)});
    }
    return grains;
}

/// The grains at rest against the flow: one-sided n gamma H^2 / 8 for each area, and nothing net.
TEST(FluxInShear, ofAFlowWithoutMotionOfItsOwnIsOneSidedAndNetNone) {
    constexpr int count = 20;
    std::vector<GrainMotion> grains;
    for (int k = 0; k < count; ++k) {
        const double y = side * (k + 0.5) / count;
        grains.push_back({.radius = r,
                          .position = {side * (0.05 + 0.9 * k / count), y, side / 2},
                          .velocity = {rate * (y - side / 2), 0, 0}});
    }
    Flying scene(grains);
    scene.setLeesEdwards(0, 1, rate);
    const double at = 0.3 * side;
    const std::size_t plane = scene.addPlane({1, 0, 0}, {at, 0, 0}),
                      opposite = scene.addPlane({-1, 0, 0}, {at, 0, 0}),
                      alongShear = scene.addPlane({0, 1, 0}, {0, 0.21 * side, 0}),
                      across = scene.addPlane({0, 0, 1}, {0, 0, 0.1 * side});
    scene.initialise();
    constexpr int steps = 100000;
    scene.step(steps);
    double forwards = 0, backwards = 0, momentum = 0;
    const double mass = scene.particleHandler.getObject(0).getMass();
    for (const GrainMotion& grain : grains) {
        const double from = (grain.position.x() - at) / side,
                     times =
                         std::floor(from + grain.velocity.x() * steps * stepLength / side) - std::floor(from);
        (times > 0 ? forwards : backwards) += std::abs(times);
        momentum += std::max(times, 0.0) * mass * grain.velocity.x();
    }
    EXPECT_GT(forwards, 20);
    const FluxCount& found = scene.at(plane);
    EXPECT_EQ(found.forwards, forwards);
    EXPECT_EQ(found.backwards, backwards);
    EXPECT_NEAR(found.massForwards, forwards * mass, 1e-12 * forwards * mass);
    // A way in a step is rounded to 1e-16 of its place, which is up to 40 periods from the origin.
    EXPECT_NEAR(found.momentumForwards.x, momentum, 1e-8 * momentum);
    EXPECT_EQ(scene.at(opposite).forwards, backwards);
    EXPECT_EQ(scene.at(opposite).backwards, forwards);
    // n gamma H^2 / 8 times the width, of count grains in the box; each grain's count is right to 1.
    const double expected = count * rate / 8 * steps * stepLength;
    EXPECT_NEAR(forwards, expected, 0.5 * count);
    EXPECT_NEAR(backwards, expected, 0.5 * count);
    for (const std::size_t none : {alongShear, across}) {
        EXPECT_EQ(scene.at(none).forwards, 0u);
        EXPECT_EQ(scene.at(none).backwards, 0u);
    }
}

/// What goes through a plane across the flow, from one face along the gradient to the next.
struct Expected {
    double forwards = 0, backwards = 0;
    Vec3D momentum = Vec3D::Zero();  // kg m/s, forwards

    void add(double times, const Vec3D& each) {
        (times > 0 ? forwards : backwards) += std::abs(times);
        momentum += std::max(times, 0.0) * each;
    }
};

double faceTime(const GrainMotion& grain, double image) {
    return (image * side - grain.position.y()) / grain.velocity.y();
}

/// A way that is straight in space is cut into pieces at the faces along the gradient.
Expected acrossFlow(const std::vector<GrainMotion>& grains, double mass, double at, double end) {
    Expected sum;
    for (const GrainMotion& grain : grains) {
        const double vy = grain.velocity.y(), direction = vy > 0 ? 1 : -1;
        double now = 0, image = 0;
        while (now < end) {
            const double next = std::min(end, faceTime(grain, vy > 0 ? image + 1 : image));
            const auto behind = [&](double time) {
                const double x = grain.position.x() + grain.velocity.x() * time - image * rate * side * time;
                return std::floor((x - at) / side);
            };
            sum.add(behind(next) - behind(now), mass * (grain.velocity - Vec3D(image * rate * side, 0, 0)));
            now = next;
            image += direction;
        }
    }
    return sum;
}

/// Across an axis other than the flow; images are numbered along the gradient.
Expected acrossOther(const std::vector<GrainMotion>& grains, double mass, int axis, double at, double end) {
    Expected sum;
    for (const GrainMotion& grain : grains) {
        const double x = grain.position[axis], v = grain.velocity[axis];
        const double first = std::floor((x - at) / side), last = std::floor((x + v * end - at) / side);
        for (double k = first; k != last; k += last > first ? 1 : -1) {
            const double plane = last > first ? k + 1 : k, time = (at + plane * side - x) / v;
            const double image =
                axis == 1 ? plane : std::floor((grain.position.y() + grain.velocity.y() * time) / side);
            sum.add(last > first ? 1 : -1, mass * (grain.velocity - Vec3D(image * rate * side, 0, 0)));
        }
    }
    return sum;
}

void expectAlike(const FluxCount& found, const Expected& expected) {
    EXPECT_GT(expected.forwards, 20);
    EXPECT_EQ(found.forwards, expected.forwards);
    EXPECT_EQ(found.backwards, expected.backwards);
    EXPECT_LT((toEigen(found.momentumForwards) - expected.momentum).norm(), 1e-8 * expected.momentum.norm());
}

TEST(FluxInShear, ofGrainsThatGoThroughAllFacesIsThatOfTheirStraightWays) {
    const std::vector<GrainMotion> grains = someGrains(60, 0.6);
    Flying scene(grains);
    scene.setLeesEdwards(0, 1, rate);
    const double inside = 0.37 * side, outside = -1.3 * side;
    for (const double at : {inside, outside})
        for (int axis = 0; axis < 3; ++axis) scene.addPlane(Vec3D::Unit(axis), at * Vec3D::Unit(axis));
    scene.setTimeStep(stepLength / 2);  // against the flow they become faster with each face
    scene.initialise();
    constexpr int steps = 50000;
    scene.step(steps);
    const double end = scene.getTime(), mass = scene.particleHandler.getObject(0).getMass();
    std::size_t plane = 0;
    for (const double at : {inside, outside}) {
        expectAlike(scene.at(plane++), acrossFlow(grains, mass, at, end));
        expectAlike(scene.at(plane++), acrossOther(grains, mass, 1, at, end));
        expectAlike(scene.at(plane++), acrossOther(grains, mass, 2, at, end));
    }
}

/// The images in the box, from step to step, with shear whose rate changes and strain along the other axes.
TEST(FluxInShearAndStrain, ofChangingRatesIsThatOfTheImagesInTheBox) {
    Flying scene(someGrains(40, 0.6));
    scene.setLeesEdwards(0, 1, rate);
    scene.setStrainRate(1, 3);
    scene.setStrainRate(2, -2);
    const double at = 0.37 * side;
    const std::size_t plane = scene.addPlane({1, 0, 0}, {at, 0, 0});
    scene.initialise();
    std::uint64_t forwards = 0, backwards = 0;
    std::vector<Vector<double>> before(40);
    const auto places = [&](std::vector<Vector<double>>& all) {
        for (std::size_t k = 0; k < 40; ++k)
            all[k] = scene.getPeriodicBox().wrap(
                toVector(scene.particleHandler.getObject(static_cast<std::uint32_t>(k)).getPosition()));
    };
    places(before);
    std::vector<Vector<double>> now(40);
    for (int k = 0; k < 30000; ++k) {
        if (k == 12000) scene.setShearRate(0);  // the images stay where they are
        if (k == 18000) scene.setShearRate(-rate);
        scene.step();
        places(now);
        for (std::size_t g = 0; g < now.size(); ++g) {
            const bool wentAcross = std::abs(now[g].y - before[g].y) > side / 2;
            // Its way is 1e-4 of the period: it is not at the plane and the face in the same step.
            if (wentAcross) continue;
            const auto past = [&](double x) { return x >= at ? 1 : 0; };
            if (std::abs(now[g].x - before[g].x) > side / 2) continue;  // brought back along the flow
            forwards += past(now[g].x) > past(before[g].x) ? 1 : 0;
            backwards += past(now[g].x) < past(before[g].x) ? 1 : 0;
        }
        before = now;
    }
    EXPECT_GT(forwards, 20u);
    EXPECT_EQ(scene.at(plane).forwards, forwards);
    EXPECT_EQ(scene.at(plane).backwards, backwards);
}

/// Grains that rest in a flow that widens: the images that have passed the plane are counted.
TEST(FluxInStrain, isWhatTheFlowCarriesThroughThePlane) {
    constexpr double strain = 8, middle = side / 2, at = 0.85 * side;
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 40; ++k)
        grains.push_back({.radius = r, .position = {side * (k + 0.4) / 40, side * (k + 0.5) / 40, side / 2}});
    Flying scene(grains);
    scene.setStrainRate(0, strain);
    const std::size_t plane = scene.addPlane({1, 0, 0}, {at, 0, 0}),
                      behind = scene.addPlane({1, 0, 0}, {0.2 * side, 0, 0}),
                      across = scene.addPlane({0, 1, 0}, {0, at, 0});
    scene.initialise();
    constexpr int steps = 50000;
    scene.step(steps);
    const double grown = std::exp(strain * steps * stepLength);
    std::uint64_t expected = 0, expectedBehind = 0;
    for (const GrainMotion& grain : grains)
        for (int image = -20; image <= 20; ++image) {
            const double from = grain.position.x() + image * side - middle;
            expected += from < at - middle && from * grown >= at - middle ? 1 : 0;
            expectedBehind += from >= 0.2 * side - middle && from * grown < 0.2 * side - middle ? 1 : 0;
        }
    EXPECT_GT(expected, 5u);
    EXPECT_EQ(scene.at(plane).forwards, expected);
    EXPECT_EQ(scene.at(plane).backwards, 0u);
    EXPECT_EQ(scene.at(behind).backwards, expectedBehind);
    EXPECT_EQ(scene.at(behind).forwards, 0u);
    EXPECT_EQ(scene.at(across).forwards + scene.at(across).backwards, 0u);
    // Each goes through at the velocity of the flow there; a step is as much longer than the flow is there.
    const double mass = scene.particleHandler.getObject(0).getMass(),
                 momentum = static_cast<double>(expected) * mass * strain * (at - middle);
    EXPECT_NEAR(scene.at(plane).momentumForwards.x, momentum, 2 * strain * stepLength * momentum);
}

TEST(FluxInShear, goesOnFromARestartFile) {
    const support::TestFolder folder;
    const auto make = [](Flying& scene) {
        scene.setLeesEdwards(0, 1, rate);
        scene.setStrainRate(2, -2);
        for (int axis = 0; axis < 3; ++axis)
            scene.addPlane(Vec3D::Unit(axis), 0.37 * side * Vec3D::Unit(axis));
    };
    const std::vector<GrainMotion> grains = someGrains(60, 0.6);
    Flying whole(grains), resumed(grains);
    make(whole), make(resumed);
    whole.initialise();
    whole.step(5003);
    whole.writeRestart(folder.path() / "flux.h5");
    resumed.restartFrom(folder.path() / "flux.h5");
    resumed.setNumberOfThreads(3);
    resumed.initialise();
    whole.step(5000), resumed.step(5000);
    for (std::size_t plane = 0; plane < 3; ++plane) {
        EXPECT_GT(whole.at(plane).forwards, 5u);
        EXPECT_EQ(resumed.at(plane).forwards, whole.at(plane).forwards);
        EXPECT_EQ(resumed.at(plane).backwards, whole.at(plane).backwards);
        EXPECT_EQ(resumed.at(plane).momentumForwards, whole.at(plane).momentumForwards);
    }
}

}  // namespace
}  // namespace pendular::fluxTest
