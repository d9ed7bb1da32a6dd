#include "Kernel/Features/AdaptiveTimeStep/ContactBound.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "Kernel/Core/Contacts/HeldMasses.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/AdaptiveTimeStep/UnitSums.h"
#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {
namespace {

/// Contacts that barely touch are taken for this overlap, of the smaller radius: the slope of a law is asked
/// at none at all.
constexpr double smallestOverlap = 1e-6;

/// What a motion of a rigid body gives at a contact: its slip along a direction is the product of this with
/// sqrt(M) v and sqrt(I) w in the principal axes.
struct BodySlip {
    using Six = std::array<double, 6>;

    /// @param contact m, from the centre of mass, in the principal axes
    BodySlip(const RigidBody& body, const Vector<double>& contact)
        : arm(contact),
          shift(1 / std::sqrt(body.mass)),
          spin{1 / std::sqrt(body.inertia.x), 1 / std::sqrt(body.inertia.y), 1 / std::sqrt(body.inertia.z)} {}

    [[nodiscard]] Six along(const Vector<double>& direction) const {
        Six slip = turning(cross(arm, direction));
        slip[0] = shift * direction.x, slip[1] = shift * direction.y, slip[2] = shift * direction.z;
        return slip;
    }
    /// Of the spin alone, about an axis.
    [[nodiscard]] Six turning(const Vector<double>& axis) const {
        return {0, 0, 0, spin.x * axis.x, spin.y * axis.y, spin.z * axis.z};
    }

    Vector<double> arm;   // m
    double shift;         // 1/sqrt(kg)
    Vector<double> spin;  // 1/sqrt(kg m^2)
};

struct Terms {
    double along, across;  // of n n and of 1 - n n
};
void add(std::array<double, 6>& to, const Terms& t, const Vector<double>& n, double unit) {
    const double difference = t.along - t.across;
    const std::array<double, 6> parts{t.across + difference * n.x * n.x,
                                      t.across + difference * n.y * n.y,
                                      t.across + difference * n.z * n.z,
                                      difference * n.x * n.y,
                                      difference * n.x * n.z,
                                      difference * n.y * n.z};
    for (std::size_t k = 0; k < 6; ++k) to[k] += inUnits(parts[k], unit);
}

}  // namespace

/// Newton's method from above on the characteristic polynomial, which is convex there: it comes down to the
/// largest root and not below it. It begins at the bound of Wolkowicz and Styan (1980), Linear Algebra Appl.
/// 29, 471: mean + sqrt(2) standard deviations of the eigenvalues.
double largestEigenvalue(const std::array<double, 6>& m, bool exact) {
    const auto [xx, yy, zz, xy, xz, yz] = m;
    const double off = xy * xy + xz * xz + yz * yz;
    const double mean = (xx + yy + zz) / 3;
    const double a = xx - mean, b = yy - mean, c = zz - mean;
    const double p = (a * a + b * b + c * c + 2 * off) / 6;  // of 2 standard deviations^2 over 3
    const double half = 0.5 * (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz));
    if (!(p > 0)) return mean;
    // t^3 - 3 p t - 2 half = 0 for t = eigenvalue - mean
    double t = 2 * std::sqrt(p);
    for (int k = 0; exact && k < 30; ++k) {
        const double slope = 3 * (t * t - p), value = t * (t * t - 3 * p) - 2 * half;
        if (!(slope > 0) || !(value > 0)) break;
        const double next = t - value / slope;
        const bool isNear = !(next < t * (1 - 1e-7));
        t = std::min(t, next);
        if (isNear) break;
    }
    return mean + t;
}

