#pragma once

#include <atomic>
#include <concepts>
#include <functional>
#include <map>
#include <mutex>
#include <span>

#include "Kernel/Core/Particles/GrainLoad.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/LiquidTransport/GrainFilms.h"

namespace pendular {

class GrainSpecies;
class ParticleHandler;

/// A grain of a scene, found by its identity: valid until the grain is removed; then every call throws
/// InputError. A grain of a rigid body cannot be changed by itself. What is set during a run holds from the
/// next step on, and is checked there as at set-up.
class GrainReference {
public:
    GrainReference(ParticleHandler& particles, std::uint32_t identity)
        : handler(&particles), number(identity) {}

    /// MercuryDPM's drivers have pointers to grains: grain->getPosition().
    [[nodiscard]] GrainReference* operator->() { return this; }
    [[nodiscard]] const GrainReference* operator->() const { return this; }

    [[nodiscard]] std::uint32_t getId() const { return number; }
    [[nodiscard]] Vec3D getPosition() const { return toEigen(record().position); }
    [[nodiscard]] Vec3D getVelocity() const { return toEigen(record().velocity); }
    [[nodiscard]] double getRadius() const { return record().radius; }
    /// kg; infinite for a grain that is held in place altogether. For a grain of a rigid body it is its share
    /// of the body's mass.
    [[nodiscard]] double getMass() const;
    [[nodiscard]] bool isFixed() const { return record().inverseMass == 0; }
    [[nodiscard]] int getSpeciesIndex() const;
    /// Zero in scenes without friction.
    [[nodiscard]] Vec3D getAngularVelocity() const;
    /// The sum of all forces (N) of the last step, weight included; of a grain that is held in place that of
    /// its contacts alone, and zero along axes along which another one is held.
    /// For a grain of a rigid body it is its mass times its acceleration, so it includes what holds it in the
    /// body.
    [[nodiscard]] Vec3D getForce() const;
    /// The sum of all torques (N m) about its centre in the last step; as the force, of a grain that is held
    /// that of its contacts, and zero about axes about which another one is held. Zero without friction.
    [[nodiscard]] Vec3D getTorque() const;
    /// kg m^2, about its centre; infinite for a grain that is held altogether. Of a grain of a rigid body: of
    /// a sphere of its share of the mass.
    [[nodiscard]] double getInertia() const;
    /// m^3, of a sphere of its radius.
    [[nodiscard]] double getVolume() const { return sphereMass(getRadius(), 1); }

    /// The film on the grain (m^3); 0 where no liquid moves. The liquid of its bridges comes on top.
    [[nodiscard]] double getLiquidVolume() const;

    /// The film (m^3). In a run the difference counts as absorbed, and is rounded to a multiple of the
    /// quantum in which the scene's liquid is counted; touching contacts draw from it at the end of the next
    /// step.
    void setLiquidVolume(double volume);
    void setVelocity(const Vec3D& velocity);
    /// Without effect in scenes without friction.
    void setAngularVelocity(const Vec3D& spin);
    void setPosition(const Vec3D& position);
    /// Changes the velocity by so much (m/s).
    void accelerate(const Vec3D& change) { setVelocity(getVelocity() + change); }
    /// Puts it elsewhere, by so much (m).
    void move(const Vec3D& way) { setPosition(getPosition() + way); }
    /// The mass follows, at the density of the species.
    void setRadius(double radius);
    template <class S>
    void setSpecies(const S* species) {
        setSpeciesIndex(species->getIndex(), species->getOwner());
    }
    /// Holds the grain, or lets it go. A grain that is held feels no force, and moves with the velocity and
    /// the spin that are set from then on; at first it has none.
    void fixParticle(bool fix = true);
    /// Holds the grain along and about these axes of space, and lets it go along and about all others but
    /// those of holdAll(). In those it feels no force and no torque, and keeps the velocity and the spin that
    /// are set from then on; at first it has none. With all axes it is fixParticle().
    void setHeldAxes(const HeldAxes& axes);
    [[nodiscard]] HeldAxes getHeldAxes() const;

private:
    void setFixed(bool fix);
    [[nodiscard]] GrainLoad loadOfHeld() const;
    void setSpeciesIndex(int index, const SpeciesOwner* owner);
    [[nodiscard]] std::uint32_t place() const;
    /// Throws InputError for a grain of a rigid body.
    void requireOwnBody(std::string_view what) const;
    [[nodiscard]] TranslationRecord& record() const;

    ParticleHandler* handler;
    std::uint32_t number;
};

/// A column of numbers, one for each grain, by identity: particleHandler.addColumn("film_volume", "m3").
class GrainColumnReference {
public:
    GrainColumnReference(ParticleHandler& particles, std::size_t column)
        : handler(&particles), number(column) {}

