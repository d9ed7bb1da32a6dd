#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Core/Walls/SurfaceAtFaces.h"
#include "Kernel/Core/Walls/WallSurface.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

class ContactSystem;
class Membrane;
struct WallBody;

/// The point of a part of a wall that is nearest to a sphere.
struct WallPoint {
    Vector<double> normal;    // unit, from the sphere's centre to the wall
    double distance;          // m, from the centre to the surface; infinite: this part is not to be touched
    Vector<double> velocity;  // m/s, of the wall's surface there
    int coveredBy = -1;       // of an infinite distance: the place of the point that stands for it
};

/// The points that are nearest to eight spheres, one lane for each.
struct EightWallPoints {
    Vector<Pack> normal;
    Pack distance;
    Vector<Pack> velocity;
};

/// A side of a facet that no other one shares: where a mesh ends, or has a crack.
struct OpenEdge {
    std::uint32_t part;
    Vector<double> begin, end;  // m
};

/// A plane that does not move, whose surface may run along it.
struct PlaneAtRest {
    HalfSpace grains;                // the side where they are
    Vector<double> surfaceVelocity;  // m/s
};

/// The force of all grains on a wall, and its torque about a point.
struct WallForce {
    Vector<double> force{0, 0, 0};   // N
    Vector<double> torque{0, 0, 0};  // N m
    Vector<double> about{0, 0, 0};   // m
};

/// A wall as the contacts see it. A wall consists of parts (faces of a mesh; one part for a plane or a
/// cylinder); a grain has at most one contact with each. The contact kernel reads wall points only, so that a
/// shape is nothing but these two functions; they run once a rebuild and once a step for the grains near the
/// wall, from several threads.
class Wall {
public:
    virtual ~Wall() = default;

    template <class S>
    void setSpecies(const S* wallSpecies) {
        if (wallSpecies->getIndex() < 0)
            throw InputError(
                "A wall's species was not added to the scene; call setSpecies() with what "
                "speciesHandler.copyAndAddObject() returned.");
        species = wallSpecies->getIndex();
        speciesOwner = wallSpecies->getOwner();
    }
    /// Its number in the scene's speciesHandler; -1 where none was set.
    [[nodiscard]] int getSpeciesIndex() const { return species; }
    /// The handler of its species.
    [[nodiscard]] const SpeciesOwner* getSpeciesOwner() const { return speciesOwner; }

    [[nodiscard]] virtual std::size_t partCount() const { return 1; }
    /// Whether a contact can be with this part, also of an image.
    [[nodiscard]] virtual bool hasPart(std::uint32_t part) const { return part < partCount(); }

    /// Whether each part is a convex body or surface as the grains see it, so that a convex grain is nearest
    /// to it in one place: not of a bowl.
    [[nodiscard]] virtual bool hasConvexParts() const { return false; }

    /// Whether it has no hollow that a body may fit into, so that it touches all spheres of a body at once.
    /// (Of meshes it is supposed.)
    [[nodiscard]] virtual bool isFlat() const { return false; }

    /// Appends the parts that a sphere with this centre may touch while its centre is within `reach` (m) of
    /// them; where the scene repeats the wall, also those of its images.
    virtual void listParts(const Vector<double>& centre, double reach,
                           std::vector<std::uint32_t>& parts) const = 0;