ContactBound ContactBounds::find(const ContactSystem& contacts, const WallHandler& walls,
                                 const ParticleStore& grains, const Integrator& integrator,
                                 const ContactOutlook& outlook) {
    ContactBound found;
    terms.clear(), shaped.clear(), wallSides.clear(), masses.reset();
    box = &contacts.periodicBox();
    shapes = contacts.laws().shapes();
    findBodies(grains);
    findMovedWalls(walls);
    std::vector<std::size_t> ends;
    for (const Bucket& bucket : contacts.store().buckets) {
        take(contacts, walls, grains, bucket, outlook);
        ends.push_back(terms.size());
    }
    const AllRanks& ranks = contacts.ranks();
    summarise(found, grains, ranks);
    const auto forEachBucket = [&](auto&& function) {
        std::size_t begin = 0;
        for (std::size_t k = 0; k < ends.size(); begin = ends[k++])
            function(contacts.store().buckets[k], std::span(terms).subspan(begin, ends[k] - begin));
    };
    forEachBucket([&](const Bucket& bucket, std::span<Term> ofBucket) {
        for (Term& term : ofBucket) {
            term.reached = reachedOverlap(contacts.laws(), bucket, term, outlook);
            found.supposedOverlap = std::max(
                found.supposedOverlap, outlook.margin * term.reached / term.pair.bodies.effectiveRadius());
            if (shapes && outlook.time > 0)
                term.pair.bodies = {shaped[static_cast<std::size_t>(&term - terms.data())].largestRadius};
        }
        press(contacts.laws(), bucket, ofBucket, outlook, found.meanOverlap);
    });
    found.supposedOverlap = ranks.largest(found.supposedOverlap);
    chooseWeights(contacts, grains);
    for (const Term& term : terms) {
        addTo(grains, term, term.first, term.second);
        if (term.second != none) addTo(grains, term, term.second, term.first);
        if (term.side != none && term.first < grains.ownSize()) addToWall(term);
    }
    for (std::size_t k = 0; k < grains.held.size(); ++k) holdBlock(grains.held[k], blocks[k]);
    for (std::size_t k = 0; k < grains.ownSize(); ++k)
        takeLeast(blocks[k], grains.identity[k], integrator, found);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        takeLeast(bodies[k], grains.bodies.membersOf(k).front().grain, integrator, found);
    if (ranks.areSeveral()) takeLeastOfRanks(found, ranks);
    if (!movedWalls.empty()) takeLeastOfWalls(grains, integrator, ranks, found);
    return found;
}

void ContactBounds::takeLeastOfRanks(ContactBound& found, const AllRanks& ranks) {
    for (const ContactBound& one : ranks.gather(std::vector{found})) {
        if (one.step > found.step || (one.step == found.step && one.grain > found.grain)) continue;
        found.step = one.step;
        found.grain = one.grain;
        found.contactsOfGrain = one.contactsOfGrain;
        found.overlapOfGrain = one.overlapOfGrain;
    }
}

/// A grain does not move along and about axes in which it is held. (Those of bodies are left as if free,
/// which bounds them, too.)
void ContactBounds::holdBlock(HeldBits held, OfGrain& of) {
    if (!held.any()) return;
    const auto keepFree = [](std::array<double, 6>& m, const Vector<double>& f) {
        const std::array<double, 6> factors{f.x, f.y, f.z, f.x * f.y, f.x * f.z, f.y * f.z};
        for (std::size_t k = 0; k < 6; ++k) m[k] *= factors[k];
    };
    for (GrainBlock* const block : {&of.spring, &of.dashpot}) {
        keepFree(block->shift, held.freeAlong());
        keepFree(block->spin, held.freeAbout());
    }
}

template <class One>
void ContactBounds::takeLeast(const One& one, std::uint32_t identity, const Integrator& integrator,
                              ContactBound& found) {
    if (one.contacts == 0) return;
    // Most are seen not to bind before their eigenvalues are found.
    if (stepOf(one, integrator, false) > found.step) return;
    const double step = stepOf(one, integrator, true);
    if (step > found.step || (step == found.step && identity > found.grain)) return;
    found.step = step;
    found.grain = identity;
    found.contactsOfGrain = one.contacts;
    found.overlapOfGrain = one.overlap;
}

void ContactBounds::findBodies(const ParticleStore& grains) {
    blocks.assign(grains.size(), {});
    bodies.assign(grains.bodies.sizeWithGhosts(), {});
    movers.clear();
    if (bodies.empty()) return;
    for (std::uint32_t place = 0; place < grains.size(); ++place) movers.push_back(place);
    for (std::size_t k = 0; k < bodies.size(); ++k)
        for (const BodyMember& member : grains.bodies.membersOf(k))
            movers[grains.placeOf(member.grain)] = static_cast<std::uint32_t>(blocks.size() + k);
}

Vector<double> ContactBounds::fromGrain(const ParticleStore& grains, const Term& term,
                                        std::uint32_t place) const {
    if (shapes) return sideOf(term, place).arm;
    const double radius = grains.translation[place].radius;
    return (place == term.first ? radius : -radius) * term.normal;
}

