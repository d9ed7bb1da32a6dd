// What a change between two steps gives to a scene is the driver's, exactly, and not the integrator's error;
// and bodies that were put into each other have the force of their overlap from the first step on.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "SelfTests/Scenes/HookedGrains.h"

namespace pendular::givenByChangeTest {
namespace {

using scenes::GrainMotion;
using scenes::HookedGrains;
using scenes::PlaneAt;

using Linear = Species<LinearViscoelastic>;
using Hertz = Species<HertzianViscoelastic>;

constexpr double r = 1e-3;         // m
constexpr double density = 2500;   // kg/m^3
constexpr double stiffness = 500;  // N/m
constexpr double modulus = 2e6;    // Pa, E*
constexpr double dt = 2e-6;        // s
constexpr double deep = 1e-5;      // m, an overlap

double massOf(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density; }

/// A normal law, with its energy (J) and its force (N) at an overlap (m), by their closed forms.
template <class S>
struct Law;
template <>
struct Law<Linear> {
    static Linear species(double factor, bool isDamped) {
        Linear species;
        species.setDensity(density);
        species.setStiffness(factor * stiffness);
        species.setDissipation(isDamped ? 0.02 : 0);
        return species;
    }
    static void setStiffness(auto& species, double factor) { species.setStiffness(factor * stiffness); }
    static double energy(double factor, double /*radius*/, double overlap) {
        return 0.5 * factor * stiffness * overlap * overlap;
    }
    static double force(double factor, double /*radius*/, double overlap) {
        return factor * stiffness * overlap;
    }
};
template <>
struct Law<Hertz> {
    static Hertz species(double factor, bool isDamped) {
        Hertz species;
        species.setDensity(density);
        species.setEffectiveElasticModulus(factor * modulus);
        species.setDissipation(isDamped ? 0.3 : 0);
        return species;
    }
    static void setStiffness(auto& species, double factor) {
        species.setEffectiveElasticModulus(factor * modulus);
    }
    /// Johnson (1985), Contact Mechanics, section 4.2. @param radius effective, m
    static double energy(double factor, double radius, double overlap) {
        return 8.0 / 15 * factor * modulus * std::sqrt(radius) * std::pow(overlap, 2.5);
    }
    static double force(double factor, double radius, double overlap) {
        return 4.0 / 3 * factor * modulus * std::sqrt(radius) * std::pow(overlap, 1.5);
    }
};

template <class S>
class GivenByChange : public testing::Test {
protected:
    using Scene = HookedGrains<S>;

    static void setUp(Scene& scene, int threads) {
        scene.keepEnergyLedger();
        scene.setQuiet();
        scene.setTimeMax(1);
        scene.setNumberOfThreads(threads);
        scene.acceptOverlaps(0.2);
        scene.acceptUnstableTimeStep();  // dashpots are as strong as they are
    }

