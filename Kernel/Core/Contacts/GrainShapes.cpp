#include "Kernel/Core/Contacts/GrainShapes.h"

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Walls/Wall.h"

namespace pendular {

ShapedTouch GrainShapes::touchAtWall(const ParticleStore& grains, std::uint32_t grain, const Wall& wall,
                                     std::uint32_t part, double range) const {
    WallPoint point{};
    findPoints(grains, grain, wall, range, {&part, 1}, {&point, 1});
    if (!(point.distance < infinity))  // a grain that touches no walls
        return {point.normal, -grains.translation[grain].radius, {0, 0, 0}, 0};
    return touchAtPlane(grains, grain, point.normal, point.distance);
}

}  // namespace pendular