    /// The nearest points of the listed parts to a sphere, all of one sphere at once, so that a wall can
    /// leave out parts that others cover (the edge between two faces).
    /// @param reach m, the radius and the range of the adhesion: parts farther away need not be told apart,
    /// and their distance may be any that is larger
    /// @param points one for each part
    virtual void findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                            std::span<WallPoint> points) const = 0;

    /// Whether the grain touches the wall where it is now; if so, the distance (m) of its centre from the
    /// nearest point of it, and the unit normal there, from the centre into the wall.
    bool getDistanceAndNormal(const SphericalParticle& grain, double& distance, Vec3D& normal) const;

    /// A wall that is nothing but a plane at rest: its points are found for eight grains at once, which gives
    /// the same bits as findPoints().
    [[nodiscard]] virtual std::optional<PlaneAtRest> planeAtRest() const { return {}; }

    /// Whether findEight() knows its points.
    [[nodiscard]] virtual bool findsEight() const { return false; }
    /// What findPoints() finds for eight spheres, with the same bits. Each sphere has one part alone, so that
    /// no other one covers it.
    virtual void findEight(const Vector<Pack>& /*centres*/,
                           const std::array<std::uint32_t, Pack::lanes>& /*parts*/,
                           EightWallPoints& /*points*/) const {}

    /// The unit normal of a part that is a facet of a mesh, which may stand for a curved surface; none for
    /// others.
    [[nodiscard]] virtual std::optional<Vector<double>> facetNormal(std::uint32_t /*part*/) const {
        return {};
    }
    /// The edges at which its facets, if it has any, do not share their sides.
    [[nodiscard]] virtual std::vector<OpenEdge> openEdges() const { return {}; }

    /// Whether a centre that moves straight from one point to the other goes through the surface.
    [[nodiscard]] virtual bool isCrossed(const Vector<double>& /*from*/, const Vector<double>& /*to*/) const {
        return false;
    }

    /// The wall as it is seen by grains that go through the faces of a scene which repeats itself. A shape
    /// that cannot tell says that it goes through them: then only the run finds out.
    [[nodiscard]] virtual SurfaceAtFaces atFaces(const PeriodicFaces& /*faces*/) const {
        return {.passes = true};
    }

    /// Whether the scene repeats it, so that parts of its images have numbers of their own (see WallImages).
    [[nodiscard]] virtual bool isRepeated() const { return false; }
    /// m, how far the image that a grain (its centre, m) meets by a part is from the wall itself.
    [[nodiscard]] virtual Vector<double> imageShift(std::uint32_t /*part*/,
                                                    const Vector<double>& /*centre*/) const {
        return {0, 0, 0};
    }
    /// The part that a grain meets where it met this one, when it has been brought back by a way (m) of whole
    /// periods.
    [[nodiscard]] virtual std::uint32_t partAfter(const Vector<double>& /*way*/, std::uint32_t part) const {
        return part;
    }

    /// Moves the wall to where it is at a time (s); returns how far (m) any point of its surface can have
    /// moved.
    virtual double moveTo(double /*time*/) { return 0; }
    /// The angular velocity (rad/s) with which the surface turns against the grains.
    [[nodiscard]] virtual Vector<double> angularVelocity() const { return {0, 0, 0}; }

    /// How it is moved by the forces on it; null unless it is.
    [[nodiscard]] virtual PlaneDrive* drive() { return nullptr; }
    [[nodiscard]] const PlaneDrive* drive() const { return const_cast<Wall*>(this)->drive(); }

    /// What it is as a body that the forces on it move; null unless it is one.
    [[nodiscard]] virtual WallBody* body() { return nullptr; }
    [[nodiscard]] const WallBody* body() const { return const_cast<Wall*>(this)->body(); }
    [[nodiscard]] bool isMovedByForces() const { return drive() != nullptr || body() != nullptr; }

    /// Itself where it is one whose vertices forces move; else null.
    [[nodiscard]] virtual Membrane* membrane() { return nullptr; }
    [[nodiscard]] const Membrane* membrane() const { return const_cast<Wall*>(this)->membrane(); }

    /// Unit, away from the grains, of a plane that is moved by forces.
    [[nodiscard]] virtual Vector<double> drivenNormal() const { return {0, 0, 0}; }

    /// The wall as polygons, for pictures; a shape that gives none is not seen.
    [[nodiscard]] virtual WallSurface surface(const SceneSphere& /*around*/) const { return {}; }

    /// Sums the forces of the grains on this wall after each step; off by default, because it costs time.
    /// @param about m, the point of the torque
    void keepForces(bool keep = true, const Vec3D& about = Vec3D::Zero());
    [[nodiscard]] bool keepsForces() const { return forcesKept || isMovedByForces(); }
    /// Keeps them also when no force moves the wall any more. What was kept stays.
    void keepForcesFromNowOn() {
        if (!forcesKept) keepForces(true, getTorquePoint());
    }
    /// The force (N) of all grains on the wall at the end of the last step. Throws InputError unless
    /// keepForces() was called or it is moved by forces.
    [[nodiscard]] Vec3D getForce() const {
        requireForces("getForce()");
        return toEigen(kept.force);
    }
    /// N m, about the point given to keepForces(). Throws as getForce().
    [[nodiscard]] Vec3D getTorque() const {
        requireForces("getTorque()");
        return toEigen(kept.torque);
    }
    [[nodiscard]] Vec3D getTorquePoint() const { return toEigen(kept.about); }
    /// A contact has ended between two steps: its force (N) on a wall that is moved by forces acts no longer.
    /// The sum that is left is rounded: the next step, and a restart file, need the sum of the contacts that
    /// there are.
    virtual void loseForce(const Vector<double>& force);

    /// Visits what a run has changed, and what must be as it was when the run began.
    virtual void visitState(StateArchive& archive);

    /// It stands in the place of a wall that was removed.
    [[nodiscard]] virtual bool isRemoved() const { return false; }

private:
    friend class ContactSystem;  // which alone sums the forces

    void requireForces(std::string_view call) const {
        if (!keepsForces()) refuseForces(call);
    }
    [[noreturn]] static void refuseForces(std::string_view call);
    /// @param touches contacts that act
    void setForce(const Vector<double>& force, const Vector<double>& torque, std::uint64_t touches);

    int species = -1;
    const SpeciesOwner* speciesOwner = nullptr;
    WallForce kept;
    bool forcesKept = false;
};

}  // namespace pendular
