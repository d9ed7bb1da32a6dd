#include <fmt/format.h>

#include <utility>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

void WallHandle::refuse(std::string_view what, bool isRemoved) const {
    throw InputError(isRemoved
                         ? fmt::format("Wall {} was removed.", number)
                         : fmt::format("Wall {} has no {}: it is a wall of another kind.", number, what));
}

std::vector<Triangle> trianglesOf(const py::object& mesh, double scale) {
    if (py::isinstance<py::str>(mesh) || py::hasattr(mesh, "__fspath__"))
        return readTriangles(mesh.cast<std::filesystem::path>(), scale);
    const Doubles corners = arrayOrNone<Doubles>(mesh);
    if (!corners || corners.ndim() != 3 || corners.shape(1) != 3 || corners.shape(2) != 3) {
        throw InputError(
            "A mesh is the name of a file, or an array of triangles: N x 3 corners x 3 numbers.");
    }
    checkedMeshScale(scale);
    std::vector<Triangle> triangles(static_cast<std::size_t>(corners.shape(0)));
    const double* from = corners.data();
    for (Triangle& triangle : triangles)
        for (Vector<double>& corner : triangle) {
            corner = {scale * from[0], scale * from[1], scale * from[2]};
            from += 3;
        }
    return triangles;
}

namespace {

WallHandle addPlane(PythonScene& scene, const SpeciesHandle& species, const Vec3D& outward,
                    const Vec3D& point, bool forces) {
    InfiniteWall wall;
    wall.set(outward, point);
    return addWall(scene, species, wall, forces);
}

WallHandle addCylinder(PythonScene& scene, const SpeciesHandle& species, const Vec3D& axis,
                       const Vec3D& point, double radius, std::optional<bool> grainsInside,
                       std::optional<double> length, bool forces) {
    if (length) {
        if (grainsInside)
            throw InputError(
                "add_cylinder(): with length (m) it is a tube with grains on both sides; leave grains_inside "
                "out.");
        FiniteCylinder wall;
        wall.set(axis, point, radius, *length);
        return addWall(scene, species, wall, forces);
    }
    InfiniteCylinder wall;
    wall.set(axis, point, radius, grainsInside.value_or(true) ? CylinderSide::Inside : CylinderSide::Outside);
    return addWall(scene, species, wall, forces);
}

WallHandle addProfile(PythonScene& scene, const SpeciesHandle& species, const Vec3D& axis, const Vec3D& point,
                      const ArrayLike& profile, bool forces) {
    const Doubles rows = rowsOf(profile, "profile", 2);
    std::vector<ProfilePoint> line;
    for (py::ssize_t k = 0; k < rows.size() / 2; ++k) line.push_back({rows.at(k, 0), rows.at(k, 1)});
    AxisymmetricWall wall;
    wall.set(axis, point, std::move(line));
    return addWall(scene, species, wall, forces);
}

WallHandle addMesh(PythonScene& scene, const SpeciesHandle& species, const py::object& mesh, double scale,
                   bool forces) {
    TriangleWall wall;
    wall.set(trianglesOf(mesh, scale));
    return addWall(scene, species, wall, forces);
}

WallHandle addSolid(PythonScene& scene, const SpeciesHandle& species, const ArrayLike& normals,
                    const ArrayLike& points, const Vec3D& centre, double radius, bool forces) {
    const Doubles outward = rowsOf(normals, "normals", 3), places = rowsOf(points, "points", 3);
    if (outward.size() != places.size()) throw InputError("There must be as many points as normals.");
    std::vector<SolidFace> faces;
    for (py::ssize_t k = 0; k < outward.size() / 3; ++k)
        faces.push_back({{outward.at(k, 0), outward.at(k, 1), outward.at(k, 2)},
                         {places.at(k, 0), places.at(k, 1), places.at(k, 2)}});
    TriangleWall wall;
    wall.set(intersectionOfHalfSpaces(faces, centre, radius));
    return addWall(scene, species, wall, forces);
}

std::string kindOf(const WallHandle& handle) {
    Wall& wall = handle.wall();
    const auto is = [&]<class Kind>(const Kind*) { return dynamic_cast<Kind*>(&wall) != nullptr; };
    if (wall.isRemoved()) return "removed";
    if (is(static_cast<InfiniteWall*>(nullptr))) return "plane";
    if (is(static_cast<InfiniteCylinder*>(nullptr))) return "cylinder";
    if (is(static_cast<FiniteCylinder*>(nullptr))) return "tube";
    if (is(static_cast<AxisymmetricWall*>(nullptr))) return "profile";
    return wall.membrane() ? "membrane" : "mesh";
}

double liquidOf(const WallHandle& handle) {
    static_cast<void>(handle.wall());
    return handle.owner->scene().liquidOfWall(handle.number);
}

Eigen::Isometry3d poseOf(const py::object& answer) {
    const Doubles numbers = arrayOrNone<Doubles>(answer);
    if (!numbers || (numbers.size() != 3 && numbers.size() != 16)) {
        throw InputError(
            "The function of set_motion() must return a shift (three numbers, m), or a matrix 4 x 4.");
    }
    const double* const n = numbers.data();
    if (numbers.size() == 3) return Eigen::Isometry3d(Eigen::Translation3d(n[0], n[1], n[2]));
    Eigen::Isometry3d pose;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) pose.matrix()(row, column) = n[4 * row + column];
    return pose;
}

