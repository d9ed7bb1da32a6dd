#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Friction/Shared/SpringSlider.h"
#include "Kernel/Laws/Friction/Shared/TangentialSpring.h"

namespace pendular {

/// What a contact with rolling and torsion remembers of them: R* times the angle that body 1 has turned
/// against body 2, about axes in the tangential plane and about the normal, as far as the springs hold it.
template <class T>
struct RollingTorsionSpring {
    TangentialSpring<T> rolling;  // m
    T torsion;                    // m

    void turn(const FrameRotation<T>& rotation) { rolling.turn(rotation); }
    /// @param shift m, of R* times the relative turn; @param normal unit
    void move(const Vector<T>& shift, const Vector<T>& normal) {
        const T about = dot(shift, normal);
        rolling.move(shift - about * normal);
        torsion = torsion + about;
    }
};

/// One whose stretch follows the contact radius.
template <class T>
struct FollowingRotationSpring : RollingTorsionSpring<T> {
    T contactRadius;  // m, at the last force
};

/// The lever of a law's rolling or torsion, in effective radii R* = r1 r2 / (r1 + r2), which is r at a wall.
/// Each law has its own, and the numbers of a material mean other torques with another one.
enum class RotationLever { EffectiveRadius = 1, EffectiveDiameter = 2 };

/// The forces of rolling and torsion: the torque on body 1 over R*.
template <class T>
struct RotationForces {
    SliderForce<T> rolling, torsion;
};

/// Springs, dashpots and sliders against rolling and torsion: each gives a force F = -(k s + g v), at most mu
/// times the normal force, of the way s of the lever L times the relative turn, and the torque L F on body 1,
/// the opposite one on body 2: the limit of the torque is mu L F_n, its stiffness k L^2. Law is the law
/// derived from this; it defines its levers, leverOfRolling and leverOfTorsion.
/// Source: Luding (2008), Granular Matter 10, 235, rolling and torsion resistance. The lever of rolling is R*
/// by Thornton et al. (2023), equation 4.9. MercuryDPM, by its sources: FrictionInteraction has 2 R* for both
/// in all states read: 126c08fa (2018) and 57a2e5ea (2020) of kuwt/MercuryDPM_fork, and 55f4a5d3 (2024), with
/// which SelfTests/Mercury compares. MindlinRollingTorsionInteraction has 2 R* for both in 126c08fa, and R*
/// for rolling and 2 R* for torsion in f44a287c (2020, the same fork) and in 55f4a5d3.
template <class Law>
struct RollingTorsion {
    static constexpr bool hasContactTorque = true;
    /// Whether a stiffness of 0 stands for that of the tangential spring; else it is no spring.
    static constexpr bool rotatesAsItSlides = false;

    double rollingStiffness = 0;    // k_r, N/m
    double rollingDissipation = 0;  // g_r, kg/s
    double rollingFrictionCoefficient = 0;
    double torsionStiffness = 0;    // k_o, N/m
    double torsionDissipation = 0;  // g_o, kg/s
    double torsionFrictionCoefficient = 0;

    static constexpr auto fields() {
        using R = RollingTorsion;
        constexpr std::string_view rolling = "Luding (2008), rolling resistance",
                                   torsion = "Luding (2008), torsion resistance";
        constexpr bool ofSliding = Law::rotatesAsItSlides;
        constexpr bool isWideRolling = Law::leverOfRolling == RotationLever::EffectiveDiameter,
                       isWideTorsion = Law::leverOfTorsion == RotationLever::EffectiveDiameter;
        return std::to_array<Field<R>>(
            {{"rollingStiffness", &R::rollingStiffness, "N/m", notNegative, Mixing::Harmonic,
              ofSliding ? "spring constant k_r against rolling; 0: Mindlin's 8 G* a of the contact"
                        : "spring constant k_r against rolling, often 2/7 of the normal one; 0: no rolling "
                          "resistance",
              rolling},
             {"rollingDissipation", &R::rollingDissipation, "kg/s", notNegative, Mixing::Arithmetic,
              "dashpot constant g_r against rolling", rolling},
             {"rollingFrictionCoefficient", &R::rollingFrictionCoefficient, "", notNegative,
              Mixing::Geometric,
              isWideRolling ? "largest torque against rolling over 2 R* and the normal force"
                            : "largest torque against rolling over R* and the normal force",
              isWideRolling ? rolling : "Thornton et al. (2023), equation 4.9"},
             {"torsionStiffness", &R::torsionStiffness, "N/m", notNegative, Mixing::Harmonic,
              ofSliding ? "spring constant k_o against torsion; 0: Mindlin's 8 G* a of the contact"
                        : "spring constant k_o against torsion; 0: no torsion resistance",
              torsion},
             {"torsionDissipation", &R::torsionDissipation, "kg/s", notNegative, Mixing::Arithmetic,
              "dashpot constant g_o against torsion", torsion},
             {"torsionFrictionCoefficient", &R::torsionFrictionCoefficient, "", notNegative,
              Mixing::Geometric,
              isWideTorsion ? "largest torque against torsion over 2 R* and the normal force"
                            : "largest torque against torsion over R* and the normal force",
              torsion}});
    }

