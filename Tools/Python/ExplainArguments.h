#pragma once

#include "Tools/Python/Numbers.h"

namespace pendular::python {

/// One sentence for arguments of other types and names, of all that is in the module by then.
void explainArguments(py::module_& module);

}  // namespace pendular::python
