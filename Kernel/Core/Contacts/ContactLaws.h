#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Core/Contacts/ContactTiming.h"
#include "Kernel/Core/Contacts/ForceTotals.h"
#include "Kernel/Core/Contacts/OverlapWatch.h"
#include "Kernel/Core/Particles/GrainSpecies.h"
#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/ContactSpot.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"
#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Stiffness.h"
#include "Kernel/Laws/Species/LiquidLaws.h"

namespace pendular {

class CapillaryWatch;
class ContactStore;
class GrainShapes;
struct Bucket;
struct PeriodicBox;
struct SetValues;
class HeldBits;
struct HeldInContacts;
struct TranslationRecord;
struct RotationRecord;

/// How many numbers a contact remembers, and what it gives to its bodies.
struct ContactLayout {
    std::size_t history = 0, normalHistory = 0, interaction = 0;
    std::size_t liquid = 0;         // of a bridge whose volume changes
    std::size_t named = 0;          // columns of a driver's own
    bool hasTorque = false;         // contacts have a tangential force, grains a spin
    bool hasContactTorque = false;  // and a torque besides that of the force

    friend bool operator==(const ContactLayout&, const ContactLayout&) = default;
};

/// A part of a bucket whose forces are to be computed.
struct ContactTask {
    ContactStore& store;
    const TranslationRecord* translation;
    const RotationRecord* rotation;
    const Vector<double>* acceleration;  // m/s^2, of the last step
    const HeldInContacts* held;          // null where no grain is held
    const PeriodicBox& box;
    std::size_t bucket;       // its number
    std::size_t begin, end;   // blocks
    Vector<double> wallSpin;  // rad/s
    double step;              // s
    ContactTiming timing;
    double unlisted;   // m, that bodies can have approached since they were listed
    double longest;    // m, of it until contacts are listed again
    bool withSamples;  // what the ledger reads of contacts is written
    bool asksAhead;    // grains and contacts may be far away, and are asked for before they are read
    OverlapWatch* overlaps;
    CapillaryWatch* capillaryNumbers;
    OwnTotals totals;
    /// s, of a step of no length, between two steps: tangential springs that are kept ahead of their contacts
    /// are so by this time, and are left so; those of touches that have not been seen before begin now.
    double springsAhead = 0;
};

/// A number of a law, with its name and unit.
struct FieldValue {
    std::string_view law, name, unit;
    double value;
};

/// What a scene asks of the laws of its species, whatever they are: SpeciesLaws gives it for a species type,
/// SeveralSpeciesLaws for species of several types. All functions of a pair take the indices of two species.
/// What only liquid needs is in LiquidLaws.
class ContactLaws : public GrainSpecies, public LiquidLaws {
public:
    ContactLayout layout;
    std::string_view name, friction;
    bool actsApart = false;       // bodies act on each other without having touched
    bool formsAtContact = false;  // a bridge that begins with a touch
    bool breaks = false;          // an attraction that ends otherwise than it began: its work is lost then
    bool isPlastic = false;
    bool resistsMotion = false;  // a bridge
    bool hasLargestCapillaryNumber = false;
    bool keepsForce = false;  // tangential springs follow the contact radius: KeepsForce
    OverlapLimit overlapLimit;
    double largestOverlapInRun = usualOverlapInRun;  // of the smaller radius; more ends a run
    std::string_view overlapAdvice = usualOverlapAdvice;

    /// The laws of a pair alone: their own names, layout and flags, where a scene has species of several
    /// types.
    [[nodiscard]] virtual const ContactLaws& ofPair(int /*a*/, int /*b*/) const { return *this; }
    [[nodiscard]] std::string_view typeName(std::size_t species) const final {
        return ofPair(static_cast<int>(species), static_cast<int>(species)).name;
    }
    [[nodiscard]] bool turnGrains() const final { return layout.hasTorque; }
    /// The shapes of the grains of a scene in which they are no spheres; else null.
    [[nodiscard]] virtual GrainShapes* shapes() const { return nullptr; }
    virtual void mixAll() = 0;
    /// Whether a value of a species has been set since mixAll().
    [[nodiscard]] virtual bool hasChanges() const = 0;
    /// @param changedInRun whether values have been changed since the run began
    virtual void visitState(StateArchive& archive, bool& changedInRun) = 0;
    [[nodiscard]] virtual std::vector<FieldValue> fields(int a, int b) const = 0;
    /// Of each species, and of each pair that the driver has given values of its own.
    [[nodiscard]] virtual std::vector<SetValues> setValues() = 0;

    [[nodiscard]] virtual double range(int a, int b, const Bodies& bodies) const = 0;
    [[nodiscard]] virtual std::optional<std::string> objection(int a, int b, const Bodies& bodies) const = 0;
    [[nodiscard]] virtual ContactStiffness stiffness(int a, int b, const Bodies& bodies,
                                                     double effectiveMass) const = 0;
    /// The stiffnesses of many contacts at a time, at the overlaps that they have.
    virtual void stiffnesses(int a, int b, std::span<const PressedPair> contacts,
                             std::span<ContactStiffness> found) const = 0;
    /// The overlap that ends a run, over the smaller radius.
    [[nodiscard]] virtual double largestOverlap(int /*a*/, int /*b*/) const { return largestOverlapInRun; }
    /// N/m, the slope of the normal law at an overlap (m).
    [[nodiscard]] virtual double normalStiffness(int a, int b, const Bodies& bodies,
                                                 double overlap) const = 0;
    /// What is out of the domain of each law, with the law's name.
    [[nodiscard]] virtual std::vector<std::pair<std::string_view, DomainLimit>> brokenLimits(
        int a, int b, const Bodies& bodies) const = 0;

    // The functions below take what contacts remember as numbers.
    /// Prepares the adhesion of a contact; where liquid moves, that of one without a bridge.
    virtual void prepareAdhesion(int a, int b, const Bodies& bodies, double* interaction) const = 0;
    [[nodiscard]] virtual double adhesiveForce(int a, int b, const double* interaction,
                                               double separation) const = 0;
    virtual void turn(int a, int b, double* history, const FrameRotation<double>& rotation) const = 0;
    [[nodiscard]] virtual double springLength(int a, int b, const double* history) const = 0;

    /// Takes the values of the pairs for the buckets of a new list.
    virtual void prepare(const std::vector<Bucket>& buckets) = 0;
    /// The laws with which a bucket of the list, by its number, was prepared.
    [[nodiscard]] virtual const ContactLaws& ofBucket(std::size_t /*bucket*/) const { return *this; }
    /// The forces of a part of a bucket; false if a block needs memory first: it is marked then.
    virtual bool compute(const ContactTask& task) const = 0;

    /// Where the bodies touch at an overlap (m).
    [[nodiscard]] virtual ContactSpot contactSpot(int a, int b, const Bodies& bodies,
                                                  double overlap) const = 0;
};

/// The laws between two species.
struct PairLaws {
    const ContactLaws& laws;
    int a, b;

    [[nodiscard]] double range(const Bodies& bodies) const { return laws.range(a, b, bodies); }
    [[nodiscard]] auto objection(const Bodies& bodies) const { return laws.objection(a, b, bodies); }
};
inline ContactStiffness contactStiffness(const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
    return pair.laws.stiffness(pair.a, pair.b, bodies, effectiveMass);
}

}  // namespace pendular
