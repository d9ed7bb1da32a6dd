#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/ContactSpot.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What one contact remembers of the JKR attraction, and its force: what JKR's theory is below Hertz's at the
/// same overlap d (negative where the neck is stretched), so that the normal law's elastic force less this
/// one is JKR's.
///
/// With the contact radius a = a_0 x^2, a_0 = (9 pi w R*^2 / (2 E*))^(1/3) that without load:
///     d R* / a_0^2 = x^4 - 2 x / 3,    F / F_c = 4 (x^6 - x^3),    F_c = 3/2 pi w R*,
/// from the end of the stable branch, x_m = 6^(-1/3), on. In y = x - x_m the first is
/// y^2 (y^2 + 4 x_m y + 6 x_m^2) = d R* / a_0^2 - x_m^4 + 2 x_m / 3, whose root is simple also at the end:
/// three steps of Newton's method on the root of both sides find y to 3e-11 of it at every overlap.
template <class T>
struct JKRInteraction {
    T pullOffForce;   // F_c, N
    T inverseLength;  // R* / a_0^2, 1/m
    T largestReach;   // m, of the neck

    static constexpr double end = 0.5503212081491045;    // x_m
    static constexpr double reach = 0.2751606040745522;  // 2 x_m / 3 - x_m^4 = x_m / 2

    /// @param separation m, negative where the bodies overlap
    [[nodiscard]] T force(T separation) const {
        const T overlap = T(0) - separation * inverseLength;
        const T hertz = max(overlap, T(0));
        const T x = neck(overlap), cube = x * x * x;
        return T(4) * pullOffForce * (hertz * sqrt(hertz) + cube * (T(1) - cube));
    }
    [[nodiscard]] T range() const { return largestReach; }
    /// a / a_0 = x^2 at a separation.
    [[nodiscard]] T squaredNeck(T separation) const {
        const T x = neck(T(0) - separation * inverseLength);
        return x * x;
    }

private:
    /// x at an overlap in units of a_0^2 / R*.
    static T neck(T overlap) {
        const T root = sqrt(max(overlap + T(reach), T(0)));
        T y = root / sqrt(T(6 * end * end) + T(1.1) * root);  // right at both ends, else to 0.1
        for (int k = 0; k < 3; ++k) {
            const T square = y * (y + T(4 * end)) + T(6 * end * end);
            y = y - (y * square - root * sqrt(square)) / (square + y * (y + T(2 * end)));
        }
        return y + T(end);
    }
};

/// The adhesion of soft, sticky spheres: a neck that forms at the first touch and holds until it snaps at a
/// separation. With a Hertzian normal law of the same E* the sum of the two is JKR's force, whose largest
/// pull is 3/2 pi w R*; with any other normal law it is an attraction that depends on the overlap like JKR's.
/// The dashpot is the normal law's: it vanishes with the overlap, and the neck is not damped.
/// Source: Johnson, Kendall and Roberts (1971), Proc. R. Soc. A 324, 301; the snap at a fixed displacement:
/// Johnson, Contact Mechanics, section 5.5.
struct JKR {
    static constexpr std::string_view name = "JKR";
    static constexpr std::string_view summary =
        "adhesion of soft spheres (Johnson, Kendall and Roberts), pull-off at 3/2 pi R* w";
    static constexpr std::string_view domain =
        "with a Hertzian normal law; Tabor's number (R* w^2 / (E*^2 z_0^3))^(1/3) above about 5; friction is "
        "limited by the Hertzian part of the force, and ends where the overlap does";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = true;
    static constexpr bool readsOverlap = true;
    static constexpr bool jumpsAtEnds = true;  // by 8/9 of the pull-off force at the touch, 5/9 at the snap
    static constexpr double largestOverlap = 0.1;  // of the effective radius, as in Hertz's theory

    double workOfAdhesion = unset;   // w, J/m^2
    double adhesionModulus = unset;  // E*, Pa

    static constexpr auto fields() {
        return std::to_array<Field<JKR>>(
            {{"workOfAdhesion", &JKR::workOfAdhesion, "J/m^2", notNegative, Mixing::Geometric,
              "work w to part the two surfaces, gamma1 + gamma2 - gamma12; 0 is none",
              "Johnson, Kendall and Roberts (1971)"},
             {"adhesionModulus", &JKR::adhesionModulus, "Pa", positive, Mixing::Harmonic, "E* of the neck",
              "Johnson, Kendall and Roberts (1971)", "effectiveElasticModulus of a Hertzian normal law"}});
    }

    void setWorkOfAdhesion(double value) { setField(*this, &JKR::workOfAdhesion, value); }
    void setAdhesionModulus(double value) { setField(*this, &JKR::adhesionModulus, value); }
    [[nodiscard]] double getWorkOfAdhesion() const { return workOfAdhesion; }
    [[nodiscard]] double getAdhesionModulus() const { return adhesionModulus; }

    /// E* of a Hertzian normal law, where the user has not set it.
    template <class Normal>
    void deriveUnset(const Normal& normal) {
        if constexpr (requires { normal.getEffectiveElasticModulus(); })
            if (!isSet(adhesionModulus)) adhesionModulus = normal.getEffectiveElasticModulus();
    }

    template <class T>
    using Interaction = JKRInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (workOfAdhesion == 0) return {0, 0, 0};
        const double radius = bodies.effectiveRadius(), length = overlapScale(radius);
        return {.pullOffForce = 1.5 * std::numbers::pi * workOfAdhesion * radius,
                .inverseLength = 1 / length,
                .largestReach = Interaction<double>::reach * length};
    }
    /// Of the contact radius a, which at equal force goes with the modulus as Hertz's: F_c has none.
    [[nodiscard]] ContactSpot neckAt(const Bodies& bodies, double overlap) const {
        const double radius = bodies.effectiveRadius();
        if (workOfAdhesion == 0) return {std::sqrt(radius * std::max(overlap, 0.0)), true};
        const double zeroLoadRadius = std::sqrt(overlapScale(radius) * radius);  // a_0
        return {zeroLoadRadius * prepare(bodies).squaredNeck(-overlap), true};
    }
    /// m
    [[nodiscard]] double range(const Bodies& bodies) const {
        return Interaction<double>::reach * overlapScale(bodies.effectiveRadius());
    }

private:
    /// a_0^2 / R* (m) at an effective radius (m).
    [[nodiscard]] double overlapScale(double radius) const {
        const double zeroLoadRadius =
            std::cbrt(4.5 * std::numbers::pi * workOfAdhesion * radius * radius / adhesionModulus);
        return zeroLoadRadius * zeroLoadRadius / radius;
    }
};

}  // namespace pendular
