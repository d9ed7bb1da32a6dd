#include "Kernel/Features/GhostImages/GrainCopies.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

// Copies are kept from 1.1 of the distance at which grains act on each other, where they come, to 1.3 of it:
// one that has just gone is not made again at once, and none is missed by the motion of a step.
static constexpr double comesWithin = 1.1, staysWithin = 1.3;
static constexpr int mostWidths = 4;

std::span<const Conflict> GrainCopies::ownConflicts() const {
    static constexpr std::string_view single = "copies are made of single spheres",
                                      takeSpheres = "take single spheres",
                                      pushedTwice = "copies would push a wall that forces move, too";
    static constexpr std::array table{
        Conflict{Feature::OwnPart, Feature::RigidBodies, single, takeSpheres},
        Conflict{Feature::OwnPart, Feature::Superquadrics, single, takeSpheres},
        Conflict{Feature::OwnPart, Feature::MovingLiquid, "a copy would have a film of its own",
                 "take bridges of a fixed volume"},
        Conflict{
            Feature::OwnPart, Feature::EnergyLedger,
            "the account would take what moves the copies for an error of the step",
            "leave keepEnergyLedger() out; with MercuryScene.h call eneFile.setFileType(FileType::NO_FILE)"},
        Conflict{Feature::OwnPart, Feature::DrivenWalls, pushedTwice, "prescribe the motion of walls"},
        Conflict{Feature::OwnPart, Feature::Membranes, pushedTwice, "leave one of them out"},
        Conflict{Feature::OwnPart, Feature::WornWalls, "copies would wear a wall, too",
                 "leave one of them out"},
        Conflict{Feature::OwnPart, Feature::Shear, "the copies do not go with the flow",
                 "leave one of them out"},
        Conflict{Feature::OwnPart, Feature::Strain, "the copies do not go with the flow",
                 "leave one of them out"}};
    return table;
}

/// Throws InputError unless it has the length 1.
static void requireUnit(const char* which, const Vec3D& normal) {
    if (!(std::abs(normal.norm() - 1) <= 1e-9))
        throw InputError(
            fmt::format("copies of grains: the {} has the length {}; it must be 1.", which, normal.norm()));
}

void GrainCopies::add(Passage passage) {
    const auto refuse = [](const char* why) { throw InputError(fmt::format("copies of grains: {}.", why)); };
    for (const Vec3D& point : passage.points)
        if (!point.allFinite()) refuse("a point of the faces is not finite");
    if (passage.angle == 0) {
        if (!passage.shift || !passage.velocity) refuse("a function of the shift or its velocity is empty");
        const Vec3D shift = passage.shift(0);
        if (!shift.allFinite()) refuse("the shift is not finite");
        if (std::abs(shift.dot(passage.outwards[1])) > 1e-9 * passage.width)
            refuse("the shift has a part along the normal; it must be along the faces");
    }
    const auto isAlong = [&](const Passage& other) {
        return passage.outwards[1].cross(other.outwards[1]).norm() < 1e-9;
    };
    if (std::ranges::any_of(passages, isAlong)) refuse("there are faces with this normal already");
    if (passages.size() == Image().turns.size()) refuse("there are three pairs of faces already");
    if (!passages.empty() && (isFeeding() || passage.kind != Kind::Period))
        refuse(
            "a box that feeds a flow is the only pair of faces; make the others periodic by setPeriodic()");
    const auto axisOf = [](const Passage& p) { return p.outwards[0].cross(p.outwards[1]); };
    const auto mayNot = [&](const Passage& one, const Passage& two) {
        return one.angle > 0 && (two.angle > 0 || axisOf(one).cross(two.outwards[1]).norm() > 1e-9);
    };
    for (const Passage& other : passages)
        if (mayNot(passage, other) || mayNot(other, passage))
            refuse("beside faces that turn there can only be a period along their axis");
    passages.push_back(std::move(passage));
    isAwake = false;
}

