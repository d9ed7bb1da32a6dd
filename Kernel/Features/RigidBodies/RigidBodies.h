#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "Kernel/Core/Particles/HeldAxes.h"
#include "Kernel/Features/RigidBodies/ContactsAround.h"
#include "Kernel/Foundation/Math/Four.h"
#include "Kernel/Foundation/Math/Quaternion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

class ParticleStore;

/// A rigid body made of grains: one mass, one motion. Three cache lines, of which eight bodies are read and
/// transposed at once.
struct alignas(64) RigidBody {
    double mass = 0;                          // kg
    Vector<double> inertia{0, 0, 0};          // kg m^2, about the principal axes
    Vector<double> position{0, 0, 0};         // m, of the centre of mass
    Vector<double> velocity{0, 0, 0};         // m/s, of it
    Vector<double> acceleration{0, 0, 0};     // m/s^2, of the last step, by all forces: see heldAxesOf()
    Vector<double> angularMomentum{0, 0, 0};  // kg m^2/s, about the centre of mass
    Vector<double> torque{0, 0, 0};           // N m, of the last step, by all contacts
    Quaternion orientation{};                 // turns the principal axes into space
    double largestFreeMass = 0;               // kg, of its largest grain, were that a free sphere

    /// rad/s
    [[nodiscard]] Vector<double> spin() const { return spinOf(Axes(orientation), inertia, angularMomentum); }
    template <Number T>
    static Vector<T> spinOf(const Axes<T>& axes, const Vector<T>& inertia, const Vector<T>& momentum) {
        const Vector<T> l = axes.turnBack(momentum);
        return axes.turn({l.x / inertia.x, l.y / inertia.y, l.z / inertia.z});
    }
    void setSpin(const Vector<double>& spin) {
        const Vector<double> w = orientation.turnBack(spin);
        angularMomentum = orientation.turn({inertia.x * w.x, inertia.y * w.y, inertia.z * w.z});
    }
    /// J, of the turning
    [[nodiscard]] double rotationalEnergy() const { return 0.5 * dot(spin(), angularMomentum); }
};
static_assert(sizeof(RigidBody) == 24 * sizeof(double));

/// rad/s: what an angular momentum about the axes about which a body is free and a spin about the others make
/// of its spin: I_ff w_f = L_f - I_fh w_h. @param heldSpin rad/s, zero about free axes
[[nodiscard]] Vector<double> spinOfHeld(const Vector<double>& inertia, const Quaternion& orientation,
                                        HeldBits axes, const Vector<double>& momentum,
                                        const Vector<double>& heldSpin);

/// What moved a body in the step before the last, for integrators that remember it.
struct EarlierBodyMotion {
    Vector<double> acceleration{0, 0, 0};  // m/s^2
    Vector<double> torque{0, 0, 0};        // N m
};

/// The axes along and about which a body is held, and its spin about these.
struct HeldBody {
    HeldBits axes;
    Vector<double> spin{0, 0, 0};  // rad/s; zero about axes about which it is free
};

/// A body without the films of its grains, where these have a mass.
struct DryBody {
    double mass = 0;                  // kg
    Vector<double> inertia{0, 0, 0};  // kg m^2, about its own principal axes
    Vector<double> centre{0, 0, 0};   // m, of the body with films, from its own, in its own axes
    Quaternion axes{};                // turns the principal axes of the body with films into its own
};

/// A grain of a rigid body.
struct BodyMember {
    std::uint32_t grain;  // identity
    Vector<double> arm;   // m, from the centre of mass, in the principal axes
    double exposed = 1;   // share of its surface that is in no other grain of the body
};

/// What the motion of a body needs of one of its grains.
struct alignas(32) MemberInSpace {
    Vector<double> arm;   // m, as of BodyMember
    std::uint32_t place;  // of the grain
};

