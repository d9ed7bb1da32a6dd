// Programs of MercuryDPM's with boundaries that act by themselves in each step, and with its files of text.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "Kernel/MercuryScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryActingBoundariesTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

// Three grains at rest, which a plane passes that moves; and one that goes through it the other way.
TEST(MercuryPrograms, fluxBoundaryPrescribedDistance) {
    for (const bool goesOn : {false, true}) {
        const TestFolder folder;
        const auto make = [&](double end) {
            auto problem = std::make_unique<Mercury3D>();
            auto species = problem->speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
            species->setDensity(1.0);
            species->setStiffness(0.1);
            SphericalParticle p0(species);
            p0.setRadius(0.1);
            for (const auto& [x, y] : {std::pair(-0.1, 0.0), std::pair(-0.1, 0.3), std::pair(-0.05, -0.3)}) {
                p0.setPosition({x, y, 0});
                problem->particleHandler.copyAndAddObject(p0);
            }
            p0.setPosition({0.1, 0.8, 0}), p0.setVelocity({-0.5, 0, 0});
            problem->particleHandler.copyAndAddObject(p0);
            FluxBoundary* const flux = problem->boundaryHandler.copyAndAddObject(FluxBoundary());
            flux->set(Vec3D(1, 0, 0), 0.0);
            flux->setPrescribedDistance([](double time) { return -time * 0.2; });
            problem->setTimeMax(end);
            problem->setTimeStep(0.01);
            problem->setQuiet();
            return problem;
        };
        auto problem = make(1);
        if (goesOn) {
            auto first = make(0.4);
            first->solve();
            first->writeRestart(folder.path() / "flux.h5");
            problem->restartFrom(folder.path() / "flux.h5");
        }
        problem->solve();
        auto* const flux = static_cast<FluxBoundary*>(problem->boundaryHandler.getObject(0));
        EXPECT_EQ(flux->getNumberOfParticlesCrossedForw(), 3u);
        EXPECT_EQ(flux->getNumberOfParticlesCrossedBack(), 1u);  // 0.1 - 0.5 t = -0.2 t
        EXPECT_EQ(flux->getNumberOfParticlesCrossedNet(), 2);
        EXPECT_NEAR(flux->getMassOfParticlesCrossedNet(), 2 * sphereMass(0.1, 1), 1e-15);
        EXPECT_TRUE(isOneSentence(refusal([&] { flux->setPrescribedDistance([](double) { return 0.0; }); })));
    }
}

// Droplets that the driver makes fall on a grain, which has their volume then, or beside it on the floor.
TEST(MercuryPrograms, dropletBoundary) {
    MercuryScene<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> dpm;
    auto species =
        dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies());
    species->setDensity(2000), species->setStiffness(300), species->setDissipation(2e-3);
    species->setLiquidBridgeVolumeMax(1e-8), species->setDistributionCoefficient(0);
    species->setContactAngle(0.3), species->setSurfaceTension(0.07);
    SphericalParticle grain(species);
    grain.setRadius(0.01);
    grain.setPosition({0, 0, 0.1});
    grain.fixParticle();
    const GrainReference caught = dpm.particleHandler.copyAndAddObject(grain);
    dpm.wallHandler.copyAndAddObject(InfiniteWall(Vec3D(0, 0, -1), Vec3D(0, 0, 0), species));
    dpm.setGravity({0, 0, -9.8});
    DropletBoundary d;
    const double radius = 1e-3;
    int made = 0;
    d.setGenerateDroplets([&](DropletBoundary& of) {
        for (; made < 10 && dpm.getTime() >= 0.01 * made; ++made)
            of.droplets_.emplace_back(DropletBoundary::Droplet{Vec3D(made % 2 == 0 ? 0.002 : 0.05, 0, 0.2),
                                                               Vec3D(0, 0, 0), radius});
    });
    DropletBoundary* const added = dpm.boundaryHandler.copyAndAddObject(d);
    dpm.setTimeStep(5e-5);
    dpm.setQuiet();
    // The first one meets the grain when it has fallen to sqrt(0.011^2 - 0.002^2) above its centre.
    const double fall = std::sqrt(2 * (0.1 - std::sqrt(0.011 * 0.011 - 0.002 * 0.002)) / 9.8);
    dpm.runTo(fall - 1e-4);
    EXPECT_EQ(added->getVolumeCaught(), 0);
    dpm.runTo(fall + 1e-4);
    EXPECT_EQ(added->getVolumeCaught(), sphereMass(radius, 1));
    dpm.runTo(0.4);
    EXPECT_TRUE(added->droplets_.empty());
    EXPECT_NEAR(added->getVolumeCaught(), 5 * sphereMass(radius, 1), 1e-20);
    EXPECT_NEAR(added->getVolumeLost(), 5 * sphereMass(radius, 1), 1e-20);
    // Films are counted in quanta.
    EXPECT_NEAR(caught.getLiquidVolume(), 5 * sphereMass(radius, 1), 1e-6 * sphereMass(radius, 1));
    dpm.finishRun();
}

