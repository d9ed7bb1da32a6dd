// Programs of MercuryDPM's public self-tests and tutorials in two dimensions, with solids of several planes,
// on prescribed paths, and with rolling and torsion, by its names and its includes. README.md lists them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "Boundaries/LeesEdwardsBoundary.h"
#include "Boundaries/PeriodicBoundary.h"
#include "Mercury2D.h"
#include "Mercury3D.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"
#include "Species/LinearViscoelasticFrictionSpecies.h"
#include "Species/LinearViscoelasticSpecies.h"
#include "Walls/AxisymmetricIntersectionOfWalls.h"
#include "Walls/InfiniteWall.h"
#include "Walls/IntersectionOfWalls.h"

namespace pendular::mercuryPlaneTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// A grain in a box of four walls, in two dimensions, elastic.
class Box2D : public MercuryScene<LinearViscoelasticSpecies> {
public:
    static constexpr double radius = 0.005, stiffness = 258.5;
    Vec3D position, velocity;
    std::size_t touches = 0, before = 0;

    Box2D(double width, const Vec3D& at, const Vec3D& with) : position(at), velocity(with) {
        setSystemDimensions(2);
        setXMax(width);
        setYMax(0.5);
        setZMax(0.1);
        LinearViscoelasticSpecies species;
        species.setDensity(2500.0);
        species.setStiffness(stiffness);
        species.setDissipation(0.0);
        speciesHandler.copyAndAddObject(species);
        setTimeStep(0.005 / 50.0);
        setQuiet();
    }
    void setupInitialConditions() override {
        SphericalParticle p0;
        p0.setSpecies(speciesHandler.getObject(0));
        p0.setRadius(radius);
        p0.setPosition(position);
        p0.setVelocity(velocity);
        particleHandler.copyAndAddObject(p0);
        InfiniteWall w0;
        w0.setSpecies(speciesHandler.getObject(0));
        w0.set(Vec3D(1.0, 0.0, 0.0), Vec3D(getXMax(), 0.0, 0.0));
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(-1.0, 0.0, 0.0), Vec3D(getXMin(), 0.0, 0.0));
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(0.0, 1.0, 0.0), Vec3D(0.0, getYMax(), 0.0));
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(0.0, -1.0, 0.0), Vec3D(0.0, getYMin(), 0.0));
        wallHandler.copyAndAddObject(w0);
    }
    void actionsAfterTimeStep() override {
        const std::size_t now = interactionHandler.getNumberOfObjects();
        touches += now > before ? now - before : 0;
        before = now;
    }
    [[nodiscard]] double omega() { return std::sqrt(stiffness / particleHandler.getObject(0)->getMass()); }
    /// The share of the energy that may be in the ends of touches: they lie in steps.
    [[nodiscard]] double share() {
        return static_cast<double>(touches) * mathsFunc::square(omega() * getTimeStep());
    }
};

/// Where a grain is that flies to and fro between two walls, which give it back after half a period.
double bounced(double place, double speed, double low, double high, double touch, double time) {
    for (;;) {
        const double way = (speed > 0 ? high - place : place - low) / std::abs(speed);
        if (way > time) return place + speed * time;
        place = speed > 0 ? high : low;
        time -= way + touch;
        speed = -speed;
    }
}

TEST(MercuryPrograms, particleIn2DBox) {
    Box2D scene(1, {0.5, 0.25, 0}, {1.2, 1.3, 0});
    scene.setTimeMax(2.5);
    scene.solve();
    const auto grain = scene.particleHandler.getObject(0);
    const double touch = constants::pi / scene.omega();
    // Each touch begins and ends in a step.
    const double error = static_cast<double>(scene.touches) * 1.3 * scene.getTimeStep();
    EXPECT_GE(scene.touches, 8u);
    EXPECT_NEAR(grain->getPosition().x(), bounced(0.5, 1.2, 0.005, 0.995, touch, scene.getTime()), error);
    EXPECT_NEAR(grain->getPosition().y(), bounced(0.25, 1.3, 0.005, 0.495, touch, scene.getTime()), error);
    EXPECT_NEAR(grain->getVelocity().squaredNorm() / (1.44 + 1.69), 1, scene.share());
    EXPECT_EQ(grain->getPosition().z(), 0);
    EXPECT_EQ(grain->getVelocity().z(), 0);
}

// Two grains that meet, elastic.
TEST(MercuryPrograms, elasticCollision) {
    MercuryScene<LinearViscoelasticSpecies> problem;
    problem.setXMax(0.5);
    problem.setYMax(0.25);
    problem.setZMax(0.5);
    problem.setTimeMax(2.0);
    problem.removeOldFiles();
    LinearViscoelasticSpecies species;
    species.setDensity(2500.0);
    species.setStiffness(258.5);
    species.setDissipation(0.0);
    SphericalParticle p0(problem.speciesHandler.copyAndAddObject(species));
    p0.setRadius(0.005);
    for (const double side : {0.25, 0.75}) {
        p0.setPosition(Vec3D(side * problem.getXMax(), 0.5 * problem.getYMax(), 0.5 * problem.getZMax()));
        p0.setVelocity(Vec3D(side < 0.5 ? 0.25 : -0.25, 0.0, 0.0));
        problem.particleHandler.copyAndAddObject(p0);
    }
    problem.setTimeStep(.005 / 50.0);
    problem.setQuiet();
    problem.solve();
    const auto left = problem.particleHandler.getObject(0), right = problem.particleHandler.getObject(1);
    const double omega = std::sqrt(2 * 258.5 / left->getMass()), touch = constants::pi / omega;
    // They touch after 0.48 s; the ends of the touch lie in steps.
    const double share = mathsFunc::square(omega * problem.getTimeStep());
    EXPECT_NEAR(left->getVelocity().x(), -0.25, share * 0.25);
    EXPECT_NEAR(left->getPosition().x(), 0.245 - 0.25 * (2 - 0.48 - touch),
                0.25 * (problem.getTimeStep() + 2 * share));
    EXPECT_EQ(left->getVelocity(), Vec3D(-right->getVelocity()));
}

