#pragma once

#include "SelfTests/Walls/WallScene.h"

namespace pendular::wearTests {

using wallTests::Dry;
using wallTests::Smooth;
using wallTests::WallScene;

constexpr double coefficient = 1e-3;          // K
constexpr double hardness = 1e9;              // H, Pa
constexpr double friction = 0.3;              // mu
constexpr double fieldOfGravity = 9.81;       // m/s^2
constexpr double radius = wallTests::radius;  // m

/// A square plate around the origin at z = 0, in 2 n^2 triangles whose normals point up, to the grains.
inline TriangleWall plate(double width, int n = 1) {
    return wallTests::mesh(
        wallTests::parallelogram({-width / 2, -width / 2, 0}, {width, 0, 0}, {0, width, 0}, n, n));
}

/// The height (m) of the centre of a grain at rest on a plane, by Hertz: F = 4/3 E* sqrt(R) d^(3/2), with E*
/// = E / (1 - nu^2) / 2.
inline double heightAtRest(double r = radius) {
    using namespace wallTests;
    const double modulus = youngModulus / (1 - poissonRatio * poissonRatio) / 2;
    return r - std::pow(0.75 * mass(r) * fieldOfGravity / (modulus * std::sqrt(r)), 2.0 / 3);
}

/// Grains that a plate wears under.
template <class S>
class PlateSceneOf : public WallScene<S> {
public:
    PlateSceneOf(const std::vector<scenes::GrainMotion>& grains, TriangleWall wall, const WearLaw& law,
                 const Vec3D& weight = {0, 0, -fieldOfGravity}, double timeStep = wallTests::step)
        : WallScene<S>(grains, wallTests::material<S>(0.6, friction), weight, timeStep) {
        this->setQuiet();
        wall.keepWear(law);
        worn = this->add(std::move(wall));
    }
    [[nodiscard]] SurfaceWear wear() const { return worn->getWear().sum(); }

    TriangleWall* worn;
};
using PlateScene = PlateSceneOf<Dry>;

}  // namespace pendular::wearTests
