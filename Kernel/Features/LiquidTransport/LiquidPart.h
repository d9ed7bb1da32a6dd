#pragma once

#include <optional>

#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

class InletHandler;
class SprayHandler;
struct LiquidLedger;

/// Liquid that moves between films and bridges, and dries; and the mass that films give to their grains.
class LiquidPart : public StepPart {
public:
    LiquidPart(const SprayHandler& spraysOfScene, const InletHandler& inletsOfScene)
        : sprays(spraysOfScene), inlets(inletsOfScene) {}

    [[nodiscard]] std::string_view name() const override { return "liquid"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    /// The liquid of the contacts compares how it dries (Features/LiquidTransport/Evaporation.h); what is to
    /// come depends on the end time, which may change.
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}
    void afterForces(StepContext& step) override;

    /// @param volume m^3, an upper bound of the liquid that will come
    void setToCome(double volume);
    /// Throws InputError where something of liquid was set, and no species moves any.
    void refuseWhereNoneMoves(const StepContext& scene, double densityOfFilms) const;
    /// At set-up: the films of the grains begin to be counted. @param timeMax s, end of the run
    /// @return the quantum (m^3) in which it is counted; 0: no liquid moves
    double beginToCount(const StepContext& scene, double timeMax) const;
    /// Throws InputError where the sprays of a run that goes on for longer emit more than it was begun for.
    void refuseMoreSpray(const StepContext& scene, double timeMax) const;
    /// Throws RunError if liquid has been lost or made: an error of the program.
    static void requireAll(const LiquidLedger& ledger, double time);

private:
    const SprayHandler& sprays;
    const InletHandler& inlets;
    std::optional<double> toCome;  // m^3
};

/// The mass of films as part of their grains'.
class FilmMassPart : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "filmMass"; }
    [[nodiscard]] Features features(const StepContext& scene) const override;
    void afterMotion(StepContext& step) override;
    void finish(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;

    /// @param liquid kg/m^3; 0: films have no mass
    void setDensity(const StepContext& scene, double liquid);
    [[nodiscard]] double getDensity() const { return density; }

private:
    double density = 0;  // kg/m^3
};

}  // namespace pendular