Vector<double> ContactBounds::armOf(const ParticleStore& grains, std::uint32_t place,
                                    const Vector<double>& fromGrain) const {
    const RigidBody& body = grains.bodies[moverAt(place) - blocks.size()];
    return box->nearest(grains.translation[place].position - body.position) + fromGrain;
}

double ContactBounds::inverseInertia(const ParticleStore& grains, std::uint32_t place) const {
    if (!isInBody(place)) return grains.rotation[place].inverseInertia;
    const Vector<double>& moments = grains.bodies[moverAt(place) - blocks.size()].inertia;
    return 1 / std::min({moments.x, moments.y, moments.z});
}

double ContactBounds::mobility(const ParticleStore& grains, const Term& term, std::uint32_t place) const {
    if (!isInBody(place)) return grains.translation[place].inverseMass;
    const std::size_t k = moverAt(place) - blocks.size();
    return mobilityOf(grains.bodies[k], armOf(grains, place, fromGrain(grains, term, place)), term.normal,
                      grains.bodies.heldAxesOf(k));
}

/// Finds the load of each grain, and the units of the sums.
void ContactBounds::chooseWeights(const ContactSystem& contacts, const ParticleStore& grains) {
    const auto forBoth = [](const Term& term, auto&& function) {
        function(term.first);
        if (term.second != none) function(term.second);
    };
    const auto stiffest = [](const ContactStiffness& s, auto part) {
        return std::max({s.normal.*part, s.sliding.*part, s.rolling.*part, s.torsion.*part});
    };
    const auto springOf = [&](const Term& term, std::uint32_t place) {
        return stiffest(term.stiffness, &SpringAndDashpot::spring) * mobility(grains, term, place);
    };
    loads.assign(blocks.size() + bodies.size(), 0);
    double largest = 0, dashpot = 0;
    for (const Term& term : terms)
        forBoth(term, [&](std::uint32_t place) { largest = std::max(largest, springOf(term, place)); });
    springUnit = unitOf(contacts.ranks().largest(largest));
    for (const Term& term : terms)
        forBoth(term, [&](std::uint32_t place) {
            loads[moverAt(place)] += inUnits(springOf(term, place), springUnit);
        });
    contacts.tellGhosts(std::span(loads).first(blocks.size()), std::span(loads).subspan(blocks.size()));
    if (!movedWalls.empty()) chooseWeightsOfWalls(grains, contacts.ranks());
    largest = largestLoadOfWalls();
    for (const double load : loads) largest = std::max(largest, load);
    largest = contacts.ranks().largest(largest);
    // An entry is at most 5/2 (1 + t) k/m, with t k/m at most the load of the other grain.
    springUnit = unitOf(8 * largest);
    for (const Term& term : terms) {
        const std::uint32_t other = term.second;
        const double share =
            term.second == none ? 1 : 1 + std::max(weight(term.first, other), weight(other, term.first));
        forBoth(term, [&](std::uint32_t place) {
            dashpot = std::max(dashpot, shareOf(grains, term, place, none) * share *
                                            stiffest(term.stiffness, &SpringAndDashpot::dashpot) *
                                            mobility(grains, term, place));
        });
        if (const double t = weightAtWall(term); t > 0)
            dashpot = std::max(dashpot, (1 + 1 / t) * wallSides[term.side].dashpot);
    }
    dashpotUnit = unitOf(4 * contacts.ranks().largest(dashpot));
}

/// The contacts of a bucket that act, or are within reach. Those of one grain with the parts of a wall follow
/// each other.
void ContactBounds::take(const ContactSystem& contacts, const WallHandler& walls, const ParticleStore& grains,
                         const Bucket& bucket, const ContactOutlook& outlook) {
    const ContactStore& store = contacts.store();
    const std::size_t end = bucket.end * Pack::lanes;
    for (std::size_t c = bucket.begin * Pack::lanes, next; c < end; c = next) {
        next = c + 1;
        if (!store.isListed(c)) continue;
        if (bucket.wall < 0) {
            takePair(contacts, grains, bucket, c, outlook);
            continue;
        }
        while (next < end && store.isListed(next) && store.firstOf(next) == store.firstOf(c)) ++next;
        takeAtWall(contacts, walls.getObject(static_cast<std::size_t>(bucket.wall)), grains, bucket, c, next,
                   outlook);
    }
}

