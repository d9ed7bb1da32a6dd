// Grains, held ones, clumps, shapes, and grains that are joined.
#include <algorithm>

#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

void addGrains(Making& making) {
    const int most = std::min(making.draw.whole(0, 40), making.recipe.grains);
    for (int k = 0; k < most; ++k)
        if (const auto grain = making.newGrain()) making.scene.particleHandler.copyAndAddObject(*grain);
}

void addHeldGrains(Making& making) {
    const int count = std::min(making.draw.whole(1, 3), making.recipe.grains);
    for (int k = 0; k < count; ++k) {
        auto grain = making.newGrain();
        if (!grain) return;
        grain->fixParticle();
        GrainReference held = making.scene.particleHandler.copyAndAddObject(*grain);
        const Vec3D velocity = 0.3 * making.scales.speed * making.draw.inCube(1);
        const bool moves = making.draw.oneIn(2);
        if (moves) held.setVelocity(making.draw.give("velocity", velocity));
    }
}

HeldAxes anyAxes(Making& making) {
    const auto one = [&] { return making.draw.oneIn(3); };
    return {one(), one(), one(), one(), one(), one()};
}
double anySpeed(Making& making) { return 0.3 * making.scales.speed; }

/// Grains that are held along and about some axes, and some that are driven along these.
void addHeldAxes(Making& making) {
    const int count = std::min(making.draw.whole(1, 5), making.recipe.grains);
    for (int k = 0; k < count; ++k) {
        auto grain = making.newGrain();
        if (!grain) return;
        GrainReference held = making.scene.particleHandler.copyAndAddObject(*grain);
        held.setHeldAxes(anyAxes(making));
        const Vec3D velocity = anySpeed(making) * making.draw.inCube(1);
        if (making.draw.oneIn(2)) held.setVelocity(making.draw.give("velocity", velocity));
    }
}

/// Bodies with a shape, in cells of their own. @param shapeOf (x, y, z) one of these half lengths (m)
template <class ShapeOf>
void addShapes(Making& making, const ShapeOf& shapeOf) {
    if (!making.shapes) return;
    const int count = std::min(making.draw.whole(4, 24), making.recipe.grains);
    for (int k = 0; k < count; ++k) {
        const auto cell = making.takeCell();
        if (!cell) return;
        const double size = 0.28 * making.scales.cell;
        const auto half = [&](std::string_view name) {
            return making.draw.give(name, making.draw.even(0.6, 1) * size);
        };
        const double x = half("half length x"), y = half("half length y"), z = half("half length z");
        auto grain = shapeOf(x, y, z);
        grain.setSpecies(making.anyMaterial());
        grain.setPosition(*cell);
        const Vec3D axis = making.draw.direction();
        grain.setOrientation({making.draw.even(-1, 1), axis.x(), axis.y(), axis.z()});
        grain.setVelocity(making.scales.speed * making.draw.inCube(1));
        grain.setAngularVelocity(making.draw.inCube(making.scales.speed / making.scales.radius));
        making.shapes->copyAndAddObject(grain);
    }
}

/// Ellipsoids and rounded blocks.
void addSuperquadrics(Making& making) {
    addShapes(making, [&](double x, double y, double z) {
        const int exponent = making.draw.oneIn(2) ? 2 : making.draw.whole(2, 6);
        return SuperquadricGrain(Superquadric{x, y, z, exponent, exponent});
    });
}

/// Their edges are as round as their overlaps of a collision ask for.
void addBlocks(Making& making) {
    addShapes(making, [&](double x, double y, double z) {
        const double radius = making.draw.even(0.6, 0.9) * std::min({x, y, z});
        return BlockGrain({x, y, z}, making.draw.give("radius", radius));
    });
}

/// Two to four spheres in a row that overlap, or at random places.
ClumpTemplate anyTemplate(Making& making) {
    std::vector<Ball> spheres;
    const int count = making.draw.whole(1, 4);
    Vec3D place = Vec3D::Zero();
    for (int k = 0; k < count; ++k) {
        const double radius = making.draw.even(0.6, 1);
        spheres.push_back({making.draw.give("centre", place), making.draw.give("radius", radius)});
        place += making.draw.even(0.4, 1.2) * radius * making.draw.direction();
    }
    return ClumpTemplate(spheres);
}

void addClumps(Making& making) {
    const ClumpTemplate shape = anyTemplate(making);
    const int count = std::min(making.draw.whole(1, 6), making.recipe.grains);
    for (int k = 0; k < count; ++k) {
        const auto cell = making.takeCell();
        if (!cell) return;
        Clump clump(shape);
        clump.setSpecies(making.anyMaterial());
        clump.setScale(
            making.draw.give("scale", making.draw.even(0.3, 0.495) * making.scales.cell / shape.getReach()));
        clump.setPosition(making.draw.give("position", *cell));
        const Vec3D axis = making.draw.direction();
        clump.setOrientation({making.draw.even(-1, 1), axis.x(), axis.y(), axis.z()});
        clump.setVelocity(making.draw.give("velocity", Vec3D(making.scales.speed * making.draw.inCube(1))));
        clump.setAngularVelocity(
            making.draw.give("spin", Vec3D(making.draw.inCube(making.scales.speed / making.scales.radius))));
        making.scene.bodyHandler.copyAndAddObject(clump);
    }
}

