// expect: An output that has members lists in visitState
// See OutputWithState.cpp for the same one, complete.

#include "Kernel/Scene/Scene.h"

struct Count {
    double outputs = 0;

    void write(const pendular::Scene&) { ++outputs; }
    void visitStat(pendular::StateArchive& archive, const pendular::Scene&) {
        archive.value("outputs", outputs);
    }
};

void addTo(pendular::Scene& scene) { scene.addOutput(Count()); }
