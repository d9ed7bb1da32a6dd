#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Features/LiquidBridges/Shared/LubricationIntegral.h"
#include "Kernel/Features/LiquidBridges/Shared/ViscousLiquid.h"
#include "Kernel/Laws/Concepts/JoinedName.h"
#include "Kernel/Laws/Concepts/LiquidRules.h"

namespace pendular {

/// How the normal viscous force is found in a step.
enum class ViscousScheme {
    Gap,       ///< from its integral over the gap: the speed lost between two gaps is exact at any step
    Implicit,  ///< its coefficient at the gap, times the speed at the end of the step
    Explicit   ///< its coefficient at the gap, times the speed that is predicted without it
};

/// The theory for what resists slip and rolling at a gap.
enum class TangentialLubrication {
    None,
    Pair,    ///< leading logarithm of lubrication theory, for any two radii, with rolling
    Popular  ///< that of a sphere that is shifted along a wall, for all bodies; rolling costs nothing
};

/// What one contact remembers of a bridge that resists motion, and what it gives.
template <class Capillary, class T>
struct ViscousInteraction {
    static constexpr double never = 1e300;  // m, the gap of a bridge that has made no step yet

    Capillary capillary;
    T squaredReach;  // b^2 = V / (pi R*), m^2
    T offset;        // of the integral
    T lastGap;       // m, at the last step, or never
    T charged;       // A up to which the speed of the bodies has paid; without liquid, where films have met:
                     // the gap (m) from which on it will have to

    [[nodiscard]] T force(T separation) const { return capillary.force(separation); }
    [[nodiscard]] T range() const { return capillary.range(); }
    /// S_c (1 + sqrt(Ca)) with the capillary number of the speed of opening (m/s), where the law says so.
    template <class Law>
    [[nodiscard]] T range(const Law& law, T opening) const {
        if (!(law.dynamicRupture > 0)) return capillary.range();
        const T number = min(numberOf(law, opening), T(law.largestCapillaryNumber));
        return capillary.range() * (T(1) + sqrt(number));
    }
    /// The capillary number where it is above the largest one that the range is made for; else 0.
    template <class Law>
    [[nodiscard]] T numberAboveBound(const Law& law, T separation, T opening) const {
        if (!(law.dynamicRupture > 0)) return T(0);
        const T number = numberOf(law, opening);
        return select((separation > T(0)) & (number > T(law.largestCapillaryNumber)), number, T(0));
    }
    /// Beyond S_c fits go on, and the force of an exact law falls linearly to zero.
    template <class Law>
    [[nodiscard]] T force([[maybe_unused]] const Law& law, T separation, [[maybe_unused]] T longest) const {
        if constexpr (requires { Law::endsAtRupture; }) {
            if (!(law.dynamicRupture > 0)) return capillary.force(separation);
            const T end = capillary.range();
            const T left = (longest - separation) / max(longest - end, T(1e-300));
            return capillary.force(min(separation, end)) * min(left, T(1));
        } else {
            return capillary.force(separation);
        }
    }

    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law& law, const BridgeMotion<T>& motion) {
        const T drag = T(6 * std::numbers::pi * law.viscosity) * square(motion.effectiveRadius);  // N s
        const MaskOf<T> acts = motion.separation > (law.viscousInContact > 0 ? T(-infinity) : T(0));
        BridgeResistance<T> found;
        if (law.scheme() == ViscousScheme::Gap) {
            found.force = chargeGap(law, motion, drag);
        } else {
            const T slope = integralOf(law).slope(motion.separation, T(law.roughness));
            const T c = select(acts, drag * slope, T(0));
            if (law.scheme() == ViscousScheme::Implicit) found.normal = c;
            else found.force = c * motion.approach;
        }
        if (law.tangential() != TangentialLubrication::None && any(acts)) {
            addTangential(law, motion, found);
            for (T* part : {&found.sliding, &found.coupling, &found.rolling})
                *part = select(acts, *part, T(0));
        }
        return found;
    }
    /// Goes on with the state of a bridge that is prepared again, perhaps for another volume: what is still
    /// to be charged stays.
    template <class Law>
    void takeState(const Law& law, const ViscousInteraction& before) {
        if (squaredReach == 0) {  // there is no liquid, or it has not come yet where films have met
            if (before.squaredReach == 0) lastGap = before.lastGap, charged = before.charged;
            return;
        }
        if (before.squaredReach == 0) {  // it is a new bridge
            if (before.lastGap >= never) return;
            lastGap = before.lastGap;  // of films that have met
            charged = integralOf(law).at(before.charged, law.roughness);
            return;
        }
        lastGap = before.lastGap;
        charged = before.charged;
        if (lastGap >= never || (squaredReach == before.squaredReach && offset == before.offset)) return;
        charged +=
            integralOf(law).at(lastGap, law.roughness) - before.integralOf(law).at(lastGap, law.roughness);
    }
    /// Films have met, and liquid is about to come: the bridge will resist from the gap `start` (m) on, of
    /// which the bodies have gone up to `gap` (m) in the last drift.
    void meet(T gap, T start) {
        lastGap = gap;
        charged = start;
    }
    /// Called between two steps; bodies that have been put somewhere else have not moved there.
    void checkGap(T separation, T roundOff) {
        if (!(abs(separation - lastGap) <= roundOff)) lastGap = never;
    }

