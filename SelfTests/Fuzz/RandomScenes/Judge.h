#pragma once

#include <functional>
#include <string>
#include <vector>

#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

namespace pendular::fuzz {

class Making;

/// How the scene of a recipe ended, and what of it is not as it must be.
struct Verdict {
    /// "ended", "refused" (set-up), "failed" (the run): with the sentence
    std::string end, sentence;
    /// Each begins with its kind and a colon.
    std::vector<std::string> faults;
    /// What its features have given to Pendular.
    std::string record;
    double seconds = 0;  // of processor time

    /// The kind of the first fault; empty without one.
    [[nodiscard]] std::string kind() const;
};

struct JudgeOptions {
    double seconds = 20;  // of processor time, after which a scene is one that does not end
    int restarts = 1;     // in the run that is compared; with one at a step of the recipe, else evenly spread
    /// What a test adds to the scene at the end of its set-up, to see whether it is found.
    std::function<void(Making&)> sabotage = {};
};

/// Runs the scene of a recipe in a process of its own, which may crash: with one thread from the start to the
/// end; and with one and three threads in turn, from restart file to restart file. What must hold: each run
/// ends, by itself or with one sentence and with no other exception; what Watch looks at; both runs end in
/// the same state, bit for bit, with the same sentence and with the same files.
Verdict judge(const Recipe& recipe, const JudgeOptions& options = {});

/// The smallest recipe with a fault of the same kind that is found by leaving out one feature after the
/// other, one wrong value after the other, then steps and grains.
Recipe minimise(const Recipe& recipe, const std::function<bool(const Recipe&)>& hasFault);

/// What a user is told of a recipe with a fault, minimised, and how to run it again.
std::string report(const Recipe& recipe, const Verdict& verdict);

}  // namespace pendular::fuzz
