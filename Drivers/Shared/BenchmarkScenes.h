#pragma once

#include <array>

#include "Drivers/Shared/SettledGrains.h"
#include "Kernel/Species/LawNames.h"
#include "Kernel/Species/Laws.h"

namespace pendular::scenes {

/// Which scene of the benchmark.
struct BenchmarkChoice {
    std::string scene = "bed";
    std::size_t particles = 0;        // about; 0: the scene's own number
    std::string species;              // empty: the scene's own
    std::filesystem::path positions;  // of the bed; empty: made by the program
    std::filesystem::path states = PENDULAR_STATES_DIR;

    [[nodiscard]] std::size_t particlesOr(std::size_t standard) const {
        return particles > 0 ? particles : standard;
    }
};

inline constexpr double benchmarkStep = 5e-7;  // s

using BenchmarkSpecies = TypeList<HertzianViscoelasticMindlinSpecies, LinearViscoelasticSpecies,
                                  HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies,
                                  HertzianViscoelasticMindlinLiquidBridgeWillettSpecies>;

/// The bed of Dosta et al. (2024) in the box of its peers' scripts; more grains are copies along x.
inline Settled publishedBed(const BenchmarkChoice& choice) {
    const Settled one{{{-0.05, -0.03, -0.090243}, {0.05, 0.03, infinity}}, readGrainFile(choice.positions)};
    return repeated(
        one, std::max<std::size_t>(1, (choice.particlesOr(1) + one.grains.size() / 2) / one.grains.size()));
}

/// A gas that fills a twentieth of a periodic cube, with speeds of about 1 m/s and no gravity.
template <class S>
class Gas : public Simulation<S> {
public:
    explicit Gas(std::size_t grains) {
        BedMaterial material;
        material.restitution = 0.95;
        const S* species = this->speciesHandler.copyAndAddObject(material.species<S>());
        const double radius = 1e-3;
        const auto perSide = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(grains))));
        const double spacing = std::cbrt(4.0 / 3 * std::numbers::pi / 0.05) * radius;
        for (int axis = 0; axis < 3; ++axis)
            this->setPeriodic(axis, 0, spacing * static_cast<double>(perSide));
        std::mt19937_64 random(1);
        const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
        this->particleHandler.reserve(grains);
        for (std::size_t k = 0; k < grains; ++k) {
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setRadius(radius);
            grain.setPosition(spacing * Vec3D(static_cast<double>(k % perSide) + 0.5,
                                              static_cast<double>(k / perSide % perSide) + 0.5,
                                              static_cast<double>(k / perSide / perSide) + 0.5));
            const double x = uniform(), y = uniform();
            grain.setVelocity({x, y, uniform()});
            this->particleHandler.copyAndAddObject(grain);
        }
        this->setTimeStep(benchmarkStep);
    }
};

/// Calls function(scene) with a bed, a gas or a mixture of this species.
template <class S, class Function>
void withSceneOf(const BenchmarkChoice& choice, int threads, Function&& function) {
    if (choice.scene == "gas") {
        Gas<S> gas(choice.particlesOr(25000));
        return function(gas);
    }
    Settled bed;
    if (!choice.positions.empty()) bed = publishedBed(choice);
    else if (choice.scene == "polydisperse")
        bed = settledMixture(choice.particlesOr(200000), 20, choice.states, threads);
    else bed = settledBed(choice.particlesOr(25000), choice.states, threads);
    BoxScene<S> scene(BedMaterial().species<S>(), bed.grains, bed.box, benchmarkStep);
    bed.grains = {};  // gives its memory back
    function(scene);
}

/// Calls function(scene) with the scene chosen, whatever its type.
template <class Function>
void withBenchmarkScene(const BenchmarkChoice& choice, int threads, Function&& function) {
    static const std::vector<std::string_view> known{"bed", "wet-bed", "gas", "polydisperse"};
    if (std::find(known.begin(), known.end(), choice.scene) == known.end())
        unknownName("scene", choice.scene, known);
    const bool isBed = choice.scene == "bed" || choice.scene == "wet-bed";
    if (!choice.positions.empty() && !isBed)
        throw InputError(fmt::format(
            "benchmark-scenes: positions are given for the scene {}; only bed and wet-bed take them.",
            choice.scene));
    const std::string standard = choice.scene == "wet-bed"
                                     ? "HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies"
                                     : "HertzianViscoelasticMindlinSpecies";
    withLawNamed<BenchmarkSpecies>("benchmark species", choice.species.empty() ? standard : choice.species,
                                   [&]<class S>() { withSceneOf<S>(choice, threads, function); });
}

}  // namespace pendular::scenes
