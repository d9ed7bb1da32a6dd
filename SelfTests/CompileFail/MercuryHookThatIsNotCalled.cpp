// expect: overrid.*final
// Hooks of MercuryDPM that nothing would call are final.

#include "Kernel/MercuryScene.h"

struct Grains : MercuryScene<LinearViscoelasticSpecies> {
    void computeAdditionalForces() {}
};
