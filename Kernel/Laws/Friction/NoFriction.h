#pragma once

#include <array>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// No tangential force: grains without spin, contacts without torque and history.
struct NoFriction {
    static constexpr std::string_view name = "";
    static constexpr std::string_view summary = "none: smooth grains that do not spin";
    static constexpr std::string_view domain = "everywhere";
    static constexpr bool acts = false;

    static constexpr auto fields() { return std::array<Field<NoFriction>, 0>{}; }

    template <class T>
    struct History {};

    struct Prepared {};
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {};
    }

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
