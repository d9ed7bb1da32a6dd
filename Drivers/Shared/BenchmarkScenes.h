#pragma once

#include <span>
#include <string_view>

#include "BuildFolders.h"
#include "Drivers/Shared/DrumScene.h"
#include "Drivers/Shared/JoinedGrains.h"
#include "Drivers/Shared/PenetrationScene.h"
#include "Drivers/Shared/SettledGrains.h"
#include "Kernel/Features/LiquidBridges/Adhesion/WetWall.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular::scenes {

/// Which scene of the benchmark.
struct BenchmarkChoice {
    std::string scene = "bed";
    std::size_t particles = 0;        // about; 0: the scene's own number
    std::string species;              // empty: the scene's own
    double ratio = 20;                // of the radii of a mixture, large to small
    std::size_t clumps = 1;           // spheres that are joined to each body of a bed; 1: none
    double shear = 0;                 // 1/s, speed along x over height that a bed or a mixture starts with
    std::filesystem::path positions;  // of the grains; empty: made by the program
    std::filesystem::path walls;      // of the drum and the penetration, with their positions
    std::filesystem::path states = folders::benchmarkStates;

    [[nodiscard]] std::size_t particlesOr(std::size_t standard) const {
        return particles > 0 ? particles : standard;
    }
};

inline constexpr double benchmarkStep = 5e-7;                  // s
inline constexpr double clumpModulus = 5e6, clumpStep = 7e-6;  // Pa, s: soft, so that peers settle them soon
inline constexpr double settlingSoftness = 30;  // divides the stiffness while a drum or a bed is filled

/// More grains than the published bed has are copies along x.
inline Settled publishedBed(const BenchmarkChoice& choice) {
    const Settled one = publishedBedOf(choice.positions);
    return repeated(
        one, std::max<std::size_t>(1, (choice.particlesOr(1) + one.grains.size() / 2) / one.grains.size()));
}

/// Fills a scene with a gas that takes a twentieth of a periodic cube, with speeds of about 1 m/s and no
/// gravity.
template <class S>
void fillWithGas(Scene& scene, const S* species, std::size_t grains) {
    const double radius = 1e-3;
    const auto perSide = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(grains))));
    const double spacing = std::cbrt(4.0 / 3 * std::numbers::pi / 0.05) * radius;
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, spacing * static_cast<double>(perSide));
    UniformRandom random(1);
    const auto speed = [&] { return random.uniform(-1, 1); };
    scene.particleHandler.reserve(grains);
    for (std::size_t k = 0; k < grains; ++k) {
        const Vec3D position = spacing * Vec3D(static_cast<double>(k % perSide) + 0.5,
                                               static_cast<double>(k / perSide % perSide) + 0.5,
                                               static_cast<double>(k / perSide / perSide) + 0.5);
        const double x = speed(), y = speed();
        addGrainRow(scene.particleHandler, species, {radius, position}, {x, y, speed()});
    }
    scene.setTimeStep(benchmarkStep);
}

/// Clumps from a file of rows radius x y z (m), those of a body behind each other, in the smallest box that
/// holds them.
inline Settled settledClumpsOf(const std::filesystem::path& positions) {
    Settled bed{{Vec3D::Constant(infinity), Vec3D::Constant(-infinity)}, readGrainFile(positions)};
    for (const GrainRow& grain : bed.grains) {
        const Vec3D radius = Vec3D::Constant(grain.radius);
        bed.box.lowest = bed.box.lowest.cwiseMin(grain.position - radius);
        bed.box.highest = bed.box.highest.cwiseMax(grain.position + radius);
    }
    bed.box.highest.z() = infinity;
    return bed;
}

/// The grains and the box of a bed or a mixture.
inline Settled settledIn(const BenchmarkChoice& choice, int threads) {
    if (choice.scene == "clumps") return settledClumpsOf(choice.positions);
    if (!choice.positions.empty()) return publishedBed(choice);
    if (choice.scene == "polydisperse")
        return settledMixture(choice.particlesOr(200000), choice.ratio, choice.states, threads);
    return settledBed(choice.particlesOr(25000), choice.states, threads);
}

