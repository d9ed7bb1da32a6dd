#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/AdaptiveTimeStep/MovedWall.h"

namespace pendular {

/// How contacts are taken: as they are, or as they may become.
struct ContactOutlook {
    double time = 0;          // s, for which they may come nearer to each other
    double falling = 0;       // m/s, that a pair may approach faster than it does now
    double reach = 0;         // m, of surfaces that may come to touch; they must be listed
    double margin = 1;        // on the overlaps that they reach in that time by themselves
    double leastOverlap = 0;  // of the smaller radius, of contacts that touch
    bool sticking = true;     // friction; else it has no springs
};

/// A step that is stable for the contacts that there are, and the grain that bounds it.
struct ContactBound {
    double step = infinity;  // s
    std::uint32_t grain = 0;
    int wall = -1;  // that bounds it: the grain is one that touches it, and the next two are of the wall
    std::size_t contactsOfGrain = 0;  // that touch, or may come to
    double overlapOfGrain = 0;        // the largest, of the smaller radius
    double supposedOverlap = 0;       // of the effective radius, the largest with the margin
    double largestOverlap = 0;        // of all contacts that touch, of the smaller radius
    double meanOverlap = 0;
    std::size_t touching = 0;  // contacts
};

/// The largest eigenvalue of a symmetric matrix (xx yy zz xy xz yz), from above.
/// @param exact to 1e-6; else up to 1.5 times as large
[[nodiscard]] double largestEigenvalue(const std::array<double, 6>& matrix, bool exact = true);

/// The largest stable step of the contacts of a scene: of each grain the highest frequency that its own
/// contacts can give it, with their stiffness at their overlaps, their directions and what friction does to
/// the spin.
///
/// Source of the bound: the work of a contact against the motion (v, w) of its grains,
/// k |s1 - s2|^2 with s1 = n.v1 or, across, (1 - n n)(v1 + r1 w1 x n), is at most
/// k (1 + t) |s1|^2 + k (1 + 1/t) |s2|^2 with any t > 0 (Cauchy and Schwarz), so that the stiffness matrix of
/// the bed is at most one of blocks of 6 x 6, one for each grain, and the squared frequency of the bed at
/// most the largest eigenvalue of these over mass and moment of inertia. (These are the circles of Gershgorin
/// by grains; by rows of the same matrix they forget the directions of contacts, and give three times as much
/// in a dense bed.) t is the load of grain 2 over that of grain 1, the sum of k/m over its contacts: equal
/// grains share alike, and a large grain among small ones does not take what is theirs. A wall that
/// is held, or a grain, has no block and leaves its partner k alone. Of a block, the eigenvalues of the parts
/// of shift and spin are exact, and their coupling is bounded by its norm. The same for dashpots.
///
/// A rigid body has one block, to which the contacts of all its grains add: with the arm a from its centre of
/// mass to a contact, s1 = n.(v + w x a) or, across, (1 - n n)(v + w x a). Its eigenvalues are exact.
///
/// A wall that forces move (a piston, a slider, a rotor, a free body) has one block by the same inequality,
/// to which all of its contacts add, for the motions that it has: with the arm a from its centre, as of a
/// rigid body. The vertices of a membrane have one each: with the weights w of a contact, which sum to 1,
/// |sum w v|^2 <= sum w |v|^2, beside the bound of the net itself (MembraneNet::squaredFrequency). Of their
/// dashpots nothing is implicit, because contacts take the mass of the grain alone for that. A grain that is
/// held along all axes has no block, so that such a wall has the whole k of their contact (t infinite). A
/// servo has no mass, and a speed of its own (Kernel/Features/Servos/Servo.h).
///
/// Of grains that are no spheres (GrainShapes), contacts are where they touch, and have the radius that they
/// have there. Where they may be by the next choice is not known: a small turn brings the contact of a flat
/// face from its middle to its rim. So with a time ahead each is taken with the largest radius of the two,
/// and as much stiffer as a force elsewhere on the surface moves the body more easily.
///
/// The stiffness of friction is that of contacts that stick. What turns the normal forces (F/d of each) is
/// left out: a thousandth.
///
/// Sums are exact, in units of 2^-40 of the largest term, so that no bit depends on the order of the list.
class ContactBounds {
public:
    /// A symmetric matrix of shift and spin in the principal axes of a rigid body, by rows of its lower half.
    using BodyMatrix = std::array<double, 21>;

