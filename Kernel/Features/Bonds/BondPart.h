#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Bonds/BondLaw.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

/// What bonds are made of.
struct BondMaterial {
    double radius = unset;  // m, of the section
    /// By the length (m) of a bond at rest.
    std::function<BondStiffness(const BondSection&, double)> stiffness = {};
    BondStrength strength = {};
    double damping = 0;  // of the critical one of each of the four springs, between two free grains
};

/// Bonds that join grains as short beams and break. They act beside the contacts, from where the grains are
/// when they are joined. Grains have orientations from their first bond on. A bond breaks at the end of a
/// step, all at once, by the forces at that moment; what it has stored then is lost in fracture.
///
///     auto& bonds = scene.addPart<BondPart>();
///     const auto cement = bonds.addMaterial({.radius = 5e-4, .stiffness = ..., .strength = {.tensile =
///     1e6}}); bonds.join(a, b, cement);
class BondPart : public StepPart {
public:
    /// Throws InputError for values out of range.
    std::size_t addMaterial(const BondMaterial& material);
    /// Joins two grains, by their identities, at set-up or in a run: where they are at the start of the next
    /// step, which acts. Throws InputError there for grains that are not in the scene, or joined already. In
    /// a periodic scene it joins the nearest images, and stays with them however far they part.
    /// @param length m, at rest; 0: the distance at which they are
    void join(std::uint32_t first, std::uint32_t second, std::size_t material, double length = 0);

    struct Bond {
        std::uint32_t first, second;  // identities
        std::uint32_t material;
        std::uint32_t at1, at2;  // where its grains are among those that are joined
        BondStiffness stiffness;
        double length;              // m, at rest
        Quaternion frame1, frame2;  // its triad in each grain
        Vector<double> between;     // m, from the first to the image of the second, in the last step
        BondLoad elastic, damping;  // of the last step
    };
    [[nodiscard]] const std::vector<Bond>& all() const { return bonds; }
    [[nodiscard]] std::size_t broken() const { return brokenCount; }
    /// The orientation of a grain since its first bond.
    [[nodiscard]] Quaternion orientationOf(std::uint32_t identity) const;
    /// s: a step that bonds alone are stable with, at least.
    [[nodiscard]] double largestStep(const StepContext& scene) const;

    [[nodiscard]] std::string_view name() const override { return "bonds"; }
    [[nodiscard]] bool actsOnRanks() const override { return true; }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override;
    void check(const StepContext& scene) override;
    void addAccelerations(StepContext& step, std::span<const std::uint32_t> places) override;
    void prepare(StepContext& step) override;
    void beforeMotion(StepContext& step) override;
    void afterForces(StepContext& step) override;
    void accelerate(StepContext& step) override;
    void finish(StepContext& step) override;
    void takeOver(StepContext& /*scene*/, const SceneChanges& /*changes*/) override { longest.reset(); }
    void takeBack(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    /// A grain that is bonded.
    struct Joined {
        std::uint32_t identity, place;                    // place: of this step; none on another rank
        Quaternion orientation, before;                   // now, and at the start of the step
        Vector<double> velocity{0, 0, 0}, spin{0, 0, 0};  // m/s, rad/s, at the start of the step
        // m/s, rad/s, before the forces of the step give it a part of their motion
        Vector<double> velocityBefore{0, 0, 0}, spinBefore{0, 0, 0};
        Vector<double> force{0, 0, 0}, torque{0, 0, 0};              // N, N m, sums of its bonds
        Vector<double> forceBefore{0, 0, 0}, torqueBefore{0, 0, 0};  // the same, of the last step
        // m/s^2, rad/s^2, as the last step has left them
        Vector<double> acceleration{0, 0, 0}, angularAcceleration{0, 0, 0};
    };
    /// How a grain moves that is on another rank.
    struct Elsewhere {
        TranslationRecord moving{};
        RotationRecord turning{};
        HeldBits held{};
    };
    struct Pair {
        std::uint32_t first, second, material;
    };
    struct ToJoin : Pair {
        double length;  // m
    };
    /// The work (J) of bonds in a step.
    struct Work {
        ExactSum elastic, damping, onHeld;
    };

    [[nodiscard]] BondStiffness stiffnessOf(std::uint32_t material, double length) const;
    [[nodiscard]] std::uint32_t joinedAt(std::uint32_t identity);
    void findPlaces(const ParticleStore& grains);
    /// Finds the grains. On several ranks, which all have all bonds, each tells the others how its own grains
    /// move.
    void findGrains(StepContext& step);
    void shareAccelerations(StepContext& step);
    /// Which of them are in the scene, on any rank.
    [[nodiscard]] std::vector<bool> areThere(const StepContext& step) const;
    [[nodiscard]] const TranslationRecord& movingOf(const ParticleStore& grains, const Joined& one) const;
    [[nodiscard]] const RotationRecord& turningOf(const ParticleStore& grains, const Joined& one) const;
    [[nodiscard]] HeldBits heldOf(const ParticleStore& grains, const Joined& one) const;
    [[nodiscard]] BondState stateOf(const StepContext& step, const Bond& bond) const;
    [[nodiscard]] BondLoad dampingOf(const StepContext& step, const Bond& bond, const BondState& state) const;
    [[nodiscard]] double energy(const StepContext& step) const;
    [[nodiscard]] bool areAsked(const AllRanks& ranks) const;
    void joinNew(StepContext& step);
    void renewForces(StepContext& step);
    void addWork(const StepContext& step, const Bond& bond, Work& work) const;
    void visitWaiting(StateArchive& archive);
    static void changeAcceleration(ParticleStore& grains, std::uint32_t place, const Vector<double>& force,
                                   const Vector<double>& torque);
    void refuseStep(const StepContext& step);
    void turnGrains(StepContext& step);
    void computeLoads(StepContext& step);
    void push(StepContext& step, double time);
    void breakBonds(StepContext& step);
    [[nodiscard]] double power(const StepContext& step, const Bond& bond, const BondLoad& load) const;
    void account(StepContext& step) const;

    std::vector<BondMaterial> materials;
    std::vector<ToJoin> toJoin;
    std::vector<Bond> bonds, atBegin;                // now, and at the start of the step
    std::vector<Joined> joined;                      // in the order of their first bonds
    std::vector<Elsewhere> elsewhere;                // of each of these, on several ranks
    std::map<std::uint32_t, std::uint32_t> numbers;  // among these, by identity
    double stored = 0;                               // J, at the end of the last step
    std::optional<double> longest;                   // s, the longest stable step, where it is known
    bool isAccelerated = false;                      // the velocities have the forces of this step
    std::size_t brokenCount = 0;
};

}  // namespace pendular