    /// The driver's number of the grain with this identity. Throws InputError if there is none.
    [[nodiscard]] double& operator[](std::uint32_t identity) const;

private:
    ParticleHandler* handler;
    std::size_t number;
};

/// The inertia of a grain against forces and torques.
struct GrainInertia {
    double inverseMass, inverseMoment;  // 1/kg, 1/(kg m^2)
};

/// The changes of a handler's grains since the scene last looked.
struct GrainChanges {
    // Identities.
    std::vector<std::uint32_t> added;
    std::vector<std::uint32_t> placed;   // put elsewhere, made larger, or let go: they may overlap others
    std::vector<std::uint32_t> altered;  // made smaller, of another species, or held

    [[nodiscard]] bool any() const { return !added.empty() || !placed.empty() || !altered.empty(); }
};

/// Adds grains to a scene, removes them, and finds them again: before the run, and in it, from any hook.
class ParticleHandler {
public:
    using Grains = ParticleStore;

    ParticleHandler() = default;
    ParticleHandler(const ParticleHandler&) = delete;

    /// Holds all grains and rigid bodies along and about these axes, those that are there and those to come,
    /// besides what is set for each: holdAll(HeldAxes::inPlane()) is a scene in the plane of x and y. A
    /// velocity or a spin there is refused, so that it is 0 to the bit. At set-up.
    void holdAll(const HeldAxes& axes);
    [[nodiscard]] HeldAxes axesOfAllHeld() const { return heldByScene.axes(); }

    /// Takes the memory for so many grains at once, instead of bit by bit.
    void reserve(std::size_t count) { grains.reserve(count); }

    /// Adds a copy of the grain. Its mass is that of a solid sphere of its species' density. Throws
    /// InputError when 2^31 grains have been added in all.
    GrainReference copyAndAddObject(const SphericalParticle& grain);
    /// A copy of what a pointer shows. (A template, so that {} is no pointer.)
    template <std::same_as<SphericalParticle> One>
    GrainReference copyAndAddObject(const One* grain) {
        return copyAndAddObject(*grain);
    }
    /// Removes the grain with this identity; its contacts and bridges end. The identities of all others stay,
    /// and this one is not given again. Throws InputError if there is no such grain, or if it is part of a
    /// rigid body.
    void removeObject(std::size_t identity);

    /// How many grains there are; in a scene on several ranks, on all of them together.
    [[nodiscard]] std::size_t getSize() const { return grains.isShared ? countOfAll() : grains.count(); }
    /// The same, under MercuryDPM's name.
    [[nodiscard]] std::size_t getNumberOfObjects() const { return getSize(); }
    [[nodiscard]] bool isEmpty() const { return getSize() == 0; }
    /// The grain with this identity. Throws InputError if there is none.
    [[nodiscard]] GrainReference getObject(std::size_t identity);
    /// The same, under MercuryDPM's name.
    [[nodiscard]] GrainReference getParticleById(std::size_t identity) { return getObject(identity); }
    /// The grain that was added last, of those that there are. Throws InputError if there is none, and as
    /// begin() does.
    [[nodiscard]] GrainReference getLastObject();
    /// The first with the smallest, or the largest, radius. Throw InputError if there is no grain, and as
    /// begin() does.
    [[nodiscard]] GrainReference getSmallestParticle();
    [[nodiscard]] GrainReference getLargestParticle();
    /// Removes all grains that are in no rigid body.
    void clear();
    [[nodiscard]] bool contains(std::size_t identity) const;
    /// The place at which the store keeps a grain, until the next list of contacts. Throws InputError if
    /// there is no such grain.
    [[nodiscard]] std::uint32_t placeOf(std::size_t identity) const;

    /// Over all grains that there are at its begin, in the order of their identities:
    /// for (GrainReference grain : particleHandler). What is added on the way is not visited; the grain
    /// itself may be removed. Throws InputError where each rank of a scene has its own grains only, because a
    /// part must not be taken for the whole: call gather() before, or loop over ownGrains().
    class Iterator {
    public:
        Iterator(ParticleHandler& particles, PlaceIndex::Iterator position)
            : handler(&particles), at(position), bound(particles.grains.nextIdentity()) {}
        GrainReference operator*() const { return {*handler, handler->grains.identity[*at]}; }
        Iterator& operator++() {
            ++at;
            return *this;
        }
        friend bool operator==(const Iterator& a, const Iterator& b) {
            return a.at == b.at || (a.isAtEnd() && b.isAtEnd());
        }

    private:
        [[nodiscard]] bool isAtEnd() const {
            return at == handler->grains.place.end() || handler->grains.identity[*at] >= bound;
        }

        ParticleHandler* handler;
        PlaceIndex::Iterator at;
        std::uint32_t bound;  // the identity of the first that is not visited
    };
    [[nodiscard]] Iterator begin() {
        requireAll("a loop over particleHandler");
        return {*this, grains.place.begin()};
    }
    [[nodiscard]] Iterator end() { return {*this, grains.place.end()}; }