/// Whether a contact counts only where its bodies are within the outlook's reach: most that are listed are
/// not.
static bool countsOnlyWithinReach(const ContactSystem& contacts, const Bucket& bucket, std::size_t contact) {
    return !contacts.laws().ofPair(bucket.species1, bucket.species2).resistsMotion &&
           !contacts.isBridged(contact);
}

void ContactBounds::takePair(const ContactSystem& contacts, const ParticleStore& grains, const Bucket& bucket,
                             std::size_t contact, const ContactOutlook& outlook) {
    const std::uint32_t first = contacts.firstOf(contact), second = contacts.secondOf(contact);
    const TranslationRecord &one = grains.translation[first], &two = grains.translation[second];
    if (!(one.inverseMass + two.inverseMass > 0)) return;
    const PeriodicBox& box = contacts.periodicBox();
    const Vector<double> apart = two.position - one.position, shift = box.nearest(apart);
    const double reach = (one.radius + two.radius + outlook.reach) * (1 + 1e-12);  // rounded
    if (countsOnlyWithinReach(contacts, bucket, contact) && squaredNorm(shift) > reach * reach) return;
    const double distance = norm(shift);
    Vector<double> velocity = one.velocity - two.velocity;
    if (box.imagesMove) velocity += box.velocityBetweenImages(apart, shift);
    Term term{.first = first, .second = second, .normal = (1 / distance) * shift};
    term.gap = distance - (one.radius + two.radius);
    if (shapes) {
        if (!(term.gap < outlook.reach)) return;
        const ShapedTerm both =
            takeShapes(grains, shapes->touch(grains, first, second, shift), shift, velocity, outlook, term);
        return keep(contacts, bucket, contact, term, outlook, &both);
    }
    term.approach = dot(velocity, term.normal);
    term.smallerRadius = std::min(one.radius, two.radius);
    term.pair.bodies = {one.radius, two.radius};
    term.pair.effectiveMass = 1 / (one.inverseMass + two.inverseMass);
    const HeldBits held1 = grains.heldAt(first), held2 = grains.heldAt(second);
    term.isHeld = held1.areAlong() || held2.areAlong();
    if (term.isHeld)
        term.pair.effectiveMass =
            heldMass(term.normal, one.inverseMass, held1, two.inverseMass, held2).effective;
    keep(contacts, bucket, contact, term, outlook);
}

/// Parts that others cover have no contact of their own. By the next choice one may: it does not turn by more
/// than a smooth surface, or it is not yet within reach (README).
void ContactBounds::takeAtWall(const ContactSystem& contacts, const Wall& wall, const ParticleStore& grains,
                               const Bucket& bucket, std::size_t begin, std::size_t end,
                               const ContactOutlook& outlook) {
    const std::uint32_t first = contacts.firstOf(begin);
    const TranslationRecord& grain = grains.translation[first];
    const bool isFixed = !(grain.inverseMass > 0);
    if (isFixed && !isMoved(bucket.wall)) return;
    parts.clear();
    for (std::size_t c = begin; c < end; ++c) parts.push_back(contacts.secondOf(c));
    points.assign(parts.size(), {});
    if (shapes) return takeShapeAtWall(contacts, wall, grains, bucket, begin, outlook);
    const ContactLaws& laws = contacts.laws().ofPair(bucket.species1, bucket.species2);
    const Bodies bodies{grain.radius};
    const double range = laws.resistsMotion ? laws.range(bucket.species1, bucket.species2, bodies) : 0;
    const double reach = grain.radius + outlook.reach + range;
    wall.findPoints(grain.position, reach, parts, points);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        WallPoint point = points[k];
        if (point.coveredBy >= 0) {
            const WallPoint& cover = points[static_cast<std::size_t>(point.coveredBy)];
            if (outlook.reach == 0 || isSmooth(cover.normal, point.normal)) continue;
            wall.findPoints(grain.position, reach, {&parts[k], 1}, {&point, 1});
        }
        Term term{.first = first, .second = none, .normal = point.normal};
        term.gap = point.distance - grain.radius;
        term.approach = dot(grain.velocity - point.velocity, term.normal);
        term.smallerRadius = grain.radius;
        term.pair.bodies = bodies;
        if (isFixed) setFixed(contacts, grains, term);
        else term.pair.effectiveMass = 1 / grain.inverseMass;
        term.isHeld = !isFixed && grains.heldAt(first).areAlong();
        if (term.isHeld)
            term.pair.effectiveMass =
                heldMass(term.normal, grain.inverseMass, grains.heldAt(first), 0, {}).effective;
        takeSide(wall, bucket.wall, parts[k], grain.position,
                 (0.5 * (grain.radius + point.distance)) * term.normal, term);
        keep(contacts, bucket, begin + k, term, outlook);
    }
}

