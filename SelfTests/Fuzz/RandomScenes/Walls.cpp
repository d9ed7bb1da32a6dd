// Planes, cylinders, axisymmetric walls, at rest and moving.
#include <numbers>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// Along the axes that do not repeat themselves.
void addPlanes(Making& making) {
    for (int axis = 0; axis < 3; ++axis) {
        if (making.isPeriodic[static_cast<std::size_t>(axis)]) continue;
        making.isClosed[static_cast<std::size_t>(axis)] = true;
        for (const double side : {-1.0, 1.0}) {
            InfiniteWall wall;
            wall.setSpecies(making.anyMaterial());
            wall.set(making.draw.give("normal", Vec3D(side * Vec3D::Unit(axis))),
                     making.draw.give("point", side < 0 ? making.lowest : making.highest));
            making.scene.wallHandler.copyAndAddObject(wall)->keepForces(making.draw.oneIn(4));
        }
    }
}

Vec3D middleOf(const Making& making) {
    return {0.5 * (making.lowest.x() + making.highest.x()), 0.5 * (making.lowest.y() + making.highest.y()),
            0.5 * (making.lowest.z() + making.highest.z())};
}

/// m, around the z-axis through the middle: what the outermost grains nearly touch.
double radiusAround(const Making& making) {
    const double x = 0.5 * (making.highest.x() - making.lowest.x() - making.scales.cell),
                 y = 0.5 * (making.highest.y() - making.lowest.y() - making.scales.cell);
    return std::hypot(x, y) + (making.scales.touching ? 0.505 : 0.72) * making.scales.cell;
}

template <class Wall>
void moveNowAndThen(Making& making, Wall& wall) {
    const double speed = 0.3 * making.scales.speed;
    if (making.draw.oneIn(3))
        wall.setVelocity(making.draw.give("velocity", Vec3D(making.draw.inCube(speed))));
    if (making.draw.oneIn(3))
        wall.setAngularVelocity(
            making.draw.give("spin", Vec3D(making.draw.inCube(0.1 * speed / radiusAround(making)))),
            middleOf(making));
}

void addCylinder(Making& making) {
    InfiniteCylinder wall;
    wall.setSpecies(making.anyMaterial());
    wall.set(making.draw.give("axis", Vec3D(0, 0, 1)), making.draw.give("point", middleOf(making)),
             making.draw.give("radius", radiusAround(making)), CylinderSide::Inside);
    if (making.draw.oneIn(3))
        wall.setAngularVelocity(
            making.draw.give("spin", Vec3D(0, 0, making.scales.speed / radiusAround(making))),
            middleOf(making));
    making.scene.wallHandler.copyAndAddObject(wall);
}

/// Beside the outermost grains, upright.
void addRod(Making& making) {
    InfiniteCylinder wall;
    wall.setSpecies(making.anyMaterial());
    const double radius = making.draw.decades(0.2, 5) * making.scales.radius;
    Vec3D point = middleOf(making);
    point.x() = making.lowest.x() - radius;
    wall.set({0, 0, 1}, making.draw.give("point", point), making.draw.give("radius", radius),
             CylinderSide::Outside);
    moveNowAndThen(making, wall);
    making.scene.wallHandler.copyAndAddObject(wall);
}

void addTube(Making& making) {
    FiniteCylinder wall;
    wall.setSpecies(making.anyMaterial());
    wall.set(
        making.draw.give("axis", Vec3D(0, 0, 1)), making.draw.give("point", middleOf(making)),
        making.draw.give("radius", radiusAround(making)),
        making.draw.give("length", making.draw.even(0.5, 1.5) * (making.highest.z() - making.lowest.z())));
    making.scene.wallHandler.copyAndAddObject(wall);
}

/// A funnel below the grains, which ends in an outlet, with a rim around them.
void addFunnel(Making& making) {
    AxisymmetricWall wall;
    wall.setSpecies(making.anyMaterial());
    const double wide = making.draw.give("rim", 1.05 * radiusAround(making));
    const double narrow = making.draw.give("outlet", making.draw.even(0, 0.4) * wide);
    Vec3D tip = middleOf(making);
    tip.z() = making.lowest.z();
    const double depth = making.draw.even(0, 1) * making.scales.cell;
    wall.set({0, 0, 1}, making.draw.give("tip", tip),
             {{narrow, -depth}, {wide, 0}, {wide, making.draw.give("height", making.scales.cell)}});
    moveNowAndThen(making, wall);
    making.scene.wallHandler.copyAndAddObject(wall);
}

