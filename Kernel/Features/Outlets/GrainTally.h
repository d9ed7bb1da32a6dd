#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

class StateArchive;

/// How many grains, and how much mass, by species and by class of size.
class GrainTally {
public:
    struct Entry {
        std::uint64_t number = 0;
        double mass = 0;  // kg
    };

    /// Borders (m) of the classes: from one diameter up to, and without, the next one. What is smaller or
    /// larger is in a class of its own. Throws InputError unless they rise, and are above 0.
    void setClasses(std::span<const double> diameters);
    /// A grain that goes in this step. @param radius m; @param mass kg
    void add(std::size_t species, double radius, double mass);
    /// All that go in this step have been added: their masses count, whose sums are exact, so that it does
    /// not matter which went first.
    void endStep();

    [[nodiscard]] std::size_t speciesCount() const { return entries.size() / classCount(); }
    [[nodiscard]] std::size_t classCount() const { return borders.size() + 1; }
    /// The limits (m) of a class of diameters; 0 and infinity at the ends.
    [[nodiscard]] double lowest(std::size_t sizeClass) const;
    [[nodiscard]] double highest(std::size_t sizeClass) const;
    /// What was counted of a species and a class of size; nothing where no grain of the species has come.
    [[nodiscard]] Entry of(std::size_t species, std::size_t sizeClass) const;
    [[nodiscard]] Entry all() const;

    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive);

private:
    std::vector<double> borders;                 // m, diameters
    std::vector<Entry> entries;                  // by species, then class
    std::map<std::size_t, ExactSum> ofThisStep;  // kg, by the number of the entry
};

}  // namespace pendular
