// Contacts that go over seams, or stay on them: what they remember, what they give to walls, bridges, the
// ledger, threads and restarts.
#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/Quantum.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Walls/SeamScene.h"

namespace pendular::seamRunTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

Wet wet() {
    Wet species = material<Wet>();
    species.setLiquidBridgeVolume(1e-11);
    species.setContactAngle(0.2);
    species.setSurfaceTension(0.07);
    return species;
}

/// Strips of a floor, 0.6 mm wide, with cracks between them; some lie a little lower.
std::vector<std::vector<Triangle>> strips(double crack) {
    std::vector<std::vector<Triangle>> all;
    for (int k = -2; k < 60; ++k)
        all.push_back(parallelogram(at(0.6e-3 * k, -0.02, k % 3 == 0 ? -crack : 0), at(0.6e-3 - crack, 0, 0),
                                    at(0, 0.04, 0)));
    return all;
}
std::vector<Triangle> joined(const std::vector<std::vector<Triangle>>& parts) {
    std::vector<Triangle> all;
    for (const auto& part : parts) append(all, part);
    return all;
}

/// A grain that slides, then rolls, over strips and over a plane.
template <class S>
void expectRollsAsOnAPlane(const S& species, double crack, bool asWalls) {
    const GrainMotion grain{.radius = radius,
                            .position = {2.05e-3, 2.2e-3, radius - 2e-7},
                            .velocity = {0.3, 0.07, 0},
                            .spin = {0, 100, 30}};
    const Vec3D gravity{0, 0, -9.81};
    WallScene<S> smooth({grain}, species, gravity), cracked({grain}, species, gravity);
    smooth.add(flat);
    if (asWalls)
        for (const auto& strip : strips(crack)) cracked.add(mesh(strip));
    else cracked.add(mesh(joined(strips(crack))));
    smooth.setQuiet(), cracked.setQuiet();
    smooth.initialise();
    cracked.initialise();
    double worst = 0;
    for (int k = 0; k < 12000; ++k) {
        smooth.step();
        cracked.step();
        ASSERT_LE(cracked.touching(), 1) << "step " << k;
        worst = std::max(worst, (smooth.motion(0).velocity - cracked.motion(0).velocity).norm());
    }
    EXPECT_GT(smooth.motion(0).position.x(), 10e-3);
    // Strips that lie lower by the crack: the grain falls by that, with sqrt(2 g crack), some 1e-4 m/s for
    // 1e-9 m; a spring that was lost at each crack would change its velocity by mu g for the time of a
    // period, 1e-3 m/s, at each of 20 strips.
    EXPECT_LT(worst, crack > 0 ? 3 * std::sqrt(2 * 9.81 * crack) : 3e-13);
}

TEST(SeamRun, aGrainRollsOverCracksAsOverAPlane) {
    for (const double crack : {1e-10, 1e-9})
        for (const bool asWalls : {false, true}) {
            expectRollsAsOnAPlane(material<Dry>(), crack, asWalls);
            expectRollsAsOnAPlane(wet(), crack, asWalls);
        }
}

/// The spring of a grain that friction holds on a slope goes on from wall to wall: it does not creep.
TEST(SeamRun, theSpringGoesOnFromWallToWall) {
    const auto velocityAfter = [](bool asWalls) {
        // It swings about x = 0, where one wall ends and the next begins, on a spring that does not slip.
        WallScene<Dry> scene(
            {{.radius = radius, .position = {2e-8, 0, radius - 5e-6}, .velocity = {-1e-3, 0, 0}}},
            material<Dry>(0.9, 5));
        scene.setQuiet();
        if (asWalls) {
            scene.add(mesh(parallelogram(at(0, -0.02, 0), at(0.02, 0, 0), at(0, 0.04, 0))));
            scene.add(mesh(parallelogram(at(-0.02, -0.02, 0), at(0.02 - 1e-13, 0, 0), at(0, 0.04, 0))));
        } else {
            scene.add(flat);
        }
        scene.initialise();
        std::vector<double> found;
        for (int k = 0; k < 15; ++k) {
            scene.steps(1);
            found.push_back(scene.motion(0).spin.y());
        }
        return found;
    };
    const auto whole = velocityAfter(false), cracked = velocityAfter(true);
    for (std::size_t k = 0; k < whole.size(); ++k)
        EXPECT_NEAR(cracked[k], whole[k], 1e-6 * std::abs(whole[k]));
}

int bridges(WallScene<Wet>& scene) { return static_cast<int>(scene.contacts().counts().bridged); }