    template <class Law>
    [[nodiscard]] LubricationIntegral<T> integralOf(const Law& law) const {
        LubricationIntegral<T> integral{
            law.viscousVolumeCorrection > 0 ? squaredReach : T(LubricationIntegral<T>::endless), T(0),
            offset};
        integral.plateau = integral.atRoughness(T(law.roughness));
        return integral;
    }

private:
    template <class Law>
    [[nodiscard]] static T numberOf(const Law& law, T opening) {
        return capillaryNumber(opening, T(law.viscosity), T(law.surfaceTension));
    }

    /// The gap scheme. The kick of a step is (6 pi eta R*^2 / m*) (A' - A_charged), A' being the integral at
    /// the gap that is reached in the share theta of the coming drift, with the speed w that the kick itself
    /// leaves:
    ///     w = w* - K (A(h + theta w dt) - A_charged),   K = n 6 pi eta R*^2 / m*,
    /// w* the speed of opening in the last drift with the bridge's and the contact's other forces (those of
    /// others come in with what they have moved). By Newton's method, whose last tangent is what is charged:
    /// an error is not lost, it is charged with the next step, so that all kicks of a way between two gaps
    /// always add up to its integral. With x = K s dt, theta = (1 + x) / (2 + x) makes one step of a linear
    /// resistance the factor 1 / (1 + x + x^2/2), of second order, that never changes the sign: creeping
    /// bridges keep to the balance of forces at any step. A is constant below a gap of 0, but goes on to fall
    /// in the step of a touch where the bodies creep (x > 1): else the rest of that step would be free.
    /// A bridge that forms where films meet, within a drift, pays from that gap on.
    template <class Law>
    [[nodiscard]] T chargeGap(const Law& law, const BridgeMotion<T>& motion, const T& drag) {
        const bool isKept = law.viscousInContact > 0;
        const T h = motion.separation, roughness(law.roughness), dt = motion.coming;
        const T kick = max(T(0.5) * (motion.step + motion.coming), T(1e-300));  // s, between two drifts
        const T contact(isKept ? -infinity : 0.0);  // m, the gap below which nothing resists
        const T open = max(h, contact);
        const MaskOf<T> begins = motion.forms | (motion.step <= T(0)) | (lastGap >= T(never));
        const MaskOf<T> touches = h < contact;
        const T drift = select(begins, -motion.approach, (h - lastGap) / max(motion.step, T(1e-300)));  // m/s
        const T wanted = fma(kick * motion.inverseMass, motion.push, drift);                            // w*
        const MaskOf<T> staysClosed = touches & (fma(wanted, dt, h) < T(0));
        // The gap (m) at which the films of bridges that form have met in the last drift.
        T met(0);
        if constexpr (HasFilmContactGap<Law>)
            met = min(T(law.filmContactGap), fma(max(motion.approach, T(0)), motion.step, h));
        const MaskOf<T> meets = motion.forms & (met > max(open, T(0)));
        // It touches, and has not paid yet for all of the way; one that forms owes nothing of the one before.
        const MaskOf<T> owes =
            (!begins) & touches & (lastGap > contact) & (lastGap < T(never)) & (charged > T(0));
        if (!isKept && !any((!staysClosed) | meets | owes)) {  // as all of a bed at rest: nothing follows
            charged = T(0);
            lastGap = h;
            return T(0);
        }
        const LubricationIntegral<T> integral = integralOf(law);
        const T atGap = integral.at(open, roughness), slope = integral.slope(open, roughness);
        T before = select((begins | touches) & !owes, atGap, charged);
        if (any(meets)) before = select(meets, integral.at(max(met, open), roughness), before);
        const T k = T(law.viscousNeighbours) * drag * motion.inverseMass;  // m/s

        const T x = k * dt * slope;
        const MaskOf<T> creeps = (k * dt * integral.plateau > roughness) & (h > contact);
        const T lowest = select(creeps, T(-infinity), contact), highest = range(law, -motion.approach);
        T share = select(touches, T(1), (T(1) + x) / (T(2) + x));
        T at = open, value = atGap, tangent = slope, w(0), paid(0);
        const auto solve = [&] {  // for w, with A + s (h + share w dt - at) = fixed + way w
            const T fixed = fma(tangent, h - at, value), way = tangent * share * dt;
            w = fma(-k, fixed - before, wanted) / fma(k, way, T(1));
            paid = fma(way, w, fixed);
        };
        solve();
        for (int turn = 0; turn < 2; ++turn) {
            share = select(fma(w, dt, h) > highest, T(1), share);  // the bridge breaks in the coming drift
            at = max(fma(share * w, dt, h), lowest);
            value = integral.at(min(at, highest), roughness);
            tangent = select(at < highest, integral.slope(at, roughness), T(0));
            solve();
        }
        // The gap closes in the coming drift, whatever resists it; or it does not open.
        const MaskOf<T> closes = (!creeps) & (h > contact) & (fma(fma(k, before, wanted), dt, h) < T(0));
        if (!isKept) paid = select(closes | staysClosed, T(0), paid);
        // The bodies are brought to a stop at most, with what others give as in the last step: what they have
        // gone too far, in the first step of a scene, is not made good.
        const T others = select(
            begins, T(0), fma(T(-2), motion.approach + drift, -(kick * motion.inverseMass * motion.last)));
        const T speed = wanted + others, own = max(drag * motion.inverseMass, T(1e-300));
        const MaskOf<T> reverses = speed * fma(own, before - paid, speed) < T(0);
        charged = select(reverses, atGap, paid);
        lastGap = h;
        return (before - select(reverses, before + speed / own, paid)) * drag / kick;
    }

