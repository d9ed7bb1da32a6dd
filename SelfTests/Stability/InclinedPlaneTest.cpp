/// A body on an inclined plane just below the angle at which it slides: it does not creep.

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::inclinedPlaneTest {
namespace {

constexpr double friction = 0.3, radius = 1e-3, pull = 9.8;  // -, m, m/s^2

/// Three grains that touch each other and are one body, so that nothing rolls, on a plane whose tangent is a
/// share of the coefficient of friction. The one that is farthest down bears the most.
class Incline : public Simulation<HertzianViscoelasticMindlinSpecies> {
public:
    explicit Incline(double share) {
        HertzianViscoelasticMindlinSpecies material;
        material.setDensity(2500);
        material.setElasticModulusAndPoissonRatio(1e8, 0.3);
        material.setEffectiveShearModulus(computeEffectiveShearModulus(1e8, 0.3));
        material.setRestitutionCoefficient(0.3);
        material.setSlidingFrictionCoefficient(friction);
        const auto* species = speciesHandler.copyAndAddObject(material);
        InfiniteWall plane;
        plane.setSpecies(species);
        plane.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(plane);
        const double angle = std::atan(share * friction);
        setGravity({pull * std::sin(angle), 0, -pull * std::cos(angle)});
        std::vector<std::uint32_t> grains;
        for (const double turned : {0.0, 2.0, 4.0}) {
            const double around = turned * std::acos(-1.0) / 3, reach = 2 * radius / std::sqrt(3.0);
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setRadius(radius);
            grain.setPosition({reach * std::cos(around), reach * std::sin(around), radius});
            grains.push_back(particleHandler.copyAndAddObject(grain).getId());
        }
        bodyHandler.join(grains);
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
        initialise();
    }
    [[nodiscard]] Vec3D place() { return bodyHandler.getObject(0).getPosition(); }
};

// At rest every step does the same, but for round-off: at most half a unit in the last place of 2e-3 m (the
// body, and its grains), 2e-19 m, in each of 10^6 steps, that is 4e-13 m if all had one sign. The swinging of
// the start goes before that: it moves the body by 4e-12 m from step 20 000 to 145 000, and then by nothing.
TEST(HeavyInclinedPlane, aBodyJustBelowTheLimitDoesNotCreepIn1e6Steps) {
    Incline scene(0.98);
    scene.step(145000);
    const Vec3D before = scene.place();
    scene.step(1000000);
    EXPECT_LT((scene.place() - before).norm(), 4e-13);
}

// Above the limit it slides with g (sin - mu cos), to the little that the springs take at first.
TEST(InclinedPlane, aBodyAboveTheLimitSlidesAsCoulombSays) {
    constexpr double share = 1.5;
    Incline scene(share);
    const double angle = std::atan(share * friction),
                 acceleration = pull * (std::sin(angle) - friction * std::cos(angle));
    const auto speedOver = [&](std::size_t steps) {
        const double place = scene.place().x(), time = scene.getTime();
        scene.step(steps);
        return std::pair((scene.place().x() - place) / (scene.getTime() - time),
                         0.5 * (scene.getTime() + time));
    };
    scene.step(20000);
    const auto [early, then] = speedOver(100);
    scene.step(20000);
    const auto [late, now] = speedOver(100);
    // Contacts are pressed evenly by then; mean speeds of a constant acceleration are those of the middle.
    EXPECT_NEAR((late - early) / (now - then) / acceleration, 1, 1e-6);
}

}  // namespace
}  // namespace pendular::inclinedPlaneTest
