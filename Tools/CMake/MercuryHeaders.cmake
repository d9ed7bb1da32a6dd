# Headers by the names that MercuryDPM's programs include ("Mercury3D.h", "Walls/InfiniteWall.h", ...), each of which
# is Kernel/MercuryScene.h. A program sees them when it links Pendular::MercuryHeaders, or adds their folder.

# Writes them into a folder. Left alone where nothing has changed, so that nothing is compiled again.
function(pendular_write_mercury_headers folder)
    set(names Mercury3D Mercury2D DPMBase Chute Logger GeneralDefine
        Particles/SphericalParticle Particles/BaseParticle Particles/LiquidFilmParticle
        Walls/InfiniteWall Walls/IntersectionOfWalls Walls/AxisymmetricIntersectionOfWalls Walls/TriangleWall
        Boundaries/PeriodicBoundary Boundaries/CubeInsertionBoundary Boundaries/DeletionBoundary
        Boundaries/CubeDeletionBoundary Boundaries/FluxBoundary Boundaries/LeesEdwardsBoundary
        Boundaries/SphereInsertionBoundary Boundaries/PolydisperseInsertionBoundary Boundaries/DropletBoundary
        Boundaries/SubcriticalMaserBoundary Boundaries/ConstantMassFlowMaserBoundary
        Boundaries/AngledPeriodicBoundary Boundaries/TimeDependentPeriodicBoundary Boundaries/CylinderInsertionBoundary
        Walls/TriangulatedWall Walls/NurbsWall Walls/Screw Walls/Coil Walls/LevelSetWall Nurbs/NurbsSurface
        CG/CG CG/TimeAveragedCG CG/Functions/Gauss CG/Functions/Lucy CG/Functions/Heaviside
        Species/Species Math/ExtendedMath Math/Helpers Math/PSD Math/RNG Math/Vector)
    foreach(normal IN ITEMS LinearViscoelastic LinearPlasticViscoelastic HertzianViscoelastic
                            HertzianBSHPViscoelastic Sinter HertzianSinter)
        foreach(friction IN ITEMS "" SlidingFriction Friction Mindlin MindlinRollingTorsion)
            foreach(adhesion IN ITEMS "" ReversibleAdhesive IrreversibleAdhesive LiquidBridgeWillet
                                      LiquidBridgeClassicalWillet LiquidBridgeBagheri LiquidMigrationWillet
                                      LiquidMigrationLS Bonded ParhamiMcMeekingSinter)
                list(APPEND names "Species/${normal}${friction}${adhesion}Species")
            endforeach()
        endforeach()
    endforeach()
    foreach(name IN LISTS names)
        file(CONFIGURE OUTPUT "${folder}/${name}.h" @ONLY CONTENT [=[
#pragma once

// Written by CMake (Tools/CMake/MercuryHeaders.cmake).

#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "Kernel/MercuryScene.h"

#ifndef UNUSED  // MercuryDPM's mark of an argument
#define UNUSED [[maybe_unused]]
#endif
]=])
    endforeach()
endfunction()

pendular_write_mercury_headers("${PROJECT_BINARY_DIR}/Generated/MercuryHeaders")
add_library(PendularMercuryHeaders INTERFACE)
add_library(Pendular::MercuryHeaders ALIAS PendularMercuryHeaders)
target_link_libraries(PendularMercuryHeaders INTERFACE Pendular::Kernel)
set_target_properties(PendularMercuryHeaders PROPERTIES EXPORT_NAME MercuryHeaders)
target_include_directories(PendularMercuryHeaders INTERFACE
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/Generated/MercuryHeaders>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/pendular/MercuryHeaders>)
