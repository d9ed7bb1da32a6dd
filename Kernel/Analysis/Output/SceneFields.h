#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

class ContactLaws;
class ContactSystem;
class ParticleStore;
class Scene;
class SceneBox;
class WallHandler;

/// The grains as points: radius, mass, velocity, spin, force (of contacts and weight), species, whether they
/// are held in place (fixed), identity; with rigid bodies also the body that each is in, and where in it.
/// @tparam Real of the fields; positions are doubles
/// @param withBodies the fields of bodies are there where the store has none, too
template <std::floating_point Real = float>
PolyData grainPoints(const ParticleStore& grains, const ContactLaws& laws, bool withBodies = false);

/// The mean stress in each grain (Pa, tension positive), in the order of identities:
/// sigma = sum over its contacts of l f / V, with the branch l (m) from the centre to the contact point, the
/// force f (N) on the grain and its volume V (m^3). Source: Love, "A Treatise on the Mathematical Theory of
/// Elasticity" (1927); Weber, Bull. Liaison Ponts Chauss. 20 (1966). The contact point lies in the middle of
/// the overlap or of the gap, at a wall, too, where the branch of meanStress() goes to the wall's surface.
/// The grains of a rigid body have the mean stress of the body: with the branches from its centre of mass,
/// over its volume.
template <std::floating_point Real = float>
PolyDataField grainStresses(const ContactSystem& contacts, const ParticleStore& grains,
                            const ContactLaws& laws);

/// The fields of contactLines(), of doubles: a row for each contact that has a force, in the order of
/// identities.
std::vector<PolyDataField> contactFields(const ContactSystem& contacts, const ParticleStore& grains,
                                         const ContactLaws& laws, bool withPoints = false, int threads = 1);

/// The contacts that have a force as lines, from centre to centre (of the nearest image) or to the wall's
/// surface. The first points are the centres of all grains, in the order of identities. The forces are those
/// on particle1; particle2 is -1 at a wall, and wall is -1 between grains.
/// @param threads that observe them; the result does not depend on it
template <std::floating_point Real = float>
PolyData contactLines(const ContactSystem& contacts, const ParticleStore& grains, const ContactLaws& laws,
                      bool withPoints = false, int threads = 1);

/// The walls as polygons, with their numbers and species; see surfacesOf().
PolyData wallPolygons(const WallHandler& walls, const Vector<double>& lowest, const Vector<double>& highest,
                      std::array<bool, 3> isPeriod = {});

/// What a frame shows of a scene.
struct SceneFrame {
    std::size_t step = 0;
    double time = 0;  // s
    PolyData grains;
    std::optional<PolyData> contacts, walls;
    std::optional<PolyData> shapes;    // of grains that are no spheres
    std::optional<PolyData> droplets;  // of sprays, where the scene has any
};

/// Which fields a frame has.
class FrameContent {
public:
    /// A number or a vector of each grain, by its identity.
    using GrainValue =
        std::variant<std::function<double(std::size_t)>, std::function<Eigen::Vector3d(std::size_t)>>;

    bool stress = false, contacts = true, contactPoints = false;
    bool doubles = false;  // fields of 64 bits, not of 32

    /// @param name ends with the unit
    void addField(std::string name, GrainValue valueOf);

    /// Of a scene whose ranks have their own grains only, what this rank has; all call it.
    /// @param box of the earlier frames, in which endless walls are drawn; it is widened to this one
    [[nodiscard]] SceneFrame of(const Scene& scene, SceneBox& box) const;
    /// A single frame.
    [[nodiscard]] SceneFrame of(const Scene& scene) const;

private:
    std::vector<std::pair<std::string, GrainValue>> added;
};

}  // namespace pendular
