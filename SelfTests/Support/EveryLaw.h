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

/// Every adhesion law that is a liquid bridge of constant volume.
template <class Function>
void forEveryBridge(Function&& function) {
    AdhesionLaws::forEach([&]<class Law>() {
        if constexpr (requires(Law law) { law.setLiquidBridgeVolume(0.0); })
            function.template operator()<Law>();
    });
}

}  // namespace pendular::support
