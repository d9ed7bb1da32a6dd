#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// What spheres are made of, and their contact.
struct ImpactMaterial {
    double density;       // kg/m^3
    double modulus;       // E* of the contact, Pa
    double shearModulus;  // G* of the contact, Pa
    double restitution = 1;
    double friction = 0;
    double springFactor = 1;  // of Mindlin's law, as in the computations of Chung and Ooi (2011)

    /// Young's modulus (Pa) and Poisson's ratio of both bodies.
    static ImpactMaterial ofTwins(double density, double youngModulus, double poissonRatio) {
        return {density, computeEffectiveElasticModulus(youngModulus, poissonRatio),
                computeEffectiveShearModulus(youngModulus, poissonRatio)};
    }
    /// The other body is rigid: E* = E / (1 - nu^2), G* = G / (2 - nu), twice those of twins.
    static ImpactMaterial againstRigid(double density, double youngModulus, double poissonRatio) {
        const ImpactMaterial twins = ofTwins(density, youngModulus, poissonRatio);
        return {density, 2 * twins.modulus, 2 * twins.shearModulus};
    }
    [[nodiscard]] ImpactMaterial with(double newRestitution, double newFriction) const {
        return {density, modulus, shearModulus, newRestitution, newFriction, springFactor};
    }
};

/// A sphere that meets a plane, or another sphere below it, along z. At the start they just touch.
class SphereImpact : public Simulation<Species<HertzianViscoelastic, Mindlin>> {
public:
    using Material = Species<HertzianViscoelastic, Mindlin>;

    struct Sphere {
        double radius;                   // m
        Vec3D velocity = Vec3D::Zero();  // m/s
        Vec3D spin = Vec3D::Zero();      // rad/s
        bool fixed = false;

        [[nodiscard]] double inverseMass(double density) const {  // 1/kg
            return fixed ? 0 : 0.75 / (std::numbers::pi * radius * radius * radius * density);
        }
    };

    /// Onto the plane z = 0, from above.
    SphereImpact(const ImpactMaterial& values, const Sphere& sphere, int stepsPerContact) {
        const Material* material = addMaterial(values);
        add(material, sphere, sphere.radius);
        InfiniteWall plane;
        plane.set({0, 0, -1}, {0, 0, 0});
        plane.setSpecies(material);
        wallHandler.copyAndAddObject(plane);
        setStep(values, sphere.radius, sphere.inverseMass(values.density), -sphere.velocity.z(),
                stepsPerContact);
    }
    /// The upper sphere onto the lower, whose highest point is the origin.
    SphereImpact(const ImpactMaterial& values, const Sphere& upper, const Sphere& lower,
                 int stepsPerContact) {
        const Material* material = addMaterial(values);
        add(material, upper, upper.radius);
        add(material, lower, -lower.radius);
        setStep(values, 1 / (1 / upper.radius + 1 / lower.radius),
                upper.inverseMass(values.density) + lower.inverseMass(values.density),
                lower.velocity.z() - upper.velocity.z(), stepsPerContact);
    }

    /// Steps until the bodies have parted. Throws InputError where they do not: with a restitution of some
    /// 1e-12 they come to a speed at which they go no further than round-off in a step.
    void finish() {
        initialise();
        do {
            if (getNumberOfTimeSteps() >= 1000 * stepsOfContact)
                throw InputError(
                    "SphereImpact: the bodies have not parted after 1000 times the time of an elastic "
                    "contact; the restitution must be larger.");
            step();
            deepest = std::max(deepest, overlap());
            strongest = std::max(strongest, particleHandler.getObject(0).getForce().z());
        } while (overlap() > 0);
    }

    [[nodiscard]] Sphere sphere(std::size_t identity = 0) {
        const auto grain = particleHandler.getObject(identity);
        return {grain.getRadius(), grain.getVelocity(), grain.getAngularVelocity()};
    }
    [[nodiscard]] double largestOverlap() const { return deepest; }  // m, of those at the steps
    [[nodiscard]] double largestForce() const { return strongest; }  // N
    [[nodiscard]] double overlap() {                                 // m
        const auto upper = particleHandler.getObject(0);
        if (particleHandler.getSize() == 1) return upper.getRadius() - upper.getPosition().z();
        const auto lower = particleHandler.getObject(1);
        return upper.getRadius() + lower.getRadius() - (upper.getPosition() - lower.getPosition()).norm();
    }

private:
    const Material* addMaterial(const ImpactMaterial& values) {
        Material material;
        material.setDensity(values.density);
        material.setEffectiveElasticModulusAndRestitutionCoefficient(values.modulus, values.restitution);
        material.setEffectiveShearModulus(values.shearModulus);
        material.setSlidingFrictionCoefficient(values.friction);
        material.setSpringFactor(values.springFactor);
        return speciesHandler.copyAndAddObject(material);
    }
    void add(const Material* material, const Sphere& sphere, double height) {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(sphere.radius);
        grain.setPosition({0, 0, height});
        grain.setVelocity(sphere.velocity);
        grain.setAngularVelocity(sphere.spin);
        if (sphere.fixed) grain.fixParticle();
        particleHandler.copyAndAddObject(grain);
    }
    void setStep(const ImpactMaterial& values, double radius, double inverseMass, double approach,
                 int stepsPerContact) {
        checkValue("SphereImpact", "speed of approach", approach, "m/s", positive);
        // Critically damped bodies approach the end of their touch for ever.
        checkValue("SphereImpact", "restitution", values.restitution, "", positiveUpTo(1));
        stepsOfContact = static_cast<std::size_t>(stepsPerContact);
        setTimeStep(hertzContactTime(values.modulus, radius, 1 / inverseMass, approach) / stepsPerContact);
        acceptUnstableTimeStep();  // the limit is that of deeper contacts
    }

    std::size_t stepsOfContact = 0;
    double deepest = 0, strongest = 0;
};

}  // namespace pendular::scenes
