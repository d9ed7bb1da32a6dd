#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/ShearAndStrain/StressServo.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

// The stress of periodic scenes of superquadrics, and its servo.

namespace pendular::superquadricServoTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;

using Hertz = Species<HertzianViscoelastic>;

constexpr double modulus = 1e7;  // Pa, effective

Hertz hertz() {
    Hertz species;
    species.setDensity(2500);
    species.setEffectiveElasticModulus(modulus);
    species.setDissipation(0.3);
    return species;
}

constexpr int perSide = 4;

/// Grains on a cubic lattice that are pressed along the axes by a depth, in a scene that repeats itself.
template <class Scene, class Add>
void addLattice(Scene& scene, const Vec3D& halfLengths, double depth, Add&& add) {
    const Vec3D spacing = 2 * halfLengths - Vec3D::Constant(depth);
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, perSide * spacing[axis]);
    for (int x = 0; x < perSide; ++x)
        for (int y = 0; y < perSide; ++y)
            for (int z = 0; z < perSide; ++z)
                add(Vec3D(spacing.cwiseProduct(Vec3D(x + 0.5, y + 0.5, z + 0.5))));
}
struct Ellipsoids : FewSuperquadrics<Hertz> {
    Ellipsoids(const Superquadric& shape, double depth) : FewSuperquadrics(hertz(), {}, 2e-6) {
        setQuiet();
        addLattice(*this, {shape.a, shape.b, shape.c}, depth, [&](const Vec3D& at) { add({shape, at}); });
    }
};
struct Spheres : FewGrains<Hertz> {
    Spheres(double r, double depth) : FewGrains(hertz(), {}, 2e-6) {
        setQuiet();
        addLattice(*this, Vec3D::Constant(r), depth, [&](const Vec3D& at) {
            SphericalParticle grain;
            grain.setSpecies(speciesHandler.getObject(0));
            grain.setRadius(r), grain.setPosition(at);
            particleHandler.copyAndAddObject(grain);
        });
    }
};

// Ellipsoids with their axes along those of a cubic lattice touch at the ends of these. Along z the contact
// has the radius R of two surfaces with the radii of curvature a^2/c and b^2/c, 2 c / (a b) = 1/R, the force
// F = 4/3 E sqrt(R) d^(3/2) and the slope k = 2 E sqrt(R d); one cell of the lattice has one such contact, so
// that s_zz = F l_z / V and, with z alone controlled, K_zz = k l_z^2 / V. So along the others. Places of 14
// mm are rounded by 9e-19 m, which is 2e-13 of the depths.
TEST(SuperquadricServo, knowsTheStiffnessOfContacts) {
    const Superquadric shape{1e-3, 1.3e-3, 1.7e-3};
    const double depth = 4e-6;
    Ellipsoids scene(shape, depth);
    scene.initialise();
    const Vec3D half(shape.a, shape.b, shape.c), l = 2 * half - Vec3D::Constant(depth);
    const double volume = l.prod();
    for (int axis = 0; axis < 3; ++axis) {
        const double radius = 0.5 * half.prod() / (half[axis] * half[axis]);
        const double force = 4. / 3 * modulus * std::sqrt(radius * depth) * depth,
                     stiffness = 2 * modulus * std::sqrt(radius * depth);
        const auto k = static_cast<std::size_t>(axis);
        HomogeneousStrain alone;
        alone.axes[k].isControlled = true;
        const DiagonalStress found = diagonalStress(scene.contacts(), scene.particleHandler.store(), alone);
        const double stress = force * l[axis] / volume, modulusAlong = stiffness * l[axis] * l[axis] / volume;
        EXPECT_NEAR(found.stress[k], stress, 2e-12 * stress) << axis;
        EXPECT_NEAR(found.stiffness[k], modulusAlong, 2e-12 * modulusAlong) << axis;
        EXPECT_NEAR(meanStress(scene).total()(axis, axis), stress, 2e-12 * stress);
        EXPECT_EQ(found.touches, 3u * perSide * perSide * perSide);
    }
}

// By either kernel, to the rounding of depths, of which the servo, which is stable, forgets the earlier ones.
TEST(SuperquadricServo, ofEqualHalfLengthsIsThatOfSpheres) {
    const double r = 1e-3, depth = 4e-6;
    Spheres spheres(r, depth);
    Ellipsoids shapes({r, r, r}, depth);
    for (int axis = 0; axis < 3; ++axis) {
        spheres.setTargetStress(axis, 2000 + 500 * axis, 5e-4);
        shapes.setTargetStress(axis, 2000 + 500 * axis, 5e-4);
    }
    spheres.initialise(), shapes.initialise();
    for (int k = 0; k < 1000; ++k) {
        spheres.step(), shapes.step();
        const Vector<double> expected = spheres.getPeriodicBox().length,
                             found = shapes.getPeriodicBox().length;
        ASSERT_LT(norm(found - expected), 1e-12 * norm(expected)) << k;
    }
    const Vec3D stress = meanStress(shapes).total().diagonal();
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(stress[axis], meanStress(spheres).total()(axis, axis), 1e-9 * stress[axis]);
}

// A crystal comes to the length at which its stress is the target: F l / V with the others held, so that
// 4/3 E sqrt(R) d^(3/2) = target x (l_x l_y), which stay.
TEST(SuperquadricServo, bringsACrystalToItsTarget) {
    const Superquadric shape{1e-3, 1.3e-3, 1.7e-3};
    const double depth = 4e-6, target = 5000;  // m, Pa
    Ellipsoids scene(shape, depth);
    scene.setTargetStress(2, target, 5e-4);
    scene.initialise();
    scene.step(25000);  // 100 times, and 6 of the drift's
    const double radius = 0.5 * shape.a * shape.b / shape.c;
    const double across = (2 * shape.a - depth) * (2 * shape.b - depth);
    const double expected = std::pow(target * across / (4. / 3 * modulus * std::sqrt(radius)), 2. / 3);
    const double found = 2 * shape.c - scene.getPeriodicBox().length.z / perSide;
    EXPECT_GT(expected, 2 * depth);
    EXPECT_NEAR(found, expected, 1e-3 * expected);
}

}  // namespace
}  // namespace pendular::superquadricServoTest