void ContactBounds::setFixed(const ContactSystem& contacts, const ParticleStore& grains, Term& term) {
    if (!masses) masses.emplace(grains, contacts.laws());
    term.isFixed = true;
    term.pair.effectiveMass = (*masses)(term.first);
}

/// If it acts, or is within reach.
void ContactBounds::keep(const ContactSystem& contacts, const Bucket& bucket, std::size_t contact, Term& term,
                         const ContactOutlook& outlook, const ShapedTerm* ofShapes) {
    const int a = bucket.species1, b = bucket.species2;
    const ContactLaws& laws = contacts.laws().ofPair(a, b);
    term.drags = contacts.isBridged(contact);
    if (!term.drags && laws.resistsMotion) {
        const double forms =
            laws.formsAtContact ? laws.filmContactGap(a, b) : laws.range(a, b, term.pair.bodies);
        term.drags = term.gap < outlook.reach + forms;
    }
    if (!(term.gap < outlook.reach || term.gap < 0 || term.drags)) return;
    terms.push_back(term);
    if (ofShapes) shaped.push_back(*ofShapes);
}

void ContactBounds::summarise(ContactBound& found, const ParticleStore& grains, const AllRanks& ranks) const {
    ExactSum sum;  // whatever the order of the list
    for (const Term& term : terms) {
        if (!(term.gap < 0) || term.first >= grains.ownSize()) continue;
        const double overlap = -term.gap / term.smallerRadius;
        ++found.touching;
        found.largestOverlap = std::max(found.largestOverlap, overlap);
        sum.add(overlap);
    }
    found.touching = ranks.sum(found.touching);
    found.largestOverlap = ranks.largest(found.largestOverlap);
    ranks.addUp({&sum});
    if (found.touching > 0) found.meanOverlap = sum.value() / static_cast<double>(found.touching);
}

/// The overlap is bounded by the way that the pair goes in the time, and by its energy, whichever gives less.
/// A spring whose stiffness k grows with the overlap d at most as its square root (Hertz) has at d an energy
/// of at least k d^2 / 3.75, and one of d^(5/2) or d^2 at smaller overlaps: so an energy that is a share e of
/// that is met at
/// e^(2/5) d at the latest. An overlap that is there already only makes it stiffer. Dashpots help;
/// attraction, springs that yield, and what others do are left to the margin and to the watch of overlaps.
double ContactBounds::reachedOverlap(const ContactLaws& laws, const Bucket& bucket, const Term& term,
                                     const ContactOutlook& outlook) {
    const double now = std::max(-term.gap, 0.0), approach = std::max(term.approach + outlook.falling, 0.0);
    const double way = approach * outlook.time - std::max(term.gap, 0.0);  // m, of the overlap
    if (!(way > 0)) return now;
    const double spring = laws.ofPair(bucket.species1, bucket.species2)
                              .normalStiffness(bucket.species1, bucket.species2, term.pair.bodies, way);
    const double last = approach + outlook.falling;  // m/s, at the end of the time: `falling` is the mean
    const double share = 0.5 * term.pair.effectiveMass * last * last / (spring * way * way / 3.75);
    return now + (share < 1 ? exponential2(0.4 * logarithm2(std::max(share, 1e-300))) : 1) * way;
}