    /// Pair: resistSlipAndRolling(). Popular: F = -6 pi eta R* (8/15 ln(R*/h_e) + 0.9588) u (Nase, Vargas,
    /// Abatan and McCarthy (2001), Powder Technol. 116, 214), taken for 0 where it is negative.
    template <class Law>
    void addTangential(const Law& law, const BridgeMotion<T>& motion, BridgeResistance<T>& found) const {
        const T scale = T(6 * std::numbers::pi * law.viscosity) * motion.effectiveRadius;  // kg/s
        const T gap = max(motion.separation, T(law.roughness));
        if (law.tangential() == TangentialLubrication::Popular) {
            const T logarithm = naturalLogarithm(motion.effectiveRadius / gap);
            found.sliding = scale * max(fma(T(8.0 / 15), logarithm, T(0.9588)), T(0));
            return;
        }
        resistSlipAndRolling(found, scale * logarithmOfGap(gap, squaredReach), motion.asymmetry);
    }
};

/// Why no bridge can form at this gap (m): it is not below the rupture distance (m).
std::string refusalOfFilmContactGap(std::string_view law, double gap, double ruptureDistance);

/// What is wrong with an option that is one of the whole numbers from 0, if so.
std::optional<std::string> objectionToOption(std::string_view law, std::string_view field, double value,
                                             int last);

