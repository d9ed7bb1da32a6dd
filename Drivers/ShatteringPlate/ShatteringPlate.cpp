/// A plate of grains that are bonded by beams, held at its rim: a ball hits it, and it shatters.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "Drivers/Shared/CommandLine.h"
#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

namespace {

constexpr double radius = 1e-3, ballRadius = 5e-3, youngModulus = 1e8, shearModulus = 4e7;  // m, Pa

struct ShatteringPlate : Simulation<LinearViscoelasticSlidingFrictionSpecies> {
    double plateRadius = 0.03, speed = 4, strength = 1e5, endTime = 4e-3;  // m, m/s, Pa, s

    void setupInitialConditions() override {
        auto* const plaster = addSpecies(1500);
        auto* const steel = addSpecies(7800);
        const std::size_t grains = addPlate(plaster);
        SphericalParticle ball;
        ball.setSpecies(steel), ball.setRadius(ballRadius);
        ball.setPosition({0, 0, 1.001 * (ballRadius + radius)}), ball.setVelocity({0, 0, -speed});
        particleHandler.copyAndAddObject(ball);
        join(grains);
        setTimeStep(1e-6), setTimeMax(endTime);
        keepEnergyLedger();
    }

    /// The numbers of grains in each part that is still joined, the largest first.
    [[nodiscard]] std::vector<std::size_t> fragments() const {
        std::vector<std::uint32_t> first(particleHandler.getSize());
        std::iota(first.begin(), first.end(), 0u);
        const auto rootOf = [&](std::uint32_t k) {
            while (first[k] != k) k = first[k] = first[first[k]];
            return k;
        };
        for (const BondPart::Bond& bond : bonds.all()) first[rootOf(bond.first)] = rootOf(bond.second);
        std::vector<std::size_t> sizes(first.size());
        for (std::uint32_t k = 0; k + 1 < first.size(); ++k) ++sizes[rootOf(k)];  // the ball is the last
        std::erase(sizes, std::size_t{0});
        std::ranges::sort(sizes, std::greater());
        return sizes;
    }

    BondPart& bonds = addPart<BondPart>();

private:
    LinearViscoelasticSlidingFrictionSpecies* addSpecies(double density) {
        LinearViscoelasticSlidingFrictionSpecies species;
        species.setDensity(density);
        species.setStiffness(2e4), species.setDissipation(0.05);  // N/m, kg/s
        species.setSlidingStiffness(6e3), species.setSlidingFrictionCoefficient(0.5);
        return speciesHandler.copyAndAddObject(species);
    }
    /// A layer of touching grains, each with six neighbours; those at the rim are held.
    std::size_t addPlate(const LinearViscoelasticSlidingFrictionSpecies* species) {
        const int rows = static_cast<int>(plateRadius / radius);
        for (int j = -rows; j <= rows; ++j)
            for (int i = -rows; i <= rows; ++i) {
                SphericalParticle grain;
                grain.setSpecies(species), grain.setRadius(radius);
                grain.setPosition(radius * Vec3D(2 * i + j % 2, std::sqrt(3.0) * j, 0));
                const double away = grain.getPosition().norm();
                if (away > plateRadius) continue;
                if (away > plateRadius - 2 * radius) grain.fixParticle();
                particleHandler.copyAndAddObject(grain);
            }
        return particleHandler.getSize();
    }
    void join(std::size_t grains) {
        const auto beam =
            bonds.addMaterial({.radius = 0.5 * radius,
                               .stiffness =
                                   [](const BondSection& section, double length) {
                                       return beamBond(youngModulus, shearModulus, 0.9, section, length);
                                   },
                               .strength = {.tensile = strength, .shear = strength},
                               .damping = 0.02});
        for (std::uint32_t a = 0; a < grains; ++a)
            for (std::uint32_t b = a + 1; b < grains; ++b) {
                const Vec3D between =
                    particleHandler.getObject(b).getPosition() - particleHandler.getObject(a).getPosition();
                if (between.norm() < 2.1 * radius) bonds.join(a, b, beam);
            }
    }
};

void print(const ShatteringPlate& scene) {
    const auto sizes = scene.fragments();
    const EnergyLedger& energy = scene.energyLedger();
    const std::size_t whole = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    fmt::print("bonds: {} of {} have broken\n", scene.bonds.broken(),
               scene.bonds.broken() + scene.bonds.all().size());
    fmt::print("fragments: {}, the largest with {} of {} grains\n", sizes.size(), sizes.front(), whole);
    fmt::print("energy: {:.3g} J went into fracture; {:.1g} J are unaccounted for\n", energy.fracture,
               scene.energyUnaccountedFor());
}

}  // namespace

int main(int argc, char** argv) {
    ShatteringPlate scene;
    RunOptions options{.output = "ShatteringPlate-output"};
    const DriverProgram driver{
        .name = "ShatteringPlate",
        .description = "A ball shatters a plate of bonded grains.",
        .options = options,
        .files = "what the run writes",
        .numbers = {{"plate-radius", "m", &scene.plateRadius, {0.004, 0.1}, "of the plate"},
                    {"speed", "m-per-s", &scene.speed, {0, 100}, "of the ball"},
                    {"strength",
                     "Pa",
                     &scene.strength,
                     {0, infinity, false, false},
                     "of bonds, in tension and in shear"},
                    {"end-time", "s", &scene.endTime, {0, 10}, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        options.apply(scene);
        scene.solve();
        if (!options.quiet) print(scene);
    });
}
