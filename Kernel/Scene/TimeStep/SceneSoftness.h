#pragma once

#include <string>

#include "Kernel/Scene/TimeStep/SoftestModulus.h"

// What softestModulus() computes of a scene.

namespace pendular {

/// Gives an advice the gain of a run whose steps are so many times as long: 2.2 to 3.1 times where they are
/// 10^(1/2) times, as measured, with more contacts and the lists of grains.
void setGain(SoftnessAdvice& advice, double longerSteps);

/// The lines of an advice's text that name the steps and all that is to be scaled.
[[nodiscard]] std::string textOf(const SoftenedStep& step);

}  // namespace pendular
