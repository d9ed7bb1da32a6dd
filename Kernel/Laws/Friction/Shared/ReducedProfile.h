#pragma once

#include <array>

#include "Kernel/Laws/Friction/Shared/MindlinSpring.h"

namespace pendular {

/// How a short reduced profile divides the contact radius a: spring i stands for the part of it from
/// bounds[i] to bounds[i + 1]. Source of the profile: PartialSlipContact, whose row of independent springs
/// this shortens to a few.
template <std::size_t springs>
struct ProfileBounds {
    std::array<double, springs + 1> bounds;  // from 0 to 1, rising

    [[nodiscard]] constexpr double width(std::size_t i) const { return bounds[i + 1] - bounds[i]; }
    /// The part of the normal force that spring i carries, over its width: the mean of 3/2 (1 - x^2).
    [[nodiscard]] constexpr double load(std::size_t i) const {
        const double a = bounds[i], b = bounds[i + 1];
        return 1.5 - 0.5 * (a * a + a * b + b * b);
    }
    /// The factor of the stiffness 8 G* a with which the springs do the work of Mindlin's contact up to a
    /// slip so large that all slips, under constant load: so they lose as much in a large cycle. Mindlin's
    /// curve is 1 - (1 - y)^(3/2) of the limit, which leaves 2/5 of the limit times the slip at which all
    /// slips, 3 mu P / (16 G* a). A spring of the stiffness 8 G* a and the load l slips at y = 2/3 l, and
    /// leaves half of that times its part of the limit. One spring: 5/6.
    [[nodiscard]] constexpr double factorOfWork() const {
        double left = 0;
        for (std::size_t i = 0; i < springs; ++i) left += width(i) * load(i) * load(i) / 3;
        return left / 0.4;
    }
};

/// By how much a contact radius (m) has grown, over what it has become.
template <class T>
[[gnu::always_inline]] inline T relativeGrowth(T before, T now) {
    constexpr double smallest = 1e-300;  // m
    return (now - before) / max(now, T(smallest));
}

/// What a law with a reduced profile remembers of a contact.
template <class T, std::size_t springs, ProfileBounds<springs> profile>
struct ProfileSprings {
    std::array<TangentialSpring<T>, springs> each;
    T contactRadius;  // m, at the last force

    /// The mean over the contact.
    [[nodiscard]] Vector<T> slidingSpring() const {
        Vector<T> sum = T(profile.width(0)) * each[0].displacement;
        for (std::size_t i = 1; i < springs; ++i) sum += T(profile.width(i)) * each[i].displacement;
        return sum;
    }
    void turn(const FrameRotation<T>& r) {
        for (auto& spring : each) spring.turn(r);
    }
    void move(const Vector<T>& shift) {
        for (auto& spring : each) spring.move(shift);
    }