    /// Makes a change after some steps, and goes on for one.
    /// @param given J, by the driver, in closed form; @param scale J, of the elastic energy
    static void expectGiven(Scene& scene, const std::function<void(Scene&)>& change, double given,
                            double scale) {
        const EnergyLedger before = scene.energyLedger();
        change(scene);
        scene.step();
        const EnergyLedger& after = scene.energyLedger();
        // Overlaps are differences of numbers of the size of r: rounded by 2^-52 r.
        EXPECT_NEAR(after.driver - before.driver, given, 5 * 0x1p-52 * r / deep * scale);
        // In a step of Verlet from rest elastic and dashpot forces work along (v + v+)/2 h, which differs
        // from the way by h^2 (a+ - a)/4; the change of the acceleration in the step is at most that of a
        // dashpot, a zeta w h: the share of the energy is below (w h)^3, with w^2 of the contact of the
        // grains.
        const double stiffest = Law<S>::force(4, r, deep) / deep * 1.5;
        const double cubed = std::pow(std::sqrt(2 * stiffest / massOf(0.9 * r)) * dt, 3);
        EXPECT_LT(std::abs(after.stepError - before.stepError), cubed * scale);
        EXPECT_NEAR(after.closed(), before.closed(), 1e-12 * scale);
    }
    /// The first force of a contact, without a dashpot, is that of its overlap.
    static void expectForce(Scene& scene, double factor, double radius) {
        const auto seen = scene.interactions();
        ASSERT_EQ(seen.size(), 1u);
        const double force = Law<S>::force(factor, radius, seen[0].overlap());
        EXPECT_NEAR(seen[0].normalForce, force, 1e-9 * force);  // round-off of the overlap, times r / deep
    }
    static void addPlane(Scene& scene, const Vec3D& normal, const Vec3D& point, std::size_t species = 0) {
        scene.wallHandler.copyAndAddObject(
            InfiniteWall(normal, point, scene.speciesHandler.getObject(species)));
    }
};
using Laws = testing::Types<Linear, Hertz>;
TYPED_TEST_SUITE(GivenByChange, Laws);

TYPED_TEST(GivenByChange, aPlaneThatIsAdded) {
    for (const bool isDamped : {false, true})
        for (const int threads : {1, 3}) {
            HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, isDamped), {{.radius = r}}, dt);
            this->setUp(scene, threads);
            scene.run(5);
            const double energy = Law<TypeParam>::energy(1, r, deep);
            this->expectGiven(
                scene,
                [&](auto& s) {
                    this->addPlane(s, {0, 0, -1}, {0, 0, -r + deep});
                },
                energy, energy);
            if (!isDamped) this->expectForce(scene, 1, r);
            // From rest, both halves of the kick have the force.
            const double gained = scene.motion(0).velocity.z() * massOf(r) / dt;
            if (!isDamped) {
                EXPECT_NEAR(gained, Law<TypeParam>::force(1, r, deep), 1e-3 * gained);
            }
        }
}

TYPED_TEST(GivenByChange, aGrainThatIsAdded) {
    for (const bool isDamped : {false, true}) {
        HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, isDamped), {{.radius = r}}, dt);
        this->setUp(scene, 1);
        scene.run(5);
        const double reduced = r * 0.9 * r / (1.9 * r), energy = Law<TypeParam>::energy(1, reduced, 4 * deep);
        this->expectGiven(
            scene,
            [&](auto& s) {
                s.particleHandler.copyAndAddObject(s.grain(0.9 * r, {1.9 * r - 4 * deep, 0, 0}));
            },
            energy, energy);
        if (!isDamped) this->expectForce(scene, 1, reduced);
    }
}

TYPED_TEST(GivenByChange, aGrainThatIsMovedOrGrowsInAndDeeper) {
    const double reduced = r / 2;
    const auto energyAt = [&](double overlap) { return Law<TypeParam>::energy(1, reduced, overlap); };
    const std::map<std::string, std::pair<double, std::function<void(HookedGrains<TypeParam>&)>>> changes{
        {"moved in",
         {-deep,
          [](auto& s) {
              s.particleHandler.getObject(1).setPosition({2 * r - deep, 0, 0});
          }}},
        {"moved deeper", {deep, [](auto& s) {
                              s.particleHandler.getObject(1).setPosition({2 * r - 2 * deep, 0, 0});
                          }}}};
    for (const bool isHeld : {false, true})
        for (const auto& [name, change] : changes) {
            SCOPED_TRACE(name);
            HookedGrains<TypeParam> scene(
                Law<TypeParam>::species(1, true),
                {{.radius = r, .fixed = isHeld}, {.radius = r, .position = {2 * r - change.first, 0, 0}}},
                dt);
            this->setUp(scene, 1);
            scene.initialise();
            const double overlap = change.first > 0 ? 2 * deep : deep;
            this->expectGiven(scene, change.second,
                              energyAt(overlap) - (change.first > 0 ? energyAt(deep) : 0), energyAt(overlap));
        }
}

// Thermal expansion, by a hook: the overlap grows by what both radii do, and R* with them.
TYPED_TEST(GivenByChange, radiiThatGrowAndShrink) {
    for (const double factor : {1.002, 0.999}) {
        HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, false),
                                      {{.radius = r}, {.radius = r, .position = {2 * r - deep, 0, 0}}}, dt);
        this->setUp(scene, 1);
        scene.initialise();
        const double overlap = deep + 2 * (factor - 1) * r,
                     then = Law<TypeParam>::energy(1, factor * r / 2, overlap),
                     before = Law<TypeParam>::energy(1, r / 2, deep);
        this->expectGiven(
            scene,
            [&](auto& s) {
                for (const std::size_t k : {0, 1}) s.particleHandler.getObject(k).setRadius(factor * r);
            },
            then - before, std::max(then, before));
        this->expectForce(scene, 1, factor * r / 2);
    }
}

