#include "Kernel/Features/Fluid/DragLaw.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/Halving.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {

void compareFluid(StateArchive& archive, const FluidMaterial& fluid) {
    for (const auto& field : FluidMaterial::fields())
        archive.same(field.name, fluid.*field.member, field.unit);
}

/// kg/s; NaN at a state for which a law of the driver's own throws.
static double resistanceOrNone(const DragLaw& law, const DragState& state) {
    try {
        return law.resistance(state);
    } catch (const std::exception&) {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

// Of each Reynolds number by itself: what differs is found to 1e-9 of the largest of its row.
void compareDragLaw(StateArchive& archive, const DragLaw& law, const FluidMaterial& fluid) {
    archive.same("law", law.name);
    archive.sameRecord<double>("lawHolds",
                               std::array{law.porosity.lowest, law.porosity.highest, law.highestReynolds});
    constexpr double diameter = 1e-3;  // m
    for (const double reynolds : reynoldsOfComparison) {
        std::vector<double> resistances;  // kg/s
        for (const double porosity : porositiesOfComparison) {
            const double slip = reynolds * fluid.viscosity / (fluid.density * porosity * diameter);
            resistances.push_back(resistanceOrNone(law, {porosity, slip, diameter, fluid}));
        }
        archive.sameValues(fmt::format("resistanceAtRe{:g}", reynolds), std::move(resistances),
                           "kg/s at porosities from 0.35 to 1");
    }
}

using std::numbers::pi;

double schillerNaumannTimesReynolds(double reynolds) {
    return reynolds < 1000 ? 24 * (1 + 0.15 * std::pow(reynolds, 0.687)) : 0.44 * reynolds;
}

namespace {

/// 3 pi mu d, kg/s: G. G. Stokes, Trans. Cambridge Phil. Soc. 9 (1851) 8.
double stokes(const DragState& s) { return 3 * pi * s.fluid.viscosity * s.diameter; }

/// m^3, of the grain. The resistance is beta times this over (1 - eps).
double volume(const DragState& s) { return pi / 6 * s.diameter * s.diameter * s.diameter; }

/// Of a sphere alone, by the superficial speed: pi/8 Cd rho d^2 U = pi/8 mu d (Cd Re).
double schillerNaumann(const DragState& s) {
    return pi / 8 * s.fluid.viscosity * s.diameter * schillerNaumannTimesReynolds(s.reynolds());
}

/// beta = 150 (1 - eps)^2 mu/(eps d^2) + 1.75 (1 - eps) rho |u - v|/d.
double ergun(const DragState& s) {
    const double d = s.diameter;
    return volume(s) *
           (150 * s.solid() * s.fluid.viscosity / (s.porosity * d * d) + 1.75 * s.fluid.density * s.slip / d);
}

/// beta = 3/4 Cd eps (1 - eps) rho |u - v|/d eps^-2.65, with Cd by the superficial speed.
double wenYu(const DragState& s) { return schillerNaumann(s) * std::pow(s.porosity, -2.65); }

double gidaspow(const DragState& s) { return s.porosity < 0.8 ? ergun(s) : wenYu(s); }

/// F = pi/8 Cd rho d^2 U^2 eps^-chi, U superficial, Cd = (0.63 + 4.8/sqrt(Re))^2,
/// chi = 3.7 - 0.65 exp(-(1.5 - lg Re)^2/2). F over u - v is eps F/U. Some codes print chi - 1, of U^2 in
/// place of eps U.
double diFelice(const DragState& s) {
    const double reynolds = s.reynolds();
    const double root = 0.63 * std::sqrt(reynolds) + 4.8;  // Cd Re = root^2
    const double off = reynolds > 0 ? 1.5 - std::log10(reynolds) : infinity;
    const double exponent = 3.7 - 0.65 * std::exp(-0.5 * off * off);
    return pi / 8 * s.fluid.viscosity * s.diameter * root * root * std::pow(s.porosity, 1 - exponent);
}

/// F over 3 pi mu d U, U superficial: 10 (1 - eps)/eps^2 + eps^2 (1 + 1.5 sqrt(1 - eps)) + 0.413 Re/(24
/// eps^2) (1/eps + 3 eps (1 - eps) + 8.4 Re^-0.343)/(1 + 10^(3 (1 - eps)) Re^(-(1 + 4 (1 - eps))/2)).
double beetstra(const DragState& s) {
    const double eps = s.porosity, phi = s.solid(), reynolds = s.reynolds(), square = eps * eps;
    double normalised = 10 * phi / square + square * (1 + 1.5 * std::sqrt(phi));
    if (reynolds > 0)
        normalised += 0.413 * reynolds / (24 * square) *
                      (1 / eps + 3 * eps * phi + 8.4 * std::pow(reynolds, -0.343)) /
                      (1 + std::pow(10, 3 * phi) * std::pow(reynolds, -0.5 * (1 + 4 * phi)));
    return stokes(s) * eps * normalised;
}

constexpr Range anyPorosity{0, 1, false, true};

constexpr std::array laws{
    DragLaw{"SchillerNaumann",
            schillerNaumann,
            {0.95, 1},
            1e5,
            "L. Schiller and A. Naumann, Z. VDI 77 (1933) 318: a sphere alone"},
    DragLaw{"Ergun", ergun, {0.3, 0.8}, 1e4, "S. Ergun, Chem. Eng. Prog. 48 (1952) 89: packed beds"},
    DragLaw{"WenYu",
            wenYu,
            {0.4, 1},
            1e5,
            "C. Y. Wen and Y. H. Yu, Chem. Eng. Prog. Symp. Ser. 62 (1966) 100: fluidised beds"},
    DragLaw{"Gidaspow",
            gidaspow,
            {0.3, 1},
            1e4,
            "D. Gidaspow, Multiphase Flow and Fluidization (1994): Ergun below a porosity of 0.8, Wen and Yu "
            "from "
            "there; it jumps there"},
    DragLaw{"DiFelice", diFelice, {0.3, 1}, 1e5, "R. Di Felice, Int. J. Multiphase Flow 20 (1994) 153"},
    DragLaw{"Beetstra",
            beetstra,
            {0.4, 1},
            1000,
            "R. Beetstra, M. A. van der Hoef and J. A. M. Kuipers, AIChE J. 53 (2007) 489: equal spheres"}};

/// The x > 0 of a growing function that gives `wanted`, by halving.
template <class Function>
double rootByHalving(Function&& grows, double wanted) {
    double high = 1;
    while (grows(high) < wanted) high *= 2;
    return turningPoint(0, high, [&](double x) { return grows(x) < wanted; }).fails;
}

}  // namespace

std::span<const DragLaw> dragLaws() { return laws; }

const DragLaw& dragLaw(std::string_view name) {
    std::vector<std::string_view> names;
    for (const DragLaw& law : laws) {
        if (law.name == name) return law;
        names.push_back(law.name);
    }
    unknownName("drag law", name, names);
}

double dragForce(const DragLaw& law, double porosity, double slip, double diameter,
                 const FluidMaterial& fluid) {
    checkFields(fluid);
    checkValue("dragForce()", "porosity", porosity, "", anyPorosity);
    checkValue("dragForce()", "slip", slip, "m/s", notNegative);
    checkValue("dragForce()", "diameter", diameter, "m", positive);
    return law.resistance({porosityOfDrag(porosity), slip, diameter, fluid}) * slip;
}

double terminalSpeed(double diameter, double density, const FluidMaterial& fluid, double gravity) {
    return balancedSpeed(dragLaw("SchillerNaumann"), 1, diameter, density, fluid, gravity);
}

/// The drag of model A is then eps V (rho_s - rho) g: the gradient of the pressure has the rest.
double balancedSpeed(const DragLaw& law, double porosity, double diameter, double density,
                     const FluidMaterial& fluid, double gravity) {
    checkFields(fluid);
    checkValue("balancedSpeed()", "porosity", porosity, "", anyPorosity);
    checkValue("balancedSpeed()", "diameter", diameter, "m", positive);
    checkValue("balancedSpeed()", "density", density, "kg/m^3", {fluid.density, infinity, true, false});
    checkValue("balancedSpeed()", "gravity", gravity, "m/s^2", notNegative);
    DragState state{porosityOfDrag(porosity), 0, diameter, fluid};
    const double weight = volume(state) * (density - fluid.density) * gravity;
    if (weight == 0) return 0;
    return rootByHalving(
        [&](double speed) {
            state.slip = speed / porosity;
            return law.resistance(state) * state.slip;
        },
        porosity * weight);
}

}  // namespace pendular
