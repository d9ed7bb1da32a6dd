#include "Kernel/Features/Wear/WearLaw.h"

#include <fmt/format.h>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

double finnieEnergy(double mass, double normalSpeed, double tangentialSpeed) {
    const double n = normalSpeed, t = tangentialSpeed;  // sin a = n / v, cos a = t / v
    return mass * (3 * n <= t ? (2 * t - 3 * n) * n : t * t / 3);
}

WearLaw WearLaw::reye(double factor) {
    checkValue("Reye's wear law", "factor k", factor, "m^3/J", notNegative);
    return {Kind::Reye, factor};
}

WearLaw WearLaw::archard(double coefficient, double hardness) {
    checkValue("Archard's wear law", "coefficient K", coefficient, "", notNegative);
    checkValue("Archard's wear law", "hardness H", hardness, "Pa", positive);
    return {Kind::Archard, coefficient / hardness};
}

WearLaw WearLaw::finnie(double cuttingShare, double flowStress) {
    checkValue("Finnie's wear law", "share c of the grains that cut", cuttingShare, "", fromZeroTo(1));
    checkValue("Finnie's wear law", "flow stress p", flowStress, "Pa", positive);
    return {Kind::Finnie, cuttingShare / flowStress};
}

double WearLaw::volume(const ContactWear& done) const {
    switch (kind) {
        case Kind::Reye:
            return factor * done.slidingWork;
        case Kind::Archard:
            return factor * done.loadTimesPath;
        case Kind::Finnie:
            return done.isImpact ? factor * finnieEnergy(done.mass, done.normalSpeed, done.tangentialSpeed)
                                 : 0;
        case Kind::None:
            break;
    }
    return 0;
}

std::string WearLaw::text() const {
    switch (kind) {
        case Kind::Reye:
            return fmt::format("Reye, V = k W, k = {:.6g} m^3/J", factor);
        case Kind::Archard:
            return fmt::format(
                "Archard, V = K F s / H, K/H = {:.6g} 1/Pa: k = K / (mu H) = {:.6g} / mu m^3/J", factor,
                factor);
        case Kind::Finnie:
            return fmt::format("Finnie, V = c m v^2 f(a) / p, c/p = {:.6g} 1/Pa", factor);
        case Kind::None:
            break;
    }
    return "none: work and impacts only";
}

void WearLaw::visitState(StateArchive& archive) const {
    archive.same("law", static_cast<int>(kind));
    archive.same("factor", factor, "m^3/J");
}

}  // namespace pendular
