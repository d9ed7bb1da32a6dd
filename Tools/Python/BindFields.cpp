#include <fmt/format.h>

#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/Clusters.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

GrainGroups groupsNamed(const std::optional<std::string>& by, std::size_t species) {
    if (!by) return GrainGroups::none();
    if (*by == "species") return GrainGroups::bySpecies(species);
    unknownName("groups of fields", *by, {"species"});
}

/// How many species the grains have.
std::size_t speciesIn(const Scene& scene) {
    std::size_t count = 1;
    for (const std::uint16_t species : scene.particleHandler.store().species)
        count = std::max<std::size_t>(count, species + 1);
    return count;
}

py::dict fields(const PythonScene& scene, const std::string& coordinates, const Vec3D& lowest,
                const Vec3D& highest, double spacing, double width, const std::string& kernel,
                bool withContacts, const std::optional<std::string>& by) {
    const FieldGrid grid(coordinates, toVector(lowest), toVector(highest), spacing);
    const SmoothingKernel weight(kernelShapeNamed(kernel), grid.dimensions(), width);
    const FieldContent content = withContacts ? FieldContent::All : FieldContent::WithoutContacts;
    FieldSums sums(grid, weight, groupsNamed(by, speciesIn(scene.scene())), content);
    {
        const PythonScene::WithoutPython others(scene);
        GrainState state;
        takeState(scene.scene(), state, content);
        sums.add(state, scene.scene().getNumberOfThreads(), &askForInterruption);
    }
    py::dict made;
    std::vector<py::ssize_t> shape;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!grid.isResolved(axis)) continue;
        std::vector<double> places;
        for (std::size_t k = 0; k < grid.counts()[axis]; ++k) places.push_back(grid.at(axis, k));
        shape.push_back(static_cast<py::ssize_t>(places.size()));
        made[py::str(fmt::format("{}_m", grid.nameOf(axis)))] = arrayOf(std::move(places));
    }
    for (PolyDataField& field : fieldsOf(sums)) {
        std::vector<py::ssize_t> whole = shape;
        if (field.components == 9) whole.insert(whole.end(), {3, 3});
        else if (field.components > 1) whole.push_back(static_cast<py::ssize_t>(field.components));
        const py::str name(field.name);
        made[name] = arrayOf(std::move(field)).attr("reshape")(py::tuple(py::cast(whole)));
    }
    return made;
}

py::dict meanStressOf(const PythonScene& scene, std::optional<double> volume) {
    const MeanStress stress = volume ? meanStress(scene.scene(), *volume) : meanStress(scene.scene());
    py::dict made;
    made["total_Pa"] = arrayOf(stress.total()), made["kinetic_Pa"] = arrayOf(stress.kinetic);
    made["contact_Pa"] = arrayOf(stress.contact), made["capillary_Pa"] = arrayOf(stress.capillary);
    made["viscous_Pa"] = arrayOf(stress.viscous), made["pressure_Pa"] = stress.pressure();
    return made;
}

/// For each grain the number of its cluster, the largest first; and the size of each.
py::dict clusters(const PythonScene& scene, std::optional<double> distance) {
    const Clusters found =
        distance ? clustersWithin(scene.scene(), *distance) : clustersOfContacts(scene.scene());
    std::vector<std::int64_t> of(found.of.begin(), found.of.end()), sizes;
    for (const Cluster& cluster : found.list) sizes.push_back(static_cast<std::int64_t>(cluster.size));
    py::dict made;
    made["cluster"] = arrayOf(std::move(of)), made["size"] = arrayOf(std::move(sizes));
    return made;
}

void requireLedger(const PythonScene& scene) {
    if (!scene.scene().keepsEnergyLedger())
        throw InputError("The scene keeps no energy ledger; call keep_energy_ledger() before the run.");
}

py::dict energies(const PythonScene& scene) {
    requireLedger(scene);
    const EnergyLedger& ledger = scene.scene().energyLedger();
    py::dict made;
    for (const EnergyLedger::Entry& entry : EnergyLedger::entries())
        made[py::str(fmt::format("{}_J", entry.name))] = ledger.*entry.member;
    return made;
}

void writeFields(PythonScene& scene, const std::string& coordinates, const Vec3D& lowest,
                 const Vec3D& highest, double spacing, double width, double interval, double average,
                 const std::string& kernel, bool withContacts, bool againstFlow, bool hdf5,
                 const std::optional<std::string>& by, const std::string& name) {
    FieldOutput output(FieldGrid(coordinates, toVector(lowest), toVector(highest), spacing),
                       kernelShapeNamed(kernel), width);
    output.withInterval(interval).averagedOver(average).withName(name);
    if (!withContacts) output.withoutContacts();
    if (againstFlow) output.againstFlow();
    if (hdf5) output.asHdf5();
    output.withGroups(groupsNamed(by, scene.species.size()));
    scene.scene().addOutput(std::move(output));
}

}  // namespace

