// What a hook changes between two steps leaves the account of the energy closed to round-off, whatever acts.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "Kernel/Core/Motion/Integrator.h"
#include "SelfTests/Energy/OpenAccount.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/AnyMaterial.h"

namespace pendular::changeLedgerTest {
namespace {

using scenes::HookedGrains;

constexpr double r = 1e-3;              // m
constexpr double dt = 2e-6;             // s
constexpr int before = 20, after = 40;  // steps

/// A chain of three grains of different sizes on a floor, with spins, one of which touches a grain that is
/// held; a fifth one is far away. They overlap by a thousandth of r, so that all forces are there when they
/// change.
template <class S>
class Chain : public HookedGrains<S> {
public:
    static constexpr bool isWet = MovesLiquid<typename S::Adhesion>;

    explicit Chain(const Integrator& scheme)
        : HookedGrains<S>(material(1), {}, dt, {{{0, 0, -1}, {0, 0, 0}}}) {
        this->speciesHandler.copyAndAddObject(material(1.7));
        const double radii[] = {r, 0.8 * r, 1.2 * r};
        double x = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (k > 0)  // centres on a floor are at different heights
                x += std::sqrt(std::pow(radii[k - 1] + radii[k] - 2e-3 * r, 2) -
                               std::pow(0.999 * (radii[k - 1] - radii[k]), 2));
            add(radii[k], {x, 0, 0.999 * radii[k]}, false);
        }
        add(0.9 * r, {-1.899 * r, 0, 0.95 * r}, true);
        add(r, {0, 30 * r, 5 * r}, false);
        this->setGravity({0.5, -1, -9.81});
        this->setIntegrator(scheme);
        this->keepEnergyLedger();
        this->setQuiet();
        this->setTimeMax(1);
        this->acceptUnstableTimeStep();  // denser grains come, where none are packed
        if constexpr (isWet) {
            this->setLiquidDensity(1000);
            Evaporation law;
            law.setFlux(1e-3);  // some per cent of a film in the test
            law.setInterval(3);
            this->setEvaporation(law);
        }
    }

private:
    static S material(double heavier) {
        S species = support::anyMaterial<S>({.youngModulus = 5e6, .stiffness = 500});
        species.setDensity(2500 * heavier);
        return species;
    }
    void add(double radius, const Vec3D& place, bool isHeld) {
        const double speed = 0.02 * static_cast<double>(1 + this->particleHandler.getSize());
        SphericalParticle grain = this->grain(radius, place, {-speed, 0.5 * speed, -0.3 * speed});
        grain.setAngularVelocity({20, -30, 1000 * speed});
        if constexpr (isWet) grain.setLiquidVolume(4e-12);
        if (isHeld) grain.fixParticle();
        this->particleHandler.copyAndAddObject(grain);
    }
};

template <class S>
struct Change {
    const char* name;
    std::function<void(Chain<S>&)> make;
};

template <class S>
std::vector<Change<S>> changesOf(const Integrator& scheme) {
    using Scene = Chain<S>;
    const auto grain = [](Scene& s, std::size_t k) { return s.particleHandler.getObject(k); };
    const auto scaleRadius = [grain](Scene& s, std::size_t k, double factor) {
        grain(s, k).setRadius(factor * grain(s, k).getRadius());
    };
    const auto otherGravity = [](Scene& s) { s.setGravity({1, 2, -5}); };
    std::vector<Change<S>> all{
        {"larger", [=](Scene& s) { scaleRadius(s, 1, 1.0005); }},
        {"smaller", [=](Scene& s) { scaleRadius(s, 1, 0.9995); }},
        {"so small that contacts end", [=](Scene& s) { scaleRadius(s, 1, 0.9); }},
        {"two radii", [=](Scene& s) { scaleRadius(s, 0, 0.9997), scaleRadius(s, 2, 1.0002); }},
        {"radius of a held grain", [=](Scene& s) { scaleRadius(s, 3, 0.9996); }},
        {"another species", [=](Scene& s) { grain(s, 1).setSpecies(s.speciesHandler.getObject(1)); }},
        {"density", [](Scene& s) { s.speciesHandler.getObject(0)->setDensity(3300); }},
        {"velocity",
         [=](Scene& s) {
             grain(s, 1).setVelocity({0.1, -0.2, 0.05});
         }},
        {"spin",
         [=](Scene& s) {
             grain(s, 1).setAngularVelocity({90, 10, -200});
         }},
        {"velocity of a held grain",
         [=](Scene& s) {
             grain(s, 3).setVelocity({0.1, 0, 0});
         }},
        {"place",
         [=](Scene& s) { grain(s, 1).setPosition(grain(s, 1).getPosition() + Vec3D(2e-7, 1e-7, 0)); }},
        {"far place",
         [=](Scene& s) {
             grain(s, 1).setPosition({0, -20 * r, 3 * r});
         }},
        {"held", [=](Scene& s) { grain(s, 1).fixParticle(); }},
        {"let go", [=](Scene& s) { grain(s, 3).fixParticle(false); }},
        {"held along an axis",
         [=](Scene& s) {
             grain(s, 1).setHeldAxes({.x = true, .aboutY = true});
             grain(s, 1).setVelocity({0.1, -0.1, 0}), grain(s, 1).setAngularVelocity({0, 40, 0});
         }},
        {"held about axes", [=](Scene& s) { grain(s, 1).setHeldAxes({.aboutX = true, .aboutZ = true}); }},
        {"let go along axes", [=](Scene& s) { grain(s, 3).setHeldAxes({.y = true}); }},
        {"gravity", otherGravity},
        {"gravity and radius", [=](Scene& s) { otherGravity(s), scaleRadius(s, 1, 1.0005); }},
        {"gravity and a new grain",
         [=](Scene& s) {
             otherGravity(s);
             s.particleHandler.copyAndAddObject(s.grain(r, {0, 10 * r, 5 * r}, {0.1, 0, 0}));
         }},
        {"a grain goes", [](Scene& s) { s.particleHandler.removeObject(0); }},
        {"a changed grain's partner goes",
         [=](Scene& s) { scaleRadius(s, 1, 0.9995), s.particleHandler.removeObject(2); }},
        {"the floor goes", [=](Scene& s) { scaleRadius(s, 1, 1.0003), s.wallHandler.removeObject(0); }},
        {"the floor moves", [](Scene& s) {
             dynamic_cast<InfiniteWall&>(s.wallHandler.getObject(0)).setVelocity({0.2, 0, 0});
         }}};
    const auto joined = [](Scene& s) { return s.bodyHandler.join(std::vector<std::uint32_t>{1, 4}); };
    all.push_back({"a body", [=](Scene& s) { joined(s); }});
    all.push_back({"a body that is held", [=](Scene& s) { joined(s).fixBody(); }});
    all.push_back({"a body that is driven along held axes", [=](Scene& s) {
                       BodyReference body = joined(s);
                       body.setHeldAxes({.y = true, .aboutX = true, .aboutY = true});
                       body.setVelocity({0, 0.1, 0}), body.setAngularVelocity({2, 1, 0});
                   }});
    if (!scheme.remembersEarlier()) {
        all.push_back({"time step", [](Scene& s) { s.setTimeStep(0.6 * dt); }});
    }
    if constexpr (Scene::isWet) {
        all.push_back({"film", [=](Scene& s) { grain(s, 1).setLiquidVolume(3e-11); }});
        all.push_back({"films and a radius", [=](Scene& s) {
                           scaleRadius(s, 1, 1.0005);
                           for (const std::size_t k : {0, 1, 2}) grain(s, k).setLiquidVolume(2e-11);
                       }});
    }
    return all;
}

constexpr Integrator schemes[] = {integrators::predictedVelocityVerlet, integrators::springsInStep,
                                  integrators::velocityVerlet, integrators::adamsMoulton};

template <class S>
class ChangeLedger : public testing::Test {};
using Laws =
    testing::Types<Species<HertzianViscoelastic>, Species<HertzianViscoelastic, Mindlin>,
                   Species<HertzianViscoelastic, MindlinRollingTorsion>,
                   Species<HertzianViscoelastic, Mindlin, JKR>, Species<HertzianViscoelastic, Mindlin, DMT>,
                   Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>,
                   Species<HertzianViscoelastic, Mindlin, LiquidBridgeYoungLaplace>,
                   Species<HertzianViscoelastic, Mindlin, LiquidMigrationWillett>>;
TYPED_TEST_SUITE(ChangeLedger, Laws);

TYPED_TEST(ChangeLedger, closesOverEveryChange) {
    for (const Integrator& scheme : schemes)
        for (const Change<TypeParam>& change : changesOf<TypeParam>(scheme)) {
            SCOPED_TRACE(fmt::format("{}, {}", scheme.name, change.name));
            Chain<TypeParam> scene(scheme);
            scene.run(before);
            ASSERT_GE(scene.interactions().size(), 6u);
            EXPECT_LT(energy::openness<Chain<TypeParam>>(scene, change.make, after), 1);
        }
}

// One change after the other, at random, in chains that have gone on: most of them meet contacts that have
// been changed before.
TYPED_TEST(ChangeLedger, closesOverRandomChanges) {
    for (const Integrator& scheme : schemes) {
        const std::vector<Change<TypeParam>> all = changesOf<TypeParam>(scheme);
        std::size_t done = 0;
        for (unsigned seed = 0; seed < 5; ++seed) {
            std::mt19937 random(seed);
            Chain<TypeParam> scene(scheme);
            scene.run(before);
            std::string made;
            for (int k = 0; k < 12; ++k) {
                const Change<TypeParam>& change = all[random() % all.size()];
                made += fmt::format(" {},", change.name);
                try {
                    EXPECT_LT(energy::openness<Chain<TypeParam>>(scene, change.make, 5), 1)
                        << scheme.name << made;
                    ++done;
                } catch (const InputError&) {  // of a grain that has gone, or is part of a body
                } catch (const RunError&) {    // they overlap too far
                    break;
                }
            }
        }
        EXPECT_GT(done, 30u) << scheme.name;
    }
}

}  // namespace
}  // namespace pendular::changeLedgerTest
