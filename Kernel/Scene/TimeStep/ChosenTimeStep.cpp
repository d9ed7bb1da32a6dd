#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"

#include <algorithm>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/Scene.h"

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