TYPED_TEST(GivenByChange, aStiffnessThatIsSet) {
    for (const bool isDamped : {false, true})
        for (const double factor : {0.25, 4.0}) {
            HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, isDamped),
                                          {{.radius = r}, {.radius = r, .position = {2 * r - deep, 0, 0}}},
                                          dt);
            this->setUp(scene, 1);
            scene.initialise();
            const double before = Law<TypeParam>::energy(1, r / 2, deep);
            this->expectGiven(
                scene, [&](auto& s) { Law<TypeParam>::setStiffness(*s.speciesHandler.getObject(0), factor); },
                (factor - 1) * before, std::max(factor, 1.0) * before);
            if (!isDamped) this->expectForce(scene, factor, r / 2);
        }
}

// A pair of species that has changed concerns no contact of another pair.
TYPED_TEST(GivenByChange, anotherSpeciesOfAGrainAndOfAWall) {
    for (const bool ofWall : {false, true}) {
        HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, false), {{.radius = r}}, dt,
                                      {{{0, 0, -1}, {0, 0, -r + deep}}});
        this->setUp(scene, 1);
        const auto* stiffer = scene.speciesHandler.copyAndAddObject(Law<TypeParam>::species(4, false));
        Law<TypeParam>::setStiffness(
            *scene.speciesHandler.getMixedObject(scene.speciesHandler.getObject(0), stiffer), 4);
        scene.initialise();
        const double before = Law<TypeParam>::energy(1, r, deep);
        this->expectGiven(
            scene,
            [&](auto& s) {
                if (ofWall) s.wallHandler.getObject(0).setSpecies(stiffer);
                else s.particleHandler.getObject(0).setSpecies(stiffer);
            },
            3 * before, 4 * before);
        this->expectForce(scene, 4, r);
    }
}

// A wall that is removed and put back at once leaves a grain at rest at rest: 1 g/8 h more, and it jumps.
TYPED_TEST(GivenByChange, aWallThatIsPutBackUnderARestingGrain) {
    const double g = 9.81;
    double overlap = 0;  // m, at rest
    for (double low = 0, high = deep; high - low > 0x1p-60 * r;) {
        overlap = 0.5 * (low + high);
        (Law<TypeParam>::force(1, r, overlap) > massOf(r) * g ? high : low) = overlap;
        if (0.5 * (low + high) == low || 0.5 * (low + high) == high) break;
    }
    for (const bool isDamped : {false, true}) {
        HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, isDamped), {{.radius = r}}, dt,
                                      {{{0, 0, -1}, {0, 0, -r + overlap}}});
        this->setUp(scene, 1);
        scene.setGravity({0, 0, -g});
        scene.run(5);
        const double energy = Law<TypeParam>::energy(1, r, overlap);
        this->expectGiven(
            scene,
            [&](auto& s) {
                s.wallHandler.removeObject(0);
                this->addPlane(s, {0, 0, -1}, {0, 0, -r + overlap});
            },
            0, energy);
        // Round-off of the overlap, of place and wall: 2^-52 r each are 1.5 times as much of a Hertz force,
        // in 6 steps.
        EXPECT_LT(scene.motion(0).velocity.norm(), 6 * 2 * 1.5 * 0x1p-52 * r / overlap * g * dt);
    }
}

// Bodies of grains have the force, too: two joined grains above a plane that is put into one of them.
TYPED_TEST(GivenByChange, aPlaneIntoAClump) {
    HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, false),
                                  {{.radius = r}, {.radius = r, .position = {3 * r, 0, 2 * deep}}}, dt);
    scene.bodyHandler.join(std::vector<std::uint32_t>{0, 1});
    this->setUp(scene, 1);
    scene.run(3);
    const double energy = Law<TypeParam>::energy(1, r, deep), force = Law<TypeParam>::force(1, r, deep);
    this->expectGiven(
        scene,
        [&](auto& s) {
            this->addPlane(s, {0, 0, -1}, {0, 0, -r + deep});
        },
        energy, energy);
    const BodyReference body = scene.bodyHandler.getObject(0);
    EXPECT_NEAR(body.getVelocity().z() * 2 * massOf(r), force * dt, 2e-3 * force * dt);
}

