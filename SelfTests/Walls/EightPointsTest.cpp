#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>
#include <memory>
#include <type_traits>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Walls/WallScene.h"

// Planes that move, cylinders and surfaces of revolution give their points to eight grains at once where each
// grain meets one part; the reference is findPoints(), which gives those of one grain.

namespace pendular::wallTests::eightPointsTest {
namespace {

using support::Random;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

bool haveSameBits(const Vector<double>& a, const Vector<double>& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
Vector<double> laneOf(const Vector<Pack>& v, std::size_t lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

bool happens(Random& random, double probability) { return random.uniform(0, 1) < probability; }

// Shapes and motions
// --------------------------------------------------------------------------------------------

/// A shape in any place, with the centres that are its special cases: on its axis, on its surface, at rims.
struct Shape {
    std::unique_ptr<RigidWall> wall;
    std::vector<Vector<double>> special;
};

Shape plane(Random& random) {
    auto wall = std::make_unique<InfiniteWall>();
    const Vec3D normal = random.direction(), point = random.inCube(1);
    wall->set(normal, point);
    return {std::move(wall), {toVector(point), toVector(Vec3D(point + normal))}};
}
Shape cylinder(Random& random) {
    auto wall = std::make_unique<InfiniteCylinder>();
    const Vec3D axis = random.direction(), point = random.inCube(1);
    const double r = random.uniform(0.1, 1);
    wall->set(axis, point, r, happens(random, 0.5) ? CylinderSide::Inside : CylinderSide::Outside);
    return {std::move(wall), {toVector(point), toVector(Vec3D(point + r * axis.unitOrthogonal()))}};
}
/// Of one to four segments; some begin or end on the axis.
Shape revolution(Random& random) {
    auto wall = std::make_unique<AxisymmetricWall>();
    std::vector<ProfilePoint> profile;
    const int points = 2 + static_cast<int>(random.uniform(0, 4));
    for (int k = 0; k < points; ++k) {
        const bool canBeOnAxis = k == 0 || (k == points - 1 && profile.back().radius > 0);
        profile.push_back({canBeOnAxis && happens(random, 0.3) ? 0 : random.uniform(0.05, 1),
                           0.5 * k + random.uniform(-0.2, 0.2)});
    }
    if (happens(random, 0.3)) profile.back() = {1, profile[profile.size() - 2].height};  // across the axis
    const Vec3D axis = happens(random, 0.3) ? Vec3D(0, 0, 1) : Vec3D(random.direction()),
                point = random.inCube(1);
    wall->set(axis, point, profile);
    Shape shape{std::move(wall), {toVector(point)}};
    for (const ProfilePoint& p : profile) {  // rims, and the axis beside them
        shape.special.push_back(toVector(Vec3D(point + p.height * axis + p.radius * axis.unitOrthogonal())));
        shape.special.push_back(toVector(Vec3D(point + p.height * axis)));
    }
    return shape;
}

void move(RigidWall& wall, Random& random) {
    const double kind = random.uniform(0, 1);
    if (happens(random, 0.5)) wall.setSurfaceVelocity(random.inCube(1));
    if (kind < 0.3) return;  // at rest
    if (kind < 0.9) {
        if (kind > 0.5) wall.setAngularVelocity(random.inCube(3), random.inCube(1));
        if (kind < 0.7) wall.setVelocity(random.inCube(1));
    } else {
        wall.setMotion([axis = Eigen::Vector3d(random.direction())](double time) {
            Eigen::Isometry3d pose(Eigen::AngleAxisd(2 * time, axis));
            pose.pretranslate(0.3 * time * axis);
            return pose;
        });
    }
    wall.moveTo(random.uniform(0, 5));
}

void expectSamePoints(const RigidWall& wall, const std::array<Vector<double>, Pack::lanes>& centres,
                      const std::array<std::uint32_t, Pack::lanes>& parts) {
    std::array<double, Pack::lanes> x, y, z;
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane)
        x[lane] = centres[lane].x, y[lane] = centres[lane].y, z[lane] = centres[lane].z;
    EightWallPoints eight;
    wall.findEight({Pack::fromLanes(x), Pack::fromLanes(y), Pack::fromLanes(z)}, parts, eight);
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
        WallPoint one;
        wall.findPoints(centres[lane], 0.1, {&parts[lane], 1}, {&one, 1});
        ASSERT_EQ(std::bit_cast<std::uint64_t>(one.distance),
                  std::bit_cast<std::uint64_t>(eight.distance[lane]));
        ASSERT_TRUE(haveSameBits(one.normal, laneOf(eight.normal, lane)));
        ASSERT_TRUE(haveSameBits(one.velocity, laneOf(eight.velocity, lane)));
    }
}

TEST(EightPoints, haveTheBitsOfOne) {
    Random random(11);
    const std::array<std::function<Shape(Random&)>, 3> shapes{plane, cylinder, revolution};
    for (int k = 0; k < 1200; ++k) {
        Shape shape = shapes[static_cast<std::size_t>(k % 3)](random);
        RigidWall& wall = *shape.wall;
        move(wall, random);
        ASSERT_TRUE(wall.findsEight());
        std::array<Vector<double>, Pack::lanes> centres;
        std::array<std::uint32_t, Pack::lanes> parts;
        for (int repeats = 0; repeats < 5; ++repeats) {
            const bool isOnePart = happens(random, 0.5);
            for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
                const auto pick = static_cast<std::size_t>(
                    random.uniform(0, 3 * static_cast<double>(shape.special.size())));
                centres[lane] = pick < shape.special.size() ? wall.getPose().place(shape.special[pick])
                                                            : toVector(Vec3D(random.inCube(2)));
                const auto part = static_cast<std::uint32_t>(
                    random.uniform(0, static_cast<double>(wall.partCount()) * (1 - 1e-9)));
                parts[lane] = isOnePart && lane > 0 ? parts[0] : part;
            }
            expectSamePoints(wall, centres, parts);
            if (HasFatalFailure()) FAIL() << "shape " << k;
        }
    }
}

// A shape that gives its points to eight grains is not asked for those of one: a class that is derived from
// it could replace one function without the other.
static_assert(std::is_final_v<InfiniteWall> && std::is_final_v<InfiniteCylinder> &&
              std::is_final_v<FiniteCylinder>);

/// A mesh has edges where parts cover each other, and images of a wall have parts of their own.
TEST(EightPoints, areThoseOfShapesWithAShortFormula) {
    EXPECT_FALSE(mesh(box(at(0, 0, 0), at(1, 1, 1))).findsEight());
    FiniteCylinder tube;
    tube.set({1, 0, 0}, {0.5, 0, 0}, 0.2, 0.5);
    EXPECT_TRUE(tube.findsEight());
    tube.repeat({1, 0, 0});
    EXPECT_FALSE(tube.findsEight());
}

// Scenes
// --------------------------------------------------------------------------------------------

/// A surface of revolution that gives its points to one grain after the other.
class OneByOne : public AxisymmetricWall {
protected:
    [[nodiscard]] bool findsEightInBody() const override { return false; }
};

/// A funnel with a lid: on its wall grains meet one part, in its corners two, in its outlet both sides.
template <class Round>
Round funnel() {
    Round wall;
    wall.set({0.1, 0, 1}, {0, 0, 0},
             {{0.9 * radius, -4 * radius},
              {0.9 * radius, 0},
              {6 * radius, 6 * radius},
              {6 * radius, 16 * radius},
              {0, 16 * radius}});
    return wall;
}

template <class S, class Round>
class Funnel : public WallScene<S> {
public:
    explicit Funnel(int threads, double spin) : WallScene<S>(grains(), laws(), {0, 0, -9.8}) {
        this->setQuiet();
        this->setNumberOfThreads(threads);
        Round wall = funnel<Round>();
        wall.setSurfaceVelocity({0, 0.02, 0.05});
        if (spin != 0) wall.setAngularVelocity(spin * Vec3D(0.1, 0, 1).normalized(), {0, 0, 0});
        wall.keepForces();
        EXPECT_EQ(wall.findsEight(), (std::is_same_v<Round, AxisymmetricWall>));
        this->add(wall);
    }

private:
    static S laws() {
        S species = material<S>();
        if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) {
            species.setLiquidBridgeVolume(2e-12);
            species.setContactAngle(0.2);
            species.setSurfaceTension(0.07);
        }
        return species;
    }
    static std::vector<scenes::GrainMotion> grains() {
        Random random(3);
        std::vector<scenes::GrainMotion> all;
        for (int layer = 0; layer < 4; ++layer)
            for (int y = -2; y <= 2; ++y)
                for (int x = -2; x <= 2; ++x) {
                    if (x * x + y * y > 5) continue;
                    const double z = 7.5 + 1.9 * layer;
                    all.push_back({.radius = radius * random.uniform(0.6, 0.9),
                                   .position = radius * Vec3D(1.9 * x + 0.1 * z, 1.9 * y, z),
                                   .velocity = Vec3D(0, 0, -0.7) + random.inCube(0.4)});
                }
        return all;
    }
};

