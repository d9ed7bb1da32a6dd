// Grains that come and go: inlets, insert(), outlets, planes that count.
#include <algorithm>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// Above the cells of the grains, a part of a radius away from the faces.
BoxRegion roomOf(Making& making) {
    const Vec3D margin = Vec3D::Constant(0.02 * making.scales.cell);
    Vec3D from = making.lowest + margin;
    from.z() = making.top + margin.z();
    return {making.draw.give("from", from), making.draw.give("to", Vec3D(making.highest - margin))};
}

/// Diameters from a half to the whole of the largest one.
SizeDistribution anySizes(Making& making) {
    const double largest = 2 * making.scales.radius, smallest = making.draw.even(0.5, 0.95) * largest;
    SphericalParticle small;
    for (AnySpecies* const material : making.materials) {
        small.setSpecies(material);
        small.setRadius(0.5 * smallest);
        making.grainsToCome.push_back(small);
        small.setRadius(making.scales.radius);
        making.grainsToCome.push_back(small);
    }
    return evenSizes(making.draw.give("smallest", smallest), making.draw.give("largest", largest));
}

SphericalParticle anyLike(Making& making) {
    SphericalParticle like;
    like.setSpecies(making.anyMaterial());
    const Vec3D velocity = making.scales.speed * (Vec3D(0, 0, -0.7) + making.draw.inCube(0.3));
    like.setVelocity(making.draw.give("velocity", velocity));
    if (making.has("moving liquid") && making.draw.oneIn(2))
        like.setLiquidVolume(making.draw.give("film", 0.5 * making.scales.liquid()));
    return like;
}

void addInsert(Making& making) {
    const SizeDistribution sizes = anySizes(making);
    const SphericalParticle like = anyLike(making);
    const auto number = static_cast<std::size_t>(std::min(making.draw.whole(1, 6), making.recipe.grains));
    const BoxRegion room = roomOf(making);
    const Amount amount =
        making.draw.oneIn(4)
            ? Amount::solidFraction(making.draw.give("fraction", making.draw.even(0.02, 0.25)))
        : making.draw.oneIn(2) ? Amount::mass(making.draw.give("mass", 4 * making.scales.mass()))
                               : Amount::grains(number);
    making.scene.insert(sizes, room, amount, like,
                        {.sample = making.draw.oneIn(2) ? Sample::Exact : Sample::Random});
}

Clump anyRod(Making& making, double half) {
    Clump rod(ClumpTemplate({{{0, 0, -half}, 1}, {{0, 0, half}, 1}}));
    rod.setSpecies(making.anyMaterial());
    return rod;
}

void addInsertedClumps(Making& making) {
    const Clump rod = anyRod(making, 0.5);
    const double size = 1.2 * making.scales.radius;
    making.scene.insert(
        evenSizes(making.draw.give("smallest", 0.8 * size), making.draw.give("largest", size)),
        roomOf(making), Amount::grains(static_cast<std::size_t>(making.draw.whole(1, 3))), rod);
}

/// A part of the room, for a few bodies of a size (m).
BoxRegion roomForFew(Making& making, double size) {
    const Vec3D middle = 0.5 * (making.lowest + making.highest);
    const double top = making.top + 0.02 * making.scales.cell;
    const Vec3D half =
        0.9 * Vec3D::Constant(std::min({size * 2, 0.5 * (making.highest.z() - top),
                                        middle.x() - making.lowest.x(), middle.y() - making.lowest.y()}));
    const Vec3D centre(middle.x(), middle.y(), top + half.z());
    return {Vec3D(centre - half), Vec3D(centre + half)};
}

/// One in three times a mixture with grains, and one in two times so dense that they grow.
template <class Body>
void addDense(Making& making, const Body& body) {
    const double size = making.scales.radius;
    BodyMixture mixture;
    mixture.add(body, evenSizes(making.draw.give("smallest", 0.8 * size), making.draw.give("largest", size)));
    if (making.draw.oneIn(3))
        mixture.add(anyLike(making), evenSizes(0.8 * size, size), making.draw.give("share", 0.5));
    making.scene.insert(
        mixture, roomForFew(making, size),
        Amount::solidFraction(making.draw.give("fraction", making.draw.oneIn(2) ? 0.15 : 0.25)));
}

