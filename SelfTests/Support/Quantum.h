#pragma once

#include "Kernel/Core/Contacts/ContactSystem.h"

namespace pendular::support {

/// N, to half of which each force on a grain of a radius (m) is rounded before it is added to others; 0 where
/// forces are summed as they are.
template <class Scene>
[[nodiscard]] double quantumOf(const Scene& scene, double radius) {
    const ContactStore& store = scene.contacts().store();
    return store.keepsTotals ? store.totals.quantum.newtons(radius) : 0;
}

}  // namespace pendular::support
