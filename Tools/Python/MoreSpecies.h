#pragma once

namespace pendular::python {

/// From now on scenes know the species of PENDULAR_PYTHON_SPECIES by their names, besides the popular ones.
void registerMoreSpecies();

}  // namespace pendular::python
