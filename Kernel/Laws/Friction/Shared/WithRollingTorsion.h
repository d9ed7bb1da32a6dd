#pragma once

#include "Kernel/Laws/Concepts/JoinedName.h"
#include "Kernel/Laws/Friction/Shared/RollingTorsionFriction.h"

namespace pendular {

/// The names of a tangential law with rolling and torsion: MindlinIncremental becomes
/// MindlinIncrementalRollingTorsion.
template <class Tangential>
struct RollingTorsionNames {
    static constexpr std::string_view
        suffix = "RollingTorsion",
        springs = ", with springs against rolling (lever R*) and torsion (lever 2 R*)";

    static constexpr std::string_view name = JoinedName<Tangential::name, suffix>::value;
    static constexpr std::string_view summary = JoinedName<Tangential::summary, springs>::value;
};

/// Any friction law, also one of a driver, with springs against rolling and torsion: see
/// RollingTorsionFriction. The levers are those of MindlinRollingTorsion, so that its numbers mean the same
/// torques here.
template <FrictionLaw Tangential>
requires(Tangential::acts && !HasContactTorque<Tangential>) struct WithRollingTorsion
    : RollingTorsionFriction<WithRollingTorsion<Tangential>, Tangential> {
    static constexpr std::string_view name = RollingTorsionNames<Tangential>::name;
    static constexpr std::string_view summary = RollingTorsionNames<Tangential>::summary;
    static constexpr RotationLever leverOfRolling = RotationLever::EffectiveRadius,
                                   leverOfTorsion = RotationLever::EffectiveDiameter;

    // The setters are those of the tangential law, made again so that a refusal names this law.
    void setSlidingFrictionCoefficient(double value) requires requires(Tangential law) {
        law.setSlidingFrictionCoefficient(value);
    }
    { setField(*this, &WithRollingTorsion::slidingFrictionCoefficient, value); }
    void setSlidingDissipation(double value) requires requires(Tangential law) {
        law.setSlidingDissipation(value);
    }
    { setField(*this, &WithRollingTorsion::slidingDissipation, value); }
    void setSlidingStiffness(double value) requires requires(Tangential law) {
        law.setSlidingStiffness(value);
    }
    { setField(*this, &WithRollingTorsion::slidingStiffness, value); }
    void setEffectiveShearModulus(double value) requires requires(Tangential law) {
        law.setEffectiveShearModulus(value);
    }
    { setField(*this, &WithRollingTorsion::effectiveShearModulus, value); }
    void setSpringFactor(double value) requires requires(Tangential law) { law.setSpringFactor(value); }
    { setField(*this, &WithRollingTorsion::springFactor, value); }
};

}  // namespace pendular
