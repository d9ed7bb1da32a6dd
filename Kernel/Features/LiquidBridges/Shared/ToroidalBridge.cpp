#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Math/GaussLegendre.h"
#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

namespace {

using std::numbers::pi;

double squareOf(double x) { return x * x; }

/// 1 - cos(angle), also for small angles.
double versine(double angle) { return 2 * squareOf(std::sin(0.5 * angle)); }

}  // namespace

double Toroid::height() const { return 2 * versine(fillingAngle) + gap; }

double Toroid::curvature() const { return 2 * std::cos(fillingAngle + contactAngle) / height(); }

double Toroid::neck() const {
    // rho (1 - sin psi) = (height / 2) cos psi / (1 + sin psi), also where rho is infinite.
    const double psi = fillingAngle + contactAngle;
    return std::sin(fillingAngle) - 0.5 * height() * std::cos(psi) / (1 + std::sin(psi));
}

double Toroid::volume() const {
    const double psi = fillingAngle + contactAngle, l = neck(), half = 0.5 * height();
    const double caps = 2 * pi * (2 + std::cos(fillingAngle)) * squareOf(versine(fillingAngle)) / 3;
    if (std::abs(std::cos(psi)) > 0.3) {
        const double rho = 1 / curvature(), b = rho + l, c = std::cos(psi);
        return 2 * pi *
                   (half * (squareOf(rho) + squareOf(b)) - half * squareOf(rho * c) / 3 -
                    b * squareOf(rho) * (c * std::sin(psi) + 0.5 * pi - psi)) -
               caps;
    }
    // Near the cylinder the closed form cancels: y = l + k x^2 / (1 + sqrt(1 - k^2 x^2)), squared and
    // integrated.
    double sum = 0;
    for (const auto [position, weight] : gaussLegendre(12)) {
        const double kx = curvature() * half * position;
        sum += weight * squareOf(l + kx * half * position / (1 + std::sqrt(1 - squareOf(kx))));
    }
    return pi * half * sum - caps;
}

double Toroid::gorgeForce() const { return pi * neck() * (1 + neck() * curvature()); }

double Toroid::boundaryForce() const {
    const double s = std::sin(fillingAngle);
    return 2 * pi * s * std::sin(fillingAngle + contactAngle) + pi * s * s * (curvature() - 1 / neck());
}

ToroidsOfVolume::ToroidsOfVolume(double liquidVolume, double angle)
    : volume(liquidVolume), contactAngle(angle), fillingAngle(0) {
    double low = 0, high = 0;
    const auto holds = [&](double phi) { return Toroid{phi, 0, contactAngle}.volume() >= volume; };
    for (double phi = 1e-6; phi < 0.7 * pi && high == 0; phi *= 1.1) (holds(phi) ? high : low) = phi;
    if (high == 0) return;
    fillingAngle = turningPoint(high, low, holds, 60).holds;
}

std::optional<Toroid> ToroidsOfVolume::at(double gap) {
    if (fillingAngle == 0) return {};
    const auto excess = [&](double phi) { return Toroid{phi, gap, contactAngle}.volume() - volume; };
    double phi = fillingAngle;
    for (int iteration = 0; iteration < 50; ++iteration) {
        const double step = 1e-6 * phi, value = excess(phi);
        const double slope = (excess(phi + step) - excess(phi - step)) / (2 * step);
        if (!(slope > 0)) return {};  // beyond the fold
        const double change = value / slope;
        phi -= std::min(std::max(change, -0.2 * phi), 0.2 * phi);
        if (std::abs(change) < 1e-9 * phi) {
            if (!(Toroid{phi, gap, contactAngle}.neck() > 0)) return {};
            fillingAngle = phi;
            return Toroid{phi, gap, contactAngle};
        }
    }
    return {};
}

}  // namespace pendular
