// Stress, fields and clusters of rigid bodies, which are grains at their centres of mass: what holds a body
// together is in the stress. The numbers are those of shared/data/drives-and-shapes/stress_rod.csv and
// stress_dumbbells.csv, closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/Clusters.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Random.h"

namespace pendular::rigidBodiesTest {
namespace {

using scenes::FewGrains;
using Smooth = Species<LinearViscoelastic>;
using Sum = FieldSums::Sum;

constexpr double r = 1e-3, stiffness = 1000, density = 2500;  // m, N/m, kg/m^3

Smooth material(double dissipation = 0) {
    Smooth s;
    s.setDensity(density);
    s.setStiffness(stiffness);
    s.setDissipation(dissipation);
    return s;
}

/// Spheres of one radius along z, with the first at the origin.
std::vector<Ball> rod(int spheres, double spacing) {
    std::vector<Ball> all;
    for (int k = 0; k < spheres; ++k) all.push_back({{0, 0, k * spacing}, r});
    return all;
}

/// A rod of five spheres between two plates that press it with a force (N).
struct PressedRod {
    static constexpr double force = 0.006, area = 1e-4;  // N, m^2 of the plates

    explicit PressedRod(double spacing)
        : length(4 * spacing + 2 * r - 2 * force / stiffness),
          scene(material(), {}, 1e-6, {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, length}}}) {
        Clump clump{ClumpTemplate(rod(5, spacing))};
        clump.setSpecies(scene.speciesHandler.getObject(0));
        clump.setPosition({0, 0, 0.5 * length});
        scene.bodyHandler.copyAndAddObject(clump);
        scene.setQuiet();
        scene.initialise();
    }
    double length;  // m, between the plates
    FewGrains<Smooth> scene;
};

/// Pa, zz, over a box between the plates with their area.
double stressOver(const GrainState& state, double length, FieldSums::Sum sum = Sum::ContactStress) {
    const double half = 0.5 * std::sqrt(PressedRod::area);
    FieldSums sums(FieldGrid("O", {-half, -half, -1e-9}, {half, half, length + 1e-9}, 1),
                   SmoothingKernel(KernelShape::Gauss, 0, 1));
    sums.add(state);
    return sums.ofAll(sum + 8, 0) * (length + 2e-9) / length;
}

// 60 Pa, whatever the spacing. Branches from the spheres' centres gave 2 r / L of it: 12 and 14.3 Pa.
TEST(StressOfBodies, isWhatARodCarries) {
    for (const double spacing : {2 * r, 1.6 * r, 0.3 * r}) {
        PressedRod pressed(spacing);
        const double expected = PressedRod::force / PressedRod::area;  // 60 Pa
        const GrainState state = stateOf(pressed.scene);
        ASSERT_EQ(state.grains.size(), 1u);
        ASSERT_EQ(state.contacts.size(), 2u);
        EXPECT_NEAR(stressOver(state, pressed.length), expected, 1e-9 * expected);
        EXPECT_NEAR(meanStress(pressed.scene, PressedRod::area * pressed.length).total()(2, 2), expected,
                    1e-9 * expected);
        // The field stress_Pa of a frame: each sphere has the stress of the body, tension positive, so that
        // the mean over the mass is F L / V.
        const double volume = unionOfSpheres(rod(5, spacing)).volume,
                     length = pressed.length + PressedRod::force / stiffness;  // to the middles of overlaps
        const PolyDataField stress = grainStresses<double>(
            pressed.scene.contacts(), pressed.scene.particleHandler.store(), pressed.scene.laws());
        for (std::size_t k = 0; k < 5; ++k)
            EXPECT_NEAR(-stress.at(9 * k + 8) * volume / (PressedRod::force * length), 1, 1e-9) << k;
        // From a frame: numbers of 32 bits, forces of 6 mN by overlaps of 6 um.
        FrameContent content;
        const SceneFrame frame = content.of(pressed.scene);
        EXPECT_NEAR(stressOver(stateOf(frame.grains, *frame.contacts, {}), pressed.length), expected,
                    1e-6 * expected);
    }
}

// An ellipsoid stands between plates as the rod does. Contact points lie in the middle of the overlap.
TEST(StressOfBodies, isWhatAnEllipsoidCarries) {
    constexpr double half = 2e-3, overlap = 1e-6, length = 2 * (half - overlap);  // m
    scenes::FewSuperquadrics<Smooth> scene(material(), {{.shape = {r, r, half, 2, 2}}}, 1e-6);
    scene.addPlane({0, 0, -1}, {0, 0, -0.5 * length});
    scene.addPlane({0, 0, 1}, {0, 0, 0.5 * length});
    scene.setQuiet();
    scene.initialise();
    const auto contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 2u);
    const double force = norm(contacts[0].force);
    EXPECT_GT(force, 0);
    EXPECT_NEAR(meanStress(scene, 1e-9).total()(2, 2) * 1e-9 / (force * length), 1, 2 * overlap / length);
}