// A scene by a restart file and a data file of text: a grain falls, and meets the floor.
TEST(MercuryPrograms, loadingDataRestart) {
    const TestFolder folder;
    const std::string restart = folder.name() + ".ini.restart", data = folder.name() + ".ini.data";
    const std::string head =
        "restart_version 1.0 name Fall\n"
        "dataFile name Fall.data fileType ONE_FILE saveCount 10 counter 0 nextSavedTimeStep 0\n"
        "xMin 0 xMax 2 yMin 0 yMax 3 zMin 0 zMax 4\n"
        "timeStep 1e-03 time 0 ntimeSteps 0 timeMax 1.5\n"
        "systemDimensions 3 particleDimensions 3 gravity 0 0 -1\n"
        "Species 1\n";
    const std::string
        species = "LinearViscoelasticSpecies id 0 rho 1.9098593 stiffness 2000 disp 10\n",
        wall =
            "Walls 1\nInfiniteWall id 0 indSpecies 0 position 0 0 0 orientation 0 0 0 1 velocity 0 0 0 "
            "normal 0 0 -1 factor 1\n",
        rest = "Boundaries 0\nParticles 0\nInteractions 0\n";
    helpers::writeToFile(restart, head + species + wall + rest);
    helpers::writeToFile(data, "1 0 0 0 0 2 2 2\n1 1 1.5  0 0 0  0.5  0 0 0  0 0 0  0\n");
    DPMBase fall;
    fall.setQuiet();
    fall.readRestartFile(restart);
    EXPECT_EQ(fall.getMax(), Vec3D(2, 3, 4));
    EXPECT_EQ(fall.getName(), "Fall");
    EXPECT_EQ(fall.getTimeMax(), 1.5);
    fall.setName(folder.name());
    fall.setFileType(FileType::NO_FILE);
    fall.readDataFile(data);
    EXPECT_EQ(fall.getMax(), Vec3D(2, 2, 2));
    fall.solve();
    // It falls by 1 m, and goes up again with what the dashpot leaves: MercuryDPM's steps, written anew.
    const double m = 1.9098593 * sphereMass(0.5, 1), h = 1e-3;
    double z = 1.5, v = 0;  // m, m/s
    const auto acceleration = [&] { return -1 + (z < 0.5 ? (2000 * (0.5 - z) - 10 * v) / m : 0.0); };
    double a = acceleration();
    for (std::size_t step = 0; step < fall.getNumberOfTimeSteps(); ++step) {
        v += 0.5 * h * a;
        z += h * v;
        a = acceleration();
        v += 0.5 * h * a;
    }
    EXPECT_GT(v, 0.8);
    // To the round-off of its steps, which one touch has grown.
    EXPECT_NEAR(fall.particleHandler.getObject(0)->getPosition().z(), z, 1e-12);
    EXPECT_NEAR(fall.particleHandler.getObject(0)->getVelocity().z(), v, 1e-11);

    helpers::writeToFile(restart, head + species + wall +
                                      "Boundaries 0\nParticles 1\n"
                                      "SphericalParticle id 0 indSpecies 0 position 1 1 2 "
                                      "velocity 0 0 1 angularVelocity 0 0 0 radius 0.5\n");
    DPMBase one;
    one.readRestartFile(restart);
    EXPECT_EQ(one.particleHandler.getObject(0)->getPosition(), Vec3D(1, 1, 2));
    EXPECT_EQ(one.particleHandler.getObject(0)->getVelocity(), Vec3D(0, 0, 1));
    const auto said = [&](const std::string& text) {
        helpers::writeToFile(restart, text);
        return refusal([&] { DPMBase().readRestartFile(restart); });
    };
    for (const std::string& bad : {said(head + "LinearViscoelasticSpecies id 0 hardness 3\n"), said(head),
                                   said(head + species + "Walls 1\nCoil id 0\n"),
                                   said(head + species + "Boundaries 1\nPeriodicBoundary\n"),
                                   said(head + species + "Particles 1\nBP 0 0 0\n")})
        EXPECT_TRUE(isOneSentence(bad)) << bad;
    helpers::writeToFile(restart, head + species + wall + rest);
    const std::string typed =
        refusal([&] { MercuryScene<LinearViscoelasticSpecies>().readRestartFile(restart); });
    EXPECT_TRUE(isOneSentence(typed) && contains(typed, "Mercury3D")) << typed;
}

}  // namespace
}  // namespace pendular::mercuryActingBoundariesTest
