#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"

namespace pendular::sceneTest {
namespace {

using scenes::boxMaterial;
using support::Random;

using Smooth = Species<LinearViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Grains of two species on a cubic lattice, shaken from their places, in a scene that repeats itself along
/// some axes.
template <class S>
class ShakenLattice : public Simulation<S> {
public:
    struct Shape {
        int edge = 6;                                   // grains
        double spacing = 2e-3;                          // m
        double smallest = 0.99e-3, largest = 1.015e-3;  // m, radii
        double shake = 8e-6;                            // m, along each axis
        double speed = 0.1;                             // m/s, along each axis
        double step = 0x1p-20;                          // s
    };

    /// @param axes that repeat themselves, one bit each
    /// @param shift of all grains, in periods along these axes
    explicit ShakenLattice(const Shape& shape, int axes, double shift = 0,
                           std::array<S, 2> materials = {boxMaterial<S>(0), boxMaterial<S>(1)})
        : length(shape.edge * shape.spacing) {
        for (const S& material : materials) this->speciesHandler.copyAndAddObject(material);
        Random random(3);
        const auto moved = [&](int axis, double x) {
            if ((axes >> axis & 1) == 0) return x;
            const double y = x + shift * length;
            return y < length ? y : y - length;
        };
        for (int k = 0; k < shape.edge * shape.edge * shape.edge; ++k) {
            const Vec3D site(k % shape.edge + 0.5, k / shape.edge % shape.edge + 0.5,
                             k / (shape.edge * shape.edge) + 0.5);
            const Vec3D place = shape.spacing * site + random.inCube(shape.shake);
            SphericalParticle grain;
            grain.setSpecies(this->speciesHandler.getObject(k % 3 == 2 ? 1 : 0));
            grain.setRadius(random.uniform(shape.smallest, shape.largest));
            grain.setPosition({moved(0, place.x()), moved(1, place.y()), moved(2, place.z())});
            grain.setVelocity(random.inCube(shape.speed));
            grain.setAngularVelocity(random.inCube(50));
            this->particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3; ++axis)
            if ((axes >> axis & 1) != 0) this->setPeriodic(axis, 0, length);
        this->setTimeStep(shape.step);
    }

    const double length;  // m
};

/// What the contacts of a scene do.
struct ContactSums {
    double force = 0;                 // N, of the sizes of the forces
    double slopes = 0;                // N/m, of force / overlap (or separation)
    int touching = 0, stretched = 0;  // contacts
};

ContactSums contactSums(const Scene& scene) {
    ContactSums sums;
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const auto seen = scene.contacts().observe(scene.particleHandler.store(), bucket, contact);
        const double force = norm(scene.contacts().forceOf(contact));
        sums.force += force;
        if (force > 0) sums.slopes += force / std::abs(seen.separation);
        (seen.separation < 0 ? sums.touching : sums.stretched) += seen.separation < 0 || seen.bridged ? 1 : 0;
    });
    return sums;
}

/// The largest difference (N) of the forces on a grain in two scenes.
double largestDifference(Scene& a, Scene& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.particleHandler.getSize(); ++k) {
        auto one = a.particleHandler.getObject(k), other = b.particleHandler.getObject(k);
        largest = std::max(largest, (one.getForce() - other.getForce()).norm());
        if (a.particleHandler.store().hasSpin) {
            const auto spinUp = [k](Scene& scene) {
                const auto& grains = scene.particleHandler.store();
                return grains.rotation[grains.place[k]].angularAcceleration;
            };
            const double lever = 0.4 * one.getMass() * one.getRadius();  // torque / radius for a spin-up
            largest = std::max(largest, lever * norm(spinUp(a) - spinUp(b)));
        }
    }
    return largest;
}

template <class S>
class PeriodicScene : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet>;
TYPED_TEST_SUITE(PeriodicScene, SpeciesOfAllKinds);

/// A scene and its copy shifted by half a period along each axis that repeats itself give the same forces.
/// Tolerance: a coordinate is rounded to epsilon x length in the shift and in each step; with both grains of
/// a contact, two numbers for each, the overlap is known to 4 (n + 1) epsilon x length after n steps. Its
/// share of the overlap is the relative error of the contact's force, except for the power of the law (3/2)
/// and the sum over elastic, damping and tangential parts (3).
TYPED_TEST(PeriodicScene, shiftedByHalfAPeriodHasTheSameForces) {
    for (int axes = 1; axes < 8; ++axes) {
        SCOPED_TRACE(fmt::format("axes {:03b}", axes));
        ShakenLattice<TypeParam> scene({}, axes), shifted({}, axes, 0.5);
        scene.initialise();
        shifted.initialise();
        for (int n = 0; n <= 60; ++n) {
            const ContactSums sums = contactSums(scene);
            const double overlapError = 4 * (n + 1) * epsilon * scene.length;
            const double tolerance = 4.5 * overlapError * sums.slopes;
            ASSERT_LE(largestDifference(scene, shifted), tolerance) << "step " << n;
            // A contact that is missed or counted twice would be seen.
            ASSERT_LT(tolerance, 1e-4 * sums.force / sums.touching);
            EXPECT_GT(sums.touching, 200);
            scene.step();
            shifted.step();
        }
        if (TypeParam::Adhesion::acts) {
            EXPECT_GT(contactSums(scene).stretched, 10);
        }
    }
}

