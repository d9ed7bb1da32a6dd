#pragma once

#include <string_view>
#include <vector>

#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// A boundary that does something by itself at the end of each step.
class ActsInSteps {
public:
    virtual ~ActsInSteps() = default;
    virtual void act(StepContext& step) = 0;
    /// Its settings, as in StepPart::compareSetUp().
    virtual void compareSetUp(StateArchive& archive, double now) const = 0;
    /// Its state in a run.
    virtual void visitState(StateArchive& archive) = 0;
};

/// The boundaries of a scene that do so, in the order in which they were added.
class MercuryActions : public StepPart {
public:
    /// It must outlive the scene's steps. Throws InputError in a run that began without any.
    void add(ActsInSteps* one);
    void remove(const ActsInSteps* one) { std::erase(all, one); }

    [[nodiscard]] std::string_view name() const override { return "boundaries that act in steps"; }
    [[nodiscard]] Features features(const StepContext& /*scene*/) const override {
        return all.empty() ? Features{} : Features{Feature::OwnPart};
    }
    void begin(StepContext& /*scene*/, bool /*isRestarted*/) override { hasBegun = true; }
    void atEnd(StepContext& step) override {
        for (ActsInSteps* const one : all) one->act(step);
    }
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;

private:
    std::vector<ActsInSteps*> all;
    bool hasBegun = false;
};

}  // namespace pendular
