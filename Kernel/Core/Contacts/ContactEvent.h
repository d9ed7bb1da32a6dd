#pragma once

#include <cstdint>
#include <string_view>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// What happened to a contact in a step.
struct ContactEvent {
    enum class Kind : std::uint8_t { TouchBegins, TouchEnds, BridgeForms, BridgeRuptures };
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::uint32_t particle1;  // identity; the lower one
    std::uint32_t particle2;  // `none` at a wall
    int wall;                 // -1: grain with grain
    std::uint32_t part;       // of the wall, e.g. a triangle of a mesh, or several that are one face
    Kind kind;
    /// Of the wall, where a periodic scene repeats it: 0 is the wall itself. A grain may touch a part of two
    /// images at once, which this tells apart; when the grain is brought back, it is another number.
    std::uint32_t image = 0;

    friend auto operator<=>(const ContactEvent&, const ContactEvent&) = default;
};

/// What happened to a contact that is given by its number in the list.
struct ContactChange {
    std::uint32_t contact;
    ContactEvent::Kind kind;
};

/// How many events there have been since the scene began to listen to them.
struct ContactEventCounts {
    std::uint64_t touchesBegun = 0, touchesEnded = 0, bridgesFormed = 0, bridgesRuptured = 0;

    void add(ContactEvent::Kind kind) {
        using Kind = ContactEvent::Kind;
        ++(kind == Kind::TouchBegins   ? touchesBegun
           : kind == Kind::TouchEnds   ? touchesEnded
           : kind == Kind::BridgeForms ? bridgesFormed
                                       : bridgesRuptured);
    }
};

}  // namespace pendular
