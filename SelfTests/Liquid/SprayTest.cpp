// Sprays: what comes out, how it flies, and what catches it; the oracles are closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::sprayTest {
namespace {

using Wet = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;

constexpr double r = 1e-3;           // m
constexpr double dropRadius = 1e-4;  // m
constexpr double g = 9.81;           // m/s^2

Wet material(double wallDose = 0) {
    Wet species;
    species.setDensity(2500);
    species.setStiffness(1);
    species.setDissipation(0);
    species.setLiquidBridgeVolumeMax(1e-11);
    species.setWallLiquidVolume(wallDose);
    species.setContactAngle(0);
    species.setSurfaceTension(0.07);
    return species;
}

struct Place {
    Vec3D position;
    double radius = r;
    bool fixed = true;
    Vec3D velocity = Vec3D::Zero();
};

/// Grains, and planes, under a spray.
class Sprayed : public scenes::FewGrains<Wet> {
public:
    Sprayed(const std::vector<Place>& places, const std::vector<scenes::PlaneAt>& planes, double step,
            const Spray& spray, double wallDose = 0)
        : FewGrains<Wet>(material(wallDose), {}, step, planes) {
        for (const Place& place : places) {
            SphericalParticle grain;
            grain.setSpecies(speciesHandler.getObject(0));
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            grain.setVelocity(place.velocity);
            if (place.fixed) grain.fixParticle();
            particleHandler.copyAndAddObject(grain);
        }
        sprayHandler.copyAndAddObject(spray);
        setQuiet();
        setTimeMax(1);
    }
    /// Until no droplet flies any more and none comes; the ledger is checked in each step.
    void runDry(double from, std::size_t most = 100000) {
        for (std::size_t k = 0; k < most && (getTime() < from || !sprayHandler.droplets().empty()); ++k) {
            step();
            ASSERT_EQ(liquidLedger().unaccounted(), 0);
            for (const CaughtDroplet& caught : sprayHandler.caught()) all.push_back(caught);
        }
    }
    std::vector<CaughtDroplet> all;
};

Spray oneDrop(const Vec3D& from, const Vec3D& towards, double speed) {
    Spray spray;
    spray.setRain(from, Vec3D::Zero(), Vec3D::Zero(), towards);
    spray.setDropletRadius(dropRadius);
    spray.setSpeed(speed);
    // The only one comes out at 1e-4 s.
    spray.setFlow(spray.dropletVolume() / 1e-4);
    spray.setTimes(0, 1.5e-4);
    return spray;
}

TEST(Spray, emitsByTheClock) {
    Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 1);
    spray.setTimes(0.5, 2);
    const double volume = spray.dropletVolume();
    EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * 1e-12, 1e-26);
    spray.setFlow(1000 * volume);
    for (const double time : {0.0, 0.4, 0.5, 0.6789, 1.23456, 2.0, 3.0}) {
        const double lasted = std::min(time, 2.0) - 0.5;
        EXPECT_EQ(spray.countAt(time),
                  lasted > 0 ? static_cast<std::uint64_t>(std::floor(1000 * volume * lasted / volume)) : 0u);
    }
    EXPECT_NEAR(spray.timeOf(0), 0.501, 1e-12);
    EXPECT_NEAR(spray.volumeBy(100), 1500 * volume, 1e-9 * volume);
}

