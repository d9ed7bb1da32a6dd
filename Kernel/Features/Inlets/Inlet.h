#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Features/Inlets/RegionInFlow.h"
#include "Kernel/Features/Insertion/BodyMixture.h"
#include "Kernel/Features/Insertion/Insertion.h"
#include "Kernel/Features/RigidBodies/BodySizes.h"

namespace pendular {

class AllRanks;
class ContactSystem;

class StateArchive;

/// What happens to the flow of an inlet while there is no room for its next grain.
enum class NoRoom {
    Later,  ///< it is made up for as soon as there is room
    Lost    ///< it is lost; from then on the flow is as before
};

/// Grains, clumps and superquadrics that come into a region of a scene at a rate. What has come by a time t
/// is the largest sum of whole ones that is not above the integral of the rate (less what was lost): the
/// error never exceeds one grain, for any time step. Grain k of an inlet has a size that is a counted random
/// number of (seed, k), and comes at a random place that is free. One that finds no room is kept and tried
/// again in the next step; it is not drawn again, because that would favour small ones.
class Inlet {
public:
    template <std::derived_from<Region> R>
    void setRegion(const R& where) {
        region = std::make_shared<const R>(where);
    }
    void setSizes(const SizeDistribution& distribution) { sizes = distribution; }
    /// Species, velocity, spin and film of the grains. In shear and strain each velocity gets that of the
    /// flow at its place (shearFlowAt()) as well. With a velocity the inlet is a stream: what passes the
    /// region's area at that velocity may be dense up to a solid fraction of 0.25.
    void setGrain(const SphericalParticle& grain) { like = grain; }
    /// Clumps come instead of grains: template, species, velocity and spin of them. setSizes() are the
    /// diameters of spheres of their volume.
    void setClump(const Clump& clump) { like = clump; }
    /// Superquadrics come instead of grains, into a scene of SuperquadricSimulation: shape, species, velocity
    /// and spin of them. setSizes() are the diameters of spheres of their volume. They are tried with the
    /// spheres around them.
    void setSuperquadric(const SuperquadricGrain& grain) { like = grain; }
    /// A mixture of grains, clumps and superquadrics comes, with the sizes that are in it. Each body has a
    /// kind that is a counted random number of (seed, k).
    void setBodies(const BodyMixture& bodies) { mixture = bodies; }
    /// Clumps and superquadrics come turned evenly at random, if this is not called; else as the first one is
    /// turned.
    void setRandomTurns(bool random) { randomTurns = random; }
    /// kg/s
    void setMassFlow(double rate);
    /// Grains a second.
    void setNumberFlow(double rate);
    /// s: grains come between these times; from 0 on without end, if this is not called.
    void setTimes(double first, double last);
    void setNoRoom(NoRoom what) { noRoom = what; }
    /// Random places that a grain is tried at in a step; 100, if this is not called.
    void setTries(std::uint32_t number);
    void setSeed(std::uint64_t value) { seed = value; }
    /// Whole grains are in the region; else only their centres. Whole grains, if this is not called.
    void setWholeGrains(bool whole) { wholeGrains = whole; }
    /// The region goes along with a wall, without turning: its middle stays where it is on the wall, as a
    /// body. @param wall its number in wallHandler
    void setFollowsWall(std::size_t wall);
    /// The region follows the height to which it fills: whenever a grain finds no room in it, it moves by a
    /// step (m) along a direction, by at most so much (m; up to 1e4 steps) in all. Only what finds no room
    /// then is made up for later, or lost. It never comes back: not where the bed sinks, and not where a wall
    /// had come into its way. At set-up walls must leave room at the end of the way and on it.
    void setFollowsFill(const Vec3D& direction, double step, double most);

    static constexpr double densestStream = 0.25;  // solid fraction

private:
    friend class InletHandler;

    std::shared_ptr<const Region> region;
    std::optional<SizeDistribution> sizes;
    std::variant<SphericalParticle, Clump, SuperquadricGrain> like;
    std::optional<BodyMixture> mixture;
    bool randomTurns = true;
    double massFlow = unset, numberFlow = unset;  // kg/s, 1/s
    double first = 0, last = infinity;            // s
    NoRoom noRoom = NoRoom::Later;
    std::uint32_t tries = 100;
    std::uint64_t seed = 1;
    bool wholeGrains = true;
    std::optional<std::uint64_t> wall;  // that the region follows
    Vector<double> rise{0, 0, 0};       // m, one step after the fill
    std::uint32_t mostRises = 0;
};

/// What has come through an inlet.
struct InletCount {
    std::uint64_t number = 0;  // of grains, clumps and superquadrics
    double mass = 0;           // kg
    double lost = 0;           // of the flow, kg or grains: what would have come if there had been room
    bool waits = false;        // the next grain finds no room
    double risen = 0;          // m, by which the region has followed the fill
};

/// The inlets of a scene.
class InletHandler {
public:
    /// At set-up only. Returns the inlet's number. Throws InputError if something of it is not set.
    std::size_t copyAndAddObject(const Inlet& inlet);
    [[nodiscard]] std::size_t getSize() const { return inlets.size(); }
    [[nodiscard]] bool isEmpty() const { return inlets.empty(); }
    /// Throws InputError if there is no such inlet.
    [[nodiscard]] const InletCount& countOf(std::size_t inlet) const;
    /// As it was given: not moved with a wall or the fill.
    [[nodiscard]] const Region& regionOf(std::size_t inlet) const { return *inlets[inlet].inlet.region; }

