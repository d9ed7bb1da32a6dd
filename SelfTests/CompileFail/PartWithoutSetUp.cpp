// expect: A part of the step lists what a driver sets of it in compareSetUp

#include "Kernel/Scene/Scene.h"

struct Draught : pendular::StepPart {
    double speed = 1;  // m/s
    [[nodiscard]] std::string_view name() const override { return "draught"; }
};

void addTo(pendular::Scene& scene) { scene.addPart<Draught>(); }
