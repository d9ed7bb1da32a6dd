#pragma once

#include <map>

#include "Kernel/Features/RigidBodies/OrientationOrder.h"
#include "SelfTests/Insertion/FilledScene.h"

namespace pendular::scenes {

/// Two equal spheres; the length over the diameter is the aspect (above 1, up to 2 they overlap).
inline ClumpTemplate dimer(double aspect) {
    const double half = 0.5 * (aspect - 1);
    return ClumpTemplate({{{0, 0, -half}, 0.5}, {{0, 0, half}, 0.5}});
}

/// A scene of clumps.
class ClumpScene : public FilledScene {
public:
    explicit ClumpScene(int numberOfThreads = 1) : FilledScene(numberOfThreads) {}

    [[nodiscard]] Clump clump(const ClumpTemplate& shape, const Vec3D& velocity = Vec3D::Zero()) const {
        Clump made(shape);
        made.setSpecies(material);
        made.setVelocity(velocity);
        return made;
    }
    void repeat(double length) {
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, length);
    }
    /// m, the least gap between two spheres of different bodies, or their images, over all pairs; a grain in
    /// no body is one of its own. @param since identity: only pairs with a sphere that is not older
    [[nodiscard]] double leastGapOfBodies(std::uint32_t since = 0) const {
        const ParticleStore& grains = particleHandler.store();
        const PeriodicBox& box = getPeriodicBox();
        const int images = box.any() ? 1 : 0;
        double least = infinity;
        for (const std::uint32_t p : grains.place)
            for (const std::uint32_t q : grains.place) {
                const std::uint32_t a = grains.identity[p], b = grains.identity[q];
                if (b >= a || a < since || grains.bodies.areJoined(a, b)) continue;
                const TranslationRecord &one = grains.translation[p], &other = grains.translation[q];
                for (int x = -images; x <= images; ++x)
                    for (int y = -images; y <= images; ++y)
                        for (int z = -images; z <= images; ++z) {
                            const Vector<double> image{x * box.length.x, y * box.length.y, z * box.length.z};
                            const Vector<double> apart =
                                box.wrap(one.position) - box.wrap(other.position) + image;
                            least = std::min(least, norm(apart) - one.radius - other.radius);
                        }
            }
        return least;
    }
    /// m^3, of all bodies, and of grains in none.
    [[nodiscard]] double volume() {
        double sum = 0;
        const ParticleStore& grains = particleHandler.store();
        for (std::size_t k = 0; k < grains.bodies.size(); ++k) sum += grains.bodies.volumeOf(k);
        for (std::size_t k = 0; k < grains.size(); ++k)
            if (!grains.isGap(k) && !grains.bodies.contains(grains.identity[k]))
                sum += sphereMass(grains.translation[k].radius, 1);
        return sum;
    }
};

/// S of N axes at random stays below this. The mean of (3 u u - 1) / 2 has no trace, so that its largest
/// eigenvalue is at most sqrt(2/3 tr Q^2); its five components have the variance of 0.3 / N of tr Q^2 each
/// (of u_x^2: 4/45, of u_x u_y: 1/15, times 9/4). So S < sqrt(0.2 chi^2 / N), and 36 is exceeded by chi^2 of
/// five degrees of freedom once in a million.
inline double mostOrder(std::size_t axes) { return std::sqrt(0.2 * 36 / static_cast<double>(axes)); }

}  // namespace pendular::scenes
