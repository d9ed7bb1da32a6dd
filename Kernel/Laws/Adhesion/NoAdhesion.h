#pragma once

#include <array>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// No adhesion: dry grains.
struct NoAdhesion {
    static constexpr std::string_view name = "";
    static constexpr std::string_view summary = "none: dry grains";
    static constexpr std::string_view domain = "everywhere";
    static constexpr bool acts = false;
    static constexpr bool formsAtContact = false;

    static constexpr auto fields() { return std::array<Field<NoAdhesion>, 0>{}; }

    template <class T>
    struct Interaction {};

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