/// The stiffness of the contacts of a bucket at the overlaps that they have, or are supposed to have: with
/// the margin what they can reach, and the mean of all, which those that others press have sooner or later.
/// @param mean of the smaller radius
void ContactBounds::press(const ContactLaws& laws, const Bucket& bucket, std::span<Term> ofBucket,
                          const ContactOutlook& outlook, double mean) {
    const double others = outlook.time > 0 ? outlook.margin * mean : 0;
    std::vector<PressedPair> pairs;
    for (Term& term : ofBucket) {
        double overlap = std::max(outlook.margin * term.reached, others * term.smallerRadius);
        if (overlap > 0) overlap = std::max(overlap, outlook.leastOverlap * term.smallerRadius);
        term.gap = -overlap;
        term.pair.overlap = std::max(overlap, smallestOverlap * term.smallerRadius);
        pairs.push_back(term.pair);
    }
    std::vector<ContactStiffness> stiffness(pairs.size());
    laws.ofPair(bucket.species1, bucket.species2)
        .stiffnesses(bucket.species1, bucket.species2, pairs, stiffness);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        ContactStiffness& s = ofBucket[k].stiffness = stiffness[k];
        if (!outlook.sticking) s.sliding = s.rolling = s.torsion = {};
        if (ofBucket[k].gap < 0) continue;
        for (SpringAndDashpot* part : {&s.normal, &s.sliding, &s.rolling, &s.torsion})
            part->spring = ofBucket[k].drags ? part->spring : 0;
    }
}

double ContactBounds::shareOf(const ParticleStore& grains, const Term& term, std::uint32_t place,
                              std::uint32_t other) const {
    if (other == none) return term.isFixed ? 1 : 1 + weightAtWall(term);
    const bool isShared = grains.translation[other].inverseMass > 0;
    return isShared ? 1 + weight(place, other) : 1;
}

template <class One>
void ContactBounds::note(const Term& term, One& one) {
    ++one.contacts;
    one.overlap = std::max(one.overlap, term.pair.overlap / term.smallerRadius);
    one.ownDashpot = term.isHeld
                         ? 0  // less is implicit than its mass says
                         : std::min(one.ownDashpot, term.stiffness.normal.dashpot / term.pair.effectiveMass);
    one.neighbours =
        std::min(one.neighbours, implicitNeighboursLimit(term.stiffness, term.pair.effectiveMass));
}

void ContactBounds::addTo(const ParticleStore& grains, const Term& term, std::uint32_t place,
                          std::uint32_t other) {
    const TranslationRecord& grain = grains.translation[place];
    if (grain.inverseMass == 0 || (!(term.gap < 0) && !term.drags)) return;
    if (isInBody(place)) return addToBody(grains, term, place, other);
    OfGrain& block = blocks[place];
    const ContactStiffness& s = term.stiffness;
    const double over = shareOf(grains, term, place, other) * grain.inverseMass;
    note(term, block);
    add(block.spring.shift, {over * s.normal.spring, over * s.sliding.spring}, term.normal, springUnit);
    add(block.dashpot.shift, {over * s.normal.dashpot, over * s.sliding.dashpot}, term.normal, dashpotUnit);
    if (!grains.hasSpin) return;
    block.relaxation = std::min(block.relaxation, s.shortestRelaxation());
    const double ownInertia = grains.rotation[place].inverseInertia;                     // 1/(kg m^2)
    const double lever2 = grain.radius * grain.radius * ownInertia / grain.inverseMass;  // 5/2 of a sphere
    const double arm = term.pair.bodies.effectiveRadius(),
                 turn = arm * arm *
                        (other == none ? (1 + weightAtWall(term)) * ownInertia
                                       : ownInertia + inverseInertia(grains, other));
    const double rim = over * lever2, cross = over * std::sqrt(lever2);
    add(block.spring.spin, {turn * s.torsion.spring, rim * s.sliding.spring + turn * s.rolling.spring},
        term.normal, springUnit);
    add(block.dashpot.spin, {turn * s.torsion.dashpot, rim * s.sliding.dashpot + turn * s.rolling.dashpot},
        term.normal, dashpotUnit);
    const double sign = place == term.first ? 1 : -1;  // the normal points away from the grain
    const auto couple = [&](Vector<double>& to, double size, double unit) {
        to += Vector<double>{inUnits(sign * size * term.normal.x, unit),
                             inUnits(sign * size * term.normal.y, unit),
                             inUnits(sign * size * term.normal.z, unit)};
    };
    couple(block.spring.coupling, cross * s.sliding.spring, springUnit);
    couple(block.dashpot.coupling, cross * s.sliding.dashpot, dashpotUnit);
}