/// The droplets are the same for any step: number, place, velocity, and where they are at a time.
TEST(Spray, isTheSameForAnyStep) {
    Spray spray;
    spray.setCone({0.01, 0.02, 0.03}, {1, 1, 0}, 0.8);
    spray.setDropletRadius(dropRadius);
    spray.setSpeed(2);
    spray.setVolumeSpread(0.3);
    spray.setFlow(1003.5 * spray.dropletVolume());
    std::vector<Droplet> reference;
    for (const double step : {1e-3, 5e-4, 1e-5}) {
        Sprayed scene({{{5, 5, 5}}}, {}, step, spray);
        scene.setGravity({0, 0, -g});
        scene.initialise();
        while (scene.getTime() < 0.05 - 0.1 * step) scene.step();
        EXPECT_EQ(scene.sprayHandler.countOf(0), 50u);
        EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
        EXPECT_NEAR(scene.liquidLedger().airborne / (50 * spray.dropletVolume()), 1, 0.2);
        const std::vector<Droplet>& now = scene.sprayHandler.droplets();
        ASSERT_EQ(now.size(), 50u);
        if (reference.empty()) {
            reference = now;
            for (std::size_t k = 0; k < now.size(); ++k) {
                const NewDroplet made = spray.droplet(k, 0);
                const double time = 0.05 - spray.timeOf(k);
                const Vector<double> wanted =
                    made.position + time * made.velocity - Vector<double>{0, 0, 0.5 * g * time * time};
                EXPECT_LT(norm(now[k].position - wanted), 1e-14);
            }
        }
        for (std::size_t k = 0; k < now.size(); ++k) {
            // Round-off of 5000 steps.
            EXPECT_LT(norm(now[k].position - reference[k].position), 1e-13);
            EXPECT_LT(norm(now[k].velocity - reference[k].velocity), 1e-11);
            EXPECT_EQ(now[k].volume, reference[k].volume);
        }
    }
}

TEST(Spray, shapesAreEven) {
    constexpr int count = 20000;
    const auto mean = [&](const Spray& spray, auto&& number) {
        double sum = 0;
        for (int k = 0; k < count; ++k) sum += number(spray.droplet(static_cast<std::uint64_t>(k), 3));
        return sum / count;
    };
    // A mean of n even numbers of width w errs by w/sqrt(12 n); four times that.
    const auto tolerance = [&](double width) { return 4 * width / std::sqrt(12.0 * count); };
    Spray spray;
    spray.setDropletRadius(dropRadius), spray.setSpeed(3), spray.setFlow(1e-9);
    spray.setFlatFan({0, 0, 0}, {0, 0, -2}, {5, 0, 1}, 1.2);
    const auto angleOf = [](const NewDroplet& d) {
        EXPECT_NEAR(norm(d.velocity), 3, 1e-14) << "constant speed";
        EXPECT_EQ(d.velocity.y, 0);
        return std::atan2(d.velocity.x, -d.velocity.z);
    };
    EXPECT_NEAR(mean(spray, angleOf), 0, tolerance(1.2));
    EXPECT_NEAR(mean(spray, [&](const NewDroplet& d) { return std::abs(angleOf(d)); }), 0.3, tolerance(0.6));
    spray.setCone({0, 0, 0}, {0, 0, 1}, 1.2);
    const double least = std::cos(0.6);
    const auto cosine = [&](const NewDroplet& d) {
        EXPECT_NEAR(norm(d.velocity), 3, 1e-14);
        EXPECT_GE(d.velocity.z / 3, least - 1e-15);
        return d.velocity.z / 3;
    };
    EXPECT_NEAR(mean(spray, cosine), 0.5 * (1 + least), tolerance(1 - least));
    EXPECT_NEAR(mean(spray, [&](const NewDroplet& d) { return std::atan2(d.velocity.y, d.velocity.x); }), 0,
                tolerance(2 * std::numbers::pi));
    spray.setRain({1, 2, 3}, {0.4, 0, 0}, {0, 0.2, 0}, {0, 0, -1});
    EXPECT_NEAR(mean(spray, [](const NewDroplet& d) { return d.position.x; }), 1, tolerance(0.4));
    EXPECT_NEAR(mean(spray, [](const NewDroplet& d) { return d.position.y; }), 2, tolerance(0.2));
    // Volumes: mean 1, relative spread 0.4.
    spray.setVolumeSpread(0.4);
    const auto volume = [](const NewDroplet& d) { return std::pow(d.radius / dropRadius, 3); };
    const double width = 2 * std::sqrt(3.0) * 0.4;
    EXPECT_NEAR(mean(spray, volume), 1, tolerance(width));
    const double square = mean(spray, [&](const NewDroplet& d) { return std::pow(volume(d) - 1, 2); });
    EXPECT_NEAR(square, 0.16, tolerance(width * width / 4 * std::sqrt(12.0 / 5)));
    EXPECT_NE(spray.droplet(7, 0).position.x, spray.droplet(7, 1).position.x) << "each spray has its own";
}

