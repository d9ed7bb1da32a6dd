#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::goldenHashTest {
namespace {

using scenes::SettlingBox;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Smooth = Species<LinearViscoelastic>;

constexpr int layers = 20;  // 320 grains

template <class S>
struct Settled {
    explicit Settled(int steps = 2000) : scene(layers) {
        scene.initialise();
        for (int k = 0; k < steps; ++k) scene.step();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(scene.particleHandler.store()); }

    SettlingBox<S> scene;
};

TEST(StateHash, isFnv1a) {
    // The hash of no bytes, and of 24, 48 and 72 zero bytes: offset x prime^n mod 2^64, as each byte is xored
    // with 0.
    ParticleStore smooth;
    EXPECT_EQ(stateHash(smooth), 0xcbf29ce484222325u);
    const auto timesPrime = [](std::uint64_t hash, int count) {
        for (int k = 0; k < count; ++k) hash *= 1099511628211u;
        return hash;
    };
    smooth.add({{0, 0, 0}, 1, {0, 0, 0}, 1}, {0, 0, 0}, 0);
    EXPECT_EQ(stateHash(smooth), timesPrime(0xcbf29ce484222325u, 48));
    ParticleStore rough;
    rough.hasSpin = true;
    rough.add({{0, 0, 0}, 1, {0, 0, 0}, 1}, {0, 0, 0}, 0);
    EXPECT_EQ(stateHash(rough), timesPrime(0xcbf29ce484222325u, 72));
    // 1.0 has the bytes 00 00 00 00 00 00 f0 3f, the lowest first.
    rough.translation[0].position.x = 1;
    const std::uint64_t six = timesPrime(0xcbf29ce484222325u, 6);
    EXPECT_EQ(stateHash(rough), timesPrime((timesPrime(six ^ 0xf0, 1) ^ 0x3f), 65));
}

TEST(StateHash, seesEveryBitAndNoPlace) {
    ParticleStore grains;
    grains.hasSpin = true;
    grains.add({{1, 2, 3}, 1, {4, 5, 6}, 1}, {7, 8, 9}, 0);
    grains.add({{3, 2, 1}, 1, {6, 5, 4}, 1}, {9, 8, 7}, 0);
    const std::uint64_t hash = stateHash(grains);
    grains.reorder({1, 0});
    EXPECT_EQ(stateHash(grains), hash);
    for (double* number :
         {&grains.translation[0].position.z, &grains.translation[1].velocity.x, &grains.rotation[1].spin.y}) {
        const double before = *number;
        *number = std::nextafter(before, 100);
        EXPECT_NE(stateHash(grains), hash);
        *number = before;
    }
    EXPECT_EQ(stateHash(grains), hash);
}

TEST(GoldenHash, sceneDoesWhatItIsMeantFor) {
    Settled<Wet> settled;
    auto& scene = settled.scene;
    int touching = 0, bridged = 0, atWalls = 0;
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = scene.contacts().observe(scene.particleHandler.store(), bucket, contact);
        touching += seen.separation < 0 ? 1 : 0;
        bridged += seen.bridged && seen.separation > 0 ? 1 : 0;
        atWalls += seen.separation < 0 && seen.wall >= 0 ? 1 : 0;
    });
    EXPECT_GT(touching, 200);
    EXPECT_GT(bridged, 50);
    EXPECT_GT(atWalls, 20);
    EXPECT_GT(scene.contacts().rebuildCount(), 20u);
    for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k) {
        const Vec3D p = scene.particleHandler.getObject(k).getPosition();
        const double width = SettlingBox<Wet>::width;
        EXPECT_TRUE(p.x() > 0 && p.x() < width && p.y() > 0 && p.y() < width && p.z() > 0) << "grain " << k;
    }
}

// Stored values, the same for every compiler, instruction set and number of threads; what they stand for is
// checked elsewhere. They change with the physics or the order of operations, and with nothing else.
TEST(GoldenHash, wetRoughGrainsSettleToTheSameBits) {
    EXPECT_EQ(Settled<Wet>().hash(), 2751357949463015764u);
}
TEST(GoldenHash, drySmoothGrainsSettleToTheSameBits) {
    EXPECT_EQ(Settled<Smooth>().hash(), 10433154835162440564u);
}

TEST(GoldenHash, doesNotDependOnTheThreads) {
    // Few steps with several threads: on a busy machine they spend their time waiting for each other.
    const auto settledWith = [](int threads) {
        Settled<Wet> settled(1000);
        settled.scene.setNumberOfThreads(threads);
        for (int k = 0; k < 20; ++k) settled.scene.step();
        return settled.hash();
    };
    const std::uint64_t one = settledWith(1);
    for (int threads : {2, 3, 8}) EXPECT_EQ(settledWith(threads), one) << threads;
}

}  // namespace
}  // namespace pendular::goldenHashTest
