#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "Kernel/Particles/ParticleHandler.h"

namespace pendular {

/// What the kernel asks of the grains of a scene, and drivers do not: these calls are right only at their
/// place in a step.
class ParticleHandler::Inside {
public:
    /// The grains as they are, in the middle of a step.
    [[nodiscard]] static ParticleStore& grainsInStep(ParticleHandler& of) { return of.grains; }
    /// What finishes a step that was left unfinished.
    static void callToFinishStep(ParticleHandler& of, std::function<void()> function) {
        of.finishing = std::move(function);
    }
    static void leaveStepUnfinished(ParticleHandler& of) { of.unfinished = true; }
    /// Whether the last step was left so, and nobody has asked for the grains since; who calls this finishes
    /// it.
    [[nodiscard]] static bool takeUnfinishedStep(ParticleHandler& of) {
        return of.unfinished.exchange(false);
    }

    /// The scene begins: no column is added from now on.
    static void closeColumns(ParticleHandler& of) { of.columnsAreClosed = true; }
    /// Grains have been joined to a rigid body.
    static void noteJoined(ParticleHandler& of, std::span<const std::uint32_t> identities) {
        of.noteJoined(identities);
    }
    /// Called with the place of a grain before it is removed.
    static void callBeforeRemoval(ParticleHandler& of, std::function<void(std::uint32_t)> function) {
        of.beforeRemoval = std::move(function);
    }
    /// What has changed since this was called last.
    [[nodiscard]] static GrainChanges takeChanges(ParticleHandler& of) {
        return std::exchange(of.changes, {});
    }
    [[nodiscard]] static bool hasChanges(const ParticleHandler& of) { return of.changes.any(); }
};

}  // namespace pendular