void ContactBounds::addToBody(const ParticleStore& grains, const Term& term, std::uint32_t place,
                              std::uint32_t other) {
    OfBody& block = bodies[moverAt(place) - blocks.size()];
    note(term, block);
    const RigidBody& body = grains.bodies[moverAt(place) - blocks.size()];
    ContactStiffness s = term.stiffness;
    if (shapes) {
        const ShapedSide& side = sideOf(term, place);
        s.normal = side.normal * s.normal, s.sliding = side.sliding * s.sliding;
    }
    const double share = shareOf(grains, term, place, other);
    const Vector<double> toContact = armOf(grains, place, fromGrain(grains, term, place));
    const Vector<double> n = body.orientation.turnBack(term.normal),
                         arm = body.orientation.turnBack(toContact);
    const BodySlip slip(body, arm);
    const auto addPart = [&](BodyMatrix& to, double along, double across, double unit) {
        for (const Vector<double>& axis : axesOfSpace) addSquare(to, share * across, slip.along(axis), unit);
        addSquare(to, share * (along - across), slip.along(n), unit);
    };
    addPart(block.spring, s.normal.spring, s.sliding.spring, springUnit);
    addPart(block.dashpot, s.normal.dashpot, s.sliding.dashpot, dashpotUnit);
    if (!grains.hasSpin) return;
    block.relaxation = std::min(block.relaxation, s.shortestRelaxation());
    for (const Vector<double>& axis : axesOfSpace)
        addSquare(block.friction, share * s.sliding.spring, slip.turning(cross(arm, axis)), springUnit);
    addSquare(block.friction, -share * s.sliding.spring, slip.turning(cross(arm, n)), springUnit);
    const double ratio = other == none ? weightAtWall(term)
                                       : inverseInertia(grains, other) / inverseInertia(grains, place),
                 lever = term.pair.bodies.effectiveRadius(), turn = lever * lever * (1 + ratio);
    const auto addTurn = [&](BodyMatrix& to, double along, double across, double unit) {
        for (const Vector<double>& axis : axesOfSpace) addSquare(to, turn * across, slip.turning(axis), unit);
        addSquare(to, turn * (along - across), slip.turning(n), unit);
    };
    for (BodyMatrix* to : {&block.spring, &block.friction})
        addTurn(*to, s.torsion.spring, s.rolling.spring, springUnit);
    addTurn(block.dashpot, s.torsion.dashpot, s.rolling.dashpot, dashpotUnit);
}

double ContactBounds::largestOf(const GrainBlock& block, bool exact) {
    const double shift = largestEigenvalue(block.shift, exact), spin = largestEigenvalue(block.spin, exact),
                 between = norm(block.coupling);
    return 0.5 * (shift + spin + std::hypot(shift - spin, 2 * between));
}

double ContactBounds::largestOf(const BodyMatrix& block, bool exact) {
    Matrix6d matrix;
    std::size_t k = 0;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column <= row; ++column) matrix(row, column) = matrix(column, row) = block[k++];
    if (exact) return largestEigenvalueOf(matrix);
    // Wolkowicz and Styan, as for three rows: mean + sqrt(5) standard deviations.
    const double mean = matrix.trace() / 6;
    return mean + std::sqrt(std::max(5 * (matrix.squaredNorm() / 6 - mean * mean), 0.0));
}

template <class One>
double ContactBounds::stepOf(const One& one, const Integrator& integrator, bool exact) {
    const SignChange signChange(integrator);
    SpringAndDashpot mode{largestOf(one.spring, exact), largestOf(one.dashpot, exact)};
    if (!integrator.contacts.timesTouches) return signChange.limit(mode);
    if (integrator.contacts.implicitForces) mode.dashpot = std::max(mode.dashpot - one.ownDashpot, 0.0);
    double step = signChange.limit(mode);
    if (integrator.contacts.implicitForces) step = std::min(step, one.neighbours);
    if (integrator.contacts.springsInStep) return step;
    const double spin = springsInSpin(one, exact);
    if (spin > 0) step = std::min(step, springsAheadLimit(spin, one.relaxation, integrator));
    return step;
}

template void ContactBounds::note(const Term&, OfBody&);
template double ContactBounds::stepOf(const OfBody&, const Integrator&, bool);

}  // namespace pendular
