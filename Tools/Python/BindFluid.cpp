#include <fmt/format.h>

#include <cmath>

#include "Kernel/Features/Fluid/ColumnFlow.h"
#include "Kernel/Features/Fluid/FluidPart.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/PartSettings.h"

namespace pendular::python {

namespace {

/// The fluid of a scene, for Python.
struct FluidHandle : Handle {
    FluidHandle(PythonScene& scene, FluidPart& of, const ColumnFlow* column)
        : Handle(scene), part(&of), flow(column) {}
    FluidPart* part;
    const ColumnFlow* flow;  // null where another host computes the fluid

    /// nz x ny x nx, and more for each cell.
    [[nodiscard]] std::vector<py::ssize_t> shape(std::initializer_list<py::ssize_t> more = {}) const {
        const auto& cells = part->grid().cells;
        std::vector<py::ssize_t> all{cells[2], cells[1], cells[0]};
        all.insert(all.end(), more);
        return all;
    }
    [[nodiscard]] const FluidFields& fields() const {
        owner->requireThisThread();
        return part->fields();
    }
    [[nodiscard]] py::array numbers(const std::vector<double>& of) const {
        return arrayOf(std::vector<double>(of), shape());
    }
    [[nodiscard]] py::array vectors(const std::vector<Vector<double>>& of) const {
        std::vector<Vector<double>> rows = of;
        return arrayOf(std::move(rows)).attr("reshape")(shape({3}));
    }
};

/// A fluid that an object of Python computes.
class PythonFluid : public FluidHost {
public:
    PythonFluid(PythonScene& of, const py::object& given)
        : scene(of), settings(given, "add_fluid(): the host") {
        for (const char* const name : {"find_velocity", "find_pressure", "take"}) {
            if (!py::hasattr(given, name)) {
                if (std::string_view(name) == "take") continue;  // it may do without
                throw InputError(fmt::format("add_fluid(): the host has no function {}().", name));
            }
            const py::object function = given.attr(name);
            if (PyCallable_Check(function.ptr()) == 0)
                refuseGiven(function, fmt::format("add_fluid(): {} of the host", name), "a function");
            functions.emplace(name, scene.keep(function));
        }
    }

    void findVelocity(const FluidGrid& /*grid*/, FluidFields& fields, double time) override {
        ask("find_velocity", fields.velocity, time);
    }
    void findPressure(const FluidGrid& /*grid*/, FluidFields& fields,
                      const Vector<double>& gravity) override {
        ask("find_pressure", fields.pressureGradient, toEigen(gravity));
    }
    void take(const FluidGrid& /*grid*/, const FluidFields& /*fields*/, double length) override {
        if (functions.contains("take")) scene.ask([&] { (*functions.at("take"))(handle(), length); });
    }
    void compareSetUp(StateArchive& archive, double /*now*/) override { settings.compare(archive); }
    FluidPart* part = nullptr;

private:
    [[nodiscard]] FluidHandle handle() const { return {scene, *part, nullptr}; }

    template <class Argument>
    void ask(const std::string& name, std::vector<Vector<double>>& field, const Argument& argument) {
        scene.ask([&] {
            const py::object answer = (*functions.at(name))(handle(), argument);
            fill(field, answer, name);
        });
    }
    void fill(std::vector<Vector<double>>& field, const py::object& answer, const std::string& name) const {
        const py::object shape = py::cast(handle().shape({3}));
        Doubles rows;
        try {
            rows = arrayOrNone<Doubles>(py::module_::import("numpy").attr("broadcast_to")(answer, shape));
        } catch (const py::error_already_set& error) {
            if (!error.matches(PyExc_Exception)) throw;
        }
        if (!rows || rows.size() != static_cast<py::ssize_t>(3 * field.size())) {
            throw InputError(name +
                             "(): the host must return three numbers for each cell, as an array of the "
                             "shape (nz, ny, nx, 3), or three for all of them.");
        }
        for (py::ssize_t k = 0; k < rows.size(); ++k)
            if (!std::isfinite(rows.data()[k]))
                throw InputError(fmt::format(
                    "{}(): the host returned {} for cell {} (x fastest, from 0); it must be a finite "
                    "number.",
                    name, rows.data()[k], k / 3));
        const double* from = rows.data();
        for (Vector<double>& vector : field) vector = {from[0], from[1], from[2]}, from += 3;
    }

