// Programs of MercuryDPM's with walls by a formula (NURBS, screws, coils), and an octahedron, by its names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "Kernel/Foundation/State/Random.h"
#include "Mercury3D.h"
#include "Nurbs/NurbsSurface.h"
#include "SelfTests/Support/Refusal.h"
#include "Walls/NurbsWall.h"

namespace pendular::mercuryCurvedWallsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// A quarter of a cylinder of radius 1 around z, from z = 0 to 2.
NurbsSurface quarterOfCylinder() {
    std::vector<double> knotsU = {0, 0, 0, 1, 1, 1};
    std::vector<double> knotsV = {0, 0, 1, 1};
    std::vector<std::vector<Vec3D>> controlPoints = {
        {{1, 0, 0}, {1, 0, 2}}, {{1, 1, 0}, {1, 1, 2}}, {{0, 1, 0}, {0, 1, 2}}};
    std::vector<std::vector<Mdouble>> weights = {{1, 1}, {1, 1}, {2, 2}};
    return {knotsU, knotsV, controlPoints, weights};
}

/// m, of a point from that quarter: to its arc, or to the nearer of its two edges.
double distanceToQuarter(const Vec3D& point) {
    const double along = std::max({0.0, -point.z(), point.z() - 2});
    const double across = point.x() >= 0 && point.y() >= 0 ? std::abs(std::hypot(point.x(), point.y()) - 1)
                                                           : std::min(std::hypot(point.x() - 1, point.y()),
                                                                      std::hypot(point.x(), point.y() - 1));
    return std::hypot(along, across);
}

TEST(MercuryPrograms, nurbsSurface) {
    const Vec3D val = quarterOfCylinder().evaluate(0.5, 0.5);
    helpers::check(val, {.6, .8, 1}, std::numeric_limits<double>::epsilon(), "Nurbs evaluation failed");
    for (double u = 0; u <= 1; u += 0.125)
        for (double v = 0; v <= 1; v += 0.25) {
            const Vec3D point = quarterOfCylinder().evaluate(u, v);
            EXPECT_NEAR(std::hypot(point.x(), point.y()), 1, 1e-15);
            EXPECT_NEAR(point.z(), 2 * v, 1e-15);
        }
    const std::vector<std::vector<Vec3D>> points = {{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 0}}};
    const std::vector<std::vector<double>> ones = {{1, 1}, {1, 1}};
    const std::vector<double> knots = {0, 0, 1, 1};
    const auto said = [](auto&&... numbers) { return refusal([&] { NurbsSurface{numbers...}; }); };
    EXPECT_EQ(said(knots, knots, points, ones), "");
    for (const std::string& bad :
         {said(std::vector<double>{0, 0, 1}, knots, points, ones),
          said(std::vector<double>{0, 1, 0, 1}, knots, points, ones),
          said(knots, knots, points, std::vector<std::vector<double>>{{1, 1}, {1, 0}}),
          said(knots, knots, points, std::vector<std::vector<double>>{{1, 1}, {1}}),
          said(std::vector<double>{0, 0, 1, std::nan("")}, knots, points, ones),
          said(knots, std::vector<double>{0, 0, 1, infinity}, points, ones)})
        EXPECT_TRUE(isOneSentence(bad) && contains(bad, "NurbsSurface")) << bad;
    auto hole = points;
    hole[1][0].y() = std::nan("");
    const std::string noPoint = said(knots, knots, hole, ones);
    EXPECT_TRUE(isOneSentence(noPoint) && contains(noPoint, "y of point (1, 0)")) << noPoint;
    // Of degree 2: three knots at an end, and two within.
    std::vector<std::vector<Vec3D>> rows;
    for (int k = 0; k < 6; ++k) rows.push_back({Vec3D(k, 0, 0), Vec3D(k, 1, 0)});
    const std::vector<std::vector<double>> weights(6, {1, 1});
    EXPECT_EQ(said(std::vector<double>{0, 0, 0, .5, .5, .7, 1, 1, 1}, knots, rows, weights), "");
    for (const std::vector<double>& tooOften : {std::vector<double>{0, 0, 0, 0, .5, .7, 1, 1, 1},
                                                std::vector<double>{0, 0, 0, .5, .5, .5, 1, 1, 1}}) {
        const std::string text = said(tooOften, knots, rows, weights);
        EXPECT_TRUE(isOneSentence(text) && contains(text, "times")) << text;
    }
}