// Density, momentum and volume of a body, spheres that overlap counted once; with its centre as its place.
TEST(FieldsOfBodies, areThoseOfOneGrain) {
    FewGrains<Smooth> scene(material(), {{.radius = r, .position = {0, 0, -0.01}}}, 1e-6);
    Clump clump{ClumpTemplate(rod(4, 0.8 * r))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setVelocity({0, 0, 0.5});
    clump.setAngularVelocity({100, 0, 0});
    const double mass = scene.bodyHandler.copyAndAddObject(clump).getMass();
    scene.setQuiet();
    scene.initialise();
    FrameContent content;
    content.doubles = true;
    const SceneFrame frame = content.of(scene);
    const FieldGrid grid("XYZ", {-2e-2, -2e-2, -2e-2}, {2e-2, 2e-2, 2e-2}, 1e-3);
    for (const GrainState& state : {stateOf(scene), stateOf(frame.grains, *frame.contacts, {}),
                                    stateOf(scene, FieldContent::WithoutContacts)}) {
        ASSERT_EQ(state.grains.size(), 2u);
        EXPECT_NEAR(state.grains[1].mass, mass, 1e-14 * mass);
        EXPECT_LT(norm(state.grains[1].position), 1e-18);
        EXPECT_NEAR(state.grains[1].velocity.z, 0.5, 1e-15);
        FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, 3, 1e-3, 8e-3));
        sums.add(state);
        double volume = 0, flux = 0;
        for (std::size_t k = 0; k < grid.size(); ++k) {
            volume += sums.ofAll(Sum::Volume, k) * 1e-9;
            flux += sums.ofAll(Sum::Flux + 5, k) * 1e-9;
        }
        // The sum over points 1 w apart errs by 5e-9 of the integral, the cut-off by less.
        EXPECT_NEAR(volume / (sphereMass(r, 1) + mass / density), 1, 1e-7);
        EXPECT_NEAR(flux / (mass * 0.25), 1, 1e-7);  // of the centre: turning is no motion of grains
    }
}

/// A simple cubic lattice of spheres in a periodic box, all neighbours of which overlap by a length (m), so
/// that each contact has one force; three in a row, or around a corner, are rigid bodies here and there.
class JoinedLattice : public FewGrains<Smooth> {
public:
    static constexpr int side = 8;
    static constexpr double overlap = 2e-6, spacing = 2 * r - overlap;

    explicit JoinedLattice(bool isJoined) : FewGrains<Smooth>(material(), {}, 5e-6) {
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(r);
        for (int k = 0; k < side * side * side; ++k) {
            // No branch lies in a face of the box.
            grain.setPosition(spacing *
                              Vec3D(k % side + 0.37, k / side % side + 0.41, k / (side * side) + 0.29));
            particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, side * spacing);
        support::Random random(2);
        for (int k = 0; isJoined && k < 150; ++k) {
            const auto any = [&](double most) { return static_cast<int>(random.uniform(0, most)); };
            const int a = any(3), b = any(3), x[3] = {any(side), any(side), any(side)};
            const std::uint32_t first = at(x[0], x[1], x[2]), second = next(x, a), third = next(x, a, b);
            const auto isTaken = [&](std::uint32_t id) { return bodyHandler.bodyOf(id).has_value(); };
            if (isTaken(first) || isTaken(second) || isTaken(third)) continue;
            joinAsSolid({first, second, third});
        }
        setQuiet();
    }

private:
    /// Round the faces.
    static std::uint32_t at(int x, int y, int z) {
        return static_cast<std::uint32_t>(x % side + side * (y % side) + side * side * (z % side));
    }
    static std::uint32_t next(const int* x, int a, int b = -1) {
        int y[3] = {x[0], x[1], x[2]};
        ++y[a];
        if (b >= 0) ++y[b];
        return at(y[0], y[1], y[2]);
    }
    /// Joins grains to a body with the mass that the spheres have in a template.
    void joinAsSolid(const std::vector<std::uint32_t>& identities) {
        std::vector<Ball> balls;
        const Vec3D origin = particleHandler.getObject(identities[0]).getPosition();
        for (const std::uint32_t id : identities)
            balls.push_back({origin + toEigen(getPeriodicBox().nearest(toVector(
                                          Vec3D(particleHandler.getObject(id).getPosition() - origin)))),
                             r});
        const MassProperties solid = unionOfSpheres(balls);
        bodyHandler.join(identities, BodyMass{density * solid.volume, solid.centre, density * solid.inertia});
    }
};