TEST(SeamRun, aCrackHasOneBridge) {
    for (const double x : {0.0, 1e-10, 3e-5, 1.5e-4})
        for (const bool fromStart : {false, true}) {
            const auto forces = [&](const std::vector<TriangleWall>& shapes) {
                WallScene<Wet> scene(
                    {{.radius = radius, .position = {x, 0, radius + (fromStart ? 1e-5 : -1e-5)}}}, wet());
                scene.setQuiet();
                for (const TriangleWall& shape : shapes) scene.add(shape);
                if (shapes.empty()) scene.add(flat);
                if (fromStart) scene.joinAtStart(2e-5);
                scene.initialise();
                scene.particleHandler.getObject(0).setVelocity({0, 0, 0.3});
                std::vector<double> found;
                for (int k = 0; k < 3000 && (k < 2 || bridges(scene) > 0); ++k) {
                    scene.step();
                    EXPECT_LE(bridges(scene), 1) << x;
                    found.push_back(scene.particleHandler.getObject(0).getForce().z());
                }
                return found;
            };
            const auto whole = forces({});
            ASSERT_GT(whole.size(), 100u);
            ASSERT_LT(whole.size(), 3000u);  // it ruptures
            for (const auto& shapes :
                 {std::vector{mesh(twoSquares(1e-9))},
                  std::vector{mesh(parallelogram(at(-0.05, -0.02, 0), at(0.05, 0, 0), at(0, 0.04, 0))),
                              mesh(parallelogram(at(1e-9, -0.02, 0), at(0.05, 0, 0), at(0, 0.04, 0)))}}) {
                const auto cracked = forces(shapes);
                ASSERT_EQ(cracked.size(), whole.size()) << x;
                for (std::size_t k = 0; k < whole.size(); ++k)
                    ASSERT_NEAR(cracked[k], whole[k], 1e-6 * std::abs(whole[0])) << x << " " << k;
            }
        }
}

/// Grains that roll over a cracked floor of two walls, a mesh of strips and a plane, and along a side.
template <class S>
class CrackedFloor : public WallScene<S> {
public:
    explicit CrackedFloor(const S& species, double crack = 1e-7, bool isPlane = false)
        : WallScene<S>(heap(), species, {0, 0, -9.81}) {
        this->setQuiet();
        for (std::size_t half = 0; half < 2 && !isPlane; ++half) {
            std::vector<Triangle> own;
            const auto all = strips(crack);
            for (std::size_t k = half; k < all.size(); k += 2) append(own, all[k]);
            this->add(mesh(own))->keepForces();
        }
        this->add(flat)->keepForces();
        this->add(mesh(parallelogram(at(0, -0.02, -0.001), at(0, 0.04, 0), at(0, 0, 0.02), 3, 3)))
            ->keepForces();
        InfiniteWall far = plane({1, 0, 0}, {20e-3, 0, 0});
        this->add(far)->keepForces();
    }

private:
    static std::vector<GrainMotion> heap() {
        std::vector<GrainMotion> grains;
        for (int x = 0; x < 4; ++x)
            for (int y = 0; y < 3; ++y)
                grains.push_back({.radius = radius,
                                  .position = {1.3e-3 + 2.4e-3 * x, 2.3e-3 * y, 1.05e-3},
                                  .velocity = {0.3 * (y - 1.5), 0.1 * (x - 1), 0},
                                  .spin = {100.0 * x, -50.0 * y, 0}});
        return grains;
    }
};

TEST(SeamRun, wallsBearWhatGrainsFeel) {
    CrackedFloor<Dry> scene(material<Dry>());
    scene.initialise();
    int most = 0;
    for (int k = 0; k < 3000; ++k) {
        scene.step();
        Vec3D onGrains = Vec3D::Zero(), onWalls = Vec3D::Zero();
        for (std::size_t g = 0; g < scene.particleHandler.getSize(); ++g)
            onGrains += scene.particleHandler.getObject(g).getForce() -
                        scene.particleHandler.getObject(g).getMass() * Vec3D(0, 0, -9.81);
        for (std::size_t w = 0; w < 5; ++w) onWalls += scene.wallHandler.getObject(w).getForce();
        // Grains have 24 contacts at most, each rounded to half a quantum.
        ASSERT_LT((onGrains + onWalls).norm(),
                  1e-12 * (1e-3 + onGrains.norm()) + 12 * support::quantumOf(scene, 1e-3));
        most = std::max(most, scene.touching());
    }
    EXPECT_GE(most, 6);
    EXPECT_LE(most, 24);  // floor and side of each
}

