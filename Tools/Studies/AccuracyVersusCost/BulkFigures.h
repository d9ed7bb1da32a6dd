#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include "Drivers/Shared/Beverloo.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Scene/Simulation.h"

// Figures of grains in bulk.

namespace pendular::bulk {

/// The contacts of grains in one state of a scene.
struct ContactFigures {
    std::vector<int> contactsOf;  // of each grain, in the order of the particle store; with grains and walls
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();  // J, sum of l f, pressure positive
};

/// The virial is the volume (m^3) times Love's and Weber's mean stress of grains at rest: l goes from body 2,
/// or from the point at the wall, to the centre of body 1, and f is the force on body 1.
/// Source: Weber (1966), Bulletin de Liaison des Ponts et Chaussees 20, 3-1.
inline ContactFigures contactFigures(const Scene& scene) {
    const auto& grains = scene.particleHandler.store();
    const ContactSystem& contacts = scene.contacts();
    ContactFigures figures{std::vector<int>(grains.size(), 0)};
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (!contacts.touches(contact)) return;
        ++figures.contactsOf[contacts.firstOf(contact)];
        if (bucket.wall < 0) ++figures.contactsOf[contacts.secondOf(contact)];
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        figures.virial -= toEigen(seen.shift) * toEigen(seen.force).transpose();
    });
    return figures;
}

struct Coordination {
    double all = 0;          // contacts of a grain
    double loadBearing = 0;  // of a grain with four contacts or more
    double rattlers = 0;     // the share of grains with three contacts or fewer
};

/// Rattlers as Goencue, Duran and Luding (2010), C. R. Mecanique 338, 570, count them: C* = M4 / N4.
inline Coordination coordination(std::span<const int> contactsOf) {
    double all = 0, bearing = 0, count = 0;
    for (const int contacts : contactsOf) {
        all += contacts;
        if (contacts >= 4) bearing += contacts, ++count;
    }
    const auto number = static_cast<double>(contactsOf.size());
    return {all / number, count > 0 ? bearing / count : 0, 1 - count / number};
}

/// m^3, of the part of a sphere that is below a height (m).
inline double volumeBelow(double height, double centre, double radius) {
    const double cap = std::clamp(height - centre + radius, 0.0, 2 * radius);
    return std::numbers::pi * cap * cap * (radius - cap / 3);
}

/// The strip of the free surface that the mean is taken over, seen along y.
struct SurfaceRegion {
    double reach;  // m, |x| is below it
    double strip;  // m, width of the strips
};

/// Degrees, the dynamic angle of repose: by the median slope of all pairs of the highest centres in strips
/// along x. Positive where the surface rises with x.
inline double surfaceAngle(std::span<const Vec3D> centres, const SurfaceRegion& region) {
    std::map<int, Vec3D> highest;
    for (const Vec3D& centre : centres) {
        if (std::abs(centre.x()) >= region.reach) continue;
        const auto strip = static_cast<int>(std::floor(centre.x() / region.strip));
        const auto [there, isNew] = highest.try_emplace(strip, centre);
        if (!isNew && centre.z() > there->second.z()) there->second = centre;
    }
    std::vector<CurvePoint> points;
    for (const auto& [strip, centre] : highest) points.push_back({centre.x(), centre.z()});
    return std::atan(medianSlope(points)) * 180 / std::numbers::pi;
}

/// Degrees, by which the centre of mass of grains in a drum about the origin is turned from below the axis:
/// the inclination of a plane surface, whatever the filling. Grains of one density.
inline double centreAngle(std::span<const Vec3D> centres, std::span<const double> radii) {
    Vec3D sum = Vec3D::Zero();
    for (std::size_t k = 0; k < centres.size(); ++k) sum += std::pow(radii[k], 3) * centres[k];
    return std::atan2(sum.x(), -sum.z()) * 180 / std::numbers::pi;
}

}  // namespace pendular::bulk