struct Found {
    std::uint64_t hash;
    Vec3D force, torque;
    friend bool operator==(const Found&, const Found&) = default;
};

template <class S, class Round>
Found after(int steps, int threads, double spin) {
    Funnel<S, Round> scene(threads, spin);
    scene.initialise();
    bool hasPairs = false;  // grains that meet two parts
    for (int k = 0; k < steps; ++k) {
        scene.step();
        std::uint32_t last = ~0u;
        scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            const std::uint32_t grain = scene.contacts().store().firstOf(c);
            hasPairs |= bucket.wall >= 0 && grain == last;
            last = bucket.wall >= 0 ? grain : ~0u;
        });
    }
    EXPECT_TRUE(hasPairs);
    const Wall& wall = scene.wallHandler.getObject(0);
    return {stateHash(scene.particleHandler.store()), wall.getForce(), wall.getTorque()};
}

template <class S>
void expectSameInFunnel(double spin) {
    const Found expected = after<S, OneByOne>(2500, 1, spin);
    EXPECT_NE(expected.force, Vec3D::Zero());
    for (const int threads : {1, 3}) EXPECT_EQ((after<S, AxisymmetricWall>(2500, threads, spin)), expected);
}
TEST(EightPoints, ofAFunnelAtRest) { expectSameInFunnel<Dry>(0); }
TEST(EightPoints, ofAFunnelThatTurns) { expectSameInFunnel<Dry>(30); }
TEST(EightPoints, ofAFunnelWithBridges) { expectSameInFunnel<Wet>(-20); }