static std::array<Vec3D, 2> pointsOf(const Vec3D& normal, double lowest, double highest) {
    requireUnit("normal", normal);
    checkValue("copies of grains", "higher face", highest, "m", {lowest, infinity, false, false});
    return {lowest * normal, highest * normal};
}

void GrainCopies::addPeriod(const Vec3D& normal, double lowest, double highest, const Vec3D& shift) {
    addPeriod(
        normal, lowest, highest, [shift](double) { return shift; },
        [](double) -> Vec3D { return Vec3D::Zero(); });
}

void GrainCopies::addPeriod(const Vec3D& normal, double lowest, double highest,
                            std::function<Vec3D(double)> shift, std::function<Vec3D(double)> velocity) {
    Passage passage{.outwards = {-normal, normal}, .points = pointsOf(normal, lowest, highest)};
    passage.width = highest - lowest;
    passage.shift = std::move(shift), passage.velocity = std::move(velocity);
    add(std::move(passage));
}

void GrainCopies::addMaser(const Vec3D& normal, double lowest, double highest, const Vec3D& shift,
                           double gap) {
    checkValue("copies of grains", "gap", gap, "m", notNegative);
    Passage passage{.kind = gap > 0 ? Kind::FeedingBeyondGap : Kind::Feeding,
                    .outwards = {-normal, normal},
                    .points = pointsOf(normal, lowest, highest)};
    passage.width = highest - lowest, passage.gap = gap;
    passage.shift = [shift](double) { return shift; };
    passage.velocity = [](double) -> Vec3D { return Vec3D::Zero(); };
    add(std::move(passage));
}

/// How often a wedge is turned until it is back where it was. Throws InputError where wedges of this angle
/// (rad) do not fill a turn: between the last and the first one there would be a gap, or they would overlap.
static int turnsToFull(double angle) {
    const double count = 2 * std::numbers::pi / angle, whole = std::round(count);
    if (std::abs(count - whole) < 1e-9 * count) return static_cast<int>(whole);
    constexpr double degree = std::numbers::pi / 180;
    const double fewer = std::max(std::floor(count), 3.0);
    throw InputError(fmt::format(
        "copies of grains: the angle between the faces is {:.10g} degrees, so that {:.10g} wedges "
        "fill a turn; "
        "it must be 360 degrees over a whole number: take {:.10g} or {:.10g} degrees.",
        angle / degree, count, 360 / (fewer + 1), 360 / fewer));
}

void GrainCopies::addTurn(const Vec3D& inwards, const Vec3D& outwards, const Vec3D& point) {
    requireUnit("first normal", inwards);
    requireUnit("second normal", outwards);
    const Vec3D axis = inwards.cross(outwards);
    const double angle = std::atan2(axis.norm(), inwards.dot(outwards));
    checkValue("copies of grains", "angle between the faces", angle, "rad",
               {1e-3, std::numbers::pi - 1e-3, true, true});
    static_cast<void>(turnsToFull(angle));
    Passage passage{.outwards = {-inwards, outwards}, .points = {point, point}};
    passage.angle = angle;
    passage.turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    add(std::move(passage));
}

void GrainCopies::addPower(Motion& to, const Passage& passage, int power, double time) const {
    if (power == 0) return;
    if (passage.angle == 0) {
        to.offset += power * (passage.width * passage.outwards[1] + passage.shift(time));
        to.velocity += power * passage.velocity(time);
        return;
    }
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    for (int k = 0; k < std::abs(power); ++k) turn *= power > 0 ? passage.turn : passage.turn.transpose();
    to = {turn * to.turn, passage.points[0] + turn * (to.offset - passage.points[0]), turn * to.velocity,
          true};
}

GrainCopies::Motion GrainCopies::motionOf(const Image& image, double time) const {
    Motion motion;
    for (std::size_t k = 0; k < passages.size(); ++k) addPower(motion, passages[k], image.turns[k], time);
    if (image.feeds) motion.offset += passages[0].gap * passages[0].outwards[1];
    return motion;
}

