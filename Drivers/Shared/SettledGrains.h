#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "Drivers/Shared/BedMaterial.h"
#include "Drivers/Shared/BoxScene.h"

namespace pendular::scenes {

/// Grains at rest in a box. The program makes them by itself, the same on every run, and keeps them in the
/// folder given, if one is.
struct Settled {
    Box box;
    std::vector<GrainRow> grains;
};

/// The bed of Dosta et al. (2024) from a file of rows radius x y z (m), in the box of its peers' scripts.
Settled publishedBedOf(const std::filesystem::path& positions);

/// A number of grains of one radius on a loose lattice, layer by layer from the floor of a box without lid,
/// where they meet none of the grains that are there.
std::vector<GrainRow> looseGrains(const Box& box, std::size_t count, double radius,
                                  std::span<const GrainRow> there);

/// Runs a box of loose grains until the kinetic energy of a grain is below a thousandth of what it would gain
/// by falling through its radius, on average: first with soft grains, then with those of the bed. Throws
/// InputError where they do not come to rest in a hundred times the time of a fall from the top.
Settled settle(Settled loose, int threads);

/// The grains kept in a file of the folder; where there is none, those that `make` makes, which are then
/// kept. Without a folder nothing is read or kept.
std::vector<GrainRow> kept(const std::filesystem::path& folder, const std::string& name,
                           const std::function<std::vector<GrainRow>()>& make);

/// Copies of the grains side by side along x.
Settled repeated(const Settled& one, std::size_t copies);

/// About so many grains of 1 mm radius in a box like that of Dosta et al. (2024): 60 mm wide, and 100 mm long
/// for 25 000 grains, in proportion for fewer. More are copies of 25 000 side by side.
Settled settledBed(std::size_t grains, const std::filesystem::path& folder, int threads);

/// About so many grains in all: small ones of 1 mm and large ones of `ratio` mm radius, of equal volume in
/// sum (one large grain for ratio^3 small ones), in a box about as high as it is wide, at least three large
/// diameters.
Settled settledMixture(std::size_t grains, double ratio, const std::filesystem::path& folder, int threads);

}  // namespace pendular::scenes
