#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Kernel/Features/LiquidTransport/Droplets.h"
#include "Kernel/Features/LiquidTransport/Spray.h"

namespace pendular {

class ContactSystem;
class GrainFilms;
class StateArchive;
struct LiquidLedger;

/// A droplet that has ended in a step, and where.
struct CaughtDroplet {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::size_t spray;
    std::uint32_t particle;   // identity; `none` at a wall, or where it was lost in flight
    int wall;                 // -1: none
    Vector<double> position;  // m, of its centre where it was caught
    double volume;            // m^3
};

/// A step as the droplets of a scene need it: they fly in it, after its grains and walls have moved.
struct SprayStep {
    ParticleStore& grains;
    GrainFilms& films;
    ContactSystem& contacts;
    const WallHandler& walls;
    const PeriodicBox& periodic;                  // at the end of the step
    const PeriodicBox &imagesBefore, &imagesNow;  // as images moved before the step, and move in it
    Vector<double> gravity;                       // m/s^2
    double time, length;                          // s, at its end; of it
    double grainShift;                            // m, of the farthest grain
    double smallestRadius;                        // m
    int threads;
};

/// The sprays of a scene, and their droplets in flight. Droplets fly as free bodies in the field of gravity,
/// exactly for any step, without drag, and do not meet each other. Each ends at the first grain or wall that
/// it meets, of what its sphere sweeps in a step: a grain's film gets all of it, a wet wall's account as
/// well; at a dry wall, or after its longest flight, it is lost. Between the ends of two steps its way is
/// taken for straight, which is off by g dt^2 / 8 at most. In shear and strain they are treated as grains
/// are: where the flow changes from one step to the next they get its change, and one that leaves the
/// periodic box goes over to the velocity of its image inside.
class SprayHandler {
public:
    /// At set-up only. Returns the number of the spray. Throws InputError if something of it is not set.
    std::size_t copyAndAddObject(const Spray& spray);
    [[nodiscard]] std::size_t getSize() const { return sprays.size(); }
    [[nodiscard]] bool isEmpty() const { return sprays.empty(); }
    /// Throws InputError if there is none.
    [[nodiscard]] const Spray& getObject(std::size_t number) const;
    /// How many droplets a spray has emitted.
    [[nodiscard]] std::uint64_t countOf(std::size_t number) const;
    [[nodiscard]] const std::vector<Droplet>& droplets() const { return inFlight; }
    /// The droplets that have ended in the last step, in the order in which they came out.
    [[nodiscard]] const std::vector<CaughtDroplet>& caught() const { return caughtInStep; }

    // Called by the scene, not by drivers.

    /// The run begins. @param quantum m^3, in which liquid is counted. Throws InputError if droplets are too
    /// small to be counted.
    void begin(double quantum);
    void close() { isClosed = true; }
    /// The volume (m^3) that all sprays emit by a time (s), at most.
    [[nodiscard]] double volumeBy(double time) const;
    /// Droplets come out until a time (s). Throws InputError if they are more liquid than the quantum was
    /// made for, or too many.
    /// In shear and strain each has the velocity of the flow at its place as well.
    void emit(GrainFilms& films, const PeriodicBox& periodic, double time);
    /// They fly.
    void advance(const SprayStep& step);
    void addTo(LiquidLedger& ledger) const;
    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive, const GrainFilms& films);

    static constexpr std::size_t mostDroplets = 10'000'000;  // in flight

private:
    struct Flight {
        Sweep sweep;
        Vector<double> velocity;  // m/s, at the start of the step
        SweepHit hit;
        std::uint32_t particle = CaughtDroplet::none;  // identity of the grain that is hit, on any rank
    };

    [[nodiscard]] double wholeVolume(double radius) const;
    void fly(const SprayStep& step);
    void dry(const SprayStep& step, Droplet& droplet, double time);
    /// Droplets fly alike on all ranks, and what is met first on any of them counts on all.
    void joinHits(const SprayStep& step);
    /// Whether it flies on.
    bool finish(const SprayStep& step, Droplet& droplet, const Flight& flight);
    void hitGrain(const SprayStep& step, const Droplet& droplet, const Flight& flight);

    std::vector<Spray> sprays;
    std::vector<std::uint64_t> counts;  // of droplets that have come out of each
    std::vector<Droplet> inFlight;
    std::size_t newOnes = 0;  // the last ones in flight have just come out
    std::vector<Flight> flights;
    std::vector<CaughtDroplet> caughtInStep;
    SweptSearch search;
    double unit = 0;  // m^3
    double lost = 0;  // m^3
    bool isClosed = false;
};

}  // namespace pendular
