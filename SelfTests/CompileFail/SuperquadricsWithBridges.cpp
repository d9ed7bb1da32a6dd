// expect: Superquadrics have no liquid bridges
// With JKR in place of the bridge it compiles: SelfTests/Superquadrics/AdhesionTest.cpp.

#include "Kernel/Simulation/SuperquadricSimulation.h"
#include "Kernel/Species/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"

pendular::SuperquadricSimulation<
    pendular::Species<pendular::HertzianViscoelastic, pendular::NoFriction, pendular::LiquidBridgeWillett>>
    scene;
