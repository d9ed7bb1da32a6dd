#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

/// x, y, z or 0, 1, 2. Throws InputError for others.
int axisOf(const py::object& axis) {
    const std::string name = py::str(axis);
    for (int k = 0; k < 3; ++k)
        if (name == std::string(1, static_cast<char>('x' + k)) || name == std::to_string(k)) return k;
    refuseGiven(axis, "An axis", "'x', 'y' or 'z', or 0, 1 or 2");
}

}  // namespace

void bindSpace(SceneClass& scene) {
    scene
        .def_property(
            "gravity", [](const PythonScene& s) { return s.scene().getGravity(); },
            [](PythonScene& s, const Vec3D& g) { s.scene().setGravity(g); }, "m/s^2; may be set during a run")
        .def(
            "set_domain",
            [](PythonScene& s, const Vec3D& lowest, const Vec3D& highest) {
                s.scene().setDomain(lowest, highest);
            },
            py::arg("lowest"), py::arg("highest"), comment("DomainBox", "lowest, highest: m, its corners."))
        .def_property_readonly(
            "domain",
            [](const PythonScene& s) { return py::make_tuple(s.scene().getMin(), s.scene().getMax()); },
            "Lowest and highest corner (m) that set_domain() has given.")
        .def(
            "set_periodic",
            [](PythonScene& s, const py::object& axis, double lowest, double highest) {
                s.scene().setPeriodic(axisOf(axis), lowest, highest);
            },
            py::arg("axis"), py::arg("lowest"), py::arg("highest"),
            comment("Scene::setPeriodic", "axis: 'x', 'y' or 'z', or 0, 1 or 2; lowest, highest: m."))
        .def_property_readonly(
            "period",
            [](const PythonScene& s) {
                const PeriodicBox& box = s.scene().getPeriodicBox();
                return py::make_tuple(arrayOf(box.lowest), arrayOf(box.length));
            },
            "Lowest corner and lengths (m) of the periodic box as it is now; a length of 0: not periodic.")
        .def(
            "set_lees_edwards",
            [](PythonScene& s, const py::object& flow, const py::object& gradient, double rate) {
                s.scene().setLeesEdwards(axisOf(flow), axisOf(gradient), rate);
            },
            py::arg("flow"), py::arg("gradient"), py::arg("rate"),
            comment("Scene::setLeesEdwards",
                    "flow, gradient: axes, 'x', 'y' or 'z', or 0, 1 or 2; rate: 1/s."))
        .def_property(
            "shear_rate", [](const PythonScene& s) { return s.scene().getShearRate(); },
            [](PythonScene& s, double rate) { s.scene().setShearRate(rate); },
            "1/s, in the last step; set in a run, in a scene with set_lees_edwards(), it holds from the "
            "next step on, and all grains get the change of the flow")
        .def(
            "set_target_shear_stress",
            [](PythonScene& s, double stress, double time, std::optional<double> largest) {
                s.scene().setTargetShearStress(stress, time, largest);
            },
            py::arg("stress"), py::arg("time"), py::arg("largest_rate") = py::none(),
            comment("Scene::setTargetShearStress",
                    "stress: Pa; time: s; largest_rate: 1/s, 1 / time if it is not given."))
        .def(
            "set_strain_rate",
            [](PythonScene& s, const py::object& axis, double rate) {
                s.scene().setStrainRate(axisOf(axis), rate);
            },
            py::arg("axis"), py::arg("rate"),
            comment("Scene::setStrainRate",
                    "axis: 'x', 'y' or 'z'; rate: 1/s, negative where it gets shorter."))
        .def(
            "strain_rate",
            [](const PythonScene& s, const py::object& axis) {
                return s.scene().getStrainRate(axisOf(axis));
            },
            py::arg("axis"), comment("Scene::getStrainRate"))
        .def(
            "set_target_stress",
            [](PythonScene& s, const py::object& axis, double stress, double time,
               std::optional<double> largest) {
                s.scene().setTargetStress(axisOf(axis), stress, time, largest);
            },
            py::arg("axis"), py::arg("stress"), py::arg("time"), py::arg("largest_rate") = py::none(),
            comment("Scene::setTargetStress",
                    "axis: 'x', 'y' or 'z'; stress: Pa; time: s; largest_rate: 1/s."))
        .def(
            "flow_at",
            [](const PythonScene& s, const ArrayLike& places) {
                const Doubles rows = rowsOf(places, "places", 3);
                std::vector<Vector<double>> flow;
                for (py::ssize_t k = 0; k < rows.size() / 3; ++k)
                    flow.push_back(
                        toVector(s.scene().shearFlowAt({rows.at(k, 0), rows.at(k, 1), rows.at(k, 2)})));
                return arrayOf(std::move(flow));
            },
            py::arg("places"), comment("Scene::shearFlowAt", "places: N x 3, m. Returns N x 3, m/s."));
}

}  // namespace pendular::python