std::vector<GrainCopies::Image> GrainCopies::imagesWithin(double reach) const {
    if (isFeeding()) {
        const Image below{.turns = {-1, 0, 0}}, above{.turns = {1, 0, 0}}, behind{.feeds = true};
        if (passages[0].kind == Kind::Feeding) return {below};
        return {below, above, behind};
    }
    std::vector<Image> all{Image()};
    for (std::size_t k = 0; k < passages.size(); ++k) {
        const Passage& passage = passages[k];
        int least, most;
        if (passage.angle > 0) {
            const int full = turnsToFull(passage.angle);
            most = full / 2;
            least = most + 1 - full;
        } else {
            most = std::min(mostWidths, 1 + static_cast<int>(reach / passage.width));
            least = -most;
        }
        std::vector<Image> further;
        for (const Image& image : all)
            for (int turns = least; turns <= most; ++turns) {
                further.push_back(image);
                further.back().turns[k] = turns;
            }
        all = std::move(further);
    }
    std::erase(all, Image());
    return all;
}

bool GrainCopies::isNear(const Image& image, const Vec3D& own, const Vec3D& there, double reach) const {
    if (image.feeds) return passages[0].beyond(1, own) >= -reach;
    return std::ranges::all_of(passages, [&](const Passage& passage) {
        return passage.beyond(0, there) <= reach && passage.beyond(1, there) <= reach;
    });
}

/// A copy begins without what the contacts of its grain remember: only springs of friction can.
static bool remembersMoreThanSprings(const ContactLaws& laws) {
    if (laws.layout.normalHistory > 0) return true;
    const auto species = static_cast<int>(laws.speciesCount());
    for (int a = 0; a < species; ++a)
        for (int b = a; b < species; ++b)
            if (laws.ofPair(a, b).formsAtContact || laws.ofPair(a, b).resistsMotion) return true;
    return false;
}

/// Grains that the scene brings back would be at another distance from these faces at once. Throws
/// InputError.
void GrainCopies::refuseFacesAcross(const PeriodicBox& box) const {
    for (int axis = 0; axis < 3; ++axis)
        for (const Passage& passage : passages)
            for (const Vec3D& normal : passage.outwards)
                if (box.length.*vectorAxes[axis] > 0 && std::abs(normal[axis]) > 1e-9)
                    throw InputError(fmt::format(
                        "copies of grains: a face with the normal ({:.4g}, {:.4g}, {:.4g}) is not along {}, "
                        "along which the scene is periodic; leave setPeriodic() of that axis out, or take "
                        "faces "
                        "along it.",
                        normal.x(), normal.y(), normal.z(), "xyz"[axis]));
}

/// A grain that goes through a face is another one from then on. Throws InputError for columns, temperatures
/// among them.
void GrainCopies::refuseColumns(const StepContext& scene) {
    const auto refuse = [](const std::string& what, const char* call) {
        throw InputError(
            fmt::format("copies of grains: {}, of which a copy would have no number; leave {} out, or take "
                        "setPeriodic().",
                        what, call));
    };
    const std::vector<GrainColumn>& columns = scene.grains().columns;
    if (!columns.empty())
        refuse(fmt::format("grains have a column, '{}'", columns.front().name), "addColumn()");
    if (!scene.contacts.columns().empty()) refuse("contacts have columns", "addContactColumn()");
}

/// What a hook changes of a grain is not changed of its copies. Throws InputError.
void GrainCopies::takeOver(StepContext& scene, const SceneChanges& changes) {
    if (!changes.grains) return;
    const ParticleStore& grains = scene.grains();
    for (const auto& [copy, identity] : copies) {
        const std::uint32_t here = grains.place[identity], there = grains.place[copy];
        if (here == PlaceIndex::none || there == PlaceIndex::none) continue;
        const double radius = grains.translation[here].radius, ofCopy = grains.translation[there].radius;
        if (radius != ofCopy)
            throw InputError(fmt::format(
                "copies of grains: particle {} has the radius {:.6g} m, and its copy, particle {}, {:.6g} m; "
                "radii cannot change near faces of a scene with copies.",
                identity, radius, copy, ofCopy));
        if (grains.species[here] != grains.species[there])
            throw InputError(fmt::format(
                "copies of grains: particle {} has the species {}, and its copy, particle {}, {}; species "
                "cannot change near faces of a scene with copies.",
                identity, grains.species[here], copy, grains.species[there]));
    }
}