/// The names of a bridge law that resists motion: LiquidBridgeBagheri becomes ViscousLiquidBridgeBagheri.
template <class Bridge>
struct ViscousNames {
    static constexpr std::string_view prefix = "Viscous", resists = ", which resists motion";

    static constexpr std::string_view name = JoinedName<prefix, Bridge::name>::value;
    static constexpr std::string_view summary = JoinedName<Bridge::summary, resists>::value;
};

/// The field that says where bridges form before a touch: below a gap, or where liquid moves at the films
/// that there are.
template <bool movesLiquid>
struct FilmContactField {
    double filmContactGap = 0;  // m
};
template <>
struct FilmContactField<true> {
    double formsAtFilmContact = 0;
};

/// Any bridge law with the viscous force of its liquid, which resists the approach and the parting of the
/// bodies, their slip and their rolling while a bridge joins them: see LubricationIntegral and
/// ViscousInteraction. The bridge is there from the touch on, as that of the law itself: the first approach
/// is not damped; or from the gap on at which the films of the bodies meet: filmContactGap, or where liquid
/// moves the sum of the thicknesses f / (4 pi r^2) of the films that there are, if formsAtFilmContact is set.
/// In contact nothing resists unless viscousInContact is set: it would make the restitution
/// depend on the stiffness of the grains.
template <class Bridge>
struct ViscousBridge : Bridge, FilmContactField<MovesLiquid<Bridge>> {
    static constexpr BridgeResists resists = BridgeResists::Rolling;
    static constexpr std::string_view name = ViscousNames<Bridge>::name;
    static constexpr std::string_view summary = ViscousNames<Bridge>::summary;

    double viscosity = unset;  // eta, Pa s
    double roughness = unset;  // eps, m
    double viscousVolumeCorrection = 1;
    double tangentialLubrication = static_cast<double>(TangentialLubrication::Pair);
    double viscousInContact = 0;
    double viscousScheme = static_cast<double>(ViscousScheme::Gap);
    double viscousNeighbours = 1;
    double dynamicRupture = 0;
    double largestCapillaryNumber = 1;

    static constexpr auto fields() {
        using Law = ViscousBridge;
        constexpr std::string_view lubrication = "Adams and Perchard (1985)", own = "this project";
        constexpr Range atLeastOne{1, infinity, true, false};
        constexpr auto added = std::to_array<Field<Law>>(
            {{"viscosity", &Law::viscosity, "Pa s", notNegative, Mixing::Arithmetic,
              "viscosity eta of the liquid", lubrication},
             {"roughness", &Law::roughness, "m", positive, Mixing::Arithmetic,
              "gap below which the resistance does not grow: the height of the roughness; 0.1 to 10 um is "
              "usual",
              lubrication},
             {"viscousVolumeCorrection", &Law::viscousVolumeCorrection, "", fromZeroTo(1), Mixing::Largest,
              "1: the liquid ends where its volume does; 0: liquid without an end", "Pitois et al. (2000)"},
             {"tangentialLubrication", &Law::tangentialLubrication, "", fromZeroTo(2), Mixing::Largest,
              "against slip and rolling: 0 nothing, 1 lubrication of any two radii, 2 that of a sphere "
              "shifted "
              "along a wall",
              "Jeffrey and Onishi (1984); Nase et al. (2001)"},
             {"viscousInContact", &Law::viscousInContact, "", fromZeroTo(1), Mixing::Largest,
              "1: bridges resist also where the bodies overlap, as at a gap of the roughness", own},
             {"viscousScheme", &Law::viscousScheme, "", fromZeroTo(2), Mixing::Largest,
              "of the normal force in a step: 0 its integral over the gap, 1 implicit, 2 explicit", own},
             {"viscousNeighbours", &Law::viscousNeighbours, "", atLeastOne, Mixing::Largest,
              "bridges of a grain for which the gap scheme is made stable at any step; 1: the step must be "
              "below "
              "the stability limit where grains have several",
              own},
             {"dynamicRupture", &Law::dynamicRupture, "", fromZeroTo(1), Mixing::Largest,
              "1: bridges rupture at S_c (1 + sqrt(Ca)), Ca = eta v / gamma of the speed v of parting; 0: at "
              "S_c",
              "Pitois et al. (2001)"},
             {"largestCapillaryNumber", &Law::largestCapillaryNumber, "", notNegative, Mixing::Largest,
              "Ca above which bridges grow no longer, so that there is a bound for the search; counted where "
              "it is exceeded",
              own},
             atFilms()});
        return joinedFields<Law>(Bridge::fields(), added);
    }