/// The rigid bodies of a scene. Their grains are in the store like all others, with the mass of their body,
/// so that contacts, walls and outputs see nothing new; but they move with the body, and their forces are
/// summed for it. A grain that is in none is its own body, and a scene without rigid bodies pays nothing.
///
/// Where a scene is shared by ranks, there are the bodies of this rank, and behind them copies (ghosts) of
/// those of other ranks of which a grain may touch one of its own; all of their grains are ghosts here.
class RigidBodies {
public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// No ghosts either.
    [[nodiscard]] bool empty() const { return bodies.empty(); }
    [[nodiscard]] std::size_t size() const { return bodies.size() - ghosts; }
    [[nodiscard]] std::size_t sizeWithGhosts() const { return bodies.size(); }
    [[nodiscard]] RigidBody& operator[](std::size_t at) { return bodies[at]; }
    [[nodiscard]] const RigidBody& operator[](std::size_t at) const { return bodies[at]; }
    /// The grains of a body, in the order in which they were joined.
    [[nodiscard]] std::span<const BodyMember> membersOf(std::size_t at) const {
        return {members.data() + begins[at], members.data() + begins[at + 1]};
    }
    /// The place of the body with this number; `none` if there is no such body.
    [[nodiscard]] std::uint32_t find(std::size_t number) const;
    [[nodiscard]] std::uint32_t numberOf(std::size_t at) const { return numbers[at]; }
    /// The number of the body that a grain is part of, or `none`.
    [[nodiscard]] std::uint32_t bodyOf(std::uint32_t grain) const {
        if (empty()) return none;
        const auto found = bodyOfGrain.find(grain);
        return found == bodyOfGrain.end() ? none : found->second;
    }
    /// The place of the body of the grain at a place, or `none`.
    [[nodiscard]] std::uint32_t at(std::uint32_t place) const {
        return place < bodyAt.size() ? bodyAt[place] : none;
    }
    /// Whether the grains at two places are of one body.
    [[nodiscard]] bool areJoinedAt(std::uint32_t a, std::uint32_t b) const {
        return !empty() && at(a) != none && at(a) == at(b);
    }
    [[nodiscard]] bool contains(std::uint32_t grain) const { return !empty() && bodyOf(grain) != none; }
    /// Whether two grains are of one body: then they do not touch each other.
    [[nodiscard]] bool areJoined(std::uint32_t a, std::uint32_t b) const {
        return !empty() && bodyOf(a) != none && bodyOf(a) == bodyOf(b);
    }

    /// m^3, of the solid that its grains stand for, overlaps counted once.
    [[nodiscard]] double volumeOf(std::size_t at) const { return volumes[at]; }
    /// Turns the shape of a body as it was given into space; its principal axes are bodies[at].orientation.
    [[nodiscard]] Quaternion orientationOf(std::size_t at) const;
    /// m, of the grain at each place: from the centre of mass of its body to its own centre, in space; zeros
    /// for grains in none. Empty without bodies.
    [[nodiscard]] std::vector<Vector<double>> armsInSpace(const ParticleStore& grains) const;
    /// The share of a grain's surface that is in no other grain of its body; 1 of a grain in none.
    [[nodiscard]] double exposedShareOf(std::uint32_t grain) const;

    /// Along and about which axes a body is held.
    [[nodiscard]] HeldBits heldAxesOf(std::size_t at) const {
        return held.empty() ? HeldBits() : held[at].axes;
    }
    [[nodiscard]] bool areSomeHeld() const { return !held.empty(); }
    /// Whether it is held altogether: then its grains are held, too.
    [[nodiscard]] bool isHeld(std::size_t at) const { return heldAxesOf(at).areAll(); }
    /// Holds a body along and about these axes. It keeps its motion about and along the others, and has none
    /// in these.
    void hold(ParticleStore& grains, std::size_t at, HeldBits axes);
    /// rad/s; exactly what was given about axes about which it is held
    [[nodiscard]] Vector<double> spinOf(std::size_t at) const;
    /// Turns the body at a spin (rad/s) from now on, also about axes about which it is held.
    void setSpin(std::size_t at, const Vector<double>& spin);
    /// rad/s: the spin that a body has in an orientation by the angular momentum about its free axes and the
    /// spin about the others.
    [[nodiscard]] Vector<double> spinIn(std::size_t at, const Quaternion& orientation,
                                        const Vector<double>& momentum) const;
    /// The angular momentum about axes about which a body is held follows from its spin; returns this.
    Vector<double> constrain(std::size_t at);
    /// What a body keeps of the step before the last; empty unless the integrator needs it.
    std::vector<EarlierBodyMotion> earlier;
    /// At the start of a run there is no step before the first.
    void startEarlier(bool remembers);

