// Surfaces that continue each other, though not to the last bit, are one: a crack counts as one contact where
// it is narrow against the contact, and edges that are real stay what they are
// (Kernel/Features/Meshes/ContactPatch.h).
#include <gtest/gtest.h>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/Meshes/WallSeams.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Walls/SeamScene.h"

namespace pendular::seamTest {
namespace {

using namespace wallTests;
using support::Random;

const double a = contactWidth;  // m

/// The share of Hertz' force that is missing in the middle of a crack of this width (m): the edges of the
/// crack are w^2 / (8 d) farther than a plane would be, and push at an angle of w / (2 d).
double lessOver(double width) {
    const double d = radius - overlap;
    return width * width / 8 * (1.5 / (d * overlap) + 1 / (d * d)) + 1e-9;
}

TEST(Seam, aCrackBetweenTwoSquaresIsNone) {
    for (const double width : {0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6})
        for (double x = -200e-6; x <= 200e-6; x += 5e-6) {
            const Push push = pushAt(meshed(twoSquares(width)), over(x));
            ASSERT_EQ(push.contacts, 1) << width << " " << x;
            ASSERT_NEAR(push.force.z() / hertz(), 1, lessOver(width)) << width << " " << x;
            // The nearest point is half a crack off at most.
            ASSERT_LE(std::abs(push.force.x()) / hertz(), 0.51 * width / radius + 1e-15);
        }
}

/// The restitution of an impact at x (m).
double bounce(const AddWalls& addWalls, double restitution, double x) {
    const double speed = 0.3;
    WallScene<Smooth> scene(
        {{.radius = radius, .position = {x, 0, radius + 1e-9}, .velocity = {0, 0, -speed}}},
        material<Smooth>(restitution), Vec3D::Zero(), 0.1 * step);
    scene.setQuiet();
    addWalls(scene);
    scene.initialise();
    for (int k = 0; k < 4000 && !(scene.motion(0).position.z() > radius + 1e-8); ++k) scene.step();
    return scene.motion(0).velocity.z() / speed;
}

TEST(Seam, aCrackLeavesTheRestitution) {
    for (const double restitution : {0.8, 0.5, 0.2}) {
        const double onPlane = bounce(walls(flat), restitution, 0);
        EXPECT_NEAR(onPlane, restitution, 2e-3);
        for (const double width : {1e-9, 1e-7})
            for (const double x : {0.0, 2e-10, -4e-8, 30e-6, 120e-6})
                EXPECT_NEAR(bounce(meshed(twoSquares(width)), restitution, x), onPlane, 1e-6)
                    << restitution << " " << width << " " << x;
    }
}

/// A plate and, at one of its sides, two that meet at a corner within that side; in the plane through the
/// origin across a normal, each corner rounded. The side goes through the origin along `along`.
std::vector<Triangle> crossing(const Vector<double>& normal, const Vector<double>& along,
                               double (*round)(double), const Vector<double>& origin) {
    const Vector<double> across = cross(normal, along);
    const auto corner = [&](double u, double v) {
        const Vector<double> c = origin + u * along + v * across;
        return at(round(c.x), round(c.y), round(c.z));
    };
    const auto rectangle = [&](double u1, double v1, double u2, double v2) {
        const auto p = corner(u1, v1), q = corner(u2, v1), r = corner(u2, v2), s = corner(u1, v2);
        return std::vector<Triangle>{{p, q, r}, {p, r, s}};
    };
    auto all = rectangle(-0.0371, -0.0413, 0.0419, 0);
    append(all, rectangle(-0.0371, 0, 0.00317, 0.0391));
    append(all, rectangle(0.00317, 0, 0.0419, 0.0391));
    return all;
}

TEST(Seam, aJunctionWithRoundedCornersIsNone) {
    const Vector<double> normal = (1 / std::sqrt(14.0)) * at(1, 2, 3),
                         side = cross(normal, at(0.3, -0.5, 0.8)), along = (1 / norm(side)) * side;
    const Vector<double> across = cross(normal, along);
    const auto toFloat = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    struct Case {
        double (*round)(double);
        Vector<double> origin;
        double error;  // m, of a corner along the normal: the sum of three roundings
    };
    Random random(4);
    for (const auto& [round, origin, error] :
         {Case{printed, at(0.01, 0.02, -0.03), 1.5 * 5e-8}, Case{toFloat, at(0.5, 0.6, 0.7), 1.5 * 3e-8}}) {
        const auto triangles = crossing(normal, along, round, origin);
        for (int k = 0; k < 39; ++k) {
            const double u = random.uniform(-0.02, 0.03), v = random.uniform(-1e-4, 1e-4);
            // Points around the corner count, too.
            const Vector<double> foot = origin + (k % 2 ? u : 0.00317 + 0.005 * u) * along + v * across;
            const Push push = pushAt(meshed(triangles), toEigen(foot + (radius - overlap) * normal));
            ASSERT_EQ(push.contacts, 1) << k;
            ASSERT_NEAR(push.force.norm() / hertz(), 1, 1.5 * error / overlap + 1e-6) << k;
        }
    }
}

TEST(Seam, flatFacesOfAFileAreOneSurface) {
    // Heights of corners of a public file, whose faces are meant to lie in z = 0.
    const double z[] = {1e-8, 6.6e-8, 0, 3.1e-8, -2e-8};
    std::vector<Triangle> faces;
    for (int k = 0; k < 12; ++k) {
        const auto corner = [&](double angle, int n) {
            return at(0.02 * std::cos(angle), 0.02 * std::sin(angle), z[n % 5]);
        };
        const double angle = std::numbers::pi / 6 * k;
        faces.push_back(
            {at(0, 0, z[k % 5]), corner(angle, 2 * k + 1), corner(angle + std::numbers::pi / 6, k + 3)});
    }
    Random random(5);
    for (int k = 0; k < 60; ++k) {
        const double x = random.uniform(-1, 1) * 1e-4, y = random.uniform(-1, 1) * 1e-4;
        const Push push = pushAt(meshed(faces), over(k % 2 ? x + 5e-3 : x, y));
        ASSERT_EQ(push.contacts, 1) << k;
        ASSERT_NEAR(push.force.z() / hertz(), 1, 1.5 * 6.6e-8 / overlap + 1e-6) << k;
    }
    for (const double restitution : {0.8, 0.5, 0.2})
        // The first and the last 6.6e-8 m of 1.3e-5 m, in which two may touch, have 1e-5 of the energy.
        EXPECT_NEAR(bounce(meshed(faces), restitution, 0), bounce(walls(flat), restitution, 0), 1e-3);
}

TEST(Seam, twoWallsAreOneSurface) {
    const auto left = parallelogram(at(-0.05, -0.025, 0), at(0.05, 0, 0), at(0, 0.05, 0)),
               right = parallelogram(at(0, -0.025, 0), at(0.05, 0, 0), at(0, 0.05, 0)),
               shifted = parallelogram(at(3e-8, -0.025, -2e-8), at(0.05, 0, 0), at(0, 0.05, 0));
    AxisymmetricWall disc;
    disc.set({0, 0, 1}, {0, 0, 0}, {{0, 0}, {1e-4, 0}});
    InfiniteCylinder rod;  // touches the plane from below, along y
    rod.set({0, 1, 0}, {0, 0, -5e-3}, 5e-3, CylinderSide::Outside);
    for (double x = -190e-6; x <= 190e-6; x += 9.5e-6)
        for (const auto& [name, both] :
             {std::pair<const char*, AddWalls>{"files", walls(mesh(left), mesh(right))},
              {"files, 30 nm apart", walls(mesh(left), mesh(shifted))},
              {"plane under a mesh", walls(flat, mesh(right))},
              {"mesh before the plane", walls(mesh(right), flat)},
              {"mesh of two parts and a plane", walls(mesh(twoSquares(1e-9)), flat)},
              {"disc in a plane", walls(disc, flat)},
              {"two planes", walls(flat, plane({0, 0, -1}, {0, 0, -1e-9}))},
              {"rod at a plane", walls(rod, flat)}}) {
            const Push push = pushAt(both, over(x, 2e-5));
            ASSERT_EQ(push.contacts, 1) << name << " " << x;
            ASSERT_NEAR(push.force.z() / hertz(), 1, 1.5 * 2e-8 / overlap + 1e-9) << name << " " << x;
        }
}

TEST(Seam, edgesThatAreRealStay) {
    // A step of a tenth of the radius: on the lower plate, against the upper edge.
    const double height = 0.1 * radius, depth = 1e-5;
    const double x = std::sqrt(std::pow(radius - depth, 2) - std::pow(radius - depth - height, 2));
    const Push step = pushAt(meshed(twoSquares(0, height)), {x, 0, radius - depth - height});
    EXPECT_EQ(step.contacts, 2);
    EXPECT_NEAR(step.force.z() / hertz(), 1 + (1 - height / (radius - depth)), 1e-9);
    EXPECT_NEAR(step.force.x() / hertz(), x / (radius - depth), 1e-9);
    // Grooves of two plates: each of the two pushes in full, whole, with a crack, and as two walls.
    for (const double turn : {170.0, 120.0, 90.0, 60.0, 45.0, 30.0, 25.0, 21.0}) {
        const double half = 0.5 * turn * std::numbers::pi / 180, d = radius - overlap;
        const Vector<double> rightWay = at(std::cos(half), 0, std::sin(half)),
                             leftWay = at(-std::cos(half), 0, std::sin(half)), y = at(0, 0.1, 0);
        for (const double crack : {0.0, 1e-9, 1e-6}) {
            const auto right = parallelogram(at(0, -0.05, 0) + crack * rightWay, 0.1 * rightWay, y),
                       left = parallelogram(at(0, -0.05, 0) + crack * leftWay, 0.1 * leftWay, y);
            auto both = right;
            append(both, left);
            for (const AddWalls& add : {meshed(both), walls(mesh(left), mesh(right)),
                                        walls(plane({std::sin(half), 0, -std::cos(half)}, {0, 0, 0}),
                                              plane({-std::sin(half), 0, -std::cos(half)}, {0, 0, 0}))}) {
                const Push push = pushAt(add, {0, 0, d / std::cos(half)});
                EXPECT_EQ(push.contacts, 2) << turn << " " << crack;
                EXPECT_NEAR(push.force.z() / hertz(), 2 * std::cos(half), 1e-8) << turn << " " << crack;
            }
        }
    }
    // The two sides of a slot, and two plates between which a grain is squeezed.
    EXPECT_EQ(pushAt(walls(plane({1, 0, 0}, {radius - overlap, 0, 0}),
                           plane({-1, 0, 0}, {-radius + overlap, 0, 0})),
                     {0, 0, 0})
                  .contacts,
              2);
}

TEST(Seam, aConvexEdgeCountsOnceWhetherItsFacesMeetOrNot) {
    for (const double turn : {5.0, 30.0, 90.0, 150.0})
        for (const double crack : {0.0, 1e-9, 1e-7}) {
            const double half = 0.5 * turn * std::numbers::pi / 180;
            const Vector<double> rightWay = at(std::cos(half), 0, -std::sin(half)),
                                 leftWay = at(-std::cos(half), 0, -std::sin(half)), y = at(0, 0.1, 0);
            const auto right = parallelogram(at(0, -0.05, 0) + crack * rightWay, 0.1 * rightWay, y),
                       left = parallelogram(at(0, -0.05, 0) + crack * leftWay, 0.1 * leftWay, y);
            for (double x = -1e-4; x <= 1e-4; x += 1e-5) {
                const Push push = pushAt(walls(mesh(left), mesh(right)), over(x));
                EXPECT_EQ(push.contacts, 1) << turn << " " << crack << " " << x;
                EXPECT_LE(push.force.norm() / hertz(), 1 + 1e-9);
            }
        }
}

/// A groove of facets that turn by 6 degrees, as a drum of 60 has: its sides are taken for one curved
/// surface, also where corners are rounded.
TEST(Seam, facetsOfACurvedSurfaceThatDoNotMeetAreSmooth) {
    const double half = 3 * std::numbers::pi / 180;
    const Vector<double> rightWay = at(std::cos(half), 0, std::sin(half)),
                         leftWay = at(-std::cos(half), 0, std::sin(half)), y = at(0, 0.1, 0);
    for (const double depth : {1e-7, 1e-6, 1e-5})
        for (const double crack : {0.0, 1e-9, 2e-7})
            for (const double x : {0.0, 1e-9, -1e-6, 1e-5}) {
                auto both = parallelogram(at(0, -0.05, 0) + crack * rightWay, 0.1 * rightWay, y);
                // One of them is cut, so that corners lie within its neighbour's side.
                append(both, parallelogram(at(0, -0.05, 0) + crack * leftWay, 0.1 * leftWay, 0.53 * y));
                append(both, parallelogram(at(0, 0.003, 0) + crack * leftWay, 0.1 * leftWay, 0.47 * y));
                const Push push = pushAt(meshed(both), {x, 0, (radius - depth) / std::cos(half)});
                EXPECT_EQ(push.contacts, 1) << depth << " " << crack << " " << x;
                // x raises the nearer side by x sin(3 degrees).
                EXPECT_NEAR(push.force.norm() / hertz(depth + std::abs(x) * std::sin(half)), 1, 1e-8);
            }
}

/// The largest change of the force (of Hertz') between neighbours of `count` places.
template <class At>
double largestJump(int count, At&& forceAt) {
    double largest = 0;
    Vec3D last = forceAt(0.0);
    for (int k = 1; k <= count; ++k) {
        const Vec3D now = forceAt(static_cast<double>(k) / count);
        largest = std::max(largest, (now - last).norm());
        last = now;
    }
    return largest / hertz();
}

/// From no crack to one through which the grain falls, over its middle and nearer to one side. Halving the
/// steps halves the changes: nothing jumps.
TEST(Seam, theForceIsContinuousInTheWidthOfACrack) {
    for (const double share : {0.02, 0.2, 0.45}) {  // of the width, from the middle
        const auto forceAt = [&](double of) {
            const double width = 3 * a * of;
            return pushAt(meshed(twoSquares(width)), over(share * width)).force;
        };
        const double coarse = largestJump(150, forceAt), fine = largestJump(300, forceAt);
        EXPECT_LT(fine, 0.55 * coarse) << share;
    }
}

/// Its size is so everywhere. Its direction turns where the upper plate becomes the nearer one, by the angle
/// between the two points.
TEST(Seam, theForceIsContinuousInTheHeightOfAStep) {
    for (const double x : {0.0, 0.3 * a, 1.0 * a, 2.0 * a}) {
        const auto forceAt = [&](double of) {
            const double height = 3 * overlap * of;
            return pushAt(meshed(twoSquares(0, height)), over(x, 0, overlap + height)).force;
        };
        const auto sizeAt = [&](double of) { return Vec3D(forceAt(of).norm(), 0, 0); };
        EXPECT_LT(largestJump(400, sizeAt), 0.55 * largestJump(200, sizeAt)) << x;
        EXPECT_LT(largestJump(400, forceAt), 0.55 * largestJump(200, forceAt) + x / radius) << x;
    }
}

/// Along the way over a crack the direction turns by w / R at the middle, where the nearer side changes.
TEST(Seam, theForceIsContinuousAlongTheWay) {
    for (const double width : {0.01 * a, 0.5 * a, 1.0 * a, 1.2 * a, 1.3 * a, 1.6 * a}) {
        const auto forceAt = [&](double of) {
            return pushAt(meshed(twoSquares(width)), over((of - 0.4771) * 6 * a)).force;
        };
        const double coarse = largestJump(200, forceAt), fine = largestJump(400, forceAt);
        EXPECT_LT(fine, 0.55 * coarse + width / radius) << width / a;
    }
}

TEST(Seam, aSlitAsWideAsTheOverlapIsOneContact) {
    const double width = overlap;
    const Push push = pushAt(meshed(twoSquares(width)), over(0));
    EXPECT_EQ(push.contacts, 1);
    const double d = std::hypot(radius - overlap, 0.5 * width);
    EXPECT_NEAR(push.force.norm() / hertz(radius - d), 1, 1e-9);
}

/// Outside of the circle in which the nearest contact cuts the plane, the two edges of a slit push in full.
TEST(Seam, twoEdgesThatAreApartAreTwoContacts) {
    const double width = 1.8 * a;
    const Push push = pushAt(meshed(twoSquares(width)), over(0));
    EXPECT_EQ(push.contacts, 2);
    const double d = std::hypot(radius - overlap, 0.5 * width);
    EXPECT_NEAR(push.force.z() / hertz(radius - d), 2 * (radius - overlap) / d, 1e-9);
}

TEST(Seam, theOrderOfPartsAndWallsDoesNotMatter) {
    Random random(6);
    for (int k = 0; k < 60; ++k) {
        auto triangles = twoSquares(random.uniform(0, 2) * a, random.uniform(-1, 1) * overlap);
        const Vec3D centre = over(random.uniform(-2, 2) * a, random.uniform(-1, 1) * a);
        const Vec3D once = pushAt(meshed(triangles), centre).force;
        std::reverse(triangles.begin(), triangles.end());
        EXPECT_LT((pushAt(meshed(triangles), centre).force - once).norm(), 1e-12 * hertz());
        const std::span<const Triangle> all(triangles);
        const TriangleWall one = mesh({all.begin(), all.begin() + 2}),
                           two = mesh({all.begin() + 2, all.end()});
        EXPECT_LT((pushAt(walls(one, two), centre).force - once).norm(), 1e-12 * hertz());
        EXPECT_LT((pushAt(walls(two, one), centre).force - once).norm(), 1e-12 * hertz());
    }
}

std::vector<std::string> doubts(const AddWalls& addWalls) {
    WallScene<Smooth> scene({scenes::GrainMotion{.radius = radius}});
    addWalls(scene);
    return doubtfulSeams(scene.wallHandler, radius, radius);
}

TEST(DoubtfulSeam, isToldOfOnceForAWall) {
    for (const double width : {0.0, 1e-12, 1e-9, 1e-8, 3e-4, 1e-3})
        EXPECT_TRUE(doubts(meshed(twoSquares(width))).empty()) << width;
    EXPECT_TRUE(doubts(meshed(box(at(0, 0, 0), at(1e-3, 1e-4, 1e-3), 3))).empty());  // a thin plate
    EXPECT_TRUE(doubts(meshed(parallelogram(at(0, 0, 0), at(0.1, 0, 0), at(0, 0.1, 0.05), 7, 5))).empty());
    for (const auto& triangles : {twoSquares(5e-5), twoSquares(0, 2e-5), twoSquares(1e-6)}) {
        const auto told = doubts(meshed(triangles));
        ASSERT_EQ(told.size(), 1u);
        EXPECT_TRUE(support::isOneSentence(told[0] + "."));
        EXPECT_TRUE(support::contains(told[0], "Part 0 of wall 0 and part 1 of wall 0"));
    }
    std::vector<Triangle> many;
    for (int k = 0; k < 50; ++k)
        append(many, parallelogram(at(1.05e-3 * k, 0, 0), at(1e-3, 0, 0), at(0, 0.05, 0)));
    EXPECT_EQ(doubts(meshed(many)).size(), 1u);
    const auto apart = doubts(walls(flat, mesh(parallelogram(at(0, 0, 1e-5), at(0.1, 0, 0), at(0, 0.1, 0)))));
    ASSERT_EQ(apart.size(), 1u);
    EXPECT_TRUE(support::contains(apart[0], "Part 0 of wall 1 and part 0 of wall 0"));
}

TEST(DoubtfulSeam, isABeltThatLiesInAFloor) {
    const auto floor = parallelogram(at(-0.1, -0.1, 0), at(0.2, 0, 0), at(0, 0.2, 0));
    TriangleWall belt = mesh(parallelogram(at(0, 0, 0), at(0.02, 0, 0), at(0, 0.02, 0)));
    EXPECT_TRUE(doubts(walls(mesh(floor), belt)).empty());
    belt.setSurfaceVelocity({0.1, 0, 0});
    const auto told = doubts(walls(mesh(floor), belt));
    ASSERT_EQ(told.size(), 1u);
    EXPECT_TRUE(support::isOneSentence(told[0] + "."));
    EXPECT_TRUE(support::contains(told[0], "touches wall 0 alone"));
    // Beside it there is no doubt.
    const auto beside = parallelogram(at(-0.1, -0.1, 0), at(0.1, 0, 0), at(0, 0.2, 0));
    EXPECT_TRUE(doubts(walls(mesh(beside), belt)).empty());
}

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

/// What edges do to a wet grain whose liquid pulls by nothing: only what it touches counts.
Push pushOnWet(const AddWalls& addWalls, const Vec3D& centre, double volume) {
    Wet glass = material<Wet>();
    glass.setLiquidBridgeVolume(volume * radius * radius * radius);
    glass.setSurfaceTension(1e-9), glass.setContactAngle(0.2);
    WallScene<Wet> scene({{.radius = radius, .position = centre}}, glass, Vec3D::Zero(), 1e-15);
    WallScene<Smooth> dry({}, material<Smooth>(), Vec3D::Zero(), 1e-15);
    scene.setQuiet(), dry.setQuiet();
    addWalls(dry);
    for (std::size_t k = 0; k < dry.wallHandler.getSize(); ++k)
        if (const auto* const own = dynamic_cast<const InfiniteWall*>(&dry.wallHandler.getObject(k)))
            scene.add(*own);
        else scene.add(dynamic_cast<const TriangleWall&>(dry.wallHandler.getObject(k)));
    scene.initialise();
    scene.step();
    return {scene.particleHandler.getObject(0).getForce(), scene.touching()};
}

/// However wide the liquid is: a grain that touches two real edges or faces stands on both.
TEST(Seam, ofAWetGrainIsNoneWhereItTouchesEdges) {
    const double distance = radius - overlap;
    for (const double volume : {1e-4, 1e-3, 1e-2, 0.05, 0.1}) {
        SCOPED_TRACE(volume);
        for (const double height : {0.05 * radius, 0.1 * radius, 0.2 * radius}) {
            const double x = std::sqrt(distance * distance - std::pow(distance - height, 2));
            const Push push = pushOnWet(meshed(twoSquares(0, height)), {x, 0, distance - height}, volume);
            EXPECT_EQ(push.contacts, 2) << height;
            EXPECT_NEAR(push.force.x(), hertz() * x / distance, 1e-3 * hertz()) << height;
        }
        for (const double turn : {25.0, 30.0, 40.0, 60.0}) {
            const double half = turn / 2 * std::numbers::pi / 180;
            const Push push = pushOnWet(walls(plane({std::sin(half), 0, -std::cos(half)}, {0, 0, 0}),
                                              plane({-std::sin(half), 0, -std::cos(half)}, {0, 0, 0})),
                                        {0, 0, distance / std::cos(half)}, volume);
            EXPECT_EQ(push.contacts, 2) << turn;
            EXPECT_NEAR(push.force.z(), 2 * hertz() * std::cos(half), 1e-3 * hertz()) << turn;
        }
    }
}

/// A cylinder of facets about the y axis, from inside, whose corners are off by up to a noise (m).
std::vector<Triangle> facetedCylinder(double ownRadius, int facets, double noise) {
    support::Random random(5);
    std::vector<Triangle> triangles;
    const auto corner = [&](int k, double y) {
        const double angle = 2 * std::numbers::pi * k / facets;
        const Vec3D off = random.inCube(noise);
        return at(ownRadius * std::cos(angle) + off.x(), y + off.y(), ownRadius * std::sin(angle) + off.z());
    };
    for (int k = 0; k < facets; ++k) {
        const double y = 5 * radius;
        triangles.push_back({corner(k, -y), corner(k + 1, -y), corner(k + 1, y)});
        triangles.push_back({corner(k, -y), corner(k + 1, y), corner(k, y)});
    }
    return triangles;
}

/// Facets that are small against the contact, and do not share their corners to the last bit, bear a grain
/// once, as those that do.
TEST(Seam, ofAFinelyCutCavityIsNone) {
    for (const double own : {radius / 0.5, radius / 0.7, radius / 0.9})
        for (const int facets : {60, 120, 360}) {
            const double inner = own * std::cos(std::numbers::pi / facets);
            for (const double angle : {0.1, 1.3, 4.0}) {
                const double out = inner - radius + overlap;
                const Vec3D centre(out * std::cos(angle), 0.3 * radius, out * std::sin(angle));
                const Push shared = pushAt(meshed(facetedCylinder(own, facets, 0)), centre),
                           cracked = pushAt(meshed(facetedCylinder(own, facets, 1e-9)), centre);
                EXPECT_EQ(cracked.contacts, shared.contacts) << radius / own << ' ' << facets;
                EXPECT_LT((cracked.force - shared.force).norm(), 1e-3 * shared.force.norm())
                    << radius / own << ' ' << facets;
            }
        }
}

}  // namespace
}  // namespace pendular::seamTest
