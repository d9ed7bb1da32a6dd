#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/ContactKey.h"
#include "SelfTests/Support/Random.h"

namespace pendular::manySizesTest {
namespace {

using support::ContactKey;
using support::Random;
using Rough = Species<HertzianViscoelastic, Mindlin>;

constexpr double small = 0.5e-3, large = 25e-3;  // m: 1 to 50
constexpr double modulus = 1e7;                  // E*, Pa

/// Grains of two sizes, 1 to 50, in a box with smooth sides: a layer of small ones, and a large one that
/// comes down on them. It is light, so that dashpots made for small masses bring it to rest within the test's
/// time.
class LargeOnSmall : public Simulation<Rough> {
public:
    static constexpr int edge = 52;                  // 52.5 mm, wider than the large grain
    static constexpr double spacing = 2.02 * small;  // so close that they cannot make room

    LargeOnSmall() {
        Rough species;
        species.setDensity(2500);
        species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, 0.1);
        species.setEffectiveShearModulus(0.3 * modulus);
        species.setSlidingFrictionCoefficient(0.5);
        const Rough* added = speciesHandler.copyAndAddObject(species);
        Random random(1);
        SphericalParticle grain;
        grain.setSpecies(added);
        grain.setRadius(small);
        for (int k = 0; k < edge * edge; ++k) {
            grain.setPosition(Vec3D(spacing * (k % edge + 0.5), spacing * (k / edge + 0.5), 1.02 * small) +
                              small * random.inCube(1).cwiseProduct(Vec3D(0.01, 0.01, 0.02)));
            grain.setVelocity(random.inCube(0.02));
            particleHandler.copyAndAddObject(grain);
        }
        species.setDensity(50);
        grain.setSpecies(speciesHandler.copyAndAddObject(species));
        grain.setRadius(large);
        grain.setPosition({0.5 * length, 0.5 * length, 2.05 * small + large});
        grain.setVelocity({0, 0, 0});
        particleHandler.copyAndAddObject(grain);
        species.setSlidingFrictionCoefficient(0);
        const Rough* smooth = speciesHandler.copyAndAddObject(species);
        addWall({0, 0, -1}, {0, 0, 0}, added);
        for (int axis : {0, 1}) {
            addWall(-Vec3D::Unit(axis), {0, 0, 0}, smooth);
            addWall(Vec3D::Unit(axis), length * Vec3D::Unit(axis), smooth);
        }
        setGravity({0, 0, -9.81});
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 10));
    }
    static constexpr double length = edge * spacing;

    [[nodiscard]] double kineticEnergy() {
        double sum = 0;
        forEachGrain([&](const auto& grain) {
            sum += 0.5 * grain.getMass() *
                   (grain.getVelocity().squaredNorm() +
                    0.4 * std::pow(grain.getRadius(), 2) * grain.getAngularVelocity().squaredNorm());
        });
        return sum;
    }
    [[nodiscard]] double weight() {
        double sum = 0;
        forEachGrain([&](const auto& grain) { sum += 9.81 * grain.getMass(); });
        return sum;
    }
    void addWall(const Vec3D& normal, const Vec3D& point, const Rough* species) {
        InfiniteWall wall;
        wall.set(normal, point);
        wall.setSpecies(species);
        wallHandler.copyAndAddObject(wall);
    }
    template <class Function>
    void forEachGrain(Function&& function) {
        for (std::size_t k = 0; k < particleHandler.getSize(); ++k) function(particleHandler.getObject(k));
    }
};

/// The overlap (m) at which Hertz's force is the one given (N).
double hertzOverlap(double force, double effectiveRadius) {
    return std::pow(0.75 * force / (modulus * std::sqrt(effectiveRadius)), 2.0 / 3.0);
}