    /// kg, without films
    [[nodiscard]] double dryMassOf(std::size_t at) const {
        return dry.empty() ? bodies[at].mass : dry[at].mass;
    }
    /// The films of a body's grains, each a thin shell about the centre of its sphere, have a mass: mass,
    /// centre and moments follow. Each point keeps its velocity, and forces stay.
    /// @param films kg, of each grain of the body; @param gravity m/s^2, part of the acceleration
    void weigh(ParticleStore& grains, std::size_t at, std::span<const double> films,
               const Vector<double>& gravity);

    /// Returns the number of the new body: in the order of adding; no number is given twice.
    /// @param volume m^3, as of volumeOf()
    /// @param frame turns its principal axes into the frame in which its shape is given
    std::uint32_t add(const RigidBody& body, std::span<const BodyMember> grains, double volume,
                      const Quaternion& frame = {});
    /// Removes the body at a place, not its grains.
    void remove(std::size_t at);

    /// Keeps the bodies at these places only, and no ghosts.
    void keepOnly(std::span<const std::uint32_t> places);
    /// Calls write(value) for all that is kept of the body at a place.
    template <class Function>
    void writeRow(std::size_t at, Function&& write) const {
        write(numbers[at]), write(begins[at + 1] - begins[at]), write(bodies[at]), write(volumes[at]);
        write(frames[at]);
        writeOne(held, at, write), writeOne(earlier, at, write), writeOne(dry, at, write);
        for (std::uint32_t m = begins[at]; m < begins[at + 1]; ++m) {
            write(members[m]);
            if (!dry.empty()) write(dryArms[m]), write(films[m]);
        }
    }
    /// Adds a body, or the ghost of one, of which take(value) takes what writeRow() wrote; sort() then.
    template <class Function>
    void takeRow(Function&& take, bool isGhost) {
        std::uint32_t count = 0;
        take(numbers.emplace_back()), take(count), take(bodies.emplace_back()), take(volumes.emplace_back());
        take(frames.emplace_back()), around.emplace_back();
        takeOne(held, take), takeOne(earlier, take), takeOne(dry, take);
        for (; count > 0; --count) {
            take(members.emplace_back());
            bodyOfGrain[members.back().grain] = numbers.back();
            if (!dry.empty()) take(dryArms.emplace_back()), take(films.emplace_back());
        }
        begins.push_back(static_cast<std::uint32_t>(members.size()));
        ghosts += isGhost ? 1 : 0;
    }
    /// After rows have come, first those of bodies and then those of ghosts: both are in the order of their
    /// numbers.
    void sort();

    /// Gives the grains of a body the mass, the places and the velocities that they have in it.
    void place(ParticleStore& grains, std::size_t at);
    /// Places the grains of all bodies but spheres, whose grains move by themselves and keep their bits.
    void placeAll(ParticleStore& grains);
    /// The body of a sphere takes over the motion of its grain.
    void follow(const ParticleStore& grains, std::size_t at);
    /// Whether a body is a solid sphere: one grain about its centre, with the moment 2/5 m r^2 to the bit.
    [[nodiscard]] bool isSphere(const ParticleStore& grains, std::size_t at) const;

    /// kg, for which each grain of a body stands: as much as its free sphere has of all of theirs.
    /// @param massOfSphere kg, by identity
    template <class Function>
    [[nodiscard]] std::vector<double> sharesOfMass(std::size_t at, Function&& massOfSphere) const {
        std::vector<double> shares;
        double sum = 0;
        for (const BodyMember& grain : membersOf(at)) sum += shares.emplace_back(massOfSphere(grain.grain));
        for (double& share : shares) share = bodies[at].mass * (share / sum);
        return shares;
    }

    /// By how much its contacts can move the body at a place, for the stability limit; found once for each
    /// body. (Without the mass of films: with it, contacts move a body less.)
    [[nodiscard]] const ContactsAround& contactsAt(const ParticleStore& grains, std::size_t at) const;
    /// Whether the body at a place is a block (Kernel/Features/Superquadrics): its grains are a core, eight
    /// corners and twelve edges, and its largestFreeMass is negative.
    [[nodiscard]] bool isBlock(std::size_t at) const { return bodies[at].largestFreeMass < 0; }