    /// The grains that this rank owns, in the order of their identities; on one rank, and after gather(), all
    /// of them. Each grain is owned by one rank, so that this loop changes each of them once:
    /// for (GrainReference grain : particleHandler.ownGrains()). Sums over all ranks: SumsOverRanks.h.
    class OwnGrains {
    public:
        explicit OwnGrains(ParticleHandler& particles) : handler(&particles) {}
        [[nodiscard]] Iterator begin() const { return {*handler, handler->grains.place.begin()}; }
        [[nodiscard]] Iterator end() const { return handler->end(); }
        [[nodiscard]] std::size_t size() const { return handler->grains.count(); }
        [[nodiscard]] bool empty() const { return size() == 0; }

    private:
        ParticleHandler* handler;
    };
    [[nodiscard]] OwnGrains ownGrains() { return OwnGrains(*this); }

    /// A number that is kept of each grain from now on, by name. It is in restart files and in the outputs of
    /// fields, there as NAME_UNIT. At set-up only. Throws InputError for a name that is there already.
    GrainColumnReference addColumn(const std::string& name, const std::string& unit, double initial = 0);

    /// The liquid on the grains, where liquid moves.
    [[nodiscard]] GrainFilms& films() { return liquidFilms; }
    [[nodiscard]] const GrainFilms& films() const { return liquidFilms; }

    /// kg, of a grain of this size (m) and species
    [[nodiscard]] double massOf(double radius, int species) const;
    /// kg, of the grain at a place: of a solid sphere; in a rigid body its share of that one's mass, which is
    /// parted as masses of free spheres are.
    [[nodiscard]] double massAt(std::uint32_t place) const;

    void visitState(StateArchive& archive);
    /// The columns in which the kernel keeps the grains. In a scene on several ranks they are those of this
    /// rank, with copies of others (ghosts) behind them. Call it again after each step: the end of a
    /// step that no output or hook follows is computed at this call.
    [[nodiscard]] Grains& store() {
        finishStep();
        return grains;
    }
    [[nodiscard]] const Grains& store() const {
        finishStep();
        return grains;
    }

    /// Ends a step that was left unfinished. May be called from any thread: all others wait until it is done.
    void finishStep() const {
        if (!unfinished.load(std::memory_order_acquire)) [[likely]]
            return;
        const std::scoped_lock one(finishingNow);
        if (unfinished.load(std::memory_order_relaxed)) finishing();
        unfinished.store(false, std::memory_order_release);
    }

    /// What only the kernel asks: ParticleHandlerInside.h.
    class Inside;

private:
    friend class GrainReference;
    friend class GrainColumnReference;

    /// Throws InputError where other ranks have grains that are not here. @param what needs all of them
    void requireAll(std::string_view what) const {
        if (grains.isShared) refusePart(what);
    }
    [[noreturn]] static void refusePart(std::string_view what);
    [[nodiscard]] GrainReference firstBy(std::string_view call,
                                         const std::function<bool(double, double)>& isBefore);
    void setSpecies(const GrainSpecies& of);
    /// Throws InputError unless velocity and spin are 0 where all grains are held. @param whose for the
    /// sentence
    void requireHeld(std::string_view whose, const Vector<double>& velocity,
                     const Vector<double>& spin) const;
    /// Throws InputError unless it is one of this scene. @param whose for the sentence
    void requireOwnSpecies(std::string_view whose, int index, const SpeciesOwner* owner) const;
    void setGravity(const Vector<double>& acceleration);
    void settleSpin();
    void renewMasses();
    void weighFilms();
    /// Gives a grain the mass of the density that its species has now, with the film that it has; its forces
    /// stay. Nothing changes for a grain that is held.
    void renewMass(std::uint32_t place);
    /// The inertia of a grain that moves by itself.
    [[nodiscard]] GrainInertia inertiaAt(std::uint32_t place) const;
    /// The body at a place has the mass of its grains' films.
    void weighFilmsOf(std::size_t body);
    void noteJoined(std::span<const std::uint32_t> identities);
    void noteDensityOfJoined(std::uint32_t identity);

    const GrainSpecies* species = nullptr;
    HeldBits heldByScene;
    std::map<std::uint16_t, double> densitiesOfJoined;  // kg/m^3, of species in rigid bodies
    bool columnsAreClosed = false;
    Grains grains;
    GrainFilms liquidFilms;
    GrainChanges changes;
    Vector<double> gravity{0, 0, 0};  // m/s^2
    double liquidDensity = 0;         // kg/m^3
    std::function<void(std::uint32_t)> beforeRemoval;
    std::function<void()> finishing;
    std::function<std::size_t()> countOfAll;
    std::function<GrainLoad(std::uint32_t)> loadAt;  // of the grain at a place, by its contacts
    mutable std::atomic<bool> unfinished = false;
    mutable std::mutex finishingNow;
};

}  // namespace pendular
