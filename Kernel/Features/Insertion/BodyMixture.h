#pragma once

#include <span>
#include <variant>
#include <vector>

#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Features/Superquadrics/SuperquadricGrain.h"

namespace pendular {

class GrainShapes;
struct InsertionScene;
class ParticleHandler;
class StateArchive;

/// Balls (m) about the origin, made larger by a factor, turned and brought to a place (m).
std::vector<Ball> placedBalls(std::span<const Ball> balls, double scale, const Vector<double>& place,
                              const Eigen::Quaterniond& turn);

/// One kind of bodies of a mixture: grains, clumps of one template, or superquadrics of one shape. Sizes are
/// diameters (m) of grains, and of the spheres that have the volume of a clump or a superquadric.
struct BodyKind {
    std::variant<SphericalParticle, Clump, SuperquadricGrain> like;  // species and motion of all of them
    SizeDistribution sizes;
    double share;  // of the number, to be divided by the sum of all

    [[nodiscard]] const SphericalParticle* grain() const { return std::get_if<SphericalParticle>(&like); }
    [[nodiscard]] const Clump* clump() const { return std::get_if<Clump>(&like); }
    [[nodiscard]] const SuperquadricGrain* shaped() const { return std::get_if<SuperquadricGrain>(&like); }
    /// "grain", "clump" or "superquadric"
    [[nodiscard]] std::string_view word() const;
    /// How the first one is turned; grains are not.
    [[nodiscard]] Eigen::Quaterniond orientation() const;
    [[nodiscard]] int species() const;
    [[nodiscard]] Vector<double> velocity() const;  // m/s
    /// m^3, the liquid of the film of one grain; all others come dry.
    [[nodiscard]] double film() const;
    /// kg/m^3, mass over volume. @param ofSpecies kg/m^3
    [[nodiscard]] double density(double ofSpecies) const;
    /// The factor of all lengths of one that has the volume of a sphere of this radius (m).
    [[nodiscard]] double scale(double radius) const;
    /// m, of the smallest and of the largest sphere of a body of a size; of a superquadric that around it.
    [[nodiscard]] double smallestSphere(double radius) const;
    [[nodiscard]] double largestSphere(double radius) const;
    /// m, from the centre of a body of a size to its farthest point.
    [[nodiscard]] double reach(double radius) const;
    /// The spheres of a body of a size (m), which is turned from its template to a place (m); of a
    /// superquadric that around it.
    [[nodiscard]] std::vector<Ball> spheres(double radius, const Vector<double>& place,
                                            const Eigen::Quaterniond& turn) const;
    /// Refuses a restart file of another kind of bodies.
    void compareSetUp(StateArchive& archive) const;
    /// Adds such a body to a scene. @param flow m/s, that its velocity gets besides its own
    void addTo(const InsertionScene& scene, double radius, const Vector<double>& place,
               const Eigen::Quaterniond& turn, const Vector<double>& flow) const;
};

/// Grains, clumps and superquadrics of several kinds, each with its share, its sizes, its species and its
/// velocity: for insert() and inlets.
class BodyMixture {
public:
    /// @param basis what shares count: bodies (Number) or their volumes (Volume). Throws InputError for
    /// another one.
    explicit BodyMixture(SizeBasis basis = SizeBasis::Number);

    /// Throws InputError unless the share, in any unit, is positive, and without a species.
    void add(const SphericalParticle& like, const SizeDistribution& sizes, double share = 1);
    void add(const Clump& like, const SizeDistribution& sizes, double share = 1);
    void add(const SuperquadricGrain& like, const SizeDistribution& sizes, double share = 1);

    [[nodiscard]] bool empty() const { return kinds.empty(); }
    [[nodiscard]] std::size_t size() const { return kinds.size(); }
    [[nodiscard]] const BodyKind& operator[](std::size_t number) const { return kinds[number]; }
    [[nodiscard]] auto begin() const { return kinds.begin(); }
    [[nodiscard]] auto end() const { return kinds.end(); }

    // Called by the scene, not by drivers.

    /// Whether there are others than grains.
    [[nodiscard]] bool hasBodies() const;
    /// The share of a kind of the number of bodies; all are 1.
    [[nodiscard]] double shareOf(std::size_t number) const;
    /// The kind of one body drawn at random, the same for the same seed and identity.
    [[nodiscard]] std::size_t draw(const CountedRandom& random, std::uint64_t identity) const;
    /// kg, of one body
    [[nodiscard]] double meanMass(const ParticleHandler& particles) const;
    /// How many of so many bodies each kind gets: the whole part of its share, and one more where the
    /// remainder is largest.
    [[nodiscard]] std::vector<std::size_t> counts(std::size_t bodies) const;

private:
    void add(BodyKind kind);

    SizeBasis basis;
    std::vector<BodyKind> kinds;
};

/// Tells a scene of the shapes that are to come. Throws InputError if it takes none.
/// @param shapes of the scene; null: it takes none
void requireShapes(const BodyMixture& mixture, GrainShapes* shapes, std::string_view who);

/// kg/m^3, of a species of a scene. Throws InputError if there is none.
[[nodiscard]] double densityOf(const ParticleHandler& particles, int species);

/// Evenly among all turns, from three numbers even in [0, 1). Source: Shoemake, "Uniform random rotations",
/// Graphics Gems III (1992) 124.
Eigen::Quaterniond evenTurn(double a, double b, double c);

}  // namespace pendular
