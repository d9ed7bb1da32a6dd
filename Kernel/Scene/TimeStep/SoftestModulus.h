#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

class Scene;

/// What a run is made for. Each stands another softness of the grains.
enum class WantedFigure {
    SolidFraction,   // also the height of a bed, and the flow from an outlet
    Friction,        // the ratio of stresses, the angle of a slope or a drum
    ContactsAtRest,  // contacts of a grain in a bed at rest
    Fluctuations,    // the kinetic energy of a flow against its mean
    ContactsInFlow,  // they count the time of a touch
    ContactTime,
    ContactArea,  // heat through contacts
    Waves,        // sound, vibration
};

/// The figures by the names that programs take: "solid-fraction", "friction", ...
[[nodiscard]] std::string_view nameOf(WantedFigure figure);
[[nodiscard]] const std::vector<WantedFigure>& allWantedFigures();
/// A figure by its name, with hyphens or underscores. Throws InputError where there is none of this name.
/// @param call that wants it, for the sentence
/// @param offered the figures that it takes, for the sentence
/// @param between words of their names in the sentence, '-' or '_'
[[nodiscard]] WantedFigure wantedFigure(std::string_view name, std::string_view call = "WantedFigure",
                                        std::span<const WantedFigure> offered = allWantedFigures(),
                                        char between = '-');
/// The name with underscores, as in Python: "solid_fraction".
[[nodiscard]] std::string snakeNameOf(WantedFigure figure);

/// What of cohesion is to stay when grains are made softer: not all can.
enum class KeptCohesion {
    NotSaid,
    Strength,    // the pull, so heaps, slopes and drums; grains stick at higher speeds
    Collisions,  // rebound and sticking at every speed; heaps of soft grains are less cohesive
};

struct SoftnessQuestion {
    double modulus = 0;          // Pa, Young's, of the material: more is never advised
    double poissonRatio = 0.25;  // 1
    double density = 0;          // kg/m^3
    double diameter = 0;         // m, of the smallest grains
    double pressure = 0;         // Pa, at the bottom of a heap, of pistons and targets
    double speed = 0;            // m/s, at which grains meet
    double pull = 0;             // N, the largest attraction of a contact
    KeptCohesion kept = KeptCohesion::NotSaid;
    double error = 0.01;  // of the figures, 1
    std::vector<WantedFigure> figures;
};

/// Density and smallest diameter of a scene's grains, and pressure and speed as in estimateOverlaps(). The
/// caller adds the material, the figures and the pull.
/// @param pressure Pa, that acts besides (pistons, target stresses)
[[nodiscard]] SoftnessQuestion softnessOf(Scene& scene, double pressure = 0);

/// One reason why grains may not be softer.
struct SoftnessBound {
    double modulus;  // Pa
    std::string reason;
};

/// A stiffness or a dashpot of a species, or of a pair of them, that is scaled with Young's modulus.
struct ScaledField {
    int first, second;       // indices of species, equal for one alone
    std::string_view field;  // "rollingStiffness"
    double factor;           // for the value that it has now
};

/// The time steps of a scene, by chosenTimeStep(), before and after its grains are made softer.
struct SoftenedStep {
    double before = 0;                // s, with Young's modulus of the material
    double byModuli = 0;              // s, where only the fields in Pa are scaled
    double after = 0;                 // s, where all of `fields` are scaled
    std::vector<ScaledField> fields;  // of all species, those of walls too
    std::vector<std::string> others;  // what else has a stiffness, and how to scale it
};

struct SoftnessAdvice {
    double modulus = 0;                  // Pa, Young's
    std::vector<SoftnessBound> bounds;   // the highest first
    double leastGain = 1, mostGain = 1;  // of the time of a run with the material's modulus
    double adhesionFactor = 1;           // for the work of adhesion of JKR and DMT, or a pull on Hertz's law
    std::optional<SoftenedStep> step;    // of the scene, where there is one

    [[nodiscard]] std::string text() const;
};

/// The softest Young's modulus with which the wanted figures are right to the wanted error.
///
/// A mean contact at a pressure p has the overlap d/D = (3 pi (1 - nu^2) p / (phi Z E))^(2/3) of Hertz's law
/// at the force pi D^2 p / (phi Z) (Rumpf 1958), with phi Z = 2.8. Measured over three decades of E with
/// Hertz-Mindlin spheres of nearly one size and a friction of 0.5 (poured beds, drums, hoppers): the solid
/// fraction grows by 3.4 d/D of itself, angles and friction fall by 11 d/D, contacts at rest are 4.52 + 12
/// (d/D)^0.6, and the energy of fluctuations is still 7 % off at a stiffness (E/((1 - nu^2) p))^(2/3) of 1e4,
/// so 1e6 is asked. 1 % was resolved by these runs; less is an extrapolation. Cohesion adds pull/D^2 to the
/// pressure; where it is the larger part, d/D is at most 1.68e-3 (a stiffness of 1e3 pulls). Overlaps by
/// speed are to be at most 5 % of the radius, the domain of Hertz's law. A user reports that the angle of
/// repose of heaps with rolling friction fell as estimated, by 5.3 % at a quarter and by 9.7 % at a tenth of
/// the modulus; this was not measured here. Nothing is known of wide sizes, clumps, and of beds that are
/// confined to a volume.
///
/// Without a scene the gain is that of contacts by Hertz's law alone: steps go with the root of the modulus.
/// Throws InputError where a number is out of its range, no figure is wanted, or cohesion is there and what
/// is to be kept of it is not given.
[[nodiscard]] SoftnessAdvice softestModulus(const SoftnessQuestion& question);
/// The same for a scene. The gain is that of its own time step, before and after all stiffnesses of its
/// species are scaled. A modulus (Pa) goes with Young's; a stiffness (N/m) with its power 2/3, as Hertz's
/// does at the same force; a dashpot (kg/s) with the root of the stiffness, for the same restitution.
[[nodiscard]] SoftnessAdvice softestModulus(Scene& scene, const SoftnessQuestion& question);

}  // namespace pendular
