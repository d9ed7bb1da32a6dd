#pragma once

namespace pendular {

/// The account (m^3) of the liquid of a scene: where it is, and where it came from. All are multiples of one
/// quantum, so that the identity holds to the last bit.
struct LiquidLedger {
    double films = 0, bridges = 0;
    double walls = 0;     // what wet walls have got back minus what they gave: negative while they give
    double removed = 0;   // with grains that were removed
    double airborne = 0;  // in droplets of sprays
    double lost = 0;      // droplets that hit dry walls, or nothing
    double evaporated = 0;
    double initial = 0;   // at the start of the run
    double absorbed = 0;  // that a driver has given to films since then
    double emitted = 0;   // by sprays

    /// Zero.
    [[nodiscard]] double unaccounted() const {
        return films + bridges + walls + removed + airborne + lost + evaporated -
               (initial + absorbed + emitted);
    }
};

}  // namespace pendular
