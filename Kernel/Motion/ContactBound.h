#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Motion/Integrator.h"

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
    std::size_t contactsOfGrain = 0;  // that touch, or may come to
    double overlapOfGrain = 0;        // the largest, of the smaller radius
    double supposedOverlap = 0;       // of the effective radius, the largest with the margin
    double largestOverlap = 0;        // of all contacts that touch, of the smaller radius
    double meanOverlap = 0;
    std::size_t touching = 0;  // contacts
};

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
/// grains share alike, and a large grain among small ones does not take what is theirs. A wall, or a grain
/// that is held, has no block and leaves its partner k alone. Of a block, the eigenvalues of the parts of
/// shift and spin are exact, and their coupling is bounded by its norm. The same for dashpots.
///
/// The stiffness of friction is that of contacts that stick. What turns the normal forces (F/d of each) is
/// left out: a thousandth.
///
/// Sums are exact, in units of 2^-40 of the largest term, so that no bit depends on the order of the list.
class ContactBounds {
public:
    [[nodiscard]] ContactBound find(const ContactSystem& contacts, const WallHandler& walls,
                                    const ParticleStore& grains, const Integrator& integrator,
                                    const ContactOutlook& outlook = {});

private:
    /// The springs (1/s^2) or dashpots (1/s) of a grain, over its mass and moment of inertia.
    struct Block {
        std::array<double, 6> shift{}, spin{};  // xx yy zz xy xz yz
        Vector<double> coupling{0, 0, 0};
    };
    struct Term {
        std::uint32_t first, second;  // places; second: none at a wall
        Vector<double> normal;
        PressedPair pair{};
        ContactStiffness stiffness{};
        double gap = 0;            // m
        double reached = 0;        // m, overlap
        double approach = 0;       // m/s
        double smallerRadius = 0;  // m
        bool drags = false;        // a bridge
    };
    struct OfGrain {
        Block spring, dashpot;
        double ownDashpot = infinity;  // 1/s, the least that one of its contacts makes implicit
        double relaxation = infinity;  // s, of the least damped spring of friction
        double overlap = 0;            // of the smaller radius
        std::size_t contacts = 0;
        double load = 0;  // 1/s^2, sum of spring over mass
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    void take(const ContactSystem& contacts, const WallHandler& walls, const ParticleStore& grains,
              const Bucket& bucket, const ContactOutlook& outlook);
    void takePair(const ContactSystem& contacts, const ParticleStore& grains, const Bucket& bucket,
                  std::size_t contact, const ContactOutlook& outlook);
    /// @param begin, end contacts of one grain with parts of the wall
    void takeAtWall(const ContactSystem& contacts, const Wall& wall, const ParticleStore& grains,
                    const Bucket& bucket, std::size_t begin, std::size_t end, const ContactOutlook& outlook);
    void keep(const ContactSystem& contacts, const Bucket& bucket, std::size_t contact, Term& term,
              const ContactOutlook& outlook);
    /// m: what a pair that touches, or may come to, can reach by its own approach.
    [[nodiscard]] static double reachedOverlap(const ContactLaws& laws, const Bucket& bucket,
                                               const Term& term, const ContactOutlook& outlook);
    static void press(const ContactLaws& laws, const Bucket& bucket, std::span<Term> ofBucket,
                      const ContactOutlook& outlook, double mean);
    void summarise(ContactBound& found) const;
    void chooseWeights(const ParticleStore& grains);
    /// The weight t of the grain at a place in a contact with another one.
    [[nodiscard]] double weight(std::uint32_t place, std::uint32_t other) const {
        const double own = blocks[place].load, others = blocks[other].load;
        return own > 0 && others > 0 ? others / own : 1;
    }
    void addTo(const ParticleStore& grains, const Term& term, std::uint32_t place, std::uint32_t other);
    /// s; not exact: at most that
    [[nodiscard]] static double stepOf(const OfGrain& grain, const Integrator& integrator, bool exact);

    std::vector<Term> terms;
    std::vector<OfGrain> blocks;  // of the grains by place
    // The parts of a wall that are near one grain, and their points.
    std::vector<std::uint32_t> parts;
    std::vector<WallPoint> points;
    double springUnit = 0, dashpotUnit = 0;
};

/// The largest eigenvalue of a symmetric matrix (xx yy zz xy xz yz), from above.
/// @param exact to 1e-6; else up to 1.5 times as large
[[nodiscard]] double largestEigenvalue(const std::array<double, 6>& matrix, bool exact = true);

}  // namespace pendular