/// How far outside of a square of half the width 0.125 about (0.25, 0.25) a point is, after a turn (rad).
double outsideSquare(const Vec3D& point, double turn) {
    const double x = point.x() - 0.25, y = point.y() - 0.25;
    return std::max(std::abs(std::cos(turn) * x + std::sin(turn) * y),
                    std::abs(std::cos(turn) * y - std::sin(turn) * x)) -
           0.125;
}

// A block in the middle of the box.
class Obstacle : public Box2D {
public:
    double nearest = 1;

    Obstacle() : Box2D(0.5, {0.15 * 0.5, 0.3335 * 0.5, 0}, {1.2, 0.2, 0}) {}
    void setupInitialConditions() override {
        Box2D::setupInitialConditions();
        IntersectionOfWalls w1;
        w1.setSpecies(speciesHandler.getObject(0));
        w1.addObject(Vec3D(-1.0, 0.0, 0.0), Vec3D(0.75 * getXMax(), 0.0, 0.0));
        w1.addObject(Vec3D(1.0, 0.0, 0.0), Vec3D(0.25 * getXMax(), 0.0, 0.0));
        w1.addObject(Vec3D(0.0, -1.0, 0.0), Vec3D(0.0, 0.75 * getYMax(), 0.0));
        w1.addObject(Vec3D(0.0, 1.0, 0.0), Vec3D(0.0, 0.25 * getYMax(), 0.0));
        wallHandler.copyAndAddObject(w1);
    }
    void actionsAfterTimeStep() override {
        Box2D::actionsAfterTimeStep();
        nearest = std::min(nearest, outsideSquare(particleHandler.getObject(0)->getPosition(), 0));
    }
};

TEST(MercuryPrograms, particleIn2DBoxWithObstacle) {
    Obstacle scene;
    scene.setTimeMax(2);
    scene.solve();
    const auto grain = scene.particleHandler.getObject(0);
    // It has met the block, up to the depth v / omega, and lost nothing.
    EXPECT_LT(scene.nearest, Box2D::radius);
    EXPECT_GT(scene.nearest, Box2D::radius - 1.01 * 1.22 / scene.omega());
    EXPECT_NEAR(grain->getVelocity().squaredNorm() / 1.48, 1, scene.share());
    EXPECT_EQ(grain->getVelocity().z(), 0);
}

// The same block, as a prism of four points that turns.
class Prism : public Box2D {
public:
    double nearest = 1;
    Vec3D afterFirst = Vec3D::Zero();  // m/s, after the first touch

    Prism() : Box2D(0.5, {0.15 * 0.5, 0.3335 * 0.5, 0}, {1.2, 0.2, 0}) {}
    void setupInitialConditions() override {
        Box2D::setupInitialConditions();
        IntersectionOfWalls w1;
        w1.setSpecies(speciesHandler.getObject(0));
        std::vector<Vec3D> Points(4);
        Points[0] = Vec3D(0.25 * getXMax(), -0.25 * getYMax(), 0.0);
        Points[1] = Vec3D(-0.25 * getXMax(), -0.25 * getYMax(), 0.0);
        Points[2] = Vec3D(-0.25 * getXMax(), 0.25 * getYMax(), 0.0);
        Points[3] = Vec3D(0.25 * getXMax(), 0.25 * getYMax(), 0.0);
        w1.createPrism(Points);
        w1.setAngularVelocity(Vec3D(0.0, 0.0, 1.0));
        w1.setVelocity(Vec3D(0.0, 0.0, 0.0));
        w1.setPosition(Vec3D(0.5 * getXMax(), 0.5 * getYMax(), 0.0));
        wallHandler.copyAndAddObject(w1);
    }
    void actionsAfterTimeStep() override {
        Box2D::actionsAfterTimeStep();
        const auto grain = particleHandler.getObject(0);
        nearest = std::min(nearest, outsideSquare(grain->getPosition(), getTime()));
        if (touches == 1 && before == 0 && afterFirst.isZero()) afterFirst = grain->getVelocity();
    }
};

TEST(MercuryPrograms, prismWalls) {
    Prism scene;
    scene.setTimeMax(2);
    scene.solve();
    EXPECT_LT(scene.nearest, Box2D::radius);
    EXPECT_GT(scene.nearest, 0);
    EXPECT_EQ(scene.particleHandler.getObject(0)->getVelocity().z(), 0);
    EXPECT_EQ(scene.particleHandler.getObject(0)->getPosition().z(), 0);
    // The first touch begins where the straight way meets the face that has turned by then.
    const Vec3D start = scene.position, speed = scene.velocity;
    double before = 0, begin = 0.1;  // s
    for (int k = 0; k < 60; ++k) {
        const double time = 0.5 * (before + begin);
        if (outsideSquare(start + time * speed, time) > Box2D::radius) before = time;
        else begin = time;
    }
    // Elastic, it is turned back from the face as that is in the middle of the touch.
    const double touch = constants::pi / scene.omega(), middle = begin + 0.5 * touch;
    const Vec3D normal(-std::cos(middle), -std::sin(middle), 0), along(normal.y(), -normal.x(), 0),
        place = start + begin * speed - Box2D::radius * normal + 0.5 * touch * speed.dot(along) * along,
        ofFace = Vec3D(0, 0, 1).cross(place - Vec3D(0.25, 0.25, 0)),
        expected = speed - 2 * (speed - ofFace).dot(normal) * normal;
    // Its ends lie in steps, and the face turns by 0.7 % of a radian in it.
    EXPECT_LT(
        (scene.afterFirst - expected).norm(),
        speed.norm() * (mathsFunc::square(scene.omega() * scene.getTimeStep()) + mathsFunc::square(touch)));
}

