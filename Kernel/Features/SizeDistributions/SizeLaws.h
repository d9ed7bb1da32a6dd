#pragma once

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"

namespace pendular {

/// The parts that the two cuts of a law have taken away, as fractions of the whole law.
struct CutAway {
    double number;  // NaN where the law has infinitely many grains
    double volume;
};

/// A law of sizes, cut to the diameters from `low` to `high`.
struct CutLaw {
    SizeDistribution sizes;
    CutAway away;
};

// All diameters are in m. These functions throw InputError for values out of their ranges, for low >= high,
// and where no grain is left between the two.

/// A law with as many grains of each diameter.
SizeDistribution evenSizes(double low, double high);

/// A normal distribution of the diameters in number, of which those above 0 are the whole.
CutLaw normalSizes(double mean, double deviation, double low, double high);

/// Lognormal, with its median on a basis and the geometric standard deviation s > 1, which is the same on all
/// bases: the median on basis k is that in number times e^(k ln^2 s). Source: Hatch and Choate, J. Franklin
/// Inst. 207 (1929) 369.
CutLaw lognormalSizes(double median, double geometricDeviation, double low, double high,
                      SizeBasis basis = SizeBasis::Number);
/// Lognormal sizes by the arithmetic mean and standard deviation in number.
CutLaw lognormalSizesFromMean(double mean, double deviation, double low, double high);

/// Rosin, Rammler, Sperling and Bennett: the volume above d is exp(-(d / size)^exponent). Source: Rosin and
/// Rammler, J. Inst. Fuel 7 (1933) 29.
/// @param exponent 0.1 to 100
CutLaw rosinRammlerSizes(double size, double exponent, double low, double high);

/// Two sizes; @param volumeOfLarge fraction of the volume that large grains have, 0 to 1
SizeDistribution bidisperseSizes(double small, double large, double volumeOfLarge);

}  // namespace pendular