/// The pose of a wall as a function of Python: it returns a shift (m), or a matrix 4 x 4.
void setMotion(const WallHandle& handle, py::function function) {
    handle.as<RigidWall>("motion").setMotion(
        [kept = handle.owner->keep(std::move(function)), scene = handle.owner](double time) {
            return scene->ask([&] { return poseOf((*kept)(time)); });
        });
}

/// As frames have them.
py::dict polygons(const PythonScene& scene) {
    FrameContent content;
    content.contacts = false;
    PolyData made = content.of(scene.scene(), scene.boxOfPictures).walls.value_or(PolyData{});
    py::dict answer;
    answer["points_m"] = arrayOf(std::move(made.points));
    answer["ends"] = arrayOf(std::move(made.ends));
    for (PolyDataField& field : made.cellFields) answer[py::str(field.name)] = arrayOf(std::move(field));
    return answer;
}

void bindMotion(py::class_<WallHandle>& wall) {
    wall.def(
            "set_velocity",
            [](const WallHandle& w, const Vec3D& v) { w.as<RigidWall>("velocity").setVelocity(v); },
            py::arg("velocity"),
            "Moves the wall from now on.\n\n"
            "velocity: m/s; with an angular velocity, that of its point. It takes the place of what has "
            "moved the wall.")
        .def(
            "set_angular_velocity",
            [](const WallHandle& w, const Vec3D& spin, const Vec3D& point) {
                w.as<RigidWall>("velocity").setAngularVelocity(spin, point);
            },
            py::arg("spin"), py::arg("point") = Vec3D(0, 0, 0),
            "Turns the wall from now on.\n\n"
            "spin: rad/s, about an axis through the point (m; where it is now), which moves with "
            "set_velocity(). It takes the place of what has moved the wall.")
        .def("set_motion", &setMotion, py::arg("function"),
             "The pose of the wall by the time: function(time in s) returns a shift (m), three numbers, or "
             "a pose as a matrix 4 x 4, from the frame in which the wall was given to the scene. It is "
             "asked in each step, may read the scene and not change it.\n\n"
             "During a run, the wall is moved from where it is by what the function changes from then on. A "
             "restart file does not keep a function, so the scene that goes on has to be set up with it. "
             "Velocities are differences of poses within 2.4e-7 s.")
        .def(
            "set_surface_velocity",
            [](const WallHandle& w, const Vec3D& v) { w.as<RigidWall>("surface").setSurfaceVelocity(v); },
            py::arg("velocity"), comment("RigidWall::setSurfaceVelocity", "velocity: m/s."))
        .def(
            "velocity_at",
            [](const WallHandle& w, const Vec3D& point) {
                return w.as<RigidWall>("velocity").getVelocityAt(point);
            },
            py::arg("point"), comment("RigidWall::getVelocityAt"))
        .def_property_readonly(
            "pose",
            [](const WallHandle& w) {
                const Pose& pose = w.as<RigidWall>("pose").getPose();
                const Vector<double> origin = pose.place({0, 0, 0});
                Eigen::Matrix3d turn;
                for (int k = 0; k < 3; ++k)
                    turn.col(k) =
                        toEigen(pose.turn({k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}));
                return py::make_tuple(arrayOf(origin), arrayOf(turn));
            },
            "Shift (m) and matrix that bring the wall from where it was set to where it is.");
}

