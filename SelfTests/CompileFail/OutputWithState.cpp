// expect: success
// The output of OutputWithMisspeltState.cpp and OutputWithOtherState.cpp, as it must be.

#include "Kernel/Scene/Scene.h"

struct Count {
    double outputs = 0;

    void write(const pendular::Scene&) { ++outputs; }
    void visitState(pendular::StateArchive& archive, const pendular::Scene&) {
        archive.value("outputs", outputs);
    }
};

void addTo(pendular::Scene& scene) { scene.addOutput(Count()); }
