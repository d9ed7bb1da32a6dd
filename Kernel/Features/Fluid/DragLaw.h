#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

class StateArchive;

/// A fluid of constant density and viscosity.
struct FluidMaterial {
    static constexpr std::string_view name = "Fluid";

    double density = unset;    // kg/m^3
    double viscosity = unset;  // Pa s

    static constexpr auto fields() {
        using F = Field<FluidMaterial>;
        return std::array{F{"density", &FluidMaterial::density, "kg/m^3", positive, Mixing::Arithmetic,
                            "mass of the fluid by its volume", "water 998.2, air 1.2"},
                          F{"viscosity", &FluidMaterial::viscosity, "Pa s", positive, Mixing::Arithmetic,
                            "dynamic viscosity", "water 1.0e-3, air 1.8e-5"}};
    }
};

/// Refuses a restart file of another fluid.
void compareFluid(StateArchive& archive, const FluidMaterial& fluid);

/// What the drag on a grain depends on.
struct DragState {
    double porosity;  // share of the fluid's volume around it
    double slip;      // |u - v|, m/s; u is the velocity of the fluid between the grains
    double diameter;  // m
    FluidMaterial fluid;

    [[nodiscard]] double solid() const { return 1 - porosity; }
    /// rho eps |u - v| d / mu: by the superficial speed, as all laws here have it.
    [[nodiscard]] double reynolds() const {
        return fluid.density * porosity * slip * diameter / fluid.viscosity;
    }
};

/// A law of the drag of spheres. The force of a law is that of model A: it does not include the force of the
/// pressure gradient that the drag itself makes (FluidPart.h).
struct DragLaw {
    std::string_view name;
    /// kg/s: the force on a grain over u - v, beta V/(1 - eps). Not negative; at no slip its limit.
    double (*resistance)(const DragState&);
    Range porosity;          // where it holds
    double highestReynolds;  // by the superficial speed
    std::string_view source;
};

/// The states at which a restart compares a law of the driver's own, which may have changed under its name:
/// all of these porosities with all of these Reynolds numbers, for a grain of 1 mm in the fluid of the scene.
/// A law is asked from lowestPorosityOfDrag to 1; laws of the kernel hold up to Re = 1e5 at most. By
/// dimensions a law depends on these two numbers only. None is at 0.8, or at Re = 1 or 1000, where laws jump:
/// the last digit would choose the side.
inline constexpr std::array porositiesOfComparison{0.35, 0.4, 0.45, 0.5, 0.6, 0.7, 0.85, 0.95, 1.0};
inline constexpr std::array reynoldsOfComparison{0.0, 0.03, 0.3, 3.0, 30.0, 300.0, 3e3, 3e4, 1.5e5};
/// Refuses a restart file of another law.
void compareDragLaw(StateArchive& archive, const DragLaw& law, const FluidMaterial& fluid);

/// All of them.
[[nodiscard]] std::span<const DragLaw> dragLaws();
/// Throws InputError, with the nearest of the names that there are, for one that is not.
[[nodiscard]] const DragLaw& dragLaw(std::string_view name);

/// Drag coefficient of a sphere alone: 24/Re (1 + 0.15 Re^0.687) below Re = 1000, 0.44 from there (0.4 %
/// lower). L. Schiller and A. Naumann, Z. VDI 77 (1933) 318. Times Re, so that it has a limit at Re = 0.
[[nodiscard]] double schillerNaumannTimesReynolds(double reynolds);

/// The lowest porosity that a drag law is asked at: grains overlap, or fill a cell by the way their volumes
/// are spread. Porosity itself is not changed.
inline constexpr double lowestPorosityOfDrag = 0.35;
/// The porosity at which a law is asked where that of the cells is this: from lowestPorosityOfDrag to 1.
[[nodiscard]] constexpr double porosityOfDrag(double porosity) {
    return std::clamp(porosity, lowestPorosityOfDrag, 1.0);
}

/// N: the force of a law, that of model A, as a grain of a scene gets it. Below a porosity of 0.35 it is that
/// at 0.35, with the same slip.
/// @param porosity above 0, up to 1; @param slip m/s, |u - v|, not negative; @param diameter m
[[nodiscard]] double dragForce(const DragLaw& law, double porosity, double slip, double diameter,
                               const FluidMaterial& fluid);

/// m/s: the speed at which the drag of a sphere alone, by Schiller and Naumann, is its weight in the fluid.
/// @param gravity m/s^2, not negative; @param density kg/m^3, of the sphere, not below that of the fluid
[[nodiscard]] double terminalSpeed(double diameter, double density, const FluidMaterial& fluid,
                                   double gravity);

/// m/s: the superficial speed at which the drag on the grains of a homogeneous bed of a porosity is their
/// weight in the fluid: where a fixed bed lifts off, and how fast a suspension settles. The drag is that of
/// dragForce().
[[nodiscard]] double balancedSpeed(const DragLaw& law, double porosity, double diameter, double density,
                                   const FluidMaterial& fluid, double gravity);

}  // namespace pendular
