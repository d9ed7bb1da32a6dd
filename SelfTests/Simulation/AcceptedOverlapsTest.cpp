// Starts with overlaps that a driver accepts knowingly: a bed of soft grains that another run has settled.
#include <gtest/gtest.h>

#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::acceptedOverlapsTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::contains;
using support::isOneSentence;
using support::refusal;
using Hertz = Species<HertzianViscoelastic>;

constexpr double r = 1e-3, density = 2500, g = 9.81;  // m, kg/m^3, m/s^2
constexpr double modulus = 1.2e4;                     // E*, Pa: a bottom of five grains gives 10 %

Hertz soft() {
    Hertz species;
    species.setDensity(density);
    species.setEffectiveElasticModulus(modulus);
    species.setDissipation(0.5);
    return species;
}

/// Grains above a floor at z = 0.
class Bed : public FewGrains<Hertz> {
public:
    explicit Bed(const std::vector<GrainMotion>& grains)
        : FewGrains<Hertz>(soft(), grains, 5e-5, {{.normal = {0, 0, -1}, .point = {0, 0, 0}}}) {
        setQuiet();
        setGravity({0, 0, -g});
    }
};

/// Two grains that overlap by a share of the radius, and touch no floor.
std::vector<GrainMotion> pairOf(double share) {
    return {{.radius = r, .position = {0, 0, 5 * r}}, {.radius = r, .position = {0, 0, (7 - share) * r}}};
}

/// The refusal of a start; 0: nothing is accepted.
std::string start(const std::vector<GrainMotion>& grains, double accepted) {
    Bed bed(grains);
    if (accepted > 0) bed.acceptOverlaps(accepted);
    return refusal([&] { bed.initialise(); });
}

TEST(AcceptedOverlaps, areUpToTheShareThatIsGiven) {
    const std::string text = start(pairOf(0.1), 0);
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(
        contains(text, "is 10 % of the smaller radius; it must be at most 5 %, unless acceptOverlaps()"));
    EXPECT_EQ(start(pairOf(0.1), 0.3), "");
    EXPECT_EQ(start(pairOf(0.3), 0.3), "");
    EXPECT_TRUE(contains(start(pairOf(0.31), 0.3), "it must be at most 30 %"));
    EXPECT_TRUE(contains(start({{.radius = r, .position = {0, 0, 0.8 * r}}}, 0), "wall 0: initial overlap"));
    EXPECT_EQ(start({{.radius = r, .position = {0, 0, 0.8 * r}}}, 0.3), "");
    // Less than without it, too.
    EXPECT_TRUE(contains(start(pairOf(0.03), 0.01), "at most 1 %"));
}

// Of several, the deepest is named, wherever it stands in the list of contacts.
TEST(AcceptedOverlaps, nameTheDeepestOfSeveral) {
    const auto startWith = [](double third) {
        Bed bed({{.radius = r, .position = {0, 0, 5 * r}},
                 {.radius = r, .position = {0, 0, 6.9 * r}},
                 {.radius = r, .position = {0, 0, third * r}},
                 {.radius = r, .position = {9 * r, 0, 0.85 * r}}});
        return refusal([&] { bed.initialise(); });
    };
    EXPECT_TRUE(contains(startWith(8.7), "particle 1 and particle 2: initial overlap = 0.0002 m is 20 %"));
    EXPECT_TRUE(contains(startWith(8.85), "particle 3 and wall 0: initial overlap = 0.00015 m is 15 %"));
    EXPECT_TRUE(contains(startWith(3.2), "particle 0 and particle 2: initial overlap = 0.0002 m is 20 %"));
}

TEST(AcceptedOverlaps, areAShareUpToThatOfARun) {
    Bed bed(pairOf(0));
    EXPECT_EQ(refusal([&] { bed.acceptOverlaps(1); }), "");
    EXPECT_EQ(start(pairOf(0.5), 1), "");
    EXPECT_TRUE(contains(start(pairOf(0.6), 1), "at most 50 %."));
    for (const double share : {1.01, -0.1, infinity, std::nan("")}) {
        const std::string text = refusal([&] { bed.acceptOverlaps(share); });
        EXPECT_TRUE(isOneSentence(text)) << share;
        EXPECT_TRUE(contains(text, "accepted overlap")) << text;
    }
}

TEST(AcceptedOverlaps, areThoseOfGrainsThatComeInARun) {
    for (const double accepted : {0.05, 0.3}) {
        Bed bed(pairOf(0));
        bed.acceptOverlaps(accepted);
        bed.initialise();
        bed.step();
        SphericalParticle grain;
        grain.setSpecies(bed.speciesHandler.getObject(0));
        grain.setRadius(r);
        grain.setPosition(bed.motion(1).position + Vec3D(0, 0, 1.8 * r));
        bed.particleHandler.copyAndAddObject(grain);
        if (accepted < 0.2) EXPECT_THROW(bed.step(), RunError);
        else EXPECT_NO_THROW(bed.step(10));
    }
}

TEST(AcceptedOverlaps, areThoseOfClumps) {
    for (const bool accepts : {false, true}) {
        Bed bed({});
        const ClumpTemplate rod({{{-0.5 * r, 0, 0}, r}, {{0.5 * r, 0, 0}, r}});
        for (const double height : {5 * r, 6.8 * r}) {
            Clump clump(rod);
            clump.setSpecies(bed.speciesHandler.getObject(0));
            clump.setPosition({0, 0, height});
            bed.bodyHandler.copyAndAddObject(clump);
        }
        if (accepts) bed.acceptOverlaps(0.3);
        const std::string text = refusal([&] { bed.initialise(); });
        EXPECT_EQ(text.empty(), accepts) << text;
    }
}

/// A column of five grains lies at rest where the floor bears their weight: Hertz's overlap is
/// (3 F / (4 E* sqrt(R)))^(2/3), 10 % of the radius. It is taken up as it is, and stays at rest.
TEST(AcceptedOverlaps, takeUpABedThatHasSettled) {
    constexpr int count = 5;
    std::vector<GrainMotion> grains;
    for (int k = 0; k < count; ++k) grains.push_back({.radius = r, .position = {0, 0, (2 * k + 1) * r}});
    Bed settling(grains);
    settling.run(40000);
    const double weight = count * sphereMass(r, density) * g;
    const double overlap = std::pow(3 * weight / (4 * modulus * std::sqrt(r)), 2.0 / 3);
    EXPECT_GT(overlap, 0.09 * r);
    EXPECT_NEAR(r - settling.motion(0).position.z(), overlap, 1e-6 * r);

    for (const bool accepts : {false, true}) {
        Bed bed({});
        for (const GrainRow& row : grainRows(settling.particleHandler))
            addGrainRow(bed.particleHandler, bed.speciesHandler.getObject(0), row);
        if (accepts) bed.acceptOverlaps(0.3);
        const std::string text = refusal([&] { bed.initialise(); });
        EXPECT_EQ(text.empty(), accepts) << text;
        if (!accepts) continue;
        bed.step(1000);
        for (std::size_t k = 0; k < count; ++k)
            EXPECT_NEAR(bed.motion(k).position.z(), settling.motion(k).position.z(), 1e-6 * r) << k;
    }
}

}  // namespace
}  // namespace pendular::acceptedOverlapsTest
