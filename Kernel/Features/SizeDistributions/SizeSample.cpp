#include "Kernel/Features/SizeDistributions/SizeSample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

using Class = SizeDistribution::Class;

/// The purpose of the random numbers of the order of grains (CountedRandom).
constexpr std::uint32_t purposeOfOrder = 0x512E6;

void refuseTooMany(std::size_t grains) {
    checkValue("SizeDistribution", "number of grains", static_cast<double>(grains), "",
               fromZeroTo(ParticleStore::largestIdentity));
}

void refuseTooFew(const std::vector<Class>& classes, std::size_t grains) {
    double least = 1;
    const Class* worst = nullptr;
    for (const Class& c : classes)
        if (c.volume > 0.01 && c.number < least) {
            least = c.number;
            worst = &c;
        }
    if (!worst || least * static_cast<double>(grains) >= 0.5) return;
    throw InputError(fmt::format(
        "SizeDistribution: of {} grains the class from {:g} m to {:g} m, which has {:.3g} % of the volume, "
        "gets less than half a grain; there must be {:.0f} at least.",
        grains, worst->low, worst->high, 100 * worst->volume, std::ceil(0.5 / least)));
}

void addClass(const SizeDistribution& sizes, const Class& c, std::size_t count, std::vector<double>& radii) {
    if (c.low == c.high) {
        radii.insert(radii.end(), count, 0.5 * c.low);
        return;
    }
    const double before = sizes.cumulative(SizeBasis::Number, c.low);
    const auto border = [&](std::size_t k) {
        if (k == 0) return c.low;
        if (k == count) return c.high;
        const double fraction =
            std::min(1.0, before + c.number * static_cast<double>(k) / static_cast<double>(count));
        return std::clamp(sizes.quantile(SizeBasis::Number, fraction), c.low, c.high);
    };
    double low = border(0);
    for (std::size_t k = 1; k <= count; ++k) {
        askForInterruption();
        const double high = border(k), number = sizes.moment(0, low, high);
        // Where round-off leaves nothing between two borders, they are the same diameter.
        const double diameter = number > 0 ? std::cbrt(sizes.moment(3, low, high) / number) : high;
        radii.push_back(0.5 * std::clamp(diameter, low, high));
        low = high;
    }
}

}  // namespace

std::vector<std::size_t> countsOfClasses(const SizeDistribution& sizes, std::size_t grains) {
    const std::vector<Class> classes = sizes.classes();
    std::vector<std::size_t> counts;
    std::vector<double> remainders;
    std::size_t given = 0;
    for (const Class& c : classes) {
        const double exact = c.number * static_cast<double>(grains);
        counts.push_back(static_cast<std::size_t>(exact));
        remainders.push_back(exact - std::floor(exact));
        given += counts.back();
    }
    std::vector<std::size_t> order(classes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
    for (std::size_t k = 0; given < grains; k = (k + 1) % order.size(), ++given) ++counts[order[k]];
    return counts;
}

std::vector<double> exactRadii(const SizeDistribution& sizes, std::size_t grains) {
    refuseTooMany(grains);
    const std::vector<Class> classes = sizes.classes();
    refuseTooFew(classes, grains);
    const std::vector<std::size_t> counts = countsOfClasses(sizes, grains);
    std::vector<double> radii;
    radii.reserve(grains);
    for (std::size_t k = 0; k < classes.size(); ++k)
        if (counts[k] > 0) addClass(sizes, classes[k], counts[k], radii);
    std::sort(radii.rbegin(), radii.rend());
    return radii;
}

std::vector<double> randomRadii(const SizeDistribution& sizes, std::size_t grains, std::uint64_t seed) {
    refuseTooMany(grains);
    const CountedRandom random(seed);
    std::vector<double> radii;
    radii.reserve(grains);
    for (std::size_t k = 0; k < grains; ++k) {
        askForInterruption();
        radii.push_back(sizes.drawRadius(random, k));
    }
    return radii;
}

void shuffle(std::vector<double>& values, std::uint64_t seed) {
    const CountedRandom random(seed);
    for (std::size_t k = values.size(); k > 1; --k) {
        const auto other =
            static_cast<std::size_t>(random.uniform(k, purposeOfOrder) * static_cast<double>(k));
        std::swap(values[k - 1], values[other]);
    }
}

}  // namespace pendular
