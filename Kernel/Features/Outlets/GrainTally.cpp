#include "Kernel/Features/Outlets/GrainTally.h"

#include <algorithm>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void GrainTally::setClasses(std::span<const double> diameters) {
    double before = 0;
    for (const double border : diameters) {
        checkValue("Outlet", "border of size classes", border, "m",
                   {before, diameterRange.highest, false, true});
        before = border;
    }
    borders.assign(diameters.begin(), diameters.end());
    entries.clear();
}

void GrainTally::add(std::size_t species, double radius, double mass) {
    const auto sizeClass = static_cast<std::size_t>(
        std::upper_bound(borders.begin(), borders.end(), 2 * radius) - borders.begin());
    if (species >= speciesCount()) entries.resize((species + 1) * classCount());
    const std::size_t entry = species * classCount() + sizeClass;
    ++entries[entry].number;
    ofThisStep[entry].add(mass);
}

void GrainTally::endStep() {
    for (const auto& [entry, mass] : ofThisStep) entries[entry].mass += mass.value();
    ofThisStep.clear();
}

double GrainTally::lowest(std::size_t sizeClass) const { return sizeClass == 0 ? 0 : borders[sizeClass - 1]; }
double GrainTally::highest(std::size_t sizeClass) const {
    return sizeClass < borders.size() ? borders[sizeClass] : infinity;
}

GrainTally::Entry GrainTally::of(std::size_t species, std::size_t sizeClass) const {
    return species < speciesCount() ? entries[species * classCount() + sizeClass] : Entry{};
}

GrainTally::Entry GrainTally::all() const {
    Entry sum;
    for (const Entry& entry : entries) {
        sum.number += entry.number;
        sum.mass += entry.mass;
    }
    return sum;
}

void GrainTally::compareSetUp(StateArchive& archive) const {
    archive.same<double>("classBorders", std::span<const double>(borders), "m");
}

void GrainTally::visitState(StateArchive& archive) {
    std::vector<std::uint64_t> numbers;
    std::vector<double> masses;
    for (const Entry& entry : entries) numbers.push_back(entry.number), masses.push_back(entry.mass);
    archive.column<std::uint64_t>("numbers", numbers);
    archive.column<double>("masses", masses);
    archive.requireFinite("masses", masses);
    archive.require(numbers.size() == masses.size() && numbers.size() % classCount() == 0, "numbers",
                    "does not fit the classes");
    entries.clear();
    for (std::size_t k = 0; k < numbers.size(); ++k) entries.push_back({numbers[k], masses[k]});
}

}  // namespace pendular
