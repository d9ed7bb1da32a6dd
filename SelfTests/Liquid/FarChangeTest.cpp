// What a run changes far away does nothing to wet grains that dry, not by one bit, and neither does a
// restart.
#include <gtest/gtest.h>

#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/AnyMaterial.h"

namespace pendular::farChangeTest {
namespace {

using scenes::HookedGrains;
using support::TestFolder;

constexpr double r = 1e-3;       // m
constexpr double step = 4e-7;    // s
constexpr int end = 600;         // steps
const Vec3D far{0.5, 0.5, 0.5};  // m

/// Three wet grains that part, turn and dry, on a floor; two dry ones are far away. A bridge loses some
/// hundred-thousandths of its volume in a step, so that it is nearly always prepared for another one than it
/// has.
template <class S>
class Drying : public HookedGrains<S> {
public:
    Drying() : HookedGrains<S>(support::anyMaterial<S>(), {}, step, {{{0, 0, -1}, {0, 0, 0}}}) {
        S unused = support::anyMaterial<S>();
        unused.setDensity(3000);
        this->speciesHandler.copyAndAddObject(unused);
        for (int k = 0; k < 3; ++k) {
            SphericalParticle grain =
                this->grain(r, {2 * r * (1 - 1e-5) * k, 0, (1 - 1e-5) * r}, {0.03 * k, 0.01 * (k - 1), 0.01});
            grain.setAngularVelocity({5, -3.0 * k, 8});
            grain.setLiquidVolume(1e-12);
            this->particleHandler.copyAndAddObject(grain);
        }
        for (const double x : {0.0, 3 * r})
            this->particleHandler.copyAndAddObject(this->grain(r, far + Vec3D(x, 0, 0)));
        Evaporation law;
        law.setFlux(2e-3);
        law.setInterval(1);
        this->setEvaporation(law);
        this->setQuiet();
        this->setTimeMax(1);
    }
    void runTo(int last) {
        while (this->getNumberOfTimeSteps() < static_cast<std::size_t>(last)) this->step();
    }
    /// The numbers of all three grains.
    [[nodiscard]] std::vector<double> allNumbers() {
        std::vector<double> all;
        for (std::size_t k = 0; k < 3; ++k) {
            const scenes::GrainMotion now = this->motion(k);
            for (const Vec3D& vector : {now.position, now.velocity, now.spin})
                all.insert(all.end(), vector.begin(), vector.end());
            all.push_back(this->particleHandler.getObject(k).getLiquidVolume());
        }
        return all;
    }
};

template <class S>
struct FarChange {
    const char* name;
    std::function<void(Drying<S>&)> make;
};

template <class S>
std::vector<FarChange<S>> farChanges() {
    using Scene = Drying<S>;
    const auto other = [](Scene& s) { return s.particleHandler.getObject(3); };
    return {{"a grain comes",
             [](Scene& s) { s.particleHandler.copyAndAddObject(s.grain(r, far + Vec3D(0, 5 * r, 0))); }},
            {"a grain comes that touches another",
             [](Scene& s) { s.particleHandler.copyAndAddObject(s.grain(r, far + Vec3D(0, 1.9999 * r, 0))); }},
            {"a small wet grain comes",
             [](Scene& s) {
                 SphericalParticle grain = s.grain(0.6 * r, far + Vec3D(0, -5 * r, 0));
                 grain.setLiquidVolume(1e-13);
                 s.particleHandler.copyAndAddObject(grain);
             }},
            {"a grain goes", [](Scene& s) { s.particleHandler.removeObject(4); }},
            {"a grain is put elsewhere", [=](Scene& s) { other(s).setPosition(far + Vec3D(0, 0, 9 * r)); }},
            {"a radius", [=](Scene& s) { other(s).setRadius(0.9 * r); }},
            {"a species", [=](Scene& s) { other(s).setSpecies(s.speciesHandler.getObject(1)); }},
            {"a grain is held", [=](Scene& s) { other(s).fixParticle(); }},
            {"a film", [=](Scene& s) { other(s).setLiquidVolume(1e-13); }},
            {"a density", [](Scene& s) { s.speciesHandler.getObject(1)->setDensity(2000); }},
            {"a wall comes", [](Scene& s) {
                 InfiniteWall wall;
                 wall.setSpecies(s.speciesHandler.getObject(0));
                 wall.set({0, 1, 0}, far + Vec3D(0, 20 * r, 0));
                 s.wallHandler.copyAndAddObject(wall);
             }}};
}

template <class S>
class FarFromDryingGrains : public testing::Test {};
using Laws = testing::Types<Species<HertzianViscoelastic, Mindlin, LiquidMigrationWillett>,
                            Species<HertzianViscoelastic, Mindlin, LiquidMigrationLS>,
                            Species<HertzianViscoelastic, Mindlin, ViscousLiquidMigrationLS>>;
TYPED_TEST_SUITE(FarFromDryingGrains, Laws);

TYPED_TEST(FarFromDryingGrains, aChangeDoesNothing) {
    Drying<TypeParam> alone;
    alone.run(end);
    const std::vector<double> expected = alone.allNumbers();
    EXPECT_EQ(alone.interactions().size(), 5u);  // two bridges, and those to the floor
    EXPECT_LT(alone.liquidLedger().bridges, 0.99 * 3e-12);
    for (const FarChange<TypeParam>& change : farChanges<TypeParam>())
        // In the step in which bridges form, in the next one, and when they have dried for a while.
        for (const int when : {1, 2, 137, 400}) {
            Drying<TypeParam> scene;
            scene.run(when);
            change.make(scene);
            scene.runTo(end);
            EXPECT_EQ(scene.allNumbers(), expected) << change.name << " at step " << when;
        }
}

TYPED_TEST(FarFromDryingGrains, grainsThatComeDoNothingOverARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    // The first one makes a list, and the next ones need none; but the first after a restart does.
    const auto bring = [](auto& s) {
        const auto number = static_cast<double>(s.getNumberOfTimeSteps());
        if (s.getNumberOfTimeSteps() % 90 == 37)
            s.particleHandler.copyAndAddObject(s.grain(r, far + Vec3D(0, 0.05 * number * r, 8 * r)));
    };
    Drying<TypeParam> alone, whole;
    alone.run(end);
    whole.hook = bring;
    whole.run(0);
    for (const int middle : {38, 100, 300}) {
        whole.runTo(middle);
        whole.writeRestart(file);
        Drying<TypeParam> again;
        again.restartFrom(file);
        again.hook = bring;
        again.initialise();
        again.runTo(end);
        EXPECT_EQ(again.allNumbers(), alone.allNumbers()) << "restart at step " << middle;
    }
    whole.runTo(end);
    EXPECT_EQ(whole.allNumbers(), alone.allNumbers());
}

}  // namespace
}  // namespace pendular::farChangeTest
