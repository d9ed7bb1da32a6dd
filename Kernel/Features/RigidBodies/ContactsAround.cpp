#include "Kernel/Features/RigidBodies/ContactsAround.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "Kernel/Features/RigidBodies/TurningResponse.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

namespace {

/// Of the smaller radius, as largestSoundOverlap of the species.
constexpr double overlapOfTouch = 0.05;
/// Of a grain at rest among others, as StabilityLimit.h has them: a sphere with contacts on all sides has 4
/// along and 8 across each direction.
constexpr double alongAll = 4, acrossAll = 8;

double upwards(double value) {
    int exponent = 0;
    const double part = std::frexp(value, &exponent);
    // A number of these digits is not made larger by round-off.
    return std::ldexp(std::ceil(1024 * part - 1e-6) / 1024, exponent);
}

/// 50 unit vectors with the symmetry of a cube, so that their squares add up to the same along all axes:
/// those of the 26 neighbours of a cell, and 24 between them.
std::vector<Eigen::Vector3d> directionsAround() {
    std::vector<Eigen::Vector3d> all;
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z) {
                const std::array<int, 3> lengths{std::abs(x), std::abs(y), std::abs(z)};
                const auto twos = std::ranges::count(lengths, 2), ones = std::ranges::count(lengths, 1);
                const bool isNeighbour = twos == 0 && ones > 0, isBetween = twos == 1 && ones == 2;
                if (isNeighbour || isBetween) all.push_back(Eigen::Vector3d(x, y, z).normalized());
            }
    return all;
}

/// A thousand directions along a spiral (Fibonacci's lattice), each for the same part of a sphere: for
/// spheres of which others leave bands and patches.
std::vector<Eigen::Vector3d> manyDirections() {
    constexpr int count = 1000;
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0));  // rad
    std::vector<Eigen::Vector3d> all;
    for (int k = 0; k < count; ++k) {
        const double z = 1 - (2 * k + 1.0) / count, across = std::sqrt(1 - z * z);
        all.emplace_back(across * std::cos(turn * k), across * std::sin(turn * k), z);
    }
    return all;
}

/// The sums over contacts, over mass and moments of the body: of squared slips.
class Sums {
public:
    Sums(double mass, const Vector<double>& moments)
        : perMoment(std::sqrt(mass / moments.x), std::sqrt(mass / moments.y), std::sqrt(mass / moments.z)) {}

    /// @param weight of what is along the normal, contacts; @param across the same of each tangent
    void add(const Eigen::Vector3d& arm, const Eigen::Vector3d& n, double weight, double across) {
        const auto [x, y, z] = toVector(arm);
        const auto [a, b, c] = toVector(perMoment);
        const std::array<std::array<double, 6>, 3> slip{
            {{1, 0, 0, 0, b * z, -c * y}, {0, 1, 0, -a * z, 0, c * x}, {0, 0, 1, a * y, -b * x, 0}}};
        std::array<double, 6> along{};
        for (std::size_t k = 0; k < 6; ++k)
            along[k] = n.x() * slip[0][k] + n.y() * slip[1][k] + n.z() * slip[2][k];
        // By hand: Eigen's products of these sizes take seconds to compile.
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                const double ofNormal = along[i] * along[j];
                const double ofAll =
                    slip[0][i] * slip[0][j] + slip[1][i] * slip[1][j] + slip[2][i] * slip[2][j];
                addTo(normal, i, j, weight * ofNormal);
                addTo(sliding, i, j, across * (ofAll - ofNormal));
            }
    }
    [[nodiscard]] double ofNormal() const { return largestEigenvalueOf(normal); }
    [[nodiscard]] double ofSliding() const { return largestEigenvalueOf(sliding); }
    [[nodiscard]] double ofSpin() const {
        return largestEigenvalueOf(Eigen::Matrix3d(sliding.bottomRightCorner<3, 3>()));
    }

private:
    static void addTo(Matrix6d& sum, std::size_t i, std::size_t j, double value) {
        sum(static_cast<int>(i), static_cast<int>(j)) += value;
        if (i != j) sum(static_cast<int>(j), static_cast<int>(i)) += value;
    }
    Eigen::Vector3d perMoment;  // 1/m, sqrt(mass over moment), of turning about each axis
    Matrix6d normal = Matrix6d::Zero(), sliding = Matrix6d::Zero();
};

