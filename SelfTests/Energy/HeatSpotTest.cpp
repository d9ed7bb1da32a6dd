#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// The radius of the spot by which contacts of several laws conduct, and what each wall gives.

namespace pendular::heatSpotTest {
namespace {

using support::contains;

constexpr double radius = 1e-3, conductivity = 1, capacity = 800;  // SI
constexpr double density = 2500, mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
constexpr double step = 1e-9;  // s, in which grains at rest move by less than a millionth of their overlaps

/// Two grains that overlap, or are drawn apart where that is negative, the second over a plane of the same
/// overlap.
template <class S>
struct WarmPair : scenes::FewGrains<S> {
    WarmPair(const S& species, double overlap)
        : scenes::FewGrains<S>(species,
                               {{.radius = radius, .position = {0, 0, 2 * radius - overlap}},
                                {.radius = radius, .position = {0, 0, 0}}},
                               step, {{{0, 0, -1}, {0, 0, overlap - radius}}}) {
        heat.setMaterial(this->speciesHandler.getObject(0), {conductivity, capacity});
        temperature[0] = 400;
        this->acceptOverlaps(0.25);
    }
    /// W/K, of the contact of the grains and of that at the wall, by the heat of a step.
    std::array<double, 2> conductances() {
        heat.holdWall(0, 500);
        this->initialise();
        this->step();
        return {-mass * capacity * (temperature[0] - 400) / (step * 100), heat.fromWall(0) / (step * 200)};
    }
    GrainColumnReference temperature = this->particleHandler.addColumn("temperature", "K", 300);
    HeatPart& heat = this->template addPart<HeatPart>(temperature);
};

/// H = 2 k a of two grains, 4 k a at a plane that has no resistance of its own, with a by R* = R/2 and R.
template <class S, class Radius>
void expectSpots(const S& species, double overlap, const Radius& spotOf) {
    WarmPair<S> pair(species, overlap);
    const auto [ofGrains, atWall] = pair.conductances();
    // The heat of a step is 1e-9 of what the grain holds, with 1e-16 of that as round-off; the grains move.
    EXPECT_NEAR(ofGrains / (2 * conductivity * spotOf(0.5 * radius)), 1, 1e-5) << S::name;
    EXPECT_NEAR(atWall / (4 * conductivity * spotOf(radius)), 1, 1e-5) << S::name;
    EXPECT_NEAR(pair.heat.conductance(0, 0, 0.5 * radius, overlap, 2 * radius) /
                    (2 * conductivity * spotOf(0.5 * radius)),
                1, 1e-12);
}

template <class S>
S ofDensity() {
    S species;
    species.setDensity(density);
    return species;
}

// The necks of the page on sintering: x^2 = R d of equal grains, 2 R* d, at a constant rate; x^2 = 2 R d of
// diffusion, 4 R* d. Hertz's spot sqrt(R* d) is 1.41 and 2 times too small. With R = 1 mm and d = 0.2 mm, 1
// W/(m K): 6.32e-4 W/K by Hertz's, 8.94e-4 and 1.26e-3 by the necks.
TEST(HeatSpot, necksOfSinteredGrainsConduct) {
    constexpr double overlap = 2e-4;
    const auto lens = [](double reduced) { return std::sqrt(2 * reduced * overlap); };
    const auto coble = [](double reduced) { return std::sqrt(4 * reduced * overlap); };
    EXPECT_NEAR(2 * lens(0.5 * radius), 8.94e-4, 1e-6);
    EXPECT_NEAR(2 * coble(0.5 * radius), 1.26e-3, 1e-5);
    auto sinter = ofDensity<SinterSpecies>();
    sinter.setPlasticParameters(1e-3, 1e-3, 0, 1);
    sinter.setSinterType(SinterType::ConstantRate);
    expectSpots(sinter, overlap, lens);
    sinter.setSinterType(SinterType::GrainBoundaryDiffusion);
    expectSpots(sinter, overlap, coble);
    auto hertzian = ofDensity<HertzianSinterSpecies>();
    hertzian.setPlasticParameters(1, 1, 0, 1);
    expectSpots(hertzian, overlap, lens);
    auto diffusing = ofDensity<HertzianViscoelasticParhamiMcMeekingSinterSpecies>();
    diffusing.setEffectiveElasticModulus(1), diffusing.setAdhesionCoefficient(0);
    expectSpots(diffusing, overlap, coble);
}

// Hertz's of Hertzian laws, and of others by the same overlap for want of their own.
TEST(HeatSpot, otherLawsHaveHertzsSpot) {
    constexpr double overlap = 1e-5;
    const auto hertz = [](double reduced) { return std::sqrt(reduced * overlap); };
    auto linear = ofDensity<LinearViscoelasticSpecies>();
    linear.setStiffness(1e-3);
    expectSpots(linear, overlap, hertz);
    auto spheres = ofDensity<HertzianViscoelasticSpecies>();
    spheres.setEffectiveElasticModulus(1);
    expectSpots(spheres, overlap, hertz);
}

// JKR's contact radius a at the force of the contact: a^3 = 3 R*/(4 E*) (F + 3 pi w R* + sqrt(6 pi w R* F +
// (3 pi w R*)^2)) (Johnson, Kendall and Roberts 1971). Also where the neck is stretched, until it snaps.
TEST(HeatSpot, necksOfStickySpheresConduct) {
    using S = HertzianViscoelasticJKRSpecies;
    auto species = ofDensity<S>();
    constexpr double modulus = 1e6, work = 0.05;
    species.setEffectiveElasticModulus(modulus), species.setWorkOfAdhesion(work);
    species.setAdhesionModulus(modulus);
    const JKR& law = species;
    const auto overlapOf = [&](double a, double reduced) {  // d = a^2/R* - sqrt(2 pi w a / E*)
        return a * a / reduced - std::sqrt(2 * std::numbers::pi * work * a / modulus);
    };
    const double reduced = 0.5 * radius;
    const double atRest = std::cbrt(4.5 * std::numbers::pi * work * reduced * reduced / modulus);
    for (const double share : {0.45, 1.0, 3.0}) {
        const double a = share * atRest, overlap = overlapOf(a, reduced);
        EXPECT_NEAR(law.neckAt({radius, radius}, overlap).radius / a, 1, 1e-9) << share;
    }
    const double a = 0.5 * atRest, stretched = overlapOf(a, reduced);
    ASSERT_LT(stretched, 0);
    // The neck forms at a touch; then its grains are drawn apart.
    WarmPair<S> pair(species, 1e-9);
    pair.initialise();
    pair.step();
    pair.particleHandler.getObject(0).setPosition({0, 0, 2 * radius - stretched});
    pair.particleHandler.getObject(1).setPosition({0, 0, 0});
    for (const std::size_t k : {0u, 1u}) pair.particleHandler.getObject(k).setVelocity({0, 0, 0});
    const double before = pair.temperature[0];
    pair.step();
    const double found = -mass * capacity * (pair.temperature[0] - before) / (step * 100);
    EXPECT_NEAR(found / (2 * conductivity * a), 1, 1e-4);
    // A stiffened grain at equal force: the same cube root as Hertz's, since F_c has no modulus.
    auto soft = species;
    soft.setEffectiveElasticModulus(1e-3 * modulus), soft.setAdhesionModulus(1e-3 * modulus);
    const auto contactOf = [&](const JKR& of, double e) {  // at no force
        const double wide = std::cbrt(4.5 * std::numbers::pi * work * reduced * reduced / e);
        return of
            .neckAt({radius, radius},
                    wide * wide / reduced - std::sqrt(2 * std::numbers::pi * work * wide / e))
            .radius;
    };
    EXPECT_NEAR(contactOf(soft, 1e-3 * modulus) / contactOf(law, modulus), 10, 1e-8);
}

template <class S>
std::string refusalOfSoftening(const S& species, Conduction conduction = Conduction::Constriction) {
    WarmPair<S> pair(species, 1e-6);
    pair.heat.setConduction(conduction);
    pair.heat.setSoftening(1e-3);
    return support::refusal([&] { pair.initialise(); });
}

// The cube root of the moduli is that of contact radii of spheres of these moduli, and of nothing else.
TEST(HeatSpot, softeningIsRefusedWhereItMeansNothing) {
    auto linear = ofDensity<LinearViscoelasticSpecies>();
    linear.setStiffness(1e-3);
    auto sinter = ofDensity<SinterSpecies>();
    sinter.setPlasticParameters(1e-3, 1e-3, 0, 1);
    auto hertz = ofDensity<HertzianViscoelasticSpecies>();
    hertz.setEffectiveElasticModulus(1);
    auto sticky = ofDensity<HertzianViscoelasticJKRSpecies>();
    sticky.setEffectiveElasticModulus(1e6), sticky.setWorkOfAdhesion(1e-9);
    for (const std::string& said : {refusalOfSoftening(linear), refusalOfSoftening(sinter)}) {
        EXPECT_TRUE(support::isOneSentence(said)) << said;
        EXPECT_TRUE(contains(said, "softening = 0.001")) << said;
        EXPECT_TRUE(contains(said, "species 0 and 0")) << said;
    }
    EXPECT_TRUE(contains(refusalOfSoftening(linear), "LinearViscoelasticSpecies"));
    EXPECT_TRUE(contains(refusalOfSoftening(hertz, Conduction::AreaOverDistance), "area over distance"));
    EXPECT_EQ(refusalOfSoftening(hertz), "");
    EXPECT_EQ(refusalOfSoftening(sticky), "");
    WarmPair<LinearViscoelasticSpecies> run(linear, 1e-6);
    run.initialise();
    run.step();
    run.heat.setSoftening(0.5);
    EXPECT_THROW(run.step(), RunError);
}

/// A row of grains between a hot and a cold wall, whose springs move nothing.
struct Row : scenes::FewGrains<LinearViscoelasticSpecies> {
    static constexpr int count = 5;
    static constexpr double overlap = 1e-6, spacing = 2 * radius - overlap;
    Row()
        : FewGrains(still(), row(), 15,
                    {{{-1, 0, 0}, {-radius + overlap, 0, 0}},
                     {{1, 0, 0}, {(count - 1) * spacing + radius - overlap, 0, 0}}}) {
        heat.setMaterial(speciesHandler.getObject(0), {conductivity, capacity});
        heat.holdWall(0, 400), heat.holdWall(1, 300);
    }
    static LinearViscoelasticSpecies still() {
        auto species = ofDensity<LinearViscoelasticSpecies>();
        species.setStiffness(1e-30);
        return species;
    }
    static std::vector<scenes::GrainMotion> row() {
        std::vector<scenes::GrainMotion> grains;
        for (int k = 0; k < count; ++k) grains.push_back({.radius = radius, .position = {k * spacing, 0, 0}});
        return grains;
    }
    [[nodiscard]] double stored() {
        double sum = 0;
        for (std::uint32_t k = 0; k < count; ++k) sum += mass * capacity * temperature[k];
        return sum;
    }
    GrainColumnReference temperature = particleHandler.addColumn("temperature", "K", 300);
    HeatPart& heat = addPart<HeatPart>(temperature);
};

// At rest the heat that leaves the hot wall comes to the cold one: their sum says nothing of it. The flux is
// 100 K over the resistances 2/(4 k a sqrt(2)) of the walls and 4/(2 k a) of the contacts, a of R* = R/2.
TEST(HeatSpot, eachWallHasItsSum) {
    Row row;
    const double start = row.stored();
    row.run(2000);
    const double hot = row.heat.fromWall(0), cold = row.heat.fromWall(1);
    EXPECT_NEAR((hot + cold) / (row.stored() - start), 1, 1e-10);
    EXPECT_NEAR((hot + cold) / row.heat.ledger().fromWalls, 1, 1e-11);  // 2000 sums that are rounded
    row.step(100);
    const double a = std::sqrt(0.5 * radius * Row::overlap);
    const double resistance = 2 / (4 * a * std::sqrt(2.0)) + 4 / (2 * a), flux = 100 / resistance;
    EXPECT_NEAR((row.heat.fromWall(0) - hot) / (100 * 15 * flux), 1, 1e-9);
    EXPECT_NEAR((row.heat.fromWall(1) - cold) / (100 * 15 * flux), -1, 1e-9);
    EXPECT_EQ(row.heat.fromWall(7), 0);
    EXPECT_EQ(row.heat.wallsOfHeat(), (std::vector{0, 1}));
}

// What a wall has given before it became an insulator stays, and goes through a restart file.
TEST(HeatSpot, sumsOfWallsGoOnWithTheRun) {
    const support::TestFolder folder;
    Row whole;
    whole.run(10);
    whole.heat.insulateWall(0);
    whole.step(5);
    whole.writeRestart(folder.path() / "half.h5");
    const double given = whole.heat.fromWall(0);
    EXPECT_GT(given, 0);
    whole.step(10);
    EXPECT_EQ(whole.heat.fromWall(0), given);
    Row second;
    second.restartFrom(folder.path() / "half.h5");
    second.initialise();
    EXPECT_EQ(second.heat.fromWall(0), given);
    second.step(10);
    EXPECT_EQ(second.heat.fromWall(0), given);
    EXPECT_EQ(second.heat.fromWall(1), whole.heat.fromWall(1));
    EXPECT_EQ(second.heat.ledger().fromWalls, whole.heat.ledger().fromWalls);
}

}  // namespace
}  // namespace pendular::heatSpotTest
