#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <vector>

#include "Drivers/Shared/BedMaterial.h"
#include "Drivers/Shared/BoxScene.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Particles/GrainSums.h"
#include "Kernel/Species/Adhesion/NoAdhesion.h"

namespace pendular::scenes {

/// Grains at rest in a box. The program makes them by itself, the same on every run, and keeps them in the
/// folder given, if one is.
struct Settled {
    Box box;
    std::vector<GrainRow> grains;
};

/// The bed of Dosta et al. (2024) from a file of rows radius x y z (m), in the box of its peers' scripts.
inline Settled publishedBedOf(const std::filesystem::path& positions) {
    return {{{-0.05, -0.03, -0.090243}, {0.05, 0.03, infinity}}, readGrainFile(positions)};
}

/// So many grains of one radius on a loose lattice, layer by layer from the floor of a box without lid, where
/// they meet none of the grains that are there.
inline std::vector<GrainRow> looseGrains(const Box& box, std::size_t count, double radius,
                                         std::span<const GrainRow> there) {
    const double edge = 2 * latticeLooseness * radius;
    const auto isFree = [&](const Vec3D& centre) {
        return std::none_of(there.begin(), there.end(), [&](const GrainRow& g) {
            return (g.position - centre).norm() < g.radius + 1.1 * radius;
        });
    };
    // As high as if the other grains took as much room again as their own lattice would.
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

/// Runs a box of loose grains until the kinetic energy of a grain is below a thousandth of what it would gain
/// by falling through its radius, on average: first with soft grains, then with those of the bed.
inline Settled settle(Settled loose, int threads) {
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
        // Not before a grain can have fallen through its radius.
        const auto first = static_cast<std::size_t>(std::sqrt(2 * 1e-3 / 9.8) / step);
        do {
            scene.step();
        } while (scene.getNumberOfTimeSteps() < first || scene.getNumberOfTimeSteps() % 200 != 0 ||
                 !atRest());
        loose.grains = grainRows(scene.particleHandler);
    }
    return loose;
}

/// The grains kept in a file of the folder; where there is none, those that `make` makes, which are then
/// kept. Without a folder nothing is read or kept.
template <class Make>
std::vector<GrainRow> kept(const std::filesystem::path& folder, const std::string& name, Make&& make) {
    if (folder.empty()) return make();
    const std::filesystem::path file = folder / (name + ".txt");
    if (!std::filesystem::exists(file)) {
        std::filesystem::create_directories(folder);
        writeGrainFile(file, make());
    }
    return readGrainFile(file);
}

/// Copies of the grains side by side along x.
inline Settled repeated(const Settled& one, std::size_t copies) {
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

/// About so many grains of 1 mm radius in a box like that of Dosta et al. (2024): 60 mm wide, and 100 mm long
/// for 25 000 grains, in proportion for fewer. More are copies of 25 000 side by side.
inline Settled settledBed(std::size_t grains, const std::filesystem::path& folder, int threads) {
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

/// About so many grains in all: small ones of 1 mm and large ones of `ratio` mm radius, of equal volume in
/// sum (one large grain for ratio^3 small ones), in a box about as high as it is wide, at least three large
/// diameters.
inline Settled settledMixture(std::size_t grains, double ratio, const std::filesystem::path& folder,
                              int threads) {
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