/// m, the least of a function of q from 0 to 1, which gives the square of a distance: of many samples, and
/// between the neighbours of the least one by thirds.
double leastOf(const std::function<double(double)>& square, int samples) {
    int best = 0;
    for (int k = 1; k <= samples; ++k)
        if (square(1.0 * k / samples) < square(1.0 * best / samples)) best = k;
    double low = std::max(0.0, (best - 1.0) / samples), high = std::min(1.0, (best + 1.0) / samples);
    for (int k = 0; k < 80; ++k) {
        const double third = (high - low) / 3;
        if (square(low + third) < square(high - third)) high -= third;
        else low += third;
    }
    return std::sqrt(square(0.5 * (low + high)));
}

/// m, of a point from a strip of the plane of x and z between two points, y from 0 to 1.
double distanceToStrip(const Vec3D& point, const Vec3D& from, const Vec3D& to) {
    const Vec3D way = to - from, start = point - from - Vec3D(0, point.y(), 0);
    const double along = std::clamp(start.dot(way) / way.squaredNorm(), 0.0, 1.0),
                 beside = std::max({0.0, -point.y(), point.y() - 1});
    return std::hypot((start - along * way).norm(), beside);
}

/// Grains of 0.1 m at random around a wall from x = 0 to 2, against the distances of a function.
void compareDistances(const NurbsSurface& surface, const std::function<double(const Vec3D&)>& distanceTo,
                      double most) {
    LinearViscoelasticSpecies species;
    species.setDensity(1), species.setStiffness(1);
    DPMBase dpm;
    SphericalParticle particle(dpm.speciesHandler.copyAndAddObject(species));
    particle.setRadius(.1);
    NurbsWall wall(surface);
    UniformRandom random(7);
    Vec3D normal;
    double distance = 0;
    int touching = 0;
    for (int k = 0; k < 4000; ++k) {
        particle.setPosition({random.uniform(-.1, 2.1), random.uniform(-.1, 1.1), random.uniform(-.1, 1.2)});
        const double expected = distanceTo(particle.getPosition());
        const bool touches = wall.getDistanceAndNormal(particle, distance, normal);
        ASSERT_TRUE(std::abs(expected - .1) <= most || touches == (expected < .1))
            << particle.getPosition().transpose();
        if (!touches) continue;
        ++touching;
        EXPECT_NEAR(distance, expected, most) << particle.getPosition().transpose();
    }
    EXPECT_GT(touching, 400);
}

// A roof of two flat parts, whose ridge is at a knot that is not in the middle; and the same with the
// second part cut once more at a short span.
TEST(MercuryNurbs, roofWithUnevenKnots) {
    const Vec3D a(0, 0, 0), b(1, 0, 1), c(2, 0, 0), y(0, 1, 0), d = b + 0.9 * (c - b);
    const auto distance = [&](const Vec3D& point) {
        return std::min(distanceToStrip(point, a, b), distanceToStrip(point, b, c));
    };
    const std::vector<double> knotsV = {0, 0, 1, 1};
    compareDistances(
        {{0, 0, .3, 1, 1}, knotsV, {{a, a + y}, {b, b + y}, {c, c + y}}, {{1, 1}, {1, 1}, {1, 1}}}, distance,
        1e-12);
    compareDistances({{-2, -2, .3, .31, 5, 5},
                      knotsV,
                      {{a, a + y}, {b, b + y}, {d, d + y}, {c, c + y}},
                      {{1, 1}, {1, 1}, {1, 1}, {1, 1}}},
                     distance, 1e-12);
}