    [[nodiscard]] ContactBound find(const ContactSystem& contacts, const WallHandler& walls,
                                    const ParticleStore& grains, const Integrator& integrator,
                                    const ContactOutlook& outlook = {});

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// The springs (1/s^2) or dashpots (1/s) of a grain, over its mass and moment of inertia.
    struct GrainBlock {
        std::array<double, 6> shift{}, spin{};  // xx yy zz xy xz yz
        Vector<double> coupling{0, 0, 0};       // is the vector product with this
    };
    struct Term {
        std::uint32_t first, second;  // places; second: none at a wall
        Vector<double> normal;
        PressedPair pair{};
        ContactStiffness stiffness{};
        double gap = 0;             // m
        double reached = 0;         // m, overlap
        double approach = 0;        // m/s
        double smallerRadius = 0;   // m
        bool drags = false;         // a bridge
        bool isHeld = false;        // one of the grains, along some axes
        bool isFixed = false;       // the grain at a wall that forces move, along all axes
        std::uint32_t side = none;  // of wallSides, at a wall that forces move
    };
    /// The side of such a wall in a contact.
    struct WallSide {
        std::uint32_t wall;          // of movedWalls
        Vector<double> arm;          // m, from the wall's centre
        std::uint32_t triangle = 0;  // of a membrane
        std::array<double, 3> weights{};
        double spring = 0, dashpot = 0;  // 1/s^2, 1/s: in all directions together, over the wall's mass
        double load = 0;  // 1/s^2, of the wall there by all of its contacts; 0: it does not move
    };
    /// A side of a contact of grains that are no spheres.
    struct ShapedSide {
        Vector<double> arm{0, 0, 0};     // m, from the grain's centre
        double normal = 1, sliding = 1;  // so many times more easily a force moves it elsewhere, at most
    };
    struct ShapedTerm {
        ShapedSide first, second;
        double largestRadius = 0;  // m, effective
    };
    template <class Block>
    struct OfOne {
        Block spring{}, dashpot{};
        double ownDashpot = infinity;  // 1/s, the least that one of its contacts makes implicit
        double neighbours = infinity;  // s, the least of implicitNeighboursLimit() of its contacts
        double relaxation = infinity;  // s, of the least damped spring of friction
        double overlap = 0;            // of the smaller radius
        std::size_t contacts = 0;
    };
    using OfGrain = OfOne<GrainBlock>;
    struct OfBody : OfOne<BodyMatrix> {
        BodyMatrix friction{};  // the part of friction's springs in the spin
    };
    struct MovedWall {
        int number;
        WallMotions motions{};       // of one that is no membrane
        PressedVertices vertices{};  // of a membrane
        OfBody block{};
        double load = 0;  // 1/s^2, of all contacts
    };