TEST(LongManySizes, aLargeGrainComesToRestOnSmallOnes) {
    LargeOnSmall scene;
    scene.initialise();
    const auto& grains = scene.particleHandler.store();
    double kinetic = 0;
    for (int n = 0; scene.getTime() < 0.12; ++n) {
        scene.step();
        if (n % 100 == 0) kinetic = std::max(kinetic, scene.kineticEnergy());
    }
    EXPECT_LT(scene.kineticEnergy(), 0.01 * kinetic);
    EXPECT_LT(scene.kineticEnergy(), 1e-3 * small * scene.weight());  // it could not rise by a thousandth

    // The floor carries all the weight, except for what still moves; and no grain's share is more than all of
    // it.
    const double weight = scene.weight();
    double moving = 0, onFloor = 0, deepest = 0;
    scene.forEachGrain([&](const auto& grain) { moving += grain.getForce().norm(); });
    std::set<ContactKey> touching;
    const std::uint32_t big = LargeOnSmall::edge * LargeOnSmall::edge;
    double lowestShare = 1, carried = 0;  // the large grain's contacts: vertical part of the normal
    double deepestUnderLarge = 0;
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const auto seen = scene.contacts().observe(grains, bucket, contact);
        if (seen.separation >= 0) return;
        deepest = std::max(deepest, -seen.separation);
        if (bucket.wall > 0) return;
        if (bucket.wall == 0) {
            onFloor += seen.normalForce;
            EXPECT_LE(-seen.separation, hertzOverlap(weight, small));
            return;
        }
        touching.insert(support::keyOf(scene.contacts().store(), grains.identity, bucket, contact));
        if (std::max(seen.particle1, seen.particle2) != big) return;
        const auto& one = grains.translation[grains.place[std::min(seen.particle1, seen.particle2)]].position;
        const Vector<double> shift = grains.translation[grains.place[big]].position - one;
        lowestShare = std::min(lowestShare, shift.z / norm(shift));
        deepestUnderLarge = std::max(deepestUnderLarge, -seen.separation);
        carried += 1;
    });
    EXPECT_NEAR(onFloor, weight, moving);
    // All small grains lie below the large one's centre and push it up: none with more than its weight over
    // the vertical part of the flattest normal, except for friction, which helps with up to half of the
    // normal force.
    EXPECT_GT(carried, 3);
    ASSERT_GT(lowestShare, 0.5);
    const double sideways = 0.5 * std::sqrt(1 - lowestShare * lowestShare);
    EXPECT_LE(deepestUnderLarge,
              hertzOverlap((weight + moving) / (lowestShare - sideways), small * large / (small + large)));
    EXPECT_LT(deepest, largestSoundOverlap * small);

    std::set<ContactKey> expected;
    for (std::uint32_t i = 0; i < grains.size(); ++i)
        for (std::uint32_t j = 0; j < i; ++j) {
            const TranslationRecord &a = grains.translation[i], &b = grains.translation[j];
            if (norm(a.position - b.position) - (a.radius + b.radius) < 0)
                expected.emplace(-1, std::min(grains.identity[i], grains.identity[j]),
                                 std::max(grains.identity[i], grains.identity[j]));
        }
    EXPECT_EQ(touching, expected);
}

/// A cloud that expands evenly from its middle (v = H x) under gravity: nobody ever meets anybody, and all
/// paths are parabolas, which velocity Verlet steps through exactly. Each step rounds the position and what
/// is added to it, half an ulp each, that is epsilon of the largest position or way.
TEST(HeavyFreeFlight, ofAMillionGrainsIsAMillionParabolas) {
    constexpr int edge = 100, steps = 10;
    constexpr double spacing = 4e-3, rate = 10, step = 1e-4;  // m, 1/s, s
    Simulation<Species<HertzianViscoelastic>> scene;
    Species<HertzianViscoelastic> species;
    species.setDensity(2000);
    species.setEffectiveElasticModulus(1e6);
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.copyAndAddObject(species));
    grain.setRadius(1e-3);
    const auto start = [=](int k) {
        return Vec3D(spacing * Vec3D(k % edge - 50, k / edge % edge - 50, k / (edge * edge) - 50));
    };
    for (int k = 0; k < edge * edge * edge; ++k) {
        grain.setPosition(start(k));
        grain.setVelocity(rate * start(k));
        scene.particleHandler.copyAndAddObject(grain);
    }
    const Vec3D gravity(1, -2, -9.81);
    scene.setGravity(gravity);
    scene.setTimeStep(step);
    scene.initialise();
    for (int n = 0; n < steps; ++n) scene.step();
    const double time = steps * step;
    double place = 0, speed = 0;
    for (int k = 0; k < edge * edge * edge; ++k) {
        const auto now = scene.particleHandler.getObject(static_cast<std::size_t>(k));
        const Vec3D x = start(k), v = rate * x;
        place = std::max(place, (now.getPosition() - (x + time * v + 0.5 * time * time * gravity)).norm());
        speed = std::max(speed, (now.getVelocity() - (v + time * gravity)).norm());
    }
    const double epsilon = std::numeric_limits<double>::epsilon(), farthest = 0.36 * (1 + rate * time);
    EXPECT_LT(place, steps * 2 * epsilon * farthest);
    EXPECT_LT(speed, steps * 2 * epsilon * rate * farthest);
    EXPECT_GT(scene.contacts().rebuildCount(), 1u);
}

}  // namespace
}  // namespace pendular::manySizesTest
