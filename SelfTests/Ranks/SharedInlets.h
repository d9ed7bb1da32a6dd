#pragma once

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/Scene.h"

/// What comes into scenes that ranks share.
namespace pendular::ranks {

/// Droplets that are caught by grains, by walls and by the end of their flight, whose momentum counts.
/// @param height m, at which the rain begins
inline Spray rainFrom(double height) {
    Spray rain;
    rain.setRain({0.006, 0.006, height}, {0.010, 0, 0}, {0, 0.010, 0}, {0.3, 0, -1});
    rain.setDropletRadius(5e-5);
    rain.setVolumeSpread(0.3);
    rain.setSpeed(5);
    rain.setFlow(40000 * rain.dropletVolume());
    rain.setMomentum(1000);
    rain.setLongestFlight(0.0022);
    return rain;
}

/// Clumps of two spheres and grains come together.
/// @param lowest, highest m, of where they come; @param numberFlow 1/s
template <class S>
void letClumpsIn(S& scene, double lowest, double highest, double numberFlow) {
    Clump rod(ClumpTemplate({{{0, 0, -0.4}, 0.5}, {{0, 0, 0.4}, 0.5}}));
    rod.setSpecies(scene.speciesHandler.getObject(0));
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    BodyMixture mixture;
    mixture.add(rod, evenSizes(1.0e-3, 1.2e-3), 2);
    mixture.add(grain, evenSizes(1.0e-3, 1.2e-3), 1);
    Inlet inlet;
    inlet.setBodies(mixture);
    inlet.setRegion(BoxRegion({0.001, 0.001, lowest}, {0.0115, 0.0115, highest}));
    inlet.setNumberFlow(numberFlow);
    scene.inletHandler.copyAndAddObject(inlet);
}

}  // namespace pendular::ranks