/// Rain upon a bed: one droplet of 0.1 mm a step, which flies for some 400 steps.
inline void addRain(Scene& scene, const Box& box) {
    constexpr double height = 2e-3, speed = 10;  // m above the highest grain, m/s
    double top = box.lowest.z();
    for (GrainReference grain : scene.particleHandler)
        top = std::max(top, grain.getPosition().z() + grain.getRadius());
    const Vec3D edge = box.highest - box.lowest;
    Spray rain;
    rain.setRain(
        {0.5 * (box.lowest.x() + box.highest.x()), 0.5 * (box.lowest.y() + box.highest.y()), top + height},
        {edge.x(), 0, 0}, {0, edge.y(), 0}, {0, 0, -1});
    rain.setDropletRadius(1e-4);
    rain.setSpeed(speed);
    rain.setFlow(rain.dropletVolume() / benchmarkStep);
    rain.setTimes(0, 1);
    scene.sprayHandler.copyAndAddObject(rain);
}

/// Calls function(scene) with a bed of dry grains whose walls are under a layer of liquid.
template <class Function>
void withWetWalls(const BenchmarkChoice& choice, int threads, Function&& function) {
    using Dry = Species<HertzianViscoelastic, Mindlin, NoAdhesion>;
    using WetWalls = Species<HertzianViscoelastic, Mindlin, WetWall>;
    Simulation<Dry, WetWalls> scene;
    const Dry* const dry = scene.speciesHandler.copyAndAddObject(BedMaterial{}.species<Dry>());
    const WetWalls* const wet = scene.speciesHandler.copyAndAddObject(BedMaterial{}.species<WetWalls>());
    scene.speciesHandler.template setPairType<WetWalls>(dry, wet);
    const Settled bed = settledIn(choice, threads);
    fillBox(scene, dry, wet, bed.grains, bed.box, benchmarkStep);
    function(scene);
}

/// Calls function(scene) with a bed, a gas or a mixture of this species: one of instantiatedSpecies().
template <class Function>
void withSceneOf(std::string_view speciesName, const BenchmarkChoice& choice, int threads,
                 Function&& function) {
    Simulation<> scene;
    AnySpecies* const species = scene.speciesHandler.addByName(speciesName);
    BedMaterial material;
    if (choice.scene == "gas") {
        material.restitution = 0.95;
        material.set(*species);
        fillWithGas(scene, species, choice.particlesOr(25000));
        return function(scene);
    }
    const bool areClumps = choice.scene == "clumps";
    if (areClumps) material.elasticModulus = clumpModulus;
    material.set(*species);
    Settled bed = settledIn(choice, threads);
    fillBox(scene, species, bed.grains, bed.box, areClumps ? clumpStep : benchmarkStep);
    if (choice.shear != 0)
        for (GrainReference grain : scene.particleHandler)
            grain.setVelocity({choice.shear * (grain.getPosition().z() - bed.box.lowest.z()), 0, 0});
    if (choice.clumps > 1) {
        areClumps ? joinRows(scene, choice.clumps) : joinNeighbours(scene, choice.clumps);
        scene.acceptUnstableTimeStep();  // the same step for all: the limit counts with the worst body
    }
    if (choice.scene == "sprayed-bed") addRain(scene, bed.box);
    bed = {};  // gives its memory back
    if (species->has("liquidBridgeVolumeMax"))
        for (GrainReference grain : scene.particleHandler) grain.setLiquidVolume(material.film);
    function(scene);
}

/// Calls function(scene) with the published drum, or one of its proportions that the program fills itself.
template <class Function>
void withDrum(const BenchmarkChoice& choice, Function&& function) {
    const auto turning = [&](auto&&... walls) {
        DrumScene scene(walls...);
        scene.turn(DrumScene::publishedSpeed);
        function(scene);
    };
    if (!choice.positions.empty())
        return turning(readGrainFile(choice.positions), readTriangles(choice.walls));
    const std::size_t number = choice.particlesOr(10000);
    const DrumShape shape = drumFor(number);
    turning(kept(choice.states, fmt::format("drum-{}", number),
                 [&] { return settledDrumGrains(number, shape, settlingSoftness); }),
            shape);
}

