#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "Kernel/Sizes/SizeDistribution.h"
#include "Kernel/State/Random.h"

namespace pendular {

/// A distribution of radii (m) by MercuryDPM's names, which makes a SizeDistribution, of diameters.
class PSD {
public:
    enum class TYPE {
        CUMULATIVE_NUMBER_DISTRIBUTION,
        CUMULATIVE_LENGTH_DISTRIBUTION,
        CUMULATIVE_AREA_DISTRIBUTION,
        CUMULATIVE_VOLUME_DISTRIBUTION,
        PROBABILITYDENSITY_NUMBER_DISTRIBUTION,
        PROBABILITYDENSITY_LENGTH_DISTRIBUTION,
        PROBABILITYDENSITY_AREA_DISTRIBUTION,
        PROBABILITYDENSITY_VOLUME_DISTRIBUTION
    };
    /// A row of a table: what is smaller than the radius (m), as a share of all or, of a density, what is
    /// between it and the radius of the row before.
    struct RadiusAndProbability {
        double internalVariable;  // m
        double probability;
    };

    PSD() = default;
    explicit PSD(const SizeDistribution& given) : distribution(given) {}

    /// As many grains of each radius. The kernel needs no bins: their number is not used.
    void setDistributionUniform(double lowest, double highest, int numberOfBins = 0);
    /// Normal in number, cut three standard deviations from the mean, as there.
    void setDistributionNormal(double mean, double deviation, int numberOfBins = 0);
    /// The table has as many grains of each radius within a row, as there.
    void setParticleSizeDistribution(const std::vector<RadiusAndProbability>& table) {
        setPSDFromVector(table, TYPE::CUMULATIVE_NUMBER_DISTRIBUTION);
    }
    void setPSDFromVector(const std::vector<RadiusAndProbability>& table, TYPE type);
    /// A table in the form of readSizeTable(), whose first line says what its columns are.
    void setPSDFromCSV(const std::filesystem::path& file);

    [[nodiscard]] double getMinRadius() const { return 0.5 * sizes().smallest(); }
    [[nodiscard]] double getMaxRadius() const { return 0.5 * sizes().largest(); }
    /// m, of the sphere of the mean volume.
    [[nodiscard]] double getVolumetricMeanRadius() const { return 0.5 * sizes().mean(3, 0); }
    /// m, drawn by number, the same in each run.
    [[nodiscard]] double drawSample();

    /// Throws InputError where nothing has been set.
    [[nodiscard]] const SizeDistribution& sizes() const;

private:
    std::optional<SizeDistribution> distribution;
    UniformRandom random{0};
};

}  // namespace pendular
