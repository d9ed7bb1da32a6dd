#include "SelfTests/Fuzz/RandomScenes/Making.h"

#include <algorithm>
#include <cmath>

namespace pendular::fuzz {

Scales::Scales(const Recipe& recipe) {
    Draws draw(recipe, "scales");
    radius = draw.decades(1e-4, 1e-2);
    density = draw.decades(500, 8000);
    modulus = draw.decades(1e6, 1e9);
    // Two grains that meet at the speed c sqrt(E/rho) overlap by some c^(4/5) of their radius (Hertz).
    speed = draw.decades(0.003, 0.03) * std::sqrt(modulus / density);
    steps = std::min(draw.whole(60, 220), recipe.steps);
    restartStep = draw.whole(1, std::max(1, steps - 1));
    // The step is of the order of what dense beds of these grains stand; in all steps a grain flies about its
    // radius.
    step = 0.3 * radius * std::sqrt(density / modulus);
    duration = steps * step;
    touching = draw.chance(0.4);
    cell = radius * (touching ? draw.even(1.96, 2) : draw.even(2.02, 2.5));
    for (int& count : cells) count = draw.whole(3, 4);
    lowest = draw.oneIn(3) ? Vec3D(draw.inCube(1)) : Vec3D::Zero();
    isOneType = draw.chance(0.5);
}

Making::Making(Scene& made, SpeciesOfScene& speciesOf, Actions& actionsOf, const Recipe& of, int restartStep)
    : scene(made),
      species(speciesOf),
      actions(actionsOf),
      recipe(of),
      scales(of),
      draw(of, "cells"),
      goesOnFrom(restartStep),
      lowest(scales.lowest) {
    for (int axis = 0; axis < 3; ++axis)
        highest[axis] = lowest[axis] + scales.cells[static_cast<std::size_t>(axis)] * scales.cell;
    top = highest.z();
    if (has("room")) highest.z() += 3 * scales.cell;
    for (int x = 0; x < scales.cells[0]; ++x)
        for (int y = 0; y < scales.cells[1]; ++y)
            for (int z = 0; z < scales.cells[2]; ++z)
                freeCells.emplace_back(lowest + scales.cell * Vec3D(x + 0.5, y + 0.5, z + 0.5));
    for (std::size_t k = freeCells.size(); k > 1; --k)
        std::swap(freeCells[k - 1],
                  freeCells[static_cast<std::size_t>(draw.whole(0, static_cast<int>(k) - 1))]);
}

bool Making::has(std::string_view word) const {
    return std::ranges::any_of(recipe.features,
                               [&](const std::string& name) { return featureNamed(name).is(word); });
}

unsigned Making::loses() const {
    unsigned all = nothing;
    for (const std::string& name : recipe.features) all |= featureNamed(name).loses;
    return all;
}

std::optional<Vec3D> Making::takeCell() {
    if (freeCells.empty()) return std::nullopt;
    const Vec3D cell = freeCells.back();
    freeCells.pop_back();
    return cell;
}

std::optional<SphericalParticle> Making::newGrain() {
    const double share = scales.touching  ? draw.even(0.975, 1)
                         : draw.oneIn(10) ? draw.even(0.1, 1)
                                          : draw.even(0.4, 1);
    const Vec3D offset = draw.inCube(1), velocity = scales.speed * draw.inCube(1),
                spin = draw.inCube(scales.speed / scales.radius);
    const bool isSpinning = draw.oneIn(2);
    const std::optional<Vec3D> cell = takeCell();
    if (!cell) return std::nullopt;
    const double radius = share * scales.radius;
    SphericalParticle grain;
    grain.setSpecies(anyMaterial());
    grain.setRadius(draw.give("radius", radius));
    grain.setPosition(
        draw.give("position", Vec3D(*cell + std::max(0.0, 0.5 * scales.cell - radius) * offset)));
    grain.setVelocity(draw.give("velocity", velocity));
    if (isSpinning) grain.setAngularVelocity(draw.give("spin", spin));
    return grain;
}

std::optional<GrainReference> Making::someGrain(double share) const {
    std::vector<GrainReference> single;
    for (const GrainReference grain : scene.particleHandler)
        if (!scene.bodyHandler.bodyOf(grain.getId())) single.push_back(grain);
    if (single.empty()) return std::nullopt;
    return single[std::min(single.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(single.size())))];
}

void Making::makePeriodic(int axis) {
    bool& is = isPeriodic[static_cast<std::size_t>(axis)];
    if (is) return;
    is = true;
    const double low = draw.give("low", lowest[axis]);
    scene.setPeriodic(axis, low, draw.give("high", highest[axis]));
}

void Making::before(int steps, std::function<void()> action) {
    actions.before.emplace(static_cast<std::size_t>(steps), std::move(action));
}

void Making::endOf(std::string_view name) {
    anyWrongUsed |= draw.usedWrong(), anyNoNumber |= draw.gaveNoNumber();
    records += fmt::format("  {}:{}\n", name, draw.record());
}

void Making::chooseStep() {
    scene.setTimeStep(scales.step);  // for what asks before there is one
    const double limit = scene.stabilityLimit(grainsToCome);
    // What a hook changes may lower the limit.
    const double factor = has("joins in the run") ? 0.3 : has("change") ? 0.6 : 0.8;
    const double step = std::min(scales.step, factor * limit);
    scene.setTimeStep(draw.give("step", step));
    scene.setTimeMax(draw.give("end", scales.steps * step));
}

void Making::addAll() {
    if (!has("material")) {  // a scene needs one
        const Feature& plain = featureNamed("HertzianViscoelasticMindlin");
        beginWith(plain.name);
        plain.add(*this);
    }
    for (const std::string& name : recipe.features) {
        beginWith(name);
        try {
            featureNamed(name).add(*this);
        } catch (...) {
            endOf(name);
            throw;
        }
        endOf(name);
    }
    beginWith("Scene");
    scene.setQuiet();
    try {
        chooseStep();
        for (const auto& action : atEndOfSetUp) action();
    } catch (...) {
        endOf("Scene");
        throw;
    }
    endOf("Scene");
}

}  // namespace pendular::fuzz
