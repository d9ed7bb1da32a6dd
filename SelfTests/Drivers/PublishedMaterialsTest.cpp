#include <gtest/gtest.h>

#include "Drivers/Shared/PublishedScene.h"

namespace pendular::publishedMaterialsTest {
namespace {

/// The published table again, typed from shared/peers/README.md: by pair, so that a swapped index shows.
struct Pair {
    PublishedMaterial a, b;
    double restitution, friction;
};
constexpr std::array<Pair, 6> published{{{M1, M1, 0.5, 0.3},
                                         {M1, M2, 0.45, 0.2},
                                         {M1, Steel, 0.4, 0.2},
                                         {M2, M2, 0.4, 0.4},
                                         {M2, Steel, 0.4, 0.2},
                                         {Steel, Steel, 0.6, 0.5}}};
constexpr std::array<double, 3> density{2500, 2000, 7200};        // kg/m^3
constexpr std::array<double, 3> youngModulus{1e9, 0.5e9, 210e9};  // Pa

class TwoGrains : public PublishedScene {
public:
    TwoGrains(PublishedMaterial a, PublishedMaterial b, double step) : PublishedScene(step, 1) {
        setGravity(Vec3D::Zero());
        addGrain({1e-3, Vec3D(-1.00137e-3, 0, 0)}, a, {0.5, 0, 0});
        addGrain({1e-3, Vec3D(1.00137e-3, 0, 0)}, b, {-0.5, 0, 0});
    }
};

TEST(PublishedMaterials, giveTheStiffnessAndFrictionOfEachPair) {
    TwoGrains scene(M1, M2, 1e-7);
    scene.speciesHandler.mixAll();
    for (const Pair& pair : published)
        for (const auto& [a, b] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
            const auto& laws = scene.speciesHandler.mixture(static_cast<int>(a), static_cast<int>(b));
            // 1/E* = sum of (1 - nu^2)/E, 1/G* = sum of (2 - nu)/G with G = E/(2 (1 + nu)), nu = 0.2
            const double inverses = 1 / youngModulus[a] + 1 / youngModulus[b];
            EXPECT_NEAR(laws.effectiveElasticModulus * 0.96 * inverses, 1, 1e-14);
            EXPECT_NEAR(laws.effectiveShearModulus * 4.32 * inverses, 1, 1e-14);
            EXPECT_EQ(laws.slidingFrictionCoefficient, pair.friction);
            EXPECT_NEAR(laws.slidingDissipation / laws.dissipation, std::sqrt(2.0 / 3.0), 1e-14);
        }
}

/// Head-on collisions. The kernel's error of the restitution is at most 0.06 % at e = 0.3 and 50 steps a
/// contact (Kernel/Core/Contacts/README.md), of second order in the step; Hertz's contact time at 1 m/s is 6
/// us (steel) to 42 us (M2), with this step 150 and more steps, so 0.05 % is ample.
TEST(PublishedMaterials, collideWithTheirRestitution) {
    for (const Pair& pair : published) {
        TwoGrains scene(pair.a, pair.b, 4e-8);
        scene.setTimeMax(80e-6);
        scene.solve();
        const double parting = (scene.particleHandler.getObject(1).getVelocity() -
                                scene.particleHandler.getObject(0).getVelocity())
                                   .x();
        EXPECT_NEAR(parting / pair.restitution, 1, 5e-4) << pair.a << " and " << pair.b;
        const double mass = sphereMass(1e-3, density[pair.a]);
        EXPECT_NEAR(scene.particleHandler.getObject(0).getMass() / mass, 1, 1e-14);
    }
}

TEST(PublishedMaterials, softGrainsTakeLongerSteps) {
    TwoGrains hard(M1, M2, 1e-7);
    const double limit = hard.stabilityLimit();
    class Soft : public PublishedScene {
    public:
        Soft() : PublishedScene(1e-7, 100) {
            addGrain({1e-3, Vec3D(-1.001e-3, 0, 0)}, M1);
            addGrain({1e-3, Vec3D(1.001e-3, 0, 0)}, M2);
        }
    } soft;
    EXPECT_NEAR(soft.getTimeStep() / hard.getTimeStep(), 10, 1e-13);
    EXPECT_NEAR(soft.stabilityLimit() / limit, 10, 1e-13);
}

}  // namespace
}  // namespace pendular::publishedMaterialsTest
