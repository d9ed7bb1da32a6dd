#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

using std::numbers::pi;

void require(bool holds, std::string_view field, double value, std::string_view allowed) {
    if (!holds) throw InputError(fmt::format("Liquid bridge: {} = {}, but {}.", field, value, allowed));
}

void check(const WettedBody& body, std::string_view name) {
    require(body.radius > 0, fmt::format("radius of the {} body", name), body.radius,
            "it must be above 0 m (infinity is a plane)");
    require(body.contactAngle >= 0 && body.contactAngle <= pi,
            fmt::format("contact angle of the {} body", name), body.contactAngle,
            "it must lie between 0 and pi rad");
}

void check(const BridgeConditions& conditions) {
    check(conditions.first, "first");
    check(conditions.second, "second");
    require(conditions.volume > 0 && std::isfinite(conditions.volume), "volume", conditions.volume,
            "it must be above 0 m^3 and finite");
}

void checkGap(const BridgeConditions& conditions, double gap) {
    require(gap >= 0 && std::isfinite(gap), "gap", gap, "it must not be below 0 m, and be finite");
    const bool planes = std::isinf(conditions.first.radius) && std::isinf(conditions.second.radius);
    require(!planes || gap > 0, "gap", gap, "between two planes it must be above 0 m");
}

bool isStableArc(const BridgeEquations& equations, const ConvergedArc& converged) {
    return stabilityOf(equations, converged.arc, converged.value.geometry).unstableModes == 0;
}

double fillingAngle(const BodyContact& body, const ArcPoint& end, int side) {
    return body.curvature == 0 ? 0
                               : std::atan2(body.sineOfFilling(end, side), body.cosineOfFilling(end, side));
}

}  // namespace

void requireBridge(const BridgeConditions& conditions, double gap) {
    check(conditions);
    checkGap(conditions, gap);
}

double CapillaryBridge::pinnedForce() const { return 2 * pi * arc_.forceLength(); }

double CapillaryBridge::force() const { return std::max(pinnedForce(), 0.0); }

double CapillaryBridge::pressure() const { return 2 * arc_.meanCurvature; }

double CapillaryBridge::firstFillingAngle() const {
    return fillingAngle(BodyContact(conditions_.first), arc_.at(-arc_.halfSpan), -1);
}

double CapillaryBridge::secondFillingAngle() const {
    return fillingAngle(BodyContact(conditions_.second), arc_.at(arc_.halfSpan), 1);
}

double CapillaryBridge::firstContactRadius() const {
    return std::sqrt(arc_.at(-arc_.halfSpan).squaredRadius);
}

double CapillaryBridge::secondContactRadius() const {
    return std::sqrt(arc_.at(arc_.halfSpan).squaredRadius);
}

double CapillaryBridge::lateralArea() const {
    return 2 * pi * measure(arc_, -arc_.halfSpan, arc_.halfSpan).areaOverTwoPi;
}

double CapillaryBridge::firstWettedArea() const {
    return pi * BodyContact(conditions_.first).cap(arc_.end(-1), -1).areaOverPi;
}

double CapillaryBridge::secondWettedArea() const {
    return pi * BodyContact(conditions_.second).cap(arc_.end(1), 1).areaOverPi;
}

double CapillaryBridge::energy() const {
    return lateralArea() - std::cos(conditions_.first.contactAngle) * firstWettedArea() -
           std::cos(conditions_.second.contactAngle) * secondWettedArea();
}

std::vector<MeridianPoint> CapillaryBridge::profile(int points) const {
    require(points >= 2, "points of the profile", points, "there must be 2 or more");
    std::vector<MeridianPoint> profile;
    profile.reserve(points);
    const double step = arc_.length() / (points - 1);
    double before = -arc_.halfSpan;
    double axial = -BodyContact(conditions_.first).cap(arc_.end(-1), -1).height;
    profile.push_back({axial, firstContactRadius()});
    for (int i = 1; i < points; ++i) {
        const double parameter =
            i + 1 == points ? arc_.halfSpan : arc_.parameterAt((i - 0.5 * (points - 1)) * step);
        axial += measure(arc_, before, parameter).axialExtent;
        profile.push_back({axial, std::sqrt(arc_.at(parameter).squaredRadius)});
        before = parameter;
    }
    return profile;
}

int CapillaryBridge::unstableModes() const {
    const BridgeEquations equations(conditions_);
    const BridgeGeometry geometry(arc_, equations.first(), equations.second());
    return stabilityOf(equations, arc_, geometry).unstableModes;
}

MeridianKind CapillaryBridge::kind(double tolerance) const {
    const auto [real, imaginary] = arc_.kenmotsu();
    const double modulus = std::hypot(real, imaginary);
    if (modulus < tolerance) return MeridianKind::Cylinder;
    if (modulus > 1 + tolerance) return MeridianKind::Nodoid;
    if (modulus < 1 - tolerance) return MeridianKind::Unduloid;
    const double radius = std::sqrt(arc_.squaredRadius());
    return std::abs(arc_.meanCurvature) * radius < std::abs(arc_.forceLength()) / radius
               ? MeridianKind::Catenoid
               : MeridianKind::Sphere;
}

std::optional<CapillaryBridge> solveBridge(const BridgeConditions& conditions, double gap,
                                           const CapillaryBridge* nearby) {
    requireBridge(conditions, gap);
    const BridgeEquations equations(conditions);
    if (nearby) {
        const auto converged = convergeArc(equations, gap, nearby->arc());
        if (converged && isStableArc(equations, *converged))
            return CapillaryBridge(conditions, gap, converged->arc);
    }
    if (const auto arc = findDirectly(conditions, equations, gap))
        return CapillaryBridge(conditions, gap, *arc);
    if (const auto arc = findAlongBranch(conditions, gap)) return CapillaryBridge(conditions, gap, *arc);
    return {};
}

std::optional<Rupture> findRupture(const BridgeConditions& conditions) {
    check(conditions);
    const auto end = findBranchEnd(conditions);
    if (!end) return {};
    return Rupture{CapillaryBridge(conditions, end->point.gap, end->point.arc), end->mode};
}

std::vector<CapillaryBridge> traceBranch(const BridgeConditions& conditions, double gap, int points) {
    std::vector<CapillaryBridge> traced;
    const auto start = solveBridge(conditions, gap);
    if (!start) return traced;
    const BridgeBranch branch(conditions);
    BranchPoint point = branch.startAt(start->arc(), gap);
    while (static_cast<int>(traced.size()) < points) {
        traced.emplace_back(conditions, point.gap, point.arc);
        const auto next = nextPoint(branch, point);
        if (!next || next->gap < 0) break;
        point = *next;
    }
    return traced;
}

}  // namespace pendular
