#pragma once

#include <cstddef>
#include <type_traits>

namespace pendular {

/// A list of types, to run a generic function for each of them.
template <class... Types>
struct TypeList {
    static constexpr std::size_t size = sizeof...(Types);

    /// Calls `function.template operator()<Type>()` for each type, in order.
    template <class Function>
    static void forEach(Function&& function) {
        (function.template operator()<Types>(), ...);
    }
};

/// The types of a list for which Keep<Type>::value is true, in the same order.
template <template <class> class Keep, class List, class Kept = TypeList<>>
struct FilteredTypes {
    using type = Kept;
};
template <template <class> class Keep, class First, class... Rest, class... Kept>
struct FilteredTypes<Keep, TypeList<First, Rest...>, TypeList<Kept...>>
    : FilteredTypes<Keep, TypeList<Rest...>,
                    std::conditional_t<Keep<First>::value, TypeList<Kept..., First>, TypeList<Kept...>>> {};

}  // namespace pendular