/// The sentence with which a run ends in which one of twenty grains in a tube is too fast to be held.
template <class Round>
std::string endInTube(const Vec3D& velocity) {
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < 20; ++k)
        grains.push_back({.radius = radius, .position = {1.5 * radius, 0, (k - 9.5) * 2.5 * radius}});
    grains[13].velocity = velocity;
    WallScene<Smooth> scene(grains);
    scene.setQuiet();
    Round tube;
    tube.set({0, 0, 1}, {0, 0, 0}, {{3 * radius, -30 * radius}, {3 * radius, 30 * radius}});
    tube.setAngularVelocity({0, 0, 2}, {0, 0, 0});
    scene.add(tube);
    scene.initialise();
    for (int k = 0; k < 40; ++k) try {
            scene.step();
        } catch (const std::runtime_error& error) {
            return fmt::format("{}: {}", k, error.what());
        }
    return {};
}

TEST(EightPoints, tellWhichGrainWentThroughTheWall) {
    for (const double speed : {180., 210., 240.}) {
        const std::string expected = endInTube<OneByOne>({speed, 0, 0});
        EXPECT_NE(expected.find("Particle 13 went through wall 0"), std::string::npos) << expected;
        EXPECT_EQ(endInTube<AxisymmetricWall>({speed, 0, 0}), expected);
    }
    EXPECT_EQ(endInTube<AxisymmetricWall>({0.1, 0, 0}), "");
}

}  // namespace
}  // namespace pendular::wallTests::eightPointsTest
