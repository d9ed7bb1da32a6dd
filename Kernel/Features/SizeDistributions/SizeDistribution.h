#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular {

/// The quantity that is counted in a distribution: grains, their lengths, areas or volumes (masses, if all
/// have one density). The number is the power of the diameter that a grain counts with.
enum class SizeBasis { Number = 0, Length = 1, Area = 2, Volume = 3 };

std::string_view nameOf(SizeBasis basis);

/// The range (m) of diameters.
inline constexpr Range diameterRange{2 * radiusRange.lowest, 2 * radiusRange.highest};

/// A piece of a distribution in which the density of numbers is one smooth function of the diameter d:
/// law(d) d^-p times the straight line from `atLow` to `atHigh`; or, where the two ends are the same, a
/// number `atLow` of grains of one size.
struct SizePanel {
    double low, high;      // m, diameters
    double atLow, atHigh;  // any unit, the same in all panels
    std::size_t sizeClass = 0;
};

/// The sizes of grains: how many there are of each diameter (m). How to make one: SizeTable.h (tables,
/// files), SizeLaws.h (lognormal, ...).
///
/// q_0 is the density of numbers, M_k = integral of d^k q_0 dd, and q_r = d^r q_0 / M_r the density on the
/// basis r (ISO 9276-2). All integrals are sums of Gauss-Legendre rules over panels short enough for
/// round-off.
class SizeDistribution {
public:
    /// @param shapeBasis p of SizePanel; @param law of SizePanel; none: 1
    /// @param panels ascending; no end of one lies within another. Throws InputError where there is nothing
    /// in them.
    SizeDistribution(std::vector<SizePanel> panels, SizeBasis shapeBasis,
                     std::function<double(double)> law = {});

    /// m, the diameters between which all grains lie.
    [[nodiscard]] double smallest() const { return panels.front().low; }
    [[nodiscard]] double largest() const { return panels.back().high; }
    /// M_k, m^k, with M_0 = 1; @param k 0 to 4
    [[nodiscard]] double moment(int k) const { return borders[k].back(); }
    /// The moment (m^k) of the grains from one diameter to another one (m); @param k 0 to 4
    [[nodiscard]] double moment(int k, double from, double to) const;
    /// D[k,m] = (M_k / M_m)^(1 / (k - m)), m: D[1,0] the mean diameter, D[3,2] Sauter's, D[4,3]. Throws
    /// InputError unless k and m are two of 0 to 4.
    [[nodiscard]] double mean(int k, int m) const;
    /// The fraction of grains up to a diameter (m), on a basis.
    [[nodiscard]] double cumulative(SizeBasis basis, double diameter) const;
    /// q_r, 1/m; infinite for a single size.
    [[nodiscard]] double density(SizeBasis basis, double diameter) const;
    /// m, the diameter up to which there is a fraction of the grains. Throws InputError unless it is 0 to 1.
    [[nodiscard]] double quantile(SizeBasis basis, double fraction) const;
    /// m, the radius of one grain drawn at random, the same for the same seed and identity.
    [[nodiscard]] double drawRadius(const CountedRandom& random, std::uint64_t identity) const {
        return 0.5 * quantile(SizeBasis::Number, random.uniform(identity, purposeOfSizes));
    }

    /// The classes of the table that it was made of; one for a law.
    struct Class {
        double low, high;       // m, diameters
        double number, volume;  // fractions of all grains
    };
    [[nodiscard]] std::vector<Class> classes() const;

private:
    /// The purpose of the random numbers of sizes; no other part of a scene may use it.
    static constexpr std::uint32_t purposeOfSizes = 0x512E5;
    static constexpr int moments = 5;

    [[nodiscard]] double numberDensity(const SizePanel& panel, double diameter) const;
    [[nodiscard]] double panelMoment(int k, const SizePanel& panel, double from, double to) const;
    [[nodiscard]] double solve(int k, const SizePanel& panel, double amount) const;

    std::vector<SizePanel> panels;
    int shapePower;
    std::function<double(double)> law;
    std::vector<double> borders[moments];  // M_k of all panels before one, and of all
};

}  // namespace pendular
