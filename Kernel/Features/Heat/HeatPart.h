#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

class EnergyAccount;

/// What the heat in grains of a species depends on.
struct HeatMaterial {
    double conductivity = unset;  // k, W/(m K); 0: an insulator
    double heatCapacity = unset;  // c, J/(kg K)
};

/// How well a contact at an overlap d conducts, W/K.
enum class Conduction {
    /// 4 a k1 k2 / (k1 + k2), 2 k a for one material, with the contact radius a of the laws of the pair: on
    /// each side heat is constricted to a round spot on a half-space, a resistance of 1/(4 k a) (Batchelor
    /// and
    /// O'Brien 1977, Proc. R. Soc. A 355, 313). The radius is Hertz's, sqrt(R* d), of Hertzian laws, and of
    /// linear and plastic ones, which define none; the neck of laws that sinter; and that of JKR's theory,
    /// which conducts until it snaps (contactSpot(), Laws/Concepts/ContactSpot.h).
    Constriction,
    /// k pi 2 R* d / l with the distance l of the centres, k the harmonic mean: area over distance, as
    /// MercuryDPM's Thermal species, whatever the laws are. Small overlaps conduct far less than by the
    /// constriction (28 times at d = 1e-3 of the radius of equal grains).
    AreaOverDistance
};

/// The heat of a scene, J. It is constant but for what is given: closed().
struct HeatLedger {
    double stored = 0;        // C T of all grains
    double fromWalls = 0;     // of held temperatures, since the start: the sum of all (HeatPart::fromWall())
    double fromContacts = 0;  // what contacts have lost, as far as it went into grains
    double toWalls = 0;       // of that what went into walls: out of the scene
    double fromDriver = 0;    // where temperatures, grains or capacities were changed between steps

    [[nodiscard]] double closed() const { return stored - fromWalls - fromContacts - fromDriver; }
};

/// The temperature of grains: heat is conducted by contacts that touch, comes from walls of a held
/// temperature, and, if asked for, from what contacts lose in friction and damping. A grain has one
/// temperature T and the heat capacity C = m c:
///     C dT/dt = sum over contacts of H (T' - T) + sources.
/// All heat of a step is summed from temperatures of one time, in the order of identities, then the
/// temperatures change: no bit depends on the order of contacts or on threads. A step is at most the smallest
/// C over sum H of a grain: then no temperature leaves the range of its neighbours', and twice that is never
/// unstable. A longer one ends the run, and so does a temperature below 0 K. Air, radiation and expansion are
/// left out. Materials, held walls and laws are, when a run goes on from a restart file, those with which it
/// began, unless the run itself has changed them: then the file has them.
///
///     auto temperature = scene.particleHandler.addColumn("temperature", "K", 293);
///     auto& heat = scene.addPart<HeatPart>(temperature);
///     heat.setMaterial(species, {.conductivity = 1, .heatCapacity = 800});
class HeatPart : public StepPart {
public:
    /// @param temperature the column of the grains' temperatures, K
    explicit HeatPart(GrainColumnReference temperature) : temperatures(temperature) {}

    /// Of all grains and walls of a species. Throws InputError for values out of range.
    template <class Species>
    void setMaterial(const Species& species, const HeatMaterial& material) {
        setMaterialOf(species->getIndex(), material);
    }
    /// A wall, by its number, has this temperature (K) and conducts heat: without resistance of its own, or
    /// with a conductivity (W/(m K)) in series. Other walls are insulators. Also in a run.
    void holdWall(int wall, double temperature, std::optional<double> conductivity = {});
    void insulateWall(int wall);
    void setConduction(Conduction law);
    /// For grains that are softer than their material: contact radii are smaller by the cube root of this
    /// ratio (0 to 1) of the moduli of simulated and real grains, as Hertz's are at equal force. It is
    /// refused for pairs of other normal laws than Hertz's, and for those with a sintered neck: their radii
    /// do not go with a modulus.
    /// @param ratio E of the simulation over that of the material
    void setSoftening(double ratio);
    /// What contacts lose by EnergyLedger::lost() heats both bodies, half each: in friction, damping, plastic
    /// flow, sintering, and where adhesion breaks; less what stiffening gives while they close. Bonds heat
    /// nothing. Needs keepEnergyLedger(): in a run without a ledger it throws InputError.
    void heatByContacts(bool heats = true);

