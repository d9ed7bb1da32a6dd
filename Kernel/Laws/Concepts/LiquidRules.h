#pragma once

#include <cmath>
#include <cstdint>

namespace pendular {

/// Volumes of liquid that moves are counted in whole quanta of q = 2^k m^3: their sums are exact, in any
/// order. Fewer than 2^53, so that a double holds each of them.
using Quanta = std::int64_t;

/// How the liquid of the contacts between two species moves: the fields of LiquidMigration. Volumes in m^3.
struct LiquidRules {
    double largest = 0;    // V_max, of a bridge; 0: none forms
    double least = 0;      // V_min: two films that offer no more than this form no bridge
    double share = 1;      // c, 0 to 1: of a ruptured bridge, what is offered to other bridges
    double wallDose = 0;   // w, that a wet wall offers to each new bridge; 0: the wall is dry
    bool byRoom = false;   // offers in proportion to V_max - V, instead of equal ones
    bool toDry = false;    // offers to touching contacts without a bridge, too
    bool atFilms = false;  // bridges form where films meet, and not only where bodies touch
};

/// The rules with volumes in quanta.
struct QuantisedRules {
    Quanta largest = 0, least = 0, wallDose = 0;
    double share = 1;
    bool byRoom = false, toDry = false, atFilms = false;

    QuantisedRules() = default;
    /// @param quantum m^3; V_max is rounded down to whole quanta, and so are the others
    QuantisedRules(const LiquidRules& rules, double quantum)
        : largest(whole(rules.largest / quantum)),
          least(whole(rules.least / quantum)),
          wallDose(whole(rules.wallDose / quantum)),
          share(rules.share),
          byRoom(rules.byRoom),
          toDry(rules.toDry),
          atFilms(rules.atFilms) {}

private:
    static Quanta whole(double quanta) { return static_cast<Quanta>(std::floor(std::fmin(quanta, 0x1p53))); }
};

}  // namespace pendular