/// Calls function(scene) with the published bed and intruder, or with those of its proportions.
template <class Function>
void withPenetration(const BenchmarkChoice& choice, Function&& function) {
    if (!choice.positions.empty()) {
        PenetrationScene scene(separateIntruder(readGrainFile(choice.positions)),
                               readTriangles(choice.walls));
        return function(scene);
    }
    const std::size_t number = choice.particlesOr(10000);
    const BedBox box = bedBoxFor(number);
    PenetrationScene scene(separateIntruder(kept(choice.states, fmt::format("penetration-{}", number),
                                                 [&] {
                                                     auto grains = settledBed(number, box, settlingSoftness);
                                                     grains.bed.push_back(*grains.intruder);
                                                     return grains.bed;
                                                 })),
                           box);
    function(scene);
}

/// Refuses what does not fit together.
/// @param others names of scenes that a program has besides: all of their own species and positions
inline void check(const BenchmarkChoice& choice, std::span<const std::string_view> others = {}) {
    std::vector<std::string_view> known{"bed",  "clumps",      "wet-bed", "wet-walls",   "sprayed-bed",
                                        "drum", "penetration", "gas",     "polydisperse"};
    known.insert(known.end(), others.begin(), others.end());
    if (std::find(known.begin(), known.end(), choice.scene) == known.end())
        unknownName("scene", choice.scene, known);
    if (choice.particles > 0) checkNumberOfGrains("benchmark-scenes", choice.particles);
    const bool isBed = choice.scene == "bed" || choice.scene.starts_with("wet-") ||
                       choice.scene == "sprayed-bed" || choice.scene == "clumps";
    checkValue("benchmark-scenes", "ratio", choice.ratio, "", {1, 50});
    checkValue("benchmark-scenes", "shear", choice.shear, "1/s", {-1e4, 1e4});
    checkValue("benchmark-scenes", "clumps", static_cast<double>(choice.clumps), "spheres", {1, 64});
    if (choice.clumps > 1 && choice.scene != "bed" && choice.scene != "wet-bed" && choice.scene != "clumps")
        throw InputError(fmt::format("benchmark-scenes: the scene {} takes no clumps.", choice.scene));
    if (choice.scene == "clumps" && choice.positions.empty())
        throw InputError("benchmark-scenes: the scene clumps needs positions: give --positions FILE.");
    if (choice.shear != 0 && !isBed && choice.scene != "polydisperse")
        throw InputError(fmt::format("benchmark-scenes: the scene {} takes no shear.", choice.scene));
    const bool hasMesh = choice.scene == "drum" || choice.scene == "penetration";
    if (!choice.positions.empty() && !isBed && !hasMesh)
        throw InputError(fmt::format("benchmark-scenes: the scene {} takes no positions.", choice.scene));
    if (hasMesh && choice.positions.empty() != choice.walls.empty())
        throw InputError(fmt::format(
            "benchmark-scenes: the scene {} needs both positions and walls, or neither.", choice.scene));
    if (!choice.walls.empty() && !hasMesh)
        throw InputError(fmt::format("benchmark-scenes: the scene {} takes no walls.", choice.scene));
    const bool isOther = std::find(others.begin(), others.end(), choice.scene) != others.end();
    if ((hasMesh || isOther || choice.scene == "wet-walls") && !choice.species.empty())
        throw InputError(fmt::format("benchmark-scenes: the scene {} has its own species.", choice.scene));
}

/// Calls function(scene) with the scene chosen, whatever its type.
template <class Function>
void withBenchmarkScene(const BenchmarkChoice& choice, int threads, Function&& function) {
    check(choice);
    if (choice.scene == "drum") return withDrum(choice, function);
    if (choice.scene == "penetration") return withPenetration(choice, function);
    if (choice.scene == "wet-walls") return withWetWalls(choice, threads, function);
    const std::string standard =
        choice.scene == "wet-bed"       ? "HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies"
        : choice.scene == "sprayed-bed" ? "HertzianViscoelasticMindlinLiquidMigrationWillettSpecies"
                                        : "HertzianViscoelasticMindlinSpecies";
    withSceneOf(choice.species.empty() ? standard : choice.species, choice, threads, function);
}

}  // namespace pendular::scenes
