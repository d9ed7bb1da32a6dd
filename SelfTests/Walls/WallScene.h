#pragma once

#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::wallTests {

using Smooth = Species<HertzianViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;

constexpr double radius = 1e-3;       // m, of the grains
constexpr double density = 2500;      // kg/m^3
constexpr double youngModulus = 5e7;  // Pa
constexpr double poissonRatio = 0.25;
constexpr double step = 4e-6;  // s, some 35 in a contact at 0.3 m/s

template <class S>
S material(double restitution = 0.6, double friction = 0.4) {
    S species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(youngModulus, poissonRatio);
    species.setRestitutionCoefficient(restitution);
    if constexpr (S::hasTorque) {
        species.setEffectiveShearModulus(computeEffectiveShearModulus(youngModulus, poissonRatio));
        species.setSlidingFrictionCoefficient(friction);
    }
    return species;
}

inline double mass(double r = radius) { return 4.0 / 3.0 * std::numbers::pi * r * r * r * density; }

/// A scene of a few grains to which walls of any shape are added.
template <class S>
class WallScene : public scenes::FewGrains<S> {
public:
    explicit WallScene(const std::vector<scenes::GrainMotion>& grains, const S& species = material<S>(),
                       const Vec3D& gravity = Vec3D::Zero(), double timeStep = step)
        : scenes::FewGrains<S>(species, grains, timeStep) {
        this->setGravity(gravity);
        this->acceptUnstableTimeStep();  // the limit is for overlaps of 5 %, these have 1 % at most
    }
    template <class Shape>
    Shape* add(Shape wall) {
        wall.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(wall);
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) this->step();
    }
    [[nodiscard]] int touching() {
        int count = 0;
        this->contacts().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            count += bucket.wall >= 0 && this->contacts().touches(c);
        });
        return count;
    }
    [[nodiscard]] double kineticEnergy() {
        double sum = 0;
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            sum += 0.5 * grain.getMass() *
                   (grain.getVelocity().squaredNorm() +
                    0.4 * std::pow(grain.getRadius(), 2) * grain.getAngularVelocity().squaredNorm());
        }
        return sum;
    }
};

inline Vector<double> at(double x, double y, double z) { return {x, y, z}; }

/// The parallelogram with a corner and two sides, cut into 2 n m triangles.
inline std::vector<Triangle> parallelogram(const Vector<double>& corner, const Vector<double>& a,
                                           const Vector<double>& b, int n = 1, int m = 1) {
    std::vector<Triangle> result;
    const auto p = [&](int i, int j) {
        return corner + (static_cast<double>(i) / n) * a + (static_cast<double>(j) / m) * b;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            result.push_back({p(i, j), p(i + 1, j), p(i + 1, j + 1)});
            result.push_back({p(i, j), p(i + 1, j + 1), p(i, j + 1)});
        }
    return result;
}

inline void append(std::vector<Triangle>& to, const std::vector<Triangle>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

/// The six sides of a box between two corners, each cut into 2 n^2 triangles.
inline std::vector<Triangle> box(const Vector<double>& low, const Vector<double>& high, int n = 1) {
    const Vector<double> d = high - low;
    const Vector<double> x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
    std::vector<Triangle> result;
    for (const auto& [corner, a, b] :
         {std::array{low, x, y}, std::array{low, x, z}, std::array{low, y, z}, std::array{high, -x, -y},
          std::array{high, -x, -z}, std::array{high, -y, -z}})
        append(result, parallelogram(corner, a, b, n, n));
    return result;
}

inline TriangleWall mesh(const std::vector<Triangle>& triangles) {
    TriangleWall wall;
    wall.set(triangles);
    return wall;
}

/// The points of a wall for a sphere, all parts within reach, without those that are left out.
inline std::vector<WallPoint> pointsFor(const Wall& wall, const Vector<double>& centre, double reach) {
    std::vector<std::uint32_t> parts;
    wall.listParts(centre, reach, parts);
    std::vector<WallPoint> points(parts.size());
    if (!parts.empty()) wall.findPoints(centre, reach, parts, points);
    std::erase_if(points, [](const WallPoint& p) { return std::isinf(p.distance); });
    return points;
}

}  // namespace pendular::wallTests
