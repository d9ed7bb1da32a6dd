#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "Kernel/Core/Particles/ParticleHandler.h"

namespace pendular {

/// What the kernel asks of the grains of a scene, and drivers do not: these calls are right only at their
/// place in a step.
class ParticleHandler::Inside {
public:
    /// The grains as they are, in the middle of a step.
    [[nodiscard]] static ParticleStore& grainsInStep(ParticleHandler& of) { return of.grains; }
    /// What finishes a step that was left unfinished.
    static void callToFinishStep(ParticleHandler& of, std::function<void()> function) {
        of.finishing = std::move(function);
    }
    static void leaveStepUnfinished(ParticleHandler& of) { of.unfinished = true; }
    /// Whether the last step was left so, and nobody has asked for the grains since; who calls this finishes
    /// it.
    [[nodiscard]] static bool takeUnfinishedStep(ParticleHandler& of) {
        return of.unfinished.exchange(false);
    }

    static void setSpecies(ParticleHandler& of, const GrainSpecies& species) { of.setSpecies(species); }
    /// m/s^2: it is the acceleration of a grain that is added or let go, of which no step has found another
    /// yet, and part of that of all others: in a run, these change with it.
    static void setGravity(ParticleHandler& of, const Vector<double>& acceleration) {
        of.setGravity(acceleration);
    }
    /// kg/m^3, of films: their mass is part of that of their grains, as renewMasses() and all changes of a
    /// grain count it. 0: they have none.
    static void setLiquidDensity(ParticleHandler& of, double density) { of.liquidDensity = density; }
    /// When the laws are known: grains of a scene without friction have no spin.
    static void settleSpin(ParticleHandler& of) { of.settleSpin(); }
    /// Gives all grains that move by themselves the mass of their species' density, and of their films where
    /// these are weighed. Forces and velocities stay.
    static void renewMasses(ParticleHandler& of) { of.renewMasses(); }
    /// kg, of the film of the grain at a place; 0 where films have no mass.
    [[nodiscard]] static double filmMassAt(const ParticleHandler& of, std::uint32_t place) {
        return of.liquidDensity > 0 ? of.liquidDensity * of.liquidFilms.of(of.grains, place) : 0;
    }
    /// m/s^2
    [[nodiscard]] static const Vector<double>& gravityOf(const ParticleHandler& of) { return of.gravity; }
    /// The body at a place has the mass of its grains' films.
    static void weighFilmsOf(ParticleHandler& of, std::size_t body) { of.weighFilmsOf(body); }
    /// Throws InputError unless velocity and spin are 0 where all grains are held.
    static void requireHeld(const ParticleHandler& of, std::string_view whose, const Vector<double>& velocity,
                            const Vector<double>& spin) {
        of.requireHeld(whose, velocity, spin);
    }
    /// The grain's body has been held or let go.
    static void noteHeld(ParticleHandler& of, std::uint32_t grain, bool mayOverlap) {
        (mayOverlap ? of.changes.placed : of.changes.altered).push_back(grain);
    }
    /// The same where only films have changed.
    static void weighFilms(ParticleHandler& of) { of.weighFilms(); }

    /// Throws InputError where other ranks have grains that are not here. @param what needs all of them
    static void requireAll(const ParticleHandler& of, std::string_view what) { of.requireAll(what); }

    /// The function that returns the number of grains of all ranks, where each has its own ones only.
    static void callToCountAll(ParticleHandler& of, std::function<std::size_t()> function) {
        of.countOfAll = std::move(function);
    }

    /// The function that returns what the contacts of the grain at a place give it.
    static void callForLoads(ParticleHandler& of, std::function<GrainLoad(std::uint32_t)> function) {
        of.loadAt = std::move(function);
    }

    /// The scene begins: no column is added from now on.
    static void closeColumns(ParticleHandler& of) { of.columnsAreClosed = true; }
    /// Grains have been joined to a rigid body.
    static void noteJoined(ParticleHandler& of, std::span<const std::uint32_t> identities) {
        of.noteJoined(identities);
    }
    /// Called with the place of a grain before it is removed.
    static void callBeforeRemoval(ParticleHandler& of, std::function<void(std::uint32_t)> function) {
        of.beforeRemoval = std::move(function);
    }
    /// In GrainChanges, instead of the identity of a grain that was given a value that it had: contacts are
    /// listed again, and none of them has changed.
    static constexpr std::uint32_t givenWhatItHas = PlaceIndex::none;
    /// What has changed since this was called last.
    [[nodiscard]] static GrainChanges takeChanges(ParticleHandler& of) {
        return std::exchange(of.changes, {});
    }
    [[nodiscard]] static bool hasChanges(const ParticleHandler& of) { return of.changes.any(); }
};

}  // namespace pendular
