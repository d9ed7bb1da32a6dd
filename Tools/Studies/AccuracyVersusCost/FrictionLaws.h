#pragma once

#include "Kernel/Features/Laws.h"
#include "Kernel/Laws/Friction/MindlinIncremental.h"
#include "Kernel/Laws/Friction/MindlinPartialSlip.h"
#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Tools/Reference/ElasticImpact.h"

// The friction laws that are compared with the exact contact, each as a contact that can be moved.

namespace pendular::friction {

/// Mindlin's increments without rescaling: a contact that opens keeps its force up to the limit.
struct IncrementsOnly : ReducedProfile<IncrementsOnly, 1, ProfileBounds<1>{{0, 1}}> {
    static constexpr std::string_view name = "increments without rescaling";

    template <class T>
    static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact, T normalForce,
                                const Slip<T>& slip, History<T>& memory) {
        // The force of the last step, as a stretch of today's stiffness.
        memory.each[0].displacement *= memory.contactRadius / max(contact.contactRadius, T(1e-300));
        memory.contactRadius = contact.contactRadius;
        return ReducedProfile::slide(p, contact, normalForce, slip, memory);
    }
};

/// Reduced profiles of other numbers of springs. Two are divided at 0.65, near which both the force under
/// constant load and random loads err least; eight evenly.
struct TwoSprings : ReducedProfile<TwoSprings, 2, ProfileBounds<2>{{0, 0.65, 1}}> {
    static constexpr std::string_view name = "two springs";
};
struct EightSprings
    : ReducedProfile<EightSprings, 8, ProfileBounds<8>{{0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1}}> {
    static constexpr std::string_view name = "eight springs";
};

/// A law under its name in tables.
template <class OfLaw>
struct NamedLaw {
    using Law = OfLaw;
    std::string_view name;
    double springFactor = unset;  // the law's own
};

/// Calls function(namedLaw) for each. The linear one has the stiffness of the contact at half the largest
/// overlap.
template <class Function>
void forEachLaw(Function&& function) {
    function(NamedLaw<Mindlin>{"Mindlin"});
    function(NamedLaw<Mindlin>{"Mindlin (factor 1)", 1});
    function(NamedLaw<MindlinSecant>{"MindlinSecant"});
    function(NamedLaw<SlidingFriction>{"SlidingFriction"});
    function(NamedLaw<IncrementsOnly>{"increments without rescaling"});
    function(NamedLaw<MindlinIncremental>{"MindlinIncremental (factor 1)", 1});
    function(NamedLaw<MindlinIncremental>{"MindlinIncremental"});
    function(NamedLaw<TwoSprings>{"two springs"});
    function(NamedLaw<MindlinPartialSlip>{"MindlinPartialSlip"});
    function(NamedLaw<EightSprings>{"eight springs"});
}

template <class Named>
typename Named::Law lawOf(const Named& named, const PartialSlipConditions& conditions,
                          double largestOverlap) {
    typename Named::Law law;
    law.setSlidingFrictionCoefficient(conditions.friction);
    law.setSlidingDissipation(0);
    if constexpr (requires { law.setSlidingStiffness(1.0); }) {
        law.setSlidingStiffness(8 * conditions.shearModulus * conditions.contactRadius(0.5 * largestOverlap));
    } else {
        law.setEffectiveShearModulus(conditions.shearModulus);
        if (isSet(named.springFactor)) law.setSpringFactor(named.springFactor);
    }
    return law;
}

/// A contact with a law of friction, moved by hand: a TangentialContact. Its memory starts with the touch and
/// ends with it, as in the kernel.
template <class Named>
class LawContact {
public:
    using Law = typename Named::Law;

    LawContact(const Named& named, const PartialSlipConditions& given, double largestOverlap)
        : conditions(given), prepared(lawOf(named, given, largestOverlap).prepare(AnyNormalLaw{})) {}

    void move(double overlap, const Vector<double>& way) {
        if (overlap <= 0) {
            history = {};
            force = {0, 0, 0};
            return;
        }
        const Contact<double> contact(overlap, conditions.effectiveRadius, 1);
        const Slip<double> slip{.velocity = way, .timeBefore = 1, .timeAfter = 0};
        force = Law::force(prepared, contact, conditions.normalForce(overlap), slip, history);
    }
    [[nodiscard]] const Vector<double>& tangentialForce() const { return force; }

private:
    PartialSlipConditions conditions;
    typename Law::Prepared prepared;
    typename Law::template History<double> history{};
    Vector<double> force{0, 0, 0};
};

}  // namespace pendular::friction
