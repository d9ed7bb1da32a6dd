#pragma once

namespace pendular {

/// How contacts use the step in which their forces are wanted; the default is that of the default integrator.
struct ContactTiming {
    /// The change of a contact's own force enters the velocity that its dashpots see: they are implicit.
    bool implicitForces = true;
    /// Forces at the first and the last step of a touch stand for the time since its start and to its end,
    /// and tangential springs are kept half a step ahead; else they move by a step with the velocity at the
    /// force.
    bool timesTouches = true;
    /// With timesTouches: tangential springs are not kept ahead, but move to the force with the velocity in
    /// the middle of the time that they move for, which is explicit. This is for grains that carry the
    /// velocity v + h a.
    bool springsInStep = false;
    /// The length (s) of the step that comes; 0: as long as the last one.
    double comingStep = 0;

    friend constexpr bool operator==(const ContactTiming&, const ContactTiming&) = default;
};

}  // namespace pendular