    // The setters are those of the bridge, made again so that a refusal names this law.
    void setLiquidBridgeVolume(double value) requires(!MovesLiquid<Bridge>) {
        setField(*this, &ViscousBridge::liquidBridgeVolume, value);
    }
    void setLiquidBridgeVolumeMax(double value) requires MovesLiquid<Bridge> {
        setField(*this, &ViscousBridge::liquidBridgeVolume, value);
    }
    void setLiquidBridgeVolumeMin(double value) requires MovesLiquid<Bridge> {
        setField(*this, &ViscousBridge::liquidBridgeVolumeMin, value);
    }
    void setDistributionCoefficient(double value) requires MovesLiquid<Bridge> {
        setField(*this, &ViscousBridge::distributionCoefficient, value);
    }
    void setWallLiquidVolume(double value) requires MovesLiquid<Bridge> {
        setField(*this, &ViscousBridge::wallLiquidVolume, value);
    }
    void setContactAngle(double value) { setField(*this, &ViscousBridge::contactAngle, value); }
    void setSurfaceTension(double value) { setField(*this, &ViscousBridge::surfaceTension, value); }

    void setViscosity(double value) { setField(*this, &ViscousBridge::viscosity, value); }
    void setRoughness(double value) { setField(*this, &ViscousBridge::roughness, value); }
    void setViscousVolumeCorrection(bool value) { viscousVolumeCorrection = value ? 1 : 0; }
    void setTangentialLubrication(TangentialLubrication value) {
        tangentialLubrication = static_cast<double>(value);
    }
    void setViscousInContact(bool value) { viscousInContact = value ? 1 : 0; }
    void setViscousScheme(ViscousScheme value) { viscousScheme = static_cast<double>(value); }
    void setDynamicRupture(bool value) { dynamicRupture = value ? 1 : 0; }
    void setLargestCapillaryNumber(double value) {
        setField(*this, &ViscousBridge::largestCapillaryNumber, value);
    }
    void setViscousNeighbours(double value) { setField(*this, &ViscousBridge::viscousNeighbours, value); }
    void setFilmContactGap(double value) requires(!MovesLiquid<Bridge>) {
        setField(*this, &ViscousBridge::filmContactGap, value);
    }
    void setFormsAtFilmContact(bool value) requires MovesLiquid<Bridge> {
        this->formsAtFilmContact = value ? 1 : 0;
    }
    [[nodiscard]] double getViscosity() const { return viscosity; }
    [[nodiscard]] double getRoughness() const { return roughness; }

    [[nodiscard]] ViscousScheme scheme() const {
        return static_cast<ViscousScheme>(static_cast<int>(viscousScheme));
    }
    [[nodiscard]] TangentialLubrication tangential() const {
        return static_cast<TangentialLubrication>(static_cast<int>(tangentialLubrication));
    }

