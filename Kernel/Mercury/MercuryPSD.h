#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Foundation/State/Random.h"

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
    /// The logarithm of the radius in metres is normal in number, cut three deviations from its mean, as
    /// there.
    void setDistributionLogNormal(double meanOfLogarithm, double deviationOfLogarithm, int numberOfBins = 0);
    /// Normal in phi = -log2(1000 D) of the diameter D (m), by volume, cut six deviations from the mean; half
    /// of the volume is in grains of a diameter up to D50 (m). Source: Krumbein, J. Sediment. Petrol. 4
    /// (1934) 65.
    void setDistributionPhiNormal(double d50, double deviationInPhi, int numberOfBins = 0);
    static PSD getDistributionNormal(double mean, double deviation, int numberOfBins = 0);
    static PSD getDistributionLogNormal(double meanOfLogarithm, double deviationOfLogarithm,
                                        int numberOfBins = 0);
    /// The table has as many grains of each radius within a row, as there.
    void setParticleSizeDistribution(const std::vector<RadiusAndProbability>& table) {
        setPSDFromVector(table, TYPE::CUMULATIVE_NUMBER_DISTRIBUTION);
    }
    void setPSDFromVector(const std::vector<RadiusAndProbability>& table, TYPE type);
    /// A table in the form of readSizeTable(), whose first line says what its columns are.
    void setPSDFromCSV(const std::filesystem::path& file);
    /// A table in MercuryDPM's form: rows "radius, probability", after one line of headings if there is one.
    /// @param scale m for one unit of the radii
    void setPSDFromCSV(const std::filesystem::path& file, TYPE type, bool headings = false, double scale = 1);

    [[nodiscard]] double getMinRadius() const { return 0.5 * sizes().smallest(); }
    [[nodiscard]] double getMaxRadius() const { return 0.5 * sizes().largest(); }
    /// m, of the sphere of the mean volume.
    [[nodiscard]] double getVolumetricMeanRadius() const { return 0.5 * sizes().mean(3, 0); }
    /// The cumulative distribution in number, at a hundred radii and the largest one.
    [[nodiscard]] std::vector<RadiusAndProbability> getParticleSizeDistribution() const;
    /// m, the diameter up to which half of the volume is.
    [[nodiscard]] double getVolumeD50() const { return sizes().quantile(SizeBasis::Volume, 0.5); }
    /// m, drawn by number, the same in each run.
    [[nodiscard]] double drawSample();

    /// Throws InputError where nothing has been set.
    [[nodiscard]] const SizeDistribution& sizes() const;

private:
    std::optional<SizeDistribution> distribution;
    UniformRandom random{0};
};

/// A row of a table of sizes under another of its names there.
using DistributionElements = PSD::RadiusAndProbability;

}  // namespace pendular
