#pragma once

#include <array>
#include <string_view>

#include "Kernel/Features/EnergyLedger/GrainSums.h"

namespace pendular {

/// The energy of a scene by mechanism, in J. EnergyAccount says how it is kept.
struct EnergyLedger {
    // Energies that the scene has now:
    double kinetic = 0;            // spin included
    double potential = 0;          // in the field of gravity
    double elastic = 0;            // in the normal overlaps
    double tangentialElastic = 0;  // in the tangential springs
    double rollingElastic = 0;
    double torsionElastic = 0;
    /// Net work done against the adhesions and bridges that act; negative in most contacts.
    double adhesive = 0;
    double pistons = 0;          // kinetic, of walls with a mass
    double membranes = 0;        // kinetic, of their vertices
    double membraneElastic = 0;  // in their springs and hinges
    double bondElastic = 0;      // in bonds between grains

    // Energies that have been lost since the start:
    double normalDashpots = 0;
    double plastic = 0;    // with its error of the time steps
    double sintering = 0;  // as contacts creep under their forces
    double tangentialDashpots = 0;
    double sliding = 0;
    double rolling = 0;  // sliders and dashpots
    double torsion = 0;
    double brokenAdhesion = 0;  // net work done against adhesions and bridges that have broken
    double viscousBridges = 0;  // by bridges that resist motion
    double membraneDamping = 0;
    double bondDamping = 0;
    double fracture = 0;  // what bonds had stored that have broken
    double bearings = 0;  // in the friction of sliders and rotors, and at their largest speeds
    /// The energy of tangential springs whose stiffness follows the overlap while they are stretched, for
    /// which the laws have no force: lost as contacts open, negative as they close.
    double stiffening = 0;

    // Energies that the scene has been given since the start:
    double walls = 0;      // by walls that move, and by what holds grains and bodies that move
    double loads = 0;      // by the loads and the weights of pistons
    double pressures = 0;  // by pressures on membranes, and their weight
    double driver = 0;     // where a driver changes velocities, places or the gravity
    double images = 0;     // by images that move against each other: shear and strain of a periodic scene
    // Energies given by liquid: bridges whose volume changes while they last (ContactLiquid). A bridge forms
    // without energy, so that all that its force has done is in lost_in_broken_adhesion when it ends.
    double migration = 0;    // liquid comes to a bridge
    double evaporation = 0;  // negative while drying bridges get weaker at the same gap

    /// Work of conservative forces that is not found as stored energy: it falls with the time step, except
    /// for springs that the integrator feeds (the page on the time step), and for an attraction without
    /// hysteresis (ReversibleAdhesive, DMT) that acts already at the start: its energy is counted from there,
    /// and what it had is in this entry from when the pair first leaves its range.
    double stepError = 0;

    double carried = 0;  // of the potential energy, by grains that have gone round a periodic scene

    /// The energy in all springs.
    [[nodiscard]] double springs() const {
        return elastic + tangentialElastic + rollingElastic + torsionElastic;
    }
    [[nodiscard]] double stored() const { return springs() + adhesive; }
    [[nodiscard]] double lost() const {
        return normalDashpots + plastic + sintering + tangentialDashpots + sliding + rolling + torsion +
               brokenAdhesion + viscousBridges + stiffening + membraneDamping + bondDamping + fracture +
               bearings;
    }
    /// Constant except for the error of the time steps.
    [[nodiscard]] double total() const {
        return kinetic + pistons + membranes + membraneElastic + bondElastic + potential + stored() + lost() -
               given();
    }
    [[nodiscard]] double given() const {
        return walls + loads + pressures + driver + images + migration + evaporation;
    }
    /// Constant except for round-off.
    [[nodiscard]] double closed() const { return total() + stepError; }
    /// Net work done against adhesions and bridges: negative while they have given more than they took.
    [[nodiscard]] double adhesionWork() const { return adhesive + brokenAdhesion; }

    struct Entry {
        std::string_view name;
        double EnergyLedger::*member;
    };
    static constexpr auto entries() {
        using L = EnergyLedger;
        return std::to_array<Entry>({{"kinetic", &L::kinetic},
                                     {"potential", &L::potential},
                                     {"elastic", &L::elastic},
                                     {"tangential_elastic", &L::tangentialElastic},
                                     {"rolling_elastic", &L::rollingElastic},
                                     {"torsion_elastic", &L::torsionElastic},
                                     {"adhesive", &L::adhesive},
                                     {"kinetic_of_pistons", &L::pistons},
                                     {"kinetic_of_membranes", &L::membranes},
                                     {"elastic_of_membranes", &L::membraneElastic},
                                     {"elastic_of_bonds", &L::bondElastic},
                                     {"lost_in_normal_dashpots", &L::normalDashpots},
                                     {"lost_plastic", &L::plastic},
                                     {"lost_in_sintering", &L::sintering},
                                     {"lost_in_tangential_dashpots", &L::tangentialDashpots},
                                     {"lost_in_sliding", &L::sliding},
                                     {"lost_in_rolling", &L::rolling},
                                     {"lost_in_torsion", &L::torsion},
                                     {"lost_in_broken_adhesion", &L::brokenAdhesion},
                                     {"lost_in_viscous_bridges", &L::viscousBridges},
                                     {"lost_in_stiffening", &L::stiffening},
                                     {"lost_in_membranes", &L::membraneDamping},
                                     {"lost_in_bonds", &L::bondDamping},
                                     {"lost_in_fracture", &L::fracture},
                                     {"lost_in_bearings", &L::bearings},
                                     {"given_by_walls", &L::walls},
                                     {"given_by_loads", &L::loads},
                                     {"given_by_pressures", &L::pressures},
                                     {"given_by_driver", &L::driver},
                                     {"given_by_images", &L::images},
                                     {"given_by_migration", &L::migration},
                                     {"given_by_evaporation", &L::evaporation},
                                     {"step_error", &L::stepError}});
    }
};

}  // namespace pendular
