#pragma once

#include <vector>

#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/Wear/WearLaw.h"

namespace pendular {

/// What grains have done to a piece of a wall.
struct SurfaceWear {
    double slidingWork = 0;  // J, that friction dissipated in sliding
    double impactWork = 0;   // J, of impacts along the normal
    double impacts = 0;      // how many
    double volume = 0;       // m^3, worn off
    double area = 0;         // m^2, at the start of the run
};

/// A wall that can count what grains wear off it.
class WornWall {
public:
    virtual ~WornWall() = default;

    [[nodiscard]] virtual bool keepsWear() const = 0;
    [[nodiscard]] virtual const WearLaw& wearLaw() const = 0;
    /// Whether its shape follows what is worn off.
    [[nodiscard]] virtual bool movesVertices() const = 0;
    /// Takes note of what a contact of a part of the wall does to it in a step, at a point (m) of the scene.
    /// In the order of identities, from one thread. Throws RunError where the wall cannot wear there.
    virtual void takeWear(std::uint32_t part, const Vector<double>& point, const ContactWear& done) = 0;
    /// Forgets what was noted in a step that failed.
    virtual void forgetStep() = 0;
    /// The step has not failed: at its end (s), what was noted counts. Throws RunError, and changes nothing,
    /// where the shape cannot follow.
    virtual void finishStep(double time) = 0;
    /// The wear of a polygon of its surface().
    [[nodiscard]] virtual const SurfaceWear& wearOf(std::size_t polygon) const = 0;
};

struct NumberedWornWall {
    std::size_t number;
    WornWall* wall;
};

/// The walls that keep their wear, in the order of their numbers.
std::vector<NumberedWornWall> wornWalls(const WallHandler& walls);

/// Throws InputError where a wall keeps its wear and the scene cannot.
/// @param withAccount the scene has an account of the energy; @param withFriction its laws have friction
void refuseWear(const WallHandler& walls, bool withAccount, bool withFriction);

}  // namespace pendular
