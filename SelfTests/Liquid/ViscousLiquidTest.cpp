#include <gtest/gtest.h>

#include <algorithm>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Features/LiquidTransport/Evaporation.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/TestFolder.h"

// Viscous bridges whose liquid moves: contacts that have none yet, have lost it, or get it again.

namespace pendular::viscousLiquidTest {
namespace {

using Wet = Species<LinearViscoelastic, NoFriction, ViscousLiquidMigrationWillett>;

constexpr double radius = 1e-3;  // m

/// Two grains of 1 mm with films, on the x axis.
class WetPair : public Simulation<Wet> {
public:
    /// @param gap m; @param film m^3 a grain; @param approach m/s
    WetPair(double gap, double film, double approach = 0, double viscosity = 1e-3) {
        Wet s;
        s.setDensity(2500);
        s.setStiffness(1000);
        s.setDissipation(0);
        s.setLiquidBridgeVolumeMax(1e-12);
        s.setContactAngle(0);
        s.setSurfaceTension(1e-9);
        s.setViscosity(viscosity);
        s.setRoughness(1e-6);
        auto* const added = speciesHandler.copyAndAddObject(s);
        for (const int side : {-1, 1}) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(radius);
            grain.setPosition(Vec3D(side * (radius + 0.5 * gap), 0, 0));
            grain.setVelocity(Vec3D(-0.5 * side * approach, 0, 0));
            grain.setLiquidVolume(film);
            particleHandler.copyAndAddObject(grain);
        }
        setLiquidToCome(1e-9);
        setTimeStep(2e-7);
        setTimeMax(0.1);
        acceptUnstableTimeStep();
        setQuiet();
    }
    [[nodiscard]] double openingSpeed() {
        return particleHandler.getObject(1).getVelocity().x() -
               particleHandler.getObject(0).getVelocity().x();
    }
};

/// Runs before() and after() with a restart file in between, and without one.
template <class Before>
void expectSameThroughRestart(double film, Before&& before) {
    const support::TestFolder folder;
    WetPair whole(-1e-6, film), half(-1e-6, film), resumed(-1e-6, film);
    for (WetPair* pair : {&whole, &half}) {
        pair->initialise();
        before(*pair);
    }
    half.writeRestart(folder.path() / "half.h5");
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    whole.step(20);
    resumed.step(20);
    EXPECT_EQ(stateHash(whole.particleHandler.store()), stateHash(resumed.particleHandler.store()));
}

TEST(ViscousLiquid, restartFilesHoldContactsWhoseBridgesHaveNoPast) {
    expectSameThroughRestart(0, [](WetPair& pair) { pair.step(5); });  // a dry touch
    expectSameThroughRestart(1e-13, [](WetPair&) {});                  // no step has been made
    expectSameThroughRestart(1e-13, [](WetPair& pair) { pair.step(5); });
    expectSameThroughRestart(1e-13, [](WetPair& pair) {
        pair.step(5);
        pair.particleHandler.getObject(1).setPosition(Vec3D(radius + 1e-6, 0, 0));
    });
}

// In an elastic collision without capillary force liquid can only take energy away. The bridge dries in the
// contact, and the grains get films again while they part: the new bridge knows nothing of the gap that the
// old one had.
TEST(ViscousLiquid, aBridgeThatFormsAgainHasNoPast) {
    constexpr double approach = 0.01;  // m/s
    WetPair pair(1e-9, 1e-14, approach, 0.1);
    Evaporation drying;
    drying.setFlux(0.5);
    drying.setInterval(1);
    pair.setEvaporation(drying);
    pair.initialise();
    bool wasWet = false, isDry = false, isWetAgain = false;
    double fastest = 0;
    for (int k = 0; k < 3000; ++k) {
        for (const ObservedContact& contact : pair.interactions()) {
            wasWet |= contact.bridgeVolume > 0;
            if (wasWet && contact.bridgeVolume == 0) isDry = true;
            if (isDry && contact.bridgeVolume > 0) isWetAgain = true;
            if (isDry && !isWetAgain && contact.separation > -1e-7 && pair.openingSpeed() > 0)
                for (const int g : {0, 1}) pair.particleHandler.getObject(g).setLiquidVolume(4e-13);
        }
        pair.step();
        fastest = std::max(fastest, std::abs(pair.openingSpeed()));
    }
    EXPECT_TRUE(isWetAgain);
    EXPECT_LE(fastest, approach * (1 + 1e-6));  // the work of capillarity: 1e-15 J of 1e-10 J
}

}  // namespace
}  // namespace pendular::viscousLiquidTest
