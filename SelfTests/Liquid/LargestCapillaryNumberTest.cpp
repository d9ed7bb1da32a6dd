#include <gtest/gtest.h>

#include <fmt/format.h>

#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Features/LiquidBridges/Adhesion/WetWall.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Bridges that are drawn faster than their law's range is made for are counted, and the summary says so.

namespace pendular::largestCapillaryNumberTest {
namespace {

using support::contains;

constexpr double r = 1e-3, um = 1e-6;              // m
constexpr double viscosity = 0.1, tension = 0.05;  // Pa s, N/m
constexpr double speed = 0.2;                      // m/s: Ca = eta v / gamma = 0.4

template <class Law>
Species<LinearViscoelastic, NoFriction, Law> material(double bound) {
    Species<LinearViscoelastic, NoFriction, Law> s;
    s.setDensity(2500);
    s.setStiffness(1e-9);
    s.setDissipation(0);
    s.setContactAngle(0.1);
    s.setSurfaceTension(tension);
    s.setViscosity(viscosity);
    s.setRoughness(1 * um);
    s.setLargestCapillaryNumber(bound);
    if constexpr (requires { s.setLiquidBridgeVolume(1.0); }) s.setLiquidBridgeVolume(1e-12);
    if constexpr (requires { s.setDynamicRupture(true); }) s.setDynamicRupture(true);
    if constexpr (requires { s.setFilmThickness(1.0); }) s.setFilmThickness(5 * um);
    if constexpr (requires { s.setLiquidLayerThickness(1.0); }) {
        s.setLiquidLayerThickness(20 * um);
        s.setHalfFillingAngle(0.6);
        s.setLiquidDensity(1000);
    }
    return s;
}

/// Grains so heavy that nothing changes their speed are drawn from a plane; the gaps at which bridges are
/// long enough to be ones are counted.
template <class Law>
class Drawn : public scenes::HookedGrains<Species<LinearViscoelastic, NoFriction, Law>> {
public:
    Drawn(double bound, double away, double thickness, int grains = 1)
        : scenes::HookedGrains<Species<LinearViscoelastic, NoFriction, Law>>(
              heavy(bound), inARow(away, grains), 1e-6, {{{1, 0, 0}, Vec3D::Zero()}}),
          layer(thickness) {
        this->setQuiet();
        this->acceptUnstableTimeStep();
        this->setTimeMax(1.5e-3);
        if constexpr (Law::formsAtContact) this->joinAtStart(10 * um);
    }
    /// Runs steps, and looks also after the step of no length at the start.
    void run(int count) {
        this->initialise();
        look();
        for (int k = 0; k < count; ++k) {
            this->step();
            look();
        }
    }
    std::uint64_t expected = 0;

private:
    void look() {
        for (const ObservedContact& seen : this->interactions())
            expected += seen.bridged && seen.separation > layer ? 1 : 0;
    }
    double layer;  // m

    static auto heavy(double bound) {
        auto s = material<Law>(bound);
        s.setDensity(2500e12);
        return s;
    }
    static std::vector<scenes::GrainMotion> inARow(double away, int count) {
        std::vector<scenes::GrainMotion> all;
        for (int k = 0; k < count; ++k)
            all.push_back({.radius = r, .position = {-r - 2 * um, 3 * r * k, 0}, .velocity = {-away, 0, 0}});
        return all;
    }
};

template <class Law>
void expectCounted(double thickness) {
    const double number = viscosity * speed / tension;
    Drawn<Law> below(1.01 * number, speed, thickness);
    below.run(1500);
    EXPECT_GT(below.expected, 100u);
    EXPECT_EQ(below.contacts().capillaryNumbers().countAbove(), 0u);
    for (const int threads : {1, 3}) {
        Drawn<Law> above(0.5 * number, speed, thickness, 20);
        above.setNumberOfThreads(threads);
        above.run(1500);
        EXPECT_GT(above.expected, 1000u);
        EXPECT_EQ(above.contacts().capillaryNumbers().countAbove(), above.expected);
        // The liquid changes the speed of grains of 1e7 kg by less than 1e-9 of it: 1 N in 1.5 ms.
        EXPECT_NEAR(above.contacts().capillaryNumbers().largestNumber() / number, 1, 1e-9);
    }
    Drawn<Law> approaching(0.5 * number, -speed, thickness);
    approaching.run(5);
    EXPECT_EQ(approaching.contacts().capillaryNumbers().countAbove(), 0u);
}

TEST(LargestCapillaryNumber, isCountedWhereBridgesAreDrawnFaster) {
    expectCounted<ViscousLiquidBridgeWillett>(0);
    expectCounted<LiquidFilmsWillett>(10 * um);
    expectCounted<WetWall>(20 * um);
}

TEST(LargestCapillaryNumber, isNothingToBridgesThatRuptureAtAFixedDistance) {
    auto law = material<ViscousLiquidBridgeWillett>(0.1);
    law.setDynamicRupture(false);
    EXPECT_EQ(law.Adhesion::prepare({r}).numberAboveBound(law, 1 * um, 100.0), 0);
    law.setDynamicRupture(true);
    EXPECT_EQ(law.Adhesion::prepare({r}).numberAboveBound(law, 1 * um, 100.0), 200);
    EXPECT_EQ(law.Adhesion::prepare({r}).numberAboveBound(law, -1 * um, 100.0), 0);
}

TEST(LargestCapillaryNumber, isInTheSummaryAndGoesOnAfterARestart) {
    using Scene = Drawn<ViscousLiquidBridgeWillett>;
    const support::TestFolder folder;
    const auto textOf = [&] { return support::contentOf(folder.name() + "-summary.csv"); };
    const double number = viscosity * speed / tension;
    Scene scene(0.5 * number, speed, 0);
    scene.addOutput(RunSummary());
    scene.setName(folder.name());
    scene.setTimeMax(1e-4);
    scene.solve();
    const std::uint64_t count = scene.contacts().capillaryNumbers().countAbove();
    EXPECT_GT(count, 50u);
    EXPECT_TRUE(
        contains(textOf(), fmt::format("\nevaluations above the largest capillary number,{},", count)));
    EXPECT_TRUE(
        contains(textOf(), fmt::format("warning,bridges were drawn at capillary numbers above the "
                                       "largestCapillaryNumber of their law in {} evaluations and the "
                                       "largest was 0.4;",
                                       count)));
    scene.writeRestart(folder.path() / "middle.h5");
    Scene resumed(0.5 * number, speed, 0), slow(2 * number, speed, 0);
    resumed.addOutput(RunSummary());
    resumed.restartFrom(folder.path() / "middle.h5");
    resumed.initialise();
    EXPECT_EQ(resumed.contacts().capillaryNumbers().countAbove(), count);
    EXPECT_EQ(resumed.contacts().capillaryNumbers().largestNumber(),
              scene.contacts().capillaryNumbers().largestNumber());

    slow.addOutput(RunSummary());
    slow.setName(folder.name());
    slow.setTimeMax(1e-4);
    slow.solve();
    EXPECT_TRUE(contains(textOf(), "\nevaluations above the largest capillary number,0,"));
    EXPECT_FALSE(contains(textOf(), "capillary numbers above"));
}

}  // namespace
}  // namespace pendular::largestCapillaryNumberTest
