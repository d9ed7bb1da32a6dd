#include "Tools/Studies/AccuracyVersusCost/BulkFigures.h"

#include <gtest/gtest.h>

#include "Drivers/Shared/BedMaterial.h"
#include "Tools/Studies/AccuracyVersusCost/PouredBed.h"
#include "Tools/Studies/AccuracyVersusCost/RibbedDrum.h"

namespace pendular::bulk::bulkFiguresTest {
namespace {

using Smooth = LinearViscoelasticSpecies;

/// Equal grains at rest on a periodic lattice, which overlap along its bonds.
class Crystal : public Simulation<Smooth> {
public:
    static constexpr double radius = 1e-3, overlap = 1e-6, stiffness = 1e4;  // m, m, N/m

    /// @param basis of the cubic cell, in edges
    Crystal(int cells, double edge, const std::vector<Vec3D>& basis) {
        Smooth species;
        species.setDensity(2500);
        species.setStiffness(stiffness);
        const Smooth* added = speciesHandler.copyAndAddObject(species);
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, cells * edge);
        for (int k = 0; k < cells * cells * cells; ++k)
            for (const Vec3D& site : basis)
                addGrainRow(particleHandler, added,
                            {radius, edge * (site + Vec3D(k % cells, k / cells % cells, k / cells / cells))});
        setTimeStep(1e-7);
        initialise();
    }
};
constexpr double bond = 2 * Crystal::radius - Crystal::overlap;  // m

// The virial is the sum of F l over the bonds, F = k d, l = 2 R - d; it is isotropic in a cubic crystal. The
// positions round to 1e-16 of a box of 1e-2 m, so that the overlap of 1e-6 m has 1e-12 of error.
TEST(BulkFigures, areThoseOfACubicAndOfAFaceCentredCrystal) {
    const std::vector<Vec3D> cubic{{0, 0, 0}},
        faceCentred{{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
    for (const bool isFaceCentred : {false, true}) {
        const Crystal crystal(3, isFaceCentred ? std::numbers::sqrt2 * bond : bond,
                              isFaceCentred ? faceCentred : cubic);
        const ContactFigures figures = contactFigures(crystal);
        const int neighbours = isFaceCentred ? 12 : 6;
        for (const int contacts : figures.contactsOf) EXPECT_EQ(contacts, neighbours);
        const Coordination c = coordination(figures.contactsOf);
        EXPECT_EQ(c.all, neighbours);
        EXPECT_EQ(c.loadBearing, neighbours);
        EXPECT_EQ(c.rattlers, 0);
        const double bonds = 0.5 * neighbours * static_cast<double>(figures.contactsOf.size());
        const double trace = bonds * Crystal::stiffness * Crystal::overlap * bond;
        const Eigen::Matrix3d exact = trace / 3 * Eigen::Matrix3d::Identity();
        EXPECT_LT((figures.virial - exact).norm(), 1e-10 * trace);
    }
}

TEST(BulkFigures, countGrainsWithFewContactsAsRattlers) {
    const std::vector<int> contacts{0, 3, 4, 8};
    const Coordination c = coordination(contacts);
    EXPECT_EQ(c.all, 15.0 / 4);
    EXPECT_EQ(c.loadBearing, 6);
    EXPECT_EQ(c.rattlers, 0.5);
}

TEST(BulkFigures, cutSpheres) {
    const double radius = 2, whole = 4.0 / 3 * std::numbers::pi * 8;
    EXPECT_EQ(volumeBelow(-3, 0, radius), 0);
    EXPECT_NEAR(volumeBelow(0, 0, radius), whole / 2, 1e-14 * whole);
    EXPECT_NEAR(volumeBelow(5, 0, radius), whole, 1e-14 * whole);
    // A cap of height h has pi h^2 (3 r - h) / 3, here 5 pi / 3 for h = 1.
    EXPECT_NEAR(volumeBelow(-1, 0, radius), 5 * std::numbers::pi / 3, 1e-14 * whole);
}

// Half a plane of grains on a lattice that is turned with the surface. A strip wider than a grain has one of
// the row at the surface, and its highest centre is of that row (one of the next row in the same strip lies
// d / cos deeper, and a row gains less than d sin within the strip), so that the line is the row.
TEST(BulkFigures, findTheAngleOfAnInclinedSurface) {
    for (const double degrees : {-30.0, 0.0, 5.0, 24.0, 35.0}) {
        const double angle = degrees * std::numbers::pi / 180, d = 1e-3;
        const Vec3D along(std::cos(angle), 0, std::sin(angle)), down(std::sin(angle), 0, -std::cos(angle));
        std::vector<Vec3D> centres;
        std::vector<double> radii;
        for (int i = -200; i <= 200; ++i)
            for (int j = 1; j <= 100; ++j) {
                const Vec3D centre = i * d * along + j * d * down;
                centres.push_back(centre);
                radii.push_back(d / 2);
            }
        EXPECT_NEAR(surfaceAngle(centres, {0.06, 2e-3}), degrees, 1e-9);
        // The piece is symmetric about the line from the origin down its middle.
        EXPECT_NEAR(centreAngle(centres, radii), degrees, 1e-9);
    }
}

// At rest the vertical virial is the sum of m g z exactly. What is left of the motion, 1e-6 m g r a grain, in
// oscillations of contacts (k = (6 E*^2 R P)^(1/3) = 180 N/m at a load P of ten grains, m = 8e-6 kg) is an
// acceleration of 0.07 g a grain; with random phases, 0.5 % in the sum over 200 grains. Twice that.
TEST(HeavyPouredBed, carriesItsWeight) {
    const LawVariant variant{"Hertz-Mindlin", 1e7, 0.5};
    PouredBed<HertzianViscoelasticMindlinSpecies> bed(variant, {.grains = 200, .across = 5}, 1);
    bed.initialise();
    const auto figures = bed.run().front();
    const auto of = [&](std::string_view name) {
        return figures[static_cast<std::size_t>(std::find(bed.names.begin(), bed.names.end(), name) -
                                                bed.names.begin())];
    };
    EXPECT_NEAR(of("vertical_stress_over_weight"), 1, 1e-2);
    EXPECT_GT(of("coordination"), 4);  // d + 1 of grains with friction, less the rattlers, to 2 d
    EXPECT_LT(of("coordination"), 6.5);
    EXPECT_GT(of("solid_fraction"), 0.55);  // random loose packing
    EXPECT_LT(of("solid_fraction"), 0.64);  // random close packing
}

// The grains' weight turns the drum back: over a long time the mean torque on the wall is the weight times
// the mean lever of the centre of mass. What is left is the change of the angular momentum, at most
// m R^2 omega, of the flow as a whole, over the time of measurement.
TEST(HeavyRibbedDrum, isTurnedBackByTheWeight) {
    const LawVariant variant{"Hertz-Mindlin", 1e6, 0.5};
    DrumOptions options;
    options.radius = 0.01;
    options.filling = 0.35;
    RibbedDrum<HertzianViscoelasticMindlinSpecies> drum(variant, options, 1);
    drum.wall().keepForces(true, Vec3D::Zero());
    drum.initialise();
    const double time = 0.6;  // s
    while (drum.getTime() < 0.4) drum.step();
    double torque = 0, weight = 0, mass = 0;  // N m, N m, kg
    int steps = 0;
    for (; drum.getTime() < 0.4 + time; ++steps) {
        drum.step();
        torque += drum.wall().getTorque().y();
        mass = 0;
        for (const TranslationRecord& grain : drum.particleHandler.store().translation) {
            weight += gravity * grain.position.x / grain.inverseMass;
            mass += 1 / grain.inverseMass;
        }
    }
    torque /= steps, weight /= steps;
    const double change = mass * options.radius * options.radius * options.speed / time;
    EXPECT_NEAR(torque, weight, change);
    EXPECT_GT(weight, 5 * change);
    EXPECT_GT(drum.figures()[0], 10);  // rises towards +x
}

}  // namespace
}  // namespace pendular::bulk::bulkFiguresTest
