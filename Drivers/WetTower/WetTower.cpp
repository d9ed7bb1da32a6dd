#include "Drivers/Shared/CommandLine.h"
#include "Kernel/MercuryNames.h"
struct WetTower : Simulation<HertzianViscoelasticMindlinIncrementalLiquidBridgeBagheriSpecies> {
    void setupInitialConditions() override {
        auto glass = speciesHandler.copyAndAddObject({});
        glass->setDensity(2500), glass->setElasticModulusAndPoissonRatio(5e6, 0.25);  // kg/m^3, Pa
        glass->setEffectiveShearModulus(computeEffectiveShearModulus(5e6, 0.25));     // Pa
        glass->setRestitutionCoefficient(0.5), glass->setSlidingFrictionCoefficient(0.4);
        glass->setLiquidBridgeVolume(2e-12), glass->setContactAngle(0.3), glass->setSurfaceTension(0.072);
        InfiniteWall floor;
        floor.setSpecies(glass), floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        SphericalParticle grain;
        grain.setSpecies(glass), grain.setRadius(1e-3);  // m
        for (int k = 0; k < 10; ++k) {
            grain.setPosition({1e-4 * (k % 3), 0, 1.2e-3 + 2.2e-3 * k});
            particleHandler.copyAndAddObject(grain);
        }
        setGravity({0, 0, -9.81}), setTimeMax(0.3), setSaveCount(5000);
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));
    }
    void writeOutput() override {
        double top = 0;
        for (GrainReference each : particleHandler) top = std::max(top, each.getPosition().z());
        if (!isQuiet()) fmt::print("{:.3f} s, top at {} m\n", getTime(), top);
    }
};
int main(int argc, char** argv) {
    return runDriver<WetTower>("Ten wet grains fall.", "WetTower", argc, argv);
}
