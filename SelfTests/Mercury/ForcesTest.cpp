// Forces that a driver gives each grain in computeExternalForces(), and programs of MercuryDPM's that have
// such.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Mercury3D.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryForcesTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

// A pair that holds together goes round the origin, to which it is drawn, in a wedge of a quarter or without.
class AngledPair : public DPMBase {
public:
    explicit AngledPair(bool isWedge) {
        LinearViscoelasticFrictionReversibleAdhesiveSpecies species;
        species.setDensity(6.0 / constants::pi);
        species.setStiffness(1e2);
        species.setAdhesionStiffness(1e2);
        species.setAdhesionForceMax(1e-1 * species.getAdhesionStiffness());
        // there with a rolling friction, whose springs are not handed over
        speciesHandler.copyAndAddObject(species);
        setTimeStep(0.01 * species.getCollisionTime(1.0));
        setQuiet();
        acceptOverlaps(0.21);
        if (!isWedge) return;
        AngledPeriodicBoundary b;
        b.set(Vec3D(1, 0, 0), Vec3D(0, -1, 0), Vec3D(0, 0, 0));
        boundaryHandler.copyAndAddObject(b);
    }
    void computeExternalForces(MercuryForcedGrain p) override {
        if (!p->isFixed()) {
            const Vec3D normal = p->getPosition() / p->getPosition().norm();
            p->addForce(-normal * p->getMass());
            computeForcesDueToWalls(p);
        }
    }
    void setupInitialConditions() override {
        const Mdouble R = 4.0, d = 0.9;
        SphericalParticle p;
        p.setSpecies(speciesHandler.getObject(0));
        p.setRadius(0.5);
        p.setPosition({R, 0, 0});
        p.setVelocity({0, std::sqrt(R), 0});
        particleHandler.copyAndAddObject(p);
        const Mdouble c = (2.0 * R * R - d * d) / (2.0 * R * R), s = std::sqrt(1.0 - c * c);
        p.setPosition({R * c, R * s, 0});
        p.setVelocity({-std::sqrt(R) * s, std::sqrt(R) * c, 0});
        particleHandler.copyAndAddObject(p);
        setMin(-R - 1, -R - 1, -R - 1), setMax(R + 1, R + 1, R + 1);
    }
};

TEST(MercuryPrograms, angledPeriodicBoundaryWithABodyForce) {
    AngledPair dpm(true), dpm2(false);
    for (AngledPair* scene : {&dpm, &dpm2}) {
        scene->setTimeMax(4.0 * constants::pi);
        scene->solve();
    }
    // A mass of 1 that is drawn by 1 goes round a circle of radius 4 with 2 m/s: once in 4 pi.
    int found = 0;
    for (auto grain : dpm.particleHandler) {
        if (dpm.getCopies().isCopy(grain->getId())) continue;
        ++found;
        EXPECT_NEAR(grain->getPosition().norm(), 4, 0.02);
        EXPECT_NEAR(grain->getVelocity().norm(), 2, 0.02);
        // One of the other scene is where this one or a turn of it is.
        double nearest = 10;
        for (auto other : dpm2.particleHandler)
            for (Vec3D at = other->getPosition(), v = other->getVelocity(); const int turn : {0, 1, 2, 3}) {
                static_cast<void>(turn);
                nearest =
                    std::min(nearest, (grain->getPosition() - at).norm() + (grain->getVelocity() - v).norm());
                at = Vec3D(-at.y(), at.x(), at.z()), v = Vec3D(-v.y(), v.x(), v.z());
            }
        EXPECT_LT(nearest, 1e-9);
    }
    EXPECT_EQ(found, 2);
}