/// From H = 0.1 m at 1 m/s it lands at x = sqrt(2 H/g) v = 0.142784 m.
TEST(Spray, landsWhereAFreeBodyDoes) {
    for (const double step : {1e-3, 3.3e-4, 1e-5}) {
        Sprayed scene({{{5, 5, 5}}}, {{{0, 0, -1}, {0, 0, 0}}}, step,
                      oneDrop({0, 0, 0.1 + dropRadius}, {1, 0, 0}, 1));
        scene.setGravity({0, 0, -g});
        scene.initialise();
        scene.runDry(2e-4);
        ASSERT_EQ(scene.all.size(), 1u);
        EXPECT_EQ(scene.all[0].wall, 0);
        // The chord of a step is off by g dt^2/8 and the wall is met within 1e-4 of the radius, both over the
        // speed of the fall, 1.4 m/s.
        const double fall = std::sqrt(2 * g * 0.1);
        EXPECT_NEAR(scene.all[0].position.x, 0.142784,
                    (g * step * step / 8 + 1e-4 * dropRadius) / fall + 5e-7);
        EXPECT_GT(scene.liquidLedger().lost, 0) << "a dry wall";
        EXPECT_EQ(scene.liquidLedger().lost, scene.liquidLedger().emitted);
    }
}

TEST(Spray, doesNotFlyThroughAGrain) {
    // It goes 5 r in a step.
    const double speed = 50, step = 5 * r / speed;
    for (const double off :
         {0.0, 0.9 * (r + dropRadius), 0.9999 * (r + dropRadius), 1.0001 * (r + dropRadius)}) {
        Spray spray = oneDrop({0, off, 0}, {1, 0, 0}, speed);
        spray.setLongestFlight(20 * step);
        Sprayed scene({{{0.0312, 0, 0}}, {{0.05, 0, 0}}}, {}, step, spray);
        scene.initialise();
        scene.runDry(2e-4);
        const bool hits = off < r + dropRadius;
        ASSERT_EQ(scene.all.size(), 1u);
        EXPECT_EQ(scene.all[0].particle, hits ? 0 : CaughtDroplet::none);
        if (!hits) continue;
        const double reach = r + dropRadius;
        EXPECT_NEAR(scene.all[0].position.x, 0.0312 - std::sqrt(reach * reach - off * off), 1e-12);
        EXPECT_EQ(scene.particleHandler.getObject(0).getLiquidVolume(), scene.all[0].volume);
        EXPECT_EQ(scene.liquidLedger().films, scene.liquidLedger().emitted);
    }
}

/// Two grains that it meets at the same time: the one with the lower number, whatever the order in memory.
TEST(Spray, theLowerNumberCatchesIt) {
    for (const double side : {1.0, -1.0}) {
        Sprayed scene({{{0.02, side * r, 0}}, {{0.02, -side * r, 0}}}, {}, 1e-4,
                      oneDrop({0, 0, 0}, {1, 0, 0}, 10));
        scene.initialise();
        scene.runDry(2e-4);
        ASSERT_EQ(scene.all.size(), 1u);
        EXPECT_EQ(scene.all[0].particle, 0u);
    }
}

TEST(Spray, meetsGrainsThatMove) {
    // The grain crosses its way: relative to it, the droplet comes from the side, 0.5 mm off its middle.
    Sprayed scene({{{0.01, -0.01 - 0.0005, 0}, r, false, {0, 10, 0}}}, {}, 1e-4,
                  oneDrop({0, 0, 0}, {1, 0, 0}, 10));
    scene.initialise();
    // The droplet starts 1e-4 s later than the grain.
    scene.particleHandler.getObject(0).setPosition({0.01, -0.01 - 0.0005 - 1e-3, 0});
    scene.runDry(2e-4);
    ASSERT_EQ(scene.all.size(), 1u);
    EXPECT_EQ(scene.all[0].particle, 0u);
    const double reach = r + dropRadius;
    // In the frame of the grain: off the middle by 0.5 mm/sqrt(2); hit when along the way they are
    // sqrt(reach^2
    // - off^2) apart.
    const double off = 0.0005 / std::sqrt(2.0);
    const double along = 0.01 * std::sqrt(2.0) + off - std::sqrt(reach * reach - off * off);
    EXPECT_NEAR(scene.all[0].position.x, along / std::sqrt(2.0), 1e-9);
}

