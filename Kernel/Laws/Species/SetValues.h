#pragma once

#include <string_view>
#include <vector>

#include "Kernel/Laws/Species/AnySpecies.h"

namespace pendular {

/// The fields of a species (first = second), or of a pair with values of its own, where the driver sets them.
struct SetValues {
    int first, second;  // indices of species
    std::string_view type;
    std::vector<NamedField> fields;
};

}  // namespace pendular
