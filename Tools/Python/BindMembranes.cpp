#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

namespace {

WallHandle addMembrane(PythonScene& scene, const SpeciesHandle& species, const py::object& mesh,
                       const MembraneMaterial& material, double scale, bool holdRim, double pressure,
                       double damping) {
    Membrane membrane;
    membrane.set(trianglesOf(mesh, scale), material);
    if (holdRim) membrane.holdRim();
    if (pressure != 0) membrane.setPressure(pressure);
    if (damping != 0) membrane.setDamping(damping);
    return addWall(scene, species, membrane, false);
}

py::array cornersOf(const std::vector<Triangle>& triangles) {
    std::vector<Vector<double>> corners;
    for (const Triangle& triangle : triangles)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    const auto count = static_cast<py::ssize_t>(triangles.size());
    return arrayOf(std::move(corners)).attr("reshape")(count, 3, 3);
}

/// Throws InputError where another program moves the vertices.
Membrane& ownMembrane(const WallHandle& wall, std::string_view what) {
    auto& membrane = wall.as<Membrane>(what);
    if (membrane.isOfHost())
        throw InputError(
            fmt::format("wall {}: it is a host wall, which has no {} of its own; move its vertices by "
                        "set_vertex_velocities() or set_vertex_targets().",
                        wall.number, what));
    return membrane;
}

/// The vertices for which a function of Python is true.
void hold(const WallHandle& wall, const py::function& where, const Vec3D& velocity) {
    ownMembrane(wall, "vertices")
        .hold([&](const Vec3D& place) { return wall.owner->ask([&] { return isTrue(where(place)); }); },
              velocity);
}

/// A mesh where it is now: its faces, which are convex, as triangles with the numbers of vertices.
struct IndexedMesh {
    std::vector<Vector<double>> vertices;  // m
    std::vector<std::int64_t> corners;     // three for each triangle

    explicit IndexedMesh(const TriangleWall& wall) {
        std::map<std::array<double, 3>, std::int64_t> known;
        const auto numberOf = [&](const Vector<double>& place) {
            const auto [at, isNew] =
                known.try_emplace({place.x, place.y, place.z}, static_cast<std::int64_t>(vertices.size()));
            if (isNew) vertices.push_back(place);
            return at->second;
        };
        for (const auto& face : wall.surface({}).polygons)
            for (std::size_t k = 2; k < face.size(); ++k)
                for (const std::size_t corner : {std::size_t{0}, k - 1, k})
                    corners.push_back(numberOf(face[corner]));
    }
};

/// Null for walls of other kinds. Throws as WallHandle::seen().
const TriangleWall* meshOf(const WallHandle& wall) {
    return dynamic_cast<const TriangleWall*>(&wall.seen<Wall>("triangles"));
}

template <class Of>
py::array vertices(const WallHandle& wall, Of&& of) {
    const auto& membrane = wall.seen<Membrane>("vertices");
    std::vector<Vector<double>> rows;
    for (std::size_t k = 0; k < membrane.getNet().vertices().size(); ++k)
        rows.push_back(toVector(of(membrane, k)));
    return arrayOf(std::move(rows));
}

py::array triangles(const WallHandle& wall) {
    std::vector<std::int64_t> corners;
    if (const TriangleWall* const mesh = meshOf(wall)) corners = IndexedMesh(*mesh).corners;
    else
        for (const auto& triangle : wall.seen<Membrane>("triangles").getNet().triangles())
            corners.insert(corners.end(), triangle.begin(), triangle.end());
    const auto count = static_cast<py::ssize_t>(corners.size() / 3);
    return arrayOf(std::move(corners), {count, 3});
}

WearLaw wearLaw(const std::string& law, const py::kwargs& given) {
    const auto value = [&](const char* name) {
        if (!given.contains(name))
            throw InputError(std::string("keep_wear('") + law + "') needs " + name + ".");
        return valueOf<double>(given[name], name, "a number");
    };
    if (law == "none") return WearLaw::none();
    if (law == "reye") return WearLaw::reye(value("factor"));
    if (law == "archard") return WearLaw::archard(value("coefficient"), value("hardness"));
    if (law == "finnie") return WearLaw::finnie(value("cutting_share"), value("flow_stress"));
    unknownName("law of wear", law, {"none", "reye", "archard", "finnie"});
}

/// Throws InputError for a value that the law does not take, which would be lost.
void refuseOthers(const std::string& law, const py::kwargs& given) {
    const std::map<std::string, std::vector<std::string_view>> taken{
        {"none", {}},
        {"reye", {"factor"}},
        {"archard", {"coefficient", "hardness"}},
        {"finnie", {"cutting_share", "flow_stress"}}};
    const auto known = taken.find(law);
    if (known == taken.end()) return;  // wearLaw() has refused it
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        if (std::ranges::count(known->second, name) == 0)
            throw InputError(fmt::format("keep_wear('{}') takes no {}.", law, name));
    }
}

void keepWear(const WallHandle& wall, const std::string& law, std::optional<double> interval,
              double acceleration, const py::kwargs& values) {
    TriangleWall& mesh = wall.as<TriangleWall>("wear");
    const WearLaw worn = wearLaw(law, values);
    refuseOthers(law, values);
    if (!interval && acceleration != 1)
        throw InputError(
            "keep_wear(): acceleration is of vertices that move by the wear; give the interval (s) between "
            "their moves too.");
    if (interval && law == "none")
        throw InputError(
            "keep_wear('none') wears nothing off, so that no vertices move; leave interval (s) out.");
    if (!interval) return mesh.keepWear(worn);
    mesh.keepWear(worn, {.interval = *interval, .acceleration = acceleration});
}

