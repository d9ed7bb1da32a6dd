// The mean stress of grains at rest is the traction at the walls that hold them.
#include <gtest/gtest.h>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::tractionTest {
namespace {

using Linear = Species<LinearViscoelastic>;

/// Grains without friction between five planes and a piston, above, or a servo.
class Vessel : public scenes::SettlingBox<Linear> {
public:
    explicit Vessel(bool isServo) : scenes::SettlingBox<Linear>(4) {
        for (std::size_t k : {0, 1}) speciesHandler.getObject(k)->setDissipation(0.02);
        wallHandler.removeObject(4);
        InfiniteWall lid;
        lid.set({0, 0, 1}, {0, 0, 0.016});
        lid.setSpecies(speciesHandler.getObject(0));
        if (isServo) lid.setTargetForce(load, 1e-3, 0.1);
        else lid.setPiston(5e-4, load);
        lidNumber = 6;
        wallHandler.copyAndAddObject(lid);
        for (std::size_t w = 0; w < 6; ++w)
            if (w != 4) wallHandler.getObject(w).keepForces();
        setQuiet();
    }
    [[nodiscard]] InfiniteWall& lid() {
        return dynamic_cast<InfiniteWall&>(wallHandler.getObject(lidNumber));
    }
    static constexpr double load = 0.3;  // N

private:
    std::size_t lidNumber;
};

/// The sum of f_a b_b over all contacts of grains in balance is that of the forces of the walls, and of the
/// weights, at their places: with normal forces only, sigma_xx V = F_x L_x, sigma_yy V = F_y L_y, and
/// sigma_zz V = F_lid height + sum m g z. What is left is the sum of the forces on grains that are not in
/// balance, times their places.
TEST(Traction, ofWallsAndPistonIsTheMeanStress) {
    for (const bool isServo : {false, true}) {
        Vessel vessel(isServo);
        vessel.initialise();
        vessel.step(
            120000);  // the piston, on 16 contacts of four layers, fades by exp(-80 t / s), grains slower
        const double width = Vessel::width, height = vessel.lid().pointOnPlane().z;
        const double volume = width * width * height;
        double unbalanced = 0, weights = 0;  // N m
        for (std::size_t k = 0; k < vessel.particleHandler.getSize(); ++k) {
            const auto grain = vessel.particleHandler.getObject(k);
            const Vec3D weight(0, 0, -9.81 * grain.getMass());
            unbalanced += (vessel.contactForceOn(k) + weight).norm() * grain.getPosition().norm();
            weights += -weight.z() * grain.getPosition().z();
        }
        const Eigen::Matrix3d stress = meanStress(vessel, volume).contact;
        const auto force = [&](std::size_t wall) { return vessel.wallHandler.getObject(wall).getForce(); };
        // Round-off of some 300 contacts, whose forces are differences of places of up to 20 mm.
        const double bound = unbalanced / volume + 1e-12 * stress.norm();
        EXPECT_LT(unbalanced / volume, 1e-6 * stress.norm()) << isServo;  // it is at rest
        EXPECT_NEAR(stress(0, 0), force(0).x() / (width * height), bound);
        EXPECT_NEAR(force(0).x(), -force(1).x(), 1e-6 * Vessel::load);
        EXPECT_NEAR(stress(1, 1), force(2).y() / (width * height), bound);
        EXPECT_NEAR(stress(2, 2), force(6).z() / (width * width) + weights / volume, bound);
        // And that of the piston, or of the servo, is the load.
        const double weight = isServo ? 0 : 5e-4 * 9.81;
        EXPECT_NEAR(force(6).z(), Vessel::load + weight, 1e-6 * Vessel::load) << isServo;
        EXPECT_GT(stress(0, 0), 0.2 * stress(2, 2));
    }
}

}  // namespace
}  // namespace pendular::tractionTest
