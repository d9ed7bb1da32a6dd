#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Features/LiquidBridges/Shared/ViscousLiquid.h"
#include "Kernel/Features/LiquidBridges/Shared/WetLayer.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"

namespace pendular {

/// The toroidal bridge between a layer and the grain that comes out of it (equations 32 to 35 and 39 to 43):
/// the wetted angle stays, and the liquid meets the layer at an angle of 0. Lengths in m; x is the height of
/// the surface of the grain above that of the layer.
template <class T>
struct ToroidOnLayer {
    T contactRadius;  // r_c = R sin(phi)
    T capHeight;      // R (1 - cos(phi))
    T sine, cosine;   // of psi = phi + theta
    T angle;          // a = pi - psi
    T capVolume;      // m^3, of the grain below its contact line

    struct Radii {
        T height, meridional, neck;  // H, r_m, r_a
    };
    [[nodiscard]] Radii radii(T x) const {
        const T height = x + capHeight, meridional = height / (T(1) + cosine);
        const T narrowing = select(cosine > T(0), meridional * (T(1) - sine), T(0));
        return {height, meridional, contactRadius - narrowing};
    }
    /// F / sigma, m; the neck is not let below a thousandth of the contact radius, where the bridge ends.
    [[nodiscard]] T force(T x) const {
        const Radii r = radii(x);
        const T neck = max(r.neck, T(1e-3) * contactRadius);
        return T(std::numbers::pi) * contactRadius *
               (T(2) * sine + contactRadius * (T(1) / r.meridional - T(1) / neck));
    }
    /// m^3
    [[nodiscard]] T volume(T x) const {
        const T pi = T(std::numbers::pi);
        const auto [height, meridional, neck] = radii(x);
        const T outer = neck + meridional;
        // r_m^2 times the three parts that are taken off the cylinder; sin^2(a/2) = (1 + cos(psi)) / 2.
        const T arc = angle * outer - T(2.0 / 3) * (T(1) + cosine) * meridional;
        const T triangle = sine * cosine * (contactRadius + T(2.0 / 3) * meridional * sine);
        return pi * (outer * outer * height - meridional * meridional * (arc + triangle)) - capVolume;
    }
};

/// What one contact of a grain with a wet wall remembers, and its forces.
template <class T>
struct WetWallInteraction {
    T radius;     // R, m
    T depth;      // delta, m, of the layer
    T roughness;  // epsilon, m
    T wetted;     // 1: the grain has been in the layer since it was last free
    T reach;      // m, largest length of the bridge
    ToroidOnLayer<T> bridge;
    T lengthFactor;    // 1 + theta / 2
    T volume;          // V, m^3, as it forms
    T grows;           // 1: the volume follows the toroid
    T viscosity;       // eta, Pa s
    T surfaceTension;  // sigma, N/m
    T density;         // rho_l, kg/m^3
    T gravity;         // m/s^2, on the bridge
    T forceInContact;  // 1: the liquid pulls also while the surfaces touch

    /// N: the pull of the liquid, with the weight of the bridge.
    /// @param separation m, negative in contact
    [[nodiscard]] T force(T separation) const {
        const T x = separation - depth;
        const T pull = surfaceTension * bridge.force(max(x, T(0)));  // in the layer as at its surface
        const T ofBridge = wetted * (pull + density * gravity * volumeAt(x));
        return select(separation < T(0), forceInContact, T(1)) * select(x > T(0), ofBridge, pull);
    }
    [[nodiscard]] T range() const { return depth + wetted * reach; }

    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law& /*law*/, const BridgeMotion<T>& motion) {
        const T x = motion.separation - depth;
        wetted = wettedAfter(wetted, x > T(0), hasRuptured(motion, x), motion.forms);
        const T factor = T(6 * std::numbers::pi) * viscosity;
        const T gap = max(motion.separation, roughness), near = factor * radius * radius / gap;
        const T apart = wetted * shareApart(motion);
        BridgeResistance<T> r;
        r.normal = apart * max(near, factor * bridge.contactRadius * dragFactor(motion));
        // Equations 29 and 30 have the speed v of the centre and the spin w R; here the slip is that of the
        // grain's surface, v + w R, and the rolling speed -w R. 0.1895 of (30) is taken as 3/4 of the 0.2526
        // of (29), 0.18945: then the matrix is symmetric, as it must be.
        const T sticking = select(x < T(0), apart, T(0)) * factor * radius;
        const T log = max(naturalLogarithm(radius / gap), T(0));
        const T ofShift = T(8.0 / 15) * log + T(0.9588), ofBoth = T(2.0 / 15) * log + T(0.2526),
                ofSpin = T(4.0 / 3) * (T(2.0 / 5) * log + T(0.3817));
        r.sliding = sticking * ofShift;
        r.coupling = sticking * (ofShift - ofBoth);
        r.rolling = sticking * (ofShift - T(2) * ofBoth + ofSpin);
        return r;
    }
    template <class Law>
    [[nodiscard]] T numberAboveBound(const Law& law, T separation, T opening) const {
        return numberAboveBoundOf(*this, law, separation, opening);
    }
    template <class Law>
    void takeState(const Law& /*law*/, const WetWallInteraction& before) {
        wetted = before.wetted;
    }
    void checkGap(T /*separation*/, T /*roundOff*/) {}  // it remembers no gap