// The same roof of degree 2: a double knot has the ridge, and control points in the middle of the parts
// keep them flat.
TEST(MercuryNurbs, roofWithADoubleKnot) {
    const Vec3D a(0, 0, 0), b(1, 0, 1), c(2, 0, 0), y(0, 1, 0), ab = 0.5 * (a + b), bc = 0.5 * (b + c);
    std::vector<std::vector<Vec3D>> points;
    for (const Vec3D& point : {a, ab, b, bc, c}) points.push_back({point, point + y});
    compareDistances(
        {{0, 0, 0, .2, .2, 1, 1, 1}, {0, 0, 1, 1}, points, std::vector(5, std::vector{1.0, 1.0})},
        [&](const Vec3D& point) {
            return std::min(distanceToStrip(point, a, b), distanceToStrip(point, b, c));
        },
        1e-12);
}

// A parabola z = x (2 - x), as one of degree 2 in the knots 0, 2 and with a knot put in at 0.1: the same
// surface, as control points are the blossoms (x1 + x2) / 2 and x1 + x2 - x1 x2 of neighbouring knots.
TEST(MercuryNurbs, parabolaWithAKnotPutIn) {
    const auto surface = [](std::vector<double> knots) {
        std::vector<std::vector<Vec3D>> points;
        for (std::size_t k = 1; k + 2 < knots.size(); ++k) {
            const double p = knots[k], q = knots[k + 1];
            points.push_back({Vec3D((p + q) / 2, 0, p + q - p * q), Vec3D((p + q) / 2, 1, p + q - p * q)});
        }
        const std::vector<std::vector<double>> weights(points.size(), {1, 1});
        return NurbsSurface(std::move(knots), {0, 0, 1, 1}, points, weights);
    };
    const auto distance = [](const Vec3D& point) {
        const double across = leastOf(
            [&](double q) {
                const double x = 2 * q, z = x * (2 - x);
                return (point.x() - x) * (point.x() - x) + (point.z() - z) * (point.z() - z);
            },
            400);
        return std::hypot(across, std::max({0.0, -point.y(), point.y() - 1}));
    };
    compareDistances(surface({0, 0, 0, 2, 2, 2}), distance, 1e-7);  // thirds find a place to 1e-8
    compareDistances(surface({0, 0, 0, .1, 2, 2, 2}), distance, 1e-7);
}

// Grains around a NURBS, also at its edges and beside them, are moved onto it.
TEST(MercuryPrograms, nurbsWall) {
    DPMBase dpm;
    dpm.setName("NurbsSurfaceUnitTest");
    auto s = dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    s->setDensity(1), s->setStiffness(1);
    NurbsWall nurbsWall;
    nurbsWall.setSpecies(s);
    nurbsWall.set(quarterOfCylinder());
    auto w = dpm.wallHandler.copyAndAddObject(nurbsWall);
    SphericalParticle particle;
    particle.setSpecies(s);
    particle.setRadius(.99);
    for (double x = -.5; x <= 4.5; x += .125)
        for (double z = -.5; z <= 2.5; z += .5) {
            particle.setPosition({x, 2 - x, z});
            dpm.particleHandler.copyAndAddObject(particle);
        }
    Vec3D normal;
    double distance = 0;
    int touching = 0;
    for (auto p : dpm.particleHandler) {
        const double expected = distanceToQuarter(p->getPosition());
        particle.setPosition(p->getPosition());
        const bool touches = w->getDistanceAndNormal(particle, distance, normal);
        EXPECT_EQ(touches, expected < .99);
        if (!touches) continue;
        ++touching;
        EXPECT_NEAR(distance, expected, 1e-13);
        EXPECT_NEAR(normal.norm(), 1, 1e-14);
        p->setPosition(distance * normal + p->getPosition());
        EXPECT_NEAR(distanceToQuarter(p->getPosition()), 0, 1e-13);
    }
    EXPECT_GT(touching, 80);
}

