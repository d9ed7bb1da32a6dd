#include <gtest/gtest.h>

#include <functional>

#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::refusedChangesTest {
namespace {

using S = HertzianViscoelasticMindlinSpecies;
using scenes::GrainMotion;
using Scene = scenes::HookedGrains<S>;
using Change = std::function<void(Scene&, double)>;  // with a number between 0 and 1

constexpr double radius = 1e-3;  // m

S material() {
    S species;
    species.setDensity(2500);
    species.setElasticModulusAndPoissonRatio(5e6, 0.25);
    species.setEffectiveShearModulus(computeEffectiveShearModulus(5e6, 0.25));
    species.setRestitutionCoefficient(0.6);
    species.setSlidingFrictionCoefficient(0.4);
    species.setSlidingDissipation(0.1);
    return species;
}

std::vector<GrainMotion> layers() {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 18; ++k)
        grains.push_back({.radius = radius,
                          .position = {2.05e-3 * (k % 3), 2.05e-3 * (k / 3 % 3), 1.05e-3 + 2.1e-3 * (k / 9)},
                          .velocity = {0.05 * (k % 2), 0.02 * (k % 5) - 0.04, -0.2}});
    return grains;
}

/// Grains that fall on a floor.
struct Falling : Scene {
    Falling() : HookedGrains(material(), layers(), 2e-6, {{{0, 0, -1}, {0, 0, 0}}}) {
        setQuiet();
        keepEnergyLedger();
        setGravity({0, 0, -9.81});
    }
};

/// The same grains without a floor, in a box that is strained and sheared.
struct Strained : Scene {
    Strained() : HookedGrains(material(), layers(), 2e-6) {
        setQuiet();
        keepEnergyLedger();
        setPeriodic(0, -1e-3, 6e-3), setPeriodic(1, -1e-3, 6e-3), setPeriodic(2, 0, 5e-3);
        setLeesEdwards(0, 1, 5);
        setStrainRate(2, -2);
    }
};

const std::vector<Change> accepted{
    [](Scene& s, double x) {
        s.particleHandler.getObject(3).setVelocity({x, -x, 0.1});
    },
    [](Scene& s, double x) {
        s.particleHandler.getObject(5).setAngularVelocity({0, 20 * x, 0});
    },
    [](Scene& s, double x) { s.particleHandler.getObject(7).setRadius(radius * (0.99 + 0.01 * x)); },
    [](Scene& s, double x) { s.speciesHandler.getObject(0)->setSlidingFrictionCoefficient(0.2 + x); },
    [](Scene& s, double x) { s.setTimeStep(1e-6 * (1 + x)); },
};

/// What is refused at once, in any run.
const std::vector<Change> refused{
    [](Scene& s, double) {
        s.setGravity({0, 0, NAN});
    },
    [](Scene& s, double x) { s.particleHandler.getObject(3).setRadius(-x); },
    [](Scene& s, double) {
        s.particleHandler.getObject(4).setPosition({NAN, 0, 0});
    },
    [](Scene& s, double) {
        s.particleHandler.getObject(4).setVelocity({0, INFINITY, 0});
    },
    [](Scene& s, double x) { s.setTimeStep(-x); },
    [](Scene& s, double) { s.setTimeMax(NAN); },
    [](Scene& s, double) { s.setPeriodic(0, 0, 1); },
    [](Scene& s, double) { s.setLeesEdwards(0, 1, 1); },
    [](Scene& s, double) { s.setIntegrator(integrators::velocityVerlet); },
    [](Scene& s, double) { s.setAdaptiveTimeStep(0.5); },
    [](Scene& s, double) { s.particleHandler.removeObject(999); },
    [](Scene& s, double) { s.particleHandler.copyAndAddObject(SphericalParticle()); },
    [](Scene& s, double) { s.wallHandler.removeObject(17); },
    [](Scene& s, double) { s.setNumberOfThreads(0); },
    [](Scene& s, double x) { s.speciesHandler.getObject(0)->setSlidingFrictionCoefficient(-x); },
    [](Scene& s, double) { s.acceptOverlaps(2); },
    [](Scene& s, double) { s.setLiquidToCome(1); },
    [](Scene& s, double) { s.keepEnergyLedger(false); },
    [](Scene& s, double) { s.initialise(); },
};

/// What one of the scenes refuses at once because of what it has.
const std::vector<Change> refusedInStrain{
    [](Scene& s, double x) {
        s.setGravity({0, 0, -1 - x});
    },
    [](Scene& s, double x) { s.setStrainRate(0, 1 + x); },  // along the flow
    [](Scene& s, double x) { s.setTargetStress(2, 100 * x, 1e-7); },
    [](Scene& s, double x) { s.setTargetShearStress(100 * x, 0); },
};
const std::vector<Change> refusedWithAFloor{
    [](Scene& s, double x) { s.setShearRate(x); },
    [](Scene& s, double x) { s.setStrainRate(0, x); },
    [](Scene& s, double x) { s.setTargetStress(0, x, 1); },
};

struct Ended {
    std::uint64_t hash;
    double energy;  // J
    std::size_t refusals;
};

/// 60 steps; before each of them one change in two is made, of which the seed tells which.
template <class Of>
Ended run(std::uint32_t seed, const std::vector<Change>& otherRefused, bool withRefused) {
    Of scene;
    std::size_t refusals = 0, asked = 0;
    UniformRandom random(seed);
    std::vector<Change> wrong = refused;
    wrong.insert(wrong.end(), otherRefused.begin(), otherRefused.end());
    const auto pick = [](const std::vector<Change>& of, double x) {
        return of[std::min(static_cast<std::size_t>(x * static_cast<double>(of.size())), of.size() - 1)];
    };
    scene.hook = [&](Scene& s) {
        const double kind = random.uniform(0, 1), which = random.uniform(0, 1), x = random.uniform(0.1, 1);
        if (kind < 0.2) return pick(accepted, which)(s, x);
        if (!withRefused || kind > 0.7) return;
        ++asked;
        refusals += support::isOneSentence(support::refusal([&] { pick(wrong, which)(s, x); })) ? 1 : 0;
    };
    scene.run(60);
    EXPECT_EQ(refusals, asked);
    return {stateHash(scene.particleHandler.store()), scene.energyLedger().total(), refusals};
}

template <class Of>
void compare(const std::vector<Change>& otherRefused) {
    std::size_t refusals = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Ended with = run<Of>(seed, otherRefused, true), without = run<Of>(seed, otherRefused, false);
        EXPECT_EQ(with.hash, without.hash) << "seed " << seed;
        EXPECT_EQ(with.energy, without.energy) << "seed " << seed;
        refusals += with.refusals;
    }
    EXPECT_GT(refusals, 400u);  // of 20 x 60 x 0.5 on the average
}

TEST(RefusedChanges, leaveASceneWithAFloorAsItWas) { compare<Falling>(refusedWithAFloor); }

TEST(RefusedChanges, leaveAStrainedSceneAsItWas) { compare<Strained>(refusedInStrain); }

}  // namespace
}  // namespace pendular::refusedChangesTest
