#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/WetWall.h"
#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/Shared/ContactTime.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// A sphere, a plate with a layer of liquid, and how they meet: the defaults are glass of 1.74 mm and 400 um
/// of water of the force balance model of wet particle-wall collisions (its Tables 1, 2 and 5).
struct WetWallCase {
    double radius = 0.87e-3;     // m
    double density = 2500;       // kg/m^3
    double youngModulus = 63e9;  // Pa
    double poissonRatio = 0.23;
    double plateModulus = 63e9;  // Pa
    double platePoissonRatio = 0.23;
    double restitution = 0.96;  // of the dry contact
    double friction = 0;
    double layer = 400e-6;           // m; 0: dry
    double halfFillingAngle = 55;    // degrees
    double contactAngle = 15;        // degrees
    double viscosity = 1e-3;         // Pa s
    double liquidDensity = 998;      // kg/m^3
    double surfaceTension = 0.0728;  // N/m
    double roughness = 0.5e-6;       // m
    double gravity = 9.81;           // m/s^2, towards the plate
    bool growingBridge = false;      // see the law WetWall
    double speed = 1;                // m/s, normal
    double angle = 0;                // degrees, of the path, from the normal
    double spin = 0;                 // rad/s; positive: the lowest point moves forward with the sphere
    double stepsPerContact = 50;     // of the time of a dry elastic contact

    /// E* and G* of the contact, Pa.
    [[nodiscard]] double modulus() const {
        const auto compliance = [](double e, double nu) { return (1 - nu * nu) / e; };
        return 1 / (compliance(youngModulus, poissonRatio) + compliance(plateModulus, platePoissonRatio));
    }
    [[nodiscard]] double shearModulus() const {
        const auto compliance = [](double e, double nu) { return 2 * (2 - nu) * (1 + nu) / e; };
        return 1 / (compliance(youngModulus, poissonRatio) + compliance(plateModulus, platePoissonRatio));
    }
    [[nodiscard]] double mass() const {  // kg
        return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
    }
};

/// How a collision ended, and what it cost.
struct WetWallOutcome {
    double normalRestitution = 0, tangentialRestitution = 0;
    double spin = 0;            // rad/s
    std::string_view end = "";  // "rupture" (of the bridge, or of a dry contact), or where the sphere stuck
    double duration = 0;        // s
    // J/kg of the sphere's mass, where the account of the energy is kept.
    double contact = 0, gravity = 0, viscous = 0, capillary = 0;
};

/// The collision, in a frame whose third axis points away from the plate and whose first is the direction of
/// the tangential motion.
class WetWallImpact : public Simulation<Species<HertzianViscoelastic, MindlinSecant, WetWall>> {
public:
    using Material = Species<HertzianViscoelastic, MindlinSecant, WetWall>;
    using Frame = Eigen::Matrix3d;

    /// @param twist rad/s, spin about the normal
    explicit WetWallImpact(const WetWallCase& values, const Frame& axes = Frame::Identity(), double twist = 0)
        : given(values), frame(axes) {
        check();
        const Material* material = speciesHandler.copyAndAddObject(makeMaterial());
        setTimeStep(hertzContactTime(given.modulus(), given.radius, given.mass(), given.speed) /
                    given.stepsPerContact);
        acceptUnstableTimeStep();  // the limit is that of deeper contacts
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(given.radius);
        grain.setPosition((given.radius + given.layer + 0.5 * given.speed * getTimeStep()) * normal());
        grain.setVelocity(given.speed * (tangentOf(given.angle) * frame.col(0) - normal()));
        grain.setAngularVelocity(twist * normal() - given.spin * frame.col(1));
        particleHandler.copyAndAddObject(grain);
        InfiniteWall plate;
        plate.set(-normal(), Vec3D::Zero());
        plate.setSpecies(material);
        wallHandler.copyAndAddObject(plate);
        setGravity(-given.gravity * normal());
        bridge = static_cast<const WetWall&>(*material).prepare({given.radius});
    }