    // Called by the scene, not by drivers.

    /// Smallest and largest radius (m) of the spheres to come of one kind, and their species.
    struct Sizes {
        double smallest, largest;
        int species;
        std::optional<BodiesAlike> bodies;  // clumps and superquadrics, for the stability limit
    };
    [[nodiscard]] std::vector<Sizes> sizes(const GrainSpecies& species) const;
    /// Whether others than grains are to come.
    [[nodiscard]] bool bringBodies() const;
    [[nodiscard]] bool bringLiquid() const;
    /// m, the largest width of the bodies to come as they turn; 0 without any.
    [[nodiscard]] double widestBody() const;
    /// Tells a scene of the shapes to come. Throws InputError if it takes none.
    /// @param shapes of the scene; null: it takes none
    void expectShapes(GrainShapes* shapes) const;
    /// Throws InputError if a body to come is wider than half the shortest period, as BodyHandler does.
    void refuseTooWide(const PeriodicBox& periodic) const;
    /// The mixture that an inlet brings.
    [[nodiscard]] const BodyMixture& bodiesOf(std::size_t inlet) const { return inlets[inlet].bodies; }
    /// The liquid (m^3) of the films of all grains that come until a time (s), by the mean of their sizes.
    [[nodiscard]] double liquidBy(const ParticleHandler& particles, double time) const;
    /// Throws InputError if wet grains are to come by a time (s), and no liquid can be counted any more:
    /// before a step, so that none is half done.
    void requireLiquid(const ParticleHandler& particles, const AllRanks& ranks, double time) const;
    /// The run begins, or goes on. Throws InputError for what cannot work; room is looked for only where it
    /// begins, because walls move.
    /// @param atSetUp the periodic box then, which strain changes
    void begin(const InsertionScene& scene, const PeriodicBox& atSetUp, bool isRestarted);
    /// Grains that are due at a time (s) come. @param tell of what is to be said once
    /// On several ranks all try the same candidates, and a place is free if it is on each of them.
    void letIn(const InsertionScene& scene, ContactSystem& contacts, double time,
               const std::function<void(std::string)>& tell);
    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive);

private:
    struct Kept {
        Inlet inlet;
        BodyMixture bodies;
        std::vector<ContactsAround> around;    // of each kind; of grains unused
        std::shared_ptr<const Region> region;  // in this scene
        InletCount count;
        std::uint32_t attempts = 0;  // of places for the next grain
        bool wasTold = false;        // that there was no room
        double nextRadius = unset;   // m
        std::size_t nextKind = 0;
        std::uint32_t rises = 0;
        Vector<double> onWall{0, 0, 0};  // m, the middle of the region in the frame of the wall
        RegionInFlow inFlow = {};
    };

    /// The shift (m) by which the region of an inlet has moved.
    [[nodiscard]] static Vector<double> shiftOf(const InsertionScene& scene, const Kept& kept,
                                                std::size_t number);

    void checkRoom(const InsertionScene& scene, std::size_t number) const;
    void check(const InsertionScene& scene, std::size_t number) const;
    void checkStream(const InsertionScene& scene, std::size_t number) const;
    /// @param filmsElsewhere m^3, that have come to the grains of other ranks
    void letInOf(const InsertionScene& scene, ContactSystem& contacts, std::size_t number, double time,
                 double filmsElsewhere, const std::function<void(std::string)>& tell);
    struct Room {
        Vector<double> place;  // m
        Eigen::Quaterniond turn;
    };
    static std::optional<Room> findRoom(const InsertionScene& scene, const AllRanks& ranks, Kept& kept,
                                        const class SphereGrid& grid, std::uint32_t number);
    static void compareKinds(StateArchive& archive, const BodyMixture& bodies);

    std::vector<Kept> inlets;
    bool hasBegun = false;
};

}  // namespace pendular
