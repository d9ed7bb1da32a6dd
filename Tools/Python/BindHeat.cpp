#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

namespace {

Conduction conductionNamed(const std::string& law) {
    if (law == "constriction") return Conduction::Constriction;
    if (law == "area_over_distance") return Conduction::AreaOverDistance;
    unknownName("law of conduction", law, {"constriction", "area_over_distance"});
}

void conduct(PythonScene& scene, double temperature, const std::string& law, double softening) {
    if (scene.heat) throw InputError("conduct_heat() was called before for this scene.");
    checkValue("conduct_heat", "temperature", temperature, "K", notNegative);
    checkValue("conduct_heat", "softening", softening, "", positiveUpTo(1));
    const Conduction conduction = conductionNamed(law);
    scene.heat = &scene.scene().addPart<HeatPart>(
        scene.scene().particleHandler.addColumn("temperature", "K", temperature));
    scene.heat->setConduction(conduction);
    scene.heat->setSoftening(softening);
}

HeatPart& heatOf(const PythonScene& scene) {
    if (scene.heat) return *scene.heat;
    throw InputError("Grains of this scene have no temperature; call conduct_heat() first.");
}

int numberOf(const PythonScene& scene, const WallHandle& wall) {
    wall.requireOf(scene, "wall");
    return static_cast<int>(wall.number);
}

py::dict heatLedger(const PythonScene& scene) {
    const HeatPart& part = heatOf(scene);
    const HeatLedger& heat = part.ledger();
    py::dict made, ofWalls;
    for (const int wall : part.wallsOfHeat()) ofWalls[py::int_(wall)] = part.fromWall(wall);
    made["stored_J"] = heat.stored, made["from_walls_J"] = heat.fromWalls;
    made["from_each_wall_J"] = ofWalls;
    made["from_contacts_J"] = heat.fromContacts, made["to_walls_J"] = heat.toWalls;
    made["from_driver_J"] = heat.fromDriver;
    return made;
}

}  // namespace

void bindHeat(SceneClass& scene) {
    scene
        .def(
            "conduct_heat", &conduct, py::arg("temperature") = 293.0, py::kw_only(),
            py::arg("law") = "constriction", py::arg("softening") = 1.0,
            "Gives the grains a temperature (K), which is their column `temperature`: heat is conducted "
            "where they touch, at set-up of the scene.\n\n"
            "law: 'constriction', 2 k a with the contact radius a of the contact laws (Hertz's, or that of a "
            "sintered or JKR's neck), or 'area_over_distance', as MercuryDPM's Thermal species. softening: "
            "for grains that are softer than their material, the ratio of the moduli of simulated and real "
            "grains, up to 1; only with Hertz's or JKR's contact radius. Every material of the scene needs "
            "set_heat_material(). Raises InputError.")
        .def(
            "set_heat_material",
            [](PythonScene& s, const SpeciesHandle& species, double conductivity, double heatCapacity) {
                species.requireOf(s, "species");
                heatOf(s).setMaterial(&species, {conductivity, heatCapacity});
            },
            py::arg("species"), py::kw_only(), py::arg("conductivity"), py::arg("heat_capacity"),
            "Heat in the grains and walls of a material, the species: conductivity, W/(m K), 0 for an "
            "insulator; heat_capacity, J/(kg K). Raises InputError.")
        .def(
            "hold_temperature",
            [](PythonScene& s, const WallHandle& wall, double temperature,
               std::optional<double> conductivity) {
                heatOf(s).holdWall(numberOf(s, wall), temperature, conductivity);
            },
            py::arg("wall"), py::arg("temperature"), py::arg("conductivity") = py::none(),
            comment("HeatPart::holdWall", "wall: of this scene; temperature: K; conductivity: W/(m K)."))
        .def(
            "insulate",
            [](PythonScene& s, const WallHandle& wall) { heatOf(s).insulateWall(numberOf(s, wall)); },
            py::arg("wall"), "A wall that had a temperature conducts no heat any more.")
        .def(
            "heat_by_contacts", [](PythonScene& s, bool heats) { heatOf(s).heatByContacts(heats); },
            py::arg("heats") = true, comment("HeatPart::heatByContacts", "heats: or no more."))
        .def("heat", &heatLedger,
             "The heat of the scene, J: stored_J, of all grains; from_walls_J, of held temperatures, the sum "
             "of from_each_wall_J, a dict by the numbers of the walls, positive into the grains; "
             "from_contacts_J, what contacts have lost, as far as it went into grains; to_walls_J, what of "
             "it went into walls; from_driver_J. What is stored is the sum of what came from all three.")
        .def_property_readonly(
            "longest_heat_step", [](const PythonScene& s) { return heatOf(s).longestStep(); },
            comment("HeatPart::longestStep"));
}

}  // namespace pendular::python