void GrainCopies::check(const StepContext& scene) {
    if (!passages.empty() && remembersMoreThanSprings(*scene.laws))
        throw InputError(
            "copies of grains: a law of this scene remembers more of a contact than springs of friction "
            "(bridges, cohesion with hysteresis, plastic overlaps), which copies would not have; take laws "
            "without.");
    for (const Passage& passage : passages)
        if (passage.angle == 0 && passage.width * (mostWidths - 1) < staysWithin * scene.largestReach)
            throw InputError(fmt::format(
                "copies of grains: the faces are {:.6g} m apart; it must be at least {:.6g} m, a third of "
                "the "
                "largest distance at which two grains of this scene act on each other, and a little more.",
                passage.width, staysWithin * scene.largestReach / (mostWidths - 1)));
    if (!passages.empty()) refuseColumns(scene);
    refuseFacesAcross(scene.box);
    // Copies behind the gap and those behind the box must not be in each other's way.
    if (isFeeding() && passages[0].gap > 0 && passages[0].gap < 2 * scene.largestReach)
        throw InputError(
            fmt::format("copies of grains: the gap is {:.6g} m; it must be at least {:.6g} m, twice "
                        "the largest distance at which two grains of this scene act on each other.",
                        passages[0].gap, 2 * scene.largestReach));
}

void GrainCopies::begin(StepContext& scene, bool isRestarted) {
    if (passages.empty()) return;
    if (scene.laws->turnGrains())
        scene.logger(
            LogLevel::Warn,
            "copies of grains: the springs of friction of two grains that touch begin anew where both go "
            "through a face.");
    if (!isRestarted) prepare(scene);
    isAwake = true;
}

void GrainCopies::prepare(StepContext& step) {
    if (isAwake) return;
    isAwake = true;
    renew(step, step.time);
}

void GrainCopies::follow(ParticleStore& grains, double time) const {
    std::map<Image, Motion> motions;
    for (const auto& [identity, own] : copiesOf)
        for (const auto& [image, copy] : own) {
            const std::uint32_t from = grains.place[identity], to = grains.place[copy];
            if (from == PlaceIndex::none || to == PlaceIndex::none) continue;
            auto known = motions.find(image);
            if (known == motions.end()) known = motions.emplace(image, motionOf(image, time)).first;
            const Motion& motion = known->second;
            const auto turned = [&](const Vector<double>& v) {
                return motion.turns ? toVector(motion.turn * toEigen(v)) : v;
            };
            TranslationRecord& there = grains.translation[to];
            there.position = toVector(placeOf(motion, toEigen(grains.translation[from].position)));
            there.velocity = turned(grains.translation[from].velocity) + toVector(motion.velocity);
            grains.acceleration[to] = turned(grains.acceleration[from]);
            if (grains.hasSpin) {
                grains.rotation[to].spin = turned(grains.rotation[from].spin);
                grains.rotation[to].angularAcceleration = turned(grains.rotation[from].angularAcceleration);
            }
            if (grains.remembersEarlier)
                grains.earlier[to] = {turned(grains.earlier[from].acceleration),
                                      turned(grains.earlier[from].angularAcceleration)};
        }
}

/// The grains in the box, as it feeds from now on.
void GrainCopies::adopt(StepContext& step) {
    if (!isFeeding() || std::exchange(hasMembers, true)) return;
    for (const GrainReference grain : step.particles)
        if (passages[0].beyond(0, grain.getPosition()) <= 0 &&
            passages[0].beyond(1, grain.getPosition()) <= 0)
            members.insert(grain.getId());
}

void GrainCopies::renew(StepContext& step, double time) {
    forgetGone(step);
    adopt(step);
    goThroughFaces(step, time);
    clearGap(step);
    makeCopies(step, time);
}

