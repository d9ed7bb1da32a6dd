#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// The parts of a scene's step, in the order in which they act. Those that the scene does not have are not
/// called.
class StepList {
public:
    using Phase = void (StepPart::*)(StepContext&);

    /// @param kernelParts live as long as the list
    explicit StepList(std::vector<StepPart*> kernelParts) : parts(std::move(kernelParts)) {}

    /// A part of a driver's own comes behind all others. Throws InputError if there is a part of its name.
    void add(std::unique_ptr<StepPart> part);
    /// Whether a part of a driver's own has this name.
    [[nodiscard]] bool hasOwn(std::string_view name) const;

    /// Finds out which parts the scene has, and what it has by them.
    Features wake(const StepContext& context);
    /// What the scene has by its parts, which stay as they are.
    [[nodiscard]] Features features(const StepContext& context) const;
    /// Throws InputError for what cannot be combined with a part of a driver's own.
    void refuseOwnConflicts(const Features& scene) const;
    void check(const StepContext& context) const;
    void begin(StepContext& context, bool isRestarted) const;
    void takeOver(StepContext& context, const SceneChanges& changes) const;

    void call(Phase phase, StepContext& context) const {
        for (StepPart* const part : awake) (part->*phase)(context);
    }
    /// @param but a part that does so itself
    void addAccelerations(StepContext& context, std::span<const std::uint32_t> places,
                          const StepPart* but = nullptr) const {
        for (StepPart* const part : awake)
            if (part != but) part->addAccelerations(context, places);
    }
    /// Takes back the parts in the opposite order.
    void takeBack(StepContext& context) const;
    [[nodiscard]] bool needFinishedStep() const { return finishEachStep; }

    /// A group of each part, asleep or not: a scene that goes on is held against all of them.
    void visitSettings(StateArchive& archive, StepContext& context) const;
    void visitStates(StateArchive& archive, StepContext& context) const;
    /// What drivers set of all parts, for ranks to compare.
    void compareSetUps(StateArchive& archive, StepContext& context) const;
    [[nodiscard]] std::vector<std::string_view> names() const;
    void addTo(SummaryRows& rows) const;

private:
    std::vector<StepPart*> parts, awake;
    std::vector<std::unique_ptr<StepPart>> own;
    bool finishEachStep = false;
};

}  // namespace pendular
