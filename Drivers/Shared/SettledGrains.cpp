#include "Drivers/Shared/SettledGrains.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Adhesion/NoAdhesion.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"

namespace pendular::scenes {

Settled publishedBedOf(const std::filesystem::path& positions) {
    return {{{-0.05, -0.03, -0.090243}, {0.05, 0.03, infinity}}, readGrainFile(positions)};
}

std::vector<GrainRow> looseGrains(const Box& box, std::size_t count, double radius,
                                  std::span<const GrainRow> there) {
    const double edge = 2 * latticeLooseness * radius;
    const auto isFree = [&](const Vec3D& centre) {
        return std::none_of(there.begin(), there.end(), [&](const GrainRow& g) {
            return (g.position - centre).norm() < g.radius + 1.1 * radius;
        });
    };
    // The place for the grains is as high as if the other grains took as much room again as their own lattice
    // would.
    double room = static_cast<double>(count) * std::pow(edge, 3);
    for (const GrainRow& g : there) room += std::pow(2 * latticeLooseness * g.radius, 3);
    const Vec3D base = box.highest - box.lowest;
    const double height = 2 * room / (base.x() * base.y()) + 4 * edge;
    const Vec3D top(box.highest.x(), box.highest.y(), box.lowest.z() + height);
    UniformRandom random(1);
    std::vector<GrainRow> grains;
    for (const Vec3D& cell : latticeCells(box.lowest, top, edge, isFree)) {
        if (grains.size() == count) break;
        grains.push_back(jittered(radius, cell, random));
    }
    return grains;
}

/// s, in which a stone falls from the highest grain to the floor.
static double fallTime(const Settled& bed) {
    double height = 0;  // m
    for (const GrainRow& grain : bed.grains)
        height = std::max(height, grain.position.z() + grain.radius - bed.box.lowest.z());
    return std::sqrt(2 * height / 9.8);
}

Settled settle(Settled loose, int threads) {
    // Beds rest after a few of these times. What never rests must end, too.
    constexpr double mostFalls = 100;
    using Dry = Species<HertzianViscoelastic, Mindlin, NoAdhesion>;
    for (const auto& [modulus, step] : {std::pair{1e8, 1.5e-6}, std::pair{1e9, 5e-7}}) {
        BedMaterial material;
        material.elasticModulus = modulus;
        material.restitution = 0.2;
        BoxScene<Dry> scene(material.species<Dry>(), loose.grains, loose.box, step);
        scene.setNumberOfThreads(threads);
        scene.initialise();
        const auto atRest = [&] {
            const auto& grains = scene.particleHandler.store();
            double fall = 0;  // J
            for (const TranslationRecord& grain : grains.translation)
                fall += 9.8 * grain.radius / grain.inverseMass;
            return translationalEnergy(grains) < 1e-3 * fall;
        };
        // Grains fall from rest: before they can have fallen through a radius they would seem to be at rest
        // again.
        const auto first = static_cast<std::size_t>(std::sqrt(2 * 1e-3 / 9.8) / step);
        const double longest = mostFalls * fallTime(loose);  // s
        do {
            if (scene.getTime() > longest)
                throw InputError(fmt::format(
                    "settle: the {} grains are not at rest after {:.3g} s, {:.0f} times the time of a fall "
                    "from the top of their box; a bed needs at least one grain, and grains that stay in it.",
                    loose.grains.size(), scene.getTime(), mostFalls));
            scene.step();
        } while (scene.getNumberOfTimeSteps() < first || scene.getNumberOfTimeSteps() % 200 != 0 ||
                 !atRest());
        loose.grains = grainRows(scene.particleHandler);
    }
    return loose;
}

std::vector<GrainRow> kept(const std::filesystem::path& folder, const std::string& name,
                           const std::function<std::vector<GrainRow>()>& make) {
    if (folder.empty()) return make();
    const std::filesystem::path file = folder / (name + ".txt");
    if (!isThere(file)) {
        makeFolder(folder);
        writeGrainFile(file, make());
    }
    return readGrainFile(file);
}

Settled repeated(const Settled& one, std::size_t copies) {
    Settled all{one.box, {}};
    const double length = one.box.highest.x() - one.box.lowest.x();
    all.grains.reserve(copies * one.grains.size());
    for (std::size_t copy = 0; copy < copies; ++copy)
        for (GrainRow row : one.grains) {
            row.position.x() += length * static_cast<double>(copy);
            all.grains.push_back(row);
        }
    all.box.highest.x() += length * static_cast<double>(copies - 1);
    return all;
}

Settled settledBed(std::size_t grains, const std::filesystem::path& folder, int threads) {
    constexpr std::size_t most = 25000;
    const std::size_t own = std::min(grains, most);
    const double length = std::max(0.1 * static_cast<double>(own) / most, 0.01);
    Settled bed{{{0, 0, 0}, {length, 0.06, infinity}}, {}};
    bed.grains = kept(folder, fmt::format("bed-{}", own), [&] {
        bed.grains = looseGrains(bed.box, own, 1e-3, {});
        return settle(bed, threads).grains;
    });
    return repeated(bed, std::max<std::size_t>(1, (grains + most / 2) / most));
}

Settled settledMixture(std::size_t grains, double ratio, const std::filesystem::path& folder, int threads) {
    const double smallRadius = 1e-3, largeRadius = ratio * smallRadius;
    const auto large = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(static_cast<double>(grains) / (ratio * ratio * ratio + 1))));
    const std::size_t small = grains - large;
    const double volume = 2 * static_cast<double>(small) * std::pow(2 * smallRadius, 3);
    const double width = std::max(std::cbrt(volume), 3 * 2 * largeRadius);
    Settled bed{{{0, 0, 0}, {width, width, infinity}}, {}};
    bed.grains = kept(folder, fmt::format("mixture-{}-1to{:g}", grains, ratio), [&] {
        bed.grains = looseGrains(bed.box, large, largeRadius, {});
        const std::vector<GrainRow> among = looseGrains(bed.box, small, smallRadius, bed.grains);
        bed.grains.insert(bed.grains.end(), among.begin(), among.end());
        return settle(bed, threads).grains;
    });
    return bed;
}

}  // namespace pendular::scenes
