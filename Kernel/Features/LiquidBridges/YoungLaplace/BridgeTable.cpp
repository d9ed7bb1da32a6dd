#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTable.h"

#include <algorithm>
#include <limits>

namespace pendular {

namespace {

constexpr std::size_t roughTerms = 7;

double angleVariable(double contactAngle) { return 2 * contactAngle / BridgeTable::mostAngle - 1; }

double volumeVariable(double volume) {
    const double decades = std::log(BridgeTable::mostVolume / BridgeTable::leastVolume);
    return 2 * std::log(volume / BridgeTable::leastVolume) / decades - 1;
}

double asymmetryVariable(double asymmetry) { return 2 * std::cbrt(asymmetry * asymmetry) - 1; }

/// The area has a square root at the rupture, like the force.
double areaVariable(double gapShare) { return std::sqrt(std::max(1.03 - gapShare, 0.0)); }

}  // namespace

BridgeConditions BridgeShape::conditions() const {
    const double radius2 = asymmetry < 1 ? 1 / (1 - asymmetry) : std::numeric_limits<double>::infinity();
    return {{1 / (1 + asymmetry), contactAngle}, {radius2, contactAngle}, volume};
}

BridgeSlice::BridgeSlice(const BridgeTable& table, double contactAngle)
    : angle(contactAngle),
      rupture(table.rupture.at(angleVariable(contactAngle))),
      rough(table.rupture.at(angleVariable(contactAngle), roughTerms)),
      force(table.force.at(angleVariable(contactAngle))),
      area(table.area.at(angleVariable(contactAngle))) {}

double BridgeSlice::ruptureDistance(const BridgeShape& shape) const {
    return rupture.at(volumeVariable(shape.volume), asymmetryVariable(shape.asymmetry))[0] *
           std::cbrt(shape.volume);
}

double BridgeSlice::roughRupture(const BridgeShape& shape) const {
    return rough.at(volumeVariable(shape.volume), asymmetryVariable(shape.asymmetry), roughTerms)[0] *
           std::cbrt(shape.volume);
}

RationalBridge<double> BridgeSlice::curve(const BridgeShape& shape, double radius, double forceScale) const {
    const double length = shape.length();
    return curveThrough(force.at(volumeVariable(shape.volume), asymmetryVariable(shape.asymmetry)),
                        roughRupture(shape) / length, radius * length, forceScale);
}

double BridgeSlice::lateralArea(const BridgeShape& shape, double gap) const {
    const double x = areaVariable(gap / roughRupture(shape));
    const auto values = area.at(volumeVariable(shape.volume), asymmetryVariable(shape.asymmetry));
    double sum = 0;  // Lagrange
    for (std::size_t i = 0; i < areaNodes.size(); ++i) {
        const double node = areaVariable(areaNodes[i]);
        double part = values[i];
        for (std::size_t k = 0; k < areaNodes.size(); ++k)
            if (k != i) part *= (x - areaVariable(areaNodes[k])) / (node - areaVariable(areaNodes[k]));
        sum += part;
    }
    return sum * areaScale(shape, gap);
}

bool BridgeTable::contains(const BridgeShape& shape) {
    return shape.contactAngle >= 0 && shape.contactAngle <= mostAngle &&
           shape.volume >= leastVolume * (1 - edge) && shape.volume <= mostVolume * (1 + edge);
}

const BridgeSlice& bridgesAt(double contactAngle) {
    thread_local BridgeSlice last = bridgeTable.at(contactAngle);
    if (last.contactAngle() != contactAngle) last = bridgeTable.at(contactAngle);
    return last;
}

double areaScale(const BridgeShape& shape, double gap) {
    // Between parabolas of height r^2 / (2 R) each: V = pi a^2 (S + a^2 / (2 R)), height at a: S + a^2 / R.
    const double length = shape.length();
    const double height = std::sqrt(gap * gap + length * length);
    return 2 * std::numbers::pi * std::sqrt(length * length / (height + gap)) * height;
}

std::uint64_t checksum(const BridgeTable& table) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](const auto& product) {
        for (const std::int32_t number : product.coefficients)
            for (int shift = 0; shift < 32; shift += 8)
                hash = (hash ^ (static_cast<std::uint32_t>(number) >> shift & 0xff)) * 0x100000001b3;
    };
    add(table.rupture), add(table.force), add(table.area);
    return hash;
}

}  // namespace pendular
