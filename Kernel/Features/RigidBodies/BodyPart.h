#pragma once

#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

class InletHandler;

/// The motion of rigid bodies, and of their grains with them.
class BodyPart : public StepPart {
public:
    explicit BodyPart(const InletHandler& inletsOfScene) : inlets(inletsOfScene) {}

    [[nodiscard]] std::string_view name() const override { return "bodies"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void check(const StepContext& scene) override;
    void begin(StepContext& scene, bool isRestarted) override;
    void moveGrains(StepContext& step) override;
    /// A scene that is strained may become too short for a body.
    void afterMotion(StepContext& step) override;
    /// It has no settings: bodies are part of the state.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void takeBack(StepContext& step) override;

    /// m, of the widest body that is there or to come, as it turns; 0 without any
    [[nodiscard]] double widest() const { return width; }
    /// Whether features() reduces over all ranks, or returns the last result: a hook may call it on one rank
    /// alone.
    void askRanks(bool ask) { asksRanks = ask; }
    /// Tells the user of bodies whose spheres do not hang together.
    /// @param first of the bodies that are looked at
    static void warnOfGaps(const StepContext& scene, std::size_t first);

private:
    const InletHandler& inlets;
    double width = 0;  // m
    bool asksRanks = true;
    mutable bool areThere = false;  // on any rank, by the last reduction of features()
};

}  // namespace pendular
