#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Friction/Shared/RollingTorsion.h"

namespace pendular {

/// What a law with sliding, rolling and torsion remembers of a contact.
template <class T, class Sliding, class Rotation>
struct FrictionSprings {
    Sliding sliding;
    Rotation rotation;

    [[nodiscard]] decltype(auto) slidingSpring() const { return sliding.slidingSpring(); }
    void turn(const FrameRotation<T>& r) {
        sliding.turn(r);
        rotation.turn(r);
    }
    void move(const Vector<T>& shift) { sliding.move(shift); }
    void moveRotation(const Vector<T>& shift, const Vector<T>& normal) { rotation.move(shift, normal); }
};

/// A tangential law with a stiffness that goes with the contact, which its springs of rolling and torsion
/// take, too: fullStiffness(p, contact), N/m.
template <class Tangential>
concept HasFullStiffness = requires(const typename Tangential::Prepared p, const Contact<double>& contact) {
    Tangential::fullStiffness(p, contact);
};
/// Any tangential law, and beside it linear springs against rolling and torsion: see RollingTorsion. Where
/// these have the stiffness of the tangential law, they follow the contact radius as its springs do. Law is
/// the law derived from this; Tangential is a friction law, or the base of one that is derived from Law.
template <class Law, class Tangential>
struct RollingTorsionFriction : Tangential, RollingTorsion<Law> {
    using Rotation = RollingTorsion<Law>;
    static constexpr bool rotatesAsItSlides = HasFullStiffness<Tangential>;
    static constexpr bool keepsForce = rotatesAsItSlides && KeepsForce<Tangential>;

    static constexpr auto fields() { return joinedFields<Law>(Tangential::fields(), Rotation::fields()); }

    static auto setters() { return settersOf<Tangential>(); }

    template <class T>
    using History =
        FrictionSprings<T, typename Tangential::template History<T>,
                        std::conditional_t<keepsForce, FollowingRotationSpring<T>, RollingTorsionSpring<T>>>;

    struct Prepared {
        typename Tangential::Prepared tangential;
        typename Rotation::PreparedRotation rotation;
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal& normal) const {
        return {Tangential::prepare(normal), this->prepareRotation()};
    }

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       History<T>& springs) {
        return sliderForce<Tangential>(p.tangential, contact, normalForce, slip, springs.sliding);
    }
    /// On body 1 (N).
    template <class T>
    [[gnu::always_inline]] static Vector<T> force(const Prepared& p, const Contact<T>& contact, T normalForce,
                                                  const Slip<T>& slip, History<T>& springs) {
        return slide(p, contact, normalForce, slip, springs).force;
    }
    template <class T>
    [[gnu::always_inline]] static RotationForces<T> rotate(const Prepared& p, const Contact<T>& contact,
                                                           T normalForce, const Vector<T>& normal,
                                                           const Slip<T>& turning, History<T>& springs) {
        T stiffness = 0;
        if constexpr (rotatesAsItSlides) stiffness = Tangential::fullStiffness(p.tangential, contact);
        if constexpr (keepsForce) follow(p, contact, springs.rotation);
        return Rotation::turnSprings(p.rotation, stiffness, normalForce, normal, turning, springs.rotation);
    }
    template <class T>
    [[gnu::always_inline]] static Vector<T> rotationForce(const Prepared& p, const Contact<T>& contact,
                                                          T normalForce, const Vector<T>& normal,
                                                          const Slip<T>& turning, History<T>& springs) {
        const RotationForces<T> forces = rotate(p, contact, normalForce, normal, turning, springs);
        return forces.rolling.force + forces.torsion.force;
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return Tangential::stiffness(p.tangential, contact);
    }

    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if constexpr (requires(const Tangential law) { law.objection(bodies); })
            if (auto found = Tangential::objection(bodies)) return found;
        return Rotation::objection(bodies);
    }

private:
    /// Springs with a stiffness of their own do not change with the contact, and stay.
    template <class T>
    [[gnu::always_inline]] static void follow(const Prepared& p, const Contact<T>& contact,
                                              FollowingRotationSpring<T>& spring) {
        const T kept = Tangential::keptStretch(spring.contactRadius, contact.contactRadius);
        if (p.rotation.rolling.shareOfSliding > 0)
            spring.rolling.displacement = kept * spring.rolling.displacement;
        if (p.rotation.torsion.shareOfSliding > 0) spring.torsion = kept * spring.torsion;
        spring.contactRadius = contact.contactRadius;
    }
};

}  // namespace pendular