    /// W/K, of a contact between species a and b, by the laws of the scene; before its set-up by Hertz's
    /// contact radius. @param distance m, of the centres
    [[nodiscard]] double conductance(int a, int b, double effectiveRadius, double overlap,
                                     double distance) const;
    [[nodiscard]] const HeatLedger& ledger() const { return heat; }
    /// J that a wall, by its number, has given to grains by conduction since the start, negative where it has
    /// taken more; 0 of one that never had a temperature.
    [[nodiscard]] double fromWall(int wall) const;
    /// The numbers of the walls that have or had a temperature.
    [[nodiscard]] std::vector<int> wallsOfHeat() const;
    /// s: the longest step at the contacts of the last one; infinite before it.
    [[nodiscard]] double longestStep() const { return longest; }

    [[nodiscard]] std::string_view name() const override { return "heat"; }
    [[nodiscard]] bool actsOnRanks() const override { return true; }
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override;
    void check(const StepContext& scene) override;
    void begin(StepContext& scene, bool isRestarted) override;
    void atEnd(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    struct HeldWall {
        double temperature;   // K
        double conductivity;  // W/(m K); infinite
    };

    struct HeatOfWall {
        int wall;       // its number
        ExactSum heat;  // J
    };

    void setMaterialOf(int species, const HeatMaterial& material);
    void noteLosses() const;
    void compareSettings(StateArchive& archive) const;
    void requireTemperatures(StepContext& step) const;
    [[nodiscard]] std::optional<std::string> objectionToSoftening(const ContactLaws& ofScene) const;
    [[nodiscard]] double capacityAt(const StepContext& step, std::uint32_t place) const;
    [[nodiscard]] double storedIn(StepContext& step) const;
    [[nodiscard]] double contactRadius(int a, int b, double effectiveRadius, double overlap) const;
    [[nodiscard]] double conductanceAtWall(const HeldWall& wall, const Bucket& bucket, int species,
                                           const ObservedContact& seen, double radius) const;
    /// Whether a contact conducts that overlaps no more: a neck.
    [[nodiscard]] bool conductsApart(const Bucket& bucket) const;
    /// Calls function(bucket, contact) for each contact of grains here, in the order of identities; on
    /// several ranks, also for those that count on others.
    template <class Function>
    void forEachActing(const StepContext& step, Function&& function) const;
    void readTemperatures(const StepContext& step);
    void conduct(StepContext& step);
    void conductBetween(const StepContext& step, const Bucket& bucket, const ObservedContact& seen,
                        std::uint32_t first, std::uint32_t second);
    void addUpWalls(const StepContext& step);
    void takeLosses(const StepContext& step);
    void refuseStep(const StepContext& step, std::uint32_t place, double bound) const;
    void changeTemperatures(StepContext& step);

    GrainColumnReference temperatures;
    std::map<int, HeatMaterial> materials;  // by species
    std::map<int, HeldWall> heldWalls;      // by number
    std::map<int, double> byWalls;          // J, since the start, by number, also of those held no more
    std::vector<HeatOfWall> ofStep;         // of the held walls that are there, by number
    const ContactLaws* laws = nullptr;      // of the scene, once it is set up
    EnergyAccount* account = nullptr;       // of a run that keeps a ledger
    Conduction conduction = Conduction::Constriction;
    double radiusFactor = 1;  // of contact radii
    bool contactsHeat = false;
    bool hasBegun = false, changedInRun = false;  // of these settings
    HeatLedger heat;
    ExactSum fromWalls, fromContacts, toWalls;  // J, of the step
    double longest = infinity;                  // s
    std::vector<double> flow, source;           // W and J, by place
    std::vector<double> conductances;           // W/K, sum of each grain, by place
    std::vector<double> before;                 // K, at the start of the step, by place
};

}  // namespace pendular