    template <class T>
    using Interaction = ViscousInteraction<typename Bridge::template Interaction<T>, T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        return withLiquid(Bridge::prepare(bodies), bodies,
                          MovesLiquid<Bridge> ? 0 : this->liquidBridgeVolume);
    }
    /// A bridge of this volume (m^3), where liquid moves.
    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies,
                                              double volume) const requires MovesLiquid<Bridge> {
        return withLiquid(Bridge::prepare(bodies, volume), bodies, volume);
    }
    [[nodiscard]] LiquidRules liquidRules() const requires MovesLiquid<Bridge> {
        LiquidRules rules = Bridge::liquidRules();
        rules.atFilms = this->formsAtFilmContact > 0;
        return rules;
    }
    /// m: bodies with films of this thickness (m, both together) form a bridge below this gap; never so far
    /// apart that the largest bridge would rupture at once.
    [[nodiscard]] double filmContact(const Bodies& bodies, double films) const requires MovesLiquid<Bridge> {
        return std::min(films, Bridge::range(bodies));
    }
    /// m
    [[nodiscard]] double range(const Bodies& bodies) const {
        const double longest = dynamicRupture > 0 ? 1 + std::sqrt(largestCapillaryNumber) : 1;
        return longest * Bridge::range(bodies);
    }
    /// The resistance at the roughness, where it is largest. The pair alone is stable at any step with the
    /// gap scheme; so is a bed whose grains have no more than viscousNeighbours bridges.
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies& bodies) const {
        auto bridge = withLiquid({}, bodies, this->liquidBridgeVolume);
        ViscousBridge law = *this;
        law.viscousScheme = static_cast<double>(ViscousScheme::Implicit);
        BridgeMotion<double> motion{};
        motion.separation = roughness;
        motion.effectiveRadius = bodies.effectiveRadius();
        motion.asymmetry = std::isinf(bodies.radius2)
                               ? 1
                               : (bodies.radius2 - bodies.radius1) / (bodies.radius1 + bodies.radius2);
        BridgeResistance<double> largest = bridge.resist(law, motion);
        if (scheme() == ViscousScheme::Gap && viscousNeighbours >= contactsAroundAGrain) largest.normal = 0;
        return largest;
    }

    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (auto found = objectionToOption(name, "tangentialLubrication", tangentialLubrication, 2))
            return found;
        if (auto found = objectionToOption(name, "viscousScheme", viscousScheme, 2)) return found;
        if constexpr (!MovesLiquid<Bridge>)
            if (this->liquidBridgeVolume > 0 && this->filmContactGap >= Bridge::range(bodies))
                return refusalOfFilmContactGap(name, this->filmContactGap, Bridge::range(bodies));
        return Bridge::objection(bodies);
    }

private:
    static constexpr Field<ViscousBridge> atFilms() {
        if constexpr (MovesLiquid<Bridge>)
            return {"formsAtFilmContact",
                    &ViscousBridge::formsAtFilmContact,
                    "",
                    fromZeroTo(1),
                    Mixing::Largest,
                    "1: bridges form where the films of two bodies meet, f / (4 pi r^2) thick on a grain; 0: "
                    "where the bodies touch",
                    "this project"};
        else
            return {"filmContactGap",
                    &ViscousBridge::filmContactGap,
                    "m",
                    notNegative,
                    Mixing::Arithmetic,
                    "gap below which bridges form, because films on the bodies meet; 0: where they touch",
                    "this project"};
    }

    static constexpr double contactsAroundAGrain = 12;  // equal spheres in the densest packing

    [[nodiscard]] Interaction<double> withLiquid(
        const typename Bridge::template Interaction<double>& capillary, const Bodies& bodies,
        double volume) const {
        const double squaredReach = volume / (std::numbers::pi * bodies.effectiveRadius());
        const double reach =
            viscousVolumeCorrection > 0 ? squaredReach : LubricationIntegral<double>::endless;
        return {.capillary = capillary,
                .squaredReach = squaredReach,
                .offset = lubricationIntegral(reach, roughness).offset,
                .lastGap = Interaction<double>::never,
                .charged = 0};
    }
};

}  // namespace pendular
