#pragma once

#include <string>
#include <vector>

namespace pendular {

class Features;
class Scene;
enum class WantedFigure;
struct GrainSizes;

/// The longest time step with which a bulk quantity is right to an error, by runs that were measured.
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

/// The step for a bulk quantity and its error (1; 0.001 to 0.2), at set-up, when species, integrator, walls
/// and grains are there.
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
/// The runs had spheres of nearly one size (a ratio of radii of 1.25; up to 1.3 is taken),
/// HertzianViscoelastic with Mindlin (MindlinIncremental up to x = 0.9, in beds and hoppers), dry, a friction
/// of 0.5 (in beds 0.25 to 0.8, which is taken), a restitution of 0.1 to 0.9 (0.5 in drums and impacts; for
/// Friction and ContactsInFlow 0.3 to 0.7 is taken) and the default integrator. In another scene (also one
/// with walls that forces move, membranes, shear or strain, liquid, or parts of the driver's own), for a
/// smaller error, and where overlaps are estimated to be above 14 % of a radius, the step is that of
/// chosenTimeStep().
///
/// Throws InputError where a number is out of its range, there are no grains, or the figure follows single
/// collisions (ContactTime, ContactArea, Waves).
/// @param features of the scene
[[nodiscard]] StepForFigure findStepForFigure(Scene& scene, const Features& features, WantedFigure figure,
                                              double error);

/// Those that findStepForFigure() does not refuse.
[[nodiscard]] const std::vector<WantedFigure>& measuredFigures();

/// What of the scene was not measured, but for its overlaps; empty if all was.
[[nodiscard]] std::string objectionToMeasuredSteps(const Scene& scene, const Features& features,
                                                   const GrainSizes& sizes, WantedFigure figure);

}  // namespace pendular
