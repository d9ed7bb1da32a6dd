#pragma once

#include <cstddef>
#include <vector>

namespace pendular {

/// A choice, of which less is better in both numbers.
struct CostAndError {
    double cost, error;
};

/// Whether each choice lies on the Pareto front: no other is as good in both numbers and better in one. What
/// is not a number is never on it.
inline std::vector<bool> paretoFront(const std::vector<CostAndError>& choices) {
    const auto beats = [](const CostAndError& one, const CostAndError& other) {
        return one.cost <= other.cost && one.error <= other.error &&
               (one.cost < other.cost || one.error < other.error);
    };
    std::vector<bool> onFront;
    for (const CostAndError& choice : choices) {
        bool best = choice.cost == choice.cost && choice.error == choice.error;
        for (const CostAndError& other : choices) best = best && !beats(other, choice);
        onFront.push_back(best);
    }
    return onFront;
}

}  // namespace pendular
