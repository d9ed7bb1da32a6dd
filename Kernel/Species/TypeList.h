#pragma once

#include <cstddef>

namespace pendular {

/// A list of types, to run a generic function for each of them.
template <class... Types>
struct TypeList {
    static constexpr std::size_t size = sizeof...(Types);

    /// Calls function.template operator()<Type>() for each type, in order.
    template <class Function>
    static void forEach(Function&& function) {
        (function.template operator()<Types>(), ...);
    }
};

}  // namespace pendular
