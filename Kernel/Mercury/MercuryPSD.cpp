#include "Kernel/Mercury/MercuryPSD.h"

#include <fmt/format.h>

#include <span>

#include "Kernel/Base/InputError.h"
#include "Kernel/Sizes/SizeLaws.h"
#include "Kernel/Sizes/SizeTable.h"

namespace pendular {

void PSD::setDistributionUniform(double lowest, double highest, int /*numberOfBins*/) {
    distribution = evenSizes(2 * lowest, 2 * highest);
}

void PSD::setDistributionNormal(double mean, double deviation, int /*numberOfBins*/) {
    distribution =
        normalSizes(2 * mean, 2 * deviation, 2 * (mean - 3 * deviation), 2 * (mean + 3 * deviation)).sizes;
}

void PSD::setPSDFromVector(const std::vector<RadiusAndProbability>& table, TYPE type) {
    const int kind = static_cast<int>(type);
    const auto basis = static_cast<SizeBasis>(kind % 4);
    std::vector<double> diameters, values;
    for (const RadiusAndProbability& row : table) {
        diameters.push_back(2 * row.internalVariable);
        values.push_back(row.probability);
    }
    if (kind >= 4 && !values.empty() && values.front() != 0)
        throw InputError(
            fmt::format("PSD: the share of the first row is {}; it must be 0, as what is between a "
                        "radius and the one before stands in its row.",
                        values.front()));
    if (kind < 4) distribution = sizesFromCumulative(diameters, values, basis, InClass::EvenInNumber);
    else
        distribution = sizesFromClasses(diameters, std::span(values).subspan(values.empty() ? 0 : 1), basis,
                                        InClass::EvenInNumber);
}

void PSD::setPSDFromCSV(const std::filesystem::path& file) {
    distribution = readSizeTable(file, InClass::EvenInNumber);
}

double PSD::drawSample() { return 0.5 * sizes().quantile(SizeBasis::Number, random.uniform(0, 1)); }

const SizeDistribution& PSD::sizes() const {
    if (!distribution)
        throw InputError(
            "PSD: no distribution is set; call setDistributionUniform(), setDistributionNormal(), "
            "setPSDFromVector() or setPSDFromCSV().");
    return *distribution;
}

}  // namespace pendular
