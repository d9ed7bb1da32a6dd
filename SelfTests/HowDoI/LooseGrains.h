#pragma once

#include "SelfTests/HowDoI/HowDoI.h"

namespace {

/// Forty grains of 1 mm radius, apart from each other in a cube of 10 mm, without walls and gravity.
struct LooseGrains : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        wallHandler.clear();
        setGravity({0, 0, 0});
        for (int k = 1; k < 40; ++k) {
            SphericalParticle grain;
            grain.setSpecies(speciesHandler.getObject(0));
            grain.setRadius(1e-3);
            grain.setPosition(0.01 * Vec3D(k % 4 + 0.3, k / 4 % 4 + 0.3, k / 16 + 0.3) / 4);
            particleHandler.copyAndAddObject(grain);
        }
        particleHandler.getObject(0).setPosition(0.01 * Vec3D(0.3, 0.3, 0.3) / 4);
        particleHandler.getObject(0).setRadius(1e-3);
    }
};

}  // namespace