// Five grains fall on a quarter of a cylinder that lies, and into the corner between it and a plane. They are
// held in a plane across it: a pile of smooth ones would leave it by any small push.
TEST(MercuryPrograms, nurbsWallIsFilled) {
    DPMBase dpm;
    dpm.setName("NurbsWallSelfTest");
    dpm.setFileType(FileType::NO_FILE);
    dpm.setQuiet();
    dpm.setGravity({0, 0, -1});
    auto s = dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    s->setDensity(1);  // not set there
    s->setCollisionTimeAndRestitutionCoefficient(.05, .1, s->getMassFromRadius(0.1));
    NurbsWall nurbsWall;
    nurbsWall.setSpecies(s);
    nurbsWall.set(quarterOfCylinder());
    nurbsWall.setOrientationViaNormal({0, 0, 1});
    nurbsWall.setPosition({1, 0, 0});
    dpm.wallHandler.copyAndAddObject(nurbsWall);
    InfiniteWall infiniteWall;
    infiniteWall.setSpecies(s);
    infiniteWall.set({0, 1, 0}, {1, 1, 1});
    dpm.wallHandler.copyAndAddObject(infiniteWall);
    SphericalParticle particle;
    particle.setSpecies(s);
    particle.setRadius(.1);
    particle.setHeldAxes({.x = true});
    for (double y = .1; y <= .95; y += .2) {
        particle.setPosition({0, y, 1.1});
        dpm.particleHandler.copyAndAddObject(particle);
    }
    EXPECT_EQ(dpm.particleHandler.getSize(), 5u);
    dpm.setTimeStep(0.001);
    dpm.setTimeMax(10.0);  // 2 s there, when they still roll
    dpm.setDomain({-1, 0, 0}, {1, 1, 1});
    // Its file NurbsWallSelfTest.ene: the centre of mass and the energy while they fall and meet.
    struct There {
        double time, y, z, kinetic;  // s, m, m, J
    };
    for (const There& there : {There{0.1, 0.500000845, 1.095009255, 9.680489521e-05},
                               {0.2, 0.5002261517, 1.083038658, 0.000335402752},
                               {0.3, 0.5004200693, 1.063158233, 0.0006148710222},
                               {0.5, 0.5027316116, 1.01516349, 0.001234098147}}) {
        dpm.runTo(there.time);
        Vec3D centre = Vec3D::Zero();
        for (auto p : dpm.particleHandler) centre += 0.2 * p->getPosition();
        // Digits of the file, and what round-off has grown to in contacts.
        EXPECT_NEAR(centre.y(), there.y, 2e-9) << there.time;
        EXPECT_NEAR(centre.z(), there.z, 2e-9) << there.time;
        EXPECT_NEAR(dpm.getKineticEnergy(), there.kinetic, 1e-12) << there.time;
    }
    dpm.runTo(10);
    dpm.finishRun();
    // The lowest one lies between both: at y = 0.9, and 1.1 from the axis. It sinks by what five grains press
    // on it: their weights over the stiffness, and that by the slope of the surface (0.9 / 1.1).
    double lowest = 2;
    for (auto p : dpm.particleHandler) {
        EXPECT_EQ(p->getPosition().x(), 0);
        EXPECT_GT(std::hypot(p->getPosition().y(), p->getPosition().z()), 1.09);
        lowest = std::min(lowest, p->getPosition().z());
    }
    const double sag = 5 * s->getMassFromRadius(.1) / s->getStiffness() * 1.1 * 1.1 / (1.1 * 1.1 - 0.9 * 0.9);
    EXPECT_NEAR(lowest, std::sqrt(1.1 * 1.1 - 0.9 * 0.9), 2 * sag);
    EXPECT_LT(dpm.getKineticEnergy(), 1e-8 * 5 * s->getMassFromRadius(.1));
}

/// m, of a point from the blade of the screw of the test below: at each q it is a straight line from the
/// axis.
double distanceToBlade(const Vec3D& point) {
    return leastOf(
        [&](double q) {
            const Vec3D along(0, std::cos(2 * constants::pi * q), std::sin(2 * constants::pi * q)),
                foot(q, 0, 0);
            const double r = std::clamp(along.dot(point - foot), 0.0, 1.0);
            return (point - foot - r * along).squaredNorm();
        },
        400);
}