// Discs that meet the faces and the edges of a triangle, at rest and in a moving frame.
class Triangle2D : public MercuryScene<LinearViscoelasticSpecies> {
public:
    Vec3D frame = Vec3D::Zero();  // m/s

    explicit Triangle2D(const Vec3D& ofFrame) : frame(ofFrame) {
        speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    }
    void setupInitialConditions() override {
        setParticleDimensions(2);
        setSystemDimensions(2);
        setXMin(-2.0);
        setXMax(2.0);
        setYMin(-2.0);
        setYMax(2.0);
        auto species = speciesHandler.getObject(0);
        species->setDensity(6.0 / constants::pi);
        species->setCollisionTimeAndRestitutionCoefficient(0.01, 1.0, 1.0);
        setTimeStep(0.0002);
        setTimeMax(1.0);
        setSaveCount(
            helpers::getSaveCountFromNumberOfSavesAndTimeMaxAndTimeStep(20, getTimeMax(), getTimeStep()));
        IntersectionOfWalls w;
        w.setSpecies(species);
        const double s = std::sqrt(3);
        w.createOpenPrism({{0.5, -s / 6, 0}, {0, s / 3, 0}, {-0.5, -s / 6, 0}, {0.5, -s / 6, 0}}, {0, 0, 1});
        w.setVelocity(frame);
        wallHandler.copyAndAddObject(w);
        SphericalParticle p(species);
        p.setRadius(0.1);
        for (const double side : {-1.0, 1.5})  // towards the faces, towards the edges
            for (const Vec3D& edge : {Vec3D(0.5, -s / 6, 0), Vec3D(0, s / 3, 0), Vec3D(-0.5, -s / 6, 0)}) {
                p.setPosition(side * edge);
                p.setVelocity((side < 0 ? edge : Vec3D(-edge)) + frame);
                particleHandler.copyAndAddObject(p);
            }
        setQuiet();
    }
};

TEST(MercuryPrograms, movingIntersectionOfWalls) {
    Triangle2D basic({0, 0, 0}), moving({1, 0, 0});
    basic.solve();
    moving.solve();
    for (std::size_t k = 0; k < 6; ++k) {
        const auto grain = basic.particleHandler.getObject(k), other = moving.particleHandler.getObject(k);
        helpers::check(other->getPosition(), grain->getPosition() + Vec3D(basic.getTime(), 0, 0), 1e-10,
                       "position");
        helpers::check(other->getVelocity(), grain->getVelocity() + Vec3D(1, 0, 0), 1e-10, "velocity");
        // It has come back, with its speed; a disc has the mass of its area.
        EXPECT_GT(grain->getVelocity().dot(grain->getPosition()), 0);
        EXPECT_NEAR(grain->getMass(), 6 * 0.01, 1e-15);
        EXPECT_NEAR(grain->getInertia(), 0.5 * 6 * 0.01 * 0.01, 1e-17);
    }
    EXPECT_NEAR(basic.speciesHandler.getObject(0)->getMassFromRadius(0.1), 6 * 0.01, 1e-15);
    EXPECT_EQ(basic.getParticleDimensions() + 10 * basic.getSystemDimensions(), 22);
}

TEST(MercuryPrograms, whatLeavesThePlaneIsRefused) {
    const auto said = [](auto&& change) {
        Box2D scene(1, {0.5, 0.25, 0}, {1, 0, 0});
        scene.setTimeMax(1e-3);
        return refusal([&] {
            change(scene);
            scene.solve();
        });
    };
    EXPECT_EQ(said([](Box2D&) {}), "");
    for (const std::string& text :
         {said([](Box2D& scene) { scene.velocity.z() = 0.5; }), said([](Box2D& scene) {
              scene.setGravity({0, 0, -9.8});
          }),
          said([](Box2D& scene) {
              scene.setParticleDimensions(2);
              scene.setSystemDimensions(3);
          }),
          said([](Box2D& scene) {
              SphericalParticle above(scene.speciesHandler.getObject(0));
              above.setRadius(Box2D::radius), above.setPosition({0.2, 0.2, 0.01});
              scene.particleHandler.copyAndAddObject(above);
          }),
          said([](Box2D& scene) {
              SphericalParticle grain(scene.speciesHandler.getObject(0));
              grain.setRadius(Box2D::radius);
              CubeInsertionBoundary box;
              box.set(grain, 1, {0, 0, 0}, {0.2, 0.2, 0.1});
              scene.boundaryHandler.copyAndAddObject(box);
          }),
          said([](Box2D& scene) { scene.setSystemDimensions(1); })})
        EXPECT_TRUE(isOneSentence(text) && contains(text, "imensions")) << text;
    Mercury2D flat;
    EXPECT_EQ(flat.getSystemDimensions(), 2);
}

