#include <fmt/format.h>

#include <chrono>

#include "SelfTests/Fuzz/RandomScenes/Judge.h"

namespace pendular::fuzz {

namespace {

/// Leaves out what is not needed, the last first, until nothing more can be left out.
template <class List>
void thin(Recipe& recipe, List Recipe::*member, const std::function<bool(const Recipe&)>& hasFault) {
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t k = (recipe.*member).size(); k-- > 0;) {
            Recipe smaller = recipe;
            (smaller.*member).erase((smaller.*member).begin() + static_cast<std::ptrdiff_t>(k));
            if (!hasFault(smaller)) continue;
            recipe = std::move(smaller);
            changed = true;
        }
    }
}

/// The smallest number for which the fault is there still, by halving.
void lower(Recipe& recipe, int Recipe::*member, int from,
           const std::function<bool(const Recipe&)>& hasFault) {
    for (int value = from / 2; value > 0; value /= 2) {
        Recipe smaller = recipe;
        smaller.*member = value;
        if (!hasFault(smaller)) return;
        recipe = std::move(smaller);
    }
}

}  // namespace

Recipe minimise(const Recipe& recipe, const std::function<bool(const Recipe&)>& hasFault) {
    Recipe smallest = recipe;
    thin(smallest, &Recipe::features, hasFault);
    thin(smallest, &Recipe::wrong, hasFault);
    lower(smallest, &Recipe::steps, 256, hasFault);
    lower(smallest, &Recipe::grains, 64, hasFault);
    return smallest;
}

std::string report(const Recipe& recipe, const Verdict& verdict) {
    // What can be tried in a minute; each scene without an end takes seconds.
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    const Recipe smallest = minimise(recipe, [&](const Recipe& smaller) {
        return std::chrono::steady_clock::now() < until &&
               judge(smaller, {.seconds = 2}).kind() == verdict.kind();
    });
    const Verdict last = judge(smallest);
    return fmt::format(
        "seed {}: {}\nfound in: {}\nminimised: {}\n{}which {} with {}\n{}\nTo run it again: "
        "SelfTestFuzzRandomScenes --scene '{}'\n",
        recipe.seed, fmt::join(verdict.faults, "; "), recipe.text(), smallest.text(), last.record, last.end,
        fmt::join(last.faults, "; "), last.sentence, smallest.text());
}

}  // namespace pendular::fuzz
