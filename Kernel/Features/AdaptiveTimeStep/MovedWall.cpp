#include "Kernel/Features/AdaptiveTimeStep/MovedWall.h"

#include <cmath>

#include "Kernel/Features/AdaptiveTimeStep/UnitSums.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Features/MovingWalls/WallBody.h"

namespace pendular {

bool hasMass(const Wall& wall) {
    if (const Membrane* const membrane = wall.membrane()) return membrane->lightestVertex() < infinity;
    return wall.body() || (wall.drive() && wall.drive()->isPiston());
}

WallMotions::WallMotions(const Wall& wall) {
    const WallBody* const body = wall.body();
    if (!body) {
        shift[0] = (1 / std::sqrt(wall.drive()->asked.mass)) * wall.drivenNormal();
        return;
    }
    centre = body->centre();
    const double root = std::sqrt(body->asked.inertia);
    if (!body->isFree()) {
        (body->turns() ? spin : shift)[0] = (1 / root) * body->asked.axis;
        return;
    }
    const Vector<double>& moments = body->asked.moments;
    for (std::size_t k = 0; k < 3; ++k) {
        shift[k] = (1 / root) * axesOfSpace[k];
        const double moment = dot(moments, axesOfSpace[k]);
        spin[3 + k] = (1 / std::sqrt(moment)) * body->free.orientation.turn(axesOfSpace[k]);
    }
}

WallMotions::Six WallMotions::along(const Vector<double>& direction, const Vector<double>& arm) const {
    Six slip{};
    for (std::size_t k = 0; k < slip.size(); ++k) slip[k] = dot(direction, shift[k] + cross(spin[k], arm));
    return slip;
}

WallMotions::Six WallMotions::about(const Vector<double>& axis) const {
    Six turn{};
    for (std::size_t k = 0; k < turn.size(); ++k) turn[k] = dot(axis, spin[k]);
    return turn;
}

double WallMotions::mobility(const Vector<double>& arm) const {
    double sum = 0;
    for (std::size_t k = 0; k < shift.size(); ++k) sum += squaredNorm(shift[k] + cross(spin[k], arm));
    return sum;
}

double WallMotions::turningMobility() const {
    double sum = 0;
    for (const Vector<double>& one : spin) sum += squaredNorm(one);
    return sum;
}

PressedVertices::PressedVertices(const Membrane& of) : membrane(&of) {
    const std::vector<bool> still = of.getHeld();
    const std::vector<double>& masses = of.getNet().movedMasses();
    for (std::size_t v = 0; v < masses.size(); ++v) mobility.push_back(still[v] ? 0 : 1 / masses[v]);
    for (std::vector<double>* const column : {&loads, &springs, &dashpots}) column->assign(masses.size(), 0);
}

}  // namespace pendular