/// Plastic grains that stick together, as the clusters of the two programs have them.
LinearPlasticViscoelasticFrictionSpecies ofClusters() {
    // A loading stiffness by the time of a contact of grains of 1 kg (a setter of the species there).
    const Mdouble mass = 2000 * sphereMass(0.03, 1), restitution = 0.5,
                  both = std::pow(constants::pi, 2) + std::pow(std::log(restitution), 2),
                  time = std::sqrt(mass * both / (2 * 1e3)), loading = 0.5 * both / (time * time);
    LinearPlasticViscoelasticFrictionSpecies species;
    species.setDensity(2700);
    species.setPlasticParameters(loading, 5 * loading, loading, 0.1);
    species.setDissipation(-std::log(restitution) / time);
    species.setSlidingFrictionCoefficient(0.5);
    species.setSlidingStiffness(species.getLoadingStiffness() * 2.0 / 7.0);
    species.setSlidingDissipation(species.getDissipation() * 2.0 / 7.0);
    species.setRollingFrictionCoefficient(0.3);
    species.setRollingStiffness(species.getLoadingStiffness() * 2.0 / 7.0);
    species.setRollingDissipation(species.getDissipation() * 2.0 / 7.0);
    return species;
}

/// Grains that are drawn to the origin until they are at rest: a cluster.
class Cluster : public DPMBase {
public:
    /// @param clusterRadius m, from which their number follows: (R / r / (1 - e p))^3 e, where p is the depth
    /// of the plastic law and e = 0.58 the solid fraction of loose grains
    Cluster(double clusterRadius, double radius) {
        SphericalParticle grain(speciesHandler.copyAndAddObject(ofClusters()));
        grain.setRadius(radius);
        const auto count = static_cast<int>(std::pow(clusterRadius / radius / (1 - 0.58 * 0.1), 3) * 0.58);
        for (int k = 0; k < count; ++k) {
            const double angle = 2 * constants::pi * k / count;
            grain.setPosition(2 * radius * Vec3D(std::cos(angle), std::sin(angle), 0));
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(1e-4);
        setTimeMax(2);
        setQuiet();
    }
    void computeExternalForces(MercuryForcedGrain p) override {
        p->addForce(-p->getMass() * (500 * p->getPosition() + 20 * p->getVelocity()));
    }
};

// Three clusters of three grains, which stay together on their way: nine grains, nine contacts.
TEST(MercuryPrograms, clustersAtGivenPlaces) {
    DPMBase problem;
    problem.setQuiet();
    problem.setTimeStep(1e-4);
    problem.setTimeMax(0.5);
    problem.setDomain(Vec3D(0, 0, 0), Vec3D(0.4, 0.4, 0.4));
    SphericalParticle p(problem.speciesHandler.copyAndAddObject(ofClusters()));
    problem.acceptOverlaps(0.2);
    for (const Vec3D& position : {Vec3D(0.1, 0.2, 0.1), Vec3D(0.2, 0.2, 0.2), Vec3D(0.1, 0.2, 0.3)}) {
        Cluster cluster(0.05, 0.03);
        cluster.solve();
        EXPECT_EQ(cluster.particleHandler.getSize(), 3u);
        for (auto grain : cluster.particleHandler) {
            p.setRadius(grain->getRadius());
            p.setPosition(position + grain->getPosition());
            p.setVelocity(Vec3D(1, 0, 0));
            problem.particleHandler.copyAndAddObject(p);
        }
    }
    problem.solve();
    helpers::check(9, static_cast<double>(problem.particleHandler.getSize()), 0.1,
                   "Number of particles check");
    helpers::check(9, static_cast<double>(problem.interactionHandler.getSize()), 0.1,
                   "Number of interactions check");
}

// Clusters come at random into a box, until there is no room for more: each stays together.
TEST(MercuryPrograms, clustersAtRandomPlaces) {
    DPMBase problem;
    problem.setQuiet();
    problem.setGravity(Vec3D(0, 0, -0.0981));
    problem.setTimeStep(1e-4);
    problem.setTimeMax(0.5);
    problem.setDomain(Vec3D(-0.4, -0.05, -0.4), Vec3D(0.4, 0.05, 0.4));
    SphericalParticle p(problem.speciesHandler.copyAndAddObject(ofClusters()));
    problem.acceptOverlaps(0.2);
    std::vector<Vec3D> centres;
    for (int failed = 0; failed <= 100;) {
        const Vec3D centre(problem.random.getRandomNumber(-0.4, -0.2),
                           problem.random.getRandomNumber(-0.01, 0.01),
                           problem.random.getRandomNumber(0.2, 0.4));
        const bool isFree = std::ranges::all_of(
            centres, [&](const Vec3D& other) { return (other - centre).norm() > 4 * 0.03; });
        if (isFree) centres.push_back(centre);
        else ++failed;
    }
    for (const Vec3D& centre : centres) {
        Cluster cluster(0.05, 0.03);
        cluster.solve();
        for (auto grain : cluster.particleHandler) {
            p.setRadius(grain->getRadius());
            p.setPosition(centre + grain->getPosition());
            p.setVelocity(Vec3D(0.2, 0, 0));
            problem.particleHandler.copyAndAddObject(p);
        }
    }
    EXPECT_GE(centres.size(), 2u);
    problem.solve();
    EXPECT_EQ(problem.particleHandler.getSize(), 3 * centres.size());
    EXPECT_GE(problem.interactionHandler.getSize(), 3 * centres.size());
}

/// One grain of 1 kg on a spring of its driver's, k = 4 N/m, with a torque.
class OnASpring : public DPMBase {
public:
    double torque = 0;  // N m
    explicit OnASpring(const Vec3D& gravity = Vec3D::Zero()) {
        LinearViscoelasticSlidingFrictionSpecies species;
        species.setDensity(1 / sphereMass(0.1, 1));
        species.setStiffness(1000);
        species.setSlidingStiffness(1000), species.setSlidingFrictionCoefficient(0.5);
        SphericalParticle grain(speciesHandler.copyAndAddObject(species));
        grain.setRadius(0.1);
        grain.setPosition({1, 0, 0});
        grain.setVelocity({0, 2, 0});
        particleHandler.copyAndAddObject(grain);
        setGravity(gravity);
        setTimeStep(1e-3);
        setTimeMax(3);
        setQuiet();
    }
    void computeExternalForces(MercuryForcedGrain p) override {
        p->addForce(-4 * p->getPosition());
        p->addTorque(Vec3D(0, 0, torque));
    }
};

// Velocity Verlet's own answer for an oscillator: a circle with sin(w h / 2) = 2 h / 2, and the radius 1
// along x; along y speeds err by a share of (2 h)^2 / 8.
TEST(MercuryForces, moveAGrainAsVerletDoes) {
    OnASpring scene({0, 0, -1});
    scene.torque = 0.004;  // 1 rad/s^2, as the inertia is 0.004 kg m^2
    scene.solve();
    const auto grain = scene.particleHandler.getObject(0);
    const double step = 2 * std::asin(1e-3), angle = step * 3000;
    EXPECT_NEAR(grain.getPosition().x(), std::cos(angle), 1e-12);
    EXPECT_NEAR(grain.getPosition().y(), std::sin(angle) * 2e-3 / std::sin(step), 1e-12);
    EXPECT_NEAR(grain.getPosition().z(), -0.25 * (1 - std::cos(angle)), 1e-12);  // beside gravity
    EXPECT_NEAR(grain.getAngularVelocity().z(), 3, 1e-12);
    EXPECT_NEAR((grain.getForce() - (-4 * grain.getPosition() - Vec3D(0, 0, 1))).norm(), 0, 1e-12);
}

// A driver may call the function of the class that it derives from first, and its first grain may be held.
TEST(MercuryForces, actWhereTheOwnFunctionIsCalledToo) {
    struct CallsFirst : OnASpring {
        void computeExternalForces(MercuryForcedGrain p) override {
            DPMBase::computeExternalForces(p);
            if (!p->isFixed()) OnASpring::computeExternalForces(p);
        }
    } scene, withHeld;
    SphericalParticle held(withHeld.speciesHandler.getObject(0));
    held.setRadius(0.1);
    held.setPosition({9, 0, 0});
    withHeld.particleHandler.clear();
    withHeld.particleHandler.copyAndAddObject(held).fixParticle();
    held.setPosition({1, 0, 0}), held.setVelocity({0, 2, 0});
    withHeld.particleHandler.copyAndAddObject(held);
    scene.solve(), withHeld.solve();
    const double angle = 2 * std::asin(1e-3) * 3000;
    for (const auto grain :
         {scene.particleHandler.getLastObject(), withHeld.particleHandler.getLastObject()}) {
        EXPECT_NEAR(grain.getPosition().x(), std::cos(angle), 1e-12);
        EXPECT_NEAR(grain.getPosition().y(), std::sin(angle) * 2e-3 / std::sin(2 * std::asin(1e-3)), 1e-12);
    }
}

/// A grain of 2 mg under the force F0 sin(w t) along x, from rest.
class Driven : public DPMBase {
public:
    double frequency;             // rad/s
    std::vector<double> asked{};  // s, when
    LinearViscoelasticSpecies* material = nullptr;
    Driven(double ofForce, double step, const Integrator& scheme) : frequency(ofForce) {
        LinearViscoelasticSpecies species;
        species.setDensity(2e-6 / sphereMass(1e-4, 1)), species.setStiffness(0.1);
        material = speciesHandler.copyAndAddObject(species);
        SphericalParticle grain(material);
        grain.setRadius(1e-4);
        particleHandler.copyAndAddObject(grain);
        setIntegrator(scheme);
        setTimeStep(step);
        setQuiet();
    }
    void computeExternalForces(MercuryForcedGrain p) override {
        asked.push_back(getTime());
        p->addForce({1e-5 * std::sin(frequency * getTime()), 0, 0});
    }
};

// The exact answer of Verlet's steps, with the force at the time t + h of the end of each: v_n = (F0 h / 2 m)
// cot(w h / 2) (1 - cos n w h), x_n = F0 h^2 / (4 m sin^2(w h / 2)) (n sin w h - sin n w h), which errs by a
// share of (w h)^2 / 12; asked a step earlier the place would be x_(n-1). The digits are those of an
// independent program.
TEST(MercuryForces, actAtTheTimeThatTheyAreAskedFor) {
    struct Known {
        double frequency, x, v;  // rad/s, m, m/s
    };
    for (const Known& known : {Known{300, 0.00079714102051026, 0.029325932238094},
                               {3000, 8.3107539495636e-5, 0.00049748363979204}})
        for (const Integrator& scheme : {integrators::velocityVerlet, integrators::predictedVelocityVerlet,
                                         integrators::springsInStep}) {
            Driven scene(known.frequency, 1e-4, scheme);
            scene.setTimeMax(0.05);
            scene.solve();
            ASSERT_EQ(scene.asked.size(), 501u);
            for (std::size_t k = 0; k < scene.asked.size(); ++k)
                EXPECT_EQ(scene.asked[k], static_cast<double>(k) * 1e-4);
            const auto grain = scene.particleHandler.getObject(0);
            EXPECT_NEAR(grain.getPosition().x() / known.x, 1, 1e-11);
            EXPECT_NEAR(grain.getVelocity().x() / known.v, 1, 1e-11);
        }
}

// Second order: the error of the place at 0.05 s is a quarter at half the step, up to the next order.
TEST(MercuryForces, ofTheTimeAreOfSecondOrder) {
    const double w = 300, t = 0.05, exact = 1e-5 / (2e-6 * w) * (t - std::sin(w * t) / w);
    std::array<double, 3> error{};
    for (std::size_t k = 0; k < error.size(); ++k) {
        Driven scene(w, 1e-3 / std::pow(2, k), integrators::predictedVelocityVerlet);
        scene.setTimeMax(t);
        scene.solve();
        error[k] = std::abs(scene.particleHandler.getObject(0).getPosition().x() - exact);
    }
    EXPECT_NEAR(error[0] / error[1], 4, 0.1);
    EXPECT_NEAR(error[1] / error[2], 4, 0.025);
}

// A hook that sets the gravity g(t) for the step that comes: its value holds for the whole step, so that the
// one in the middle of it is of second order, and the one at its start of first.
TEST(MercuryForces, ofAGravityThatChangesAreOfSecondOrderByItsValueInTheMiddle) {
    struct Shaken : Driven {
        double share;  // of a step, from its start
        Shaken(double step, double at) : Driven(0, step, integrators::predictedVelocityVerlet), share(at) {}
        void actionsBeforeTimeStep() override {
            setGravity({5 * std::sin(300 * (getTime() + share * getTimeStep())), 0, 0});
        }
    };
    const double w = 300, t = 0.05, exact = 5 / w * (t - std::sin(w * t) / w);
    const auto ratio = [&](double share) {
        std::array<double, 2> error{};
        for (std::size_t k = 0; k < error.size(); ++k) {
            Shaken scene(1e-4 / std::pow(2, k), share);
            scene.setTimeMax(t);
            scene.solve();
            error[k] = std::abs(scene.particleHandler.getObject(0).getPosition().x() - exact);
        }
        return error[0] / error[1];
    };
    EXPECT_NEAR(ratio(0.5), 4, 0.1);
    EXPECT_NEAR(ratio(0), 2, 0.1);
}

// What is asked within a step knows its end, as grains are there already.
TEST(MercuryForces, conditionsOfOutletsHaveTheTimeOfTheGrains) {
    Driven scene(0, 1e-4, integrators::predictedVelocityVerlet);
    scene.particleHandler.getObject(0).setVelocity({1, 0, 0});
    Outlet outlet;
    outlet.setPlane({1, 0, 0}, {0, 0, 0});
    std::vector<double> differences;
    outlet.setCondition([&](const GrainReference& grain) {
        differences.push_back(grain.getPosition().x() - scene.getTime());
        return false;
    });
    scene.outletHandler.copyAndAddObject(outlet);
    scene.setTimeMax(1e-3);
    scene.solve();
    ASSERT_FALSE(differences.empty());
    for (const double difference : differences) EXPECT_NEAR(difference, 0, 1e-16);
}

/// Two grains of 1e-5 kg and their bond along x, the first held; a constant force pulls the second, also
/// across. The bond is critically damped: c = 2 sqrt(k m).
class Pulled : public DPMBase {
public:
    static constexpr double stiffness = 1000, mass = 1e-5;  // N/m, kg
    Vec3D force{0.01, 0.002, 0}, torque{1e-6, 0, 0};        // N, N m
    BondPart& bonds = addPart<BondPart>();
    Pulled(double steps, const Integrator& scheme) {
        LinearViscoelasticSlidingFrictionSpecies species;
        species.setDensity(mass / sphereMass(1e-3, 1)), species.setStiffness(100);
        species.setSlidingStiffness(20), species.setSlidingFrictionCoefficient(0.5);
        SphericalParticle grain(speciesHandler.copyAndAddObject(species));
        grain.setRadius(1e-3);
        particleHandler.copyAndAddObject(grain).fixParticle();
        grain.setPosition({2.1e-3, 0, 0});
        particleHandler.copyAndAddObject(grain);
        BondMaterial glue;
        glue.radius = 1e-3, glue.damping = 1;
        glue.stiffness = [](const BondSection&, double) {
            return BondStiffness{stiffness, 0.1 * stiffness, 1e-4, 1e-4};
        };
        bonds.join(0, 1, bonds.addMaterial(glue));
        setIntegrator(scheme);
        setTimeStep(steps * std::sqrt(mass / stiffness));
        setTimeMax(0.1);  // 1000 sqrt(m/k)
        setQuiet();
    }
    void computeExternalForces(MercuryForcedGrain p) override { p->addForce(force), p->addTorque(torque); }
};

// At rest the springs of the bond bear the whole force and torque, and its dashpots nothing: they see no
// velocity that only some of the forces have changed. (They bore a share of h / sqrt(m/k) of the force.)
TEST(MercuryForces, restOnDampedBondsAsTheyAre) {
    for (const Integrator& scheme : {integrators::velocityVerlet, integrators::predictedVelocityVerlet})
        for (const double steps : {0.1, 0.05, 0.025}) {
            Pulled scene(steps, scheme);
            scene.solve();
            const BondPart::Bond& bond = scene.bonds.all().at(0);
            const Vector<double> force = toVector(scene.force);
            // What is left of the start after 1000 sqrt(m/k) is nothing; places are rounded to 1e-16 of 2 mm,
            // and forces with them to 2e-16 N.
            EXPECT_LT(norm(bond.damping.force), 1e-9 * norm(force)) << steps;
            EXPECT_LT(norm(bond.damping.torque2), 1e-9 * norm(force) * 1e-3) << steps;
            EXPECT_LT(std::abs(norm(bond.elastic.force) - norm(force)), 1e-9 * norm(force)) << steps;
            EXPECT_LT(scene.particleHandler.getObject(1).getVelocity().norm(), 1e-12) << steps;
        }
}

// A hook that changes a grain in each step, so that its acceleration is found anew, leaves it the whole
// force, also where it is bonded.
TEST(MercuryForces, stayWhereAHookChangesTheGrain) {
    struct Growing : Driven {
        Growing() : Driven(0, 1e-4, integrators::predictedVelocityVerlet) {}
        void computeExternalForces(MercuryForcedGrain p) override { p->addForce({1e-5, 0, 0}); }
        void actionsAfterTimeStep() override {
            auto grain = particleHandler.getObject(0);
            grain.setRadius(grain.getRadius() * (1 + 1e-12));
        }
    } scene;
    scene.setTimeMax(0.05);
    scene.solve();
    // 5 m/s^2, but for 1500 parts in 10^12 of the mass.
    EXPECT_NEAR(scene.particleHandler.getObject(0).getVelocity().x(), 0.25, 1e-9);
    struct BondedGrowing : Pulled {
        BondedGrowing() : Pulled(0.1, integrators::predictedVelocityVerlet) { setTimeMax(0.02); }
        void actionsAfterTimeStep() override {
            auto grain = particleHandler.getObject(1);
            grain.setRadius(grain.getRadius() * (1 + 1e-12));
        }
    } bonded;
    bonded.solve();
    const BondPart::Bond& bond = bonded.bonds.all().at(0);
    EXPECT_NEAR(norm(bond.elastic.force), bonded.force.norm(), 1e-8 * bonded.force.norm());
    EXPECT_LT(norm(bond.damping.force), 1e-8 * bonded.force.norm());
}

// A grain that is pressed on a wall, whose contact a hook changes in each step, stays at the overlap F/k.
// (Without the force at the start of each step it would swing about F/2k.)
TEST(MercuryForces, stayWhereAHookChangesTheContact) {
    static constexpr double force = 1e-7, overlap = force / 0.1;  // N, m
    struct Pressed : Driven {
        Pressed() : Driven(0, 1e-4, integrators::predictedVelocityVerlet) {
            InfiniteWall wall;
            wall.setSpecies(material), wall.set({1, 0, 0}, {1e-4 - overlap, 0, 0});
            wallHandler.copyAndAddObject(wall);
            setTimeMax(0.05);
        }
        void computeExternalForces(MercuryForcedGrain p) override { p->addForce({force, 0, 0}); }
        void actionsAfterTimeStep() override {
            material->setStiffness(material->getStiffness() * (1 + 1e-12));
        }
    } scene;
    scene.solve();
    // 500 parts in 10^12 of the overlap, and the round-off of positions of 1e-4 m.
    EXPECT_NEAR(scene.particleHandler.getObject(0).getPosition().x(), 0, 1e-6 * overlap);
}

// A part of a driver's own reads the velocities that contacts have seen, wherever it stands in the order.
TEST(MercuryForces, areNotInTheVelocitiesThatOtherPartsRead) {
    struct Reads : StepPart {
        std::vector<Vec3D> seen;
        [[nodiscard]] std::string_view name() const override { return "reads velocities"; }
        void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // no settings
        void afterForces(StepContext& step) override {
            seen.push_back(step.particles.getObject(0).getVelocity());
        }
    };
    OnASpring scene;
    Reads& reads = scene.addPart<Reads>();
    scene.setTimeMax(0.01);
    scene.setIntegrator(integrators::velocityVerlet);
    std::vector<Vec3D> half;
    Vec3D x(1, 0, 0), v(0, 2, 0);
    half.push_back(v);  // forces at the start
    for (int k = 0; k < 10; ++k) {
        half.push_back(v - 0.5e-3 * 4 * x);
        x += 1e-3 * half.back();
        v = half.back() - 0.5e-3 * 4 * x;
    }
    scene.solve();
    ASSERT_EQ(reads.seen.size(), half.size());
    for (std::size_t k = 0; k < half.size(); ++k) EXPECT_LT((reads.seen[k] - half[k]).norm(), 1e-14) << k;
}

TEST(MercuryForces, areBookedAsGivenByTheDriver) {
    OnASpring scene;
    scene.torque = 0.001;
    scene.keepEnergyLedger();
    scene.solve();
    const auto grain = scene.particleHandler.getObject(0);
    const double now = scene.getKineticEnergy() + scene.getRotationalEnergy();
    EXPECT_NEAR(scene.energyLedger().driver, now - 2, 1e-13);
    EXPECT_NEAR(scene.energyUnaccountedFor(), 0, 1e-13);
    EXPECT_NEAR(scene.energyLedger().driver,
                2 - 2 * grain.getPosition().squaredNorm() + scene.getRotationalEnergy(), 1e-5);
}

TEST(MercuryForces, goOnFromARestartFile) {
    const TestFolder folder;
    const auto named = [&](OnASpring& scene) -> OnASpring& {
        scene.setName(folder.name());
        scene.setFileType(FileType::NO_FILE);
        scene.torque = 0.001;
        return scene;
    };
    OnASpring whole, first, second;
    named(whole).solve();
    named(first).setTimeMax(1);
    first.keepRestartFile();
    first.solve();
    named(second).restartFrom(folder.name() + "-restart.h5");
    second.keepEnergyLedger(false);
    second.solve();
    const auto a = whole.particleHandler.getObject(0), b = second.particleHandler.getObject(0);
    EXPECT_EQ(a.getPosition(), b.getPosition());
    EXPECT_EQ(a.getVelocity(), b.getVelocity());
    EXPECT_EQ(a.getAngularVelocity(), b.getAngularVelocity());
}

// Also where grains come later: a driver's part acts, and that of a scene without forces does not.
TEST(MercuryForces, areFoundWithoutGrains) {
    OnASpring later;
    later.particleHandler.clear();
    later.setIntegrator(integrators::adamsMoulton);
    EXPECT_TRUE(contains(refusal([&] { later.solve(); }), "forces of the driver"));
    DPMBase empty;
    empty.setIntegrator(integrators::adamsMoulton);
    LinearViscoelasticSpecies species;
    species.setDensity(1000), species.setStiffness(1000);
    empty.speciesHandler.copyAndAddObject(species);
    empty.setTimeStep(1e-3), empty.setTimeMax(0), empty.setQuiet();
    EXPECT_EQ(refusal([&] { empty.solve(); }), "");
}

TEST(MercuryForces, areRefusedWhereTheyAreNoNumberOrDoNotFit) {
    struct NotFinite : OnASpring {
        void computeExternalForces(MercuryForcedGrain p) override { p->addForce(Vec3D(0, std::nan(""), 0)); }
    } scene;
    const std::string text = refusal([&] { scene.solve(); });
    EXPECT_TRUE(isOneSentence(text) && contains(text, "particle 0") && contains(text, "is not finite"))
        << text;
    OnASpring adams;
    adams.setIntegrator(integrators::adamsMoulton);
    const std::string steps = refusal([&] { adams.solve(); });
    EXPECT_TRUE(isOneSentence(steps) && contains(steps, "forces of the driver")) << steps;
    DPMBase without;  // which has none: the part sleeps
    without.setIntegrator(integrators::adamsMoulton);
    LinearViscoelasticSpecies species;
    species.setDensity(1000), species.setStiffness(1000);
    SphericalParticle grain(without.speciesHandler.copyAndAddObject(species));
    grain.setRadius(0.1);
    without.particleHandler.copyAndAddObject(grain);
    without.setTimeStep(1e-3), without.setTimeMax(0), without.setQuiet();
    EXPECT_EQ(refusal([&] { without.solve(); }), "");
}

}  // namespace
}  // namespace pendular::mercuryForcesTest
