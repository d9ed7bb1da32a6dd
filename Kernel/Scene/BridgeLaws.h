#pragma once

#include "Kernel/Features/Laws.h"
#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

/// An adhesion law that is a liquid bridge of constant volume, and nothing but its capillary force.
template <class Law>
concept BridgeLaw = requires(const Law law, const Bodies bodies) {
    law.scales(bodies);
}
&&!MovesLiquid<Law> && bridgeResists<Law> == BridgeResists::Nothing;

/// Calls `function.template operator()<Law>()` for each bridge law of the kernel.
template <class Function>
void forEachBridgeLaw(Function&& function) {
    AdhesionLaws::forEach([&]<class Law>() {
        if constexpr (BridgeLaw<Law>) function.template operator()<Law>();
    });
}

}  // namespace pendular
