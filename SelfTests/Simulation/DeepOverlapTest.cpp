#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <optional>

#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Reference/VirtualRanks.h"

// A run ends where two grains overlap too deeply. This is looked at whenever grains can have approached by a
// tenth of the smallest radius, and only where what the forces have seen does not exclude it. The reference
// looks at all pairs.

namespace pendular::deepOverlapTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::contains;
using support::Random;
using support::TestFolder;

/// The same normal law with a largest overlap at which one grain is all within the other: its runs go on.
struct Bottomless : LinearViscoelastic {
    static constexpr double largestOverlapInRun = 2;
};
using Refusing = Species<LinearViscoelastic>;
using Boundless = Species<Bottomless>;

constexpr double r = 1e-3, step = 1e-5;  // m, s

template <class S>
S soft(double stiffness) {
    S species;
    species.setDensity(2000);
    species.setStiffness(stiffness);
    species.setDissipation(1e-4);
    return species;
}

/// A cloud that contracts so fast that some pairs may overlap too deeply.
struct Cloud {
    std::vector<GrainMotion> grains;
    double stiffness;              // N/m
    std::optional<double> period;  // m, along all axes
    /// Changes the grains before a step of this number.
    std::function<void(ParticleHandler&, std::size_t)> change = [](ParticleHandler&, std::size_t) {};
};

Cloud randomCloud(Random& random) {
    // Two grains of mass m that meet at v overlap by v sqrt(m / 2 / k): some r/2 in the mean of the clouds.
    Cloud cloud;
    const double speed = random.uniform(0.1, 2), mass = sphereMass(r, 2000),
                 depth = random.uniform(0.1, 0.7) * r;
    cloud.stiffness = 0.5 * mass * (speed / depth) * (speed / depth);
    const int edge = 3;
    if (random.uniform(0, 1) < 0.5) cloud.period = edge * 2.6 * r;
    for (int k = 0; k < edge * edge * edge; ++k) {
        const Vec3D place(k % edge - 1, k / edge % edge - 1, k / edge / edge - 1);
        const Vec3D towards = -0.3 * speed * place;
        cloud.grains.push_back({.radius = r * random.uniform(0.5, 1),
                                .position = 2.6 * r * place + random.inCube(0.2 * r),
                                .velocity = towards + random.inCube(0.5 * speed)});
    }
    return cloud;
}

template <class S>
class CloudScene : public FewGrains<S> {
public:
    explicit CloudScene(const Cloud& cloud) : FewGrains<S>(soft<S>(cloud.stiffness), cloud.grains, step) {
        this->setQuiet();
        this->acceptUnstableTimeStep();
        this->acceptOverlaps(0.49);
        if (cloud.period)
            for (int axis = 0; axis < 3; ++axis)
                this->setPeriodic(axis, -0.5 * *cloud.period, 0.5 * *cloud.period);
    }
};

/// The number of whole steps after which a run is to end, by the positions of a twin that goes on; none if it
/// does not end within so many.
std::optional<std::size_t> expectedEnd(const Cloud& cloud, std::size_t steps) {
    CloudScene<Boundless> twin(cloud);
    twin.initialise();
    const ParticleStore& grains = twin.particleHandler.store();
    double smallest = infinity, unseen = 0;
    const auto places = [&] {
        std::vector<Vec3D> all;
        for (const std::uint32_t place : grains.place)
            all.push_back(toEigen(grains.translation[place].position));
        return all;
    };
    for (const GrainMotion& grain : cloud.grains) smallest = std::min(smallest, grain.radius);
    const auto nearest = [&](Vec3D apart) {
        if (cloud.period)
            for (double& x : apart) x -= *cloud.period * std::nearbyint(x / *cloud.period);
        return apart;
    };
    for (std::size_t k = 0; k < steps; ++k) {
        cloud.change(twin.particleHandler, k);
        const std::vector<Vec3D> before = places();
        twin.step();
        const std::vector<Vec3D> now = places();
        double farthest = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            farthest = std::max(farthest, nearest(now[i] - before[i]).norm());
        unseen += 2 * farthest;
        if (unseen < 0.1 * smallest) continue;
        unseen = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const double a = grains.translation[grains.place[static_cast<std::uint32_t>(i)]].radius,
                             b = grains.translation[grains.place[static_cast<std::uint32_t>(j)]].radius;
                if (nearest(now[i] - now[j]).norm() < a + b - 0.5 * std::min(a, b)) return k;
            }
    }
    return {};
}

