#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "Kernel/Core/Walls/RepeatedWall.h"
#include "Kernel/Features/Membranes/MembraneNet.h"
#include "Kernel/Features/Membranes/MembraneSurface.h"

namespace pendular {

/// The places of the vertices of a membrane, and what moves them. One entry for each vertex.
struct MembraneState {
    using Column = std::vector<Vector<double>>;

    Column position, velocity;  // m, m/s
    Column acceleration;        // m/s^2, at the end of the last step; of held ones F / m
    Column earlier;             // m/s^2, at its start; empty before the first step of one that came in a run
    Column ofGrains;            // N, of the contacts
    Column elastic;             // N, of springs and hinges
    Column ofPressure;          // N
    Column impulse;             // N s, of the grains since a host last moved it; empty where none does
    Vector<double> gravity{0, 0, 0};  // m/s^2, that accelerations have
};

/// The work (J) of forces in the last step, for the energy ledger.
struct MembraneWork {
    double byGrains = 0;   // contacts, on all vertices
    double byLoads = 0;    // pressure on all vertices, weight of those that move
    double byHolders = 0;  // what held vertices were given
    double damped = 0;     // lost
    double missing = 0;  // error of the step: what the elastic energy and the motion have, and no force gave
};

/// An elastic membrane of triangles (MembraneNet.h) that touches grains from both sides. Contacts are with
/// its triangles, as at a mesh; their forces and torques go to the corners by barycentric weights.
/// Its vertices are integrated with the grains. It has no thickness for contacts, and does not touch itself:
/// a run ends where a triangle collapses or folds onto its neighbour, or where the membrane goes through
/// itself. A scene that repeats itself repeats it, and joins free edges that lie a period apart
/// (MembraneNet::joinAcross()); whether it goes through its images is not looked at.
class Membrane : public RepeatedWall {
public:
    /// Throws InputError as MembraneNet, and for triangles that go through each other.
    void set(std::span<const Triangle> triangles, const MembraneMaterial& material);
    /// Sets the membrane from a file: STL, OBJ, PLY or rows (readTriangles). @param scale m for one unit of
    /// the file
    void read(const std::filesystem::path& path, const MembraneMaterial& material, double scale = 1) {
        set(readTriangles(path, scale), material);
    }
    [[nodiscard]] bool isSet() const { return net != nullptr; }

    /// From now on, the vertices at places (m; where they are now) for which the function is true move with
    /// this velocity (m/s) and not by forces. It may be called in a run, too, and again for the same ones.
    /// Throws InputError if there is none.
    void hold(const std::function<bool(const Vec3D&)>& where, const Vec3D& velocity = Vec3D::Zero());
    /// Holds all vertices at free edges, as hold() does. Edges that a scene joins to its images are not free.
    void holdRim(const Vec3D& velocity = Vec3D::Zero());
    /// @param value Pa, pushes along the normals (of corners that run counter-clockwise towards the eye);
    /// negative against them. It may be called in a run: it acts from the end of the next step on.
    void setPressure(double value);
    /// Each vertex of mass m and velocity v has the force -rate m v, as in a fluid at rest; at set-up.
    /// @param rate 1/s
    void setDamping(double rate);

    /// These throw InputError before set().
    [[nodiscard]] const MembraneNet& getNet() const {
        if (!isSet()) throw InputError("Membrane: call set() or read() before it is asked for its net.");
        return *net;
    }
    [[nodiscard]] double getPressure() const { return pressure; }
    [[nodiscard]] double getDamping() const { return damping; }
    [[nodiscard]] const std::vector<bool>& getHeld() const { return held; }
    [[nodiscard]] Vec3D getPosition(std::size_t vertex) const { return toEigen(now.position.at(vertex)); }
    [[nodiscard]] Vec3D getVelocity(std::size_t vertex) const { return toEigen(now.velocity.at(vertex)); }
    /// The force (N) of the grains at the end of the last step.
    [[nodiscard]] Vec3D getForceOfGrains(std::size_t vertex) const {
        return toEigen(now.ofGrains.at(vertex));
    }
    /// m^3, inside a closed one whose normals point outwards; an open one is closed by cones from its free
    /// edges to vertex 0.
    [[nodiscard]] double getVolume() const { return getNet().volume(now.position); }
    [[nodiscard]] double getKineticEnergy() const;  // J, of what is not held
    [[nodiscard]] double getElasticEnergy() const;  // J
    /// The mass (kg) of the lightest vertex that moves, with those that move with it; infinite where all are
    /// held
    [[nodiscard]] double lightestVertex() const;
    [[nodiscard]] double squaredFrequency() const { return getNet().squaredFrequency(atRest()); }  // 1/s^2
    [[nodiscard]] double massOfArea() const { return areaDensity; }                                // kg/m^2