// A grain in two dimensions that goes through the upper face of a shear: it comes in below with the velocity
// of its image there, at the place of that one.
TEST(MercuryPrograms, leesEdwards) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    scene.setSystemDimensions(2);
    scene.setDomain({0, 0, 0}, {1, 1, 1});
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(6.0 / constants::pi), species->setStiffness(1000);
    SphericalParticle p(species);
    p.setRadius(0.05);
    p.setPosition({0.5, 0.9, 0});
    p.setVelocity({0, 0.5, 0});
    scene.particleHandler.copyAndAddObject(p);
    LeesEdwardsBoundary boundary;
    const double velocity = 0.75;
    boundary.set([velocity](double time) { return time * velocity; }, [velocity](double) { return velocity; },
                 scene.getXMin(), scene.getXMax(), scene.getYMin(), scene.getYMax());
    scene.boundaryHandler.copyAndAddObject(boundary);
    scene.setTimeStep(1e-4);
    scene.setTimeMax(0.5);
    scene.setQuiet();
    scene.solve();
    const auto grain = scene.particleHandler.getObject(0);
    EXPECT_NEAR(grain->getVelocity().x(), -velocity, 1e-15);
    EXPECT_NEAR(grain->getPosition().x(), 0.5 - velocity * 0.5, 1e-12);
    EXPECT_NEAR(grain->getPosition().y(), 0.9 + 0.25 - 1, 1e-12);
    EXPECT_EQ(grain->getVelocity().z(), 0);
    EXPECT_TRUE(isOneSentence(refusal([&] {
        LeesEdwardsBoundary().set([](double t) { return t * t; }, [](double t) { return 2 * t; }, 0, 1, 0, 1);
    })));
}

// A grain that is held goes round the unit circle.
class DrivenParticle : public MercuryScene<LinearViscoelasticSpecies> {
public:
    double farthest = 0;

    void setupInitialConditions() override {
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(1), species->setStiffness(1);
        SphericalParticle p0(species);
        p0.setRadius(0.1);
        p0.fixParticle();
        setPrescribedPosition(particleHandler.copyAndAddObject(p0),
                              [](double time) { return Vec3D(std::cos(time), 0.0, std::sin(time)); });
        setTimeStep(0.01);
        setTimeMax(2 * constants::pi);
        setXMax(1.0);
        setYMax(1.0);
        setZMax(1.0);
    }
    void actionsAfterTimeStep() override {
        const Vec3D pos = particleHandler.getObject(0)->getPosition();
        farthest = std::max(farthest, (pos - Vec3D(std::cos(getTime()), 0, std::sin(getTime()))).norm());
    }
};

TEST(MercuryPrograms, drivenParticle) {
    DrivenParticle scene;
    scene.setFileType(FileType::NO_FILE);
    scene.setQuiet();
    scene.solve();
    EXPECT_LT(scene.farthest, 1e-14);  // round-off of a step; there 1e-6
    EXPECT_LT((scene.particleHandler.getObject(0)->getPosition() - Vec3D(1, 0, 0)).norm(), 0.01);
}

// Three pairs that meet alike: one through the faces of the periods, one across them at the start, one in the
// middle; grains that are removed on the way change nothing.
class PeriodicPairs : public Mercury3D {
public:
    void setupInitialConditions() override {
        LinearViscoelasticFrictionSpecies species;
        const double stiffness = 1e5;
        species.setDensity(2500);
        species.setStiffness(stiffness);
        species.setSlidingStiffness(2.0 / 7.0 * stiffness);
        species.setSlidingFrictionCoefficient(0.5);
        species.setRollingStiffness(2.0 / 5.0 * stiffness);
        species.setRollingFrictionCoefficient(0.5);
        species.setTorsionStiffness(2.0 / 5.0 * stiffness);
        species.setTorsionFrictionCoefficient(0.5);
        auto s = speciesHandler.copyAndAddObject(species);
        setTimeMax(8e-2);
        setTimeStep(2.0e-4);
        setXMax(1.0);
        setYMax(1.0);
        setZMax(0.1);
        PeriodicBoundary b0;
        b0.set(Vec3D(1, 0, 0), getMin(), getMax());
        boundaryHandler.copyAndAddObject(b0);
        b0.set(Vec3D(0, 1, 0), getMin(), getMax());
        boundaryHandler.copyAndAddObject(b0);
        SphericalParticle p(s);
        p.setRadius(0.1);
        const auto add = [&](double x, double y, double velocity, const Vec3D& spin) {
            p.setPosition(Vec3D(x, y, 0));
            p.setVelocity(Vec3D(velocity, 0, 0));
            p.setAngularVelocity(spin);
            particleHandler.copyAndAddObject(p);
        };
        const Vec3D none(0, 0, 0), spin(0.3, 0.6, 0.9);
        add(0.1, 0.1, 0, none), add(0.3, 0.3, 0, none);
        add(0.6, 0.041, -1, spin), add(0.4, 0.001, 1, none);
        add(0.6, 0.82, -1, spin), add(0.4, 0.78, 1, none);
        add(0.02, 0.42, -1, spin), add(0.82, 0.38, 1, none);
        setQuiet();
    }
    void actionsBeforeTimeStep() override {
        if (getTime() > 3.5e-2 && particleHandler.contains(1)) particleHandler.removeObject(1);
        if (getTime() > 4.5e-2 && particleHandler.contains(0)) particleHandler.removeObject(0);
    }
};

TEST(MercuryPrograms, periodicWallsWithSlidingFriction) {
    PeriodicPairs scene;
    scene.solve();
    EXPECT_EQ(scene.particleHandler.getNumberOfObjects(), 6u);
    const auto wrapped = [](const Vec3D& way) {
        return Vec3D(way.x() - std::floor(way.x() + 0.5), way.y() - std::floor(way.y() + 0.5), way.z());
    };
    for (const std::size_t k : {0u, 1u}) {
        const auto normal = scene.particleHandler.getObject(4 + k);
        EXPECT_GT(std::abs(normal->getVelocity().y()), 0.1);  // they have met
        for (const auto& [other, shift] :
             {std::pair(6 + k, Vec3D(-0.58, -0.4, 0)), std::pair(2 + k, Vec3D(0, -0.779, 0))}) {
            const auto grain = scene.particleHandler.getObject(other);
            EXPECT_LT(wrapped(grain->getPosition() - normal->getPosition() - shift).norm(), 1e-10);
            EXPECT_LT((grain->getVelocity() - normal->getVelocity()).norm(), 1e-10);
            EXPECT_LT((grain->getAngularVelocity() - normal->getAngularVelocity()).norm(), 1e-8);
        }
    }
}

