#include "Tools/Reference/PartialSlipContact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

double PartialSlipConditions::contactRadius(double overlap) const {
    return std::sqrt(effectiveRadius * std::max(overlap, 0.0));
}
double PartialSlipConditions::normalForce(double overlap) const {
    return 4.0 / 3.0 * elasticModulus * contactRadius(overlap) * std::max(overlap, 0.0);
}

PartialSlipContact::PartialSlipContact(const PartialSlipConditions& given, double largestOverlap, int springs)
    : conditions(given) {
    checkValue("PartialSlipContact", "effectiveRadius", given.effectiveRadius, "m", positive);
    checkValue("PartialSlipContact", "elasticModulus", given.elasticModulus, "Pa", positive);
    checkValue("PartialSlipContact", "shearModulus", given.shearModulus, "Pa", positive);
    checkValue("PartialSlipContact", "friction", given.friction, "", notNegative);
    checkValue("PartialSlipContact", "largestOverlap", largestOverlap, "m", positive);
    checkValue("PartialSlipContact", "springs", springs, "", positive);
    spacing = conditions.contactRadius(largestOverlap) / springs;
    for (int k = 0; k < springs; ++k)
        profile.push_back((k + 0.5) * spacing * (k + 0.5) * spacing / given.effectiveRadius);
    stretch.assign(profile.size(), {0, 0, 0});
}

void PartialSlipContact::move(double newOverlap, const Vector<double>& slip) {
    // The outermost spring touches within half a spacing of the largest radius.
    const auto count = static_cast<double>(profile.size());
    const double largest = profile.back() * std::pow(count / (count - 0.5), 2);
    if (!(newOverlap <= largest * (1 + 1e-12)))
        throw InputError(fmt::format(
            "PartialSlipContact: overlap = {} m is above the largest one given, {} m.", newOverlap, largest));
    const double before = std::max(depth, 0.0), closing = newOverlap - depth;
    depth = newOverlap;
    const double limitOverCompression = conditions.friction / conditions.stiffnessRatio();
    const std::size_t touchedBefore = touching;
    touching = sticking = 0;
    Vector<double> sum{0, 0, 0};
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const double compression = newOverlap - profile[k];
        if (compression <= 0) {
            if (k >= touchedBefore) break;  // nor do those farther out
            stretch[k] = {0, 0, 0};
            continue;
        }
        ++touching;
        // One that begins to touch in this move takes the part of the slip since then.
        const double part = before > profile[k] ? 1 : compression / closing;
        Vector<double> moved = stretch[k] + part * slip;
        const double limit = limitOverCompression * compression, length2 = squaredNorm(moved);
        if (length2 > limit * limit) moved *= limit / std::sqrt(length2);
        else ++sticking;
        stretch[k] = moved;
        sum += moved;
    }
    force = (-2 * 4 * conditions.shearModulus * spacing) * sum;  // of both sides
}

double PartialSlipContact::stickingPart() const {
    return touching > 0 ? static_cast<double>(sticking) / static_cast<double>(touching) : 0;
}

}  // namespace pendular
