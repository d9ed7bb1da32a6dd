// Places so far from the origin that rounding does not resolve a grain: what is lost nearer than that, and
// that they are refused wherever they come from.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Fuzz/EditedState.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::farPlacesTest {
namespace {

using scenes::FewGrains;
using support::contains;
using support::isOneSentence;
using support::refusal;
using Linear = Species<LinearViscoelastic>;

constexpr double r = 1e-3;                         // m
const double farthest = farthestCoordinate(r);     // m
constexpr double density = 2500, stiffness = 1e3;  // kg/m^3, N/m

Linear material(double restitution) {
    Linear species;
    const double mass = sphereMass(r, density);
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(stiffness, restitution, mass);
    return species;
}

/// A single grain.
class One : public FewGrains<Linear> {
public:
    explicit One(const Vec3D& position = Vec3D::Zero(), const Vec3D& velocity = Vec3D::Zero())
        : FewGrains(material(0.5), {{.radius = r, .position = position, .velocity = velocity}}, 1e-5) {
        setQuiet();
    }
    [[nodiscard]] SphericalParticle grainAt(const Vec3D& position) {
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(r);
        grain.setPosition(position);
        return grain;
    }
};

void expectFar(const std::string& text, std::string_view owner) {
    EXPECT_TRUE(isOneSentence(text)) << text;
    EXPECT_TRUE(contains(text, owner)) << text;
    EXPECT_TRUE(contains(text, "so far from the origin that rounding does not resolve a radius of 0.001 m"));
    EXPECT_TRUE(contains(text, "at most 4.5e+06 m"));
}

TEST(FarPlaces, areThoseWhereOneRoundingIsAMillionthOfTheRadius) {
    // 2^-52 of a coordinate is at least its unit in the last place.
    const double unit = std::nextafter(farthest, infinity) - farthest;
    EXPECT_LE(unit, 1e-6 * r);
    EXPECT_GE(unit, 0.5e-6 * r);
    EXPECT_TRUE(isResolved({farthest, -farthest, 0}, r));
    for (const double x : {1.001 * farthest, -1.001 * farthest, 1e307, infinity, std::nan("")}) {
        EXPECT_FALSE(isResolved({x, 0, 0}, r));
        EXPECT_FALSE(isResolved({0, x, 0}, r));
        EXPECT_FALSE(isResolved({0, 0, x}, r));
    }
}

/// The restitution of two grains that meet at 0.1 m/s at a place along x.
double restitutionAt(double place) {
    // From a place that is a double, so that both positions are the same numbers but for their rounding.
    const double begin = std::floor(place);
    FewGrains<Linear> pair(material(0.5),
                           {{.radius = r, .position = {begin, 0, 0}, .velocity = {0.05, 0, 0}},
                            {.radius = r, .position = {begin + 2.01 * r, 0, 0}, .velocity = {-0.05, 0, 0}}},
                           2e-6);
    pair.run(800);
    EXPECT_LT(pair.motion(0).velocity.x(), 0);
    return (pair.motion(1).velocity.x() - pair.motion(0).velocity.x()) / 0.1;
}

/// Overlaps of n steps, of which each position is rounded by up to half of 1e-6 r: their errors add up as
/// independent ones do, k / m h sqrt(n / 3) 1e-6 r / 2 for each of the two, which is 1e-4 of the 0.1 m/s.
TEST(FarPlaces, upToTheLimitGiveTheSameRebound) {
    const double near = restitutionAt(0);
    const double mass = sphereMass(r, density), contactSteps = 160, h = 2e-6;
    const double error = stiffness / (0.5 * mass) * h * std::sqrt(contactSteps / 6) * 1e-6 * r;
    EXPECT_LT(error, 2e-4 * 0.1);
    for (const double share : {1e-3, 0.1, 0.99})
        EXPECT_NEAR(restitutionAt(share * farthest), near, 4 * error / 0.1) << share;
}

/// Set-up says where steps may be rounded.
TEST(FarPlaces, thatAreNearTheLimitAreToldOf) {
    for (const double x : {9e-3 * farthest, 1.1e-2 * farthest}) {
        One scene({0, x, 0});
        scene.setQuiet(false);
        testing::internal::CaptureStderr();
        scene.initialise();
        const std::string log = testing::internal::GetCapturedStderr();
        EXPECT_EQ(
            log.find("particle 0 is so far from the origin that its position is rounded to 1e-08 of its") !=
                std::string::npos,
            x > 1e-2 * farthest)
            << log;
    }
}

TEST(FarPlaces, areRefusedAtSetUpAndInHooks) {
    for (const double x : {1.01 * farthest, 1e9, 1e12, 1e307}) {
        expectFar(refusal([&] { One scene({0, -x, 0}); }), "particle 0: position = (");
        One scene;
        for (int begun = 0; begun < 2; ++begun) {
            expectFar(refusal([&] {
                          scene.particleHandler.copyAndAddObject(scene.grainAt({x, 0, 0}));
                      }),
                      "particle 1: position = (");
            expectFar(refusal([&] {
                          scene.particleHandler.getObject(0).setPosition({0, 0, x});
                      }),
                      "particle 0: position = (");
            if (begun == 0) scene.initialise();
        }
        scene.step();
    }
    // A grain that shrinks.
    One scene({0.9 * farthest, 0, 0});
    const std::string text = refusal([&] { scene.particleHandler.getObject(0).setRadius(0.5 * r); });
    EXPECT_TRUE(contains(text, "radius of 0.0005 m")) << text;
    EXPECT_EQ(scene.particleHandler.getObject(0).getRadius(), r);
}

TEST(FarPlaces, areRefusedOfBodiesRegionsAndFaces) {
    One scene;
    Clump clump(ClumpTemplate({{{0, 0, 0}, r}, {{1.5 * r, 0, 0}, r}}));
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setPosition({1e12, 0, 0});
    EXPECT_TRUE(
        contains(refusal([&] { scene.bodyHandler.copyAndAddObject(clump); }), "so far from the origin"));
    EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    const BodyMass mass{1, {1e307, 0, 0}, Eigen::Matrix3d::Identity()};
    EXPECT_TRUE(contains(refusal([&] { scene.bodyHandler.join({0}, mass); }), "rigid body: centre = ("));
    const BoxRegion box({1e12, 0, 0}, {1.1e12, 1, 1});
    const std::string text = refusal([&] {
        scene.insert(evenSizes(2 * r, 2.1 * r), box, Amount::grains(3), scene.grainAt({0, 0, 0}));
    });
    EXPECT_TRUE(contains(text, "insert(): a corner of the region = (")) << text;
    One periodic;
    periodic.setPeriodic(1, 1e12, 1e12 + 1);
    EXPECT_TRUE(contains(refusal([&] { periodic.initialise(); }), "a periodic face = (0, 1e+12, 0) m"));
    One wide;
    wide.setPeriodic(1, -1e307, 1e307);
    EXPECT_TRUE(contains(refusal([&] { wide.initialise(); }), "a periodic face"));
}

TEST(FarPlaces, areRefusedInFilesOfGrains) {
    const support::TestFolder folder;
    const auto file = folder.path() / "grains.txt";
    std::ofstream(file) << "1e-3 0 0 0\n1e-3 0 5e6 0\n";
    const std::string text = refusal([&] { readGrainFile(file); });
    expectFar(text, "line 2");
}

/// A number of a restart file that a damaged disk has changed: it hung the search for neighbours.
TEST(FarPlaces, areRefusedInRestartFiles) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: no restart files.";
    const support::TestFolder folder;
    const auto file = folder.path() / "run-restart.h5";
    const auto scene = [] {
        auto made = std::make_unique<One>();
        Clump clump(ClumpTemplate({{{0, 0, 0}, r}, {{1.5 * r, 0, 0}, r}}));
        clump.setSpecies(made->speciesHandler.getObject(0));
        clump.setPosition({0.1, 0, 0});
        made->bodyHandler.copyAndAddObject(clump);
        return made;
    };
    auto first = scene();
    first->initialise();
    first->step(3);
    for (const char* table : {"particles/translation", "particles/bodies/motion", "particles/bodies/arms"})
        for (const double x : {1e307, 1e12}) {
            first->writeRestart(file);
            fuzz::EditedState content(file);
            content.setNumber(table, std::string_view(table).ends_with("motion") ? 4 : 0,
                              x);  // behind mass and inertia
            content.write(file);
            sealRestartFile(file);
            auto next = scene();
            next->restartFrom(file);
            const std::string text = refusal([&] { next->initialise(); });
            EXPECT_TRUE(isOneSentence(text)) << table;
            EXPECT_TRUE(contains(text, "far")) << text;
        }
}

/// One that starts near the limit and flies over it.
TEST(FarPlaces, endARunThatComesToThem) {
    One scene({farthest - 0.5, 0, 0}, {50, 0, 0});
    scene.initialise();
    std::string text;
    try {
        scene.step(2000);
    } catch (const RunError& error) {
        text = error.what();
    }
    expectFar(text, "At time 0.0");
    EXPECT_TRUE(contains(text, "particle 0: position = (4.50"));
    EXPECT_TRUE(contains(text, "remove grains that fly away"));
    EXPECT_LT(scene.motion(0).position.x(), farthest + 1e-2);
}

}  // namespace
}  // namespace pendular::farPlacesTest