// A grain that is squeezed between two held ones turns about their line (torsion), or across it (rolling):
// the torque goes up to mu 2 R* times the normal force at each of the two, then it swings and decays.
class Squeezed : public MercuryScene<LinearViscoelasticFrictionSpecies> {
public:
    double largest = 0;
    std::vector<double> torques;  // N m, of one contact, after each step
    const bool rolls;

    explicit Squeezed(bool isRolling) : rolls(isRolling) {
        const Mdouble collisionTime = 2e-2, restitution = 0.7;
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticFrictionSpecies());
        species->setDensity(6.0 / constants::pi);
        species->setCollisionTimeAndNormalAndTangentialRestitutionCoefficient(collisionTime, restitution,
                                                                              restitution, 1);
        if (rolls) {
            species->setRollingStiffness(0.4 * species->getStiffness());
            species->setRollingDissipation(0.4 * species->getDissipation());
            species->setRollingFrictionCoefficient(0.1);
        } else {
            species->setTorsionStiffness(0.4 * species->getStiffness());
            species->setTorsionDissipation(0.4 * species->getDissipation());
            species->setTorsionFrictionCoefficient(0.1);
        }
        setTimeStep(0.02 * collisionTime);
        setTimeMax(10 * collisionTime);
        SphericalParticle p(species);
        p.setRadius(0.5);
        p.setAngularVelocity(rolls ? Vec3D(0, 1, 0) : Vec3D(0, 0, 1));
        particleHandler.copyAndAddObject(p);
        p.fixParticle();
        for (const double side : {-1.99, 1.99}) {
            p.setPosition({0, 0, side * p.getRadius()});
            particleHandler.copyAndAddObject(p);
        }
        setDomain({-1, -1, -1}, {1, 1, 1});
        setQuiet();
    }
    void actionsAfterTimeStep() override {
        const Vec3D torque = particleHandler.getObject(0)->getTorque();
        torques.push_back(-0.5 * (rolls ? torque.y() : torque.z()));
        largest = std::max(largest, std::abs(torques.back()));
    }
};

TEST(MercuryPrograms, rollingAndTorsionFriction) {
    for (const bool rolls : {true, false}) {
        Squeezed scene(rolls);
        scene.solve();
        const double force = scene.speciesHandler.getObject(0)->getStiffness() * 0.005;
        // 2 R* = r, as there: rollingFriction*radius*normalForce, by its own words; the grain stays in the
        // middle.
        EXPECT_NEAR(scene.largest, 0.1 * 0.5 * force, 1e-9 * force);
        EXPECT_LT(scene.particleHandler.getObject(0)->getAngularVelocity().norm(), 0.5);
        if (!rolls) continue;
        // Its RollingFrictionSelfTest.torque: force and torque of one contact while it slides, to six digits.
        // (When it sticks again the torque swings otherwise than there, where a spring that slides is
        // shortened together with its dashpot: SpringSlider.h.)
        EXPECT_NEAR(force, 62.4801, 5e-5);
        // While it sticks, at the end of the first step: the torque of spring and dashpot by a lever of 2 R*,
        // at the spin in the middle of the step. Its first line, 2.7622 N m, is that of a spring which the
        // forces at the start have stretched for a step already; here they only read it.
        const auto* const species = scene.speciesHandler.getObject(0);
        const double h = scene.getTimeStep(), square = 0.5 * 0.5, inertia = 0.1,
                     spring = square * species->getRollingStiffness() * h,
                     dashpot = square * species->getRollingDissipation(),
                     spinThere = 1 - h * (spring + dashpot) / inertia, spin = 1 - h * dashpot / inertia;
        EXPECT_NEAR(spring * (1 + spinThere) + dashpot * spinThere, 2.7622, 5e-5);
        EXPECT_NEAR(scene.torques[0], (spring + dashpot) * spin, 1e-9);
        for (const std::size_t step : {5u, 10u, 20u, 30u})
            EXPECT_NEAR(scene.torques[step], 3.12401, 5e-6) << step;
    }
}

// Three grains on a slope of 20 degrees: without friction, with that of sliding, and with that of rolling.
class InclinedPlane : public MercuryScene<LinearViscoelasticFrictionSpecies> {
public:
    static constexpr double radius = 0.005, stiffness = 259.018, gravity = 9.81;
    const double angle;

    explicit InclinedPlane(double degrees) : angle(degrees * constants::degree) {
        setSystemDimensions(3);
        setGravity(Vec3D(sin(angle), 0.0, -cos(angle)) * gravity);
        setXMax(0.3);
        setYMax(0.3);
        setZMax(0.05);
        setTimeMax(0.4);
        setTimeStep(0.005 / 50.0);
        setQuiet();
    }
    /// A grain beside the others, of a species of its own, that touches the plane.
    GrainReference add(double sliding, double rolling, double dashpot = 0, double overlap = 0) {
        const auto set = [&](auto& laws) {
            laws.setStiffness(stiffness);
            laws.setDissipation(0.0334);
            laws.setSlidingStiffness(2.0 / 7.0 * laws.getStiffness());
            laws.setRollingStiffness(2.0 / 5.0 * laws.getStiffness());
            laws.setSlidingDissipation(dashpot);
            laws.setRollingDissipation(dashpot);
            laws.setSlidingFrictionCoefficient(sliding);
            laws.setRollingFrictionCoefficient(rolling);
            laws.setRollingFrictionCoefficientStatic(rolling);
        };
        LinearViscoelasticFrictionSpecies own;
        own.setDensity(2500.0);
        set(own);
        auto* const species = speciesHandler.copyAndAddObject(own);
        const std::size_t number = speciesHandler.getSize();
        if (number > 1) set(*speciesHandler.getMixedObject(speciesHandler.getObject(0), species));
        else wallHandler.copyAndAddObject(InfiniteWall({0, 0, -1}, {0, 0, 0}, species));
        SphericalParticle p0(species);
        p0.setRadius(radius);
        p0.setPosition(Vec3D(0.015, 0.06 * static_cast<double>(number) - 0.057, p0.getRadius() - overlap));
        return particleHandler.copyAndAddObject(p0);
    }
    [[nodiscard]] double pull() const { return gravity * std::sin(angle); }   // m/s^2
    [[nodiscard]] double press() const { return gravity * std::cos(angle); }  // m/s^2
    [[nodiscard]] static double mass() { return sphereMass(radius, 2500); }
    /// m, of a grain at rest.
    [[nodiscard]] double overlap() const { return mass() * press() / stiffness; }
};

