#include "Kernel/Features/RigidBodies/BodyLimits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Walls/InfiniteWall.h"

namespace pendular {

namespace {

/// One side of a contact.
struct TouchingBody {
    std::size_t species;
    double radius;         // m; infinite of a wall; of a block that of its edges
    double flat = 0;       // m, of a block: the largest that counts on its faces
    double mass;           // kg; infinite of what does not move, or may not
    double spheres = 1;    // of a body that another grain touches at once, in the mean
    bool isPlane = false;  // of a wall
    double finer = 0;      // 1/m, and
    double finest = 0;     // 1/m^2: means of 1/r and 1/r^2 over the surface of a body
    [[nodiscard]] bool isBlock() const { return flat > 0; }
    /// Held grains may lie as densely as the spheres of a body.
    [[nodiscard]] bool isHeld() const { return radius < infinity && !(mass < infinity); }
};

/// How many bodies there are: one that is alone touches no other.
std::size_t countOf(const std::vector<BodiesAlike>& bodies) {
    std::size_t count = 0;
    for (const BodiesAlike& one : bodies) count += one.count;
    return count;
}

/// Whether bodies touch others: not one that is alone, but it is taken among its equals where there is
/// nothing else that it could touch.
bool touchBodies(const GrainSizes& grains, const GrainSizes& others, const WallHandler& walls) {
    return countOf(grains.bodies) > 1 ||
           (walls.present().empty() && std::ranges::all_of(others.all, &SizeRange::empty));
}

/// From how many sides, up to six, plane walls may touch a body.
double sidesOfPlanes(const WallHandler& walls) {
    double sides = 0;
    for (const PresentWall& wall : walls.present())
        sides += dynamic_cast<const InfiniteWall*>(wall.object.get()) ? 1 : wall.object->isFlat() ? 6 : 0;
    return std::min(sides, 6.0);
}

/// What bodies may touch: the extremes of each species.
std::vector<TouchingBody> partners(const ContactLaws& species, const GrainSizes& grains,
                                   const WallHandler& walls) {
    std::vector<TouchingBody> found;
    const GrainSizes others = grains.withoutBodies();
    for (std::size_t s = 0; s < others.all.size(); ++s) {
        const SizeRange& sizes = others.all[s];
        if (sizes.empty()) continue;
        const double heaviest = others.held[s].empty() ? species.massOf(s, sizes.largest) : infinity;
        for (const double radius : {sizes.smallest, sizes.largest})
            found.push_back({.species = s, .radius = radius, .mass = heaviest});
    }
    for (std::size_t s = 0; s < grains.all.size() && touchBodies(grains, others, walls); ++s)
        for (const bool blocks : {false, true}) {
            TouchingBody smallest{.species = s, .radius = infinity, .mass = 0},
                largest{.species = s, .radius = 0, .mass = 0};
            for (const BodiesAlike& body : grains.bodies) {
                if (body.species != s || body.isBlock != blocks) continue;
                const BodiesAlike::Size &light = body.least, &heavy = body.most;
                smallest.radius = std::min({smallest.radius, light.smallest, heavy.smallest});
                const double own = blocks ? std::max(light.smallest, heavy.smallest)
                                          : std::max(light.largest, heavy.largest);
                largest.radius = std::max(largest.radius, own);
                largest.mass = std::max(largest.mass, heavy.mass);
                largest.spheres = std::max(largest.spheres, body.around.facing());
                const double widest = light.largest;
                largest.finer = std::max(largest.finer, body.around.finer / widest);
                largest.finest = std::max(largest.finest, body.around.finest / (widest * widest));
                if (blocks) largest.flat = std::max({largest.flat, light.largest, heavy.largest});
            }
            if (!(largest.mass > 0)) continue;
            smallest.mass = largest.mass, smallest.spheres = largest.spheres, smallest.flat = largest.flat;
            smallest.finer = largest.finer, smallest.finest = largest.finest;
            found.push_back(smallest), found.push_back(largest);
        }
    for (const PresentWall& wall : walls.present())
        found.push_back({.species = static_cast<std::size_t>(wall.object->getSpeciesIndex()),
                         .radius = infinity,
                         .mass = infinity,
                         .isPlane = wall.object->isFlat()});
    return found;
}

/// As Hertz's law takes a touch: of a block the face is flat, and a sphere on it has at most the block's
/// largest radius.
Bodies touchOf(const TouchingBody& one, const TouchingBody& two) {
    if (!one.isBlock() && !two.isBlock()) return Bodies{one.radius, two.radius};
    if (one.isBlock() && two.isBlock()) return Bodies{std::max(one.radius, two.radius), infinity};
    const TouchingBody &block = one.isBlock() ? one : two, &other = one.isBlock() ? two : one;
    if (!(other.radius < infinity)) return Bodies{block.radius, infinity};
    return Bodies{std::max(block.radius, std::min(other.radius, block.flat)), infinity};
}

/// More grains than are supposed find room on a body if they are smaller than its spheres: on a sphere of
/// radius R those of radius r, ((R + r) / 2 r)^2 times as many, and of the spheres of bodies the mean over
/// their surface. On the face of a block eight are supposed, and there is room for a hexagonal layer.
double roomFor(const TouchingBody& partner, const TouchingBody& own, double face) {
    if (partner.isBlock() || !(partner.radius < infinity)) return 1;
    const double radius = partner.radius;
    if (own.isBlock()) return std::max(1.0, face / (2 * std::numbers::sqrt3 * radius * radius) / 8);
    const double ofOne = 1 / radius, finer = partner.finer > 0 ? partner.finer : ofOne,
                 finest = partner.finest > 0 ? partner.finest : ofOne * ofOne;
    return std::max(1.0, 0.25 * (own.radius * own.radius * finest + 2 * own.radius * finer + 1));
}

/// The spheres of a body that one of another radius touches at once, where one of theirs touches so many: at
/// one overlap the part of the surface that it touches grows as R + r.
double touchedBy(double radius, double ofBody, double touched) {
    return 1 + (touched - 1) * std::max(1.0, (radius + ofBody) / (2 * ofBody));
}

/// Contacts of one side, as if each of the other were at rest, over the mass.
class ContactLoads {
public:
    ContactLoads(const ContactLaws& of, const GrainSizes& grains, std::size_t contacts)
        : species(of), heldDamping(grains.heldDamping), met(contacts) {}