TEST(SeamRun, theLedgerClosesAsOnAPlane) {
    const auto ledgerOf = [](double crack, bool isPlane) {
        CrackedFloor<Dry> scene(material<Dry>(), crack, isPlane);
        scene.keepEnergyLedger();
        scene.initialise();
        const EnergyLedger& ledger = scene.energyLedger();
        const double start = ledger.closed();
        scene.steps(5000);
        double all = 0;
        for (const auto& entry : EnergyLedger::entries()) all += std::abs(ledger.*entry.member);
        EXPECT_LT(std::abs(ledger.closed() - start), 5 * std::sqrt(5000) * 0x1p-53 * all);
        return ledger;
    };
    const EnergyLedger onPlane = ledgerOf(0, true);
    EXPECT_GT(onPlane.sliding, 0);
    // A spring that was lost at a crack would be found in the error of the step. Strips lie lower by the
    // crack, which is 1e-3 of the overlap at rest.
    const EnergyLedger onCracks = ledgerOf(1e-10, false);
    EXPECT_NEAR(onCracks.stepError, onPlane.stepError, 0.01 * std::abs(onPlane.stepError));
    EXPECT_NEAR(onCracks.sliding, onPlane.sliding, 0.01 * onPlane.sliding);
    ledgerOf(1e-7, false);
}

TEST(HeavySeamRun, hasTheSameBitsForAnyThreadsAndThroughRestarts) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    const auto check = [&](const auto& species) {
        using S = std::remove_cvref_t<decltype(species)>;
        CrackedFloor<S> whole(species);
        whole.initialise();
        whole.steps(1503);
        whole.writeRestart(file);
        whole.steps(1500);
        for (const int threads : {1, 3}) {
            CrackedFloor<S> resumed(species);
            resumed.setNumberOfThreads(threads);
            resumed.restartFrom(file);
            resumed.initialise();
            resumed.steps(1500);
            EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
            CrackedFloor<S> again(species);
            again.setNumberOfThreads(threads);
            again.initialise();
            again.steps(3003);
            EXPECT_EQ(stateHash(again.particleHandler.store()), stateHash(whole.particleHandler.store()));
        }
    };
    check(material<Dry>());
    check(wet());
}

/// Where a belt lies beside a floor, the nearer one drives a grain; where they lie in one plane, the one with
/// the lower number.
TEST(SeamRun, ofWallsThatMoveTheNearestCounts) {
    for (const double x : {-1e-5, 1e-5, 5e-3})
        for (const bool beltFirst : {false, true}) {
            WallScene<Dry> scene({{.radius = radius, .position = {x, 0, radius - 2e-7}}}, material<Dry>(),
                                 {0, 0, -9.81});
            scene.setQuiet();
            const TriangleWall rest =
                mesh(parallelogram(at(-0.02, -0.02, 0), at(0.02, 0, 0), at(0, 0.04, 0)));
            TriangleWall belt = mesh(parallelogram(at(0, -0.02, 0), at(0.02, 0, 0), at(0, 0.04, 0)));
            belt.setSurfaceVelocity({0, 0.1, 0});
            if (beltFirst) scene.add(belt);
            scene.add(rest);
            if (!beltFirst) scene.add(belt);
            scene.initialise();
            scene.steps(3);
            EXPECT_EQ(scene.touching(), 1);
            EXPECT_EQ(scene.motion(0).velocity.y() > 0, x > 0) << x;
        }
}

/// Two materials side by side: the nearest one's law, once.
TEST(SeamRun, ofTwoMaterialsTheNearestCounts) {
    for (const double x : {-3e-5, 3e-5}) {
        WallScene<Smooth> scene({{.radius = radius, .position = {x, 0, radius - overlap}}},
                                material<Smooth>(), Vec3D::Zero(), 1e-15);
        scene.setQuiet();
        Smooth soft = material<Smooth>();
        soft.setElasticModulusAndPoissonRatio(0.1 * youngModulus, poissonRatio);
        const Smooth* other = scene.speciesHandler.copyAndAddObject(soft);
        scene.add(mesh(parallelogram(at(-0.02, -0.02, 0), at(0.02, 0, 0), at(0, 0.04, 0))));
        TriangleWall right = mesh(parallelogram(at(1e-9, -0.02, 0), at(0.02, 0, 0), at(0, 0.04, 0)));
        right.setSpecies(other);
        scene.wallHandler.copyAndAddObject(right);
        scene.initialise();
        scene.steps(1);
        EXPECT_EQ(scene.touching(), 1);
        const double force = scene.particleHandler.getObject(0).getForce().z();
        EXPECT_NEAR(force / hertz(), x < 0 ? 1 : 2 / 11.0, 1e-9);  // 1/E* is the mean of both
    }
}

}  // namespace
}  // namespace pendular::seamRunTest