// What friction takes from the speed v, a grain has as spin w: v + 2/5 r^2 w / l = g sin(angle) t, where l is
// the lever, to the middle of the overlap d. d swings between 0 and twice its value at rest, and decays.
void expectMomentum(const InclinedPlane& scene, const GrainReference& grain, double start) {
    const double r = InclinedPlane::radius, d = scene.overlap(), spin = grain.getAngularVelocity().y();
    EXPECT_NEAR(grain.getVelocity().x() + 0.4 * r * r * spin / (r - 0.5 * d),
                start + scene.pull() * scene.getTime(), 0.4 * spin * 0.5 * d);
}

// And where it rolls, its surface swings on the spring of sliding, k_t = 2/7 k, about what bears 2/7 of the
// weight along the slope. The spring bears mu N at most: up to v = (mu g cos - 2/7 g sin) m / sqrt(k_t m_t)
// with m_t = 2/7 m. (Nothing damps it, and the grain has begun without a force that could bear it.)
void expectRolling(const InclinedPlane& scene, const GrainReference& grain, double friction) {
    const double lever = InclinedPlane::radius - 0.5 * scene.overlap(), spin = grain.getAngularVelocity().y(),
                 swing = (friction * scene.press() - scene.pull() * 2 / 7) * 3.5 /
                         std::sqrt(InclinedPlane::stiffness / InclinedPlane::mass());
    EXPECT_LT(std::abs(grain.getVelocity().x() - spin * lever), swing + spin * 0.5 * scene.overlap());
}

TEST(MercuryPrograms, threeGrainsOnAnInclinedPlane) {
    InclinedPlane problem(20);
    const auto smooth = problem.add(0, 0), rolls = problem.add(0.5, 0), stays = problem.add(0.5, 0.5);
    problem.solve();
    EXPECT_NEAR(smooth.getVelocity().x(), problem.pull() * 0.4, 1e-12);
    EXPECT_EQ(smooth.getAngularVelocity().norm(), 0);
    expectMomentum(problem, rolls, 0);
    expectRolling(problem, rolls, 0.5);
    // tan(20 degrees) = 0.36 < 0.5: it stays, and swings on its springs, by up to m g sin / sqrt(k m). Its
    // first bounces leave it without force now and then, until they decay in 2 m / g: less than it would roll
    // by then.
    const double mass = InclinedPlane::mass(), spring = 2.0 / 7.0 * InclinedPlane::stiffness;
    EXPECT_LT(std::abs(stays.getVelocity().x()), mass * problem.pull() / std::sqrt(spring * mass));
    const double bounces = 2 * mass / 0.0334;  // s
    EXPECT_NEAR(stays.getPosition().x(), 0.015, 0.5 * 5.0 / 7.0 * problem.pull() * bounces * bounces);
}

// With a friction below 2/7 of the slope a grain slides from the start on. Of the normal force it has felt
// m (g cos t + v_z) by then, and of friction mu times as much; its spin has grown by that on the lever.
TEST(MercuryPrograms, aGrainSlidesOnAnInclinedPlane) {
    InclinedPlane problem(20);
    const double friction = 0.05, h = problem.getTimeStep();
    const auto grain = problem.add(friction, 0);
    problem.solve();
    const double felt = problem.press() * problem.getTime() + grain.getVelocity().z();  // m/s
    // In its first step of touch it holds less than it could.
    const double first =
        friction * InclinedPlane::stiffness * 0.5 * problem.press() * h * h * h / InclinedPlane::mass();
    EXPECT_NEAR(grain.getVelocity().x(), problem.pull() * problem.getTime() - friction * felt, first);
    expectMomentum(problem, grain, 0);
    const double r = InclinedPlane::radius;
    EXPECT_NEAR(grain.getAngularVelocity().y(),
                2.5 * friction * felt * (r - 0.5 * problem.overlap()) / (r * r),
                2.5 * friction * felt * 0.5 * problem.overlap() / (r * r));
    EXPECT_GT(grain.getVelocity().x() - r * grain.getAngularVelocity().y(), 0.5);
}

// Without spin at the start it slides until v = w r, after 2 v / (7 mu g cos - 2 g sin) or so, and rolls
// then.
TEST(MercuryPrograms, aGrainSlidesAndRollsOnAnInclinedPlane) {
    InclinedPlane problem(20);
    const double friction = 0.5, start = 1;
    auto grain = problem.add(friction, 0, 0, problem.overlap());
    grain.setVelocity({start, 0, 0});
    const double slides = 2 * start / (7 * friction * problem.press() - 2 * problem.pull());  // s
    problem.setTimeMax(0.9 * slides);
    problem.solve();
    EXPECT_NEAR(grain.getVelocity().x(),
                start + (problem.pull() - friction * problem.press()) * problem.getTime(), 1e-3 * start);
    expectMomentum(problem, grain, start);
    InclinedPlane longer(20);
    auto same = longer.add(friction, 0, 0, longer.overlap());
    same.setVelocity({start, 0, 0});
    longer.solve();
    expectMomentum(longer, same, start);
    expectRolling(longer, same, friction);
}

