#include "Kernel/Output/EnergyFile.h"
#include "Kernel/Output/GrainFlowFiles.h"
#include "Kernel/Output/Hdf5Output.h"
#include "Kernel/Output/MercuryOutput.h"
#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Output/WallForceFile.h"
#include "Kernel/Simulation/RunSummary.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

template <class Output>
void addFrames(PythonScene& scene, double interval, bool contacts, bool stress, bool doubles) {
    scene.scene().addOutput(
        Output().withInterval(interval).withContacts(contacts).withStress(stress).withDoubles(doubles));
}

template <class Table>
void addTable(PythonScene& scene, double interval) {
    scene.scene().addOutput(Table(interval));
}

}  // namespace

void bindOutputs(SceneClass& scene) {
    scene
        .def("write_paraview", &addFrames<ParaViewOutput>, py::arg("interval"), py::kw_only(),
             py::arg("contacts") = true, py::arg("stress") = false, py::arg("doubles") = false,
             "Writes NAME.pvd, which ParaView opens, with a frame at each multiple of the interval (s).")
        .def(
            "write_hdf5", &addFrames<Hdf5Output>, py::arg("interval"), py::kw_only(),
            py::arg("contacts") = true, py::arg("stress") = false, py::arg("doubles") = false,
            "Writes NAME-fields.h5, which frames() reads, with a frame at each multiple of the interval (s).")
        .def("write_energy", &addTable<EnergyFile>, py::arg("interval"), comment("EnergyFile"))
        .def("write_wall_forces", &addTable<WallForceFile>, py::arg("interval"), comment("WallForceFile"))
        .def("write_inlets", &addTable<InletFile>, py::arg("interval"), comment("InletFile"))
        .def("write_outlets", &addTable<OutletFile>, py::arg("interval"), comment("OutletFile"))
        .def("write_flux", &addTable<FluxFile>, py::arg("interval"), comment("FluxFile"))
        .def(
            "write_mercury",
            [](PythonScene& s, std::size_t steps) {
                s.scene().addOutput(MercuryOutput().withEnergies(s.scene().keepsEnergyLedger()));
                s.scene().setSaveCount(steps);
            },
            py::arg("steps"), comment("MercuryOutput"))
        .def(
            "write_summary", [](PythonScene& s) { s.scene().addOutput(RunSummary()); },
            comment("RunSummary"));
}

}  // namespace pendular::python