    /// Whether a host moves its vertices (HostWall).
    [[nodiscard]] virtual bool isOfHost() const { return false; }

    using Wall::membrane;
    [[nodiscard]] Membrane* membrane() override { return this; }
    [[nodiscard]] std::size_t partCount() const override { return getNet().triangles().size(); }
    [[nodiscard]] bool hasConvexParts() const override { return true; }
    [[nodiscard]] bool canBeRepeated() const override { return true; }
    void repeat(const Vector<double>& lengths) override;
    [[nodiscard]] SurroundingBox surroundings() const override {
        return {shape.around().middle(), 0.5 * (shape.around().highest - shape.around().lowest)};
    }
    void findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] std::optional<Vector<double>> facetNormal(std::uint32_t part) const override {
        return shape.normalOf(partOfShape(part));
    }
    double moveTo(double time) override;
    void join(double time);
    void loseForce(const Vector<double>& force) override;
    [[nodiscard]] WallSurface surface(const SceneSphere& around) const override;
    void visitState(StateArchive& archive) override;

    // Called by MembraneMotion.
    [[nodiscard]] const MembraneState& state() const { return now; }
    /// The vertices go on; the farthest (m) is told by the next moveTo().
    void goOn(MembraneState next, double farthest, int threads = 1);
    /// Forces, velocities and accelerations at the end of the step; the places are those of goOn().
    void finish(MembraneState end) { now = std::move(end), forcesAreOld = false; }
    /// Contacts have ended, or none of its forces are known, since the last step.
    [[nodiscard]] bool hasOldForces() const { return forcesAreOld; }
    [[nodiscard]] TriangleWeights weightsAt(std::size_t triangle, const Vector<double>& point) const;
    /// The place at which the membrane goes through itself, if it does. It is looked for only when vertices
    /// may have come a quarter of the shortest edge nearer to each other since the last look.
    [[nodiscard]] std::optional<MembraneSurface::Crossing> findCrossing();
    MembraneWork work;

protected:
    /// Its vertices are at rest where the net has them.
    void begin(std::shared_ptr<const MembraneNet> of);
    void requireBeforeRun() const;
    [[nodiscard]] MembraneState& changed() { return now; }
    [[nodiscard]] std::vector<bool>& heldOnes() { return held; }

    void listOwn(const Vector<double>& centre, double reach,
                 std::vector<std::uint32_t>& parts) const override {
        shape.listParts(centre, reach, parts);
    }
    void findOwn(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                 std::span<WallPoint> points) const override;
    [[nodiscard]] bool isOwnCrossed(const Vector<double>& from, const Vector<double>& to) const override {
        return shape.isCrossed(from, to);
    }

private:
    [[nodiscard]] std::optional<MembraneSurface::Crossing> crossing() const;
    [[nodiscard]] Vector<double> velocityAt(std::size_t triangle, const Vector<double>& point) const;
    void makeShape();
    /// The vertices that do not move by forces. Those at sides that a scene has still to join to their
    /// images, as after a restart, count as the rim that they were at set-up.
    [[nodiscard]] std::vector<bool> atRest() const;
    /// A vertex is held where one is that moves with it; those at edges that are joined are not rim.
    void holdCopies();

    std::shared_ptr<const MembraneNet> net;  // copies share it
    MembraneMaterial material;
    double areaDensity = 0;  // kg/m^2
    std::vector<bool> held;
    std::vector<bool> heldAsRim;          // by holdRim() alone
    Vector<double> rimVelocity{0, 0, 0};  // m/s
    double pressure = 0;                  // Pa
    double damping = 0;                   // 1/s
    MembraneState now;
    MembraneSurface shape;
    double shifted = 0;    // m, by goOn()
    double unlooked = 0;   // m, that vertices may have come nearer to each other since findCrossing()
    double began = unset;  // s, of the run; not a number before it
    bool forcesAreOld = true;
    std::vector<std::uint8_t> heldAtSetUp;  // by hold(); empty: none
    MembraneState::Column velocityAtSetUp;  // m/s, of these
    double pressureAtSetUp = 0;             // Pa
};

}  // namespace pendular
