#include <fmt/format.h>

#include <set>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/SpeciesValues.h"

namespace pendular::python {

namespace {

/// law, field, unit, range and value of all that can be set, each once.
py::list describe(AnyLaws& laws) {
    py::list rows;
    std::set<std::string> listed;
    for (const NamedSetter& setter : laws.setters())
        for (const SetterValue& value : setter.values) {
            const std::string name = nameOfSetter(setter, value);
            if (!listed.insert(name).second) continue;
            rows.append(py::make_tuple(std::string(setter.law), name, std::string(value.unit),
                                       value.range.text(value.unit),
                                       setter.values.size() == 1 && setter.get ? setter.get() : unset));
        }
    return rows;
}

/// All names that addByName() knows.
std::vector<std::string> knownSpecies() {
    std::vector<std::string> names;
    for (const std::string_view name : instantiatedSpecies()) names.push_back(withoutEnding(name));
    for (const std::string_view name : registeredSpecies()) names.push_back(withoutEnding(name));
    return names;
}

SpeciesHandle addSpecies(PythonScene& scene, const std::string& type, const py::kwargs& given) {
    const Values values = valuesOf(given);
    if (type.find_first_of(" ./") != std::string::npos)
        throw InputError(fmt::format("'{}' is no name of a species; pendular.species() lists them.", type));
    // All of it is checked before anything is added.
    const auto other = scene.superquadrics() ? makeShapedScene(typeNamed(type)) : makeScene();
    setValues(other->addSpecies(typeNamed(type)), values);
    AnySpecies& added = scene.addSpecies(typeNamed(type));
    setValues(added, values);
    scene.species.push_back(&added);
    return {scene, added};
}

}  // namespace

void bindSpecies(py::module_& module, SceneClass& scene) {
    py::class_<SpeciesHandle> material(module, "Species", collectHandles<SpeciesHandle>(),
                                       "A material of a scene; add_species() makes it.");
    refuseCopies(material, "it is a part of its scene; hand its numbers on.");
    compareBy(material, [](const SpeciesHandle& s) { return s.getIndex(); });
    material.def_property_readonly("index", &SpeciesHandle::getIndex, "Its number in the scene, from 0.")
        .def_property_readonly(
            "name", [](const SpeciesHandle& s) { return withoutEnding(s.species->getName()); },
            "Normal, friction and adhesion law.")
        .def(
            "set",
            [](const SpeciesHandle& s, const py::kwargs& values) {
                s.owner->requireThisThread(), s.owner->requireMayChange();
                setValues(*s.species, valuesOf(values));
            },
            "Sets fields by their names, also during a run: from the next step on. Raises InputError.")
        .def(
            "get",
            [](const SpeciesHandle& s, const std::string& name) {
                for (const NamedSetter& setter : s.species->setters())
                    if (setter.name == camelCase(name)) return s.species->get(setter.name);
                if (!togetherWith(*s.species, name).empty())
                    throw InputError(fmt::format(
                        "{} can be set and not read, as fields are computed from it; fields() has them.",
                        name));
                refuseName(*s.species, camelCase(name));
            },
            py::arg("name"), "A field by its name; NaN where it is not set.")
        .def(
            "fields", [](const SpeciesHandle& s) { return describe(*s.species); },
            "Rows (law, field, unit, range, value) of all that can be set.")
        .def("__repr__", [](const SpeciesHandle& s) {
            return fmt::format("<pendular.Species {}: {}, {:g} kg/m^3>", s.getIndex(),
                               withoutEnding(s.species->getName()), s.species->getDensity());
        });

    scene
        .def_property_readonly(
            "species",
            [](PythonScene& s) {
                std::vector<SpeciesHandle> all;
                for (AnySpecies* const one : s.species) all.emplace_back(s, *one);
                return all;
            },
            "The materials, in the order of their indices, which grain_species has.")
        .def("add_species", &addSpecies, py::arg("type"),
             "Adds a material by the name of its laws (pendular.species() lists them), with its fields: "
             "density (kg/m^3), those of pendular.fields(type), or young_modulus (Pa) and poisson_ratio, "
             "restitution_coefficient, and others that fields are computed from. Raises InputError.")
        .def(
            "set_pair",
            [](PythonScene& s, const SpeciesHandle& a, const SpeciesHandle& b,
               std::optional<std::string> type, const py::kwargs& values) {
                a.requireOf(s, "species"), b.requireOf(s, "species");
                const std::string name(type ? typeNamed(*type) : std::string(a.species->getName()));
                if (!type && a.species->getName() != b.species->getName())
                    throw InputError(
                        "set_pair() of two materials of different types needs the type of their laws.");
                setValues(s.lawsOfPair(*a.species, *b.species, name), valuesOf(values));
            },
            py::arg("a"), py::arg("b"), py::arg("type") = py::none(),
            "Gives the contacts of two materials, a and b, values of their own, and, where the materials "
            "have different types, the type of their laws. What is not given is mixed from both.");

    module.def("species", &knownSpecies,
               "The names of all species that are compiled into this module. Others: a library for "
               "load_species(), or a build with their names in -DPENDULAR_PYTHON_SPECIES.");
    module.def(
        "fields", [](const std::string& type) { return describe(makeScene()->addSpecies(typeNamed(type))); },
        py::arg("type"),
        "Rows (law, field, unit, range, default) of all that add_species() takes for a type.");
}

}  // namespace pendular::python
