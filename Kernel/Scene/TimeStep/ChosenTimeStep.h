#pragma once

namespace pendular {

class Scene;

/// s: the smaller of stabilityLimit() and shortestContactTime() over the steps that the shortest contact is
/// to have at least. Throws InputError where no contact can be.
[[nodiscard]] double chosenTimeStep(Scene& scene, double stepsInContact = 25);

}  // namespace pendular
