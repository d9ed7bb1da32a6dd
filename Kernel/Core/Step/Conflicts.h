#pragma once

#include <span>
#include <string>
#include <string_view>

#include "Kernel/Core/Step/Feature.h"

namespace pendular {

/// Two features that one scene cannot have.
struct Conflict {
    Feature a, b;
    std::string_view why, advice;  // parts of a sentence: "images ... move past walls", "leave the walls out"
};

/// All of them that the kernel knows.
[[nodiscard]] std::span<const Conflict> conflicts();

/// Those of several ranks: what they cannot share yet.
[[nodiscard]] std::span<const Conflict> conflictsOfRanks();

/// Throws InputError with one sentence if a scene has both features of a conflict.
void refuseConflicts(const Features& scene, std::span<const Conflict> table = conflicts());
/// Throws InputError with one sentence for a conflict in which one of these features takes part.
void refuseConflictsOf(const Features& some, const Features& scene);

/// The sentence for a scene: what cannot be combined, why, and what to do instead.
[[nodiscard]] std::string sentence(const Conflict& conflict, const Features& scene);

/// The matrix for the documentation, in Markdown: which features go together, and the sentence of each that
/// do not.
[[nodiscard]] std::string conflictMatrix();

}  // namespace pendular
