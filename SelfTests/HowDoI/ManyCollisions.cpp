#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Scene/Collisions.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

TEST_F(HowDoI, ManyCollisions) {
    // [snippet]
    LinearViscoelasticSpecies material;
    material.setDensity(2500);                                           // kg/m^3
    material.setStiffnessAndRestitutionCoefficient(1e4, 0.5, 1.047e-5);  // N/m, 1, kg: of each grain
    const auto outcomes = collideMany(100, processorCount(), [&](std::size_t k) {
        const double speed = 0.01 * static_cast<double>(k + 1);  // m/s
        return collide(material,
                       {.radius1 = 1e-3, .radius2 = 1e-3, .normalVelocity = speed});  // infinity: a wall
    });
    fmt::print("{} of 1, {} s\n", outcomes[0].restitution, outcomes[0].contactTime);
    // [end]
    for (const CollisionOutcome& one : outcomes) EXPECT_NEAR(one.restitution, 0.5, 1e-3);
}

}  // namespace
