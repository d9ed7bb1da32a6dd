#include "Drivers/Shared/CommandLine.h"
#include "Kernel/MercuryNames.h"

namespace {

#define main mainOfFirstDriver [[maybe_unused]]
// [snippet]
struct FirstDriver : Simulation<HertzianViscoelasticMindlinIncrementalSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);                                                 // kg/m^3
        material->setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.5);  // Pa, -
        material->setEffectiveShearModulus(0.6e6);                                  // Pa
        material->setSlidingFrictionCoefficient(0.4);
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(1e-3), grain.setPosition({0.01, 0.01, 0.01});  // m
        grain.setVelocity({0.1, 0, 0});                                // m/s
        particleHandler.copyAndAddObject(grain);
        InfiniteWall floor;
        floor.setSpecies(material);
        floor.set({0, 0, -1}, {0, 0, 0});  // its normal points out, away from the grains
        wallHandler.copyAndAddObject(floor);
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25)), setTimeMax(0.01);  // s
    }
};
int main(int argc, char** argv) {
    return runDriver<FirstDriver>("One grain flies.", "FirstDriver", argc, argv);
}
// [end]
#undef main

}  // namespace
