#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// A number that tells, before anything moves, whether two bodies are in the domain of a law. A law that has
/// such numbers has a function domainLimits(bodies), which gives a vector of them.
struct DomainLimit {
    std::string_view quantity;
    double value;
    Range range;  // that the law is made for
    std::string_view unit = {};

    [[nodiscard]] bool holds() const { return range.contains(value); }
    /// "V* = 0.02; it is made for at least 0 and at most 0.001"
    [[nodiscard]] std::string text() const;
};

/// A law whose theory holds for small overlaps only says up to which one: `largestOverlap`, over the
/// effective radius.
template <class Law>
concept HasLargestOverlap = requires {
    { Law::largestOverlap } -> std::convertible_to<double>;
};

/// The share of the smaller radius beyond which two grains end a run; of laws that are made for more it is
/// their number `largestOverlapInRun`.
inline constexpr double usualOverlapInRun = 0.5;
template <class Mixed>
constexpr double largestOverlapInRun() {
    double largest = usualOverlapInRun;
    const auto take = [&]<class Law>() {
        if constexpr (requires { Law::largestOverlapInRun; })
            largest = std::max(largest, Law::largestOverlapInRun);
    };
    take.template operator()<typename Mixed::Normal>();
    take.template operator()<typename Mixed::Friction>();
    take.template operator()<typename Mixed::Adhesion>();
    return largest;
}

/// What to do where two grains end a run by that; laws of which it is no help have their own as
/// `overlapAdvice`.
inline constexpr std::string_view usualOverlapAdvice =
    "take stiffer grains, a smaller time step, or lower speeds and loads";
/// Of laws under which grains grow together at any stiffness and step.
inline constexpr std::string_view sinterOverlapAdvice =
    "they sinter, and their neck is wider than the model holds for; end the run before, let them sinter more "
    "slowly or up to a smaller overlap, or take lower loads";
template <class Mixed>
constexpr std::string_view overlapAdvice() {
    std::string_view advice = usualOverlapAdvice;
    const auto take = [&]<class Law>() {
        if constexpr (requires { Law::overlapAdvice; }) advice = Law::overlapAdvice;
    };
    take.template operator()<typename Mixed::Normal>();
    take.template operator()<typename Mixed::Friction>();
    take.template operator()<typename Mixed::Adhesion>();
    return advice;
}

/// A law's part of what a species is made for.
struct OverlapLimit {
    std::string_view law = {};
    double largest = infinity;  // of the effective radius
};

/// The smallest of the largest overlaps that three laws are made for.
template <class Mixed>
constexpr OverlapLimit overlapLimit() {
    OverlapLimit limit;
    const auto take = [&]<class Law>() {
        if constexpr (HasLargestOverlap<Law>)
            if (Law::largestOverlap < limit.largest) limit = {Law::name, Law::largestOverlap};
    };
    take.template operator()<typename Mixed::Normal>();
    take.template operator()<typename Mixed::Friction>();
    take.template operator()<typename Mixed::Adhesion>();
    return limit;
}

/// Calls function(law's name, limit) for each number of the laws of a pair that is out of their domains.
template <class Mixed, class Function>
void forEachBrokenLimit(const Mixed& laws, const Bodies& bodies, Function&& function) {
    laws.forEachLaw([&]<class Law>(const Law& law) {
        if constexpr (requires { law.domainLimits(bodies); })
            for (const DomainLimit& limit : law.domainLimits(bodies))
                if (!limit.holds()) function(Law::name, limit);
    });
}

}  // namespace pendular