// With dashpots of sliding and rolling a grain comes to rest on a slope of 10 degrees: down from its start by
// the stretch of the spring of sliding, and by what turns it in that of rolling, whose lever is 2 R* = 2 r.
// (With R* it would turn four times as far.) Its overlap is that at rest, and what the slope asks of friction
// at most, 2 tan(10 degrees), is below it.
TEST(MercuryPrograms, aGrainRestsOnAnInclinedPlane) {
    InclinedPlane problem(10);
    const auto grain = problem.add(0.5, 0.5, 0.1, problem.overlap());
    problem.setTimeMax(0.6);
    problem.solve();
    const double force = InclinedPlane::mass() * problem.pull(), r = InclinedPlane::radius,
                 lever = r - 0.5 * problem.overlap(), stretch = force / (2. / 7 * InclinedPlane::stiffness),
                 turn = force * lever / (2. / 5 * InclinedPlane::stiffness * 4 * r * r);  // m, rad
    // What is left of the swing is its speed over its rate. They began with 0.01 m/s: speeds that are below
    // e^-15 of it after 0.6 s have a rate above 25/s.
    const double speed =
        std::abs(grain.getVelocity().x()) + r * std::abs(grain.getAngularVelocity().y());  // m/s
    EXPECT_LT(speed, 0.01 * std::exp(-15));
    const double left = speed / 25;
    EXPECT_NEAR(grain.getPosition().x() - 0.015, stretch + turn * lever, left + 1e-7 * stretch);
}

// The solid that a triangle makes by turning, and a plane as one of this kind.
TEST(MercuryPrograms, axisymmetricWall) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    scene.setDomain({-1, -1, -1}, {1, 1, 1});
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    AxisymmetricIntersectionOfWalls w;
    w.setSpecies(species);
    w.setPosition({0, 0, 0.5});
    w.createPrism({{.1, 0, .1}, {.1, 0, .2}, {.2, 0, .1}}, {0, 1, 0});
    w.setAxis({0, 0, 1});
    auto ring = scene.wallHandler.copyAndAddObject(w);
    SphericalParticle p(species);
    p.setRadius(0.08);
    struct Expected {
        double r, z, distance;
        Vec3D normal;  // (r, 0, z)
    };
    const double h = std::sqrt(0.5);
    for (const auto& [r, z, distance, normal] :
         {Expected{0.05, 0.15, 0.05, {1, 0, 0}},         // in the bore
          Expected{0.2, 0.2, 0.1 * h, {-h, 0, -h}},      // on the cone
          Expected{0.13, 0.07, 0.03, {0, 0, 1}},         // below
          Expected{0.24, 0.07, 0.05, {-0.8, 0, 0.6}},    // at the outer edge
          Expected{0.07, 0.06, 0.05, {0.6, 0, 0.8}}}) {  // at the lower edge of the bore
        p.setPosition({0.6 * r, 0.8 * r, z + 0.5});
        double found = 0;
        Vec3D direction;
        ASSERT_TRUE(ring->getDistanceAndNormal(p, found, direction)) << r << ' ' << z;
        EXPECT_NEAR(found, distance, 1e-14);
        EXPECT_LT((direction - Vec3D(0.6 * normal.x(), 0.8 * normal.x(), normal.z())).norm(), 1e-13);
    }
    p.setPosition({0, 0, 0.65});
    double found = 0;
    Vec3D direction;
    EXPECT_FALSE(ring->getDistanceAndNormal(p, found, direction));  // on the axis, 0.1 from all of it
    w.addObject({0, 1, 0}, {0, 0, 0});
    EXPECT_TRUE(isOneSentence(refusal([&] { scene.wallHandler.copyAndAddObject(w); })));
}