/// The spheres of a body, each with those that it overlaps or that a grain on it may touch as well.
class Neighbourhoods {
public:
    explicit Neighbourhoods(std::span<const SphereOfBody> of) : spheres(of), near(of.size()) {
        std::vector<std::uint32_t> order(spheres.size());
        for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
        std::ranges::sort(order, {}, [&](std::uint32_t k) { return spheres[k].arm.x; });
        double widest = 0;  // m
        for (const SphereOfBody& sphere : spheres) widest = std::max(widest, sphere.radius);
        for (std::size_t a = 0; a < order.size(); ++a) {
            const SphereOfBody& one = spheres[order[a]];
            for (std::size_t b = a + 1; b < order.size(); ++b) {
                const SphereOfBody& two = spheres[order[b]];
                if (two.arm.x - one.arm.x > 3 * one.radius + 3 * widest) break;
                const double apart = norm(two.arm - one.arm);
                if (apart < 3 * one.radius + two.radius) near[order[a]].push_back(order[b]);
                if (apart < 3 * two.radius + one.radius) near[order[b]].push_back(order[a]);
            }
        }
    }
    /// Whether a place (m) on a sphere is in no other one; of two alike the first has it.
    [[nodiscard]] bool isExposed(std::uint32_t own, const Vector<double>& place) const {
        return std::ranges::none_of(near[own], [&](std::uint32_t k) {
            const double inside = spheres[k].radius - norm(place - spheres[k].arm),
                         rounding = 1e-9 * spheres[own].radius;
            return inside > rounding || (inside > -rounding && k < own && areAlike(k, own));
        });
    }
    /// The spheres that a grain as large as one of them touches, which is on it along a normal with an
    /// overlap of 5 %; 1 where others do not let it there.
    [[nodiscard]] double touchedAt(std::uint32_t own, const Vector<double>& normal) const {
        const double r = spheres[own].radius;
        const Vector<double> centre = spheres[own].arm + ((2 - overlapOfTouch) * r) * normal;
        double count = 1;
        for (const std::uint32_t k : near[own]) {
            const double overlap = spheres[k].radius + r - norm(centre - spheres[k].arm);
            if (overlap > overlapOfTouch * r * (1 + 1e-9)) return 1;
            count += overlap > 1e-9 * r ? 1 : 0;
        }
        return count;
    }

private:
    [[nodiscard]] bool areAlike(std::uint32_t a, std::uint32_t b) const {
        return norm(spheres[a].arm - spheres[b].arm) + std::abs(spheres[a].radius - spheres[b].radius) <
               1e-8 * spheres[a].radius;
    }
    std::span<const SphereOfBody> spheres;
    std::vector<std::vector<std::uint32_t>> near;
};

/// A plane wall, by its contacts: the spheres of a body that it touches.
class PlaneContacts {
public:
    PlaneContacts(std::span<const SphereOfBody> of, double ofBody, const Vector<double>& about)
        : spheres(of), mass(ofBody), moments(about) {}