// The wall that a piston is has the force of what was put into it, in the first half of the step alike.
TYPED_TEST(GivenByChange, aGrainIntoAPiston) {
    HookedGrains<TypeParam> scene(Law<TypeParam>::species(1, false),
                                  {{.radius = r, .position = {0, 0, 3 * r}}}, dt,
                                  {{{0, 0, 1}, {0, 0, 4 * r}}});
    this->setUp(scene, 1);
    auto& piston = dynamic_cast<InfiniteWall&>(scene.wallHandler.getObject(0));
    piston.setPiston(1e-4, 0);
    scene.run(3);
    const double energy = Law<TypeParam>::energy(1, r, deep), force = Law<TypeParam>::force(1, r, deep);
    this->expectGiven(
        scene,
        [&](auto& s) {
            s.particleHandler.getObject(0).setPosition({0, 0, 3 * r + deep});
        },
        energy, energy);
    EXPECT_NEAR(piston.getDrivenVelocity() * 1e-4, force * dt, 2e-3 * force * dt);
}

// Of what hooks could do before: fields and velocities.
TEST(GivenByChanges, gravityAndVelocities) {
    HookedGrains<Linear> scene(Law<Linear>::species(1, false), {{.radius = r, .position = {0, 0, 5 * r}}},
                               dt);
    scene.keepEnergyLedger();
    scene.setQuiet();
    scene.setTimeMax(1);
    scene.run(2);
    const double then = scene.energyLedger().driver;
    scene.setGravity({0, 0, -9.81});
    scene.particleHandler.getObject(0).setVelocity({0.3, 0, 0});
    scene.step();
    const double given = massOf(r) * (9.81 * 5 * r + 0.5 * 0.09);
    EXPECT_NEAR(scene.energyLedger().driver - then, given, 1e-13 * given);
}

/// A block of grains that overlap, at a floor.
class Block : public HookedGrains<Species<HertzianViscoelastic, Mindlin>> {
public:
    explicit Block(int threads) : HookedGrains(material(), {}, dt, {{{0, 0, -1}, {0, 0, 0}}}) {
        for (int k = 0; k < 6 * 6 * 6; ++k)
            particleHandler.copyAndAddObject(
                grain(r, {1.99 * r * (k % 6), 1.99 * r * (k / 6 % 6), 0.99 * r + 1.99 * r * (k / 36)},
                      {0.01 * (k % 5), 0.01 * (k % 7), -0.01 * (k % 3)}));
        setGravity({0, 0, -9.81});
        keepEnergyLedger();
        setQuiet();
        setTimeMax(1);
        setNumberOfThreads(threads);
    }
    static Species<HertzianViscoelastic, Mindlin> material() {
        Species<HertzianViscoelastic, Mindlin> species;
        species.setDensity(density);
        species.setEffectiveElasticModulus(modulus);
        species.setDissipation(0.3);
        species.setEffectiveShearModulus(0.7 * modulus);
        species.setSlidingFrictionCoefficient(0.4);
        species.setSlidingDissipation(0.2);
        return species;
    }
};

// Tangential springs are kept half a step ahead; what they store changes with their stiffness, and they have
// all of their way in the next step.
TEST(GivenByChanges, theStiffnessOfTangentialSprings) {
    for (const Integrator& scheme : {integrators::predictedVelocityVerlet, integrators::springsInStep}) {
        Block block(1);
        block.setIntegrator(scheme);
        block.speciesHandler.getObject(0)->setSlidingFrictionCoefficient(100);  // all stick
        block.run(40);
        const EnergyLedger before = block.energyLedger();
        ASSERT_GT(before.tangentialElastic, 0);
        block.speciesHandler.getObject(0)->setEffectiveShearModulus(1.4 * modulus);
        block.step();
        const EnergyLedger& after = block.energyLedger();
        // k_t is proportional to G*. The springs are found again at the time of the change by the velocities
        // at it, which differ from those of the step by h^2 of the change of the accelerations.
        const double given = before.tangentialElastic;
        EXPECT_NEAR(after.driver - before.driver, given, 0.02 * given) << scheme.name;
        EXPECT_LT(std::abs(after.stepError - before.stepError), 0.02 * given) << scheme.name;
        EXPECT_NEAR(after.closed(), before.closed(), 1e-12 * std::abs(after.elastic)) << scheme.name;
    }
}