/// Forces are pairs of opposite ones. What rounding leaves: each grain's sum of some ten forces, and its
/// velocity.
TYPED_TEST(PeriodicScene, keepsItsMomentum) {
    ShakenLattice<TypeParam> scene({.speed = 1}, 7);
    const Vec3D gravity(0, 1, -9.81);
    scene.setGravity(gravity);
    scene.initialise();
    Vec3D before = Vec3D::Zero();
    double mass = 0, scale = 0;
    const auto forEachGrain = [&](auto&& function) {
        for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k)
            function(scene.particleHandler.getObject(k));
    };
    forEachGrain([&](const auto& grain) {
        before += grain.getMass() * grain.getVelocity();
        mass += grain.getMass();
    });
    constexpr int steps = 1000;
    double impulses = 0;
    for (int n = 0; n < steps; ++n) {
        scene.step();
        forEachGrain([&](const auto& grain) {
            scale += epsilon * grain.getMass() * grain.getVelocity().norm();
            impulses += scene.getTimeStep() * grain.getForce().norm();
        });
    }
    Vec3D after = Vec3D::Zero();
    forEachGrain([&](const auto& grain) { after += grain.getMass() * grain.getVelocity(); });
    EXPECT_LT((after - before - scene.getTime() * mass * gravity).norm(), scale + 10 * epsilon * impulses);
    EXPECT_GT(impulses, 10 * mass * gravity.norm() * scene.getTime());  // contacts matter
    EXPECT_GT(scene.contacts().rebuildCount(), 3u);
}

/// Elastic grains in a scene that repeats itself along three axes. A collision keeps its energy except for
/// the errors of its first and last step, (w dt)^3 / 12 of the speed each (see DryCollisionTest), w = pi /
/// t_c; and while grains touch, velocity Verlet counts the stored energy as 1 - (w dt)^2/4 of what it is. The
/// energy in a collision is k T = 2/3 of the kinetic energy of a grain on average in a gas in equilibrium;
/// twice that for one that comes from another distribution.
void expectEnergyIsKept(const Vec3D& gravity) {
    Smooth material = boxMaterial<Smooth>(0);
    material.setStiffness(3e4);
    material.setDissipation(0);
    const double mass = sphereMass(1e-3, material.getDensity());
    constexpr double stepsPerContact = 60;
    const double contactTime = linearContactTime(3e4, 0, 0.5 * mass);
    ShakenLattice<Smooth> gas({.edge = 5,
                               .spacing = 3e-3,
                               .smallest = 1e-3,
                               .largest = 1e-3,
                               .shake = 4e-4,
                               .speed = 1,
                               .step = contactTime / stepsPerContact},
                              7, 0, {material, material});
    gas.setGravity(gravity);
    gas.keepEnergyLedger();
    gas.initialise();
    const double total = gas.energyLedger().total(), energy = gas.energyLedger().kinetic;
    const double grains = static_cast<double>(gas.particleHandler.getSize());
    double collisions = 0, inContact = 0;
    for (int n = 0; n < 8000; ++n) {
        gas.step();
        const ContactSums sums = contactSums(gas);
        collisions += std::max(0.0, sums.touching - inContact);
        inContact = sums.touching;
    }
    const double frequency = std::numbers::pi / stepsPerContact;  // w dt
    const double perCollision = 2 * std::pow(frequency, 3) / 6 * 2 * (2.0 / 3.0) * energy / grains;
    const double now = std::pow(frequency, 2) / 4 * gas.energyLedger().elastic;
    EXPECT_GT(collisions, 2 * grains);
    EXPECT_EQ(gas.energyLedger().lost(), 0);
    EXPECT_NEAR(gas.energyLedger().total(), total, collisions * perCollision + now);
    EXPECT_LT(collisions * perCollision, 1e-3 * energy);
}

TEST(PeriodicGas, keepsItsEnergy) { expectEnergyIsKept({0, 0, 0}); }
/// What falls round and round gains what the field gives it.
TEST(PeriodicGas, keepsItsEnergyInAFieldOfGravity) { expectEnergyIsKept({1, 3, -9.81}); }

}  // namespace
}  // namespace pendular::sceneTest
