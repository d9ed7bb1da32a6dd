#pragma once

#include <string>

namespace pendular {

class Scene;
enum class WantedFigure;

/// The longest time step with which a bulk figure is right to an error, by runs that were measured.
struct StepForFigure {
    WantedFigure figure{};
    double step = 0;      // s
    double asked = 0;     // 1, the error
    double measured = 0;  // 1, deviation of the runs at that step, two standard errors included; 0: not known
    double limit = 0;     // s, stabilityLimit()
    std::string unknown{};  // why there is no measured error; the step is that of chosenTimeStep() then

    [[nodiscard]] bool isKnown() const { return unknown.empty(); }
    /// What was found and what is lost, in a few sentences.
    [[nodiscard]] std::string text() const;
};

/// The step for a bulk figure and its error (1; 0.001 to 0.2), at set-up, when species, integrator, walls and
/// grains are there.
///
/// It is h omega over omega, the highest frequency of two grains at an overlap of 5 % of the smaller radius,
/// with the largest h omega at which runs kept to the error against runs with a ninth to a sixth of it
/// (Tools/Studies/Results/bulk-steps.csv: ten starts of a poured bed, a drum and a hopper). It is never above
/// sqrt(2) / omega, from which on a slow opening may be taken for the end of a touch (StabilityLimit.h), so
/// that it is below the largest stable step of each contact by itself, 2 / omega. Above stabilityLimit() it
/// is measured, not proved, that a bed whose friction sticks stays at rest.
///
/// The runs had spheres of nearly one size, HertzianViscoelastic with Mindlin, dry, a friction of 0.5, a
/// restitution of 0.2 to 0.9 and the default integrator. In another scene, for a smaller error, and where
/// collisions at the estimated speed overlap by more than 5 %, the step is that of chosenTimeStep().
///
/// Throws InputError where a number is out of its range, there are no grains, or the figure follows single
/// collisions (ContactTime, ContactArea, Waves).
[[nodiscard]] StepForFigure findStepForFigure(Scene& scene, WantedFigure figure, double error);

}  // namespace pendular
