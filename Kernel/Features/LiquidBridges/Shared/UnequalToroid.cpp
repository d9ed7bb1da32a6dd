#include "Kernel/Features/LiquidBridges/Shared/UnequalToroid.h"

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"

namespace pendular {

namespace {

using std::numbers::pi;

/// The part of a body in the toroid.
struct ToroidContact {
    double capHeight, capVolume, psi, sine, cosine;

    ToroidContact(double radius, double curvature, double contactAngle) {
        const double sineOfFilling = radius * curvature;
        capHeight = radius * sineOfFilling / (1 + std::sqrt(1 - sineOfFilling * sineOfFilling));
        capVolume = pi * capHeight * (3 * radius * radius + capHeight * capHeight) / 6;
        psi = std::asin(sineOfFilling) + contactAngle;
        sine = std::sin(psi);
        cosine = std::cos(psi);
    }
};

struct Contacts {
    ToroidContact first, second;

    explicit Contacts(const UnequalToroid& t)
        : first(t.contactRadius[0], t.curvature[0], t.contactAngle),
          second(t.contactRadius[1], t.curvature[1], t.contactAngle) {}

    [[nodiscard]] double arcCurvature(double gap) const {
        return (first.cosine + second.cosine) / (first.capHeight + gap + second.capHeight);
    }
};

double cube(double x) { return x * x * x; }

/// The toroid with this volume, from one nearby: Newton's method in both contact radii.
std::optional<UnequalToroid> converge(UnequalToroid toroid, double volume) {
    const auto residual = [volume](const UnequalToroid& t) {
        return std::array{t.mismatch(), t.volume() / volume - 1};
    };
    for (int iteration = 0; iteration < 40; ++iteration) {
        const auto value = residual(toroid);
        std::array<std::array<double, 2>, 2> slope;  // by the first and the second radius
        for (std::size_t k = 0; k < 2; ++k) {
            const double step = 1e-6 * toroid.contactRadius[k];
            UnequalToroid moved = toroid;
            moved.contactRadius[k] += step;
            const auto there = residual(moved);
            slope[k] = {(there[0] - value[0]) / step, (there[1] - value[1]) / step};
        }
        const double determinant = slope[0][0] * slope[1][1] - slope[1][0] * slope[0][1];
        const std::array change{(value[0] * slope[1][1] - value[1] * slope[1][0]) / determinant,
                                (value[1] * slope[0][0] - value[0] * slope[0][1]) / determinant};
        double largest = 0;
        for (std::size_t k = 0; k < 2; ++k)
            largest = std::max(largest, std::abs(change[k]) / toroid.contactRadius[k]);
        if (!std::isfinite(largest)) return {};
        const double part = std::min(1.0, 0.2 / largest);
        for (std::size_t k = 0; k < 2; ++k) toroid.contactRadius[k] -= part * change[k];
        if (largest < 1e-8) return toroid;
    }
    return {};
}

}  // namespace

double UnequalToroid::arcCurvature() const { return Contacts(*this).arcCurvature(gap); }

double UnequalToroid::mismatch() const {
    const Contacts contacts(*this);
    return (contactRadius[0] - contactRadius[1]) * contacts.arcCurvature(gap) + contacts.first.sine -
           contacts.second.sine;
}

double UnequalToroid::neck() const {
    const Contacts contacts(*this);
    return contactRadius[0] - (1 - contacts.first.sine) / contacts.arcCurvature(gap);
}

double UnequalToroid::volume() const {
    const Contacts contacts(*this);
    const auto& [first, second] = contacts;
    const double rho = 1 / contacts.arcCurvature(gap), b = contactRadius[0] + rho * first.sine;  // l + rho
    return pi *
               (rho * (b * b + rho * rho) * (first.cosine + second.cosine) -
                cube(rho) * (cube(first.cosine) + cube(second.cosine)) / 3 -
                b * rho * rho *
                    (first.sine * first.cosine + second.sine * second.cosine + pi - first.psi - second.psi)) -
           first.capVolume - second.capVolume;
}

double UnequalToroid::gorgeForce() const { return pi * neck() * (1 + neck() * arcCurvature()); }

UnequalToroidsOfVolume::UnequalToroidsOfVolume(double liquidVolume, double contactAngle, double asymmetry)
    : volume(liquidVolume) {
    const auto equal = ToroidsOfVolume(liquidVolume, contactAngle).at(0);
    if (!equal) return;
    const double radius = std::sin(equal->fillingAngle);
    last = UnequalToroid{{radius, radius}, {1, 1}, 0, contactAngle};
    constexpr int steps = 8;  // from equal spheres to these
    for (int k = 1; k <= steps && last; ++k) {
        const double between = asymmetry * k / steps;
        last->curvature = {1 + between, 1 - between};
        last = converge(*last, volume);
    }
}

std::optional<UnequalToroid> UnequalToroidsOfVolume::at(double gap) {
    constexpr double straight =
        0.05;  // neck times curvature of an arc whose neck is far outside of the bridge
    if (!last) return {};
    UnequalToroid next = *last;
    next.gap = gap;
    const auto found = converge(next, volume);
    if (!found || !(found->neck() > 0) || std::abs(found->neck() * found->arcCurvature()) < straight)
        return {};
    last = found;
    return found;
}

}  // namespace pendular
