#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"

namespace pendular {

/// The assumption on the sizes within a class of a table. A table on the basis of numbers is the same in
/// both.
enum class InClass {
    EvenOnBasis,   ///< the cumulative curve of the table's basis is a straight line: it is met at every size
    EvenInNumber,  ///< as many grains of each diameter (MercuryDPM's reading)
};

/// Sieve classes: edges d_0 ... d_n (m, diameters), and the n fractions of the grains between them, in any
/// unit, on a basis. These functions throw InputError for sizes that do not increase or are out of
/// diameterRange, for negative fractions, and for other numbers of them.
SizeDistribution sizesFromClasses(std::span<const double> edges, std::span<const double> fractions,
                                  SizeBasis basis, InClass within = InClass::EvenOnBasis);

/// A cumulative table, from 0 to 1 (to 1e-9), on a basis, at diameters (m).
SizeDistribution sizesFromCumulative(std::span<const double> diameters, std::span<const double> cumulative,
                                     SizeBasis basis, InClass within = InClass::EvenOnBasis);

/// Values of a density on a basis, in any unit, at diameters (m); straight lines between them.
SizeDistribution sizesFromDensity(std::span<const double> diameters, std::span<const double> densities,
                                  SizeBasis basis);

/// Single sizes: diameters (m) and the fractions of grains that have them, in any unit, on a basis.
SizeDistribution singleSizes(std::span<const double> diameters, std::span<const double> fractions,
                             SizeBasis basis);

/// Reads a table of two columns, parted by a comma. Its first line says what they are:
///   diameter_UNIT or radius_UNIT, with the unit m, mm or um, and
///   cumulative_BASIS   from 0 in the first row to 1 in the last
///   class_BASIS        what is between the size of the row before and this one; 0 in the first row; sum 1
///   single_BASIS       what has just this size; sum 1
///   density_BASIS      per length of the size, in any unit; straight lines between rows
/// with the basis number, length, area, volume or mass, and, for all but density, _percent behind it where
/// the whole is 100. Lines that are empty or begin with # are skipped. Throws InputError with the file, the
/// line and the reason.
/// @param within for cumulative and class; as EvenOnBasis where nothing is given
SizeDistribution readSizeTable(const std::filesystem::path& path, std::optional<InClass> within = {});

}  // namespace pendular
