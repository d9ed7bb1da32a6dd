#pragma once

#include "Kernel/Contacts/SpeciesLaws.h"
#include "Kernel/Superquadrics/DryAdhesion.h"
#include "Kernel/Superquadrics/SuperquadricHandler.h"

namespace pendular {

/// The laws of one species type for superquadrics. Contacts remember the normal of the last step, with which
/// the search for the next one begins, behind what the normal law remembers; and before it the torque of
/// rolling and torsion.
template <class S>
class SuperquadricLaws final : public SpeciesLaws<S> {
    static_assert(knowsRadiusOnly<typename S::Adhesion>,
                  "Superquadrics have no liquid bridges: take a species with JKR, DMT, ReversibleAdhesive or "
                  "IrreversibleAdhesive, or without adhesion.");

    static constexpr std::size_t kept = S::hasContactTorque ? 6 : 3;  // numbers of the last step
    static_assert(layoutOf<S>.normalHistory + kept <= std::tuple_size_v<ContactNumbers>);

public:
    SuperquadricLaws(SpeciesHandler<S>& speciesHandler, SuperquadricHandler& superquadricHandler)
        : SpeciesLaws<S>(speciesHandler), superquadrics(superquadricHandler) {
        this->layout.normalHistory += kept;
        this->layout.hasTorque = this->layout.hasContactTorque = true;
        if constexpr (S::Adhesion::acts) superquadrics.setAdhesive();
    }

    /// Where Gauss' radius is largest: sqrt(det(K1 + K2)) >= sqrt(det K1) + sqrt(det K2) (Minkowski), so that
    /// the radius of a pair is at most that of two spheres of the largest radii.
    [[nodiscard]] double range(int a, int b, const Bodies& bodies) const override {
        const double factor = superquadrics.largestRadiusRatio();
        return SpeciesLaws<S>::range(a, b, {factor * bodies.radius1, factor * bodies.radius2});
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
    SuperquadricHandler& superquadrics;
};

}  // namespace pendular
