#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Core/Contacts/LocalBodies.h"
#include "Kernel/Core/Contacts/SpeciesLaws.h"
#include "Kernel/Features/Superquadrics/AdhesionOfShapes.h"
#include "Kernel/Features/Superquadrics/SuperquadricHandler.h"

namespace pendular {

/// The laws of one species type for superquadrics. Contacts remember the normal of the last step, with which
/// the search for the next one begins, behind what the normal law remembers; and before it the torque of
/// rolling and torsion.
template <class S>
class SuperquadricLaws final : public SpeciesLaws<S> {
    static_assert(
        actsBetweenShapes<typename S::Adhesion>,
        "Superquadrics have only adhesion that is prepared quickly for new radii, of liquid that does not "
        "move: JKR, DMT, ReversibleAdhesive, IrreversibleAdhesive, or LiquidBridge... Willett, "
        "ClassicalWillett, Bagheri, Lambert, Mikami, LianSeville, YoungLaplace.");

    static constexpr std::size_t kept = S::hasContactTorque ? 6 : 3;  // numbers of the last step
    static_assert(layoutOf<S>.normalHistory + kept <= std::tuple_size_v<ContactNumbers>);

public:
    SuperquadricLaws(SpeciesHandler<S>& speciesHandler, SuperquadricHandler& superquadricHandler)
        : SpeciesLaws<S>(speciesHandler), superquadrics(superquadricHandler) {
        this->layout.normalHistory += kept;
        this->layout.hasTorque = this->layout.hasContactTorque = true;
        if constexpr (S::Adhesion::acts) superquadrics.setAdhesive();
    }

    /// The largest of the bodies as they can be seen: dry laws reach farthest where the bodies are flat,
    /// bridges where they are sharp.
    [[nodiscard]] double range(int a, int b, const Bodies& bodies) const override {
        if constexpr (!S::Adhesion::acts) return SpeciesLaws<S>::range(a, b, bodies);
        double largest = 0;
        for (const Bodies& seen : extremes(a, b, bodies))
            largest = std::max(largest, SpeciesLaws<S>::range(a, b, seen));
        return largest;
    }
    [[nodiscard]] std::optional<std::string> objection(int a, int b, const Bodies& bodies) const override {
        if constexpr (requires(typename S::Mixed laws) { laws.solveOutsideTable; })
            if (this->of(a, b).solveOutsideTable > 0 && this->of(a, b).liquidBridgeVolume > 0)
                return fmt::format(
                    "{}: setSolveOutsideTable(true) is for scenes of spheres: superquadrics have other radii "
                    "as they turn, so that the equation would be solved in each step, in 0.3 ms a bridge; "
                    "leave it out, and take volumes of the table.",
                    S::Adhesion::name);
        if (auto found = SpeciesLaws<S>::objection(a, b, bodies)) return found;
        if constexpr (S::Adhesion::acts)
            for (const Bodies& seen : extremes(a, b, bodies))
                if (const auto found = SpeciesLaws<S>::objection(a, b, seen))
                    return fmt::format(
                        "{} Where these superquadrics are {}, their effective radius is {:.6g} m; it is "
                        "{:.6g} m of the spheres around them.",
                        *found, seen.effectiveRadius() > bodies.effectiveRadius() ? "flat" : "sharp",
                        seen.effectiveRadius(), bodies.effectiveRadius());
        return {};
    }
    /// Of bodies that can be seen so that they are out of the domain.
    [[nodiscard]] std::vector<std::pair<std::string_view, DomainLimit>> brokenLimits(
        int a, int b, const Bodies& bodies) const override {
        auto found = SpeciesLaws<S>::brokenLimits(a, b, bodies);
        if constexpr (S::Adhesion::acts)
            for (const Bodies& seen : extremes(a, b, bodies)) {
                auto more = SpeciesLaws<S>::brokenLimits(a, b, seen);
                found.insert(found.end(), more.begin(), more.end());
            }
        return found;
    }

    /// At Gauss' radius R where it is largest: a stiffness that goes with sqrt(R x overlap), of an overlap
    /// that is a share of the radius, goes with the root of R when both lengths do.
    [[nodiscard]] ContactStiffness stiffness(int a, int b, const Bodies& bodies, double mass) const override {
        const double factor = std::sqrt(superquadrics.largestRadiusRatio());
        ContactStiffness found =
            SpeciesLaws<S>::stiffness(a, b, {factor * bodies.radius1, factor * bodies.radius2}, mass);
        found.rolling = superquadrics.largestTurningRatio() * found.rolling;
        found.torsion = superquadrics.largestTurningRatio() * found.torsion;
        return found;
    }
    [[nodiscard]] GrainShapes* shapes() const override { return &superquadrics; }
    void visitState(StateArchive& archive, bool& changedInRun) override {
        SpeciesLaws<S>::visitState(archive, changedInRun);
        archive.group("superquadrics", [&] { superquadrics.visitState(archive); });
    }
    bool compute(const ContactTask& task) const override {
        return this->computeBlocks(task, [&](std::size_t block) {
            return superquadrics.geometryOf(task, block, S::Adhesion::acts ? this : nullptr);
        });
    }

private:
    /// Bodies as flat, and as sharp, as adhesion can see them, alike and one flat beside the other.
    ///
    /// Flat: sqrt(det(K1 + K2)) >= sqrt(det K1) + sqrt(det K2) (Minkowski), so that Gauss' radius of a pair
    /// is at most that of two spheres of the largest radii. Sharp: no principal curvature of K1 + K2 is above
    /// the sum of the largest ones.
    [[nodiscard]] std::array<Bodies, 4> extremes(int a, int b, const Bodies& around) const {
        const LocalBodies local(around, this->bridgeVolume(a, b).value_or(0));
        const double radius = around.effectiveRadius(), flat = superquadrics.largestRadiusRatio() * radius,
                     sharp = superquadrics.smallestRadiusRatio() * radius;
        const Bodies oneFlat{1}, alike = std::isinf(around.radius2) ? oneFlat : Bodies{1, 1};
        return {local.with(flat, alike), local.with(sharp, alike), local.with(flat, oneFlat),
                local.with(sharp, oneFlat)};
    }
    SuperquadricHandler& superquadrics;
};

}  // namespace pendular
