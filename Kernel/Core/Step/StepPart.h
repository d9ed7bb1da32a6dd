#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "Kernel/Core/Step/Conflicts.h"
#include "Kernel/Core/Step/StepContext.h"

namespace pendular {

class StateArchive;
class SummaryRows;

/// The changes that hooks have made since the last step.
struct SceneChanges {
    bool laws = false;    // species or pairs
    bool walls = false;   // added, removed, or moved by other forces
    bool grains = false;  // that were there: put elsewhere, made larger or smaller, held
    bool timeStep = false;
    // None of them: only new grains have come.
    [[nodiscard]] bool areOnlyNewGrains() const { return !laws && !walls && !grains && !timeStep; }
};

/// Something that acts in the steps of a scene. A scene calls its parts in the order of their list, phase by
/// phase, and takes a step that fails back in the opposite order. A driver adds a part of its own by
/// addPart(). A part whose features the scene does not have sleeps: only begin(), compareSetUp(),
/// visitSetting() and visitState() are called.
///
/// Errors: a part throws InputError or RunError with one sentence; in a run both end it, with the sentence.
class StepPart {
public:
    StepPart() = default;
    StepPart(const StepPart&) = delete;
    StepPart& operator=(const StepPart&) = delete;
    virtual ~StepPart() = default;

    /// The name in restart files, the summary and messages; one part has it.
    [[nodiscard]] virtual std::string_view name() const = 0;
    /// The features that the scene has by this part; none: the part sleeps. Asked at set-up and after
    /// changes.
    [[nodiscard]] virtual Features features(const StepContext&) const { return {Feature::OwnPart}; }
    /// The features that a part of a driver's own does not go together with: a is Feature::OwnPart.
    [[nodiscard]] virtual std::span<const Conflict> ownConflicts() const { return {}; }
    /// Whether finish() needs the velocities at the end of each step. Where no part does, the end of a step
    /// is done together with the start of the next one, which is faster.
    [[nodiscard]] virtual bool needsFinishedStep() const { return true; }

    /// Throws InputError for what cannot be; at set-up and after changes.
    virtual void check(const StepContext&) {}
    /// The run begins, or goes on from a restart file.
    virtual void begin(StepContext&, bool /*isRestarted*/) {}
    /// Hooks have changed something; before check().
    virtual void takeOver(StepContext&, const SceneChanges&) {}

    /// Hooks have changed these grains, whose accelerations were found anew of contacts and gravity: the part
    /// adds those of the forces that it gave in the last step.
    virtual void addAccelerations(StepContext&, std::span<const std::uint32_t> /*places*/) {}

    /// Called before a step, with a whole state: it may still choose the length of the step, or change
    /// velocities (the energy ledger books that as given by the driver). It is not taken back.
    virtual void prepare(StepContext&) {}
    virtual void beforeMotion(StepContext&) {}
    virtual void moveGrains(StepContext&) {}
    /// Images and walls, when the grains have moved.
    virtual void moveSurroundings(StepContext&) {}
    /// All have moved, and `shifts` are known.
    virtual void afterMotion(StepContext&) {}
    /// The contacts have their forces: a part finds its own, by the velocities that contacts have seen, which
    /// it leaves as they are for the parts behind it.
    virtual void afterForces(StepContext&) {}
    /// All parts have found their forces: velocities get the share of them that the end of the step gives.
    virtual void accelerate(StepContext&) {}
    /// Grains have the velocities of the end of the step, which is not taken back any more.
    virtual void finish(StepContext&) {}
    /// Grains may come and go.
    virtual void atEnd(StepContext&) {}
    /// The step has failed in one of the phases from beforeMotion() to accelerate(): the part is as it was
    /// before it.
    virtual void takeBack(StepContext&) {}

    /// Visits what check() and begin() need of a restart file.
    virtual void visitSetting(StateArchive&, StepContext&) {}
    /// Visits all else that the part remembers.
    virtual void visitState(StateArchive&, StepContext&) {}
    virtual void addTo(SummaryRows&) const {}

    /// Whether the part of a driver's own acts alike where ranks share the scene: each has its own grains and
    /// ghosts of others (Kernel/Features/DomainDecomposition/README.md). Else it is refused there.
    [[nodiscard]] virtual bool actsOnRanks() const { return false; }

    /// Lists all that a driver sets of the part, each by archive.same(name, value, unit): a run that is
    /// resumed with another value ends with a sentence that names it, and ranks compare the values as well.
    /// What the run itself may change is compared unless it has. A part without settings overrides this by an
    /// empty function.
    virtual void compareSetUp(StateArchive&, StepContext&) = 0;
};

}  // namespace pendular
