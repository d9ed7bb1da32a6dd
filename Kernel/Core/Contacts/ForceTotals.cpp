#include "Kernel/Core/Contacts/ForceTotals.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pendular {

ForceQuantum::ForceQuantum(double pressure) {
    // A radius is less than 2 p, so that a force is at most 4 p^2 times the pressure. Without a stiffness any
    // quantum is as good: forces that do not fit are summed in order.
    constexpr double usual = 1e9;
    const double largest = pressure > 0 && std::isfinite(pressure) ? pressure : usual;
    setPerUnitForce(std::ldexp(1.0, std::ilogb(most / 4 / largest)));
}

void ForceTotals::Copy::clearMarked() {
    constexpr std::size_t step = OwnTotals::grainsOfAMark;
    for (std::size_t k = 0; k < marks.size(); ++k)
        if (marks[k] != 0)
            std::fill(totals.data() + k * step, totals.data() + std::min((k + 1) * step, totals.size()),
                      ForceTotal{});
}

void ForceTotals::begin(std::size_t grains, int threads) {
    if (!std::exchange(areZero, false)) {
        std::fill_n(first.data(), first.size(), ForceTotal{});
        for (Copy& copy : others) copy.clearMarked();
    }
    first.resize(grains);
    others.resize(static_cast<std::size_t>(threads - 1));
    for (Copy& copy : others) {
        copy.totals.resize(grains);
        copy.marks.assign(grains / OwnTotals::grainsOfAMark + 1, 0);
    }
}

OwnTotals ForceTotals::of(int thread) {
    if (thread == 0) return {first.data(), nullptr};
    Copy& copy = others[static_cast<std::size_t>(thread - 1)];
    return {copy.totals.data(), copy.marks.data()};
}

std::size_t ForceTotals::bytes() const {
    std::size_t sum = first.bytes();
    for (const Copy& copy : others) sum += copy.totals.bytes() + copy.marks.capacity();
    return sum;
}

}  // namespace pendular
