// Films and bridges that dry: the oracles are closed forms, and curves of an independent solver of the
// Young-Laplace equation (areas and times to 8 digits).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Laws/Species/AdhesionEnergy.h"
#include "Kernel/Scene/PendularState.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::dryingTest {
namespace {

using support::TestFolder;
using wet::HeavyRow;

constexpr double r = HeavyRow<>::r;
constexpr double gamma = HeavyRow<>::surfaceTension;

const Bodies equal{r, r}, plane{0.5 * r, infinity};  // R = r for both

/// kt/R at which a bridge of V0* has dried to V*, by steps of equal length.
struct Given {
    const char* name;
    Bodies bodies;
    double gap;         // over R
    double volume;      // V*
    double area;        // A/R^2 at it
    double timeToHalf;  // kt/R from V* = 0.01 to 0.005
};
const Given given[] = {{"equal, touching", equal, 0, 0.01, 0.2402092631, 0.026636705},
                       {"plane, touching", plane, 0, 0.01, 0.2381932366, 0.0268381491},
                       {"equal, apart", equal, 0.1, 0.01, 0.2420149549, 0.0247913689}};
/// The relative error of numbers with the digits that are given.
constexpr double digits = 1e-8;

BridgeLiquid bridgeOf(const Bodies& bodies, double volume, double angle = 0) {
    return {bodies, volume * r * r * r, angle, gamma};
}

double exactArea(const Given& g, double volume) {
    return solveBridgeSurface(bridgeOf(g.bodies, volume), g.gap * r).area / (r * r);
}

TEST(Drying, bridgesHaveTheirExactArea) {
    struct Row {
        double volume, equal, plane;
    };
    for (const Row& row :
         {Row{0.01, 0.2402092631, 0.2381932366}, Row{0.005, 0.141288978, 0.1403617098},
          Row{0.001, 0.04139665554, 0.04126409043}, Row{1e-4, 0.007220094945, 0.007212663889},
          Row{1e-5, 0.001269521885, 0.001269111957}})
        for (const bool isPlane : {false, true}) {
            const BridgeLiquid bridge = bridgeOf(isPlane ? plane : equal, row.volume);
            const double exact = (isPlane ? row.plane : row.equal) * r * r;
            EXPECT_NEAR(solveBridgeSurface(bridge, 0).area / exact, 1, digits);
            EXPECT_NEAR(bridgeArea(bridge, 0) / exact, 1, 0.01);  // the stated error of the table
            EXPECT_EQ(bridgeArea(bridge, -0.01 * r), bridgeArea(bridge, 0));
        }
    for (const Given& g : given) {
        EXPECT_NEAR(exactArea(g, g.volume) / g.area, 1, digits) << g.name;
        EXPECT_NEAR(bridgeArea(bridgeOf(g.bodies, g.volume), g.gap * r) / (g.area * r * r), 1, 0.01);
    }
}

/// The pressure goes on to the rupture, where it ends with the root of the distance to it, and is held
/// beyond.
TEST(Drying, bridgesHaveTheirPressureUpToTheRupture) {
    for (const Bodies& bodies : {equal, plane})
        for (const double angle : {0.0, 0.3, 0.9}) {
            const double radius = std::isinf(bodies.radius2) ? 0.5 : 1, volume = 0.01;
            const WettedBody first{radius, angle}, second{std::isinf(bodies.radius2) ? infinity : 1, angle};
            const auto rupture = findRupture({first, second, volume});
            ASSERT_TRUE(rupture);
            const double end = rupture->last.gap(), last = gamma / r * rupture->last.pressure();
            const auto surface = [&](double share) {
                return solveBridgeSurface(bridgeOf(bodies, volume, angle), share * end * r);
            };
            const auto lacks = [&](double share) { return std::abs(surface(share).pressure / last - 1); };
            EXPECT_LT(lacks(0.999), lacks(0.99));
            EXPECT_LT(lacks(0.9999), lacks(0.999));
            // A root: a hundredth of the distance is a tenth (less where it ends otherwise than by a fold).
            EXPECT_LT(lacks(1 - 1e-6), 0.11 * lacks(0.9999));
            EXPECT_GT(lacks(1 - 1e-6), 0);
            for (const double share : {1 + 1e-6, 1.01, 2.0}) {
                EXPECT_NEAR(surface(share).pressure / last, 1, 1e-12) << share;
                EXPECT_GT(surface(share).fillingAngle1, 0);
            }
        }
}

/// Below the volumes of the table: A/R^2 = C V*^(3/4) for V* -> 0 between spheres that touch, C = pi (pi - 2
/// theta)/cos(theta) (2/pi)^(3/4). The next term is smaller by V*^(1/2), the area of the table is right to 1
/// %.
TEST(Drying, smallBridgesHaveTheAreaOfTheLimit) {
    for (const double angle : {0.0, 0.3, 1.0})
        for (const double volume : {1e-8, 1e-10, 1e-14}) {
            const double c = std::numbers::pi * (std::numbers::pi - 2 * angle) / std::cos(angle) *
                             std::pow(2 / std::numbers::pi, 0.75);
            const double area = bridgeArea(bridgeOf(equal, volume, angle), 0) / (r * r);
            EXPECT_NEAR(area / (c * std::pow(volume, 0.75)), 1, 0.011) << angle << ' ' << volume;
        }
    // There is no step where table and limit meet.
    for (const double gap : {0.0, 1e-4, 1e-3}) {
        const double above = bridgeArea(bridgeOf(equal, 1.0000001e-7), gap * r),
                     below = bridgeArea(bridgeOf(equal, 0.9999999e-7), gap * r);
        EXPECT_NEAR(above / below, 1, 1e-6);
    }
    EXPECT_EQ(bridgeArea(bridgeOf(equal, 0), 0), 0);
}

/// V* of a bridge after a time kt/R in so many steps of the midpoint rule.
double driedExactly(const Given& g, double time, int steps) {
    double volume = g.volume;
    for (int k = 0; k < steps; ++k)
        volume = Evaporation::leftAfter(volume, time / steps, [&](double v) { return exactArea(g, v); });
    return volume;
}

TEST(Drying, halfTheStepQuartersTheError) {
    for (const Given& g : given) {
        const auto error = [&](int steps) { return driedExactly(g, g.timeToHalf, steps) - 0.005; };
        // What the digits of the time leave open: A dt.
        const double open = 0.14 * 1e-10;
        const double at2 = error(2), at4 = error(4), at8 = error(8);
        EXPECT_NEAR(at2 / at4, 4, 0.5) << g.name;
        EXPECT_NEAR(at4 / at8, 4, 0.5) << g.name;
        EXPECT_LT(std::abs(at8), 1e-4 * 0.005) << g.name;
        EXPECT_LT(std::abs(error(256)), std::abs(at8) / 1000 + open) << g.name;
    }
}

/// The life of touching bridges, and when one that is apart ruptures.
TEST(Drying, lastsAsLongAsTheExactBridge) {
    const double lives[] = {0.1728289, 0.1733664};
    for (const int which : {0, 1}) {
        const Given& g = given[which];
        const double length = 1e-4;
        double volume = g.volume, time = 0;
        while (volume > 1e-9) {
            volume = Evaporation::leftAfter(volume, length, [&](double v) { return exactArea(g, v); });
            time += length;
        }
        // The rest as the limit has it, which for V* = 0.01 is 4 % too long, and the less the smaller the
        // bridge: 4 V*^(1/4)/C.
        const double c = std::numbers::pi * std::numbers::pi * std::pow(2 / std::numbers::pi, 0.75);
        EXPECT_NEAR((time + 4 * std::pow(volume, 0.25) / c) / lives[which], 1, 1e-4) << g.name;
    }
    const Given& apart = given[2];
    EXPECT_NEAR(driedExactly(apart, 0.0562490978, 2000) / 0.001, 1, 1e-5);
    // From here to the rupture, at 0.977e-3, the area grows by 5 % as a square root does: the solver, which
    // starts from nothing, finds no bridge there, and the area is that of the table.
    EXPECT_NEAR(driedExactly(apart, 0.0564443423, 2000) / 9.770635011e-4, 1, 0.05 * 0.023);
    const auto rupture = findRupture({{1, 0}, {1, 0}, 9.770635011e-4});
    ASSERT_TRUE(rupture);
    EXPECT_NEAR(rupture->last.gap(), 0.1, 1e-8);
}

// Scenes. Times are in r/k.

constexpr double k = 1e-4;          // m/s
constexpr double unitTime = r / k;  // s

Evaporation flux(double value, std::size_t interval = 1) {
    Evaporation law;
    law.setFlux(value);
    law.setInterval(interval);
    return law;
}

using ExactRow = HeavyRow<LiquidMigration<LiquidBridgeYoungLaplace>>;

TEST(Drying, aTouchingPairDries) {
    ExactRow row({0.005, 0.005}, {}, 1e-4 * unitTime, [](ExactRow& scene) { scene.setEvaporation(flux(k)); });
    const double initial = row.liquidLedger().initial;
    EXPECT_NEAR(initial, 0.01 * r * r * r, row.particleHandler.films().quantum());
    double before = 0, halfTime = 0;
    while (row.bridge(0) > 0 && row.steps < 3000) {
        row.advance();
        ASSERT_EQ(row.liquidLedger().unaccounted(), 0);
        const double force = row.force(0);
        if (row.steps > 2 && row.bridge(0) > 1e-7) {
            // The force at contact rises to 2 pi R gamma cos(theta), as V -> 0; the table holds it to 0.2 %.
            EXPECT_GT(force, before * (1 - 2e-3));
            EXPECT_LT(force, 2 * std::numbers::pi * r * gamma * (1 + 2e-3));
        }
        before = force;
        if (halfTime == 0 && row.bridge(0) < 0.005) halfTime = row.time();
    }
    // The area of the table is right to 1 %.
    EXPECT_NEAR(halfTime / 0.02663671, 1, 0.012);
    EXPECT_NEAR(row.time() / 0.1728289, 1, 0.012);
    EXPECT_GT(before, 0.99 * 2 * std::numbers::pi * r * gamma);
    row.advance(2);
    EXPECT_EQ(row.liquidLedger().evaporated, initial);
    EXPECT_EQ(row.contacts().movingLiquid().driedBridges(), 1u);
    for (const ObservedContact& seen : row.interactions()) EXPECT_FALSE(seen.bridged);
}

/// It does not shrink, but ruptures when its rupture distance has come down to the gap; what it had then goes
/// to the films, which dry at once. The bridge laws with the fits' rupture distance rupture at
/// V* 9.708729e-4.
template <class Law>
void expectRupture(double volume, double tolerance) {
    HeavyRow<Law> row({0.005, 0.005}, {0.1}, 1e-5 * unitTime, [](HeavyRow<Law>& scene) {
        Evaporation law = flux(k);
        law.setStartTime(2.5e-5 * unitTime);  // when it is apart
        scene.setEvaporation(law);
    });
    double last = row.bridge(0);
    while (row.bridge(0) > 0 && row.steps < 10000) {
        last = row.bridge(0);
        row.advance();
    }
    EXPECT_NEAR(last / volume, 1, tolerance);
    // It dries from 2e-5 on, and ruptures in the step after that which takes it below this volume.
    EXPECT_NEAR((row.time() - 3e-5) / 0.0564443, 1, 0.012 + 1e-5 / 0.056);
    // In the same step the films have begun to dry.
    const double quantum = row.particleHandler.films().quantum() / (r * r * r);
    EXPECT_NEAR(row.film(0) + row.film(1), last - 2 * 4 * std::numbers::pi * 1e-5, 4 * quantum);
    EXPECT_EQ(row.contacts().movingLiquid().driedBridges(), 0u);
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
}

TEST(Drying, aStretchedBridgeRuptures) {
    // An update takes A k dt = 0.113 * 1e-5 of 9.77e-4, which is 0.12 %, and the bridge is prepared again at
    // changes of 0.1 %; the rupture distance of the table is right to 0.075 %, of which the volume is the
    // third power.
    expectRupture<LiquidMigration<LiquidBridgeYoungLaplace>>(9.770635e-4, 0.0012 + 0.001 + 0.00225);
    expectRupture<LiquidMigrationWillett>(9.708729e-4, 0.0012 + 0.001);
}

/// Each reservoir dries by its own area: a film by 4 pi r^2, whatever the bridge does.
TEST(Drying, filmsAndBridgesDryByThemselves) {
    // V_max 0.01: the rest stays in the films.
    const double step = 1e-5 * unitTime;
    ExactRow row({0.02, 0.005}, {}, step, [](ExactRow& scene) {
        scene.speciesHandler.getObject(0)->setLiquidBridgeVolumeMax(0.01 * r * r * r);
        scene.setEvaporation(flux(k));
    });
    ExactRow alone({0.005, 0.005}, {}, step, [](ExactRow& scene) { scene.setEvaporation(flux(k)); });
    const double start = row.film(0);
    EXPECT_NEAR(start, 0.012, 1e-5);
    row.advance(50), alone.advance(50);
    EXPECT_NEAR((start - row.film(0)) / (4 * std::numbers::pi * 50e-5), 1, 1e-6);
    EXPECT_NEAR(row.bridge(0) / alone.bridge(0), 1, 1e-6);
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
    while (row.film(0) > 0 || row.film(1) > 0) row.advance();
    EXPECT_GT(row.bridge(0), 0.008);
}

/// A film that loses a hundredth of a quantum in an update loses its share in the mean.
TEST(Drying, isNotLostInRounding) {
    ExactRow row({0.005, 0.005}, {0.5}, 1e-4 * unitTime, [](ExactRow& scene) {
        scene.setLiquidToCome(1e3 * r * r * r);
        const double quantum = std::ldexp(1, std::ilogb(4e3 * r * r * r) + 1 - 53);
        scene.setEvaporation(flux(0.01 * quantum / (4 * std::numbers::pi * r * r * 1e-4 * unitTime)));
    });
    const double quantum = row.particleHandler.films().quantum(), start = row.liquidLedger().films;
    row.advance(20000);
    // 40 000 draws with the chance p = 0.01 of each: n p +- 4 sqrt(n p).
    const double lost = (start - row.liquidLedger().films) / quantum;
    EXPECT_NEAR(lost, 400, 4 * std::sqrt(400));
    EXPECT_EQ(row.liquidLedger().evaporated, start - row.liquidLedger().films);
}

TEST(Drying, ratesOfTheThreeLaws) {
    Evaporation law;
    EXPECT_FALSE(law.acts());
    law.setMassTransfer(0.01, 0.0173, 998, 0.4);
    EXPECT_NEAR(law.flux(), 0.01 * (1 - 0.4) * 0.0173 / 998, 1e-22);
    law.setFlux(1e-6);
    EXPECT_EQ(law.flux(), 1e-6);
    EXPECT_NEAR(law.radiusLeftAfter(50e-6, 25), 25e-6, 1e-20);
    EXPECT_GT(law.radiusLeftAfter(50e-6, 49.999), 0);
    EXPECT_EQ(law.radiusLeftAfter(50e-6, 50.001), 0);
    // The d^2 law: a0^2 rho / (2 D (rho_vs - rho_v)) = 5.80 s.
    Evaporation diffusion;
    diffusion.setDiffusion(2.5e-5, 8.6e-3, 998);
    EXPECT_FALSE(diffusion.acts());
    EXPECT_TRUE(diffusion.dropletsEvaporate());
    const double life = 50e-6 * 50e-6 * 998 / (2 * 2.5e-5 * 8.6e-3);
    EXPECT_NEAR(life, 5.80, 0.005);
    EXPECT_NEAR(diffusion.radiusLeftAfter(50e-6, 0.75 * life), 25e-6, 1e-15);
    EXPECT_EQ(diffusion.radiusLeftAfter(50e-6, 1.0001 * life), 0);
}

/// Water at 293 K, V_m = 18e-6 m^3/mol, gamma = 0.0728 N/m, between spheres that touch, V* = 0.01.
TEST(Drying, vapourIsThinnerAboveABridge) {
    Evaporation law;
    law.setFlux(1);
    law.setKelvin(18e-6, 293);
    struct Row {
        double radius, factor;
    };
    for (const Row& row : {Row{1e-4, 0.999913}, Row{1e-5, 0.999126}, Row{1e-6, 0.991291}}) {
        const BridgeLiquid bridge{
            {row.radius, row.radius}, 0.01 * row.radius * row.radius * row.radius, 0, 0.0728};
        // The digits of V_m: 0.3 % of 1 - factor; those of the factor.
        EXPECT_NEAR(law.flux(solveBridgeSurface(bridge, 0).pressure), row.factor,
                    0.003 * (1 - row.factor) + 5e-7);
    }
    EXPECT_EQ(law.flux(), 1);
    law.setMassTransfer(1, 1, 1, 0.995);
    EXPECT_EQ(law.flux(-1e8), 0) << "nothing condenses";
    // In a scene: a bridge dries slower by it.
    Evaporation plain = flux(k, 4), kelvin = plain;
    kelvin.setKelvin(18e-6, 293);
    double left[2];
    for (const bool with : {false, true}) {
        HeavyRow<LiquidMigrationWillett> row({0.005, 0.005}, {}, 1e-4 * unitTime, [&](auto& scene) {
            scene.setEvaporation(with ? kelvin : plain);
        });
        row.advance(401);
        left[with] = row.bridge(0);
    }
    // The table's area is within 1 % of the solved one; Kelvin's factor at 1 mm is 1 - 9e-6.
    EXPECT_NEAR(left[1] / left[0], 1, 0.01);
    EXPECT_NE(left[1], left[0]);
}

// The energy.

/// The energy that a stretched bridge has, and what more liquid changes in it; closed form of the simplified
/// law of Willett.
TEST(Drying, energyOfAStretchedBridge) {
    LiquidMigrationWillett law;
    law.setLiquidBridgeVolumeMax(1e-10), law.setContactAngle(0), law.setSurfaceTension(0.0728);
    const Bodies bodies{2e-3, 2e-3};
    const double less = adhesionEnergyOf(law.prepare(bodies, 1e-11), 1e-4),
                 more = adhesionEnergyOf(law.prepare(bodies, 1.5e-11), 1e-4);
    EXPECT_NEAR(less / -7.486403596e-9, 1, 1e-8);
    EXPECT_NEAR(more / -1.176983530e-8, 1, 1e-8);
    const double inContact = adhesionEnergyOf(law.prepare(bodies, 1e-11), 0);
    EXPECT_NEAR(inContact / -4.566915184e-8, 1, 1e-8);
    EXPECT_NEAR(adhesionEnergyOf(law.prepare(bodies, 1e-11), -1e-6) - inContact,
                -1e-6 * law.prepare(bodies, 1e-11).force(0), 1e-20);
    EXPECT_EQ(adhesionEnergyOf(law.prepare(bodies, 1e-11), 1e-3), 0);
}

/// A scene has these energies, too, where a third grain brings the liquid. Its bridge to the second one
/// breaks, and all of its liquid goes to the bridge that is stretched.
TEST(Drying, migrationAndEvaporationAreInTheEnergyLedger) {
    constexpr double start = 3.5e-4 * unitTime;
    using Row = HeavyRow<LiquidMigrationWillett>;
    Row row({0.0025, 0.0025, 0.005}, {0.05}, 1e-4 * unitTime, [&](Row& scene) {
        scene.keepEnergyLedger();
        Evaporation law = flux(k);
        law.setStartTime(1 + start);
        scene.setEvaporation(law);
    });
    const EnergyLedger& ledger = row.energyLedger();
    const double before = ledger.closed();
    LiquidMigrationWillett law = *row.speciesHandler.getObject(0);
    const auto energy = [&](double volume, double gap) {
        return adhesionEnergyOf(law.prepare(equal, volume * r * r * r), gap * r);
    };
    row.advance(4);
    EXPECT_EQ(ledger.migration, 0) << "a bridge that forms is no migration";
    // Grain 1 has given half of its film to either bridge.
    const double old = row.bridge(0), gap = row.gap(0);
    EXPECT_NEAR(old, 0.00375, 1e-9);
    row.rupture(1);
    EXPECT_GT(row.bridge(0), 1.4 * old);
    EXPECT_NEAR(ledger.migration / (energy(row.bridge(0), gap) - energy(old, gap)), 1, 1e-3);
    const double atStart = row.bridge(0), migrated = ledger.migration;
    while (row.getTime() < 1 + start + 0.02 * unitTime) row.advance();
    EXPECT_LT(row.bridge(0), 0.9 * atStart);
    EXPECT_EQ(ledger.migration, migrated);
    // Bridges are prepared again when they have changed by 0.1 %.
    EXPECT_NEAR(ledger.evaporation / (energy(row.bridge(0), gap) - energy(atStart, gap)), 1, 5e-3);
    EXPECT_GT(ledger.evaporation, 0);
    // Grains of 4.2e3 kg were taken along at up to 0.1 m/s, in some 20 steps: round-off of 21 J each.
    EXPECT_LT(std::abs(ledger.closed() - before), 20 * 21 * 0x1p-53);
    EXPECT_GT(std::abs(ledger.migration), 1e4 * 20 * 21 * 0x1p-53);
}

// Boxes of many grains.

using Box = wet::WetBox<Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>>;

/// A box that settles, and dries fast from step 600 on: films are gone at once, and a bridge of 2e-12 m^3 (V*
/// = 0.002) lasts 0.12 r/k or some 1000 steps.
class DryingBox : public Box {
public:
    explicit DryingBox(int layers, int threads = 1) : Box(layers, threads) {
        Evaporation law;
        law.setFlux(0.12 * r / (1000 * getTimeStep()));
        law.setStartTime(600 * getTimeStep());
        law.setInterval(7);
        setEvaporation(law);
    }
};

TEST(Drying, theLedgersOfABoxThatSettlesClose) {
    DryingBox box(4);
    box.keepEnergyLedger();
    box.initialise();
    const EnergyLedger& ledger = box.energyLedger();
    const double start = ledger.closed();
    constexpr int steps = 3000;
    for (int n = 0; n < steps; ++n) {
        box.step();
        ASSERT_EQ(box.liquidLedger().unaccounted(), 0) << n;
    }
    EXPECT_LT(std::abs(ledger.closed() - start), support::roundOff(ledger, steps));
    EXPECT_NE(ledger.migration, 0);
    EXPECT_GT(ledger.evaporation, 0);
    EXPECT_GT(box.liquidLedger().evaporated, 0.5 * box.liquidLedger().initial);
    EXPECT_GT(box.contacts().movingLiquid().driedBridges(), 0u);
}

TEST(Drying, doesNotDependOnThreadsOrRestarts) {
    const TestFolder folder;
    wet::expectSameBits<DryingBox>(folder.path(), {0, 250, 251, 700}, 1200, 700, 720);
}

// Limits at which the pendular state ends.

TEST(PendularLimits, volumeWhereBridgesOfThreeGrainsMeet) {
    struct Row {
        double degrees, volume;
    };
    for (const Row& row : {Row{0, 0.057739}, Row{10, 0.067004}, Row{15, 0.071187}, Row{20, 0.075143},
                           Row{30, 0.082539}, Row{40, 0.089463}})
        EXPECT_NEAR(volumeWhereBridgesMeet(row.degrees * std::numbers::pi / 180), row.volume, 5.1e-7)
            << row.degrees;
    LiquidMigrationWillett law;
    law.setContactAngle(0), law.setSurfaceTension(gamma);
    const auto isBroken = [&](const Bodies& bodies) {
        const std::vector<DomainLimit> limits = law.domainLimits(bodies);
        return std::ranges::any_of(limits, [](const DomainLimit& limit) {
            return limit.quantity.starts_with("V_max") && !limit.holds();
        });
    };
    law.setLiquidBridgeVolumeMax(0.0577 * r * r * r);
    EXPECT_FALSE(isBroken(equal));
    law.setLiquidBridgeVolumeMax(0.0578 * r * r * r);
    EXPECT_TRUE(isBroken(equal));
    EXPECT_FALSE(isBroken({r, infinity}));
}

/// Three heavy grains in mutual touch, each with a film that becomes one bridge's volume (in r^3).
PendularState stateOfThree(double film, double more = 0) {
    constexpr double side = 2 * r * (1 - 1e-6);
    scenes::FewGrains<HeavyRow<>::Material> scene(HeavyRow<>::material(),
                                                  {{.position = {0, 0, 0}},
                                                   {.position = {side, 0, 0}},
                                                   {.position = {0.5 * side, std::sqrt(0.75) * side, 0}}},
                                                  1e-3);
    scene.setQuiet();
    for (auto&& grain : scene.particleHandler) grain.setLiquidVolume(film * r * r * r);
    scene.initialise();
    if (more > 0) scene.particleHandler.getObject(0).setLiquidVolume(more * r * r * r);
    scene.step();
    return pendularState(scene, true);
}

TEST(PendularLimits, bridgesThatMeetAreCounted) {
    const PendularState apart = stateOfThree(0.0575), meeting = stateOfThree(0.0580);
    EXPECT_EQ(apart.overlappingShare, 0);
    EXPECT_EQ(meeting.overlappingShare, 1);
    EXPECT_EQ(apart.bridgesOfAGrain, 2);
    EXPECT_EQ(apart.shareInFilms, 0);
    EXPECT_EQ(apart.thickFilms, 0u);
    EXPECT_NEAR(apart.liquidOverSolid, 0.0575 / (4.0 / 3 * std::numbers::pi), 1e-9);
    EXPECT_NEAR(apart.saturation(0.6), 1.5 * apart.liquidOverSolid, 1e-15);
    EXPECT_TRUE(apart.warnings().empty());
    ASSERT_EQ(meeting.warnings().size(), 1u);
    EXPECT_TRUE(support::contains(meeting.warnings()[0], "100 % of the bridges meet"));
    // More than bridges hold: 0.1 r is the thickness of 4 pi 0.1 r^3.
    EXPECT_EQ(stateOfThree(0.01, 1.25).thickFilms, 0u);
    const PendularState thick = stateOfThree(0.01, 1.26);
    EXPECT_EQ(thick.thickFilms, 1u);
    EXPECT_NEAR(thick.shareInFilms, 1.26 / 1.29, 1e-6);
    EXPECT_EQ(thick.warnings().size(), 3u) << "saturation, share in films, thick films";
    for (const std::string& sentence : thick.warnings()) EXPECT_EQ(sentence.find(','), std::string::npos);
}

/// A run goes on with the drying and the sprays that it had.
TEST(Drying, otherValuesAreRefusedAtARestart) {
    const TestFolder folder;
    const auto file = folder.path() / "box.h5";
    const auto run = [&](double flux, double start, std::size_t interval, double density, bool restarts) {
        Box box(1);
        Evaporation law;
        law.setFlux(flux), law.setStartTime(start), law.setInterval(interval);
        box.setEvaporation(law);
        box.setLiquidDensity(density);
        if (restarts) box.restartFrom(file);
        box.initialise();
        if (!restarts) box.writeRestart(file);
    };
    run(1e-6, 0, 10, 0, false);
    EXPECT_EQ(support::refusal([&] { run(1e-6, 0, 10, 0, true); }), "");
    for (const auto& [text, what] :
         {std::pair(support::refusal([&] { run(2e-6, 0, 10, 0, true); }), "fastest"),
          std::pair(support::refusal([&] { run(1e-6, 1, 10, 0, true); }), "start"),
          std::pair(support::refusal([&] { run(1e-6, 0, 11, 0, true); }), "interval"),
          std::pair(support::refusal([&] { run(1e-6, 0, 10, 1, true); }), "filmMass/density")}) {
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, what));
    }
}

