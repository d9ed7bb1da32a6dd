#pragma once

#include <string_view>

namespace pendular {

class Scene;
struct PeriodicBox;

/// Throws InputError before the contacts of a scene are listed for the first time, which initialise() does:
/// until then they have no laws and no box, also while parts of the step begin. For functions that are given
/// a scene from outside.
/// @param call the function, as users call it: "fields()"
void requireListedContacts(const Scene& scene, std::string_view call);

/// The box of the contacts; before they are listed, that of the scene.
[[nodiscard]] const PeriodicBox& boxOfContacts(const Scene& scene);

}  // namespace pendular
