// Contacts of grains that are no spheres, as the bound of the step takes them.
#include <algorithm>
#include <cmath>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/AdaptiveTimeStep/ContactBound.h"
#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"

namespace pendular {

ContactBounds::ShapedTerm ContactBounds::takeShapes(const ParticleStore& grains, const ShapedTouch& touch,
                                                    const Vector<double>& shift,
                                                    const Vector<double>& velocity,
                                                    const ContactOutlook& outlook, Term& term) const {
    term.normal = touch.normal;
    term.gap = -touch.depth;
    term.approach = dot(velocity, touch.normal);
    term.smallerRadius = infinity;
    term.pair.bodies = {touch.radius};
    ShapedTerm found;
    found.first = sideOf(grains, term.first, touch.arm1, touch.normal, outlook);
    if (term.second != none)
        found.second = sideOf(grains, term.second, touch.arm1 - shift, touch.normal, outlook);
    double inverseMass = 0;  // 1/kg, as the contact takes it: of bodies that are free or held altogether
    Bodies flattest{infinity}, around{infinity};
    const auto add = [&](std::uint32_t place, const Vector<double>& arm, double& radius, double& most) {
        const ShapeExtremes extremes = shapes->extremesAt(grains, place);
        radius = extremes.radius, most = extremes.around;
        term.approach += norm(grains.rotation[place].spin) * extremes.lever;
        term.smallerRadius = std::min(term.smallerRadius, shapes->thickness(grains, place));
        const double own = grains.translation[place].inverseMass;
        term.isHeld |= grains.heldAt(place).areAlong();
        const bool isFree = own > 0 && isInBody(place);
        const std::size_t k = isFree ? moverAt(place) - blocks.size() : 0;
        term.isHeld |= isFree && grains.bodies.heldAxesOf(k).any();
        inverseMass += isFree ? mobilityOf(grains.bodies[k], armOf(grains, place, arm), touch.normal) : own;
    };
    add(term.first, found.first.arm, flattest.radius1, around.radius1);
    if (term.second != none) add(term.second, found.second.arm, flattest.radius2, around.radius2);
    term.pair.effectiveMass = 1 / inverseMass;
    found.largestRadius = std::min(flattest.effectiveRadius(), around.effectiveRadius());
    return found;
}

/// The parts of the wall are known.
void ContactBounds::takeShapeAtWall(const ContactSystem& contacts, const Wall& wall,
                                    const ParticleStore& grains, const Bucket& bucket, std::size_t begin,
                                    const ContactOutlook& outlook) {
    const std::uint32_t place = contacts.firstOf(begin);
    shapes->findPoints(grains, place, wall, outlook.reach, parts, points);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        WallPoint point = points[k];
        if (point.coveredBy >= 0) {
            const WallPoint& cover = points[static_cast<std::size_t>(point.coveredBy)];
            if (outlook.reach == 0 || isSmooth(cover.normal, point.normal)) continue;
            shapes->findPoints(grains, place, wall, outlook.reach, {&parts[k], 1}, {&point, 1});
        }
        if (!(point.distance < infinity)) continue;
        const ShapedTouch touch = shapes->touchAtPlane(grains, place, point.normal, point.distance);
        if (!(-touch.depth < outlook.reach)) continue;
        const Vector<double> surface =
            point.velocity + cross(wall.angularVelocity(), touch.arm1 - point.distance * point.normal);
        Term term{.first = place, .second = none, .normal = point.normal};
        const ShapedTerm own =
            takeShapes(grains, touch, {0, 0, 0}, grains.translation[place].velocity - surface, outlook, term);
        if (!(grains.translation[place].inverseMass > 0)) setFixed(contacts, grains, term);
        takeSide(wall, bucket.wall, parts[k], grains.translation[place].position, touch.arm1, term);
        keep(contacts, bucket, begin + k, term, outlook, &own);
    }
}

ContactBounds::ShapedSide ContactBounds::sideOf(const ParticleStore& grains, std::uint32_t place,
                                                const Vector<double>& arm, const Vector<double>& normal,
                                                const ContactOutlook& outlook) const {
    ShapedSide side{.arm = arm};
    if (!(outlook.time > 0) || !isInBody(place)) return side;
    const RigidBody& body = grains.bodies[moverAt(place) - blocks.size()];
    const Vector<double> lever = armOf(grains, place, arm);
    const auto response = [&](const Vector<double>& a, const Vector<double>& b) {  // over 1/m
        const Vector<double> p = body.orientation.turnBack(cross(lever, a)),
                             q = body.orientation.turnBack(cross(lever, b));
        return dot(a, b) + body.mass * (p.x * q.x / body.inertia.x + p.y * q.y / body.inertia.y +
                                        p.z * q.z / body.inertia.z);
    };
    const TangentPlane<double> plane(normal);
    const double uu = response(plane.u, plane.u), vv = response(plane.v, plane.v),
                 least = 0.5 * (uu + vv - std::hypot(uu - vv, 2 * response(plane.u, plane.v)));
    const ShapeExtremes extremes = shapes->extremesAt(grains, place);
    side.normal = std::max(1.0, (1 + extremes.turning) / response(normal, normal));
    side.sliding = std::max(1.0, (1 + extremes.sliding) / least);
    return side;
}

}  // namespace pendular
