#pragma once

#include <pybind11/pybind11.h>

namespace pendular::python {

/// An object that was made by __new__() without __init__() has nothing of C++ in it: wherever it is used, as
/// self or as an argument, it is a TypeError from now on. After all classes of the module are bound.
void refuseUnmadeObjects(pybind11::module_& module);

}  // namespace pendular::python
