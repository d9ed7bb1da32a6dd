#pragma once

#include <array>
#include <cstddef>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What one contact remembers of its bond.
template <class T>
struct BondOfContact {
    T attraction;    // F_b of its species, N
    T dashpot;       // c, kg/s
    T bond = T(0);   // N, while it is bonded; 0: it is not
    T asked = T(0);  // 1: bonded since the last step
    /// The places among these numbers.
    static constexpr std::size_t attractionNumber = 0, bondNumber = 2, askedNumber = 3;

    [[nodiscard]] T force(T /*separation*/) const { return bond; }
    /// Without a bond it never acts.
    [[nodiscard]] T range() const { return select(bond > T(0), T(0), T(-infinity)); }
    /// A bond that was there before the last touch ended has gone with it: its force is taken off here.
    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law&, const BridgeMotion<T>& motion) {
        const auto isOver = motion.forms & !(asked > T(0));
        const BridgeResistance<T> result{.normal = select(isOver, T(0), dashpot),
                                         .force = select(isOver, bond, T(0))};
        bond = select(isOver, T(0), bond);
        asked = T(0);
        return result;
    }
    template <class Law>
    void takeState(const Law&, const BondOfContact& before) {
        bond = before.bond, asked = before.asked;
    }
    void checkGap(T /*separation*/, T /*roundOff*/) {}
};

/// Bodies that overlap and have been told to stay together: a constant attraction F_b, and a dashpot c, until
/// they part. A pair at rest overlaps by F_b / k of a linear spring k; a force of F_b parts it, with the work
/// F_b^2 / (2 k). There is no shear, no bending and no strength in it: beams that break are BondPart. A
/// contact is bonded by MercuryInteraction::bond(); without that the law does nothing.
/// Source: MercuryDPM's BondedSpecies.
struct Bonded {
    static constexpr std::string_view name = "Bonded";
    static constexpr std::string_view summary =
        "constant attraction of contacts that a driver has bonded, while they overlap (as MercuryDPM's)";
    static constexpr std::string_view domain =
        "overlaps up to the radius; forces are of one size for all radii";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = true;
    static constexpr bool readsOverlap = true;
    static constexpr BridgeResists resists = BridgeResists::Approach;
    static constexpr double largestOverlapInRun = 1;

    double bondForceMax = unset;  // F_b, N
    double bondDissipation = 0;   // c, kg/s

    static constexpr auto fields() {
        constexpr std::string_view source = "MercuryDPM, BondedSpecies";
        return std::to_array<Field<Bonded>>(
            {{"bondForceMax", &Bonded::bondForceMax, "N", notNegative, Mixing::Harmonic,
              "F_b, attraction of a bonded contact; 0: none", source},
             {"bondDissipation", &Bonded::bondDissipation, "kg/s", notNegative, Mixing::Harmonic,
              "c, dashpot of a bonded contact", source}});
    }

    void setBondForceMax(double value) { set(&Bonded::bondForceMax, value); }
    void setBondDissipation(double value) { set(&Bonded::bondDissipation, value); }
    [[nodiscard]] double getBondForceMax() const { return bondForceMax; }
    [[nodiscard]] double getBondDissipation() const { return bondDissipation; }

    template <class T>
    using Interaction = BondOfContact<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies&) const { return {bondForceMax, bondDissipation}; }
    [[nodiscard]] double range(const Bodies&) const { return 0; }
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies&) const {
        return {.normal = bondDissipation};
    }

private:
    void set(double Bonded::*member, double value) { setField(*this, member, value); }
};

}  // namespace pendular