    /// The volume (m^3) of a bridge of the length x (m); none in the layer.
    [[nodiscard]] T volumeAt(T x) const {
        return select(x > T(0), select(grows > T(0), bridge.volume(x), volume), T(0));
    }

private:
    /// Equations 36 and 37: where the bridge is longer than (1 + theta/2) (1 + sqrt(Ca)) V^(1/3); or its neck
    /// has closed, or it is as long as the law's range allows.
    MaskOf<T> hasRuptured(const BridgeMotion<T>& motion, T x) const {
        const T factor =
            lengthFactor * (T(1) + sqrt(capillaryNumber(-motion.approach, viscosity, surfaceTension)));
        const MaskOf<T> isTooLong = x * x * x > factor * factor * factor * volumeAt(x);
        const MaskOf<T> isClosed = bridge.radii(x).neck < T(1e-3) * bridge.contactRadius;
        return isTooLong | isClosed | (x > T(0.98) * reach);
    }
    /// The drag of equation 25 over that of Stokes.
    T dragFactor(const BridgeMotion<T>& motion) const {
        const T speed = max(motion.approach, -motion.approach);
        const T reynolds = T(2) * bridge.contactRadius * density * speed / viscosity;
        return T(1) + T(0.25) * reynolds / (T(1) + sqrt(reynolds)) + reynolds * T(1.0 / 60);
    }
};

/// A grain meets a wall that is covered by a layer of liquid: it goes into the layer (I), touches the wall
/// (II), comes out (III), and draws a bridge from the layer until that ruptures (IV). In I, III and IV the
/// liquid resists the normal motion by the larger of the drag of the wetted cap and the lubrication at the
/// wall; in I and III also sliding and rolling. It pulls by the capillary force of a toroid, in I and III by
/// its value at the surface of the layer. In II there are the normal and the friction law alone.
/// Source: the force balance model of wet particle-wall collisions, equations 25 to 43, with Tsuji's dashpot
/// (HertzianViscoelastic) and MindlinSecant. Where its text leaves open what is meant, see the README of this
/// folder. I and III have the same forces, so all that a contact must remember is whether the grain has been
/// in the layer: a grain that comes back from IV is in I again, and one that leaves without having touched
/// the wall draws a bridge as well. Grains are dry among themselves.
struct WetWall : LayerLaw<WetWall> {
    static constexpr std::string_view name = "WetWall";
    static constexpr std::string_view summary =
        "wall under a layer of liquid: viscous and capillary forces as a grain goes in, comes out and draws "
        "a "
        "bridge";
    static constexpr std::string_view domain =
        "layers thinner than half of the grain's radius, on walls; half-filling angles as measured (20 to 60 "
        "degrees); Reynolds numbers below 2e5; surfaces that are plane over a few radii of the grain";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = false;
    static constexpr bool readsOverlap = true;
    static constexpr BridgeResists resists = BridgeResists::Rolling;

    double liquidLayerThickness = unset;  // delta, m
    double halfFillingAngle = unset;      // phi, rad
    double contactAngle = unset;          // theta, rad
    double surfaceTension = unset;        // sigma, N/m
    double liquidDensity = unset;         // rho_l, kg/m^3
    double growingBridge = 0;
    double bridgeGravity = 0;  // m/s^2