py::dict wear(const WallHandle& wall) {
    const WornTriangles& worn = wall.as<TriangleWall>("wear").getWear();
    const auto column = [&](double SurfaceWear::*what) {
        std::vector<double> numbers;
        for (std::size_t k = 0; k < worn.size(); ++k) numbers.push_back(worn.of(k).*what);
        return arrayOf(std::move(numbers));
    };
    py::dict made;
    made["sliding_work_J"] = column(&SurfaceWear::slidingWork);
    made["impact_work_J"] = column(&SurfaceWear::impactWork);
    made["impacts"] = column(&SurfaceWear::impacts);
    made["worn_volume_m3"] = column(&SurfaceWear::volume);
    made["area_m2"] = column(&SurfaceWear::area);
    return made;
}

}  // namespace

void bindMembranes(py::module_& module, SceneClass& scene) {
    auto wall = py::class_<WallHandle>(module.attr("Wall"));
    wall.def("hold", &hold, py::arg("where"), py::arg("velocity") = Vec3D(0, 0, 0), comment("Membrane::hold"))
        .def(
            "hold_rim", [](const WallHandle& w, const Vec3D& v) { ownMembrane(w, "rim").holdRim(v); },
            py::arg("velocity") = Vec3D(0, 0, 0),
            comment("Membrane::holdRim", "velocity: m/s, with which they move from now on."))
        .def(
            "set_pressure", [](const WallHandle& w, double p) { ownMembrane(w, "pressure").setPressure(p); },
            py::arg("pressure"),
            "A pressure on the membrane, also in a run: it acts from the end of the next step on.\n\n"
            "pressure: Pa, pushes along the normals (of corners that run counter-clockwise towards the "
            "eye); negative against them.")
        .def_property_readonly(
            "volume", [](const WallHandle& w) { return w.seen<Membrane>("volume").getVolume(); },
            comment("Membrane::getVolume"))
        .def_property_readonly(
            "vertices",
            [](const WallHandle& w) {
                if (const TriangleWall* const mesh = meshOf(w)) return arrayOf(IndexedMesh(*mesh).vertices);
                return vertices(w, [](const Membrane& m, std::size_t k) { return m.getPosition(k); });
            },
            "m, N x 3: where the vertices of a mesh, a membrane or a host wall are now.")
        .def_property_readonly(
            "triangles", &triangles,
            "N x 3: the numbers of the vertices at their corners. Of a mesh, triangles that "
            "lie in one plane may be others than those that were given, on the same faces; "
            "of one with keep_wear() they are the same.")
        .def_property_readonly(
            "vertex_velocities",
            [](const WallHandle& w) {
                return vertices(w, [](const Membrane& m, std::size_t k) { return m.getVelocity(k); });
            },
            "m/s, N x 3")
        .def_property_readonly(
            "vertex_forces",
            [](const WallHandle& w) {
                return vertices(w, [](const Membrane& m, std::size_t k) { return m.getForceOfGrains(k); });
            },
            "N, N x 3: of the grains on each vertex, at the end of the last step.")
        .def_property_readonly(
            "elastic_energy",
            [](const WallHandle& w) { return w.seen<Membrane>("springs").getElasticEnergy(); }, "J")
        .def("keep_wear", &keepWear, py::arg("law"), py::arg("interval") = py::none(),
             py::arg("acceleration") = 1.0,
             "Counts what grains wear off each triangle of a mesh, by a law: reye (factor, m^3/J), archard "
             "(coefficient, hardness in Pa), finnie (cutting_share, flow_stress in Pa), or none. With an "
             "interval (s) the vertices move by it, times acceleration. At set-up.")
        .def("wear", &wear, "Columns of what was done to each triangle: sliding_work_J, worn_volume_m3, ...");

    scene.def(
        "add_membrane",
        [](PythonScene& s, const SpeciesHandle& species, const py::object& mesh, double youngModulus,
           double thickness, double density, double scale, bool holdRim, double pressure, double damping) {
            return addMembrane(s, species, mesh, {youngModulus, thickness, density}, scale, holdRim, pressure,
                               damping);
        },
        py::arg("species"), py::arg("mesh"), py::kw_only(), py::arg("young_modulus"), py::arg("thickness"),
        py::arg("density"), py::arg("scale") = 1.0, py::arg("hold_rim") = false, py::arg("pressure") = 0.0,
        py::arg("damping") = 0.0,
        comment("Membrane",
                "species: the material of its surface. mesh: the name of a file (STL, OBJ, PLY), or an "
                "array of triangles, N x 3 x 3 numbers; scale: m for one unit of it. young_modulus: Pa; "
                "thickness: m; density: kg/m^3. hold_rim: its free edges stay. pressure: Pa, along the "
                "normals; damping: 1/s, a force of this rate times mass and velocity on each vertex."));

    module.def(
        "membrane_sheet",
        [](int columns, int rows, double edge) { return cornersOf(membraneSheet(columns, rows, edge)); },
        py::arg("columns"), py::arg("rows"), py::arg("edge"), comment("membraneSheet"));
    module.def(
        "membrane_tube",
        [](double radius, double height, int around) {
            return cornersOf(membraneTube(radius, height, around));
        },
        py::arg("radius"), py::arg("height"), py::arg("around"), comment("membraneTube"));
}

}  // namespace pendular::python