TEST(Spray, handsOverItsMomentum) {
    for (const double density : {0.0, 1000.0}) {
        Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 10);
        if (density > 0) spray.setMomentum(density);
        Sprayed scene({{{0.0105, 0, 0}, r, false}}, {}, 1e-4, spray);
        scene.keepEnergyLedger();
        scene.initialise();
        const double before = scene.energyLedger().closed();
        scene.runDry(2e-4);
        const double mass = scene.getTotalMass(), drop = density * scene.all.at(0).volume;
        EXPECT_NEAR(scene.motion(0).velocity.x(), 10 * drop / (mass + drop), 1e-12);
        scene.step();
        EXPECT_NEAR(scene.energyLedger().closed(), before, 1e-12 * (scene.energyLedger().kinetic + 1e-300));
        EXPECT_NEAR(scene.energyLedger().driver, scene.getKineticEnergy(), 1e-12 * scene.getKineticEnergy());
    }
}

TEST(Spray, wallsAreDryOrWet) {
    for (const double dose : {0.0, 1e-12}) {
        Sprayed scene({{{5, 5, 5}}}, {{{1, 0, 0}, {0.01, 0, 0}}}, 1e-4, oneDrop({0, 0, 0}, {1, 0, 0}, 10),
                      dose);
        scene.initialise();
        scene.runDry(2e-4);
        const LiquidLedger ledger = scene.liquidLedger();
        EXPECT_EQ(ledger.walls, dose > 0 ? ledger.emitted : 0);
        EXPECT_EQ(ledger.lost, dose > 0 ? 0 : ledger.emitted);
        EXPECT_EQ(scene.liquidOfWall(0), ledger.walls);
        EXPECT_NEAR(scene.all.at(0).position.x, 0.01 - dropRadius, 1e-4 * dropRadius);
    }
}

/// A thin sheet of triangles in its way, turned by 45 degrees; and none through its edge.
TEST(Spray, meetsMeshes) {
    for (const double height : {0.0, 0.0049, 0.02}) {
        Spray spray = oneDrop({0, 0, height}, {1, 0, 0}, 10);
        spray.setLongestFlight(0.01);
        Sprayed scene({{{5, 5, 5}}}, {}, 1e-3, spray);
        TriangleWall wall;
        const Vector<double> a{0.015, -0.005, -0.005}, b{0.015, 0.005, -0.005}, c{0.025, 0.005, 0.005},
            d{0.025, -0.005, 0.005};
        wall.set(std::vector<Triangle>{{a, b, c}, {a, c, d}});
        wall.setSpecies(scene.speciesHandler.getObject(0));
        scene.wallHandler.copyAndAddObject(wall);
        scene.initialise();
        scene.runDry(2e-4);
        ASSERT_EQ(scene.all.size(), 1u);
        EXPECT_EQ(scene.all[0].wall, height < 0.01 ? 0 : -1);
        if (height < 0.01) {
            // The plane x = 0.02 + z, at a distance of the radius.
            EXPECT_NEAR(scene.all[0].position.x, 0.02 + height - std::sqrt(2.0) * dropRadius,
                        2e-4 * dropRadius);
        }
    }
}

TEST(Spray, goesRoundAPeriodicScene) {
    Spray spray = oneDrop({0.009, 0, 0}, {1, 0, 0}, 10);
    Sprayed scene({{{0.004, 0, 0}}}, {}, 1e-4, spray);
    scene.setPeriodic(0, 0, 0.01);
    scene.initialise();
    scene.runDry(2e-4);
    ASSERT_EQ(scene.all.size(), 1u);
    EXPECT_EQ(scene.all[0].particle, 0u);
    EXPECT_NEAR(scene.getTime(), 1e-4 + (0.005 - r - dropRadius) / 10, 1e-4);
}