/// Grains that others have taken out. Throws RunError where a copy was: it would come and go in each step.
void GrainCopies::forgetGone(StepContext& step) {
    const auto isGone = [&](std::uint32_t identity) { return !step.particles.contains(identity); };
    std::erase_if(members, isGone);
    std::vector<std::uint32_t> alone;
    std::erase_if(copiesOf, [&](const auto& one) {
        const bool isGrainGone = isGone(one.first);
        for (const auto& [image, copy] : one.second)
            if (isGrainGone) alone.push_back(copy);
            else if (isGone(copy))
                throw RunError(
                    fmt::format("At time {:.6g} s particle {}, a copy of particle {}, was taken out; keep "
                                "outlets {:.6g} m away "
                                "from the faces, and remove the grain itself.",
                                step.time, copy, one.first, staysWithin * step.largestReach));
        return isGrainGone;
    });
    for (const std::uint32_t copy : alone) removeCopy(step, copy);
}

void GrainCopies::removeCopy(StepContext& step, std::uint32_t copy) {
    copies.erase(copy);
    if (step.particles.contains(copy)) step.particles.removeObject(copy);
}

void GrainCopies::goThroughFaces(StepContext& step, double time) {
    constexpr int mostRounds = 1000;  // of a grain that was put far beyond a face
    for (std::size_t k = 0; k < passages.size(); ++k) {
        const Passage& passage = passages[k];
        for (int round = 0; round < mostRounds; ++round) {
            std::vector<std::pair<std::uint32_t, int>> crossings;  // identities, faces
            for (const GrainReference grain : step.particles) {
                if (!repeats(grain.getId())) continue;
                for (int face = passage.kind == Kind::Feeding ? 1 : 0; face < 2; ++face)
                    if (passage.beyond(face, grain.getPosition()) > 0) {
                        crossings.emplace_back(grain.getId(), face);
                        break;
                    }
            }
            for (const auto& [identity, face] : crossings) goThrough(step, identity, k, face, time);
            if (crossings.empty()) break;
        }
    }
}

void GrainCopies::moveGrain(StepContext& step, std::uint32_t identity, const Motion& motion) {
    GrainReference grain = step.particles.getObject(identity);
    const bool isHeld = grain.isFixed();
    grain.setPosition(placeOf(motion, grain.getPosition()));
    if (isHeld) return;
    grain.setVelocity(motion.turn * grain.getVelocity() + motion.velocity);
    grain.setAngularVelocity(motion.turn * grain.getAngularVelocity());
}

/// The copy behind the other face is the grain from now on, and the grain is its copy.
void GrainCopies::goThrough(StepContext& step, std::uint32_t identity, std::size_t passage, int face,
                            double time) {
    const Passage& through = passages[passage];
    Image inside;
    inside.turns[passage] = face == 1 ? -1 : 1;
    CopiesOfOne own;
    if (const auto known = copiesOf.find(identity); known != copiesOf.end()) {
        own = std::move(known->second);
        copiesOf.erase(known);
    }
    const auto found = own.find(inside);
    if (found == own.end()) {  // one that was put beyond the face
        for (const auto& [image, copy] : own) removeCopy(step, copy);
        return moveGrain(step, identity, motionOf(inside, time));
    }
    const std::uint32_t now = found->second;
    own.erase(found);
    copies.erase(now);
    if (isFeeding()) members.erase(identity), members.insert(now);
    if (through.kind == Kind::Feeding) {
        ++fed;
        return;
    }
    const int full = through.angle > 0 ? turnsToFull(through.angle) : 0;
    CopiesOfOne& renewed = copiesOf[now];
    Image behind;
    behind.turns[passage] = -inside.turns[passage];
    renewed[behind] = identity, copies[identity] = now;
    for (const auto& [image, copy] : own) {
        if (image.feeds && face == 1) {
            stopCopying(copy);
            ++fed;
        } else if (image.feeds) {
            removeCopy(step, copy);
        } else {
            Image moved = image;
            moved.turns[passage] -= inside.turns[passage];
            if (full > 0 && moved.turns[passage] > full / 2) moved.turns[passage] -= full;
            if (full > 0 && moved.turns[passage] < full / 2 + 1 - full) moved.turns[passage] += full;
            renewed[moved] = copy, copies[copy] = now;
        }
    }
}