// Which grains of a lattice touch a screw. There 8213 do, which is not asserted: beyond the rim of the blade
// it takes the distance for shorter than it is, and near the axis it finds another winding.
TEST(MercuryPrograms, screw) {
    Mercury3D dpm;
    LinearViscoelasticSpecies species;
    species.setDensity(1);
    species.setStiffness(1);
    auto s = dpm.speciesHandler.copyAndAddObject(species);
    Screw screw({0, 0, 0}, 1, 1, 1, 0, .1, ScrewType::singleHelix);
    screw.setSpecies(s);
    auto w = dpm.wallHandler.copyAndAddObject(screw);
    dpm.setDomain({-0.2, -1, -1}, {1.2, 1, 1});
    Mdouble h = 0.05;
    Mdouble distance = 0;
    Vec3D normal;
    SphericalParticle particle(s);
    particle.setRadius(0.5 * h);
    UniformRandom random(1);
    int looked = 0;
    for (Mdouble x = dpm.getXMin(); x < dpm.getXMax(); x += h)
        for (Mdouble y = dpm.getYMin(); y < dpm.getYMax(); y += h)
            for (Mdouble z = dpm.getZMin(); z < dpm.getZMax(); z += h) {
                particle.setPosition({x, y, z});
                const bool touches = w->getDistanceAndNormal(particle, distance, normal);
                if (touches) dpm.particleHandler.copyAndAddObject(particle);
                if (random.uniform(0, 1) > 0.02) continue;
                ++looked;
                const double expected = distanceToBlade({x, y, z}) - 0.1;
                EXPECT_TRUE(std::abs(expected - 0.5 * h) < 1e-9 || touches == (expected < 0.5 * h));
                EXPECT_TRUE(!touches || std::abs(distance - expected) < 1e-7) << x << ' ' << y << ' ' << z;
            }
    EXPECT_GT(looked, 500);
    EXPECT_GT(dpm.particleHandler.getSize(), 0u);
}

// Grains beside a coil, where it is not, fall on it: none gets into it by more than its contacts yield, of
// the fastest 4.9 m/s times 0.05 s over pi, and half as much again for what lies on it.
TEST(MercuryPrograms, coil) {
    Mercury3D problem;
    problem.setName("CoilSelfTest");
    problem.setFileType(FileType::NO_FILE);
    problem.setQuiet();
    problem.setGravity(Vec3D(0.0, -9.8, 0.0));
    const double particleRadius = 0.2, length = 1, radius = 1 - particleRadius, turns = 2,
                 thickness = 0.5 * particleRadius;
    problem.setMin(-1, -1, 0), problem.setMax(1, 5, 2);
    LinearViscoelasticSpecies species;
    species.setDensity(1000);
    species.setCollisionTimeAndRestitutionCoefficient(0.05, 0.8, species.getMassFromRadius(particleRadius));
    auto s = problem.speciesHandler.copyAndAddObject(species);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            problem.wallHandler.copyAndAddObject(
                InfiniteWall(side * Vec3D::Unit(axis), side < 0 ? problem.getMin() : problem.getMax(), s));
    Coil coil;
    coil.setSpecies(s);
    coil.set(Vec3D(0, 0, 0), length, radius, turns, -1.0, thickness);
    auto pCoil = problem.wallHandler.copyAndAddObject(coil);
    const auto toWire = [&](const Vec3D& point) {
        return leastOf(
                   [&](double q) {
                       const double angle = 2 * constants::pi * turns * q;
                       return (point - Vec3D(radius * std::cos(angle), radius * std::sin(angle), length * q))
                           .squaredNorm();
                   },
                   400) -
               thickness;
    };
    SphericalParticle p0(s);
    p0.setRadius(particleRadius);
    const int nx = 4, ny = 14, nz = 4;  // as many as have room, with gaps of 5 %
    Mdouble distance = 0;
    Vec3D normal;
    int touching = 0;
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
            for (int k = 0; k < nz; ++k) {
                p0.setPosition({-1 + 2 * (0.5 + i) / nx, -1 + 6 * (0.5 + j) / ny, 2 * (0.5 + k) / nz});
                const double expected = toWire(p0.getPosition());
                const bool touches = pCoil->getDistanceAndNormal(p0, distance, normal);
                EXPECT_EQ(touches, expected < particleRadius);
                EXPECT_TRUE(!touches || std::abs(distance - expected) < 1e-7);
                if (!touches) problem.particleHandler.copyAndAddObject(p0);
                touching += touches ? 1 : 0;
            }
    EXPECT_GT(touching, 10);
    problem.setTimeStep(0.02 * 0.05);
    problem.setTimeMax(0.5);
    problem.solve();
    for (auto p : problem.particleHandler)
        EXPECT_GT(toWire(p->getPosition()), 0.4 * particleRadius) << p->getId();
    EXPECT_TRUE(contains(refusal([&] { coil.set(Vec3D(0, 0, 0), 1, 1, 1, 0, 0); }), "thickness"));
    EXPECT_TRUE(contains(refusal([&] { coil.set(Vec3D(0, 0, 0), 0, 1, 1, 0, 0.1); }), "length"));
}

