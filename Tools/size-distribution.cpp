/// Shows a distribution of grain sizes on all bases, draws grains from it, and compares samples with it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/LawNames.h"

using namespace pendular;

namespace {

struct Options {
    std::string file, law, inClass = "basis", basis = "number";
    double size = unset, deviation = unset, exponent = unset, volumeOfLarge = unset;
    double smallest = unset, largest = unset;
    int points = 201;
    std::size_t draw = 0, samples = 100;
    std::uint64_t seed = 1;
    bool exact = false, errors = false;
};

constexpr std::string_view program = "size-distribution";

template <class Value>
Value chosen(std::string_view kind, std::string_view name,
             std::initializer_list<std::pair<std::string_view, Value>> values) {
    std::vector<std::string_view> known;
    for (const auto& [key, value] : values) {
        if (key == name) return value;
        known.push_back(key);
    }
    unknownName(kind, name, known);
}

SizeBasis basisOf(const Options& o) {
    return chosen<SizeBasis>("basis", o.basis,
                             {{"number", SizeBasis::Number},
                              {"length", SizeBasis::Length},
                              {"area", SizeBasis::Area},
                              {"volume", SizeBasis::Volume}});
}

enum class Law { Even, Normal, Lognormal, RosinRammler, Bidisperse };

/// The distribution that the options describe, and what the cuts of a law take away.
CutLaw distribution(const Options& o) {
    if (o.file.empty() == o.law.empty())
        throw InputError(fmt::format("{}: give either --file or --law.", program));
    if (!o.file.empty()) {
        const auto within =
            chosen<InClass>("reading of a class", o.inClass,
                            {{"basis", InClass::EvenOnBasis}, {"number", InClass::EvenInNumber}});
        return {readSizeTable(o.file, within), {0, 0}};
    }
    const SizeBasis basis = basisOf(o);
    switch (chosen<Law>("law", o.law,
                        {{"even", Law::Even},
                         {"normal", Law::Normal},
                         {"lognormal", Law::Lognormal},
                         {"rosin-rammler", Law::RosinRammler},
                         {"bidisperse", Law::Bidisperse}})) {
        case Law::Normal:
            return normalSizes(o.size, o.deviation, o.smallest, o.largest);
        case Law::Lognormal:
            return lognormalSizes(o.size, o.deviation, o.smallest, o.largest, basis);
        case Law::RosinRammler:
            return rosinRammlerSizes(o.size, o.exponent, o.smallest, o.largest);
        case Law::Bidisperse:
            return {bidisperseSizes(o.smallest, o.largest, o.volumeOfLarge), {0, 0}};
        case Law::Even:
            break;
    }
    return {evenSizes(o.smallest, o.largest), {0, 0}};
}

constexpr std::array bases{SizeBasis::Number, SizeBasis::Length, SizeBasis::Area, SizeBasis::Volume};

void describe(const Options& o, const CutLaw& law) {
    const SizeDistribution& sizes = law.sizes;
    fmt::print("# diameters: {:.6g} m to {:.6g} m\n", sizes.smallest(), sizes.largest());
    if (!o.law.empty())
        fmt::print("# the cuts take away, of 1: {:.3g} of the number, {:.3g} of the volume\n",
                   law.away.number, law.away.volume);
    else
        fmt::print("# within a class: even {}\n",
                   o.inClass == "basis" ? "on the basis of the file" : "in number");
    fmt::print("# D[1,0] {:.6g} m, D[3,0] {:.6g} m, D[3,2] {:.6g} m, D[4,3] {:.6g} m\n", sizes.mean(1, 0),
               sizes.mean(3, 0), sizes.mean(3, 2), sizes.mean(4, 3));
    for (const SizeBasis basis : {SizeBasis::Number, SizeBasis::Volume})
        fmt::print("# by {}: d10 {:.6g} m, d50 {:.6g} m, d90 {:.6g} m\n", nameOf(basis),
                   sizes.quantile(basis, 0.1), sizes.quantile(basis, 0.5), sizes.quantile(basis, 0.9));
}

/// The curves on all bases, at diameters in equal ratios.
void printCurves(const Options& o, const SizeDistribution& sizes) {
    checkValue(program, "points", o.points, "", {2, 1e7});
    fmt::print("diameter_m");
    for (const SizeBasis basis : bases) fmt::print(",cumulative_{}", nameOf(basis));
    for (const SizeBasis basis : bases) fmt::print(",density_{}_per_m", nameOf(basis));
    fmt::print("\n");
    for (int k = 0; k < o.points; ++k) {
        const double d = k + 1 == o.points ? sizes.largest()
                                           : sizes.smallest() * std::pow(sizes.largest() / sizes.smallest(),
                                                                         k / (o.points - 1.0));
        fmt::print("{}", d);
        for (const SizeBasis basis : bases) fmt::print(",{}", sizes.cumulative(basis, d));
        for (const SizeBasis basis : bases) fmt::print(",{}", sizes.density(basis, d));
        fmt::print("\n");
    }
}

void printGrains(const Options& o, const SizeDistribution& sizes) {
    checkValue(program, "draw", static_cast<double>(o.draw), "grains", {1, 1e9});
    const std::vector<double> radii =
        o.exact ? exactRadii(sizes, o.draw) : randomRadii(sizes, o.draw, o.seed);
    fmt::print("diameter_m\n");
    for (const double r : radii) fmt::print("{}\n", 2 * r);
}

/// The largest difference of the fraction of the volume up to the border of a class, or, where there is but
/// one class, up to the tenths of the volume, in a sample from that of the distribution.
double worstError(const SizeDistribution& sizes, std::vector<double> radii) {
    std::sort(radii.begin(), radii.end());
    std::vector<double> borders;
    for (const auto& c : sizes.classes()) borders.push_back(c.high);
    if (borders.size() == 1)
        for (int k = 1; k < 10; ++k) borders.push_back(sizes.quantile(SizeBasis::Volume, 0.1 * k));
    std::sort(borders.begin(), borders.end());
    double total = 0, below = 0, worst = 0;
    for (const double r : radii) total += r * r * r;
    auto next = radii.begin();
    for (const double border : borders) {
        for (; next != radii.end() && 2 * *next <= border; ++next) below += *next * *next * *next;
        worst = std::max(worst, std::abs(below / total - sizes.cumulative(SizeBasis::Volume, border)));
    }
    return worst;
}

void printErrors(const Options& o, const SizeDistribution& sizes) {
    checkValue(program, "samples", static_cast<double>(o.samples), "", {1, 1e6});
    fmt::print("grains,random_mean_error,random_largest_error,exact_error\n");
    for (const std::size_t grains : {100, 300, 1000, 3000, 10000, 30000, 100000}) {
        double sum = 0, largest = 0;
        for (std::size_t k = 0; k < o.samples; ++k) {
            const double error = worstError(sizes, randomRadii(sizes, grains, o.seed + k));
            sum += error;
            largest = std::max(largest, error);
        }
        std::string exact = "nan";  // where there are too few grains for a class
        try {
            exact = fmt::format("{}", worstError(sizes, exactRadii(sizes, grains)));
        } catch (const InputError&) {}
        fmt::print("{},{},{},{}\n", grains, sum / static_cast<double>(o.samples), largest, exact);
    }
}

int run(const Options& o) {
    const CutLaw law = distribution(o);
    describe(o, law);
    if (o.errors) printErrors(o, law.sizes);
    else if (o.draw > 0 || o.exact) printGrains(o, law.sizes);
    else printCurves(o, law.sizes);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Grain sizes: means, quantiles, and the curves on all bases, as CSV; grains drawn from them. "
        "The file is a table of two columns, as in diameter_mm,cumulative_volume; "
        "the page on size distributions describes it.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--file", o.file, "table of sizes");
    app.add_option("--in-class", o.inClass,
                   "within a class of the file, grains are even on its 'basis' or in 'number'");
    app.add_option("--law", o.law, "even, normal, lognormal, rosin-rammler or bidisperse, instead of a file");
    app.add_option("--size-m", o.size,
                   "diameter, m: mean (normal), median (lognormal), 63 % of the volume (rosin-rammler)");
    app.add_option("--deviation", o.deviation,
                   "standard deviation, m (normal); geometric, above 1 (lognormal)");
    app.add_option("--exponent", o.exponent, "of rosin-rammler");
    app.add_option("--basis", o.basis, "of the median of lognormal: number, length, area or volume");
    app.add_option("--smallest-m", o.smallest, "smallest diameter, m: all laws are cut there");
    app.add_option("--largest-m", o.largest, "largest diameter, m");
    app.add_option("--volume-of-large", o.volumeOfLarge,
                   "fraction of the volume that the large grains have (bidisperse)");
    app.add_option("--points", o.points, "of the curves");
    app.add_option("--draw", o.draw, "print the diameters of so many grains instead of curves");
    app.add_option("--seed", o.seed, "of random grains");
    app.add_flag(
        "--exact", o.exact,
        "draw grains that have the distribution as exactly as their count allows, the largest first");
    app.add_flag("--errors", o.errors,
                 "print the error of the volume over the number of grains, for random and exact samples");
    app.add_option("--samples", o.samples, "random samples for --errors");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
