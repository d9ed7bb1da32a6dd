#pragma once

#include "Kernel/Features/Superquadrics/SuperquadricLaws.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular {

/// The class that a driver of superquadrics derives from: a `Simulation<S>` whose particles are all added by
/// superquadricHandler.
template <class S>
class SuperquadricSimulation : public Simulation<S> {
public:
    SuperquadricSimulation() { this->setLaws(ownLaws); }
    ~SuperquadricSimulation() override { this->completeLeftRun(); }

    SuperquadricHandler superquadricHandler{this->particleHandler};

private:
    SuperquadricLaws<S> ownLaws{this->speciesHandler, superquadricHandler};
};

}  // namespace pendular