    static constexpr auto fields() {
        using Law = WetWall;
        constexpr std::string_view bridge = "the same, equations 31 to 35",
                                   viscous = "the same, equations 25 to 30";
        return std::to_array<Field<Law>>(
            {{"liquidLayerThickness", &Law::liquidLayerThickness, "m", notNegative, Mixing::Largest,
              "thickness delta of the layer on walls; 0 is dry",
              "force balance model of wet particle-wall collisions, section 2.1"},
             {"halfFillingAngle",
              &Law::halfFillingAngle,
              "rad",
              {0, std::numbers::pi, false, false},
              Mixing::Arithmetic,
              "angle phi from the axis to the contact line on the grain, in phase IV",
              bridge},
             {"contactAngle", &Law::contactAngle, "rad", fromZeroTo(std::numbers::pi), Mixing::MeanCosine,
              "contact angle theta at the grain", bridge},
             {"surfaceTension", &Law::surfaceTension, "N/m", positive, Mixing::Arithmetic,
              "surface tension sigma of the liquid", bridge},
             {"viscosity", &Law::viscosity, "Pa s", positive, Mixing::Arithmetic,
              "viscosity eta of the liquid", viscous},
             {"liquidDensity", &Law::liquidDensity, "kg/m^3", positive, Mixing::Arithmetic,
              "density rho_l of the liquid", viscous},
             {"roughness", &Law::roughness, "m", positive, Mixing::Arithmetic,
              "smallest gap epsilon of the surfaces: below it the viscous coefficients stay as they are "
              "there",
              viscous},
             {"growingBridge", &Law::growingBridge, "", fromZeroTo(1), Mixing::Largest,
              "1: the bridge's volume is that of the toroid at each moment, so that it grows; 0: it stays as "
              "it "
              "was when the grain left the layer",
              "the same, equations 36, 38 to 43"},
             {"bridgeGravity", &Law::bridgeGravity, "m/s^2", notNegative, Mixing::Largest,
              "gravity towards the wall that acts on the bridge's liquid; 0: it has no weight",
              "the same, equation 38"},
             {"capillaryInContact", &Law::capillaryInContact, "", fromZeroTo(1), Mixing::Largest,
              "1: the liquid pulls also while the surfaces touch; 0: not, as in the source", "this project"},
             {"largestCapillaryNumber", &Law::largestCapillaryNumber, "", notNegative, Mixing::Largest,
              "bounds the length of a bridge that is drawn fast, (1 + sqrt(Ca)) times the static one",
              "this project"}});
    }

    void setLiquidLayerThickness(double value) { setField(*this, &WetWall::liquidLayerThickness, value); }
    void setHalfFillingAngle(double value) { setField(*this, &WetWall::halfFillingAngle, value); }
    void setContactAngle(double value) { setField(*this, &WetWall::contactAngle, value); }
    void setSurfaceTension(double value) { setField(*this, &WetWall::surfaceTension, value); }
    void setLiquidDensity(double value) { setField(*this, &WetWall::liquidDensity, value); }
    void setGrowingBridge(bool value) { growingBridge = value ? 1 : 0; }
    void setBridgeGravity(double value) { setField(*this, &WetWall::bridgeGravity, value); }
    [[nodiscard]] double getLiquidLayerThickness() const { return liquidLayerThickness; }
    [[nodiscard]] double getHalfFillingAngle() const { return halfFillingAngle; }
    [[nodiscard]] double getContactAngle() const { return contactAngle; }
    [[nodiscard]] double getSurfaceTension() const { return surfaceTension; }
    [[nodiscard]] double getLiquidDensity() const { return liquidDensity; }

    template <class T>
    using Interaction = WetWallInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const;
    /// m, thickness of the layer and largest length of a bridge; 0 between grains.
    [[nodiscard]] double range(const Bodies& bodies) const;
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies& bodies) const;
    /// Why no toroid stands on the layer, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const;
    [[nodiscard]] std::vector<DomainLimit> domainLimits(const Bodies& bodies) const;

private:
    [[nodiscard]] ToroidOnLayer<double> toroid(double radius) const;
    /// The largest length (m) in the range of speeds that the law is given.
    [[nodiscard]] double largestLength(const ToroidOnLayer<double>& bridge, double radius) const;
};

}  // namespace pendular