    struct Contact {
        ContactStiffness stiffness;
        Bodies bodies;
        double effectiveMass;  // kg
    };
    [[nodiscard]] Contact contactOf(const TouchingBody& own, const TouchingBody& partner) const {
        const double mass = 1 / (1 / own.mass + 1 / partner.mass);
        const Bodies bodies = touchOf(own, partner);
        // A block's radii are true ones, which the laws of shapes would take as those of spheres around.
        const double known =
            own.isBlock() || partner.isBlock() ? std::sqrt(species.shapes()->largestRadiusRatio()) : 1;
        return {species.stiffness(static_cast<int>(own.species), static_cast<int>(partner.species),
                                  {bodies.radius1 / known, bodies.radius2 / known}, heldDamping * mass),
                bodies, mass};
    }
    /// Of a body. @param times more contacts than it has among its equals
    [[nodiscard]] BodyLoad ofBody(const Contact& contact, const ContactsAround& around, double mass,
                                  double times) const {
        const ContactStiffness& s = contact.stiffness;
        const double unit = times / mass, turn = around.turning * squaredLeverOfRotation(contact.bodies);
        const SpringAndDashpot turning = met.across * turn * s.rolling + met.along * turn * s.torsion,
                               spin = unit * (met.across * around.spin * s.sliding + turning);
        const SpringAndDashpot both =
            unit * (met.along * around.normal * s.normal + met.across * around.sliding * s.sliding + turning);
        return completed({.all = larger(both, spin), .spin = spin}, contact, 4 * around.normal / mass);
    }
    /// Of a body at planes on so many sides.
    [[nodiscard]] BodyLoad ofBodyAtPlanes(const Contact& contact, const ContactsAround& around, double mass,
                                          double sides) const {
        const ContactStiffness& s = contact.stiffness;
        const double turn = sides * around.turning * squaredLeverOfRotation(contact.bodies);
        const auto of = [sides](double one, double box) { return std::min(sides * one, box); };
        const double normal = of(around.wallNormal, around.boxNormal),
                     sliding = of(around.wallSliding, around.boxSliding),
                     spin = of(around.wallSpin, around.boxSpin);
        const SpringAndDashpot turning = turn * (s.rolling + s.torsion);
        return completed({.all = 1 / mass * (normal * s.normal + sliding * s.sliding + turning),
                          .spin = 1 / mass * (spin * s.sliding + turning)},
                         contact, around.wallNormal / mass);
    }
    /// Of a free sphere, each of whose contacts is with so many spheres.
    [[nodiscard]] BodyLoad ofSphere(const Contact& contact, double mass, double spheres) const {
        const ContactStiffness& s = contact.stiffness;
        const double unit = spheres / mass;
        const SpringAndDashpot spin = turningAmong(met, s, contact.bodies, 1 / unit);
        return completed(
            {.all = larger(unit * (met.along * s.normal + met.across * s.sliding), spin), .spin = spin},
            contact, unit);
    }
    [[nodiscard]] double along() const { return met.along; }

private:
    /// @param mobility 1/kg, of the side at one contact
    [[nodiscard]] static BodyLoad completed(BodyLoad load, const Contact& contact, double mobility) {
        load.relaxation = contact.stiffness.shortestRelaxation();
        load.neighbours =
            implicitNeighboursLimit(contact.stiffness, 1 / (1 / contact.effectiveMass + mobility));
        return load;
    }
    const ContactLaws& species;
    double heldDamping;
    Neighbours met;
};

BodyLoad largest(const BodyLoad& a, const BodyLoad& b) {
    return {larger(a.all, b.all), larger(a.spin, b.spin), std::min(a.relaxation, b.relaxation),
            std::min(a.neighbours, b.neighbours)};
}

/// A load, and a share of another one.
BodyLoad sum(const BodyLoad& a, const BodyLoad& b, double share) {
    return {a.all + share * b.all, a.spin + share * b.spin, std::min(a.relaxation, b.relaxation),
            std::min(a.neighbours, b.neighbours)};
}

/// The sides of a body: with its smallest and its largest grains.
std::array<TouchingBody, 2> sidesOf(const BodiesAlike& body, const BodiesAlike::Size& size) {
    TouchingBody smallest{.species = body.species, .radius = size.smallest, .mass = size.mass},
        largest = smallest;
    if (body.isBlock) smallest.flat = largest.flat = size.largest;
    else largest.radius = size.largest;
    return {smallest, largest};
}

/// Of a body among all that it may touch, and between planes.
BodyLoad loadOfBody(const ContactLoads& loads, const BodiesAlike& body, const BodiesAlike::Size& size,
                    const TouchingBody& own, const std::vector<TouchingBody>& partners, double sides) {
    BodyLoad amongOthers, atPlanes, amongPlanes;
    for (const TouchingBody& partner : partners) {
        const ContactLoads::Contact contact = loads.contactOf(own, partner);
        if (partner.isPlane) {
            const auto between = [&](double planes) {
                return loads.ofBodyAtPlanes(contact, body.around, size.mass, planes);
            };
            atPlanes = largest(atPlanes, between(std::min(sides, 2.0)));
            amongPlanes = largest(amongPlanes, between(sides));
            continue;
        }
        const double spheres =
            partner.isHeld() ? std::max(partner.spheres, body.around.facing()) : partner.spheres;
        amongOthers = largest(amongOthers, loads.ofBody(contact, body.around, size.mass,
                                                        spheres * roomFor(partner, own, size.face)));
    }
    // Planes on two sides leave room for half of the others, on all sides for none.
    return largest(largest(amongOthers, amongPlanes), sum(atPlanes, amongOthers, 0.5));
}

/// Of the free spheres on such bodies: among these, or on one at its densest place.
BodyLoad loadOfSpheres(const ContactLoads& loads, const ContactLaws& species, const GrainSizes& alone,
                       const ContactsAround& around, const TouchingBody& body) {
    const double touched = std::max(around.mean, around.most / loads.along());
    BodyLoad load;
    for (std::size_t s = 0; s < alone.free.size(); ++s) {
        if (alone.free[s].empty()) continue;
        for (const double radius : {alone.free[s].smallest, alone.free[s].largest}) {
            const double mass = species.massOf(s, radius);
            const TouchingBody sphere{.species = s, .radius = radius, .mass = mass};
            load = largest(load, loads.ofSphere(loads.contactOf(sphere, body), mass,
                                                touchedBy(radius, body.radius, touched)));
        }
    }
    return load;
}

}  // namespace

BodyLoad loadOfBodies(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                      std::size_t contacts) {
    const ContactLoads loads(species, grains, contacts);
    const GrainSizes alone = grains.withoutBodies();
    BodyLoad ofBodies, ofSpheres;
    const std::vector<TouchingBody> all = partners(species, grains, walls);
    const double sides = sidesOfPlanes(walls);
    for (const BodiesAlike& body : grains.bodies)
        for (const BodiesAlike::Size& size : {body.least, body.most})
            for (const TouchingBody& own : sidesOf(body, size)) {
                ofBodies = largest(ofBodies, loadOfBody(loads, body, size, own, all, sides));
                ofSpheres = largest(ofSpheres, loadOfSpheres(loads, species, alone, body.around, own));
            }
    forEachExtremePair(species, alone, walls, [&](const PairLaws& pair, const Bodies& bodies, double mass) {
        const ContactStiffness stiffness = contactStiffness(pair, bodies, grains.heldDamping * mass);
        const double own = species.massOf(static_cast<std::size_t>(pair.a), bodies.radius1);
        ofSpheres = largest(ofSpheres, loads.ofSphere({stiffness, bodies, mass}, own, 1));
    });
    // One that is alone touches only what does not move.
    const bool isOnly =
        !touchBodies(grains, alone, walls) && std::ranges::all_of(alone.free, &SizeRange::empty);
    BodyLoad both = isOnly ? BodyLoad{} : largest(ofBodies, ofSpheres);
    both.all = both.all + ofBodies.all, both.spin = both.spin + ofBodies.spin;
    both.relaxation = std::min(both.relaxation, ofBodies.relaxation);
    both.neighbours = std::min(both.neighbours, ofBodies.neighbours);
    return both;
}

double limitOfBodies(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                     const Integrator& integrator, std::size_t contacts, const WallResponse& ofWalls) {
    if (grains.bodies.empty()) return infinity;
    const BodyLoad load = loadOfBodies(species, grains, walls, contacts);
    const SpringAndDashpot mode = load.all + larger(ofWalls.shift, ofWalls.spin);
    const double turning = load.spin.spring + ofWalls.spin.spring;  // 1/s^2
    double limit = SignChange(integrator).limit(mode);
    if (!integrator.contacts.timesTouches) return stabilityMargin * limit;
    if (integrator.contacts.implicitForces) limit = std::min(limit, load.neighbours);
    if (!integrator.contacts.springsInStep && turning > 0)
        limit = std::min(limit, springsAheadLimit(turning, load.relaxation, integrator));
    return stabilityMargin * limit;
}

double stepOfFastestBodies(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls) {
    if (grains.bodies.empty()) return infinity;
    const BodyLoad load = loadOfBodies(species, grains, walls, contactsInDensestBed);
    return std::min(stabilityMargin * 2 / std::sqrt(load.all.spring), stabilityMargin * load.neighbours);
}

}  // namespace pendular
