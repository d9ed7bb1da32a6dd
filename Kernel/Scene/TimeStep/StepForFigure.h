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
/// It is the longest step that is below both x / omega and y stabilityLimit(), with the largest x and y at
/// which runs kept to the error against runs with much shorter steps (Tools/Studies/Results/bulk-steps.csv:
/// six to nineteen starts of poured beds, drums, hoppers and impacts; errors include two standard errors).
/// omega is the highest frequency of two grains at an overlap of 5 % of the smaller radius; x is at
/// most 1.32, below sqrt(2), from which on a slow opening may be taken for the end of a touch
/// (StabilityLimit.h), and so below the largest stable step of each contact by itself, 2 / omega. y is at
/// most 6.2: stabilityLimit() knows the dashpots, and strongly damped beds do not come to rest above that (at
/// a restitution of 0.2 and y = 13 their kinetic energy stays 500 times as large). That beds rest below it is
/// measured, not proved.
///
/// The runs had spheres of nearly one size, HertzianViscoelastic with Mindlin (MindlinIncremental up to x =
/// 0.9), dry, a friction of 0.5, a restitution of 0.1 to 0.9 and the default integrator. In another scene,
/// for a smaller error, and where overlaps are estimated to be above 14 % of a radius, the step is that of
/// chosenTimeStep().
///
/// Throws InputError where a number is out of its range, there are no grains, or the figure follows single
/// collisions (ContactTime, ContactArea, Waves).
[[nodiscard]] StepForFigure findStepForFigure(Scene& scene, WantedFigure figure, double error);

}  // namespace pendular