void addDenseClumps(Making& making) { addDense(making, anyRod(making, 0.4)); }

/// An ellipsoid or a rounded block that is up to twice as long as wide; its size is given where it comes.
SuperquadricGrain anySuperquadric(Making& making) {
    const auto half = [&] { return making.draw.give("half length", making.draw.even(0.5, 1)); };
    const double x = half(), y = half();
    const int exponent = making.draw.oneIn(2) ? 2 : making.draw.whole(2, 6);
    SuperquadricGrain grain(Superquadric{x, y, half(), exponent, exponent});
    grain.setSpecies(making.anyMaterial());
    return grain;
}

void addDenseSuperquadrics(Making& making) { addDense(making, anySuperquadric(making)); }

void addInsertInRun(Making& making) {
    const SizeDistribution sizes = anySizes(making);
    const SphericalParticle like = anyLike(making);
    const BoxRegion room = roomOf(making);
    const auto number = static_cast<std::size_t>(making.draw.whole(1, 4));
    making.before(making.someStep(), [&scene = making.scene, sizes, like, room, number] {
        scene.insert(sizes, room, Amount::grains(number), like, {.tries = 300});
    });
}

/// 1/s; a stream has at most a quarter of the solid fraction.
double anyFlow(Making& making) {
    const Vec3D width = making.highest - making.lowest;
    const double densest = 0.25 * 0.9 * width.x() * 0.9 * width.y() * 0.4 * making.scales.speed /
                           (making.scales.mass() / making.scales.density);
    return std::min(making.draw.even(1, 8) / making.scales.duration,
                    making.draw.even(0.2, 1) * 0.5 * densest);
}

/// The rest of an inlet of these bodies.
void addInletOf(Making& making, Inlet& inlet, double number) {
    if (making.draw.oneIn(2)) inlet.setNumberFlow(making.draw.give("flow", number));
    else inlet.setMassFlow(making.draw.give("flow", number * making.scales.mass()));
    if (making.draw.oneIn(2)) inlet.setNoRoom(NoRoom::Lost);
    if (making.draw.oneIn(3)) inlet.setWholeGrains(false);
    if (making.draw.oneIn(4))
        inlet.setTimes(making.draw.give("first", 0.2 * making.scales.duration),
                       making.draw.give("last", 0.8 * making.scales.duration));
    inlet.setSeed(static_cast<std::uint64_t>(making.draw.whole(0, 1000)));
    making.scene.inletHandler.copyAndAddObject(inlet);
}

void addInlet(Making& making) {
    Inlet inlet;
    inlet.setRegion(roomOf(making));
    inlet.setSizes(anySizes(making));
    inlet.setGrain(anyLike(making));
    addInletOf(making, inlet, anyFlow(making));
}

/// Bodies, or a mixture of them with grains. @param make a body; @param setOnly (inlet, body) brings it alone
template <class Make, class SetOnly>
void addInletOfBodies(Making& making, const Make& make, const SetOnly& setOnly) {
    Inlet inlet;
    inlet.setRegion(roomOf(making));
    const double size = 1.2 * making.scales.radius;
    const SphericalParticle grain = anyLike(making);
    auto body = make();
    body.setVelocity(grain.getVelocity());
    body.setAngularVelocity(making.draw.give(
        "spin", Vec3D(making.scales.speed / making.scales.radius * making.draw.inCube(0.3))));
    const SizeDistribution sizes =
        evenSizes(making.draw.give("smallest", 0.8 * size), making.draw.give("largest", size));
    if (making.draw.oneIn(2)) {
        BodyMixture mixture;
        mixture.add(body, sizes);
        mixture.add(grain, anySizes(making), making.draw.give("share", making.draw.even(0.1, 2)));
        inlet.setBodies(mixture);
    } else {
        setOnly(inlet, body);
        inlet.setSizes(sizes);
    }
    inlet.setRandomTurns(!making.draw.oneIn(4));
    addInletOf(making, inlet, anyFlow(making));
}

