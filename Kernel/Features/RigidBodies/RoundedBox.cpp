#include "Kernel/Features/RigidBodies/RoundedBox.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

double signOf(std::size_t number, std::size_t bit) { return (number >> bit & 1) != 0 ? 1 : -1; }

/// m^5, the integral of x^2 over a box about 0 with half lengths a along x and b, c across, and radius r.
double secondMoment(double a, double b, double c, double r) {
    constexpr double pi = std::numbers::pi;
    const double far = (a + r) * (a + r) * (a + r) - a * a * a;
    const double box = 8.0 / 3 * a * a * a * b * c;
    const double slabs = 8.0 / 3 * b * c * far + 8.0 / 3 * a * a * a * r * (b + c);
    const double along = 2.0 / 3 * pi * r * r * a * a * a;
    // Of a quarter of a disc in a corner: area pi r^2 / 4, first moment r^3 / 3, second pi r^4 / 16.
    const double quarters =
        8 * (b + c) * (0.25 * pi * r * r * a * a + 2.0 / 3 * r * r * r * a + pi / 16 * r * r * r * r);
    // Of an eighth of a ball: pi r^3 / 6, pi r^4 / 16, pi r^5 / 30.
    const double eighths = 8 * pi * r * r * r * (a * a / 6 + a * r / 8 + r * r / 30);
    return box + slabs + along + quarters + eighths;
}

}  // namespace

RoundedBox RoundedBox::fromOuter(std::string_view owner, const Vector<double>& outer, double radius) {
    checkValue(owner, "half length a", outer.x, "m", positive);
    checkValue(owner, "half length b", outer.y, "m", positive);
    checkValue(owner, "half length c", outer.z, "m", positive);
    checkValue(owner, "radius of the edges", radius, "m", positive);
    const double least = std::min({outer.x, outer.y, outer.z});
    if (radius >= least)
        throw InputError(
            fmt::format("{}: radius of the edges = {:.6g} m must be below the smallest half "
                        "length, {:.6g} m; take a sphere or a clump for what has no flat faces.",
                        owner, radius, least));
    return {{outer.x - radius, outer.y - radius, outer.z - radius}, radius};
}

MassProperties RoundedBox::mass() const {
    constexpr double pi = std::numbers::pi;
    const auto [a, b, c] = half;
    const double r = radius;
    const double volume = 8 * a * b * c + 8 * r * (a * b + b * c + c * a) + 2 * pi * r * r * (a + b + c) +
                          4.0 / 3 * pi * r * r * r;
    const Eigen::Vector3d second(secondMoment(a, b, c, r), secondMoment(b, c, a, r),
                                 secondMoment(c, a, b, r));
    MassProperties found = MassProperties::fromMoments(volume, Eigen::Vector3d::Zero(), second.asDiagonal());
    found.error = 1e-15;
    return found;
}

Vector<double> RoundedBox::support(const Vector<double>& n) const {
    const auto along = [&](double half, double part) {
        return (part > 0 ? half : part < 0 ? -half : 0) + radius * part;
    };
    return {along(half.x, n.x), along(half.y, n.y), along(half.z, n.z)};
}

Vector<double> RoundedBox::corner(std::size_t number) const {
    return {signOf(number, 0) * half.x, signOf(number, 1) * half.y, signOf(number, 2) * half.z};
}

Vector<double> RoundedBox::facesAt(std::size_t edge) {
    const double first = signOf(edge, 0), second = signOf(edge, 1);
    switch (axisOf(edge)) {
        case 0:
            return {0, first, second};
        case 1:
            return {second, 0, first};
        default:
            return {first, second, 0};
    }
}

double RoundedBox::halfLength(std::size_t edge) const {
    switch (axisOf(edge)) {
        case 0:
            return half.x;
        case 1:
            return half.y;
        default:
            return half.z;
    }
}

Vector<double> RoundedBox::middle(std::size_t edge) const {
    const Vector<double> faces = facesAt(edge);
    return {faces.x * half.x, faces.y * half.y, faces.z * half.z};
}

double RoundedBox::turning() const {
    const MassProperties solid = mass();
    const double further = radius / std::numbers::sqrt3;
    const Vector<double> arm{half.x + further, half.y + further, half.z + further};
    Eigen::Matrix3d cross;
    cross << 0, -arm.z, arm.y, arm.z, 0, -arm.x, -arm.y, arm.x, 0;
    const Eigen::Vector3d inverse = solid.volume * solid.inertia.diagonal().cwiseInverse();
    const Eigen::Matrix3d response = cross.transpose() * inverse.asDiagonal() * cross;
    return largestEigenvalueOf(response);
}

double RoundedBox::radiusAtContacts() const {
    return std::cbrt(3 * mass().volume / (16 * std::numbers::pi * (1 + turning())));
}

double RoundedBox::largestContactRadius() const { return std::max(radius, radiusAtContacts()); }

}  // namespace pendular
