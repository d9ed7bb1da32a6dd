#include "Kernel/Features/SizeDistributions/SizeDistribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/GaussLegendre.h"

namespace pendular {

namespace {

/// d^k; k may be negative.
double powerOfDiameter(double d, int k) {
    double result = 1;
    for (int n = std::abs(k); n > 0; --n) result *= d;
    return k < 0 ? 1 / result : result;
}

bool isSingle(const SizePanel& panel) { return panel.low == panel.high; }

/// Panels cut so that 16 nodes integrate d^k, k from -3 on, to round-off: on [a, 2a] the nearest singular
/// point, 0, lies on the ellipse with foci at the ends whose sum of half-axes is 5.8, and 5.8^-32 = 3e-25.
std::vector<SizePanel> cutByHalves(std::vector<SizePanel> panels) {
    const auto pieces = [](const SizePanel& p) {
        return std::max(1.0, std::ceil(std::log2(p.high / p.low) - 1e-9));
    };
    if (std::all_of(panels.begin(), panels.end(), [&](const SizePanel& p) { return pieces(p) == 1; }))
        return panels;
    std::vector<SizePanel> cut;
    for (const SizePanel& panel : panels) {
        const double n = pieces(panel);
        const auto border = [&](double k) {
            return k == n ? panel.high : panel.low * std::pow(panel.high / panel.low, k / n);
        };
        const auto value = [&](double d) {
            return std::lerp(panel.atLow, panel.atHigh, (d - panel.low) / (panel.high - panel.low));
        };
        if (n == 1) {
            cut.push_back(panel);
            continue;
        }
        for (double k = 0; k < n; ++k)
            cut.push_back(
                {border(k), border(k + 1), value(border(k)), value(border(k + 1)), panel.sizeClass});
    }
    return cut;
}

}  // namespace

std::string_view nameOf(SizeBasis basis) {
    constexpr std::array<std::string_view, 4> names{"number", "length", "area", "volume"};
    return names[static_cast<std::size_t>(basis)];
}

SizeDistribution::SizeDistribution(std::vector<SizePanel> given, SizeBasis shapeBasis,
                                   std::function<double(double)> shape)
    : panels(cutByHalves(std::move(given))), shapePower(static_cast<int>(shapeBasis)), law(std::move(shape)) {
    std::erase_if(panels, [](const SizePanel& p) { return p.atLow == 0 && p.atHigh == 0; });
    double total = 0;
    for (const SizePanel& panel : panels) total += panelMoment(0, panel, panel.low, panel.high);
    if (!(total > 0 && std::isfinite(total)))
        throw InputError("SizeDistribution: there are no grains between the smallest and the largest size.");
    for (SizePanel& panel : panels) {
        panel.atLow /= total;
        panel.atHigh /= total;
    }
    for (int k = 0; k < moments; ++k) {
        borders[k].reserve(panels.size() + 1);
        borders[k].push_back(0);
        for (const SizePanel& panel : panels)
            borders[k].push_back(borders[k].back() + panelMoment(k, panel, panel.low, panel.high));
    }
}

double SizeDistribution::numberDensity(const SizePanel& panel, double d) const {
    const double along = (d - panel.low) / (panel.high - panel.low);
    return std::lerp(panel.atLow, panel.atHigh, along) * (law ? law(d) : 1) * powerOfDiameter(d, -shapePower);
}

double SizeDistribution::panelMoment(int k, const SizePanel& panel, double from, double to) const {
    if (isSingle(panel)) return panel.atLow * powerOfDiameter(panel.low, k);
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (const QuadratureNode& node : gaussLegendre(16)) {
        const double d = middle + half * node.position;
        sum += node.weight * powerOfDiameter(d, k) * numberDensity(panel, d);
    }
    return half * sum;
}

double SizeDistribution::moment(int k, double from, double to) const {
    double sum = 0;
    auto panel = std::lower_bound(panels.begin(), panels.end(), from,
                                  [](const SizePanel& p, double d) { return p.high < d; });
    for (; panel != panels.end() && panel->low <= to; ++panel) {
        const double low = std::max(from, panel->low), high = std::min(to, panel->high);
        if (isSingle(*panel) || low < high) sum += panelMoment(k, *panel, low, high);
    }
    return sum;
}

double SizeDistribution::mean(int k, int m) const {
    const auto isOrder = [&](int order) { return order >= 0 && order < moments; };
    if (!isOrder(k) || !isOrder(m) || k == m)
        throw InputError(
            fmt::format("The mean diameter D[{},{}] of a size distribution: its orders must be two different "
                        "ones of 0 to "
                        "{}.",
                        k, m, moments - 1));
    return std::pow(moment(k) / moment(m), 1.0 / (k - m));
}

double SizeDistribution::cumulative(SizeBasis basis, double diameter) const {
    const int k = static_cast<int>(basis);
    const auto panel = std::upper_bound(panels.begin(), panels.end(), diameter,
                                        [](double d, const SizePanel& p) { return d < p.high; });
    double sum = borders[k][static_cast<std::size_t>(panel - panels.begin())];
    if (panel != panels.end() && panel->low < diameter) sum += panelMoment(k, *panel, panel->low, diameter);
    return sum / borders[k].back();
}

double SizeDistribution::density(SizeBasis basis, double diameter) const {
    const int k = static_cast<int>(basis);
    const auto panel = std::lower_bound(panels.begin(), panels.end(), diameter,
                                        [](const SizePanel& p, double d) { return p.high < d; });
    if (panel == panels.end() || diameter < panel->low) return 0;
    if (isSingle(*panel)) return infinity;
    return powerOfDiameter(diameter, k) * numberDensity(*panel, diameter) / borders[k].back();
}

/// The diameter up to which a panel has an amount of M_k: Newton's method, with a step of bisection wherever
/// it would leave the bracket.
double SizeDistribution::solve(int k, const SizePanel& panel, double amount) const {
    double low = panel.low, high = panel.high;
    const double all = panelMoment(k, panel, low, high);
    if (isSingle(panel) || amount <= 0) return low;
    if (amount >= all) return high;
    double d = low + (high - low) * amount / all;
    for (int step = 0; step < 200; ++step) {
        const double excess = panelMoment(k, panel, panel.low, d) - amount;
        if (excess == 0) return d;
        (excess > 0 ? high : low) = d;
        double next = d - excess / (powerOfDiameter(d, k) * numberDensity(panel, d));
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - d) <= 4e-16 * d) return next;  // two units in the last place
        d = next;
    }
    return d;
}

double SizeDistribution::quantile(SizeBasis basis, double fraction) const {
    checkValue("SizeDistribution", "fraction of a quantile", fraction, "", fromZeroTo(1));
    if (fraction == 1) return largest();
    const int k = static_cast<int>(basis);
    const double wanted = fraction * borders[k].back();
    // The first panel at whose end there is as much.
    const auto end = std::lower_bound(borders[k].begin() + 1, borders[k].end() - 1, wanted);
    const auto at = static_cast<std::size_t>(end - borders[k].begin()) - 1;
    return solve(k, panels[at], wanted - borders[k][at]);
}

std::vector<SizeDistribution::Class> SizeDistribution::classes() const {
    std::vector<Class> found;
    for (std::size_t at = 0; at < panels.size(); ++at) {
        if (at == 0 || panels[at].sizeClass != panels[at - 1].sizeClass)
            found.push_back({panels[at].low, 0, 0, 0});
        found.back().high = panels[at].high;
        found.back().number += borders[0][at + 1] - borders[0][at];
        found.back().volume += (borders[3][at + 1] - borders[3][at]) / borders[3].back();
    }
    return found;
}

}  // namespace pendular
