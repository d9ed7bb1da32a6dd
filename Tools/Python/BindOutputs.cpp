#include <fmt/format.h>

#include <map>
#include <utility>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

/// Rows of all grains, which a function of Python makes for each frame. Frames ask for the grains in the
/// order of identities, so a grain that is not behind the last one begins a new frame.
class RowsOfFrame {
public:
    /// @param numbers of a row: 1, or 3 of a vector
    RowsOfFrame(PythonScene& of, std::string called, py::function function, py::ssize_t numbers)
        : scene(of), name(std::move(called)), make(of.keep(std::move(function))), width(numbers) {}

    /// Those of one grain.
    const double* operator()(std::size_t identity) {
        // Identities grow within a frame, and a frame has all grains.
        if (at >= rows.size() || identity <= last) {
            rows = ofAll();
            at = 0;
        }
        last = identity;
        return &rows[std::exchange(at, at + static_cast<std::size_t>(width))];
    }

private:
    std::vector<double> ofAll() {
        return scene.askForOwnRows([&] {
            const Doubles made = arrayOrNone<Doubles>((*make)(scene.object()));
            const auto count = static_cast<py::ssize_t>(scene.scene().particleHandler.store().count());
            if (!made || made.ndim() != (width == 1 ? 1 : 2) || made.size() != count * width) {
                throw InputError(
                    fmt::format("The function of the field {} must return {} for each of {} grains.", name,
                                width == 3 ? "three numbers" : "a number", count));
            }
            return std::vector<double>(made.data(), made.data() + made.size());
        });
    }

    PythonScene& scene;
    std::string name;
    std::shared_ptr<py::function> make;
    py::ssize_t width;
    std::vector<double> rows;
    std::size_t at = 0, last = 0;  // the next number of the rows; the identity of the last grain
};

using Functions = std::map<std::string, py::function>;

template <class Output>
void addFrames(PythonScene& scene, Output output, double interval, bool contacts, bool contactPoints,
               bool stress, bool doubles, const Functions& numbers, const Functions& vectors) {
    if (contactPoints && !contacts)
        throw InputError(
            "contact_points are columns of the contacts, which contacts=False leaves out; leave one of them "
            "out.");
    output.withInterval(interval).withContacts(contacts).withContactPoints(contactPoints);
    output.withStress(stress).withDoubles(doubles);
    for (const auto& [name, function] : numbers) {
        const auto rows = std::make_shared<RowsOfFrame>(scene, name, function, 1);
        output.addField(name, [rows](std::size_t grain) { return *(*rows)(grain); });
    }
    for (const auto& [name, function] : vectors) {
        const auto rows = std::make_shared<RowsOfFrame>(scene, name, function, 3);
        output.addField(name, [rows](std::size_t grain) {
            const double* const row = (*rows)(grain);
            return Eigen::Vector3d(row[0], row[1], row[2]);
        });
    }
    scene.scene().addOutput(std::move(output));
}

void addParaView(PythonScene& scene, double interval, bool contacts, bool contactPoints, bool stress,
                 bool doubles, const Functions& numbers, const Functions& vectors, bool parts) {
    addFrames(scene, ParaViewOutput().withParts(parts), interval, contacts, contactPoints, stress, doubles,
              numbers, vectors);
}
void addHdf5(PythonScene& scene, double interval, bool contacts, bool contactPoints, bool stress,
             bool doubles, const Functions& numbers, const Functions& vectors) {
    addFrames(scene, Hdf5Output(), interval, contacts, contactPoints, stress, doubles, numbers, vectors);
}
/// How both kinds of frames are bound. @param more arguments and the text
template <class Function, class... More>
void bindFrames(SceneClass& scene, const char* name, Function function, const More&... more) {
    scene.def(name, function, py::arg("interval"), py::kw_only(), py::arg("contacts") = true,
              py::arg("contact_points") = false, py::arg("stress") = false, py::arg("doubles") = false,
              py::arg("fields") = Functions{}, py::arg("vectors") = Functions{}, more...);
}

template <class Table>
void addTable(PythonScene& scene, double interval) {
    scene.scene().addOutput(Table(interval));
}

}  // namespace

void bindOutputs(SceneClass& scene) {
    bindFrames(
        scene, "write_paraview", &addParaView, py::arg("parts") = false,
        "Writes NAME.pvd, which ParaView opens, with a frame at each multiple of the interval (s).\n\n"
        "contacts, contact_points, stress: these as well; doubles: of 64 bits, not of 32. fields, vectors: "
        "what else the grains are to have, a function for each name (which ends with the unit): f(scene) "
        "returns N numbers, or N x 3. parts: on several ranks, each writes a file of its own grains.");
    bindFrames(scene, "write_hdf5", &addHdf5,
               "Writes NAME-fields.h5, which frames() reads, with a frame at each multiple of "
               "the interval (s); contacts, contact_points, stress, doubles, fields and vectors are "
               "as in write_paraview().");
    scene
        .def("write_energy", &addTable<EnergyFile>, py::arg("interval"),
             comment("EnergyFile", "interval: s, between two rows."))
        .def("write_wall_forces", &addTable<WallForceFile>, py::arg("interval"),
             comment("WallForceFile", "interval: s, between two rows."))
        .def("write_inlets", &addTable<InletFile>, py::arg("interval"),
             comment("InletFile", "interval: s, between two rows."))
        .def("write_outlets", &addTable<OutletFile>, py::arg("interval"),
             comment("OutletFile", "interval: s, between two rows."))
        .def("write_flux", &addTable<FluxFile>, py::arg("interval"),
             comment("FluxFile", "interval: s, between two rows."))
        .def(
            "write_mercury",
            [](PythonScene& s, std::size_t steps) {
                s.scene().addOutput(MercuryOutput().withEnergies(s.scene().keepsSpringEnergy()));
                s.scene().setSaveCount(steps);
            },
            py::arg("steps"), comment("MercuryOutput", "steps: between two frames."))
        .def(
            "write_summary", [](PythonScene& s) { s.scene().addOutput(RunSummary()); },
            comment("RunSummary"));
}

}  // namespace pendular::python
