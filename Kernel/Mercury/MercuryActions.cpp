#include "Kernel/Mercury/MercuryActions.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void MercuryActions::add(ActsInSteps* one) {
    if (hasBegun && all.empty())
        throw InputError(
            "A boundary that acts in each step is added in a run that began without any; add it at set-up.");
    all.push_back(one);
}

void MercuryActions::compareSetUp(StateArchive& archive, StepContext& scene) {
    archive.same("count", static_cast<std::uint64_t>(all.size()));
    for (std::size_t k = 0; k < all.size(); ++k)
        archive.group(fmt::format("boundary {}", k), [&] { all[k]->compareSetUp(archive, scene.time); });
}

void MercuryActions::visitState(StateArchive& archive, StepContext& /*scene*/) {
    for (std::size_t k = 0; k < all.size(); ++k)
        archive.group(fmt::format("boundary {}", k), [&] { all[k]->visitState(archive); });
}

}  // namespace pendular
