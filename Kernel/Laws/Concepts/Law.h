#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/Field.h"

// clang-format off
/// What a contact law is. A species is composed of three: a normal, a friction and an adhesion law. Each has a
/// table of fields and three moments:
/// - prepare(), once when species are mixed (normal, friction) or when a contact is listed (adhesion): every
///   costly function belongs here;
/// - force(), in each step, on T = double in tests and tools and on T = Pack in the kernel: + - * / sqrt select,
///   and exponential2 and logarithm2 where a law cannot do without;
/// - range(), the largest separation of the surfaces at which the law can act (m): the neighbour search and the
///   rupture of a bridge use this same number.
// clang-format on

namespace pendular {

/// One touching contact as the normal and the friction law see it.
template <class T>
struct Contact {
    T overlap;          // m, greater than 0
    T effectiveRadius;  // m, r1 r2 / (r1 + r2)
    T effectiveMass;    // kg, m1 m2 / (m1 + m2)
    T contactRadius;    // a, m, sqrt(effective radius x overlap): Hertz
    T massRoot;  // sqrt(effective mass x a), kg^(1/2) m^(1/2): Hertzian dashpots are proportional to it

    Contact() = default;
    Contact(T touchOverlap, T radius, T mass)
        : overlap(touchOverlap),
          effectiveRadius(radius),
          effectiveMass(mass),
          contactRadius(sqrt(radius * touchOverlap)),
          massRoot(sqrt(mass * contactRadius)) {}
};

/// The normal force of a contact is elastic - damping x (speed of separation).
template <class T>
struct NormalForce {
    T elastic;  // N, positive where it pushes the bodies apart
    T damping;  // kg/s
};

/// The tangential motion of a contact at the moment at which the force F is wanted: its velocity then is
/// velocity + response x F, so that a law can be implicit in its own force.
template <class T>
struct Slip {
    Vector<T> velocity;  // m/s, of body 1 against body 2 at the contact point, without its normal part and
                         // without F
    T timeBefore;        // s, for which a spring has moved with the velocity since it was stored
    T timeAfter;         // s, for which it will move with it until it is stored again
    T response = T(0);   // m/s per N on body 1
};

/// The force of a spring with dashpot and slider, and its origin: the spring's part is -stiffness x spring.
template <class T>
struct SliderForce {
    Vector<T> force;   // N
    Vector<T> spring;  // m, at the moment of the force
    T stiffness;       // N/m
    MaskOf<T> slides;  // the force was cut
    MaskOf<T> slips;   // the spring was shortened
};

/// The memory of a law that remembers nothing.
template <class T>
struct NoHistory {};

/// The small rotation of a contact in a step, which the history of a friction law follows in its turn().
template <class T>
struct FrameRotation {
    Vector<T> normal;       // n, now; from body 1 to body 2
    Vector<T> normalShift;  // m/m, n now - n at the last step
    T twist;                // rad, about n: mean of the two bodies
};

template <class Law>
concept HasFieldTable = requires {
    { Law::name } -> std::convertible_to<std::string_view>;
    { Law::summary } -> std::convertible_to<std::string_view>;
    { Law::domain } -> std::convertible_to<std::string_view>;
    Law::fields();
};

template <class Law>
concept HasRange = requires(const Law law, const Bodies bodies) {
    { law.range(bodies) } -> std::convertible_to<double>;
};

/// A normal law whose force depends on what the overlap was before (plastic ones): its functions take its
/// History<T> as well. What a contact remembers is zero at its first touch, and forgotten where it parts.
template <class Law>
concept HasNormalHistory = requires {
    typename Law::template History<double>;
};
template <class Law>
struct NormalHistoryOf {
    template <class T>
    using type = NoHistory<T>;
};
template <HasNormalHistory Law>
struct NormalHistoryOf<Law> {
    template <class T>
    using type = typename Law::template History<T>;
};

/// A normal law whose contacts change with time at a given overlap: creep(p, contact, step, history) brings
/// the history on by the step (s) that has come to its end, at the overlap there, before the force: a rate
/// that depends on the force must be implicit in it, as no limit of the step includes it. It must not raise
/// the elastic energy, of which it has taken creepLoss(p, contact, before, after), J.
template <class Law>
concept Creeps = HasNormalHistory<Law> &&
    requires(const typename Law::Prepared p, const Contact<double>& contact,
             typename NormalHistoryOf<Law>::template type<double> history) {
    Law::creep(p, contact, 1.0, history);
    { Law::creepLoss(p, contact, history, history) } -> std::same_as<double>;
};

/// A normal law with an attraction of its own while bodies touch, pull(p, effective radius) in N: it counts
/// as adhesion, so that friction sees only what pushes.
template <class Law>
concept PullsInContact = requires(const typename Law::Prepared p) {
    { Law::pull(p, 1.0) } -> std::same_as<double>;
};

/// The normal force of a law with or without a history, which it brings up to date.
template <class Law, class T, class History>
[[gnu::always_inline]] inline NormalForce<T> normalForce(const typename Law::Prepared& p,
                                                         const Contact<T>& contact,
                                                         [[maybe_unused]] History& history) {
    if constexpr (HasNormalHistory<Law>) return Law::force(p, contact, history);
    else return Law::force(p, contact);
}
/// The energy (J) that the overlap gives back.
template <class Law, class History>
double elasticEnergy(const typename Law::Prepared& p, const Contact<double>& contact,
                     [[maybe_unused]] const History& history) {
    if constexpr (HasNormalHistory<Law>) return Law::elasticEnergy(p, contact, history);
    else return Law::elasticEnergy(p, contact);
}

template <class Law, class T>
concept HasNormalForce = requires(const typename Law::Prepared p, const Contact<T>& contact,
                                  typename NormalHistoryOf<Law>::template type<T> history) {
    { normalForce<Law>(p, contact, history) } -> std::same_as<NormalForce<T>>;
}
&&(HasNormalHistory<Law> || requires(const typename Law::Prepared p, const Contact<T>& contact) {
    { Law::force(p, contact) } -> std::same_as<NormalForce<T>>;
});

template <class Law>
concept NormalLaw = HasFieldTable<Law> && HasRange<Law> && HasNormalForce<Law, double> &&
    HasNormalForce<Law, Pack> &&
    requires(const Law law, const typename Law::Prepared p, const Contact<double>& contact) {
    { law.prepare() } -> std::same_as<typename Law::Prepared>;
    requires HasNormalHistory<Law> || requires {
        { Law::elasticEnergy(p, contact) } -> std::same_as<double>;  // J, stored in the overlap
    };
    { Law::stiffness(p, contact) } -> std::same_as<double>;  // N/m, largest slope of the elastic force
    {
        Law::elasticExponent
        } -> std::convertible_to<double>;  // powers of the overlap with which the two parts
    {
        Law::dampingExponent
        } -> std::convertible_to<double>;  // grow from the start of a touch: see SampleTiming
};

/// What a friction law remembers of a contact: its History<T>.
template <class History, class T>
concept FrictionHistory = requires(History history, const History& kept, const FrameRotation<T>& rotation,
                                   const Vector<T>& way) {
    { kept.slidingSpring() } -> std::convertible_to<Vector<T>>;  // m, of body 1 against body 2, tangential
    history.turn(rotation);
    history.move(way);  // m; springs are moved from outside with ContactTiming::springsInStep
};

/// A law with a torque of its own has springs of rolling and torsion that are moved from outside as well:
/// moveRotation(way of R* times the relative spin, normal).
template <class Law, class T>
concept MovesRotation = !requires {
    requires Law::hasContactTorque;
}
|| requires(typename Law::template History<T> history, const Vector<T>& way, const Vector<T>& normal) {
    history.moveRotation(way, normal);
};

template <class Law, class T>
concept HasFrictionForce = requires(const typename Law::Prepared p, const Contact<T>& contact, T normalForce,
                                    const Slip<T>& slip, typename Law::template History<T> history) {
    { Law::force(p, contact, normalForce, slip, history) } -> std::same_as<Vector<T>>;
};

/// Stands for any normal law where a concept asks for a function of one.
struct AnyNormalLaw {};

/// The friction force with how it comes about, from laws that say so in a function slide() with the arguments
/// of force(); for others all work is taken for that of sliding.
template <class Law, class T, class History>
[[gnu::always_inline]] inline SliderForce<T> sliderForce(const typename Law::Prepared& p,
                                                         const Contact<T>& contact, T normalForce,
                                                         const Slip<T>& slip, History& history) {
    if constexpr (requires { Law::slide(p, contact, normalForce, slip, history); })
        return Law::slide(p, contact, normalForce, slip, history);
    else
        return {Law::force(p, contact, normalForce, slip, history),
                {T(0), T(0), T(0)},
                T(0),
                normalForce == normalForce,
                normalForce == normalForce};
}

/// `acts` is false for the law that does nothing: its species have no tangential force, no torque and no
/// spin.
template <class Law>
concept FrictionLaw = HasFieldTable<Law> && HasRange<Law> && std::same_as<decltype(Law::acts), const bool> &&
    requires(const Law law) {
    { law.prepare(AnyNormalLaw{}) } -> std::same_as<typename Law::Prepared>;
} &&(!Law::acts ||
     (HasFrictionForce<Law, double> && HasFrictionForce<Law, Pack> &&
      FrictionHistory<typename Law::template History<double>, double> &&
      FrictionHistory<typename Law::template History<Pack>, Pack> && MovesRotation<Law, double> &&
      MovesRotation<Law, Pack> && requires(const typename Law::Prepared p, const Contact<double>& contact) {
          { Law::stiffness(p, contact) } -> std::same_as<double>;  // N/m, of the tangential spring
      }));

/// A friction law whose springs follow the contact radius: where it grows they keep their force, and not
/// their stretch. keptStretch(a0, a) is the share of the stretch that is left of a spring over the whole
/// contact where the radius a0 has become a (m).
template <class Law>
concept KeepsForce = requires {
    { Law::keptStretch(1.0, 1.0) } -> std::same_as<double>;
};

/// A friction law that gives torques of its own to the two bodies (rolling, torsion), besides those of the
/// tangential force:
///     rotationForce(p, contact, normalForce, normal, turning, history): the torque on body 1 over the
///     effective radius (N), `turning` the motion of the effective radius times the relative spin (rad/s x
///     m); rotate(...), with the same arguments: the two parts of it, as RotationForces.
template <class Law>
concept HasContactTorque = requires {
    requires Law::hasContactTorque;
};

template <class Law, class T>
concept HasAdhesionForce = requires(const typename Law::template Interaction<T> interaction, T separation) {
    {
        interaction.force(separation)
        } -> std::same_as<T>;                    // N, attraction positive; separation in m: separationFor
    { interaction.range() } -> std::same_as<T>;  // m
};

/// The motion of its ends that a bridge resists, besides its force; each has those before it. A law says so
/// by a member `resists`; one without it feels the separation only, and its scenes pay for nothing else.
enum class BridgeResists { Nothing, Approach, Sliding, Rolling };
template <class Law>
inline constexpr BridgeResists bridgeResists = [] {
    if constexpr (requires { Law::resists; }) return Law::resists;
    else return BridgeResists::Nothing;
}();

/// Of a law that resists motion, for how many contacts of a grain its own implicit dashpot stands: n. The
/// velocity of a contact is found from the last one as if the change of its own force moved its bodies n
/// times as far. A steady force does not change, so nothing is different then; but where the resistance is
/// large, the force of a mode of which the contacts of a bed add up to L times that of one goes by the factor
/// (n - 2 L) / n in a step: with n > L any resistance is stable. With 1, the default, the resistance must be
/// known to the limit of the step.
template <class Law>
inline constexpr double implicitNeighbours = [] {
    if constexpr (requires { Law::implicitNeighbours; }) return Law::implicitNeighbours;
    else return 1.0;
}();

/// How the ends of a bridge move in a step.
template <class T>
struct BridgeMotion {
    T separation;       // m, of the surfaces; negative where they overlap
    T approach;         // m/s, of the surfaces, predicted for the end of the step
    T step;             // s, the last one; zero at the start of a scene
    T coming;           // s, the next one
    T effectiveRadius;  // m
    T inverseMass;      // 1/kg, of the effective mass
    T push;             // N, normal repulsion by what else acts in the contact
    T last;             // N, normal repulsion by all that acted in it at the last step
    T asymmetry;        // (r2 - r1) / (r1 + r2), 1 at a wall; 0 for a law that does not resist rolling
    MaskOf<T> forms;    // the bridge was not there in the last step: what it remembers starts
};

/// The resistance of a bridge to the motion of its ends, as coefficients (kg/s), so that the kernel can make
/// the forces implicit. With the slip u (m/s) of surface 1 against surface 2, and W = R* n x (spin 1 - spin
/// 2), the speed (m/s) with which body 1 rolls along the surface of body 2, the bridge gives body 1
///     the normal force  -(normal x approach + force),
///     the tangential force  F = -(sliding u + coupling W)  at the contact point, and
///     the torque  R* m x n  with  m = -(coupling u + rolling W);
/// body 2 gets the opposite. Against the twist about n there is nothing. Source of the form: the resistance
/// matrix of lubrication theory, Jeffrey and Onishi (1984), J. Fluid Mech. 139, which is symmetric and
/// positive definite: sliding x rolling > coupling^2. `force` is for a law that makes its normal force
/// implicit by itself.
template <class T>
struct BridgeResistance {
    T normal = T(0), sliding = T(0), coupling = T(0), rolling = T(0);
    T force = T(0);  // N, repulsion
};

/// A law whose bridge resists motion: its Interaction has a function resist(law, motion), which may change
/// what the interaction remembers; takeState(law, before), which takes over what a bridge remembers when it
/// is prepared again; and checkGap(separation, roundOff), which forgets how bodies moved that have been put
/// somewhere else between two steps.
/// largestResistance(bodies) is for the stability limit.
template <class Law, class T>
concept HasResistance = requires(const Law law, typename Law::template Interaction<T> interaction,
                                 const BridgeMotion<T>& motion) {
    { interaction.resist(law, motion) } -> std::same_as<BridgeResistance<T>>;
};
template <class Law>
concept ResistsAsItSays = (bridgeResists<Law> == BridgeResists::Nothing
                               ? !HasResistance<Law, double>
                               : HasResistance<Law, double> && HasResistance<Law, Pack> &&
                                     requires(const Law law, const Bodies bodies,
                                              typename Law::template Interaction<double> bridge) {
                                         {
                                             law.largestResistance(bodies)
                                             } -> std::same_as<BridgeResistance<double>>;
                                         bridge.takeState(law, bridge);
                                         bridge.checkGap(0.0, 0.0);
                                     });

/// A bridge that ruptures later the faster its ends part: range(law, opening) is the rupture distance (m) at
/// the speed of opening (m/s), at most that of the law's range(), and force(law, separation, range) the force
/// until there.
template <class Law>
concept HasDynamicRupture = requires(const Law law, const typename Law::template Interaction<double> bridge) {
    { bridge.range(law, 1.0) } -> std::same_as<double>;
    { bridge.force(law, 1.0, 1.0) } -> std::same_as<double>;
};

/// A bridge whose law has a largest capillary number, for which its range is made: numberAboveBound(law,
/// separation, speed of opening) is its capillary number where that is larger, and else 0.
template <class Law>
concept HasLargestCapillaryNumber = requires(const Law law,
                                             const typename Law::template Interaction<double> bridge) {
    { bridge.numberAboveBound(law, 1.0, 1.0) } -> std::same_as<double>;
};

/// An adhesion law whose liquid moves: each contact has a bridge of its own volume, or none
/// (Features/LiquidBridges/Shared/LiquidMigration.h). It has liquidRules(), and prepare(bodies, volume)
/// besides prepare(bodies), which is a contact without liquid.
template <class Law>
concept MovesLiquid = requires {
    requires Law::movesLiquid;
};

/// A bridge of a fixed volume that may form before the bodies touch, below the gap `filmContactGap` (m) of
/// its law: 0 where it does not.
template <class Law>
concept HasFilmContactGap = !MovesLiquid<Law> && requires(const Law law) {
    { law.filmContactGap } -> std::convertible_to<double>;
};

/// An attraction that begins and ends at full size, at the touch and at its range: `jumpsAtEnds`. Its first
/// and last samples stand for the time since its start and to its end.
template <class Law>
concept JumpsAtEnds = requires {
    requires Law::jumpsAtEnds;
    requires Law::formsAtContact;
};

/// The separation (m) that an adhesion law is given at an overlap (m): 0 in contact, or negative for a law
/// that says `readsOverlap`.
template <class Law, class T>
[[gnu::always_inline]] inline T separationFor(T overlap) {
    if constexpr (requires { requires Law::readsOverlap; }) return -overlap;
    else return max(-overlap, T(0));
}

/// `acts` is false for the law that does nothing. `formsAtContact` says that the force exists only from the
/// first touch until the separation exceeds the range (a liquid bridge), not whenever bodies are within the
/// range.
template <class Law>
concept AdhesionLaw = HasFieldTable<Law> && HasRange<Law> && std::same_as<decltype(Law::acts), const bool> &&
    (!Law::acts || (HasAdhesionForce<Law, double> && HasAdhesionForce<Law, Pack> && ResistsAsItSays<Law> &&
                    std::same_as<decltype(Law::formsAtContact), const bool> &&
                    requires(const Law law, const Bodies bodies) {
                        { law.prepare(bodies) } -> std::same_as<typename Law::template Interaction<double>>;
                    }));

}  // namespace pendular