    /// Of all planes across these directions, the principal axes, and the directions of some of the spheres.
    void findMost(std::span<const Eigen::Vector3d> directions, const Quaternion& frame,
                  ContactsAround& found) {
        for (const Eigen::Vector3d& direction : directions) look(frame.turnBack(toVector(direction)));
        for (const double side : {-1.0, 1.0})
            for (const Vector<double>& axis : {Vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
                look(side * axis);
        const std::size_t each = 1 + spheres.size() / 1000;  // those between are near some of these
        for (std::size_t k = 0; k < spheres.size(); k += each)
            if (const double length = norm(spheres[k].arm); length > 0) look((1 / length) * spheres[k].arm);
        // Those with most come first, so that few of the others can have a larger eigenvalue.
        std::ranges::sort(seen, {}, [](const Seen& plane) { return -plane.trace; });
        found.wallNormal = found.wallSliding = found.wallSpin = 0;
        Vector<double> ofNormal{0, 0, 1}, ofSliding = ofNormal, ofSpin = ofNormal;
        const auto take = [](double value, const Seen& plane, double& most, Vector<double>& direction) {
            if (value > most) most = value, direction = plane.normal;
        };
        for (const Seen& plane : seen) {
            // The part across has two tangents, and so at most the shift and the spin of twice as many.
            if (plane.trace <= std::min({found.wallNormal, found.wallSliding, found.wallSpin})) break;
            Sums sums(mass, moments);
            touch(plane, sums);
            take(sums.ofNormal(), plane, found.wallNormal, ofNormal);
            take(sums.ofSliding(), plane, found.wallSliding, ofSliding);
            take(sums.ofSpin(), plane, found.wallSpin, ofSpin);
        }
        found.boxNormal = 2 * found.wallNormal, found.boxSliding = 2 * found.wallSliding;
        found.boxSpin = 2 * found.wallSpin;
        for (const Vector<double>& direction : {ofNormal, ofSliding, ofSpin})
            addBoxes(direction, frame, found);
    }

private:
    struct Seen {
        Vector<double> normal, farthest;  // m, the centre of the farthest sphere
        double height, slack;             // m
        double trace;                     // of the squares of all slips, an upper bound
    };
    static bool isTouched(const SphereOfBody& sphere, const Seen& plane) {
        const Vector<double> aside = sphere.arm - plane.farthest;
        const double along = dot(aside, plane.normal);
        return dot(sphere.arm, plane.normal) + sphere.radius >
               plane.height - plane.slack - 0.03 * norm(aside - along * plane.normal);
    }
    void touch(const Seen& plane, Sums& sums) const {
        for (const SphereOfBody& sphere : spheres)
            if (isTouched(sphere, plane))
                sums.add(toEigen(sphere.arm + sphere.radius * plane.normal), toEigen(plane.normal), 1, 1);
    }
    /// Of six planes, two of them across a direction: others turn a cube about an axis along them as these
    /// do. In the frame of the shape the planes are the same for all bodies of it.
    void addBoxes(const Vector<double>& direction, const Quaternion& frame, ContactsAround& found) const {
        const Vector<double> ofShape = toVector(toEigen(frame.turn(direction)).unitOrthogonal());
        const Eigen::Vector3d across = toEigen(direction), side = toEigen(frame.turnBack(ofShape));
        constexpr int turns = 8;  // of the quarter that a box looks the same after
        for (int k = 0; k < turns; ++k) {
            const Eigen::AngleAxisd turn(0.5 * std::numbers::pi * k / turns, across);
            const Eigen::Vector3d first = turn * side, second = across.cross(first);
            Sums sums(mass, moments);
            for (const Eigen::Vector3d& normal : {across, first, second})
                for (const double sign : {-1.0, 1.0}) touch(planeAcross(sign * toVector(normal)), sums);
            found.boxNormal = std::max(found.boxNormal, sums.ofNormal());
            found.boxSliding = std::max(found.boxSliding, sums.ofSliding());
            found.boxSpin = std::max(found.boxSpin, sums.ofSpin());
        }
    }
    [[nodiscard]] Seen planeAcross(const Vector<double>& normal) const {
        Seen plane{normal, {0, 0, 0}, -infinity, 0, 0};
        for (const SphereOfBody& sphere : spheres)
            if (const double height = dot(sphere.arm, normal) + sphere.radius; height > plane.height)
                plane.height = height, plane.farthest = sphere.arm,
                plane.slack = overlapOfTouch * sphere.radius;
        const double least = std::min({moments.x, moments.y, moments.z});
        for (const SphereOfBody& sphere : spheres)
            if (isTouched(sphere, plane)) {
                const Vector<double> arm = sphere.arm + sphere.radius * normal;
                plane.trace += 3 + 2 * mass * squaredNorm(arm) / least;
            }
        return plane;
    }
    void look(const Vector<double>& normal) { seen.push_back(planeAcross(normal)); }
    std::span<const SphereOfBody> spheres;
    double mass;             // kg
    Vector<double> moments;  // kg m^2
    std::vector<Seen> seen;
};

/// A contact that is the only one: at the farthest end of an arm, along the direction that moves the body
/// most.
double alone(std::span<const SphereOfBody> spheres, double mass, const Vector<double>& moments) {
    double most = 1;
    for (const SphereOfBody& sphere : spheres)
        most = std::max(most, 1 + mass * responseOfTurning(sphere.arm, moments));
    return most;
}

}  // namespace

std::array<double, 14> ContactsAround::numbers() const {
    return {normal,      sliding,  spin,      turning,    mean,    most,  wallNormal,
            wallSliding, wallSpin, boxNormal, boxSliding, boxSpin, finer, finest};
}

bool ContactsAround::areWithin(const ContactsAround& other) const {
    constexpr double digit = 1 + 3.0 / 1024;
    const std::array<double, 14> own = numbers(), others = other.numbers();
    for (std::size_t k = 0; k < own.size(); ++k)
        if (own[k] > digit * others[k]) return false;
    return true;
}

ContactsAround ContactsAround::roundedUp(double factor) const {
    const auto up = [factor](double value) { return upwards(factor * value); };
    return {.normal = up(normal),
            .sliding = up(sliding),
            .spin = up(spin),
            .turning = up(turning),
            .mean = up(mean),
            .most = up(most),
            .wallNormal = up(wallNormal),
            .wallSliding = up(wallSliding),
            .wallSpin = up(wallSpin),
            .boxNormal = up(boxNormal),
            .boxSliding = up(boxSliding),
            .boxSpin = up(boxSpin),
            .finer = up(finer),
            .finest = up(finest)};
}

ContactsAround contactsAround(std::span<const SphereOfBody> spheres, double mass,
                              const Vector<double>& moments, const Quaternion& frame) {
    static const std::vector<Eigen::Vector3d> few = directionsAround(), many = manyDirections();
    const Neighbourhoods near(spheres);
    Sums sums(mass, moments);
    double touched = 0, squares = 0, most = 1, rims = 0;  // rims: m^2
    double surface = 0, overRadius = 0, overSquare = 0;   // m^2 of the surface, and m and 1 over r and r^2
    double widest = 0;                                    // m
    std::vector<std::pair<Eigen::Vector3d, double>> exposed;
    for (std::uint32_t k = 0; k < spheres.size(); ++k) {
        const auto& [arm, radius] = spheres[k];
        const auto look = [&, &arm = arm, &radius = radius](const std::vector<Eigen::Vector3d>& directions) {
            exposed.clear();
            for (const Eigen::Vector3d& direction : directions) {
                const Vector<double> normal = frame.turnBack(toVector(direction));
                if (near.isExposed(k, arm + radius * normal))
                    exposed.emplace_back(toEigen(normal), near.touchedAt(k, normal));
            }
            return 1 / static_cast<double>(directions.size());
        };
        double perDirection = look(few);
        if (exposed.size() < few.size()) perDirection = look(many);
        for (const auto& [direction, count] : exposed) {
            touched += perDirection * count, squares += perDirection * count * count;
            most = std::max(most, count);
        }
        const double open = perDirection * static_cast<double>(exposed.size()) * radius * radius;
        surface += open, overRadius += open / radius, overSquare += open / (radius * radius);
        widest = std::max(widest, radius);
        // Of twelve contacts a direction has a share; all that are exposed have one at least together.
        const double least =
            1 / (3 * alongAll * static_cast<double>(std::max<std::size_t>(exposed.size(), 1)));
        for (const auto& [direction, count] : exposed) {
            const double share = std::max(perDirection * count, least);
            // The squares of cosines add up to a third, those of sines along one tangent to two thirds.
            sums.add(toEigen(arm) + radius * direction, direction, 3 * share, 1.5 * share);
            rims += share * radius * radius;
        }
    }
    const double smallest = std::min({moments.x, moments.y, moments.z}), one = alone(spheres, mass, moments);
    ContactsAround found{.normal = std::max(sums.ofNormal(), most * one / alongAll),
                         .sliding = std::max(sums.ofSliding(), most * one / acrossAll),
                         .spin = sums.ofSpin(),
                         .turning = mass * rims / smallest,
                         .mean = touched > 0 ? squares / touched : 1,
                         .most = most,
                         .finer = surface > 0 ? widest * overRadius / surface : 1,
                         .finest = surface > 0 ? widest * widest * overSquare / surface : 1};
    PlaneContacts(spheres, mass, moments).findMost(few, frame, found);
    return found.roundedUp();
}

ContactsAround contactsAroundBlock(std::span<const SphereOfBody> corners, double mass,
                                   const Vector<double>& moments) {
    Sums sums(mass, moments);
    double rims = 0;  // m^2
    for (const auto& [arm, radius] : corners)
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d corner = toEigen(arm),
                                  normal = std::copysign(1, corner[axis]) * Eigen::Vector3d::Unit(axis);
            // Its own corner, and one of the other block; in units of a sphere's contacts.
            sums.add(corner + radius * normal, normal, 2 / alongAll, 2 / acrossAll);
            rims += 2 / (3 * alongAll) * radius * radius;
        }
    ContactsAround found{.normal = sums.ofNormal(),
                         .sliding = sums.ofSliding(),
                         .spin = sums.ofSpin(),
                         .turning = mass * rims / std::min({moments.x, moments.y, moments.z})};
    found.wallNormal = found.wallSliding = found.wallSpin = 0;
    // All faces lie on planes, without the corners of others.
    found.boxNormal = alongAll / 2 * sums.ofNormal(), found.boxSliding = acrossAll / 2 * sums.ofSliding();
    found.boxSpin = acrossAll / 2 * sums.ofSpin();
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
        Sums face(mass, moments);
        for (const auto& [arm, radius] : corners)
            if (toEigen(arm)[axis] > 0) face.add(toEigen(arm) + radius * normal, normal, 1, 1);
        found.wallNormal = std::max(found.wallNormal, face.ofNormal());
        found.wallSliding = std::max(found.wallSliding, face.ofSliding());
        found.wallSpin = std::max(found.wallSpin, face.ofSpin());
    }
    return found.roundedUp();
}

ContactsAround contactsAroundAs(double massAtContacts, double mass) {
    const double share = mass / massAtContacts;
    return ContactsAround{.normal = share,
                          .sliding = share,
                          .spin = 2.5 * share,
                          .turning = 2.5 * share,
                          .wallNormal = share,
                          .wallSliding = 3.5 * share,
                          .wallSpin = 2.5 * share,
                          .boxNormal = 2 * share,
                          .boxSliding = 10 * share,  // spin about an axis with four planes along it
                          .boxSpin = 10 * share}
        .roundedUp();
}

}  // namespace pendular
