#pragma once

#include "Tools/Python/Numbers.h"

namespace pendular::python {

/// With which a function ends for which there is no memory; explainArguments() says which.
inline constexpr const char* outOfMemory = "There is not enough memory.";

/// One sentence for arguments of other types and names, of all that is in the module by then.
void explainArguments(py::module_& module);

}  // namespace pendular::python
