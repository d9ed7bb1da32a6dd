// expect: a boundary is added to boundaryHandler
// MercuryDPM has two handlers, too; a boundary that is added to the other one is refused with its name.

#include "Kernel/MercuryScene.h"

struct Grains : MercuryScene<LinearViscoelasticSpecies> {
    void setupInitialConditions() override { wallHandler.copyAndAddObject(PeriodicBoundary()); }
};