// Changes of all kinds at once: as many bits for any number of threads, with the ledger or without.
TEST(GivenByChanges, isTheSameForAnyNumberOfThreads) {
    const auto after = [](int threads, bool withLedger) {
        Block block(threads);
        block.keepEnergyLedger(withLedger);
        block.run(20);
        block.particleHandler.getObject(17).setRadius(1.003 * r);
        block.particleHandler.getObject(60).setPosition(block.particleHandler.getObject(60).getPosition() +
                                                        Vec3D(1e-6, 0, 0));
        block.step();
        block.speciesHandler.getObject(0)->setEffectiveElasticModulus(1.5 * modulus);
        block.wallHandler.copyAndAddObject(
            InfiniteWall({-1, 0, 0}, {-0.99 * r, 0, 0}, block.speciesHandler.getObject(0)));
        for (int k = 0; k < 10; ++k) block.step();
        std::vector<double> all;
        for (const GrainReference grain : block.particleHandler)
            for (const Vec3D& each : {grain.getPosition(), grain.getVelocity(), grain.getAngularVelocity()})
                all.insert(all.end(), each.begin(), each.end());
        if (withLedger)
            for (const EnergyLedger::Entry& entry : EnergyLedger::entries())
                all.push_back(block.energyLedger().*entry.member);
        return all;
    };
    const std::vector<double> one = after(1, true), without = after(1, false);
    for (const int threads : {2, 7}) EXPECT_EQ(after(threads, true), one) << threads;
    EXPECT_TRUE(std::equal(without.begin(), without.end(), one.begin()));
}

// Who sets values that are there already changes nothing, in no bit: contacts are listed again, and no more.
TEST(GivenByChanges, ofValuesThatAreThere) {
    using Hook = std::function<void(Block&)>;
    const auto after = [](const Hook& hook) {
        Block block(1);
        block.acceptOverlaps(0.2);
        block.particleHandler.getObject(3).setHeldAxes({.x = true});
        block.particleHandler.getObject(40).fixParticle();
        block.run(5);
        for (int k = 0; k < 60; ++k) {
            if (hook && k % 2 == 0) hook(block);
            block.step();
        }
        std::vector<double> all;
        for (const GrainReference grain : block.particleHandler)
            for (const Vec3D& each : {grain.getPosition(), grain.getVelocity(), grain.getAngularVelocity()})
                all.insert(all.end(), each.begin(), each.end());
        EXPECT_EQ(block.energyLedger().driver, 0);
        return std::pair(all, block.contacts().rebuildCount());
    };
    const auto ofAll = [](auto&& set) {
        return [set](Block& block) {
            for (GrainReference grain : block.particleHandler) set(grain);
        };
    };
    const std::map<std::string, Hook> hooks{
        {"radius", ofAll([](GrainReference& grain) { grain.setRadius(grain.getRadius()); })},
        {"position", ofAll([](GrainReference& grain) { grain.setPosition(grain.getPosition()); })},
        {"species",
         [](Block& b) { b.particleHandler.getObject(50).setSpecies(b.speciesHandler.getObject(0)); }},
        {"held", ofAll([](GrainReference& grain) { grain.setHeldAxes(grain.getHeldAxes()); })},
        {"fixed", [](Block& b) { b.particleHandler.getObject(40).fixParticle(); }},
        {"a species that nothing is of",
         [](Block& b) { b.speciesHandler.copyAndAddObject(Block::material()); }},
        {"a wall that nothing touches", [](Block& b) {
             b.wallHandler.copyAndAddObject(
                 InfiniteWall({0, 0, -1}, {0, 0, -1}, b.speciesHandler.getObject(0)));
         }}};
    const auto [bits, lists] = after({});
    for (const auto& [name, hook] : hooks) {
        const auto [same, more] = after(hook);
        EXPECT_EQ(same, bits) << name;
        EXPECT_GE(more, lists + 20) << name;
    }
}

}  // namespace
}  // namespace pendular::givenByChangeTest
