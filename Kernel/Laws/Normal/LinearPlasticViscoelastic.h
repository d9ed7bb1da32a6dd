#pragma once

#include "Kernel/Laws/Normal/Shared/PlasticBranches.h"
#include "Kernel/Laws/Normal/Shared/PlasticSprings.h"

namespace pendular {

/// Luding's linear plastic contact with cohesion: it loads along k1 d, unloads along a steeper slope k2 from
/// its largest overlap d_max on, to zero force at d_0 = (1 - k1/k2) d_max, and then pulls, with at most k_c
/// d. The slope grows with d_max, k2 = k1 + (k_p - k1) d_max / d*, up to k_p at d* = k_p / (k_p - k1) phi 2
/// R*. There the flattening ends: beyond d* the contact loads and unloads along the limit branch
/// k_p (d - phi 2 R*), elastic. A contact that was pulled open along -k_c d reloads from there. Source:
/// Luding (2008), Granular Matter 10, 235, adhesive elasto-plastic contacts (d_max at most d*).
struct LinearPlasticViscoelastic : PlasticSprings<LinearPlasticViscoelastic> {
    static constexpr std::string_view name = "LinearPlasticViscoelastic";
    static constexpr std::string_view summary =
        "linear loading, steeper unloading from the largest overlap, cohesion (Luding)";
    static constexpr std::string_view domain =
        "any overlap; flattens up to the overlap d*, elastic beyond; a contact that has parted forgets its "
        "flattening";

    static constexpr auto fields() { return joinedFields<LinearPlasticViscoelastic>(springFields()); }

    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const { return softUnloading(); }

    template <class T>
    using History = LargestOverlap<T>;

    struct Prepared {
        double loading;      // k1, N/m
        double unloading;    // k_p, N/m
        double cohesion;     // k_c, N/m
        double growth;       // (k_p - k1)^2 / (2 phi k_p) = (k_p - k1) R* / d*, N/m
        double limit;        // d* / R*; infinite where k_p = k1, without flattening
        double dissipation;  // kg/s
    };
    [[nodiscard]] Prepared prepare() const {
        const double difference = unloadingStiffnessMax - loadingStiffness;
        const double hardest = 2 * penetrationDepthMax * unloadingStiffnessMax;
        return {loadingStiffness,
                unloadingStiffnessMax,
                cohesionStiffness,
                difference * difference / hardest,
                difference > 0 ? hardest / difference : infinity,
                dissipation};
    }

    /// The overlap is its own measure.
    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact, LargestOverlap<T>& history) {
        const T overlap = contact.overlap;
        const T largest = min(max(history.largest, overlap), p.limit * contact.effectiveRadius);
        const T growth = p.growth / contact.effectiveRadius;
        const PlasticBranches<T> branches(overlap, largest, T(p.loading), slope(p, growth, largest),
                                          T(p.cohesion));
        history.largest = select(branches.isCohesive(), reloaded(p, growth, overlap), largest);
        return {branches.force(), T(p.dissipation)};
    }
    /// The elastic energy of the branch of unloading; beyond d* it is that of loading, too.
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact,
                                const LargestOverlap<double>& history) {
        const double k2 = slope(p, p.growth / contact.effectiveRadius, history.largest);
        const double force = k2 * (contact.overlap - history.largest) + p.loading * history.largest;
        return 0.5 * force * force / k2;
    }

private:
    /// k2 (N/m) at the largest overlap.
    template <class T>
    static T slope(const Prepared& p, T growth, T largest) {
        return min(p.loading + growth * largest, T(p.unloading));
    }
    /// The largest overlap m (m), below d*, whose branch of unloading meets the cohesive one at the overlap
    /// d: (k2 + k_c) d = (k2 - k1) m with k2 = k1 + growth m.
    template <class T>
    static T reloaded(const Prepared& p, T growth, T d) {
        constexpr double smallest = 1e-300;  // where k_p = k1, no branch is cohesive
        const T half = T(0.5) * d;
        return half + sqrt(half * half + d * (T(p.loading + p.cohesion) / max(growth, T(smallest))));
    }
};

}  // namespace pendular