/// Two grains in one cell, which do not touch.
std::optional<std::array<std::uint32_t, 2>> addTwo(Making& making) {
    const auto cell = making.takeCell();
    if (!cell) return std::nullopt;
    std::array<std::uint32_t, 2> identities{};
    SphericalParticle grain;
    grain.setSpecies(making.anyMaterial());
    const Vec3D half = 0.24 * making.scales.cell * making.draw.direction();
    for (int k = 0; k < 2; ++k) {
        grain.setRadius(0.23 * making.scales.cell);
        grain.setPosition(*cell + (k == 0 ? half : Vec3D(-half)));
        grain.setVelocity(making.scales.speed * making.draw.inCube(1));
        identities[static_cast<std::size_t>(k)] =
            making.scene.particleHandler.copyAndAddObject(grain).getId();
    }
    return identities;
}

void addJoined(Making& making) {
    if (const auto two = addTwo(making)) making.scene.bodyHandler.join(*two);
}

void addJoinInRun(Making& making) {
    const auto two = addTwo(making);
    if (!two) return;
    making.before(making.someStep(), [&scene = making.scene, pair = *two] {
        for (const std::uint32_t identity : pair)
            if (!scene.particleHandler.contains(identity) || scene.bodyHandler.bodyOf(identity)) return;
        const auto a = scene.particleHandler.getObject(pair[0]), b = scene.particleHandler.getObject(pair[1]);
        if (a.isFixed() || b.isFixed()) return;
        // They may have met: spheres that overlap need a mass that is given.
        if ((a.getPosition() - b.getPosition()).norm() < a.getRadius() + b.getRadius()) return;
        scene.bodyHandler.join(pair);
    });
}

/// Bodies that are held altogether, or along and about some axes.
void addHeldBodies(Making& making) {
    for (int k = making.draw.whole(1, 3); k > 0; --k) {
        const auto two = addTwo(making);
        if (!two) return;
        BodyReference body = making.scene.bodyHandler.join(*two);
        body.setHeldAxes(making.draw.oneIn(3) ? HeldAxes::all() : anyAxes(making));
        const Vec3D velocity = anySpeed(making) * making.draw.inCube(1),
                    spin = making.draw.inCube(anySpeed(making) / making.scales.radius);
        if (making.draw.oneIn(2)) continue;
        body.setVelocity(making.draw.give("velocity", velocity));
        body.setAngularVelocity(making.draw.give("spin", spin));
    }
}

void addBodyChange(Making& making) {
    const Vec3D velocity = making.draw.give("velocity", Vec3D(making.scales.speed * making.draw.inCube(1)));
    const Vec3D spin =
        making.draw.give("spin", Vec3D(making.draw.inCube(making.scales.speed / making.scales.radius)));
    const bool removes = making.draw.oneIn(2);
    making.before(making.someStep(), [&scene = making.scene, velocity, spin, removes] {
        const auto bodies = scene.particleHandler.store().bodies.size();
        if (bodies == 0) return;
        BodyReference body =
            scene.bodyHandler.getObject(scene.particleHandler.store().bodies.numberOf(bodies - 1));
        if (removes) return scene.bodyHandler.removeObject(body.getId());
        body.setVelocity(velocity);
        body.setAngularVelocity(spin);
    });
}

}  // namespace

std::vector<Feature> bodyFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "Grains", .share = 0.95, .add = addGrains},
        {.name = "HeldGrains",
         .share = 0.12,
         .add = addHeldGrains,
         .loses = both | places,
         .kinds = {"held"}},
        {.name = "HeldAxes", .share = 0.08, .add = addHeldAxes, .loses = both | places, .kinds = {"held"}},
        {.name = "HeldBodies",
         .share = 0.08,
         .add = addHeldBodies,
         .loses = both | places,
         .kinds = {"body", "held"}},
        // A scene has them only by name, as it has one type of species then.
        {.name = "Superquadrics", .share = 0, .add = addSuperquadrics, .kinds = {"body", "shape"}},
        {.name = "Blocks", .share = 0, .add = addBlocks, .kinds = {"body", "shape"}},
        {.name = "Clumps", .share = 0.2, .add = addClumps, .kinds = {"body"}},
        {.name = "Joined", .share = 0.08, .add = addJoined, .kinds = {"body"}},
        {.name = "JoinInRun",
         .share = 0.05,
         .add = addJoinInRun,
         .loses = both,
         .kinds = {"body", "change", "joins in the run"}},
        {.name = "BodyChange",
         .share = 0.3,
         .add = addBodyChange,
         .loses = both,
         .kinds = {"change"},
         .needs = {"body"}},
    };
}

}  // namespace pendular::fuzz