    PythonScene& scene;
    PartSettings settings;
    std::map<std::string, std::shared_ptr<py::function>> functions;
};

PressureModel modelNamed(const std::string& model) {
    if (model == "A") return PressureModel::A;
    if (model == "B") return PressureModel::B;
    unknownName("model of the pressure", model, {"A", "B"});
}

/// m/s over the time: a number, or a function of Python.
std::function<double(double)> speedOf(PythonScene& scene, const py::object& given) {
    if (PyCallable_Check(given.ptr()))
        return [kept = scene.keep(py::function(given)), &scene](double time) {
            return scene.ask([&] {
                return valueOf<double>((*kept)(time), "What the function superficial_speed returns",
                                       "a number (m/s)");
            });
        };
    const auto value = valueOf<double>(given, "add_fluid(): superficial_speed",
                                       "a number (m/s), or a function of the time (s) that returns one");
    checkValue("add_fluid()", "superficial_speed", value, "m/s", anyFinite);
    return [value](double) { return value; };
}

double numberFor(const std::string& function, const char* name, const Given<double>& given,
                 const char* unit) {
    return valueOf(given, function + "(): " + name, fmt::format("a number ({})", unit));
}

FluidMaterial materialOf(const std::string& function, const Given<double>& density,
                         const Given<double>& viscosity) {
    const FluidMaterial fluid{numberFor(function, "density", density, "kg/m^3"),
                              numberFor(function, "viscosity", viscosity, "Pa s")};
    checkFields(fluid);
    return fluid;
}

FluidHandle addFluid(PythonScene& scene, const Given<Vec3D>& lowest, const Given<Vec3D>& highest,
                     const Given<std::array<int, 3>>& cells, const Given<double>& density,
                     const Given<double>& viscosity, const Given<std::string>& law,
                     const Given<std::string>& model, const py::object& superficialSpeed,
                     const py::object& host) {
    if (superficialSpeed.is_none() == host.is_none())
        throw InputError(
            "add_fluid() takes a superficial_speed (m/s), of a column, or a host that computes the fluid.");
    const FluidGrid grid{toVector(vectorOf(lowest.object, "add_fluid(): lowest")),
                         toVector(vectorOf(highest.object, "add_fluid(): highest")),
                         valueOf(cells, "add_fluid(): cells", "three whole numbers (nx, ny, nz)")};
    const FluidMaterial fluid = materialOf("add_fluid", density, viscosity);
    const DragLaw& drag = dragLaw(valueOf(law, "add_fluid(): drag_law", "a name of drag_laws()"));
    const PressureModel pressure = modelNamed(valueOf(model, "add_fluid(): model", "'A' or 'B'"));
    const auto add = [&](auto computes) {
        auto* const flow = computes.get();
        return std::pair{flow,
                         &scene.scene().addPart<FluidPart>(grid, fluid, drag, std::move(computes), pressure)};
    };
    if (host.is_none()) {
        const auto [flow, part] = add(std::make_unique<ColumnFlow>(fluid, speedOf(scene, superficialSpeed)));
        return {scene, *part, flow};
    }
    const auto [flow, part] = add(std::make_unique<PythonFluid>(scene, host));
    flow->part = part;
    return {scene, *part, nullptr};
}

double pressureDrop(const FluidHandle& fluid) {
    if (!fluid.flow)
        throw InputError("pressure_drop: the host of this fluid knows it; only a column has it.");
    return fluid.flow->pressureDrop();
}

py::array cellCentres(const FluidHandle& fluid) {
    const FluidGrid& grid = fluid.part->grid();
    const Vector<double> cell = grid.spacing();
    std::vector<Vector<double>> centres;
    for (int k = 0; k < grid.cells[2]; ++k)
        for (int j = 0; j < grid.cells[1]; ++j)
            for (int i = 0; i < grid.cells[0]; ++i)
                centres.push_back(grid.lowest +
                                  Vector<double>{(i + 0.5) * cell.x, (j + 0.5) * cell.y, (k + 0.5) * cell.z});
    return fluid.vectors(centres);
}

const DragLaw& lawFor(const std::string& function, const Given<std::string>& law) {
    return dragLaw(valueOf(law, function + "(): law", "a name of drag_laws()"));
}

double dragForceOf(const Given<std::string>& law, const Given<double>& porosity, const Given<double>& slip,
                   const Given<double>& diameter, const Given<double>& density,
                   const Given<double>& viscosity) {
    const std::string name = "drag_force";
    return dragForce(lawFor(name, law), numberFor(name, "porosity", porosity, "1"),
                     numberFor(name, "slip", slip, "m/s"), numberFor(name, "diameter", diameter, "m"),
                     materialOf(name, density, viscosity));
}

double terminalSpeedOf(const Given<double>& diameter, const Given<double>& grainDensity,
                       const Given<double>& density, const Given<double>& viscosity,
                       const Given<double>& gravity) {
    const std::string name = "terminal_speed";
    return terminalSpeed(numberFor(name, "diameter", diameter, "m"),
                         numberFor(name, "grain_density", grainDensity, "kg/m^3"),
                         materialOf(name, density, viscosity), numberFor(name, "gravity", gravity, "m/s^2"));
}

double balancedSpeedOf(const Given<std::string>& law, const Given<double>& porosity,
                       const Given<double>& diameter, const Given<double>& grainDensity,
                       const Given<double>& density, const Given<double>& viscosity,
                       const Given<double>& gravity) {
    const std::string name = "balanced_speed";
    return balancedSpeed(lawFor(name, law), numberFor(name, "porosity", porosity, "1"),
                         numberFor(name, "diameter", diameter, "m"),
                         numberFor(name, "grain_density", grainDensity, "kg/m^3"),
                         materialOf(name, density, viscosity), numberFor(name, "gravity", gravity, "m/s^2"));
}

void bindDragLaws(py::module_& module) {
    module.def(
        "drag_laws",
        [] {
            std::vector<std::string> names;
            for (const DragLaw& law : dragLaws()) names.emplace_back(law.name);
            return names;
        },
        "Names of the drag laws that add_fluid() takes.");
    module.def(
        "drag_force", &dragForceOf, py::arg("law"), py::arg("porosity"), py::arg("slip"), py::arg("diameter"),
        py::kw_only(), py::arg("density"), py::arg("viscosity"),
        "N: the drag of a law (model A) on a sphere (diameter, m) among others (porosity, 1) in a fluid "
        "(density, kg/m^3; viscosity, Pa s) that goes past it with this velocity between the grains "
        "(slip, m/s). As in a scene, it is that at a porosity of 0.35 below that.");
    module.def("terminal_speed", &terminalSpeedOf, py::arg("diameter"), py::arg("grain_density"),
               py::kw_only(), py::arg("density"), py::arg("viscosity"), py::arg("gravity") = 9.81,
               comment("terminalSpeed",
                       "diameter: m; grain_density: kg/m^3; density, "
                       "viscosity: of the fluid, kg/m^3 and Pa s; gravity: "
                       "m/s^2."));
    module.def("balanced_speed", &balancedSpeedOf, py::arg("law"), py::arg("porosity"), py::arg("diameter"),
               py::arg("grain_density"), py::kw_only(), py::arg("density"), py::arg("viscosity"),
               py::arg("gravity") = 9.81,
               comment("balancedSpeed",
                       "law: the name of a drag law; porosity: 1; diameter: of the grains, m; "
                       "grain_density: kg/m^3; density, viscosity: of the fluid, kg/m^3 and Pa s; gravity: "
                       "m/s^2."));
}

}  // namespace

void bindFluid(py::module_& module, SceneClass& scene) {
    const auto vectors = [](std::vector<Vector<double>> FluidFields::*field) {
        return [field](const FluidHandle& f) { return f.vectors(f.fields().*field); };
    };
    py::class_<FluidHandle>(module, "Fluid", collectHandles<FluidHandle>(),
                            "The fluid of a scene: fields of the last step, or in a function of its host of "
                            "this one, as arrays (nz, ny, nx) and (nz, ny, nx, 3).")
        .def_property_readonly("cell_centres", &cellCentres, "m")
        .def_property_readonly(
            "porosity", [](const FluidHandle& f) { return f.numbers(f.fields().porosity); },
            "1 - volume of grains / volume of the cell.")
        .def_property_readonly("solid_flux", vectors(&FluidFields::solidFlux),
                               "m/s: volume of grains times velocity, over the volume of the cell.")
        .def_property_readonly("drag", vectors(&FluidFields::drag), "N/m^3, of model A on the grains.")
        .def_property_readonly("source", vectors(&FluidFields::source),
                               "N/m^3: what the grains have given the fluid in the last step.")
        .def_property_readonly("velocity", vectors(&FluidFields::velocity), "m/s, between the grains.")
        .def_property_readonly("pressure_gradient", vectors(&FluidFields::pressureGradient),
                               "Pa/m, with that of the fluid's weight.")
        .def_property_readonly("pressure_drop", &pressureDrop, comment("ColumnFlow::pressureDrop"))
        .def_property_readonly(
            "drag_impulse", [](const FluidHandle& f) { return toEigen(f.part->dragImpulse()); },
            comment("FluidPart::dragImpulse"))
        .def_property_readonly(
            "work", [](const FluidHandle& f) { return f.part->ledger().work; }, "J, on all grains that move.")
        .def_property_readonly(
            "impulse", [](const FluidHandle& f) { return toEigen(f.part->ledger().impulse); },
            "N s, on all grains.");
    scene.def(
        "add_fluid", &addFluid, py::arg("lowest"), py::arg("highest"), py::arg("cells"), py::kw_only(),
        py::arg("density"), py::arg("viscosity"), py::arg("drag_law") = "Gidaspow", py::arg("model") = "A",
        py::arg("superficial_speed") = py::none(), py::arg("host") = py::none(),
        "A fluid (density in kg/m^3, viscosity in Pa s) between the grains, on a grid of cells (nx, ny, nz) "
        "from the lowest to the highest corner (m), of three grain diameters or more each; returns its "
        "Fluid.\n\n"
        "superficial_speed: m/s, a number or a function of the time: a column of 1 x 1 x nz cells, up which "
        "it flows. host: an object that computes the fluid in each step by find_velocity(fluid, time) in m/s "
        "between the grains and find_pressure(fluid, gravity), the gradient of the pressure in Pa/m, both "
        "(nz, ny, nx, 3) or three numbers; and learns by take(fluid, step), if it has that, what the grains "
        "gave (fluid.source). drag_law: one of drag_laws(). model: how the pressure is counted, A or B. "
        "Raises InputError.");
    bindDragLaws(module);
}

}  // namespace pendular::python