void bindFields(SceneClass& scene) {
    scene
        .def("fields", &fields, py::arg("coordinates"), py::arg("lowest"), py::arg("highest"),
             py::arg("spacing"), py::arg("width"), py::kw_only(), py::arg("kernel") = "gauss",
             py::arg("contacts") = true, py::arg("by") = py::none(),
             "Density, velocity, stress and others at the points of a grid, as of the last step.\n\n"
             "coordinates: those that are resolved (O, X, Y, Z, XY, XZ, YZ, XYZ, R, RZ); over the others of "
             "the box from lowest to highest (m) is averaged. spacing: m, between points. width: m, of the "
             "kernel (gauss, lucy, heaviside). contacts: stress of contacts, too. by='species': also of "
             "each. Returns x_m, y_m, z_m of the points, and the fields by the names that they have in the "
             "files of write_fields(): an axis for each coordinate, then vectors and tensors. Stress is "
             "positive in compression; coordination counts touches with grains and walls, fabric those "
             "with grains alone. With contacts, call initialise() before the first run(). Ctrl-C ends it.")
        .def("mean_stress", &meanStressOf, py::arg("volume") = py::none(),
             comment("MeanStress",
                     "volume: m^3; that of the periodic box where it is not given. Returns total_Pa, "
                     "kinetic_Pa, contact_Pa, capillary_Pa and viscous_Pa, 3 x 3 each, and pressure_Pa, a "
                     "third of the trace of the total."))
        .def("clusters", &clusters, py::arg("distance") = py::none(),
             "cluster: for each grain the number of its cluster, from the largest on; size: of each "
             "cluster, in grains. Grains are joined that touch or have a bridge, or, with a distance (m), "
             "whose centres are nearer.")
        .def(
            "keep_energy_ledger", [](PythonScene& s) { s.scene().keepEnergyLedger(); },
            comment("Scene::keepEnergyLedger"))
        .def(
            "keep_spring_energy", [](PythonScene& s) { s.scene().keepSpringEnergy(); },
            "Keeps the energy of the springs of contacts (spring_energy), which takes less time than the "
            "ledger.")
        .def_property_readonly(
            "spring_energy", [](const PythonScene& s) { return s.scene().springEnergy(); },
            "J, in the springs of the contacts. After keep_spring_energy() or keep_energy_ledger().")
        .def("energy", &energies,
             "The energies of the ledger (J) by their names, as in NAME-energy.csv: what the scene has, has "
             "lost, "
             "and was given. After keep_energy_ledger().")
        .def_property_readonly(
            "energy_unaccounted",
            [](const PythonScene& s) {
                requireLedger(s);
                return s.scene().energyUnaccountedFor();
            },
            comment("Scene::energyUnaccountedFor"))
        .def_property_readonly(
            "kinetic_energy", [](const PythonScene& s) { return s.scene().getKineticEnergy(); },
            "J, of the centres of the grains that can move")
        .def_property_readonly(
            "rotational_energy", [](const PythonScene& s) { return s.scene().getRotationalEnergy(); }, "J")
        .def_property_readonly(
            "total_mass", [](const PythonScene& s) { return s.scene().getTotalMass(); },
            "kg, of the grains that can move")
        .def_property_readonly(
            "centre_of_mass", [](const PythonScene& s) { return s.scene().getCentreOfMass(); }, "m")
        .def_property_readonly(
            "momentum", [](const PythonScene& s) { return s.scene().getTotalMomentum(); }, "kg m/s")
        .def("write_fields", &writeFields, py::arg("coordinates"), py::arg("lowest"), py::arg("highest"),
             py::arg("spacing"), py::arg("width"), py::kw_only(), py::arg("interval"),
             py::arg("average") = 0.0, py::arg("kernel") = "gauss", py::arg("contacts") = true,
             py::arg("against_flow") = false, py::arg("hdf5") = false, py::arg("by") = py::none(),
             py::arg("name") = "coarse",
             "Fields at the points of a grid over the run, averaged over time: files as fields() has them "
             "now. With up to one coordinate NAME-coarse.csv with rows of all averages, else "
             "NAME-coarse.pvd for ParaView, or NAME-coarse.h5.\n\n"
             "coordinates, lowest, highest (m), spacing (m), width (m), kernel: as in fields(). interval: "
             "s, between two samples; average: s, over which they are averaged; 0: each is a row. contacts: "
             "stress of contacts, too. against_flow: velocities are those against the flow of shear and "
             "strain. hdf5: write NAME-coarse.h5. by='species': also of each. name: in the place of coarse. "
             "Raises InputError.");
}

}  // namespace pendular::python