// Grains around an octahedron, which has its distances exactly here and on a grid there.
TEST(MercuryPrograms, levelSet) {
    DPMBase dpm;
    dpm.setName("LevelSetUnitTest");
    dpm.setFileType(FileType::NO_FILE);
    dpm.setQuiet();
    auto s = dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    Mdouble r = 0.04;
    s->setDensity(1);
    s->setCollisionTimeAndRestitutionCoefficient(0.5, 0.5, s->getMassFromRadius(r));
    dpm.setDomain({-1, -1, -1}, {1, 1, 1});  // before the wall
    auto w = dpm.wallHandler.copyAndAddObject(LevelSetWall(LevelSetWall::Shape::Diamond, 0.8, s));
    w->setVelocity(Vec3D(-1, -1, 0) * 0.01);
    w->setAngularVelocity(Vec3D(0, 0, 1) * -0.05, {0, 0, 0});
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            dpm.wallHandler.copyAndAddObject(
                InfiniteWall(side * Vec3D::Unit(axis), side * Vec3D(1, 1, r), s));
    SphericalParticle p(s);
    Mdouble d = 0;
    Vec3D n;
    p.setRadius(r);
    for (Mdouble x = -1 + r; x <= 0; x += 2 * r)
        for (Mdouble y = -1 + r; y <= 0; y += 2 * r) {
            p.setPosition({x, y, 0});
            const bool touches = w->getDistanceAndNormal(p, d, n);
            // In the plane z = 0 the nearest point is on the edge x + y = -0.8 outside, on a face inside.
            const double out = -x - y - 0.8, expected = out > 0 ? out / std::sqrt(2) : out / std::sqrt(3);
            EXPECT_EQ(touches, std::abs(expected) < r);
            EXPECT_TRUE(!touches || std::abs(d - std::abs(expected)) < 1e-12);
            if (!touches && out > 0) dpm.particleHandler.copyAndAddObject(p);  // it has room inside, too
        }
    EXPECT_GT(dpm.particleHandler.getNumberOfObjects(), 60u);
    dpm.setGravity(Vec3D(1, 1, 0) * 0.5 * s->getStiffness());
    dpm.setTimeMax(2);  // 20 s there
    dpm.setTimeStep(0.01);
    dpm.solve();
    // It has moved by (-0.02, -0.02) and turned by -0.1 rad: grains are outside of it.
    const Vec3D along(std::cos(-0.1), std::sin(-0.1), 0), across(-along.y(), along.x(), 0);
    for (auto grain : dpm.particleHandler) {
        const Vec3D way = grain->getPosition() - Vec3D(-0.02, -0.02, 0);
        EXPECT_GT(std::abs(way.dot(along)) + std::abs(way.dot(across)), 0.8 + 0.5 * r * std::sqrt(2));
    }
}

}  // namespace
}  // namespace pendular::mercuryCurvedWallsTest
