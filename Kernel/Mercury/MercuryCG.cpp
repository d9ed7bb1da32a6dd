#include "Kernel/Mercury/MercuryCG.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <utility>

#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/StateHash.h"

namespace pendular {
namespace {

using StateContact = GrainState::Contact;

/// m, from the centre of the first grain of a contact to the middle of its overlap.
Vector<double> fromGrainToPoint(const GrainState& state, std::size_t number) {
    if (!state.shapes.empty()) return state.shapes[number].toPoint;
    const StateContact& contact = state.contacts[number];
    const double length = norm(contact.shift), radius = state.grains[contact.first].radius,
                 gap = length - radius - state.grains[contact.second].radius;
    return ((radius + 0.5 * gap) / length) * contact.shift;
}

/// Turns a contact round: it is then as its second grain has it.
void reverse(GrainState& state, std::size_t number) {
    StateContact& contact = state.contacts[number];
    if (!state.shapes.empty()) {
        auto& [point, normal] = state.shapes[number];
        point -= contact.shift;
        if (normal) normal = -*normal;
    }
    std::swap(contact.first, contact.second);
    contact.shift = -contact.shift;
    contact.force = -contact.force;
}

/// Takes grains out of a state. A contact with one of them is then one with a wall at the contact point.
/// @param isOut of each grain
void makeBoundary(GrainState& state, const std::vector<bool>& isOut) {
    std::vector<StateContact> contacts;
    std::vector<GrainState::Shape> shapes;
    for (std::size_t k = 0; k < state.contacts.size(); ++k) {
        StateContact& contact = state.contacts[k];
        const bool isAtWall = contact.second == StateContact::wall;
        if (isOut[contact.first] && (isAtWall || isOut[contact.second])) continue;
        if (!isAtWall && isOut[contact.first]) reverse(state, k);
        if (!isAtWall && isOut[contact.second]) {
            contact.shift = fromGrainToPoint(state, k);
            contact.second = StateContact::wall;
        }
        contacts.push_back(contact);
        if (!state.shapes.empty()) shapes.push_back(state.shapes[k]);
    }
    std::vector<std::uint32_t> number(state.grains.size());
    std::vector<GrainState::Grain> grains;
    for (std::size_t k = 0; k < number.size(); ++k) {
        number[k] = static_cast<std::uint32_t>(grains.size());
        if (!isOut[k]) grains.push_back(state.grains[k]);
    }
    for (StateContact& contact : contacts) {
        contact.first = number[contact.first];
        if (contact.second != StateContact::wall) contact.second = number[contact.second];
    }
    state.grains = std::move(grains);
    state.contacts = std::move(contacts);
    state.shapes = std::move(shapes);
}

/// Whether a grain counts: it moves, and is of the species that is selected (negative: of any).
bool isCounted(const ParticleStore& grains, std::uint32_t place, int species) {
    return grains.translation[place].inverseMass != 0 && (species < 0 || grains.species[place] == species);
}

/// The state of a scene, in which only grains that move, and of one species if one is selected, count.
GrainState countedState(const Scene& scene, int species) {
    GrainState state = stateOf(scene);
    const ParticleStore& grains = scene.particleHandler.store();
    if (!grains.bodies.empty()) return state;  // bodies stand in the place of their grains
    std::vector<bool> isOut;
    bool any = false;
    for (const std::uint32_t place : grains.place) {
        isOut.push_back(!isCounted(grains, place, species));
        any |= isOut.back();
    }
    if (any) makeBoundary(state, isOut);
    return state;
}

/// Tells states apart: by grains, their sizes and masses, which hooks may change, and the box.
std::uint64_t hashOf(const Scene& scene) {
    const ParticleStore& grains = scene.particleHandler.store();
    std::uint64_t hash = stateHash(grains);
    const auto add = [&hash](double number) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3u;
    };
    for (const std::uint32_t place : grains.place)
        add(grains.translation[place].radius), add(grains.translation[place].inverseMass);
    for (int axis = 0; axis < 3; ++axis) add(scene.getMin()[axis]), add(scene.getMax()[axis]);
    return hash;
}

/// The mean of the squared distance from the middle of a function over the square of its width.
double varianceOf(KernelShape shape, int dimensions) {
    const double d = dimensions;
    switch (shape) {
        case KernelShape::Gauss:  // without a cut-off, as there
            return d;
        case KernelShape::Heaviside:
            return d / (d + 2);
        case KernelShape::Lucy:
            break;
    }
    // The moments of r^(d - 1) (1 - 6 r^2 + 8 r^3 - 3 r^4) from 0 to 1.
    const auto moment = [](double n) { return 1 / (n + 1) - 6 / (n + 3) + 8 / (n + 4) - 3 / (n + 5); };
    return moment(d + 1) / moment(d - 1);
}

CGPoint pointOf(const FieldSums& sums, std::size_t point) {
    using Sum = FieldSums::Sum;
    const auto at = [&](std::size_t sum) { return sums.ofAll(sum, point); };
    CGPoint found;
    const auto& n = sums.grid().counts();
    const std::array<std::size_t, 3> place{point / (n[1] * n[2]), point / n[2] % n[1], point % n[2]};
    for (std::size_t axis = 0; axis < 3; ++axis)
        found.coordinates.place[static_cast<int>(axis)] =
            sums.grid().isResolved(axis) ? sums.grid().at(axis, place[axis]) : 0;
    found.number = at(Sum::Number), found.volume = at(Sum::Volume), found.density = at(Sum::Mass);
    std::size_t part = Sum::Flux;
    for (int k = 0; k < 3; ++k) {
        found.momentum[k] = at(Sum::Momentum + static_cast<std::size_t>(k));
        found.force[k] = at(Sum::Traction + static_cast<std::size_t>(k));
        for (int l = k; l < 3; ++l) found.flux(k, l) = found.flux(l, k) = at(part++);
        for (int l = 0; l < 3; ++l)
            found.stress(k, l) = at(Sum::ContactStress + static_cast<std::size_t>(3 * k + l));
    }
    return found;
}

}  // namespace

