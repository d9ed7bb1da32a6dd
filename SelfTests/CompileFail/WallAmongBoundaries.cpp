// expect: a wall is added to wallHandler
// The other way round than PeriodicBoundaryAmongWalls.cpp.

#include "Kernel/MercuryScene.h"

struct Grains : MercuryScene<LinearViscoelasticSpecies> {
    void setupInitialConditions() override { boundaryHandler.copyAndAddObject(InfiniteWall()); }
};