// Rain on a lattice: what each grain gets is counted by Poisson.

/// 400 grains, 3 mm apart, above a floor.
std::vector<Place> lattice(double small = r) {
    std::vector<Place> places;
    for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 20; ++y)
            places.push_back({{3e-3 * (x + 0.5), 3e-3 * (y + 0.5), 0}, (x + y) % 2 == 0 ? r : small});
    return places;
}

Spray rainOnLattice(std::size_t count, double spread = 0) {
    Spray spray;
    spray.setRain({0.03, 0.03, 0.01}, {0.06, 0, 0}, {0, 0.06, 0}, {0, 0, -1});
    spray.setDropletRadius(dropRadius);
    spray.setSpeed(1);
    spray.setVolumeSpread(spread);
    spray.setFlow(static_cast<double>(count) * spray.dropletVolume() / 0.1);
    spray.setTimes(0, 0.1 * (1 + 1e-9));
    return spray;
}

struct Counts {
    std::vector<double> drops, liquid;  // of each grain
    double onGrains = 0;
};

Counts rain(const std::vector<Place>& places, const Spray& spray) {
    Sprayed scene(places, {{{0, 0, -1}, {0, 0, -0.002}}}, 1e-3, spray);
    scene.initialise();
    scene.runDry(0.1005);
    Counts counts{std::vector<double>(places.size(), 0), {}};
    for (const CaughtDroplet& caught : scene.all)
        if (caught.particle != CaughtDroplet::none) ++counts.drops[caught.particle], ++counts.onGrains;
    for (auto&& grain : scene.particleHandler)
        counts.liquid.push_back(grain.getLiquidVolume() / spray.dropletVolume());
    EXPECT_EQ(scene.all.size(), scene.sprayHandler.countOf(0));
    return counts;
}

double meanOf(const std::vector<double>& numbers) {
    double sum = 0;
    for (const double x : numbers) sum += x;
    return sum / static_cast<double>(numbers.size());
}
double relativeDeviation(const std::vector<double>& numbers) {
    double sum = 0;
    const double mean = meanOf(numbers);
    for (const double x : numbers) sum += (x - mean) * (x - mean);
    return std::sqrt(sum / static_cast<double>(numbers.size())) / mean;
}

TEST(Spray, rainOnALatticeIsCaughtByItsShadow) {
    constexpr std::size_t count = 40000;
    const Counts counts = rain(lattice(), rainOnLattice(count));
    const double share = std::numbers::pi * std::pow(1.1 / 3, 2);
    EXPECT_NEAR(share, 0.422370, 5e-7);
    EXPECT_NEAR(counts.onGrains / count, share, 4 * std::sqrt(share * (1 - share) / count));
    // The number of a grain obeys Poisson's law, to the binomial's 1 - p with p = 1e-3: variance = mean. The
    // variance of n such numbers errs by its sqrt(2/n).
    const double n = static_cast<double>(counts.drops.size()), mean = meanOf(counts.drops);
    EXPECT_NEAR(std::pow(relativeDeviation(counts.drops), 2) * mean, 1, 4 * std::sqrt(2 / n));
}