void GrainCopies::clearGap(StepContext& step) {
    if (!isFeeding() || passages[0].gap == 0) return;
    std::vector<std::uint32_t> back;
    for (const GrainReference grain : step.particles) {
        if (members.contains(grain.getId()) || isCopy(grain.getId())) continue;
        const double beyond = passages[0].beyond(1, grain.getPosition());
        // A grain that has just been fed is at its end.
        if (beyond > 0 && beyond < passages[0].gap * (1 - 1e-9)) back.push_back(grain.getId());
    }
    for (const std::uint32_t identity : back) step.particles.removeObject(identity);
}

void GrainCopies::makeCopies(StepContext& step, double time) {
    std::vector<std::pair<Image, Motion>> images;
    for (const Image& image : imagesWithin(comesWithin * step.largestReach))
        images.emplace_back(image, motionOf(image, time));
    std::vector<std::pair<std::uint32_t, Image>> coming;
    std::vector<std::pair<std::uint32_t, Image>> going;
    for (const GrainReference grain : step.particles) {
        const std::uint32_t identity = grain.getId();
        if (!repeats(identity)) continue;
        const auto known = copiesOf.find(identity);
        const Vec3D place = grain.getPosition();
        for (const auto& [image, motion] : images) {
            const bool isThere = known != copiesOf.end() && known->second.contains(image);
            const double reach = (isThere ? staysWithin : comesWithin) * step.largestReach;
            if (isNear(image, place, placeOf(motion, place), reach) == isThere) continue;
            (isThere ? going : coming).emplace_back(identity, image);
        }
    }
    // Those whose image is no longer one of these.
    for (const auto& [identity, own] : copiesOf)
        for (const auto& [image, copy] : own)
            if (std::ranges::find(images, image, &std::pair<Image, Motion>::first) == images.end())
                going.emplace_back(identity, image);
    for (const auto& [identity, image] : going) {
        CopiesOfOne& own = copiesOf[identity];
        removeCopy(step, own.at(image));
        own.erase(image);
    }
    for (const auto& [identity, image] : coming) makeOne(step, identity, image, time);
    std::erase_if(copiesOf, [](const auto& one) { return one.second.empty(); });
    follow(step.grains(), time);
}

namespace {

/// The species of a grain that is there, as setSpecies() takes it.
struct SpeciesOfGrain {
    int index;
    const SpeciesOwner* owner;
    [[nodiscard]] int getIndex() const { return index; }
    [[nodiscard]] const SpeciesOwner* getOwner() const { return owner; }
};

}  // namespace

bool GrainCopies::isCopyBy(const Image& image, std::uint32_t identity) const {
    const auto copy = copies.find(identity);
    if (copy == copies.end()) return false;
    const auto own = copiesOf.find(copy->second);
    if (own == copiesOf.end()) return false;
    const auto found = own->second.find(image);
    return found != own->second.end() && found->second == identity;
}

/// Behind the gap nobody is in the way while the flow goes on. Throws RunError where it does not. Copies by
/// the same image overlap as their grains do, which is no matter of room.
void GrainCopies::requireRoom(StepContext& step, std::uint32_t identity, const Image& image,
                              const SphericalParticle& copy, double time) const {
    constexpr double mostShare = 0.05;  // of the smaller radius, as at set-up
    for (const GrainReference other : step.particles) {
        const double overlap = copy.getRadius() + other.getRadius() -
                               norm(step.box.nearest(toVector(other.getPosition() - copy.getPosition())));
        if (overlap <= mostShare * std::min(copy.getRadius(), other.getRadius())) continue;
        if (isCopyBy(image, other.getId())) continue;
        throw RunError(fmt::format(
            "At time {:.6g} s there is no room behind the gap for what follows particle {} of the box that "
            "feeds: particle {} is there; a box with a gap feeds a flow that goes on, so drive it more "
            "strongly, or take one without a gap.",
            time, identity, other.getId()));
    }
}