    /// Steps until the sphere is free again, or turns back to the plate. Throws InputError where it does
    /// neither, as with a restitution of nearly 0 or a very viscous liquid.
    WetWallOutcome finish() {
        initialise();
        const EnergyLedger before = energyLedger();
        double weightWork = 0;  // J
        bool touched = false, joined = false;
        WetWallOutcome outcome;
        const double layers = given.layer / (given.speed * getTimeStep());  // steps
        do {
            if (static_cast<double>(getNumberOfTimeSteps()) >= 1e4 * (given.stepsPerContact + layers))
                throw InputError(
                    "WetWallImpact: the sphere creeps, and has not left the plate after 10 000 times the "
                    "time of a dry contact and of the way through the layer; the restitution must be "
                    "larger, or the viscosity smaller.");
            const double from = separation();
            step();
            weightWork += bridgeWeight(from, separation());
            touched |= separation() < 0;
            outcome.end = phase(touched, joined);
            joined = isJoined();
        } while (outcome.end.empty());
        outcome.duration = getTime();
        outcome.spin = -particleHandler.getObject(0).getAngularVelocity().dot(frame.col(1));
        const double tangential = given.speed * tangentOf(given.angle);
        if (outcome.end == "rupture") outcome.normalRestitution = partingSpeed() / given.speed;
        if (tangential > 0)
            outcome.tangentialRestitution =
                particleHandler.getObject(0).getVelocity().dot(frame.col(0)) / tangential;
        const EnergyLedger& after = energyLedger();
        const double perMass = 1 / given.mass();
        outcome.contact = perMass * (after.normalDashpots + after.tangentialDashpots + after.sliding +
                                     after.stiffening + after.springs());
        outcome.gravity = perMass * (after.potential - before.potential + weightWork);
        outcome.viscous = perMass * after.viscousBridges;
        outcome.capillary = perMass * (after.adhesionWork() - weightWork);
        return outcome;
    }

    [[nodiscard]] Vec3D normal() const { return frame.col(2); }
    /// m, of the surfaces; negative while they overlap
    [[nodiscard]] double separation() {
        return particleHandler.getObject(0).getPosition().dot(normal()) - given.radius;
    }
    [[nodiscard]] double partingSpeed() {  // m/s
        return particleHandler.getObject(0).getVelocity().dot(normal());
    }

private:
    static double tangentOf(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

    void check() const {
        const auto require = [](std::string_view field, double value, std::string_view unit,
                                const Range& range) {
            checkValue("WetWallImpact", field, value, unit, range);
        };
        require("radius", given.radius, "m", positive);
        require("density", given.density, "kg/m^3", positive);
        require("elastic modulus", given.youngModulus, "Pa", positive);
        require("Poisson's ratio", given.poissonRatio, "", poissonRatios);
        require("elastic modulus of the plate", given.plateModulus, "Pa", positive);
        require("Poisson's ratio of the plate", given.platePoissonRatio, "", poissonRatios);
        require("restitution", given.restitution, "", positiveUpTo(1));
        require("gravity", given.gravity, "m/s^2", notNegative);
        require("speed", given.speed, "m/s", positive);
        require("angle", given.angle, "degrees", {0, 90, true, false});
        require("spin", given.spin, "rad/s", anyFinite);
        require("steps of a contact", given.stepsPerContact, "", {5, 1e6});
    }
    Material makeMaterial() const {
        Material material;
        material.setDensity(given.density);
        material.setEffectiveElasticModulusAndRestitutionCoefficient(given.modulus(), given.restitution);
        material.setEffectiveShearModulus(given.shearModulus());
        // The dashpot of the normal direction, as equation 20 has it: beta_t sqrt(8 G*) = beta sqrt(4/3 E*).
        material.setSlidingDissipation(material.getDissipation() *
                                       std::sqrt(given.modulus() / (6 * given.shearModulus())));
        material.setSpringFactor(1);
        material.setSlidingFrictionCoefficient(given.friction);
        material.setLiquidLayerThickness(given.layer);
        material.setHalfFillingAngle(given.halfFillingAngle * std::numbers::pi / 180);
        material.setContactAngle(given.contactAngle * std::numbers::pi / 180);
        material.setSurfaceTension(given.surfaceTension);
        material.setViscosity(given.viscosity);
        material.setLiquidDensity(given.liquidDensity);
        material.setRoughness(given.roughness);
        material.setGrowingBridge(given.growingBridge);
        material.setBridgeGravity(given.gravity);
        return material;
    }
    /// Work (J) against the weight of the bridge between two separations (m).
    [[nodiscard]] double bridgeWeight(double from, double to) const {
        if (to <= given.layer || given.layer == 0) return 0;
        const double mean = 0.5 * (std::max(from, given.layer) + to) - given.layer;
        return given.gravity * given.liquidDensity * bridge.volumeAt(mean) *
               (to - std::max(from, given.layer));
    }
    [[nodiscard]] bool isJoined() const { return contacts().counts().bridged > 0; }
    /// How the collision has ended; empty while it goes on.
    [[nodiscard]] std::string_view phase(bool touched, bool wasJoined) {
        const double h = separation(), v = partingSpeed();
        if (given.layer == 0) return touched && h > 0 ? "rupture" : "";
        if (wasJoined && !isJoined()) return "rupture";
        if (!touched) return v >= -1e-6 * given.speed && wasJoined ? "I" : "";
        if (h <= 0 || v > 0) return "";
        return h < given.layer ? "III" : "IV";
    }

    WetWallCase given;
    Frame frame;
    WetWall::Interaction<double> bridge;
};

}  // namespace pendular::scenes
