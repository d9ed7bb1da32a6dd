#include "Tools/Studies/AccuracyVersusCost/ShearCell.h"

#include <gtest/gtest.h>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"

namespace pendular::shearCellTest {
namespace {

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

// The mean of the stress over all contacts is that at the wall, except for two terms of the momentum balance:
// the change of sum(m v_x z) during the time T, which is rho phi rate H^2 / (12 T) = 1.0 Pa if a linear
// profile becomes a plug (H = 16 mm, T = 0.3 s), and the stress of the fluctuations, rho phi (rate d)^2 = 0.6
// Pa.
TEST(HeavyShearCell, stressOfTheContactsIsThatAtTheWall) {
    scenes::ShearCellOptions options;
    options.across = 6;
    options.strainBefore = 1;
    scenes::ShearCell<Wet> cell(options, 1);
    cell.initialise();
    const scenes::ShearFigures figures = cell.run();
    EXPECT_NEAR(figures.shearStress, figures.wallStress, 1.6);
    EXPECT_GT(figures.shearStress, 20);  // so that the difference is a small one

    // The capillary tension is that of as many bridges as there are, each with a force between those at
    // contact and at rupture and a distance of at most 2 R + S_c. Bridges with a wall count one grain, others
    // two.
    const auto species = scenes::BedMaterial().species<Wet>();
    const Bodies bodies{options.radius, options.radius};
    const auto bridge = species.LiquidBridgeBagheri::prepare(bodies);
    const double grainVolume = 4.0 / 3 * std::numbers::pi * std::pow(options.radius, 3);
    const double perVolume =
        figures.coordination * options.solidFraction / grainVolume;  // grains x bodies / m^3
    EXPECT_LT(figures.capillaryTension,
              perVolume * bridge.force(0) * (2 * options.radius + bridge.range()) / 3);
    EXPECT_GT(figures.capillaryTension,
              0.5 * 0.8 * perVolume * bridge.force(bridge.range()) * 1.95 * options.radius / 3);
}

}  // namespace
}  // namespace pendular::shearCellTest
