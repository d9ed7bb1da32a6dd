#pragma once

#include "Kernel/Laws/Adhesion/Shared/AdhesionRamp.h"

namespace pendular {

/// A ramp of attraction that acts whenever bodies are within its range: it stores energy and loses none.
struct ReversibleAdhesive : AdhesionRamp<ReversibleAdhesive> {
    static constexpr std::string_view name = "ReversibleAdhesive";
    static constexpr std::string_view summary =
        "attraction that falls linearly with the separation, the same on approach and on parting";
    static constexpr std::string_view domain =
        "a model of short-ranged attraction without hysteresis; forces are of one size for all radii";
    static constexpr bool formsAtContact = false;
};

}  // namespace pendular
