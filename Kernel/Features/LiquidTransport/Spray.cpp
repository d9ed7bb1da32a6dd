#include "Kernel/Features/LiquidTransport/Spray.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfSpray = "Spray";

/// What the random numbers of a droplet are for.
enum Purpose : std::uint32_t { Place1, Place2, Angle, Azimuth, Size, PurposeCount };

/// Unit, across a unit vector, in the plane of that and the given one.
Vector<double> acrossIn(const Vector<double>& direction, const Vec3D& given) {
    const Vector<double> vector = checkedVector(ownerOfSpray, "across", given, "");
    const Vector<double> part = vector - dot(vector, direction) * direction;
    return checkedDirection(ownerOfSpray, "length of the part of 'across' that is across the direction",
                            toEigen(part));
}

}  // namespace

void Spray::setRain(const Vec3D& at, const Vec3D& along1, const Vec3D& along2, const Vec3D& towards) {
    middle = checkedVector(ownerOfSpray, "middle", at, "m");
    edge1 = checkedVector(ownerOfSpray, "edge1", along1, "m");
    edge2 = checkedVector(ownerOfSpray, "edge2", along2, "m");
    direction = checkedDirection(ownerOfSpray, "length of the direction", towards);
    shape = Shape::Rain;
}

void Spray::setFlatFan(const Vec3D& nozzle, const Vec3D& towards, const Vec3D& across, double fanAngle) {
    checkValue(ownerOfSpray, "angle", fanAngle, "rad", positiveUpTo(std::numbers::pi));
    middle = checkedVector(ownerOfSpray, "nozzle", nozzle, "m");
    direction = checkedDirection(ownerOfSpray, "length of the direction", towards);
    edge1 = acrossIn(direction, across);
    angle = fanAngle;
    shape = Shape::FlatFan;
}

void Spray::setCone(const Vec3D& nozzle, const Vec3D& towards, double coneAngle) {
    checkValue(ownerOfSpray, "angle", coneAngle, "rad", positiveUpTo(2 * std::numbers::pi));
    middle = checkedVector(ownerOfSpray, "nozzle", nozzle, "m");
    direction = checkedDirection(ownerOfSpray, "length of the direction", towards);
    edge1 = anyAcross(direction);
    edge2 = cross(direction, edge1);
    angle = coneAngle;
    shape = Shape::Cone;
}

void Spray::setFlow(double value) {
    checkValue(ownerOfSpray, "flow", value, "m^3/s", positive);
    flowRate = value;
}
void Spray::setDropletRadius(double value) {
    checkValue(ownerOfSpray, "droplet radius", value, "m", radiusRange);
    radius = value;
}
void Spray::setVolumeSpread(double value) {
    checkValue(ownerOfSpray, "volume spread", value, "", fromZeroTo(0.5));
    spread = value;
}
void Spray::setSpeed(double value) {
    checkValue(ownerOfSpray, "speed", value, "m/s", notNegative);
    speed = value;
}
void Spray::setTimes(double begin, double end) {
    checkValue(ownerOfSpray, "first time", begin, "s", notNegative);
    checkValue(ownerOfSpray, "last time", end, "s", {begin, infinity, true, false});
    first = begin;
    last = end;
}
void Spray::setMomentum(double liquidDensity) {
    checkValue(ownerOfSpray, "density of the liquid", liquidDensity, "kg/m^3", positive);
    density = liquidDensity;
}
void Spray::setLongestFlight(double value) {
    checkValue(ownerOfSpray, "longest flight", value, "s", positive);
    longest = value;
}

double Spray::dropletVolume() const { return sphereMass(radius, 1); }
double Spray::spreadWidth() const { return std::sqrt(3.0) * spread; }

std::uint64_t Spray::countAt(double time) const {
    const double lasted = std::min(time, last) - first;
    return lasted > 0 ? static_cast<std::uint64_t>(std::floor(flowRate * lasted / dropletVolume())) : 0;
}
double Spray::timeOf(std::uint64_t k) const {
    return first + static_cast<double>(k + 1) * dropletVolume() / flowRate;
}
double Spray::volumeBy(double time) const {
    return flowRate * std::max(std::min(time, last) - first, 0.0) * largestShare();
}

NewDroplet Spray::droplet(std::uint64_t k, std::size_t number) const {
    const CountedRandom random(seed);
    const auto uniform = [&](Purpose purpose) {
        return random.uniform(k, static_cast<std::uint32_t>(number) * PurposeCount + purpose);
    };
    NewDroplet made{middle, speed * direction, radius};
    if (spread > 0) made.radius *= std::cbrt(1 + spreadWidth() * (2 * uniform(Size) - 1));
    if (shape == Shape::Rain)
        made.position += (uniform(Place1) - 0.5) * edge1 + (uniform(Place2) - 0.5) * edge2;
    if (shape == Shape::FlatFan) {
        const double turned = angle * (uniform(Angle) - 0.5);
        made.velocity = speed * (std::cos(turned) * direction + std::sin(turned) * edge1);
    }
    if (shape == Shape::Cone) {
        // Even in the solid angle: even in the cosine.
        const double cosine = 1 - uniform(Angle) * (1 - std::cos(0.5 * angle));
        const double sine = std::sqrt((1 - cosine) * (1 + cosine));
        const double azimuth = 2 * std::numbers::pi * uniform(Azimuth);
        made.velocity =
            speed * (cosine * direction + sine * (std::cos(azimuth) * edge1 + std::sin(azimuth) * edge2));
    }
    return made;
}

void Spray::check(std::size_t number) const {
    const auto require = [&](bool isGiven, std::string_view what, std::string_view call) {
        if (!isGiven)
            throw InputError(
                fmt::format("spray {}: {} is not set; call {} before it is added.", number, what, call));
    };
    require(shape != Shape::None, "its shape", "setRain(), setFlatFan() or setCone()");
    require(isSet(flowRate), "its flow", "setFlow()");
    require(isSet(radius), "the radius of its droplets", "setDropletRadius()");
    require(isSet(speed), "the speed of its droplets", "setSpeed()");
    const Vector<double> half = shape == Shape::Rain ? 0.5 * (edge1 + edge2) : Vector<double>{0, 0, 0};
    for (const Vector<double>& place : {middle + half, middle - half})
        requireResolved(fmt::format("spray {}", number), "place", place, radius);
}

void Spray::compareSetUp(StateArchive& archive) const {
    archive.same("shape", static_cast<int>(shape));
    archive.sameRecord<double>("middle", middle, "m");
    archive.sameRecord<double>("edge1", edge1, "m");
    archive.sameRecord<double>("edge2", edge2, "m");
    archive.sameRecord<double>("direction", direction);
    archive.same("angle", angle, "rad");
    archive.same("flow", flowRate, "m^3/s");
    archive.same("dropletRadius", radius, "m");
    archive.same("speed", speed, "m/s");
    archive.same("volumeSpread", spread);
    archive.same("firstTime", first, "s");
    archive.same("lastTime", last, "s");
    archive.same("liquidDensity", density, "kg/m^3");
    archive.same("longestFlight", longest, "s");
    archive.same("seed", seed);
}

}  // namespace pendular
