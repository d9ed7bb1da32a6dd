#include "Tools/Python/MoreSpecies.h"

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Python/PythonSpecies.h"

namespace pendular::python {

void registerMoreSpecies() {
    PythonSpecies::forEach([]<class S>() { registerSpecies<S>(); });
}

}  // namespace pendular::python