void bindDrives(py::class_<WallHandle>& wall) {
    wall.def(
            "set_piston",
            [](const WallHandle& w, double mass, double load) {
                w.as<InfiniteWall>("piston").setPiston(mass, load);
            },
            py::arg("mass"), py::arg("load"),
            comment("InfiniteWall::setPiston", "mass: kg; load: N, along the normal towards the grains."))
        .def(
            "set_target_force",
            [](const WallHandle& w, double force, double time, double largest) {
                w.as<InfiniteWall>("servo").setTargetForce(force, time, largest);
            },
            py::arg("force"), py::arg("time"), py::arg("largest_speed"),
            comment("InfiniteWall::setTargetForce",
                    "force: N, of the grains on the plane; time: s; largest_speed: m/s."))
        .def_property_readonly(
            "driven_velocity",
            [](const WallHandle& w) { return w.as<InfiniteWall>("drive").getDrivenVelocity(); },
            comment("InfiniteWall::getDrivenVelocity"))
        .def_property_readonly(
            "point", [](const WallHandle& w) { return arrayOf(w.as<InfiniteWall>("plane").pointOnPlane()); },
            "m, on a plane, where it is now")
        .def(
            "set_slider",
            [](const WallHandle& w, const Vec3D& direction, double mass, double force, double friction,
               double largestSpeed) {
                w.as<RigidWall>("body").setSlider(direction, {mass, force, friction, largestSpeed});
            },
            py::arg("direction"), py::kw_only(), py::arg("mass"), py::arg("force") = 0.0,
            py::arg("friction") = 0.0, py::arg("largest_speed") = infinity,
            comment("RigidWall::setSlider",
                    "direction: of any length; mass: kg; force: N, along it; friction: N, of its bearing, "
                    "against its motion; largest_speed: m/s."))
        .def(
            "set_rotor",
            [](const WallHandle& w, const Vec3D& axis, const Vec3D& point, double inertia, double torque,
               double friction, double largestSpin) {
                w.as<RigidWall>("body").setRotor(axis, point, {inertia, torque, friction, largestSpin});
            },
            py::arg("axis"), py::arg("point"), py::kw_only(), py::arg("inertia"), py::arg("torque") = 0.0,
            py::arg("friction") = 0.0, py::arg("largest_spin") = infinity,
            comment("RigidWall::setRotor",
                    "axis: of any length; point: m, on it; inertia: kg m^2, about it; torque: N m; "
                    "friction: N m, of its bearing, against its motion; largest_spin: rad/s."))
        .def(
            "set_free_body",
            [](const WallHandle& w, std::optional<double> density, std::optional<double> mass,
               const Vec3D& centre, const std::optional<ArrayLike>& inertia, const Vec3D& force,
               const Vec3D& torque) {
                if (density &&
                    (mass || inertia || !centre.isZero(0) || !force.isZero(0) || !torque.isZero(0)))
                    throw InputError(
                        "set_free_body() with density takes no mass, centre, inertia, force or torque; give "
                        "mass and inertia instead of density.");
                if (density) return w.as<TriangleWall>("density").setFreeBody(*density);
                if (!mass || !inertia)
                    throw InputError("set_free_body() takes density, of a closed mesh, or mass and inertia.");
                const Doubles rows = rowsOf(*inertia, "inertia", 3);
                if (rows.shape(0) != 3) throw InputError("inertia must be 3 x 3 numbers.");
                FreeBodySettings settings{*mass, centre, {}, force, torque};
                for (int a = 0; a < 3; ++a)
                    for (int b = 0; b < 3; ++b) settings.inertia(a, b) = rows.at(a, b);
                w.as<RigidWall>("body").setFreeBody(settings);
            },
            py::kw_only(), py::arg("density") = py::none(), py::arg("mass") = py::none(),
            py::arg("centre") = Vec3D(0, 0, 0), py::arg("inertia") = py::none(),
            py::arg("force") = Vec3D(0, 0, 0), py::arg("torque") = Vec3D(0, 0, 0),
            comment("RigidWall::setFreeBody",
                    "density: kg/m^3, of a closed mesh; or mass: kg, centre: m, of mass, and inertia: 3 x "
                    "3, kg m^2, about it. force: N, and torque: N m, that act besides."))
        .def_property_readonly(
            "body_speed", [](const WallHandle& w) { return w.as<RigidWall>("body").getBodySpeed(); },
            comment("RigidWall::getBodySpeed"))
        .def_property_readonly(
            "body_way", [](const WallHandle& w) { return w.as<RigidWall>("body").getBodyWay(); },
            comment("RigidWall::getBodyWay"));
}

}  // namespace

