#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Features/Inlets/RegionInFlow.h"
#include "Kernel/Features/Outlets/GrainTally.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"

namespace pendular {

class ContactSystem;

/// A place at which grains leave a scene: each one whose centre is in a region, or beyond a plane, at the end
/// of a step is counted and removed; in a scene that repeats itself, each one of which an image is there. A
/// rigid body goes as a whole, when its centre of mass is there, and counts as one. Grains and bodies that
/// are held in place altogether stay; those that are held along some axes go.
class Outlet {
public:
    /// Lets grains in a region go.
    template <std::derived_from<Region> R>
    void setRegion(const R& where) {
        region = std::make_shared<const R>(where);
    }
    /// Lets grains beyond a plane go: on the side to which its normal points.
    /// @param normal of any length; @param point on it, m
    void setPlane(const Vec3D& normal, const Vec3D& point);
    /// Borders (m) between the classes of diameters by which grains are counted; one class without them. A
    /// rigid body has the diameter of the sphere of its volume.
    void setSizeClasses(std::span<const double> diameters) { tally.setClasses(diameters); }
    /// s: only those go that have been in the scene at least so long. What is there when the run begins came
    /// then.
    void setLeastAge(double age);
    /// Lets only those go for which the function is true. It is asked in the order of identities, on one
    /// thread, only for grains that would go without it, and of a rigid body for its first grain. A restart
    /// file cannot keep a function: it keeps that there is one, and a scene without it does not go on. On
    /// several ranks each asks for its own grains, before any of them go: the answer may depend on the grain
    /// alone.
    void setCondition(std::function<bool(const GrainReference&)> function);

private:
    friend class OutletHandler;

    [[nodiscard]] bool takes(const Vector<double>& point) const {
        return region ? region->contains(fromRegion.wrap(point), 0) : dot(normal, point) > offset;
    }

    std::shared_ptr<const Region> region;  // none: a plane
    PeriodicBox fromRegion;                // the scene's, from the lowest corner of the region
    RegionInFlow inFlow;
    bool hasPlane = false;
    Vector<double> normal{0, 0, 0};  // unit
    double offset = 0;               // m
    double leastAge = 0;             // s
    std::function<bool(const GrainReference&)> condition;
    GrainTally tally;
};

/// The outlets of a scene. A grain goes through the first of them that takes it.
class OutletHandler {
public:
    /// At set-up only. Returns the outlet's number. Throws InputError if it has no place.
    std::size_t copyAndAddObject(const Outlet& outlet);
    [[nodiscard]] std::size_t getSize() const { return outlets.size(); }
    [[nodiscard]] bool isEmpty() const { return outlets.empty(); }
    /// What has gone through an outlet. Throws InputError if there is none.
    [[nodiscard]] const GrainTally& countOf(std::size_t outlet) const;
    /// What has gone through all outlets.
    [[nodiscard]] std::uint64_t removedNumber() const;
    [[nodiscard]] double removedMass() const;  // kg

    // Called by the scene, not by drivers.

    /// The run begins. Throws InputError for a region that is longer than the period, and for a plane across
    /// which the scene repeats itself: all grains have images beyond it.
    /// @param atSetUp the periodic box then, which strain changes
    void begin(const PeriodicBox& atSetUp, const ParticleStore& grains, double time);
    /// Lets grains out at the end of a step, at a time (s), in the order of identities, from all ranks.
    /// Returns the energies (J) that were stored in their contacts, where ranks share the grains. Throws
    /// RunError where the scene has become shorter than a region.
    std::vector<double> letOut(ParticleHandler& particles, BodyHandler& bodies, ContactSystem& contacts,
                               const PeriodicBox& periodic, double time, int threads);
    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive);

private:
    struct Leaving {
        std::uint32_t identity;  // of a rigid body, that of its first grain
        std::uint32_t outlet;
        std::uint32_t body = RigidBodies::none;  // its number
        auto operator<=>(const Leaving&) const = default;
    };
    /// All grains whose identity is below `next` had come by a time. (Identities rise with the time.)
    struct Arrival {
        double time;  // s
        std::uint32_t next;
    };

    /// Regions know where the images are now.
    void follow(const PeriodicBox& periodic, double time);
    void noteArrivals(std::uint32_t next, double time);
    /// The first arrival that is not so old (s) yet at a time (s).
    [[nodiscard]] std::vector<Arrival>::const_iterator firstYoung(double age, double time) const;
    /// The first identity that came too late: it and later ones are too young for an outlet at a time (s).
    [[nodiscard]] std::uint32_t firstTooYoung(const Outlet& outlet, double time) const;
    /// Grains that are in no rigid body, on all threads; then the bodies.
    /// @param tooYoung of each outlet, as of firstTooYoung()
    void findGrains(const ParticleStore& grains, std::span<const std::uint32_t> tooYoung, int threads);
    void findBodies(const ParticleStore& grains, std::span<const std::uint32_t> tooYoung);
    /// One that leaves, as it is counted.
    struct Gone {
        std::uint32_t identity, outlet, body;
        int species;
        double radius, mass;  // m, kg
    };
    /// None if it has gone already, or the condition of the outlet is not met.
    [[nodiscard]] std::optional<Gone> measure(const Leaving& one, ParticleHandler& particles,
                                              BodyHandler& bodies) const;
    /// Removes it, and counts it.
    void remove(const Gone& one, ParticleHandler& particles, BodyHandler& bodies);
    std::vector<double> letOutOfRanks(ParticleHandler& particles, BodyHandler& bodies,
                                      ContactSystem& contacts);
    void count(const Gone& one);
    void visitArrivals(StateArchive& archive);

    std::vector<Outlet> outlets;
    std::vector<Arrival> arrivals;            // only where an outlet asks for an age
    double longestAge = 0;                    // s, that one asks for
    double last = 0;                          // s, of the last step
    std::vector<std::vector<Leaving>> found;  // by each thread
    std::vector<Leaving> leaving;
    bool hasBegun = false;
};

}  // namespace pendular
