#include "Kernel/Scene/CollisionScene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Walls/InfiniteWall.h"

namespace pendular {
namespace {

/// A species of a scene, for grains and walls of another one with the same laws.
struct SharedSpecies {
    std::size_t index;
    const SpeciesOwner* owner;

    [[nodiscard]] int getIndex() const { return static_cast<int>(index); }
    [[nodiscard]] const SpeciesOwner* getOwner() const { return owner; }
};

}  // namespace

double touchTime(const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
    const double overlap = largestSoundOverlap * std::min(bodies.radius1, bodies.radius2),
                 spring = pair.laws.normalStiffness(pair.a, pair.b, bodies, overlap);
    return std::max(halfPeriod(pair, bodies, effectiveMass),
                    std::numbers::pi * std::sqrt(effectiveMass / spring));
}

CollisionScene::CollisionScene(ContactLaws& of, const CollidingBodies& pair, const CollisionApproach& given,
                               double step, const Integrator& integrator)
    : meeting(pair), approach(given) {
    setLaws(of);
    const double m1 = of.massOf(pair.species1, pair.bodies.radius1);
    const double share = pair.isAtWall() ? 1 : 1 - m1 / (m1 + of.massOf(pair.species2, pair.bodies.radius2));
    addGrain(pair.species1, pair.bodies.radius1, -1, share);
    if (pair.isAtWall()) {
        const SharedSpecies species{pair.species2, of.owner()};
        wallHandler.copyAndAddObject(InfiniteWall({1, 0, 0}, {0, 0, 0}, &species));
    } else {
        addGrain(pair.species2, pair.bodies.radius2, 1, 1 - share);
    }
    setTimeStep(step);
    setIntegrator(integrator);
    acceptUnstableTimeStep();
    acceptOverlaps(0.5);
    setQuiet();  // one of hundreds
}

CollisionScene::~CollisionScene() { completeLeftRun(); }

void CollisionScene::addGrain(std::size_t species, double radius, double side, double share) {
    const SharedSpecies shared{species, laws().owner()};
    SphericalParticle grain;
    grain.setSpecies(&shared);
    grain.setRadius(radius);
    const double gap = meeting.isAtWall() ? approach.gap : 0.5 * approach.gap;
    grain.setPosition({side * (radius + gap), side * share * approach.offset, 0});
    grain.setVelocity({-side * share * approach.normal, -side * share * approach.slip, 0});
    grain.setAngularVelocity({0, 0, side < 0 ? approach.spin1 : approach.spin2});
    particleHandler.copyAndAddObject(grain);
}

std::optional<CollisionEnd> CollisionScene::look() {
    const bool touches = overlap() > 0;
    const double parting = relativeVelocity().dot(normal());
    if (touches && !begin) begin = getTime();
    const bool isStuck = creeps(touches, parting);
    if (begin) {
        if (!touches && timeOfTouch == 0) timeOfTouch = getTime() - *begin;
        if (leaves && parting < 0) return CollisionEnd::DrawnBack;
        leaves = parting > 0;
    }
    if (begin && !touches && !(contactForceOn(0).squaredNorm() > 0)) return CollisionEnd::Parted;
    if (isStuck) return CollisionEnd::Creeps;
    return {};
}

/// Whether the collision ends as creeping: the energy of the approach or parting has been below 1e-10 of
/// the initial one for four contact times, or the touch, or the bridge after it, lasts too long. Elastic
/// bodies are so slow only where they turn, for 1e-5 of a contact time, and 1e-5 of the speed is a tenth
/// of the smallest error that can be asked for. By Hertz's law a touch at a lower speed lasts longer, as
/// the fifth root: 40 times as long at 1e-8 of the speed that gives the largest sound overlap.
bool CollisionScene::creeps(bool touches, double parting) {
    constexpr double still = 1e-5, stillTimes = 4, longestTouch = 100, longestBridge = 2000;
    const double now = getTime(), unit = meeting.touchTime;
    if (!begin) return now > 2 * approach.gap / approach.normal + longestTouch * unit;
    if (!(std::abs(parting) < still * std::hypot(approach.normal, approach.slip))) lastMoved = now;
    return now - lastMoved > stillTimes * unit ||
           now - *begin > (touches ? longestTouch : longestBridge) * unit;
}

Vec3D CollisionScene::shift() {
    const Vec3D place = particleHandler.getObject(0).getPosition();
    if (meeting.isAtWall()) return {-place.x(), 0, 0};
    return particleHandler.getObject(1).getPosition() - place;
}

double CollisionScene::overlap() {
    const double reach = meeting.bodies.radius1 + (meeting.isAtWall() ? 0 : meeting.bodies.radius2);
    return reach - shift().norm();
}

Vec3D CollisionScene::velocityOf(std::size_t body) {
    if (body == 1 && meeting.isAtWall()) return Vec3D::Zero();
    return particleHandler.getObject(body).getVelocity();
}

double CollisionScene::spinOf(std::size_t body) {
    if (body == 1 && meeting.isAtWall()) return 0;
    return particleHandler.getObject(body).getAngularVelocity().z();
}

}  // namespace pendular
