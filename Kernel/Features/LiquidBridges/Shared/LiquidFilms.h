#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Features/LiquidBridges/Shared/ViscousLiquid.h"
#include "Kernel/Features/LiquidBridges/Shared/WetLayer.h"
#include "Kernel/Laws/Concepts/JoinedName.h"

namespace pendular {

/// The names of a bridge law between bodies with films: LiquidBridgeBagheri becomes LiquidFilmsBagheri.
template <class Bridge>
struct FilmNames {
    static constexpr std::string_view prefix = "LiquidFilms", bridgePrefix = "LiquidBridge";
    static constexpr std::string_view suffix =
        Bridge::name.starts_with(bridgePrefix) ? Bridge::name.substr(bridgePrefix.size()) : Bridge::name;
    static constexpr std::string_view films = "films of liquid that meet, resist motion and leave a bridge; ";

    static constexpr std::string_view name = JoinedName<prefix, suffix>::value;
    static constexpr std::string_view summary = JoinedName<films, Bridge::summary>::value;
};

/// What one contact of two bodies with films remembers, and its forces.
template <class T, class BridgeInteraction>
struct LiquidFilmsInteraction {
    BridgeInteraction bridge;
    T depth;           // m, of both films
    T roughness;       // epsilon, m
    T wetted;          // 1: the films have met since the bodies were last apart
    T reach;           // m, largest rupture distance, at least the depth of the films
    T viscosity;       // eta, Pa s
    T surfaceTension;  // gamma, N/m
    T radius;          // R* = r1 r2 / (r1 + r2), m
    T cutOff;          // V / (pi R*), m^2: sets how far the liquid reaches out
    T length;          // m, S_dyn at the present speed
    T forceInContact;  // 1: the liquid pulls also while the surfaces touch

    /// N
    /// @param separation m, negative in contact
    [[nodiscard]] T force(T separation) const {
        const T atRest = bridge.range();  // S_c
        const T pull = bridge.force(min(max(separation, depth), atRest));
        const T fading = max(length - separation, T(0)) / max(length - atRest, T(1e-300));
        const T there = select(separation < T(0), forceInContact, select(separation > depth, wetted, T(1)));
        return there * pull * select(separation > atRest, min(fading, T(1)), T(1));
    }
    [[nodiscard]] T range() const { return depth + wetted * (reach - depth); }

    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law& /*law*/, const BridgeMotion<T>& motion) {
        const T h = motion.separation;
        const T root = sqrt(capillaryNumber(-motion.approach, viscosity, surfaceTension));
        length = min(max(bridge.range() * (T(1) + root), depth), T(0.98) * reach);
        wetted = wettedAfter(wetted, h > depth, h > length, motion.forms);
        const T factor = T(6 * std::numbers::pi) * viscosity * radius;
        const T gap = max(h, roughness), apart = wetted * shareApart(motion);
        BridgeResistance<T> r;
        r.normal = apart * factor * radius / gap;
        const T sticking = select(h < depth, apart, T(0)) * factor;
        resistSlipAndRolling(r, sticking * logarithmOfGap(gap, cutOff), motion.asymmetry);
        return r;
    }
    template <class Law>
    [[nodiscard]] T numberAboveBound(const Law& law, T separation, T opening) const {
        return numberAboveBoundOf(*this, law, separation, opening);
    }
    template <class Law>
    void takeState(const Law& /*law*/, const LiquidFilmsInteraction& before) {
        wetted = before.wetted, length = before.length;
    }
    void checkGap(T /*separation*/, T /*roundOff*/) {}  // it remembers no gap
};

/// Bodies with films of liquid collide as a grain does with a wet wall (WetWall), in four phases: the films
/// meet at h = delta_1 + delta_2 (I), the surfaces touch (II), part (III), and draw a bridge until it
/// ruptures (IV). In I, III and IV the liquid resists the approach by lubrication, 6 pi eta R*^2 / max(h,
/// epsilon), in I and III also sliding and rolling, by the leading logarithm of lubrication theory for two
/// spheres of any radii (resistSlipAndRolling), L = ln(1 + V / (pi R* h^2)) / 2. The capillary force is
/// that of the law Bridge, with the volume of both films, 4 pi (r1^2 + r2^2) delta, or liquidBridgeVolume if
/// that is less; in I and III its value at the surface of the films. The bridge ruptures at S_c (1 +
/// sqrt(Ca)), Ca = eta v / gamma with the speed v of parting; beyond S_c its force falls linearly to zero
/// there.
///
/// Each contact has the whole films of its bodies: for liquid that several bridges of a grain share, see
/// LiquidMigration. A wall has a film as grains of its species have.
template <class Bridge>
struct LiquidFilms : Bridge, LayerLaw<LiquidFilms<Bridge>> {
    static constexpr std::string_view name = FilmNames<Bridge>::name;
    static constexpr std::string_view summary = FilmNames<Bridge>::summary;
    static constexpr bool formsAtContact = false;
    static constexpr bool readsOverlap = true;
    static constexpr BridgeResists resists = BridgeResists::Rolling;

