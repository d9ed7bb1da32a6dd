#pragma once

#include <string_view>

#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

class Scene;
class StateArchive;

/// The box (m) of a scene in the frames of one output, in which walls without ends are drawn. It holds the
/// particles of all frames so far, walls that have ends, the scene's domain (DomainBox) and the regions of
/// inlets; along a period it is the period. It never shrinks. Where nothing but particles bounds it, it is
/// wider than they are by a quarter of its longest side (upwards, against gravity: of its height), and by
/// half of it where it has become too small. So it is the same in nearly all frames, and changes a few times
/// only in a scene that spreads.
class SceneBox {
public:
    /// Widens the box to the scene as it is. All ranks call it, and get the same box.
    void take(const Scene& scene);
    /// Its highest corner is below its lowest one before anything was there to take.
    [[nodiscard]] const Box& box() const { return taken; }

    void visitState(StateArchive& archive, std::string_view name);

private:
    [[nodiscard]] bool isEmpty() const { return !(taken.lowest.x <= taken.highest.x); }

    Box taken;
};

}  // namespace pendular
