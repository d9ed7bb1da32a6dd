#include "Kernel/Mercury/MercuryChute.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "Kernel/Features/Insertion/Insertion.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"

namespace pendular {

Chute::Chute() { setInflowHeight(inflowHeight); }

void Chute::setChuteAngleAndMagnitudeOfGravity(double angle, double gravity) {
    checkValue("Chute", "angle", angle, "degrees", {-90, 90, true, true});
    checkValue("Chute", "gravity", gravity, "m/s^2", notNegative);
    chuteAngle = angle * constants::degree;
    setGravity(gravity * Vec3D(std::sin(chuteAngle), 0, -std::cos(chuteAngle)));
}

void Chute::setChuteAngle(double angle) {
    const double gravity = getGravity().norm();
    if (!(gravity > 0))
        throw InputError(
            "Chute: its angle is set without gravity, which it turns; give both with "
            "setChuteAngleAndMagnitudeOfGravity(), or call setGravity() before.");
    setChuteAngleAndMagnitudeOfGravity(angle, gravity);
}

void Chute::setFixedParticleRadius(double radius) {
    checkValue("Chute", "radius of the grains of the bottom", radius, "m", notNegative);
    fixedRadius = radius;
}

void Chute::setRoughBottomType(std::string_view type) {
    constexpr std::array<std::string_view, 4> names{"MONOLAYER_ORDERED", "MONOLAYER_DISORDERED", "MULTILAYER",
                                                    "FLAT"};
    const auto* const found = std::ranges::find(names, type);
    if (found == names.end())
        throw InputError(fmt::format("Chute: type of the bottom = '{}'; it must be one of {}, {}, {}, {}.",
                                     type, names[0], names[1], names[2], names[3]));
    bottom = static_cast<RoughBottomType>(found - names.begin());
}

void Chute::setInflowParticleRadius(double smallest, double largest) {
    checkValue("Chute", "smallest radius of what flows in", smallest, "m", radiusRange);
    checkValue("Chute", "largest radius of what flows in", largest, "m", {smallest, infinity, true, false});
    smallestInflow = smallest, largestInflow = largest;
}

void Chute::setInflowHeight(double height) {
    checkValue("Chute", "height of the inflow", height, "m", positive);
    inflowHeight = height;
    setZMax(getZMin() + height);
}

void Chute::setInflowVelocityVariance(double share) {
    checkValue("Chute", "variance of the velocity of the inflow", share, "", fromZeroTo(1));
    inflowVariance = share;
}

void Chute::setupInitialConditions() {
    if (speciesHandler.isEmpty())
        throw InputError("Chute: it has no species; add one to speciesHandler before solve().");
    setupSideWalls();
    createBottom();
    setupInflow();
    setupOutflow();
}

void Chute::setupSideWalls() {
    if (isPeriodic) {
        PeriodicBoundary sides;
        sides.set(Vec3D(0, 1, 0), getYMin(), getYMax());
        boundaryHandler.copyAndAddObject(sides);
        return;
    }
    const auto* const species = speciesHandler.getObject(0);
    wallHandler.copyAndAddObject(InfiniteWall(Vec3D(0, -1, 0), getMin(), species));
    wallHandler.copyAndAddObject(InfiniteWall(Vec3D(0, 1, 0), getMax(), species));
}

/// Grains come at the beginning of the chute, as many as have room, above the grains of the bottom.
void Chute::setupInflow() {
    SphericalParticle grain(speciesHandler.getObject(0));
    grain.setRadius(largestInflow);
    const double spread = inflowVariance * inflowVelocity;
    CubeInsertionBoundary inflow;
    const double above = bottom == FLAT ? 0 : std::min(fixedRadius, getZMax() - getZMin());
    inflow.set(grain, maxFailed, getMin() + Vec3D(0, 0, above),
               Vec3D(getXMin() + 2 * largestInflow, getYMax(), getZMax()),
               Vec3D(inflowVelocity - spread, 0, 0), Vec3D(inflowVelocity + spread, 0, 0), smallestInflow,
               largestInflow);
    boundaryHandler.copyAndAddObject(inflow);
}

void Chute::setupOutflow() {
    DeletionBoundary beyond;
    beyond.set(Vec3D(1, 0, 0), getXMax());
    boundaryHandler.copyAndAddObject(beyond);
    beyond.set(Vec3D(-1, 0, 0), -getXMin());
    boundaryHandler.copyAndAddObject(beyond);
}

void Chute::addFloor(double height) {
    wallHandler.copyAndAddObject(
        InfiniteWall(Vec3D(0, 0, -1), Vec3D(0, 0, height), speciesHandler.getObject(0)));
}

SphericalParticle Chute::fixedGrain() {
    SphericalParticle grain(speciesHandler.getObject(0));
    grain.setRadius(fixedRadius);
    grain.fixParticle();
    return grain;
}

void Chute::createBottom() {
    if (fixedRadius < 1e-12 || bottom == FLAT) return addFloor(getZMin());
    if (bottom == MONOLAYER_ORDERED) return layInRows();
    if (bottom == MONOLAYER_DISORDERED) return layAtRandom();
    layDeep();
}

/// As many as have room side by side, at even distances.
void Chute::layInRows() {
    const Vec3D length = getMax() - getMin();
    std::array<int, 2> counts{};
    for (const int axis : {0, 1})
        counts[axis] = std::max(1, static_cast<int>(length[axis] / (2 * fixedRadius) * (1 + 1e-12)));
    SphericalParticle grain = fixedGrain();
    for (int i = 0; i < counts[0]; ++i)
        for (int j = 0; j < counts[1]; ++j) {
            grain.setPosition(getMin() + Vec3D(fixedRadius + i * length.x() / counts[0],
                                               fixedRadius + j * length.y() / counts[1], 0));
            particleHandler.copyAndAddObject(grain);
        }
    addFloor(getZMin() - length.x() / counts[0]);
}

void Chute::layAtRandom() {
    constexpr int mostFailed = 500;
    SphericalParticle grain = fixedGrain();
    const Vec3D low = getMin() + Vec3D(fixedRadius, fixedRadius, 0),
                high = getMax() - Vec3D(fixedRadius, fixedRadius, 0);
    for (int failed = 0; failed < mostFailed;) {
        grain.setPosition({random.getRandomNumber(low.x(), high.x()),
                           random.getRandomNumber(low.y(), high.y()), getZMin()});
        if (!checkParticleForInteraction(grain)) ++failed;
        else failed = 0, particleHandler.copyAndAddObject(grain);
    }
    addFloor(getZMin() - 0.5 * fixedRadius);
}

/// Centres down to 2.4 radii below the bottom; whole grains are in a box that is larger by a radius. As dense
/// as can be: among walls that are near each other there is less room.
void Chute::layDeep() {
    constexpr std::array fractions{0.55, 0.5, 0.45, 0.4, 0.35, 0.3};
    const double thickness = 2.4 * fixedRadius;
    const SphericalParticle grain = fixedGrain();
    const SizeDistribution size =
        singleSizes(std::array{2 * fixedRadius}, std::array{1.0}, SizeBasis::Number);
    const BoxRegion layer(getMin() - Vec3D(0, 0, thickness + fixedRadius),
                          Vec3D(getXMax(), getYMax(), getZMin() + fixedRadius));
    for (const double fraction : fractions) {
        try {
            insert(size, layer, Amount::solidFraction(fraction), grain);
            break;
        } catch (const InputError&) {
            if (fraction == fractions.back()) throw;
        }
    }
    addFloor(getZMin() - thickness - fixedRadius);
}

}  // namespace pendular