void addClumpInlet(Making& making) {
    addInletOfBodies(
        making, [&] { return anyRod(making, 0.5); },
        [](Inlet& inlet, const Clump& rod) { inlet.setClump(rod); });
}

void addSuperquadricInlet(Making& making) {
    addInletOfBodies(
        making, [&] { return anySuperquadric(making); },
        [](Inlet& inlet, const SuperquadricGrain& grain) { inlet.setSuperquadric(grain); });
}

void addOutlet(Making& making) {
    Outlet outlet;
    const Vec3D middle = 0.5 * (making.lowest + making.highest);
    const bool isEndless = std::ranges::all_of(making.isPeriodic, [](bool periodic) { return periodic; });
    if (making.draw.oneIn(2) && !isEndless) {
        int axis = making.draw.whole(0, 2);  // across which the scene does not repeat itself
        for (int k = 0; k < 2 && making.isPeriodic[static_cast<std::size_t>(axis)]; ++k)
            axis = (axis + 1) % 3;
        outlet.setPlane(making.draw.give("normal", Vec3D(Vec3D::Unit(axis))),
                        making.draw.give("point", Vec3D(middle + 0.3 * (making.highest - middle))));
    } else {
        outlet.setRegion(
            SphereRegion(making.draw.give("centre", middle), making.draw.give("radius", making.scales.cell)));
    }
    if (making.draw.oneIn(3)) outlet.setLeastAge(making.draw.give("age", 0.3 * making.scales.duration));
    if (making.draw.oneIn(3))
        outlet.setCondition([](const GrainReference& grain) { return grain.getId() % 2 == 0; });
    if (making.draw.oneIn(3))
        outlet.setSizeClasses(std::array{making.draw.give("class", making.scales.radius)});
    making.scene.outletHandler.copyAndAddObject(outlet);
}

void addFluxPlane(Making& making) {
    const Vec3D middle = 0.5 * (making.lowest + making.highest);
    const bool inclined = making.draw.oneIn(2) && !making.has("periodic");
    const Vec3D normal = inclined ? making.draw.direction() : Vec3D(Vec3D::Unit(making.draw.whole(0, 2)));
    making.scene.fluxPlaneHandler.copyAndAddObject(
        FluxPlane{making.draw.give("normal", normal), making.draw.give("point", middle)});
}

}  // namespace

std::vector<Feature> flowFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "Insert", .share = 0.12, .add = addInsert, .kinds = {"room"}},
        {.name = "InsertedClumps", .share = 0.05, .add = addInsertedClumps, .kinds = {"room", "body"}},
        {.name = "DenseClumps", .share = 0.05, .add = addDenseClumps, .kinds = {"room", "body", "dense"}},
        {.name = "DenseSuperquadrics",
         .share = byName,
         .add = addDenseSuperquadrics,
         .kinds = {"room", "body", "shape", "dense"}},
        {.name = "InsertInRun",
         .share = 0.08,
         .add = addInsertInRun,
         .loses = both,
         .kinds = {"room", "change", "comes in the run"}},
        {.name = "Inlet",
         .share = 0.1,
         .add = addInlet,
         .loses = both,
         .kinds = {"room", "inlet", "comes in the run"}},
        {.name = "ClumpInlet",
         .share = 0.05,
         .add = addClumpInlet,
         .loses = both,
         .kinds = {"room", "inlet", "body", "comes in the run"}},
        {.name = "SuperquadricInlet",
         .share = byName,
         .add = addSuperquadricInlet,
         .loses = both,
         .kinds = {"room", "inlet", "body", "shape", "comes in the run"}},
        {.name = "Outlet", .share = 0.08, .add = addOutlet, .loses = both, .kinds = {"outlet"}},
        {.name = "FluxPlane", .share = 0.1, .add = addFluxPlane},
    };
}

}  // namespace pendular::fuzz
