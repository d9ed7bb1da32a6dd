#pragma once

/// MercuryDPM's names for what a driver's species block uses, so that such a block compiles after a change of
/// its include. MercuryScene.h has those of the rest of a driver.

#include <numbers>

#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Laws/Species/TimeStepAdvice.h"
#include "Kernel/Scene/Simulation.h"

using Mdouble = double;
/// Any grain has a film where liquid moves.
using LiquidFilmParticle = pendular::SphericalParticle;
/// How contacts sinter: species->setSinterType(SINTERTYPE::CONSTANT_RATE).
struct SINTERTYPE {
    static constexpr auto PARHAMI_MCKEEPING = pendular::SinterType::GrainBoundaryDiffusion,
                          CONSTANT_RATE = pendular::SinterType::ConstantRate;
};

/// The levels of logger(INFO, "{} grains", number). What MercuryDPM logs as ERROR or FATAL ends its program:
/// throw an InputError or a RunError.
inline constexpr pendular::LogLevel WARN = pendular::LogLevel::Warn, INFO = pendular::LogLevel::Info,
                                    DEFAULT = pendular::LogLevel::Info, VERBOSE = pendular::LogLevel::Verbose,
                                    DEBUG = pendular::LogLevel::Debug;

namespace constants {
inline constexpr double pi = std::numbers::pi;
inline constexpr double sqrt_2 = std::numbers::sqrt2;
inline constexpr double sqrt_3 = std::numbers::sqrt3;
inline constexpr double sqrt_pi = 1 / std::numbers::inv_sqrtpi;
inline constexpr double degree = std::numbers::pi / 180;
}  // namespace constants

namespace helpers {

/// @param radius m; @param shearModulus Pa; @param density kg/m^3. Returns s.
inline double getRayleighTime(double radius, double shearModulus, double poissonRatio, double density) {
    return pendular::rayleighTime(radius, shearModulus, poissonRatio, density);
}
/// @param mass1 kg; @param mass2 kg. Returns m1 m2 / (m1 + m2), kg.
inline double getEffectiveMass(double mass1, double mass2) { return mass1 * mass2 / (mass1 + mass2); }
/// @param elasticModulus Pa. Returns the effective modulus of two bodies of this material, Pa.
inline double computeEffectiveElasticModulus(double elasticModulus, double poissonRatio) {
    return pendular::computeEffectiveElasticModulus(elasticModulus, poissonRatio);
}

}  // namespace helpers

using namespace pendular;  // NOLINT(google-global-names-in-headers): MercuryDPM's names are global