/// lambda drops a grain: dry fraction exp(-lambda), relative deviation of the liquid sqrt((1 + s^2)/lambda).
TEST(Spray, fewDropsLeaveGrainsDry) {
    for (const double lambda : {1.0, 3.0, 10.0})
        for (const double spread : {0.0, 0.5}) {
            const auto count = static_cast<std::size_t>(400 * lambda / 0.422370);
            const Counts counts = rain(lattice(), rainOnLattice(count, spread));
            const double n = 400, own = meanOf(counts.drops);
            EXPECT_NEAR(own, lambda, 4 * std::sqrt(lambda / n));
            const double dry = static_cast<double>(std::ranges::count(counts.drops, 0.0)) / n;
            EXPECT_NEAR(dry, std::exp(-own), 4 * std::sqrt(std::exp(-own) / n));
            const double wanted = std::sqrt((1 + spread * spread) / own);
            // Error of a relative deviation of n numbers: (1/sqrt(2 n)) sqrt(1 + kurtosis/2 + ...) of it,
            // with excess kurtosis 1/lambda of Poisson's law: below 1.5/sqrt(2 n) from lambda = 1 on.
            EXPECT_NEAR(relativeDeviation(counts.liquid) / wanted, 1, 4 * 1.5 / std::sqrt(2 * n));
        }
}

TEST(Spray, largeGrainsCatchMore) {
    constexpr std::size_t count = 40000;
    const Counts counts = rain(lattice(0.5 * r), rainOnLattice(count));
    double large = 0, small = 0;
    for (std::size_t k = 0; k < counts.drops.size(); ++k)
        ((k / 20 + k % 20) % 2 == 0 ? large : small) += counts.drops[k];
    const double ratio = std::pow(1.1 / 0.6, 2);
    EXPECT_NEAR(large / small, ratio, 4 * ratio * std::sqrt(1 / large + 1 / small));
}

// The bits.

using Box = wet::WetBox<Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>>;

/// A box that settles under two sprays, with momentum; drops and films dry.
class SprayedBox : public Box {
public:
    explicit SprayedBox(int layers, int threads = 1) : Box(layers, threads) {
        Spray cone;
        cone.setCone({0.006, 0.006, 0.003 * (layers + 1)}, {0, 0, -1}, 2.0);
        cone.setDropletRadius(dropRadius);
        cone.setSpeed(1);
        cone.setVolumeSpread(0.2);
        cone.setMomentum(1000);
        cone.setFlow(0.4 * cone.dropletVolume() / getTimeStep());
        cone.setLongestFlight(0.05);
        sprayHandler.copyAndAddObject(cone);
        Spray fan;
        fan.setFlatFan({0.005, 0.002, 0.003 * (layers + 1)}, {0, 0.1, -1}, {1, 0, 0}, 1.5);
        fan.setDropletRadius(0.7 * dropRadius);
        fan.setSpeed(2);
        fan.setFlow(0.3 * fan.dropletVolume() / getTimeStep());
        fan.setLongestFlight(0.05);
        sprayHandler.copyAndAddObject(fan);
        Evaporation law;
        law.setFlux(1e-6);
        law.setDiffusion(2.5e-5, 8.6e-3, 998);
        law.setInterval(10);
        setEvaporation(law);
        setLiquidDensity(1000);
        setTimeMax(1200 * getTimeStep());
    }
};

TEST(Spray, isConservedInABoxThatSettles) {
    SprayedBox box(4);
    box.initialise();
    double most = 0;
    for (int k = 0; k < 1200; ++k) {
        box.step();
        const LiquidLedger ledger = box.liquidLedger();
        ASSERT_EQ(ledger.unaccounted(), 0) << k;
        most = std::max(most, ledger.airborne);
    }
    const LiquidLedger ledger = box.liquidLedger();
    EXPECT_EQ(box.sprayHandler.countOf(0), box.sprayHandler.getObject(0).countAt(box.getTime()));
    EXPECT_GT(box.sprayHandler.countOf(0), 470u);
    EXPECT_GT(most, 0);
    EXPECT_GT(ledger.evaporated, 0);
    EXPECT_GT(ledger.films + ledger.bridges, ledger.initial) << "more has come than has dried";
}

TEST(Spray, doesNotDependOnThreadsOrRestarts) {
    const support::TestFolder folder;
    wet::expectSameBits<SprayedBox>(folder.path(), {0, 250, 251, 700}, 1000, 700, 720);
}