    double filmThickness = unset;  // delta, m

    static constexpr auto fields() {
        using Law = LiquidFilms;
        constexpr auto added = std::to_array<Field<Law>>(
            {{"filmThickness", &Law::filmThickness, "m", notNegative, Mixing::Arithmetic,
              "thickness delta of the film on each body; 0 is dry",
              "this project, after the force balance model of wet particle-wall collisions"},
             {"viscosity", &Law::viscosity, "Pa s", notNegative, Mixing::Arithmetic,
              "viscosity eta of the liquid", "the same"},
             {"roughness", &Law::roughness, "m", positive, Mixing::Arithmetic,
              "smallest gap epsilon of the surfaces: below it the viscous coefficients stay as they are "
              "there",
              "the same"},
             {"capillaryInContact", &Law::capillaryInContact, "", fromZeroTo(1), Mixing::Largest,
              "1: the liquid pulls also while the surfaces touch; 0: not, as in the model", "this project"},
             {"largestCapillaryNumber", &Law::largestCapillaryNumber, "", notNegative, Mixing::Largest,
              "bounds the rupture distance of a bridge that is drawn fast, (1 + sqrt(Ca)) times the static "
              "one",
              "this project"}});
        constexpr auto ofBridge = [] {
            constexpr auto table = Bridge::fields();
            std::array<Field<Law>, table.size()> own{};
            for (std::size_t k = 0; k < table.size(); ++k) {
                own[k] = table[k];
                if (own[k].name == "liquidBridgeVolume")
                    own[k].meaning = "largest volume of a bridge, which has less where both films hold less";
            }
            return own;
        }();
        return joinedFields<Law>(ofBridge, added);
    }

    void setLiquidBridgeVolume(double value) { setField(*this, &LiquidFilms::liquidBridgeVolume, value); }
    void setContactAngle(double value) { setField(*this, &LiquidFilms::contactAngle, value); }
    void setSurfaceTension(double value) { setField(*this, &LiquidFilms::surfaceTension, value); }
    void setFilmThickness(double value) { setField(*this, &LiquidFilms::filmThickness, value); }
    [[nodiscard]] double getFilmThickness() const { return filmThickness; }

    template <class T>
    using Interaction = LiquidFilmsInteraction<T, typename Bridge::template Interaction<T>>;

    /// m^3
    [[nodiscard]] double volume(const Bodies& bodies) const {
        const double films = 4 * std::numbers::pi * filmThickness *
                             (bodies.radius1 * bodies.radius1 + bodies.radius2 * bodies.radius2);
        return filmThickness == 0 ? 0 : std::min(this->liquidBridgeVolume, films);
    }
    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        const Bridge bridge = bridgeBetween(bodies);
        if (!isWet(bodies)) {
            Interaction<double> dry{};
            dry.bridge = bridge.prepare(bodies);
            dry.depth = dry.reach = -1;  // m, below all overlaps
            dry.roughness = dry.surfaceTension = 1;
            return dry;
        }
        const double radius = bodies.effectiveRadius(), depth = 2 * filmThickness;
        return {.bridge = bridge.prepare(bodies),
                .depth = depth,
                .roughness = this->roughness,
                .wetted = 0,
                .reach = range(bodies),
                .viscosity = this->viscosity,
                .surfaceTension = this->surfaceTension,
                .radius = radius,
                .cutOff = volume(bodies) / (std::numbers::pi * radius),
                .length = std::max(bridge.range(bodies), depth),
                .forceInContact = this->capillaryInContact};
    }
    /// m: the largest rupture distance at the speeds that the law is given; 0 where no body has a film.
    [[nodiscard]] double range(const Bodies& bodies) const {
        if (!isWet(bodies)) return 0;
        const double rupture =
            bridgeBetween(bodies).range(bodies) * (1 + std::sqrt(this->largestCapillaryNumber));
        return 1.03 * std::max(rupture, 2 * filmThickness);
    }
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies& bodies) const {
        if (!isWet(bodies)) return {};
        return this->resistanceAtRoughness(bodies, filmThickness, bodies.radius1 == bodies.radius2 ? 0 : 1);
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (!isWet(bodies)) return std::nullopt;
        return bridgeBetween(bodies).objection(bodies);
    }
    [[nodiscard]] auto domainLimits(const Bodies& bodies) const {
        return bridgeBetween(bodies).domainLimits(bodies);
    }

private:
    [[nodiscard]] bool isWet(const Bodies& bodies) const { return volume(bodies) > 0; }
    [[nodiscard]] Bridge bridgeBetween(const Bodies& bodies) const {
        Bridge bridge = *this;
        bridge.liquidBridgeVolume = volume(bodies);
        return bridge;
    }
};

}  // namespace pendular
