#pragma once

#include "Kernel/Species/Laws.h"

namespace pendular::support {

/// Calls function.template operator()<Law>() for every law of the kernel.
template <class Function>
void forEveryLaw(Function&& function) {
    NormalLaws::forEach(function);
    FrictionLaws::forEach(function);
    AdhesionLaws::forEach(function);
}

/// Calls function.template operator()<S>() for the species of every combination of the kernel's laws.
template <class Function>
void forEverySpecies(Function&& function) {
    NormalLaws::forEach([&]<class N>() {
        FrictionLaws::forEach([&]<class F>() {
            AdhesionLaws::forEach([&]<class A>() { function.template operator()<Species<N, F, A>>(); });
        });
    });
}

/// Every adhesion law that is a liquid bridge of constant volume.
template <class Function>
void forEveryBridge(Function&& function) {
    AdhesionLaws::forEach([&]<class Law>() {
        if constexpr (requires(Law law) { law.setLiquidBridgeVolume(0.0); })
            function.template operator()<Law>();
    });
}

}  // namespace pendular::support