/// The mass of a film is its grain's, and that of liquid in bridges nobody's.
TEST(Spray, filmsHaveMassIfAskedFor) {
    Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 10);
    Sprayed scene({{{0.0105, 0, 0}, r, false}}, {}, 1e-4, spray);
    scene.setLiquidDensity(1000);
    scene.particleHandler.getObject(0).setLiquidVolume(1e-12);
    scene.initialise();
    const double solid = 4.0 / 3 * std::numbers::pi * r * r * r * 2500;
    EXPECT_NEAR(scene.getTotalMass(), solid + 1e-9, 1e-12 * solid);
    scene.runDry(2e-4);
    EXPECT_NEAR(scene.getTotalMass(), solid + 1000 * (1e-12 + scene.all.at(0).volume), 1e-12 * solid);
}

// Bad input.

TEST(Spray, refusesBadFields) {
    using support::contains;
    using support::isOneSentence;
    using support::refusal;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> zero{0, -1, nan, infinity, -infinity}, below{-1, nan, infinity, -infinity},
        notFinite{nan, infinity, -infinity};
    struct Case {
        const char* field;
        void (*set)(Spray&, double);
        std::vector<double> wrong;
    };
    using S = Spray;
    const Case cases[] = {
        {"flow", [](S& s, double v) { s.setFlow(v); }, zero},
        {"droplet radius", [](S& s, double v) { s.setDropletRadius(v); }, zero},
        {"speed", [](S& s, double v) { s.setSpeed(v); }, below},
        {"volume spread", [](S& s, double v) { s.setVolumeSpread(v); }, {-0.1, 0.51, nan, infinity}},
        {"first time", [](S& s, double v) { s.setTimes(v, 1); }, below},
        {"last time", [](S& s, double v) { s.setTimes(1, v); }, {0.5, nan, infinity, -infinity}},
        {"density of the liquid", [](S& s, double v) { s.setMomentum(v); }, zero},
        {"longest flight", [](S& s, double v) { s.setLongestFlight(v); }, zero},
        {"angle",
         [](S& s, double v) {
             s.setCone({0, 0, 0}, {1, 0, 0}, v);
         },
         {0, -1, 6.3, nan, infinity}},
        {"angle",
         [](S& s, double v) {
             s.setFlatFan({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, v);
         },
         {0, -1, 3.15, nan, infinity}},
        {"nozzle",
         [](S& s, double v) {
             s.setCone({v, 0, 0}, {1, 0, 0}, 1);
         },
         notFinite},
        {"nozzle",
         [](S& s, double v) {
             s.setFlatFan({0, v, 0}, {1, 0, 0}, {0, 1, 0}, 1);
         },
         notFinite},
        {"direction",
         [](S& s, double v) {
             s.setCone({0, 0, 0}, {v, 0, 0}, 1);
         },
         {0, nan, infinity}},
        {"direction",
         [](S& s, double v) {
             s.setFlatFan({0, 0, 0}, {0, v, 0}, {1, 0, 0}, 1);
         },
         {0, nan, infinity}},
        {"across",
         [](S& s, double v) {
             s.setFlatFan({0, 0, 0}, {1, 0, 0}, {0, v, 0}, 1);
         },
         {0, nan, infinity}},
        {"across",
         [](S& s, double v) {
             s.setFlatFan({0, 0, 0}, {1, 0, 0}, {1 + v, 0, 0}, 1);
         },
         {0}},
        {"middle",
         [](S& s, double v) {
             s.setRain({0, 0, v}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
         },
         notFinite},
        {"edge1",
         [](S& s, double v) {
             s.setRain({0, 0, 0}, {v, 0, 0}, {0, 1, 0}, {0, 0, 1});
         },
         notFinite},
        {"edge2",
         [](S& s, double v) {
             s.setRain({0, 0, 0}, {1, 0, 0}, {0, v, 0}, {0, 0, 1});
         },
         notFinite},
        {"direction",
         [](S& s, double v) {
             s.setRain({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, v});
         },
         {0, nan, infinity}}};
    for (const Case& c : cases)
        for (const double value : c.wrong) {
            S spray;
            const std::string text = refusal([&] { c.set(spray, value); });
            EXPECT_TRUE(isOneSentence(text)) << c.field << ' ' << value;
            EXPECT_TRUE(contains(text, c.field));
        }
    // What is missing.
    Spray part;
    const auto missing = [&](const char* what) {
        SprayHandler handler;
        const std::string text = refusal([&] { handler.copyAndAddObject(part); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, what));
    };
    missing("shape");
    part.setCone({0, 0, 0}, {1, 0, 0}, 1), missing("flow");
    part.setFlow(1e-9), missing("radius");
    part.setDropletRadius(dropRadius), missing("speed");
}

TEST(Spray, refusesWhatCannotBeCounted) {
    using support::contains;
    using support::isOneSentence;
    using support::refusal;
    const auto refusalOf = [](double flow, double radius, double toCome = unset) {
        Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 10);
        spray.setDropletRadius(radius);
        spray.setFlow(flow);
        spray.setTimes(0, 1);
        Sprayed scene({{{5, 5, 5}}}, {}, 1e-4, spray);
        if (isSet(toCome)) scene.setLiquidToCome(toCome);
        return refusal([&] { scene.initialise(); });
    };
    EXPECT_EQ(refusalOf(1e-9, dropRadius), "");
    EXPECT_EQ(refusalOf(1e-9, dropRadius, 1.1e-9), "");
    const std::string tooMuch = refusalOf(1e6, dropRadius);
    EXPECT_TRUE(isOneSentence(tooMuch));
    EXPECT_TRUE(contains(tooMuch, "spray 0: its droplets"));
    const std::string tooSmall = refusalOf(1e-9, 1e-10);
    EXPECT_TRUE(isOneSentence(tooSmall));
    const std::string moreThanSaid = refusalOf(1e-9, dropRadius, 0.9e-9);
    EXPECT_TRUE(isOneSentence(moreThanSaid));
    EXPECT_TRUE(contains(moreThanSaid, "liquid to come = 9e-10 m^3, but the sprays emit up to 1e-09 m^3"));

    const auto endOf = [](Sprayed& scene) {
        try {
            for (int k = 0; k < 10; ++k) scene.step();
        } catch (const RunError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    {  // A run that is made longer than it was said.
        Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 10);
        spray.setFlow(1e6 * spray.dropletVolume());
        spray.setTimes(0, 1);
        Sprayed scene({{{5, 5, 5}}}, {}, 1e-4, spray);
        scene.speciesHandler.getObject(0)->setLiquidBridgeVolumeMax(1e-30);
        scene.setTimeMax(1e-4);
        scene.initialise();
        const std::string text = endOf(scene);
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "setLiquidToCome()"));
        EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    }
    {  // More droplets than memory.
        Spray spray = oneDrop({0, 0, 0}, {1, 0, 0}, 10);
        spray.setFlow(1e12 * spray.dropletVolume());
        spray.setTimes(0, 1);
        Sprayed scene({{{5, 5, 5}}}, {}, 1e-4, spray);
        scene.initialise();
        const std::string text = endOf(scene);
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "droplets come out in a step"));
    }
    {  // In a run.
        Sprayed scene({{{5, 5, 5}}}, {}, 1e-4, oneDrop({0, 0, 0}, {1, 0, 0}, 10));
        scene.initialise();
        EXPECT_TRUE(isOneSentence(refusal([&] {
            scene.sprayHandler.copyAndAddObject(oneDrop({0, 0, 0}, {1, 0, 0}, 10));
        })));
        EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene.sprayHandler.getObject(1)); })));
        EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene.sprayHandler.countOf(1)); })));
    }
    {  // Where nothing is wet.
        Species<LinearViscoelastic> dry;
        dry.setDensity(2500), dry.setStiffness(100), dry.setDissipation(0);
        scenes::FewGrains<Species<LinearViscoelastic>> scene(dry, {{.radius = r}}, 1e-6);
        scene.setQuiet();
        scene.sprayHandler.copyAndAddObject(oneDrop({0, 0, 0}, {1, 0, 0}, 10));
        const std::string text = refusal([&] { scene.initialise(); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "no species of this scene moves liquid"));
    }
}

}  // namespace
}  // namespace pendular::sprayTest
