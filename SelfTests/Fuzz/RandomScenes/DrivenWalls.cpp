// Planes that forces move.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// Above the grains.
InfiniteWall lidOf(Making& making) {
    InfiniteWall lid;
    lid.setSpecies(making.anyMaterial());
    Vec3D point = making.lowest;
    point.z() = making.top;
    lid.set({0, 0, 1}, making.draw.give("point", point));
    return lid;
}

/// N, that brings a grain to the scene's speed in the run.
double loadOf(Making& making) {
    return making.draw.decades(0.1, 10) * making.scales.mass() * making.scales.speed / making.scales.duration;
}

void addPiston(Making& making) {
    InfiniteWall lid = lidOf(making);
    const double mass = making.draw.decades(1, 50) * making.scales.mass();
    lid.setPiston(making.draw.give("mass", mass), making.draw.give("load", 10 * loadOf(making)));
    InfiniteWall* const added = making.scene.wallHandler.copyAndAddObject(lid);
    if (!making.draw.oneIn(3)) return;
    const double later = making.draw.give("load later", -5 * loadOf(making));
    making.before(making.someStep(), [added, mass, later] { added->setPiston(mass, later); });
}

void addForceServo(Making& making) {
    InfiniteWall lid = lidOf(making);
    lid.setTargetForce(making.draw.give("force", loadOf(making)),
                       making.draw.give("time", 0.1 * making.scales.duration),
                       making.draw.give("largest", 0.2 * making.scales.speed));
    InfiniteWall* const added = making.scene.wallHandler.copyAndAddObject(lid);
    if (!making.draw.oneIn(3)) return;
    const Vec3D velocity = making.draw.give("velocity", Vec3D(0, 0, 0.1 * making.scales.speed));
    making.before(making.someStep(), [added, velocity] { added->setVelocity(velocity); });
}

}  // namespace

std::vector<Feature> drivenWallFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "Piston",
         .share = 0.07,
         .add = addPiston,
         .loses = both,
         .kinds = {"wall", "driven wall"},
         .excludes = {"room", "WallThatGoes"},
         .needs = {"Grains"}},
        {.name = "ForceServo",
         .share = 0.06,
         .add = addForceServo,
         .loses = both,
         .kinds = {"wall", "driven wall"},
         .excludes = {"room", "WallThatGoes"},
         .needs = {"Grains"}},
    };
}

}  // namespace pendular::fuzz
