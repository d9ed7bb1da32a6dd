#pragma once

#include <cstddef>
#include <limits>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

class BodyHandler;
class ContactLaws;
class ContactSystem;
class EnergyAccount;
class Logger;
class ParticleHandler;
class StepList;
class StepTimes;
class WallHandler;
struct EnergyLedger;
struct GrainSizes;
struct Integrator;

/// How far things have moved in the step, m.
struct Shifts {
    double grains = 0, walls = 0;  // the farthest grain, the farthest point of a wall
    double approach = 0;           // of two grains that touch, at most
};

/// The scene as a part of its step sees it.
struct StepContext {
    ParticleHandler& particles;
    BodyHandler& bodies;
    WallHandler& walls;
    ContactSystem& contacts;
    PeriodicBox& box;
    Logger& logger;
    StepTimes& times;

    const StepList* parts = nullptr;
    ContactLaws* laws = nullptr;
    PeriodicBox boxAtSetUp = {};         // only its lowest corner and its lengths
    const Integrator* scheme = nullptr;  // as the driver has chosen it
    bool springsInStep = false;          // contacts move springs as integrators::springsInStep does
    Vector<double> gravity{0, 0, 0};     // m/s^2
    int threads = 1;
    double smallestRadius = std::numeric_limits<double>::infinity();  // m, of all grains that have been
    double largestReach = 0;                   // m, of two centres that have acted on each other
    const GrainSizes* checkedSizes = nullptr;  // of the last check
    bool hasInlets = false;
    bool acceptsUnstableStep = false;

    EnergyLedger* ledger = nullptr;    // null: none is kept
    EnergyAccount* account = nullptr;  // null: the same

    double time = 0;               // s, at the start of the step
    double length = 0;             // s, of the step; 0 at the start of a run, where forces are found
    double timeAfter = 0;          // s, at its end, with the bits that the scene's time will have
    std::size_t number = 0;        // of steps that have been done
    double unfinished = 0;         // s, length of the last step, whose end may be left to this one
    bool finishesLast = false;     // it is: the motion of this step does both at once
    bool grainsHaveMoved = false;  // in this step, so that taking it back moves them back
    Shifts shifts = {};            // of this step

    /// The grains as they are, in the middle of a step.
    [[nodiscard]] ParticleStore& grains() const;
};

/// How contacts of a scene see velocities, and what its limits count with: the driver's integrator, with
/// springs in the step where the friction lacks dashpots, or the time step is adaptive.
[[nodiscard]] Integrator contactScheme(const StepContext& scene);

}  // namespace pendular
