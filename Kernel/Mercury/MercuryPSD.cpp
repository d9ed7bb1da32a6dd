#include "Kernel/Mercury/MercuryPSD.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

void PSD::setDistributionUniform(double lowest, double highest, int /*numberOfBins*/) {
    distribution = evenSizes(2 * lowest, 2 * highest);
}

void PSD::setDistributionNormal(double mean, double deviation, int /*numberOfBins*/) {
    distribution =
        normalSizes(2 * mean, 2 * deviation, 2 * (mean - 3 * deviation), 2 * (mean + 3 * deviation)).sizes;
}

void PSD::setDistributionLogNormal(double mean, double deviation, int /*numberOfBins*/) {
    const auto diameterAt = [&](double deviations) { return 2 * std::exp(mean + deviations * deviation); };
    distribution = lognormalSizes(diameterAt(0), std::exp(deviation), diameterAt(-3), diameterAt(3)).sizes;
}

void PSD::setDistributionPhiNormal(double d50, double deviationInPhi, int /*numberOfBins*/) {
    const double most = std::exp2(6 * deviationInPhi);
    distribution =
        lognormalSizes(d50, std::exp2(deviationInPhi), d50 / most, d50 * most, SizeBasis::Volume).sizes;
}

PSD PSD::getDistributionNormal(double mean, double deviation, int numberOfBins) {
    PSD made;
    made.setDistributionNormal(mean, deviation, numberOfBins);
    return made;
}

PSD PSD::getDistributionLogNormal(double mean, double deviation, int numberOfBins) {
    PSD made;
    made.setDistributionLogNormal(mean, deviation, numberOfBins);
    return made;
}

std::vector<PSD::RadiusAndProbability> PSD::getParticleSizeDistribution() const {
    constexpr int pieces = 100;
    std::vector<RadiusAndProbability> table;
    for (int k = 0; k <= pieces; ++k) {
        const double radius = getMinRadius() + k * (getMaxRadius() - getMinRadius()) / pieces;
        table.push_back({radius, sizes().cumulative(SizeBasis::Number, 2 * radius)});
    }
    return table;
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

void PSD::setPSDFromCSV(const std::filesystem::path& path, TYPE type, bool headings, double scale) {
    checkValue("PSD", "scale of the radii", scale, "", positive);
    const InputFile file = loadTextFile("table of sizes", path);
    std::vector<RadiusAndProbability> table;
    std::size_t line = 0;
    for (std::size_t at = 0; at < file.text.size();) {
        const std::size_t end = std::min(file.text.find('\n', at), file.text.size());
        const std::string_view row(file.text.data() + at, end - at);
        at = end + 1;
        Words words(row);
        if (++line == 1 && headings) continue;
        if (words.next().empty()) continue;
        const std::size_t comma = row.find(',');
        if (comma == std::string_view::npos)
            file.refuse("line", line, "it must be a radius and a probability, parted by a comma");
        RadiusAndProbability numbers{};
        for (const auto& [part, number] : {std::pair(row.substr(0, comma), &numbers.internalVariable),
                                           std::pair(row.substr(comma + 1), &numbers.probability)}) {
            const std::string_view word = Words(part).next();
            if (!parseNumber(word, *number)) file.refuse("line", line, whyNoNumber(word));
        }
        table.push_back({scale * numbers.internalVariable, numbers.probability});
    }
    setPSDFromVector(table, type);
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