// Bad input.

TEST(Drying, refusesBadFields) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    using E = Evaporation;
    struct Case {
        const char* field;
        void (*set)(E&, double);
        std::vector<double> wrong;
    };
    const std::vector<double> below{-1, nan, infinity, -infinity}, zero{0, -1, nan, infinity, -infinity};
    const Case cases[] = {
        {"flux", [](E& e, double v) { e.setFlux(v); }, below},
        {"mass transfer coefficient", [](E& e, double v) { e.setMassTransfer(v, 1, 1); }, below},
        {"density of saturated vapour", [](E& e, double v) { e.setMassTransfer(1, v, 1); }, below},
        {"density of the liquid", [](E& e, double v) { e.setMassTransfer(1, 1, v); }, zero},
        {"relative humidity",
         [](E& e, double v) { e.setMassTransfer(1, 1, 1, v); },
         {-0.1, 1.1, nan, infinity}},
        {"diffusivity", [](E& e, double v) { e.setDiffusion(v, 1, 1); }, below},
        {"difference of vapour density", [](E& e, double v) { e.setDiffusion(1, v, 1); }, below},
        {"density of the liquid", [](E& e, double v) { e.setDiffusion(1, 1, v); }, zero},
        {"molar volume", [](E& e, double v) { e.setKelvin(v, 293); }, zero},
        {"temperature", [](E& e, double v) { e.setKelvin(18e-6, v); }, zero},
        {"start time", [](E& e, double v) { e.setStartTime(v); }, {nan, infinity, -infinity}},
        {"interval", [](E& e, double v) { e.setInterval(static_cast<std::size_t>(v)); }, {0, 2e9}}};
    for (const Case& c : cases)
        for (const double value : c.wrong) {
            E law;
            const std::string text = support::refusal([&] { c.set(law, value); });
            EXPECT_TRUE(support::isOneSentence(text)) << c.field << ' ' << value;
            EXPECT_TRUE(support::contains(text, c.field));
        }
    ExactRow row({0.005, 0.005}, {}, 1e-4 * unitTime);
    EXPECT_TRUE(support::contains(support::refusal([&] { row.setEvaporation(flux(1)); }), "evaporation"));
    EXPECT_TRUE(
        support::contains(support::refusal([&] { row.setLiquidDensity(1000); }), "density of the liquid"));
    for (const double value : {-1.0, nan, infinity, -infinity}) {
        Simulation<Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>> scene;
        EXPECT_TRUE(support::isOneSentence(support::refusal([&] { scene.setLiquidDensity(value); })));
    }
    // Nothing is wet here.
    for (const int what : {0, 1}) {
        Species<LinearViscoelastic> dry;
        dry.setDensity(2500), dry.setStiffness(100), dry.setDissipation(0);
        scenes::FewGrains<Species<LinearViscoelastic>> scene(dry, {{.radius = r}}, 1e-6);
        scene.setQuiet();
        if (what == 0) scene.setEvaporation(flux(1));
        else scene.setLiquidDensity(1000);
        const std::string text = support::refusal([&] { scene.initialise(); });
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "no species of this scene moves liquid"));
    }
}

}  // namespace
}  // namespace pendular::dryingTest
