#pragma once

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"

namespace pendular {

/// How many of so many grains each class gets: the whole part of its fraction of the number, and one more
/// where the remainder is largest.
std::vector<std::size_t> countsOfClasses(const SizeDistribution& sizes, std::size_t grains);

/// Radii (m), the largest first, that have the distribution as exactly as their count allows: each class has
/// its countsOfClasses(), cut into parts of equal number, and a grain has the mean volume of its part. So the
/// sample's volume up to the border of any part is that of the class, but for the rounding of the counts.
///
/// Throws InputError for more grains than a scene can have, and where a class with more than a hundredth of
/// the volume gets less than half a grain, with the number of grains that would be needed.
std::vector<double> exactRadii(const SizeDistribution& sizes, std::size_t grains);

/// Radii (m) of so many grains drawn at random, each for itself.
std::vector<double> randomRadii(const SizeDistribution& sizes, std::size_t grains, std::uint64_t seed);

/// Puts values into an order that is random, and the same for the same seed.
void shuffle(std::vector<double>& values, std::uint64_t seed);

}  // namespace pendular
