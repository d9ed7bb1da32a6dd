#include "Kernel/Simulation/ChosenTimeStep.h"

#include <algorithm>

#include "Kernel/Base/InputError.h"
#include "Kernel/Simulation/Scene.h"
#include "Kernel/Species/Field.h"

namespace pendular {

double chosenTimeStep(Scene& scene, double stepsInContact) {
    checkValue("chosenTimeStep", "stepsInContact", stepsInContact, "", positive);
    const double step = std::min(scene.stabilityLimit(), scene.shortestContactTime() / stepsInContact);
    if (!(step < infinity))
        throw InputError(
            "chosenTimeStep() finds no contact that could be: call it after grains are there, or inlets that "
            "insert them.");
    return step;
}

}  // namespace pendular
