#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Friction/Shared/SpringSlider.h"
#include "Kernel/Laws/Friction/Shared/TangentialSpring.h"

namespace pendular {

/// A tangential spring that remembers whether it slides.
template <class T>
struct StickSlipSpring : TangentialSpring<T> {
    T slides;  // 1 or 0, in the last step
};

/// Static and dynamic friction: a spring that sticks breaks loose at the ratio times the dynamic limit, and
/// slides at the dynamic limit until spring and dashpot give less than that.
/// Source: Luding (2008), Granular Matter 10, 235, sliding friction. Law is the law derived from this.
template <class Law>
struct StickSlip {
    double staticFrictionRatio = 1;  // mu_s / mu_d

    static constexpr auto fields() {
        return std::to_array<Field<StickSlip>>(
            {{"staticFrictionRatio", &StickSlip::staticFrictionRatio, "", Range{1, infinity, true, false},
              Mixing::Arithmetic, "static over dynamic coefficient of sliding friction",
              "Luding (2008), sliding friction"}});
    }
    void setStaticFrictionRatio(double value) {
        setField(static_cast<Law&>(*this), &StickSlip::staticFrictionRatio, value);
    }
    [[nodiscard]] double getStaticFrictionRatio() const { return staticFrictionRatio; }

    /// mu_s itself, at least the dynamic coefficient, which must have been set before; 0 goes with 0.
    void setSlidingFrictionCoefficientStatic(double value) {
        const double dynamic = static_cast<const Law&>(*this).slidingFrictionCoefficient;
        if (value == 0 && dynamic == 0) return setStaticFrictionRatio(1);
        if (!(dynamic > 0))
            throw InputError(fmt::format(
                "{}: slidingFrictionCoefficientStatic needs the dynamic coefficient, which is {}; "
                "call setSlidingFrictionCoefficient() before it, with more than 0.",
                Law::name, dynamic));
        checkValue(Law::name, "slidingFrictionCoefficientStatic", value, "",
                   Range{dynamic, infinity, true, false});
        setStaticFrictionRatio(std::max(value / dynamic, 1.0));
    }
    [[nodiscard]] double getSlidingFrictionCoefficientStatic() const {
        return staticFrictionRatio * static_cast<const Law&>(*this).slidingFrictionCoefficient;
    }

    static std::vector<Setter<Law>> setters() {
        return {{"slidingFrictionCoefficientStatic",
                 {{"slidingFrictionCoefficientStatic", "", positive}},
                 "staticFrictionRatio, with the dynamic coefficient, which must be set before and may not be "
                 "greater",
                 [](Law& law, std::span<const double> v) { law.setSlidingFrictionCoefficientStatic(v[0]); },
                 [](const Law& law) { return law.getSlidingFrictionCoefficientStatic(); }}};
    }

    /// @param limit of the sliding contact, N
    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(double ratio, T stiffness, T damping, T limit,
                                                       const Slip<T>& slip, StickSlipSpring<T>& spring) {
        const T threshold = select(spring.slides > T(0), limit, ratio * limit);
        const SliderForce<T> result =
            slideSpring(stiffness, damping, threshold, limit, slip, spring.displacement);
        spring.slides = select(result.slides, T(1), T(0));
        return result;
    }
};

}  // namespace pendular