void bindWalls(py::module_& module, SceneClass& scene) {
    py::class_<WallHandle> wall(module, "Wall", collectHandles<WallHandle>(), "A wall of a scene.");
    refuseCopies(wall, "it is a part of its scene; hand its number on.");
    compareBy(wall, [](const WallHandle& w) { return w.number; });
    wall.def_readonly("number", &WallHandle::number, "Its number, in the order of adding, from 0.")
        .def_property_readonly(
            "force", [](const WallHandle& w) { return w.wall().getForce(); }, comment("Wall::getForce"))
        .def_property_readonly(
            "torque", [](const WallHandle& w) { return w.wall().getTorque(); }, comment("Wall::getTorque"))
        .def(
            "keep_forces",
            [](const WallHandle& w, bool keep, const Vec3D& about) {
                w.as<Wall>("forces").keepForces(keep, about);
            },
            py::arg("keep") = true, py::arg("about") = Vec3D(0, 0, 0),
            comment("Wall::keepForces", "keep: or no more; about: m, the point of the torque."))
        .def(
            "set_species",
            [](const WallHandle& w, const SpeciesHandle& s) {
                s.requireOf(*w.owner, "species");
                w.as<Wall>("species").setSpecies(&s);
            },
            py::arg("species"),
            "Gives the wall another material, also during a run.\n\nspecies: of this scene.")
        .def_property_readonly("kind", &kindOf, "plane, cylinder, tube, profile, mesh, membrane, or removed.")
        .def_property_readonly("liquid", &liquidOf, comment("Scene::liquidOfWall"))
        .def("__repr__",
             [](const WallHandle& w) { return fmt::format("<pendular.Wall {}: {}>", w.number, kindOf(w)); });
    bindMotion(wall);
    bindDrives(wall);

    scene
        .def("add_plane", &addPlane, py::arg("species"), py::arg("outward"), py::arg("point"), py::kw_only(),
             py::arg("forces") = false,
             "Adds a plane; grains are on the side from which its normal points away.\n\n"
             "species: the material of its surface. outward: its normal, away from the grains, of any "
             "length; point: m, on it. forces: they are kept, as by keep_forces().")
        .def("add_cylinder", &addCylinder, py::arg("species"), py::arg("axis"), py::arg("point"),
             py::arg("radius"), py::kw_only(), py::arg("grains_inside") = py::none(),
             py::arg("length") = py::none(), py::arg("forces") = false,
             "Adds a circular cylinder without ends: a container, or a rod with the grains outside. With a "
             "length (m) it is a thin tube with open ends about the point, and grains may be on both "
             "sides.\n\n"
             "species: the material of its surface. axis: its direction, of any length; point: m, on the "
             "axis, of a tube its middle; radius: m; grains_inside: False where they are outside, not with "
             "length. forces: they are kept, as by keep_forces().")
        .def("add_profile", &addProfile, py::arg("species"), py::arg("axis"), py::arg("point"),
             py::arg("profile"), py::kw_only(), py::arg("forces") = false,
             comment("AxisymmetricWall",
                     "species: the material of its surface. axis: its direction, of any length; point: m, "
                     "on the axis, at the height 0. profile: M x 2 numbers, radius and height (m), at least "
                     "2 points. forces: they are kept, as by keep_forces()."))
        .def("add_mesh", &addMesh, py::arg("species"), py::arg("mesh"), py::kw_only(), py::arg("scale") = 1.0,
             py::arg("forces") = false,
             comment("TriangleWall",
                     "species: the material of its surface. mesh: the name of a file (STL, OBJ, PLY), or an "
                     "array of triangles, N x 3 x 3 numbers; scale: m for one unit of it. forces: they are "
                     "kept, as by keep_forces()."))
        .def("add_solid", &addSolid, py::arg("species"), py::arg("normals"), py::arg("points"), py::kw_only(),
             py::arg("centre"), py::arg("radius"), py::arg("forces") = false,
             comment("intersectionOfHalfSpaces",
                     "species: the material of its surface. normals: N x 3, into the solid, of "
                     "any length; points: N x 3, m, one on each plane. centre and radius: m, of a sphere "
                     "around all places where grains come. forces: they are kept, as by keep_forces()."))
        .def(
            "remove_wall",
            [](PythonScene& s, const WallHandle& w) {
                w.requireOf(s, "wall");
                s.scene().wallHandler.removeObject(w.number);
            },
            py::arg("wall"), comment("WallHandler::removeObject"))
        .def(
            "keep_wall_forces", [](PythonScene& s) { s.scene().wallHandler.keepForces(); },
            comment("WallHandler::keepForces"))
        .def(
            "wall",
            [](PythonScene& s, std::size_t number) {
                static_cast<void>(s.scene().wallHandler.getObject(number));
                return WallHandle(s, number);
            },
            py::arg("number"), "The wall with this number.")
        .def("wall_polygons", &polygons,
             "The walls as pictures show them: points_m, corners of plane polygons one after another; ends, "
             "where each polygon ends among them; and of each polygon its wall, species, and what was worn "
             "off. Endless walls end where they meet and at the box of the scene, which widens from call to "
             "call where it must, and never shrinks.")
        .def_property_readonly(
            "walls",
            [](PythonScene& s) {
                std::vector<WallHandle> all;
                for (const PresentWall& wall : s.scene().wallHandler.present())
                    all.emplace_back(s, wall.number);
                return all;
            },
            "All walls that there are, in the order of their numbers.")
        .def_property_readonly(
            "wall_count", [](const PythonScene& s) { return s.scene().wallHandler.getSize(); },
            comment("WallHandler::getSize"));
}

}  // namespace pendular::python
