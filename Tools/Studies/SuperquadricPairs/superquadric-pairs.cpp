/// How often Newton's method fails for pairs of superquadrics, how far off it is, and what a pair takes.

#include <fmt/format.h>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Superquadrics/SuperquadricPair.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/Studies/SuperquadricPairs/RandomDirection.h"

using namespace pendular;

namespace {

struct Options {
    std::size_t pairs = 800;
    double overlap = 0.02;
    std::size_t seed = 1;
};

using Pair = SuperquadricPair<double>;
constexpr std::size_t lanes = Pack::lanes;

/// Two shapes of the same exponents, their half lengths spread evenly in the logarithm over a factor of
/// `aspect`, turned at random and moved together until they overlap by a share of their distance.
Pair randomPair(UniformRandom& random, int exponent, double aspect, double overlap) {
    const auto shape = [&] {
        const auto half = [&] { return std::pow(aspect, random.uniform(-0.5, 0.5)); };
        return SuperquadricLanes<double>::from({half(), half(), half(), exponent, exponent});
    };
    const auto axes = [&] {
        const double angle = random.uniform(0, std::numbers::pi);
        return Axes<double>(Quaternion{std::cos(0.5 * angle), std::sin(0.5 * angle) * direction(random)});
    };
    Pair pair{shape(), shape(), axes(), axes(), {0, 0, 0}};
    const Vector<double> way = direction(random);
    double touching = 0, apart = 4 * aspect;
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (touching + apart);
        pair.shift = middle * way;
        (findTouch(pair, firstNormal(pair), 0.0).depth > 0 ? touching : apart) = middle;
    }
    pair.shift = (1 - overlap) * touching * way;
    return pair;
}

/// Eight pairs side by side.
SuperquadricPair<Pack> together(const Pair* pairs) {
    const auto number = [&](auto&& of) {
        alignas(64) std::array<double, lanes> column;
        for (std::size_t k = 0; k < lanes; ++k) column[k] = of(pairs[k]);
        return Pack::load(column.data());
    };
    const auto vector = [&](auto&& of) {
        return Vector<Pack>{number([&](const Pair& p) { return of(p).x; }),
                            number([&](const Pair& p) { return of(p).y; }),
                            number([&](const Pair& p) { return of(p).z; })};
    };
    const auto shape = [&](auto&& of) {
        return SuperquadricLanes<Pack>{
            number([&](const Pair& p) { return of(p).a; }),  number([&](const Pair& p) { return of(p).b; }),
            number([&](const Pair& p) { return of(p).c; }),  number([&](const Pair& p) { return of(p).n1; }),
            number([&](const Pair& p) { return of(p).n2; }), of(pairs[0]).areEllipsoids};
    };
    SuperquadricPair<Pack> all{shape([](const Pair& p) -> auto& { return p.shape1; }),
                               shape([](const Pair& p) -> auto& { return p.shape2; }),
                               Axes<Pack>(QuaternionOf<Pack>{}), Axes<Pack>(QuaternionOf<Pack>{}),
                               vector([](const Pair& p) -> auto& { return p.shift; })};
    all.axes1.x = vector([](const Pair& p) -> auto& { return p.axes1.x; });
    all.axes1.y = vector([](const Pair& p) -> auto& { return p.axes1.y; });
    all.axes1.z = vector([](const Pair& p) -> auto& { return p.axes1.z; });
    all.axes2.x = vector([](const Pair& p) -> auto& { return p.axes2.x; });
    all.axes2.y = vector([](const Pair& p) -> auto& { return p.axes2.y; });
    all.axes2.z = vector([](const Pair& p) -> auto& { return p.axes2.z; });
    return all;
}

/// A row of the table: one exponent and one ratio of half lengths.
void measure(const Options& options, int exponent, double aspect) {
    UniformRandom random(options.seed);
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < options.pairs; ++k)
        pairs.push_back(randomPair(random, exponent, aspect, options.overlap));

    std::vector<SuperquadricPair<Pack>> eights;
    std::vector<Vector<Pack>> cold, warm;
    int failures = 0;
    double worst = 0;
    for (std::size_t k = 0; k < options.pairs; k += lanes) {
        eights.push_back(together(&pairs[k]));
        cold.push_back(firstNormal(eights.back()));
        const auto found = findTouch(eights.back(), cold.back(), 0.0);
        // A normal of the step before: a thousandth of a radian off. Both starts must lead to one depth.
        const TangentPlane<Pack> plane(found.normal);
        warm.push_back(superquadric::unit(found.normal + Pack(1e-3) * plane.u));
        const auto again = findTouch(eights.back(), warm.back(), 0.0);
        const Pack off = abs(found.depth - again.depth) / norm(eights.back().shift);
        for (int lane = 0; lane < static_cast<int>(lanes); ++lane) {
            failures += (bits(found.isFound) >> lane & 1) != 0 ? 0 : 1;
            worst = std::max(worst, off[lane]);
        }
    }
    Pack sum = 0;  // what is not used would not be computed
    const auto timeOf = [&](const std::vector<Vector<Pack>>& starts) {
        constexpr int repeats = 5;
        return leastTimeOf(4,
                           [&] {
                               for (int r = 0; r < repeats; ++r)
                                   for (std::size_t k = 0; k < eights.size(); ++k)
                                       sum = sum + findTouch(eights[k], starts[k], 0.0).depth;
                           }) /
               (repeats * static_cast<double>(options.pairs)) * 1e9;
    };
    const double coldTime = timeOf(cold), warmTime = timeOf(warm);
    if (sum[0] == 0.125) fmt::print("#");
    fmt::print("{},{},{},{},{:.2g},{:.4g},{:.4g}\n", exponent, aspect, options.pairs, failures, worst,
               coldTime, warmTime);
    std::fflush(stdout);
}

int run(const Options& options) {
    if (options.pairs == 0 || options.pairs % lanes != 0)
        throw InputError(
            fmt::format("superquadric-pairs: --pairs = {} must be a multiple of {}.", options.pairs, lanes));
    checkValue("superquadric-pairs", "--overlap", options.overlap, "", {0, 0.2, false, true});
    fmt::print(
        "exponent,largest_ratio_of_half_lengths,pairs,failures_of_newton,largest_difference_of_depth_per_"
        "distance,"
        "cold_time_ns,warm_time_ns\n");
    for (int exponent = Superquadric::smallestExponent; exponent <= Superquadric::largestExponent; ++exponent)
        for (const double aspect : {1.0, 2.0, 5.0, 10.0}) measure(options, exponent, aspect);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints a row of CSV for each exponent and ratio of half lengths of random superquadrics that touch: "
        "how "
        "often Newton's method has not ended, so that the fallback was taken; the largest difference of the "
        "depths from two starts; and the processor time of a pair, eight at once, without and with a normal "
        "of "
        "the step before.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--pairs", o.pairs, "pairs of each row, a multiple of 8");
    app.add_option("--overlap", o.overlap, "share of the distance of two that just touch, up to 0.2");
    app.add_option("--seed", o.seed, "of the random numbers");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
