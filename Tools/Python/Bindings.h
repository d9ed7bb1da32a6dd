#pragma once

#include "Tools/Python/PythonScene.h"

/// The parts of the module: each adds its classes, functions and methods, in a file of its name.

namespace pendular::python {

using SceneClass = py::class_<PythonScene, std::shared_ptr<PythonScene>>;

/// What a function that takes long returns; other threads of Python go on meanwhile.
template <class Function>
auto withoutPython(const Function& function) {
    const py::gil_scoped_release others;
    return function();
}

void bindSpecies(py::module_& module, SceneClass& scene);
void bindSizes(py::module_& module);
void bindRegions(py::module_& module, SceneClass& scene);
void bindGrains(SceneClass& scene);
void bindGrainArrays(SceneClass& scene);
void bindBodies(py::module_& module, SceneClass& scene);
void bindWalls(py::module_& module, SceneClass& scene);
void bindMembranes(py::module_& module, SceneClass& scene);
void bindHostWalls(py::module_& module, SceneClass& scene);
void bindRun(SceneClass& scene);
void bindSpace(SceneClass& scene);
void bindFlows(SceneClass& scene);
void bindLiquid(SceneClass& scene);
void bindContacts(SceneClass& scene);
void bindFields(SceneClass& scene);
void bindOutputs(SceneClass& scene);
void bindParts(SceneClass& scene);
void bindBonds(SceneClass& scene);
void bindHeat(SceneClass& scene);
void bindFluid(py::module_& module, SceneClass& scene);
void bindSoftness(py::module_& module, SceneClass& scene);
void bindCollisions(py::module_& module);
void bindResults(py::module_& module);

}  // namespace pendular::python
