#pragma once

#include "Kernel/Species/Adhesion/DMT.h"
#include "Kernel/Species/Adhesion/IrreversibleAdhesive.h"
#include "Kernel/Species/Adhesion/JKR.h"
#include "Kernel/Species/Adhesion/ReversibleAdhesive.h"

namespace pendular {

/// Whether an adhesion law knows the bodies by their effective radius only, remembers nothing, and is
/// prepared at little cost: contacts of superquadrics, whose radius changes as they turn, prepare it in each
/// step. A law of your own says so by a specialisation.
template <class Law>
inline constexpr bool knowsRadiusOnly = !Law::acts;
template <>
inline constexpr bool knowsRadiusOnly<JKR> = true;
template <>
inline constexpr bool knowsRadiusOnly<DMT> = true;
template <>
inline constexpr bool knowsRadiusOnly<ReversibleAdhesive> = true;
template <>
inline constexpr bool knowsRadiusOnly<IrreversibleAdhesive> = true;

}  // namespace pendular
