#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeCurve.h"

namespace pendular {

/// What one contact remembers of a bridge whose published force needs trigonometric functions or the solution
/// of an equation at each separation: its curve as a rational function, fitted once.
template <class T>
struct FittedBridgeInteraction {
    RationalBridge<T> curve;  // N
    T ruptureDistance;        // m

    [[nodiscard]] T force(T separation) const { return curve.at(separation); }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The published force of one bridge. Lengths are in R, forces in R gamma.
struct PublishedBridge {
    std::function<double(double)> force;  // F(S); called for growing S
    double ruptureDistance;
};

/// The volumes V* for which eight terms follow a published curve to 1 %.
inline constexpr double leastFittedVolume = 1e-9, mostFittedVolume = 1;

FittedBridgeInteraction<double> fitBridge(const PublishedBridge& bridge, const BridgeScales& scales,
                                          double surfaceTension);

/// Why a published curve cannot be used, if so: a volume outside of the box, no rupture distance, or a force
/// that does not attract all the way. One sentence.
std::optional<std::string> objectionToFit(std::string_view law, const PublishedBridge& bridge,
                                          const BridgeScales& scales, double contactAngle);

/// The bridge of solutions that are found one from the other for growing gaps: it ends at `most`, or before,
/// where there is no solution or its force no longer attracts; ruptureDistance 0 if that is so at contact.
/// @param solutions copyable, with at(gap) -> std::optional<Solution>
template <class Solutions, class Solution>
PublishedBridge attractiveBridge(Solutions solutions, double (Solution::*force)() const, double most) {
    const auto first = solutions.at(0);
    if (!first || !(((*first).*force)() > 0)) return {[](double) { return 0.0; }, 0};
    Solutions walking = solutions;
    const auto attracts = [&](double gap) {
        Solutions trial = walking;
        const auto solution = trial.at(gap);
        if (!solution || !(((*solution).*force)() > 0)) return false;
        walking = trial;
        return true;
    };
    double reached = 0, step = most / 16;
    while (reached < most && step > 1e-7 * most) {
        const double next = std::min(reached + step, most);
        if (attracts(next)) reached = next;
        else step *= 0.5;
    }
    return {[solutions, force, last = *first](double gap) mutable {
                last = solutions.at(gap).value_or(last);  // within a rounding error of the end
                return (last.*force)();
            },
            reached};
}

/// The rupture distance of Lian, Thornton and Adams, J. Colloid Interface Sci. 161 (1993) 138-147, equation
/// 16: (1 + theta/2) V^(1/3).
inline double lianRupture(double volume, double contactAngle) {
    return (1 + 0.5 * contactAngle) * std::cbrt(volume);
}

/// The parts of a law that is fitted. Model has published(V*), or published(bodies): the PublishedBridge.
template <class Model>
struct FittedBridge : LiquidBridge<Model> {
    template <class T>
    using Interaction = FittedBridgeInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return {{{}, 0, 1}, 0};
        const BridgeScales scales = this->scales(bodies);
        return fitBridge(publishedFor(bodies), scales, this->surfaceTension);
    }
    [[nodiscard]] double range(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return 0;
        const BridgeScales scales = this->scales(bodies);
        return scales.radius * publishedFor(bodies).ruptureDistance;
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (this->liquidBridgeVolume == 0) return std::nullopt;
        if (auto angle = LiquidBridge<Model>::objection(bodies)) return angle;
        const BridgeScales scales = this->scales(bodies);
        return objectionToFit(Model::name, publishedFor(bodies), scales, this->contactAngle);
    }

    /// The published curve of the bridge between the bodies, which is fitted.
    [[nodiscard]] PublishedBridge publishedFor(const Bodies& bodies) const {
        if constexpr (requires(const Model law) { law.published(bodies); }) return model().published(bodies);
        else return model().published(this->scales(bodies).volume);
    }

private:
    const Model& model() const { return static_cast<const Model&>(*this); }
};

}  // namespace pendular