InfiniteWall planeBelow(Making& making) {
    InfiniteWall wall;
    wall.setSpecies(making.anyMaterial());
    wall.set({0, 0, -1}, making.draw.give("point", making.lowest));
    return wall;
}

void addMovingPlane(Making& making) {
    InfiniteWall wall = planeBelow(making);
    wall.setVelocity(
        making.draw.give("velocity", Vec3D(0, 0, 0.3 * making.scales.speed * making.draw.even(-0.5, 1))));
    making.scene.wallHandler.copyAndAddObject(wall);
}

void addVibratingPlane(Making& making) {
    InfiniteWall wall = planeBelow(making);
    const double height = making.draw.give("height", 0.05 * making.scales.radius),
                 rate = making.draw.give("rate", 2 * std::numbers::pi * 3 / making.scales.duration);
    wall.setMotion([height, rate](double time) {
        return Eigen::Isometry3d(Eigen::Translation3d(0, 0, height * std::sin(rate * time)));
    });
    making.scene.wallHandler.copyAndAddObject(wall);
}

void addBelt(Making& making) {
    InfiniteWall wall = planeBelow(making);
    wall.setSurfaceVelocity(making.draw.give(
        "velocity", Vec3D(making.draw.even(-1, 1), making.draw.even(-1, 1), 0) * making.scales.speed));
    making.scene.wallHandler.copyAndAddObject(wall);
}

/// It comes in a step, goes in a later one; and in a scene that goes on, it is set up if it has come by then.
void addWallThatComes(Making& making) {
    InfiniteWall wall;
    wall.setSpecies(making.anyMaterial());
    wall.set(making.draw.give("normal", Vec3D(0, 0, -1)),
             making.draw.give("point", Vec3D(making.lowest - Vec3D(0, 0, 0.3 * making.scales.radius))));
    if (making.draw.oneIn(2))
        wall.setVelocity(making.draw.give("velocity", Vec3D(0, 0, 0.3 * making.scales.speed)));
    const int comes = making.someStep(), goes = comes + making.draw.whole(1, making.scales.steps);
    const bool keepsForces = making.draw.oneIn(2);
    const auto add = [&scene = making.scene, wall, keepsForces] {
        scene.wallHandler.copyAndAddObject(wall)->keepForces(keepsForces);
        return scene.wallHandler.getSize() - 1;
    };
    const auto number = std::make_shared<std::size_t>(0);
    if (making.goesOnFrom > comes) making.atEnd([add, number] { *number = add(); });
    making.before(comes, [add, number] { *number = add(); });
    making.before(goes, [&scene = making.scene, number] { scene.wallHandler.removeObject(*number); });
}

void addWallThatGoes(Making& making) {
    const double share = making.draw.even(0, 1);
    making.before(making.someStep(), [&scene = making.scene, share] {
        std::vector<std::size_t> there;
        for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w)
            if (!scene.wallHandler.isRemoved(w)) there.push_back(w);
        if (there.empty()) return;
        scene.wallHandler.removeObject(
            there[static_cast<std::size_t>(share * static_cast<double>(there.size()))]);
    });
}

}  // namespace

std::vector<Feature> wallFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "Planes", .share = 0.5, .add = addPlanes, .loses = both, .kinds = {"wall"}},
        {.name = "Cylinder", .share = 0.08, .add = addCylinder, .loses = both, .kinds = {"wall"}},
        {.name = "Rod", .share = 0.06, .add = addRod, .loses = both, .kinds = {"wall"}},
        {.name = "Tube", .share = 0.05, .add = addTube, .loses = both, .kinds = {"wall", "parts"}},
        {.name = "Funnel", .share = 0.06, .add = addFunnel, .loses = both, .kinds = {"wall", "parts"}},
        {.name = "MovingPlane", .share = 0.06, .add = addMovingPlane, .loses = both, .kinds = {"wall"}},
        {.name = "VibratingPlane", .share = 0.06, .add = addVibratingPlane, .loses = both, .kinds = {"wall"}},
        {.name = "Belt", .share = 0.05, .add = addBelt, .loses = both, .kinds = {"wall"}},
        {.name = "WallThatComes",
         .share = 0.08,
         .add = addWallThatComes,
         .loses = both,
         .kinds = {"wall", "change"}},
        // The wall that goes may be one that closes the box.
        {.name = "WallThatGoes",
         .share = 0.06,
         .add = addWallThatGoes,
         .loses = both | places,
         .kinds = {"wall", "change"},
         .needs = {"wall"}},
    };
}

}  // namespace pendular::fuzz