// Every sphere is in balance, and so is every body with the force of its lost contacts within it: joining
// changes no stress. It is k d / a^2 along each axis.
TEST(StressOfBodies, isThatOfTheLatticeFromWhichTheyAreJoined) {
    const double expected =
        stiffness * JoinedLattice::overlap / (JoinedLattice::spacing * JoinedLattice::spacing);
    for (const bool isJoined : {false, true}) {
        JoinedLattice scene(isJoined);
        scene.initialise();
        EXPECT_EQ(scene.bodyHandler.getSize() > 60, isJoined);
        const MeanStress stress = meanStress(scene);
        EXPECT_LT((stress.total() - expected * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
                  1e-9 * expected);
        const double edge = JoinedLattice::side * JoinedLattice::spacing;
        FieldSums sums(FieldGrid("O", {0, 0, 0}, {edge, edge, edge}, 1),
                       SmoothingKernel(KernelShape::Gauss, 0, 1));
        sums.add(stateOf(scene));
        for (std::size_t k = 0; k < 9; ++k)
            EXPECT_NEAR(sums.ofAll(Sum::ContactStress + k, 0), k % 4 == 0 ? expected : 0, 1e-9 * expected)
                << k;
        // The stresses of the grains in a frame, weighed by their masses.
        FrameContent content;
        content.doubles = content.stress = true;
        const SceneFrame frame = content.of(scene);
        const PolyDataField &each = *frame.grains.pointField("stress_Pa"),
                            &mass = *frame.grains.pointField("mass_kg");
        double sum = 0;
        for (std::size_t k = 0; k < mass.size(); ++k) sum -= mass.at(k) / density * each.at(9 * k + 4);
        EXPECT_NEAR(sum / (edge * edge * edge), expected, 1e-9 * expected);
    }
}

// Upright rods of three spheres on a lattice a x a x c press each other with k d along z, by 3 k d across:
// the stress is k d_z / a^2 along z and 3 k d / (a c) across. A servo of the stress along z ends where c has
// that overlap; one with branches between spheres, of which one in z is 2 r instead of c, would end at a
// shorter c.
TEST(StressOfBodies, isWhatAServoMakes) {
    constexpr int across = 5, along = 3;
    constexpr double d = 2e-6, a = 2 * r - d, c = 4 * r - d, k = stiffness;
    FewGrains<Smooth> scene(material(0.1), {}, 5e-6);
    Clump clump{ClumpTemplate(rod(3, r))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    for (int n = 0; n < across * across * along; ++n) {
        clump.setPosition(
            {(n % across + 0.3) * a, (n / across % across + 0.4) * a, (n / (across * across) + 0.2) * c});
        scene.bodyHandler.copyAndAddObject(clump);
    }
    for (int axis = 0; axis < 2; ++axis) scene.setPeriodic(axis, 0, across * a);
    scene.setPeriodic(2, 0, along * c);
    const double target = 1.2 * k * d / (a * a);
    scene.setTargetStress(2, target, 1e-3);
    scene.setQuiet();
    scene.initialise();
    const Eigen::Matrix3d first = meanStress(scene).total();
    EXPECT_NEAR(first(2, 2) * a * a / (k * d), 1, 1e-9);
    EXPECT_NEAR(first(0, 0) * a * c / (3 * k * d), 1, 1e-9);
    scene.step(20000);  // 100 times that of the servo, whose drift takes 16
    EXPECT_NEAR(meanStress(scene).total()(2, 2) / target, 1, 1e-5);
    // The scene becomes 0.4 um shorter for each rod.
    EXPECT_NEAR(scene.getPeriodicBox().length.z, along * (4 * r - target * a * a / k), along * 1e-5 * d);
}

// Five spheres of a rod are one cluster, with a grain that touches it as well, and one that is apart is
// another.
TEST(ClustersOfBodies, holdTheirGrains) {
    FewGrains<Smooth> scene(material(), {{.position = {0, 0, -1.999e-3}}, {.position = {0.01, 0, 0}}}, 1e-6);
    Clump clump{ClumpTemplate(rod(5, r))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setPosition({0, 0, 2 * r});
    scene.bodyHandler.copyAndAddObject(clump);
    clump.setPosition({0.02, 0, 0});
    scene.bodyHandler.copyAndAddObject(clump);
    scene.setQuiet();
    scene.initialise();
    // Centres of neighbours in a rod are 1 mm apart, and those of the grain and the first sphere 2 mm.
    for (const Clusters& found : {clustersOfContacts(scene), clustersWithin(scene, 2.1e-3)}) {
        ASSERT_EQ(found.list.size(), 3u);
        EXPECT_EQ(found.list[0].size, 6u);
        EXPECT_EQ(found.list[0].bodies, 2u);
        EXPECT_EQ(found.list[1].size, 5u);
        EXPECT_EQ(found.list[1].bodies, 1u);
        EXPECT_EQ(found.of, (std::vector<std::size_t>{0, 2, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1}));
        EXPECT_DOUBLE_EQ(found.aloneOfMembers(), 2.0 / 4);
        EXPECT_DOUBLE_EQ(found.aloneOfClusters(), 2.0 / 3);
        // Points a spacing r apart in a row have the radius of gyration r sqrt((n^2 - 1) / 12).
        EXPECT_NEAR(found.list[1].gyrationRadius, r * std::sqrt(2.0), 1e-15);
    }
    EXPECT_EQ(clustersWithin(scene, 0.5e-3).list.size(), 4u);  // a body is whole at any distance
}

}  // namespace
}  // namespace pendular::rigidBodiesTest
