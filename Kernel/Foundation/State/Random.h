#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// Random numbers that are the same on every machine and standard library (the engine's integers are fixed by
/// the standard, its distributions are not).
class UniformRandom {
public:
    explicit UniformRandom(std::uint64_t seed) : engine(seed) {}

    /// Evenly in [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }

    /// Every decade alike, in [low, high); both above 0.
    double logarithmic(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }

    void visitState(StateArchive& archive) {
        std::stringstream numbers;
        numbers << engine;
        std::string text = numbers.str();
        archive.text("generator", text);
        numbers.str(text);
        numbers >> engine;
        archive.require(!numbers.fail(), "generator", "is not the state of one");
    }

private:
    std::mt19937_64 engine;
};

}  // namespace pendular
