#pragma once

#include <type_traits>

#include "Kernel/Scene/BridgeLaws.h"

namespace pendular::support {

/// Calls function.template operator()<Law>() for every law of the kernel.
template <class Function>
void forEveryLaw(Function&& function) {
    NormalLaws::forEach(function);
    FrictionLaws::forEach(function);
    AdhesionLaws::forEach(function);
}

/// Species that stand for all: the laws do not know of each other, so a test of what composes them needs each
/// normal law and each friction law once, dry and with a bridge. All combinations would make the build of the
/// tests grow with the product of the numbers of laws; Composition tests a product of some.
template <class Function>
void forRepresentativeSpecies(Function&& function) {
    NormalLaws::forEach([&]<class N>() { function.template operator()<Species<N, Mindlin, NoAdhesion>>(); });
    FrictionLaws::forEach([&]<class F>() {
        function.template operator()<Species<HertzianViscoelastic, F, LiquidBridgeBagheri>>();
    });
}

/// The same, and each other adhesion law once.
template <class Function>
void forSpeciesWithEveryLaw(Function&& function) {
    forRepresentativeSpecies(function);
    AdhesionLaws::forEach([&]<class A>() {
        if constexpr (A::acts && !std::is_same_v<A, LiquidBridgeBagheri>)
            function.template operator()<Species<HertzianViscoelastic, NoFriction, A>>();
    });
}

}  // namespace pendular::support
