#include <cmath>

#include "Kernel/Features/Membranes/HostWall.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

namespace {

std::vector<Vec3D> vectorsOf(const ArrayLike& given, std::string_view name) {
    const Doubles rows = rowsOf(given, name, 3);
    std::vector<Vec3D> vectors;
    for (py::ssize_t k = 0; k < rows.size() / 3; ++k)
        vectors.emplace_back(rows.data()[3 * k], rows.data()[3 * k + 1], rows.data()[3 * k + 2]);
    return vectors;
}

std::vector<HostWall::Corners> cornersOf(const ArrayLike& given) {
    const Doubles rows = rowsOf(given, "triangles", 3);
    std::vector<HostWall::Corners> corners;
    for (py::ssize_t k = 0; k < rows.size(); ++k) {
        const double number = rows.data()[k];
        if (!(number >= 0 && number < 4e9 && number == std::floor(number)))
            throw InputError("triangles: the corners must be numbers of vertices, counted from 0.");
        if (k % 3 == 0) corners.emplace_back();
        corners.back()[static_cast<std::size_t>(k % 3)] = static_cast<std::uint32_t>(number);
    }
    return corners;
}

WallHandle addHostWall(PythonScene& scene, const SpeciesHandle& species, const py::object& mesh,
                       const std::optional<ArrayLike>& triangles, const Given<double>& unit) {
    const double scale = checkedMeshScale(valueOf(unit, "add_host_wall(): scale", "a number"));
    HostWall wall;
    if (triangles) {
        std::vector<Vec3D> vertices = vectorsOf({mesh}, "vertices");
        for (Vec3D& vertex : vertices) vertex *= scale;
        wall.set(vertices, cornersOf(*triangles));
    } else {
        wall.set(trianglesOf(mesh, scale));
    }
    return addWall(scene, species, wall, false);
}

HostWall& hostWall(const WallHandle& wall) { return wall.as<HostWall>("vertices that a host moves"); }

}  // namespace

void bindHostWalls(py::module_& module, SceneClass& scene) {
    auto wall = py::class_<WallHandle>(module.attr("Wall"));
    wall.def(
            "set_vertex_velocities",
            [](const WallHandle& w, const ArrayLike& v) {
                hostWall(w).setVelocities(vectorsOf(v, "velocities"));
            },
            py::arg("velocities"), comment("HostWall::setVelocities"))
        .def(
            "set_vertex_targets",
            [](const WallHandle& w, const ArrayLike& places, const Given<double>& time) {
                hostWall(w).setTargets(vectorsOf(places, "places"),
                                       valueOf(time, "set_vertex_targets(): time", "a number (s)"));
            },
            py::arg("places"), py::arg("time"), comment("HostWall::setTargets"))
        .def_property_readonly(
            "vertex_impulses",
            [](const WallHandle& w) {
                MembraneState::Column rows = w.seen<HostWall>("vertices that a host moves").state().impulse;
                return arrayOf(std::move(rows));
            },
            comment("HostWall::getImpulses"));
    scene.def("add_host_wall", &addHostWall, py::arg("species"), py::arg("mesh"),
              py::arg("triangles") = py::none(), py::kw_only(), py::arg("scale") = 1.0,
              comment("HostWall",
                      "species: of the surface; mesh: a file, "
                      "or vertices (n, 3) with triangles; "
                      "triangles: corners by their rows, (m, 3); "
                      "scale: m of a unit of the file."));
}

}  // namespace pendular::python
