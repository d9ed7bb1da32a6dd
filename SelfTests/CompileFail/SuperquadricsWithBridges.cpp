// expect: Superquadrics have only adhesion that is prepared quickly
// With LiquidBridgeWillett in place of it it compiles: SelfTests/Superquadrics/BridgeTest.cpp.

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeRabinovich.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

pendular::SuperquadricSimulation<
    pendular::Species<pendular::HertzianViscoelastic, pendular::NoFriction, pendular::LiquidBridgeRabinovich>>
    scene;