    void setRollingStiffness(double value) { set(&RollingTorsion::rollingStiffness, value); }
    void setRollingDissipation(double value) { set(&RollingTorsion::rollingDissipation, value); }
    void setRollingFrictionCoefficient(double value) {
        set(&RollingTorsion::rollingFrictionCoefficient, value);
    }
    void setTorsionStiffness(double value) { set(&RollingTorsion::torsionStiffness, value); }
    void setTorsionDissipation(double value) { set(&RollingTorsion::torsionDissipation, value); }
    void setTorsionFrictionCoefficient(double value) {
        set(&RollingTorsion::torsionFrictionCoefficient, value);
    }
    /// For programs that set it: it must be the dynamic coefficient, which must have been set before, as
    /// springs of rolling and torsion have one coefficient here.
    void setRollingFrictionCoefficientStatic(double value) {
        requireDynamic("rollingFrictionCoefficientStatic", value, rollingFrictionCoefficient);
    }
    void setTorsionFrictionCoefficientStatic(double value) {
        requireDynamic("torsionFrictionCoefficientStatic", value, torsionFrictionCoefficient);
    }
    [[nodiscard]] double getRollingStiffness() const { return rollingStiffness; }
    [[nodiscard]] double getRollingDissipation() const { return rollingDissipation; }
    [[nodiscard]] double getRollingFrictionCoefficient() const { return rollingFrictionCoefficient; }
    [[nodiscard]] double getTorsionStiffness() const { return torsionStiffness; }
    [[nodiscard]] double getTorsionDissipation() const { return torsionDissipation; }
    [[nodiscard]] double getTorsionFrictionCoefficient() const { return torsionFrictionCoefficient; }

    /// A coefficient without a spring would do nothing, in silence.
    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const {
        if (Law::rotatesAsItSlides) return std::nullopt;
        const auto missing = [](std::string_view kind, double stiffness, double coefficient) {
            return stiffness > 0 || coefficient == 0
                       ? std::nullopt
                       : std::optional(fmt::format("{}: {}FrictionCoefficient = {} has no effect, because "
                                                   "{}Stiffness = 0 N/m; it must be greater than 0 N/m.",
                                                   Law::name, kind, coefficient, kind));
        };
        const auto found = missing("rolling", rollingStiffness, rollingFrictionCoefficient);
        return found ? found : missing("torsion", torsionStiffness, torsionFrictionCoefficient);
    }

    /// With the lever R*: a lever of n R* is the same torque as n^2 times the spring and the dashpot and n
    /// times the coefficient, also where the slider slides.
    struct PreparedSlider {
        double stiffness;       // N/m
        double damping;         // kg/s
        double coefficient;     // of friction
        double shareOfSliding;  // of the stiffness of the tangential spring, which adds to it
    };
    struct PreparedRotation {
        PreparedSlider rolling, torsion;
    };
    [[nodiscard]] PreparedRotation prepareRotation() const {
        const auto prepared = [](RotationLever lever, double stiffness, double damping, double coefficient) {
            const auto n = static_cast<double>(lever);
            return PreparedSlider{n * n * stiffness, n * n * damping, n * coefficient,
                                  Law::rotatesAsItSlides && stiffness == 0 ? n * n : 0};
        };
        return {
            prepared(Law::leverOfRolling, rollingStiffness, rollingDissipation, rollingFrictionCoefficient),
            prepared(Law::leverOfTorsion, torsionStiffness, torsionDissipation, torsionFrictionCoefficient)};
    }

    /// The torque on body 1 over R* (N), by its two parts.
    /// @param sliding N/m, of the tangential spring; @param normal unit, from body 1 to body 2; @param
    /// turning of R* times the relative spin
    template <class T>
    [[gnu::always_inline]] static RotationForces<T> turnSprings(const PreparedRotation& p, T sliding,
                                                                T normalForce, const Vector<T>& normal,
                                                                const Slip<T>& turning,
                                                                RollingTorsionSpring<T>& spring) {
        const T limit = max(normalForce, T(0));
        Slip<T> torsion = turning, rolling = turning;
        torsion.velocity = dot(turning.velocity, normal) * normal;
        rolling.velocity = turning.velocity - torsion.velocity;
        Vector<T> twist = spring.torsion * normal;
        const RotationForces<T> forces{
            turnSpring(p.rolling, sliding, limit, rolling, spring.rolling.displacement),
            turnSpring(p.torsion, sliding, limit, torsion, twist)};
        spring.torsion = dot(twist, normal);
        return forces;
    }

private:
    static void requireDynamic(std::string_view field, double value, double dynamic) {
        if (value != dynamic)
            throw InputError(
                fmt::format("{}: {} = {} is not allowed; it must be the dynamic coefficient, {}, as rolling "
                            "and torsion have one coefficient here.",
                            Law::name, field, value, dynamic));
    }
    template <class T>
    [[gnu::always_inline]] static SliderForce<T> turnSpring(const PreparedSlider& p,
                                                            [[maybe_unused]] T sliding, T normalForce,
                                                            const Slip<T>& slip, Vector<T>& spring) {
        const T limit = p.coefficient * normalForce;
        T stiffness = p.stiffness;
        if constexpr (Law::rotatesAsItSlides) stiffness = fma(T(p.shareOfSliding), sliding, stiffness);
        return slideSpring(stiffness, T(p.damping), limit, limit, slip, spring);
    }
    void set(double RollingTorsion::*member, double value) {
        setField(static_cast<Law&>(*this), member, value);
    }
};

}  // namespace pendular