// Grains that come down on a triangle: those above it go back, and those at its edges turn aside.
TEST(MercuryPrograms, triangleWall) {
    MercuryScene<LinearViscoelasticSpecies> dpm;
    dpm.setTimeMax(1);
    dpm.setDomain({0, 0, 0}, {1, 1, 1});
    const Mdouble d = .1;
    LinearViscoelasticSpecies species;
    species.setDensity(constants::pi / 6.0);
    species.setCollisionTimeAndRestitutionCoefficient(0.5, 1.0, d * d * d);
    auto s = dpm.speciesHandler.copyAndAddObject(species);
    dpm.setTimeStep(0.01);
    SphericalParticle particle(s);
    particle.setRadius(0.5 * d);
    particle.setVelocity({0, 0, -.1});
    std::vector<Vec3D> starts;
    for (Mdouble x = -d / 8; x < 1 + d; x += d + d / 22)
        for (Mdouble y = -d / 8; y < 1 + d - x; y += d + d / 22) {
            particle.setPosition(Vec3D(x, y, .5 * d));
            dpm.particleHandler.copyAndAddObject(particle);
            starts.push_back(particle.getPosition());
        }
    TriangleWall wall;
    wall.setSpecies(s);
    wall.setVertices({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    dpm.wallHandler.copyAndAddObject(wall);
    dpm.setQuiet();
    dpm.solve();
    std::size_t above = 0;
    for (auto grain : dpm.particleHandler) {
        const Vec3D velocity = grain->getVelocity(), at = starts[grain->getId()];
        // Elastic, with some 50 steps a touch.
        EXPECT_NEAR(velocity.norm(), .1, .1 * std::pow(constants::pi / 50, 2));
        if (!(std::min({at.x(), at.y(), 1 - at.x() - at.y()}) > 0)) continue;
        ++above;
        EXPECT_EQ(velocity.head<2>().norm(), 0);
        EXPECT_GT(velocity.z(), 0);
    }
    EXPECT_GE(above, 30u);
}

// A stair of eight triangles: the distances are those to its profile, also at its edges.
TEST(MercuryPrograms, getDistanceAndNormalForTriangleWalls) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto s = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    const std::array<std::pair<double, double>, 5> profile{
        {{-.7, -.7}, {-.7, 0}, {0, 0}, {.7, 0}, {.7, .7}}};  // x, z
    const double y = .9;
    TriangleWall wall;
    wall.setSpecies(s);
    for (std::size_t i = 0; i < 4; i++) {
        const auto at = [&](std::size_t k, double side) {
            return Vec3D(profile[k].first, side * y, profile[k].second);
        };
        wall.setVertices(at(i, -1), at(i + 1, -1), at(i, 1));
        scene.wallHandler.copyAndAddObject(wall);
        wall.setVertices(at(i, 1), at(i + 1, -1), at(i + 1, 1));
        scene.wallHandler.copyAndAddObject(wall);
    }
    SphericalParticle particle(s);
    particle.setRadius(0.2);
    std::size_t touched = 0;
    for (double x = -1; x <= 1; x += 0.047)
        for (double z = -1; z <= 1; z += 0.047) {
            double expected = infinity;  // m, to the profile
            for (std::size_t i = 0; i < 4; ++i) {
                const Eigen::Vector2d a(profile[i].first, profile[i].second), p(x, z),
                    along = Eigen::Vector2d(profile[i + 1].first, profile[i + 1].second) - a;
                const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
                expected = std::min(expected, (p - a - share * along).norm());
            }
            particle.setPosition({x, 0.1, z});
            double nearest = infinity;
            for (std::size_t k = 0; k < scene.wallHandler.getNumberOfObjects(); ++k) {
                double distance = 0;
                Vec3D normal;
                if (scene.wallHandler.getObject(k)->getDistanceAndNormal(particle, distance, normal))
                    nearest = std::min(nearest, distance);
            }
            if (expected < 0.2) {
                ++touched;
                EXPECT_NEAR(nearest, expected, 1e-14) << x << ' ' << z;
            } else EXPECT_EQ(nearest, infinity) << x << ' ' << z;
        }
    EXPECT_GT(touched, 300u);
    // And some lines of its file GetDistanceAndNormalForTriangleWalls.out, beside the stair and at its edges:
    // x, z and the overlap there, to six digits.
    for (const auto& [x, z, overlap] : {std::array{-0.82, -0.85, 0.00790627},
                                        {-0.82, -0.74, 0.0735089},
                                        {-0.82, -0.3, 0.08},
                                        {-0.81, 0.1, 0.0513393},
                                        {-0.8, 0.05, 0.0881966},
                                        {-0.8, -0.87, 0.00276917}}) {
        particle.setPosition({x, 0, z});
        double nearest = infinity, distance = 0;
        Vec3D normal;
        for (std::size_t k = 0; k < scene.wallHandler.getNumberOfObjects(); ++k)
            if (scene.wallHandler.getObject(k)->getDistanceAndNormal(particle, distance, normal))
                nearest = std::min(nearest, distance);
        EXPECT_NEAR(0.2 - nearest, overlap, 5e-6 * overlap + 5e-9) << x << ' ' << z;
    }
}

// A wall that turns about y, as a plane, as an intersection of one plane and as a solid of revolution: a
// grain that adheres to it goes alike.
class MovingWalls : public MercuryScene<LinearViscoelasticReversibleAdhesiveSpecies> {
public:
    explicit MovingWalls(int kind) {
        const Vec3D position(0, 0, 1);
        setMin(position - Vec3D(1, 1, 1));
        setMax(position + Vec3D(1, 1, 1));
        LinearViscoelasticReversibleAdhesiveSpecies species;
        species.setStiffnessAndRestitutionCoefficient(100.0, 0.5, 1.0);
        species.setAdhesionStiffness(100);
        species.setAdhesionForceMax(1);
        species.setDensity(6.0 / constants::pi);
        auto s = speciesHandler.copyAndAddObject(species);
        const auto add = [&](auto w) {
            w.setSpecies(s);
            w.setPosition(position);
            w.addObject(Vec3D(0, 0, 1), Vec3D(0, 0, 0));
            w.setAngularVelocity(Vec3D(0, .1, 0));
            wallHandler.copyAndAddObject(w);
        };
        if (kind == 0)
            wallHandler.copyAndAddObject(InfiniteWall({0, 0, 1}, position, s))
                ->setAngularVelocity(Vec3D(0, .1, 0), position);
        else if (kind == 1) add(IntersectionOfWalls());
        else add(AxisymmetricIntersectionOfWalls());
        SphericalParticle p(s);
        p.setRadius(0.5);
        p.setPosition(position + Vec3D(1, 0, -0.49));
        particleHandler.copyAndAddObject(p);
        setTimeStep(0.02 * species.getCollisionTime(1.0));
        setTimeMax(3);
        setQuiet();
    }
};

TEST(MercuryPrograms, movingWalls) {
    MovingWalls plane(0), solid(1), turned(2);
    plane.solve(), solid.solve(), turned.solve();
    const auto grain = plane.particleHandler.getObject(0);
    EXPECT_EQ(plane.interactionHandler.getNumberOfObjects(), 1u);
    EXPECT_LT(grain->getVelocity().z(), -0.05);  // with the wall
    for (MovingWalls* other : {&solid, &turned}) {
        const auto same = other->particleHandler.getObject(0);
        EXPECT_LT((same->getPosition() - grain->getPosition()).norm(), 1e-11);
        EXPECT_LT((same->getVelocity() - grain->getVelocity()).norm(), 1e-11);
    }
}

}  // namespace
}  // namespace pendular::mercuryPlaneTest
