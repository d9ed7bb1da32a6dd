// expect: Superquadrics have only adhesion that is prepared quickly
// With LiquidBridgeWillett in place of it it compiles: SelfTests/Superquadrics/BridgeTest.cpp.

#include "Kernel/Simulation/SuperquadricSimulation.h"
#include "Kernel/Species/Adhesion/LiquidBridgeRabinovich.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"

pendular::SuperquadricSimulation<
    pendular::Species<pendular::HertzianViscoelastic, pendular::NoFriction, pendular::LiquidBridgeRabinovich>>
    scene;