int MercuryCG::dimensions() const {
    if (coordinates == "O") return 0;
    return static_cast<int>(coordinates.size());
}

void MercuryCG::setStandardDeviation(double deviation) {
    checkValue("CG", "standard deviation", deviation, "m", positive);
    if (dimensions() == 0)
        throw InputError("CG: a standard deviation has no meaning where no direction is resolved.");
    width = deviation / std::sqrt(varianceOf(shape, dimensions()));
}

void MercuryCG::setRadius(double radius) {
    // A sphere's mean of x^2 is r^2 / 5.
    setStandardDeviation(radius * std::sqrt(0.2 * dimensions()));
}

bool MercuryCG::isInTime(const Scene& of) const {
    // A time is a number of steps times their length, with round-off.
    const double tolerance = 1e-9 * std::abs(of.getTime());
    return of.getTime() >= timeMin - tolerance && of.getTime() <= timeMax + tolerance;
}

FieldSums MercuryCG::emptySums(const Scene& of) const {
    Vec3D low = lowest ? *lowest : of.getMin(), high = highest ? *highest : of.getMax();
    for (int axis = 0; axis < 3; ++axis)
        if (low[axis] == high[axis] && coordinates.find("XYZ"[axis]) != coordinates.npos)
            low[axis] -= width, high[axis] += width;  // the point is in the middle
    const FieldGrid grid = cell ? FieldGrid(coordinates, toVector(low), toVector(high), *cell)
                                : FieldGrid(coordinates, toVector(low), toVector(high), counts);
    return {grid, SmoothingKernel(shape, grid.dimensions(), width, getCutoff())};
}

const Scene& MercuryCG::sceneInTime() const {
    if (!scene)
        throw InputError(
            "CG: it is of no scene; take the pointer that cgHandler.copyAndAddObject() returned.");
    if (!isInTime(*scene))
        throw InputError(
            fmt::format("CG: the last step is at {:.6g} s; it must be between {:.6g} s and {:.6g} s.",
                        scene->getTime(), timeMin, timeMax));
    return *scene;
}

const FieldSums& MercuryCG::sumsNow() const {
    if (averages) {
        if (mean) return *mean;
        throw InputError("TimeAveragedCG: no output was due in its times, so that there is no mean.");
    }
    const Scene& of = sceneInTime();
    const std::size_t step = of.getNumberOfTimeSteps();
    const std::uint64_t state = hashOf(of);
    if (last && last->step == step && last->state == state) return last->sums;
    last = Last{step, state, emptySums(of)};
    last->sums.add(countedState(of, species), of.getNumberOfThreads());
    return last->sums;
}

std::array<double, 6> MercuryCG::getStandardisedParticleSizeMomenta() const {
    const Scene& of = sceneInTime();
    const ParticleStore& grains = of.particleHandler.store();
    std::vector<double> radii;
    for (const std::uint32_t place : grains.place)
        if (isCounted(grains, place, species)) radii.push_back(grains.translation[place].radius);
    const double number = static_cast<double>(radii.size());
    const auto meanOf = [&](auto&& power) {
        ExactSum sum;
        for (const double radius : radii) sum.add(power(radius));
        return radii.empty() ? 0 : sum.value() / number;
    };
    const double middle = meanOf([](double radius) { return radius; });
    const auto about = [&](int n) { return meanOf([&](double r) { return std::pow(r - middle, n); }); };
    const double variance = about(2);
    std::array<double, 6> found{number, middle, variance};
    for (std::size_t n = 3; n < 6 && variance > 0; ++n)
        found[n] = about(static_cast<int>(n)) / std::pow(variance, 0.5 * static_cast<double>(n));
    return found;
}

void MercuryCG::sample(const Scene& of) {
    if (!averages || !isInTime(of)) return;
    if (!mean) mean = emptySums(of);
    mean->add(countedState(of, species), of.getNumberOfThreads());
}

CGPoint MercuryCG::getPoint(std::size_t point) const {
    const FieldSums& sums = sumsNow();
    if (point >= sums.grid().size())
        throw InputError(
            fmt::format("CG: there is no point {}; it has {}, counted from 0.", point, sums.grid().size()));
    return pointOf(sums, point);
}

std::vector<CGPoint> MercuryCG::getPoints() const {
    const FieldSums& sums = sumsNow();
    std::vector<CGPoint> points;
    for (std::size_t k = 0; k < sums.grid().size(); ++k) points.push_back(pointOf(sums, k));
    return points;
}

CGPoint MercuryCG::evaluateAverage() const {
    CGPoint sum{.coordinates = {Vec3D::Zero()}};
    const std::vector<CGPoint> points = getPoints();
    const double share = 1 / static_cast<double>(points.size());
    for (const CGPoint& p : points) {
        sum.number += share * p.number, sum.volume += share * p.volume, sum.density += share * p.density;
        sum.momentum += share * p.momentum, sum.force += share * p.force;
        sum.flux += share * p.flux, sum.stress += share * p.stress;
    }
    return sum;
}

MercuryCG* MercuryCGHandler::getObject(std::size_t number) const {
    if (number >= all.size())
        throw InputError(fmt::format("CGHandler: there is no coarse graining {}; it has {}, counted from 0.",
                                     number, all.size()));
    return all[number].get();
}

MercuryCG* MercuryCGHandler::getLastObject() const {
    if (all.empty()) throw InputError("CGHandler: there is no coarse graining.");
    return all.back().get();
}

}  // namespace pendular
