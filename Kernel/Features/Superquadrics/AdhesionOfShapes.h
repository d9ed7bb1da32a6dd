#pragma once

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeSoulie.h"
#include "Kernel/Laws/Adhesion/DMT.h"
#include "Kernel/Laws/Adhesion/IrreversibleAdhesive.h"
#include "Kernel/Laws/Adhesion/JKR.h"
#include "Kernel/Laws/Adhesion/ReversibleAdhesive.h"
#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// Whether an adhesion law acts between superquadrics. Their radii change as they turn, so that it is
/// prepared in each step: it must know nothing but the radii, remember nothing, and be prepared within a
/// microsecond. Of the bridges those are all of constant volume but the ones that are fitted anew for each
/// contact (14 to 140 us). A dry law of your own says so by a specialisation.
template <class Law>
inline constexpr bool actsBetweenShapes =
    !Law::acts || (
                      requires(const Law law, const Bodies bodies) { law.scales(bodies); } &&
                      !requires(const Law law, const Bodies bodies) { law.publishedFor(bodies); } &&
                      !MovesLiquid<Law> && bridgeResists<Law> == BridgeResists::Nothing);
template <>
inline constexpr bool actsBetweenShapes<JKR> = true;
template <>
inline constexpr bool actsBetweenShapes<DMT> = true;
template <>
inline constexpr bool actsBetweenShapes<ReversibleAdhesive> = true;
template <>
inline constexpr bool actsBetweenShapes<IrreversibleAdhesive> = true;
template <>
inline constexpr bool actsBetweenShapes<LiquidBridgeSoulie> = false;  // knows no flat body

}  // namespace pendular