    void take(const ContactSystem& contacts, const WallHandler& walls, const ParticleStore& grains,
              const Bucket& bucket, const ContactOutlook& outlook);
    void takePair(const ContactSystem& contacts, const ParticleStore& grains, const Bucket& bucket,
                  std::size_t contact, const ContactOutlook& outlook);
    /// @param begin, end contacts of one grain with parts of the wall
    void takeShapeAtWall(const ContactSystem& contacts, const Wall& wall, const ParticleStore& grains,
                         const Bucket& bucket, std::size_t begin, const ContactOutlook& outlook);
    void takeAtWall(const ContactSystem& contacts, const Wall& wall, const ParticleStore& grains,
                    const Bucket& bucket, std::size_t begin, std::size_t end, const ContactOutlook& outlook);
    void keep(const ContactSystem& contacts, const Bucket& bucket, std::size_t contact, Term& term,
              const ContactOutlook& outlook, const ShapedTerm* ofShapes = nullptr);
    /// Makes a contact of the spheres around two grains that of their shapes, or of one with a plane.
    /// @param shift m, centre 2 - centre 1; @param velocity m/s, of 1 against 2, or the wall where it touches
    [[nodiscard]] ShapedTerm takeShapes(const ParticleStore& grains, const ShapedTouch& touch,
                                        const Vector<double>& shift, const Vector<double>& velocity,
                                        const ContactOutlook& outlook, Term& term) const;
    /// Of a grain that is held along all axes, at a wall that forces move: the mass that its dashpots have.
    void setFixed(const ContactSystem& contacts, const ParticleStore& grains, Term& term);
    [[nodiscard]] ShapedSide sideOf(const ParticleStore& grains, std::uint32_t place,
                                    const Vector<double>& arm, const Vector<double>& normal,
                                    const ContactOutlook& outlook) const;
    [[nodiscard]] const ShapedSide& sideOf(const Term& term, std::uint32_t place) const {
        const ShapedTerm& both = shaped[static_cast<std::size_t>(&term - terms.data())];
        return place == term.first ? both.first : both.second;
    }
    /// m: what a pair that touches, or may come to, can reach by its own approach.
    [[nodiscard]] static double reachedOverlap(const ContactLaws& laws, const Bucket& bucket,
                                               const Term& term, const ContactOutlook& outlook);
    static void press(const ContactLaws& laws, const Bucket& bucket, std::span<Term> ofBucket,
                      const ContactOutlook& outlook, double mean);
    void summarise(ContactBound& found, const ParticleStore& grains, const AllRanks& ranks) const;
    /// The grain of all ranks that bounds the step.
    static void takeLeastOfRanks(ContactBound& found, const AllRanks& ranks);
    void findBodies(const ParticleStore& grains);
    static void holdBlock(HeldBits held, OfGrain& of);
    void chooseWeights(const ContactSystem& contacts, const ParticleStore& grains);
    /// Where the load of the grain at a place is, or of the body that it is part of.
    [[nodiscard]] std::uint32_t moverAt(std::uint32_t place) const {
        return movers.empty() ? place : movers[place];
    }
    [[nodiscard]] bool isInBody(std::uint32_t place) const { return moverAt(place) >= blocks.size(); }
    /// m, from the centre of mass of the body to a point.
    /// @param fromGrain m, from the grain's centre to it
    [[nodiscard]] Vector<double> armOf(const ParticleStore& grains, std::uint32_t place,
                                       const Vector<double>& fromGrain) const;
    /// m, from the grain's centre to the contact.
    [[nodiscard]] Vector<double> fromGrain(const ParticleStore& grains, const Term& term,
                                           std::uint32_t place) const;
    /// 1/kg: how easily a force along the normal moves it there.
    [[nodiscard]] double mobility(const ParticleStore& grains, const Term& term, std::uint32_t place) const;
    [[nodiscard]] double inverseInertia(const ParticleStore& grains, std::uint32_t place) const;
    /// The weight t of the grain at a place in a contact with another one.
    [[nodiscard]] double weight(std::uint32_t place, std::uint32_t other) const {
        const double own = loads[moverAt(place)], others = loads[moverAt(other)];
        return own > 0 && others > 0 ? others / own : 1;
    }
    /// What the grain at a place takes of the contact: 1 + t.
    [[nodiscard]] double shareOf(const ParticleStore& grains, const Term& term, std::uint32_t place,
                                 std::uint32_t other) const;
    // Of walls that forces move (ContactBoundOfWalls.cpp):
    void findMovedWalls(const WallHandler& walls);
    [[nodiscard]] bool isMoved(int wall) const;
    /// @param fromGrain m, from the grain's centre to the contact
    void takeSide(const Wall& wall, int number, std::uint32_t part, const Vector<double>& position,
                  const Vector<double>& fromGrain, Term& term);
    void chooseWeightsOfWalls(const ParticleStore& grains, const AllRanks& ranks);
    [[nodiscard]] double largestLoadOfWalls() const;
    /// The weight of the grain in a contact with such a wall; 0 where the contact does not move the wall, and
    /// infinite where it does not move the grain.
    [[nodiscard]] double weightAtWall(const Term& term) const;
    void addToWall(const Term& term);
    void addToVertices(const WallSide& side, const ContactStiffness& stiffness, double share);
    void takeLeastOfWalls(const ParticleStore& grains, const Integrator& integrator, const AllRanks& ranks,
                          ContactBound& found);

    void addTo(const ParticleStore& grains, const Term& term, std::uint32_t place, std::uint32_t other);
    void addToBody(const ParticleStore& grains, const Term& term, std::uint32_t place, std::uint32_t other);
    /// What grain and body take note of in the same way.
    template <class One>
    static void note(const Term& term, One& one);
    /// The largest eigenvalue; not exact: at least that.
    [[nodiscard]] static double largestOf(const GrainBlock& block, bool exact);
    [[nodiscard]] static double largestOf(const BodyMatrix& block, bool exact);
    /// 1/s^2, of the springs of friction alone.
    [[nodiscard]] static double springsInSpin(const OfGrain& grain, bool exact) {
        return largestEigenvalue(grain.spring.spin, exact);
    }
    [[nodiscard]] static double springsInSpin(const OfBody& body, bool exact) {
        return largestOf(body.friction, exact);
    }
    /// s; not exact: at most that
    template <class One>
    [[nodiscard]] static double stepOf(const One& one, const Integrator& integrator, bool exact);
    template <class One>
    static void takeLeast(const One& one, std::uint32_t identity, const Integrator& integrator,
                          ContactBound& found);

    std::vector<Term> terms;
    std::vector<ShapedTerm> shaped;     // of each; empty where grains are spheres
    std::vector<OfGrain> blocks;        // of the grains by place
    std::vector<OfBody> bodies;         // of the rigid bodies
    std::vector<std::uint32_t> movers;  // of each place; empty without bodies
    std::vector<MovedWall> movedWalls;
    std::vector<WallSide> wallSides;
    std::vector<double> loads;          // 1/s^2, sum of spring over mass: of the grains, then of the bodies
    std::optional<GrainMasses> masses;  // where grains that are held carry such walls
    const PeriodicBox* box = nullptr;
    const GrainShapes* shapes = nullptr;  // null where grains are spheres
    // The parts of a wall that are near one grain, and their points.
    std::vector<std::uint32_t> parts;
    std::vector<WallPoint> points;
    double springUnit = 0, dashpotUnit = 0;
};

}  // namespace pendular
