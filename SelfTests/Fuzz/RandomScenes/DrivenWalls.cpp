// Walls that forces move.
#include "Kernel/Features/Meshes/TriangleWall.h"
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

/// A closed box in a cell of which no grain has anything; none where all are taken.
std::optional<TriangleWall> boxInCell(Making& making, Vec3D& middle) {
    const std::optional<Vec3D> cell = making.takeCell();
    if (!cell) return {};
    middle = making.draw.give("middle", *cell);
    const double half = making.draw.give("half", making.draw.even(0.1, 0.3) * making.scales.cell);
    const auto at = [&](double x, double y, double z) {
        return toVector(Vec3D(middle + half * Vec3D(x, 0.8 * y, 0.6 * z)));
    };
    std::vector<Triangle> faces;
    for (const double s : {-1., 1.}) {
        const auto side = [&](auto&& corner) {
            const auto a = corner(-s, -1.), b = corner(s, -1.), c = corner(s, 1.), d = corner(-s, 1.);
            faces.push_back({a, b, c}), faces.push_back({a, c, d});
        };
        side([&](double u, double v) { return at(s, u, v); });
        side([&](double u, double v) { return at(v, s, u); });
        side([&](double u, double v) { return at(u, v, s); });
    }
    TriangleWall box;
    box.set(faces);
    box.setSpecies(making.anyMaterial());
    return box;
}

void addRotor(Making& making) {
    Vec3D middle;
    std::optional<TriangleWall> box = boxInCell(making, middle);
    if (!box) return;
    const double arm = making.scales.cell;
    RotorSettings settings{.inertia = making.draw.give(
                               "inertia", making.draw.decades(5, 100) * making.scales.mass() * arm * arm),
                           .torque = making.draw.give("torque", 5 * loadOf(making) * arm)};
    if (making.draw.oneIn(2)) settings.friction = making.draw.give("friction", 0.2 * settings.torque);
    if (making.draw.oneIn(2))
        settings.largestSpin = making.draw.give("largest", 0.2 * making.scales.speed / arm);
    box->setRotor({0.2, 0.1, 1}, middle, settings);
    TriangleWall* const added = making.scene.wallHandler.copyAndAddObject(*box);
    if (!making.draw.oneIn(3)) return;
    settings.torque *= -2;
    making.before(making.someStep(), [added, middle, settings] {
        added->setRotor({0.2, 0.1, 1}, middle, settings);
    });
}

/// With a velocity across its direction now and then, which it keeps.
void addSlider(Making& making) {
    Vec3D middle;
    std::optional<TriangleWall> box = boxInCell(making, middle);
    if (!box) return;
    SliderSettings settings{
        .mass = making.draw.give("mass", making.draw.decades(5, 100) * making.scales.mass()),
        .force = making.draw.give("force", 5 * loadOf(making))};
    const double speed = 0.1 * making.scales.speed;
    if (making.draw.oneIn(2)) settings.friction = making.draw.give("friction", 0.2 * settings.force);
    if (making.draw.oneIn(2)) settings.largestSpeed = making.draw.give("largest", 2 * speed);
    if (making.draw.oneIn(2))
        box->setVelocity(making.draw.give("velocity", Vec3D(making.draw.inCube(speed))));
    const Vec3D direction = making.draw.give("direction", making.draw.direction());
    box->setSlider(direction, settings);
    TriangleWall* const added = making.scene.wallHandler.copyAndAddObject(*box);
    if (!making.draw.oneIn(3)) return;
    settings.force *= -2;
    making.before(making.someStep(), [added, direction, settings] { added->setSlider(direction, settings); });
}

void addFreeWall(Making& making) {
    Vec3D middle;
    std::optional<TriangleWall> box = boxInCell(making, middle);
    if (!box) return;
    box->setVelocity(making.draw.give("velocity", Vec3D(making.draw.inCube(0.1 * making.scales.speed))));
    box->setFreeBody(making.draw.give("density", making.draw.decades(30, 300) * making.scales.density));
    making.scene.wallHandler.copyAndAddObject(*box);
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
        {.name = "Slider",
         .share = byName,
         .add = addSlider,
         .loses = both,
         .kinds = {"wall", "parts", "moved wall"},
         .excludes = {"WallThatGoes"}},
        {.name = "Rotor",
         .share = 0.06,
         .add = addRotor,
         .loses = both,
         .kinds = {"wall", "parts", "moved wall"},
         .excludes = {"WallThatGoes"}},
        {.name = "FreeWall",
         .share = 0.06,
         .add = addFreeWall,
         .loses = both,
         .kinds = {"wall", "parts", "moved wall"},
         .excludes = {"WallThatGoes"}},
    };
}

}  // namespace pendular::fuzz
