#include "Kernel/Mercury/MercuryWalls.h"

#include <fmt/format.h>

#include "Kernel/Base/InputError.h"

namespace pendular {

TriangleWall IntersectionOfWalls::inDomain(const Vec3D& lowest, const Vec3D& highest) const {
    const double diagonal = (highest - lowest).norm();
    if (!(diagonal > 0))
        throw InputError(
            "IntersectionOfWalls: the domain has no width, and faces without end are cut off by it; call "
            "setMin() and setMax(), in m, before the wall is added.");
    TriangleWall wall = forWall;
    wall.set(intersectionOfHalfSpaces(faces, 0.5 * (lowest + highest), diagonal));
    return wall;
}

RigidWall* MercuryWallHandler::getObject(std::size_t number) const {
    auto* const rigid = dynamic_cast<RigidWall*>(&walls->getObject(number));
    if (!rigid)
        throw InputError(fmt::format(
            "WallHandler: wall {} is no rigid wall; keep the pointer that copyAndAddObject() returned.",
            number));
    return rigid;
}

RigidWall* MercuryWallHandler::getLastObject() const {
    for (std::size_t wall = walls->getSize(); wall-- > 0;)
        if (!walls->isRemoved(wall)) return getObject(wall);
    throw InputError("WallHandler: there is no wall.");
}

std::size_t MercuryWallHandler::getNumberOfObjects() const {
    std::size_t count = 0;
    for (std::size_t wall = 0; wall < walls->getSize(); ++wall) count += walls->isRemoved(wall) ? 0 : 1;
    return count;
}

}  // namespace pendular