void GrainCopies::makeOne(StepContext& step, std::uint32_t identity, const Image& image, double time) {
    const GrainReference grain = step.particles.getObject(identity);
    const SpeciesOfGrain species{grain.getSpeciesIndex(), step.laws->owner()};
    SphericalParticle copy(&species);
    copy.setRadius(grain.getRadius());
    copy.setPosition(placeOf(motionOf(image, time), grain.getPosition()));
    if (image.feeds) requireRoom(step, identity, image, copy, time);
    copy.setHeldAxes(grain.getHeldAxes());
    const std::uint32_t made = step.particles.copyAndAddObject(copy).getId();
    copiesOf[identity][image] = made;
    copies[made] = identity;
}

/// A shift that depends on the time is compared by its values at the start and now.
void GrainCopies::Passage::compareSetUp(StateArchive& archive, double now) const {
    const auto compare = [&](std::string_view name, const Vec3D& v, std::string_view unit) {
        archive.sameRecord<double>(name, toVector(v), unit);
    };
    constexpr std::array<std::string_view, 2> normals{"lowerNormal", "higherNormal"},
        places{"lowerPoint", "higherPoint"};
    for (const std::size_t face : {0u, 1u}) {
        compare(normals[face], outwards[face], "");
        compare(places[face], points[face], "m");
    }
    const auto compareFunction = [&](std::string_view name, const std::function<Vec3D(double)>& of,
                                     std::string_view unit) {
        const Vec3D first = of(0), last = of(now);
        archive.sameValues(name, {first.x(), first.y(), first.z(), last.x(), last.y(), last.z()}, unit);
    };
    if (angle == 0) compareFunction("shift", shift, "m"), compareFunction("velocity", velocity, "m/s");
    archive.same("angle", angle, "rad");
    archive.same("gap", gap, "m");
    archive.same("kind", static_cast<int>(kind));
}

void GrainCopies::compareSetUp(StateArchive& archive, StepContext& scene) {
    archive.same("count", static_cast<std::uint64_t>(passages.size()));
    for (std::size_t k = 0; k < passages.size(); ++k)
        archive.group(fmt::format("faces{}", k), [&] { passages[k].compareSetUp(archive, scene.time); });
}

void GrainCopies::visitState(StateArchive& archive, StepContext& /*scene*/) {
    std::vector<std::uint32_t> grains, ofGrains, inBox(members.begin(), members.end());
    std::vector<std::int32_t> turns, feeds;
    for (const auto& [identity, own] : copiesOf)
        for (const auto& [image, copy] : own) {
            grains.push_back(identity), ofGrains.push_back(copy), feeds.push_back(image.feeds ? 1 : 0);
            turns.insert(turns.end(), image.turns.begin(), image.turns.end());
        }
    archive.column<std::uint32_t>("grains", grains);
    archive.column<std::uint32_t>("copies", ofGrains);
    archive.column<std::int32_t>("turns", turns);
    archive.column<std::int32_t>("feeds", feeds);
    archive.column<std::uint32_t>("members", inBox);
    archive.value("hasMembers", hasMembers);
    archive.value("fed", fed);
    if (!archive.isReading()) return;
    archive.require(ofGrains.size() == grains.size() && feeds.size() == grains.size() &&
                        turns.size() == Image().turns.size() * grains.size(),
                    "copies", "do not fit the grains");
    copiesOf.clear(), copies.clear();
    members = {inBox.begin(), inBox.end()};
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const Image image{{turns[3 * k], turns[3 * k + 1], turns[3 * k + 2]}, feeds[k] != 0};
        copiesOf[grains[k]][image] = ofGrains[k];
        copies[ofGrains[k]] = grains[k];
    }
    archive.require(copies.size() == grains.size(), "copies", "has a copy of two grains");
}

void GrainCopies::addTo(SummaryRows& rows) const {
    rows.add("copies of grains at the end", copies.size());
    if (isFeeding()) rows.add("grains that have gone from the box into the flow", fed);
}

}  // namespace pendular