/// The same of a run that refuses.
std::optional<std::size_t> endOf(Scene& scene, const Cloud& cloud, std::size_t steps) {
    while (scene.getNumberOfTimeSteps() < steps) try {
            cloud.change(scene.particleHandler, scene.getNumberOfTimeSteps());
            scene.step();
        } catch (const RunError& stop) {
            EXPECT_TRUE(contains(stop.what(), "% of the smaller radius and more than 50 %"));
            return scene.getNumberOfTimeSteps();
        }
    return {};
}

constexpr std::size_t steps = 400;

TEST(DeepOverlap, isRefusedInTheStepOfBruteForce) {
    Random random(7);
    int ended = 0;
    for (int k = 0; k < 60; ++k) {
        const Cloud cloud = randomCloud(random);
        const std::optional<std::size_t> expected = expectedEnd(cloud, steps);
        CloudScene<Refusing> scene(cloud);
        scene.initialise();
        EXPECT_EQ(endOf(scene, cloud, steps), expected) << k;
        ended += expected ? 1 : 0;
    }
    EXPECT_GT(ended, 15);
    EXPECT_LT(ended, 45);
}

TEST(DeepOverlap, isRefusedInTheSameStepAfterARestart) {
    Random random(8);
    for (int k = 0; k < 12; ++k) {
        const TestFolder folder;
        const Cloud cloud = randomCloud(random);
        const std::optional<std::size_t> expected = expectedEnd(cloud, steps);
        if (!expected || *expected < 2) continue;
        for (const std::size_t before : {*expected, *expected / 2}) {
            CloudScene<Refusing> first(cloud), second(cloud);
            for (Scene* each : {static_cast<Scene*>(&first), static_cast<Scene*>(&second)})
                each->setName(folder.name());
            first.keepRestartFile();
            first.setTimeMax(static_cast<double>(before) * step);
            first.solve();
            second.restartFrom(first.restartFile());
            second.initialise();
            EXPECT_EQ(endOf(second, cloud, steps), expected) << k << ' ' << before;
        }
    }
}

/// What a hook has put so that it overlaps was not seen by the forces.
TEST(DeepOverlap, ofGrainsThatAHookHasMovedIsRefusedInTheStepOfBruteForce) {
    Random random(9);
    int ended = 0;
    for (int k = 0; k < 40; ++k) {
        Cloud cloud;
        cloud.stiffness = 1e-3;
        const double share = random.uniform(0.35, 0.48), speed = random.uniform(1, 30);
        const auto when = static_cast<std::size_t>(random.uniform(1, 60));
        // The third one flies about, so that overlaps are looked at at other steps.
        cloud.grains = {{.radius = r},
                        {.radius = r, .position = {5 * r, 0, 0}},
                        {.radius = r, .position = {0, 10 * r, 0}, .velocity = {0, random.uniform(1, 20), 0}}};
        cloud.change = [=](ParticleHandler& particles, std::size_t number) {
            if (number != when) return;
            GrainReference grain = particles.getObject(1);
            grain.setPosition(particles.getObject(0).getPosition() + Vec3D((2 - share) * r, 0, 0));
            grain.setVelocity({-speed, 0, 0});
        };
        const std::optional<std::size_t> expected = expectedEnd(cloud, 150);
        CloudScene<Refusing> scene(cloud);
        scene.initialise();
        EXPECT_EQ(endOf(scene, cloud, 150), expected) << k;
        ended += expected ? 1 : 0;
    }
    EXPECT_GT(ended, 20);
}

/// A rank knows only the overlaps of its own contacts, and gets those of grains that come from another one.
TEST(DeepOverlap, isRefusedInTheSameStepOnRanks) {
    Random random(10);
    for (int k = 0; k < 8; ++k) {
        Cloud cloud = randomCloud(random);
        cloud.period = {};
        const std::optional<std::size_t> expected = expectedEnd(cloud, steps);
        for (const RankOptions& options : {RankOptions{}, RankOptions{.cutsWander = true}}) {
            std::optional<std::size_t> end;  // of a rank that refuses; the others end where they wait for it
            std::mutex mutex;
            const auto run = [&](Exchange& exchange) {
                CloudScene<Refusing> scene(cloud);
                scene.setRanks(exchange, options);
                scene.initialise();
                if (const auto own = endOf(scene, cloud, steps)) {
                    const std::lock_guard lock(mutex);
                    end = own;
                    throw RunError("refused");
                }
            };
            try {
                VirtualRanks(2).run(run);
            } catch (const RunError&) {
                EXPECT_TRUE(end.has_value());
            }
            EXPECT_EQ(end, expected) << k << ' ' << options.cutsWander;
        }
    }
}

}  // namespace
}  // namespace pendular::deepOverlapTest