    /// Puts the grains of a body behind each other, at the first of them.
    /// @param places of all grains, in an order in space
    void keepTogether(const ParticleStore& grains, std::vector<std::uint32_t>& places) const;
    /// Finds the grains where they are now: after each change of places, before the calls below.
    void refresh(const ParticleStore& grains);
    void forgetPlaces() { placesAreKnown = false; }
    /// The places of bodies, in the order of their first grains in the store; without bodies that move as
    /// their only grain, and those that are held.
    [[nodiscard]] const std::vector<std::uint32_t>& inSpace() const { return order; }
    /// The grains of the bodies of inSpace(), body by body.
    [[nodiscard]] const std::vector<MemberInSpace>& membersInSpace() const { return inOrder; }
    /// The place in membersInSpace() at which the grains of the body at a place of inSpace() begin; those of
    /// the next one follow.
    [[nodiscard]] std::uint32_t firstInSpace(std::size_t k) const { return firsts[k]; }
    /// The bodies that isSphere() is true of: they move as their grain does, bit for bit.
    [[nodiscard]] const std::vector<std::uint32_t>& spheres() const { return spheresOnly; }
    /// All others that are held along or about some axis.
    [[nodiscard]] const std::vector<std::uint32_t>& heldOnes() const { return heldOnly; }
    /// The places of all grains that move by themselves, or are held, or are the sphere of a body.
    [[nodiscard]] const std::vector<std::uint32_t>& ownPlaces() const { return own; }

    void visitState(StateArchive& archive, const ParticleStore& grains);

private:
    template <class Value, class Function>
    static void writeOne(const std::vector<Value>& column, std::size_t at, Function& write) {
        write(!column.empty());
        if (!column.empty()) write(column[at]);
    }
    /// A column that is empty here may have rows on other ranks.
    template <class Value, class Function>
    void takeOne(std::vector<Value>& column, Function& take) const {
        bool isThere = false;
        take(isThere);
        if (!isThere && column.empty()) return;
        column.resize(bodies.size());
        if (isThere) take(column.back());
    }
    /// Puts the body at order[k] to place k; those that are not in the order go.
    void reorder(std::span<const std::uint32_t> order);
    void visitHeld(StateArchive& archive);
    void visitDry(StateArchive& archive);
    void requireWhole(const StateArchive& archive, const ParticleStore& grains) const;
    void measureAll(const ParticleStore& grains);
    /// The body of the grain at each place; `none` for one in no body.
    [[nodiscard]] std::vector<std::uint32_t> bodiesAt(const ParticleStore& grains) const;
    [[nodiscard]] ContactsAround findContacts(const ParticleStore& grains, std::size_t at) const;
    /// The spheres of a body without films, in its principal axes.
    [[nodiscard]] std::vector<SphereOfBody> spheresOf(const ParticleStore& grains, std::size_t at) const;
    /// Whether two bodies have one shape, whatever their sizes: to 1e-9, so that contactsAt() of one is that
    /// of the other.
    [[nodiscard]] bool haveOneShape(const ParticleStore& grains, std::size_t a, std::size_t b) const;
    /// kg: a body of one grain moves at a contact as a free sphere of this mass would.
    [[nodiscard]] double massAtContacts(const ParticleStore& grains, std::size_t at) const;

    std::size_t ghosts = 0;  // the last bodies
    std::vector<RigidBody> bodies;
    std::vector<double> volumes;                                // m^3, of each
    std::vector<Quaternion> frames;                             // of each without films: see add()
    mutable std::vector<std::optional<ContactsAround>> around;  // of each, once they were asked for
    mutable std::vector<std::size_t> shapes;                    // places in `around` of a few unlike bodies
    std::vector<HeldBody> held;                                 // of each; empty while none is held
    std::vector<DryBody> dry;                                   // of each; empty while films have no mass
    std::vector<Vector<double>> dryArms;  // m, of each of `members`, in its dry body; empty as `dry`
    std::vector<double> films;            // kg, of each of `members`; empty as `dry`
    std::vector<std::uint32_t> numbers;   // of each; they grow
    std::vector<std::uint32_t> begins{0};
    std::vector<BodyMember> members;
    std::vector<MemberInSpace> inOrder;  // of the bodies in `order`, body by body
    bool placesAreKnown = false;
    std::vector<std::uint32_t> firsts;  // of each body in `order`, and one more
    std::vector<std::uint32_t> bodyAt, order, spheresOnly, heldOnly, own;
    std::unordered_map<std::uint32_t, std::uint32_t> bodyOfGrain;
    std::uint32_t next = 0;
};

}  // namespace pendular
