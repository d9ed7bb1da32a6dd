// expect: visitState.. of an output has the form visitState
// See OutputWithState.cpp for the same one, complete.

#include "Kernel/Scene/Scene.h"

struct Count {
    double outputs = 0;

    void write(const pendular::Scene&) { ++outputs; }
    void visitState(pendular::StateArchive& archive) { archive.value("outputs", outputs); }
};

void addTo(pendular::Scene& scene) { scene.addOutput(Count()); }