    /// The springs of a contact whose radius has become a: the parts of the profile stay where they are in
    /// the material, and the bounds move over them (first order, upwind). Where the radius grows, what comes
    /// in from outside has no stretch, so that the force stays; where it shrinks, the outermost goes with its
    /// force. With one spring that is the increment of the force with rescaling on unloading: Thornton,
    /// Cummins and Cleary (2013), Powder Technology 233, 30.
    [[gnu::always_inline]] void follow(T a) {
        const T change = relativeGrowth(contactRadius, a);
        const T grown = max(change, T(0)), shrunk = max(-change, T(0));
        const auto before = each;
        for (std::size_t i = 0; i < springs; ++i) {
            Vector<T>& u = each[i].displacement;
            const Vector<T>& old = before[i].displacement;
            const T gained = min(grown * (profile.bounds[i + 1] / profile.width(i)), T(1));
            if (i + 1 < springs) u += gained * (before[i + 1].displacement - old);
            else u -= gained * old;
            if (i == 0) continue;
            const T lost = min(shrunk * (profile.bounds[i] / profile.width(i)), T(1));
            u += lost * (before[i - 1].displacement - old);
        }
        contactRadius = a;
    }
};

/// The force of the springs with one dashpot beside them, each at most its part of the limit; see
/// slideSpring. The velocity at the end of the step is that of springs that stick; of one spring it is
/// slideSpring.
/// @param stiffness of all together, N/m; @param damping kg/s; @param limit of all together, N
template <class T, std::size_t springs, ProfileBounds<springs> profile>
[[gnu::always_inline]] inline SliderForce<T> slideProfile(T stiffness, T damping, T limit,
                                                          const Slip<T>& slip,
                                                          ProfileSprings<T, springs, profile>& memory) {
    constexpr double smallest = 1e-300;  // N^2: what is less is taken for it in divisions
    const T resistance = stiffness * slip.timeBefore + damping;  // N per m/s
    const Vector<T> mean = memory.slidingSpring();
    const Vector<T> sticking =
        (T(-1) / (T(1) + slip.response * resistance)) * (stiffness * mean + resistance * slip.velocity);
    const Vector<T> drag = resistance * (slip.velocity + slip.response * sticking);

    Vector<T> force{T(0), T(0), T(0)};
    auto slides = limit < T(0);
    for (std::size_t i = 0; i < springs; ++i) {
        const T most = T(profile.load(i)) * limit;
        const Vector<T> wanted = -(stiffness * memory.each[i].displacement + drag);
        const T size2 = squaredNorm(wanted);
        const auto over = size2 > most * most;
        slides = slides | over;
        force += (T(profile.width(i)) * select(over, most / sqrt(max(size2, T(smallest))), T(1))) * wanted;
    }
    const Vector<T> velocity = slip.velocity + slip.response * force;

    auto slips = limit < T(0);
    Vector<T> stretched{T(0), T(0), T(0)};
    for (std::size_t i = 0; i < springs; ++i) {
        Vector<T>& spring = memory.each[i].displacement;
        const T most = T(profile.load(i)) * limit;
        spring += slip.timeBefore * velocity;
        const T size2 = squaredNorm(stiffness * spring);
        const auto over = size2 > most * most;
        slips = slips | over;
        if (any(over)) spring = select(over, most / sqrt(max(size2, T(smallest))), T(1)) * spring;
        stretched += T(profile.width(i)) * spring;
        spring += slip.timeAfter * velocity;
    }
    return {force, stretched, stiffness, slides, slips};
}

/// Mindlin's tangential stiffness over a reduced profile of a few springs. Law is the law derived from this.
template <class Law, std::size_t springs, ProfileBounds<springs> profile>
struct ReducedProfile : MindlinSpring<Law> {
    using Spring = MindlinSpring<Law>;
    template <class T>
    using History = ProfileSprings<T, springs, profile>;

    ReducedProfile() { this->springFactor = profile.factorOfWork(); }

    /// Of a spring over the whole contact: the share of its stretch that is left where the contact radius (m)
    /// has changed; see ProfileSprings::follow().
    template <class T>
    [[gnu::always_inline]] static T keptStretch(T before, T now) {
        return T(1) - min(max(relativeGrowth(before, now), T(0)), T(1));
    }

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const typename Spring::Prepared& p,
                                                       const Contact<T>& contact, T normalForce,
                                                       const Slip<T>& slip, History<T>& memory) {
        const auto opens = contact.contactRadius < memory.contactRadius;
        memory.follow(contact.contactRadius);
        SliderForce<T> result =
            slideProfile(Spring::springStiffness(p, contact), Spring::springDamping(p, contact),
                         p.coefficient * max(normalForce, T(0)), slip, memory);
        // The energy of the outer spring that goes is lost: the ledger counts it as slip. That of a single
        // one follows from its stiffness.
        if constexpr (springs > 1) result.slips = result.slips | opens;
        return result;
    }
};

}  // namespace pendular
