#include <fmt/format.h>

#include <array>

#include "Kernel/Features/Superquadrics/SuperquadricHandler.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/Regions.h"

namespace pendular::python {

namespace {

std::vector<Ball> ballsOf(const ArrayLike& spheres) {
    const Doubles rows = rowsOf(spheres, "spheres", 4);
    std::vector<Ball> balls;
    for (py::ssize_t k = 0; k < rows.size() / 4; ++k) {
        const double* const row = rows.data() + 4 * k;
        balls.push_back({{row[0], row[1], row[2]}, row[3]});
    }
    return balls;
}

Eigen::Matrix3d matrixOf(const ArrayLike& given, std::string_view name) {
    const Doubles rows = rowsOf(given, name, 3);
    if (rows.shape(0) != 3) throw InputError(std::string(name) + " must be 3 x 3 numbers.");
    Eigen::Matrix3d matrix;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) matrix(row, column) = rows.at(row, column);
    return matrix;
}

std::optional<BodyMass> massOf(std::optional<double> mass, const std::optional<Vec3D>& centre,
                               const std::optional<ArrayLike>& inertia) {
    if (mass.has_value() != inertia.has_value())
        throw InputError("mass (kg) and inertia (3 x 3, kg m^2) of a body are given together.");
    if (centre && !mass)
        throw InputError(
            "centre (m) of a body is given with mass (kg) and inertia (3 x 3, kg m^2); without them it is "
            "computed; leave it out.");
    if (!mass) return {};
    return BodyMass{*mass, centre.value_or(Vec3D(0, 0, 0)), matrixOf(*inertia, "inertia")};
}

AnyShape clump(const ArrayLike& spheres, std::optional<double> mass, const std::optional<Vec3D>& centre,
               const std::optional<ArrayLike>& inertia) {
    const auto given = massOf(mass, centre, inertia);
    const std::vector<Ball> balls = ballsOf(spheres);
    return withoutPython(
        [&] { return given ? AnyShape{ClumpTemplate(balls, *given)} : AnyShape{ClumpTemplate(balls)}; });
}

Eigen::Quaterniond quaternionOf(const ArrayLike& orientation) {
    const Doubles q = rowsOf(orientation, "orientation", 1);
    if (q.size() != 4) throw InputError("orientation must be a quaternion: four numbers w, x, y, z.");
    return {q.at(0), q.at(1), q.at(2), q.at(3)};
}

SuperquadricHandler& shapesOf(PythonScene& scene) {
    if (SuperquadricHandler* const handler = scene.superquadrics()) return *handler;
    throw InputError(
        "This scene takes spheres and clumps only; make it by Scene(superquadrics=NAME), with the name of "
        "its one species type.");
}

std::uint32_t addShape(PythonScene& scene, const SpeciesHandle& species, const AnyShape& shape,
                       const Vec3D& position, const ArrayLike& orientation, const Vec3D& velocity,
                       const Vec3D& spin, double scale) {
    scene.requireNoViews();
    const auto placed = [&](auto body) {
        body.setSpecies(&species);
        body.setPosition(position), body.setOrientation(quaternionOf(orientation));
        body.setVelocity(velocity), body.setAngularVelocity(spin);
        return body;
    };
    if (const auto* const spheres = std::get_if<ClumpTemplate>(&shape.of)) {
        Clump clump(*spheres);
        clump.setScale(scale);
        return scene.scene().bodyHandler.copyAndAddObject(placed(clump)).getId();
    }
    if (const auto* const grain = std::get_if<SuperquadricGrain>(&shape.of))
        return shapesOf(scene).copyAndAddObject(placed(grain->scaled(scale))).getId();
    if (scale != 1) throw InputError("A block has the size that block() was given; leave scale out.");
    return shapesOf(scene).copyAndAddObject(placed(std::get<BlockGrain>(shape.of))).getId();
}

std::uint32_t join(PythonScene& scene, const ArrayLike& identities, std::optional<double> mass,
                   const std::optional<Vec3D>& centre, const std::optional<ArrayLike>& inertia) {
    return scene.scene()
        .bodyHandler
        .join(std::span<const std::uint32_t>(identitiesOf(identities, "identities")),
              massOf(mass, centre, inertia))
        .getId();
}

double volumeOf(const AnyShape& shape) {
    if (const auto* const spheres = std::get_if<ClumpTemplate>(&shape.of)) return spheres->getVolume();
    if (const auto* const grain = std::get_if<SuperquadricGrain>(&shape.of))
        return grain->getShape().volume();
    return std::get<BlockGrain>(shape.of).getBox().mass().volume;
}

/// Columns of all bodies, in the order of their numbers.
py::dict bodies(PythonScene& scene) {
    scene.requireRows("bodies()");
    Scene& of = scene.scene();
    std::map<std::uint32_t, bool> numbers;
    for (const GrainReference grain : of.particleHandler.ownGrains())
        if (const auto body = of.bodyHandler.bodyOf(grain.getId())) numbers[*body] = true;
    const auto rows = static_cast<py::ssize_t>(numbers.size());
    std::vector<std::int64_t> ids;
    std::vector<double> masses, volumes;
    std::vector<Vector<double>> position, velocity, spin, force, torque;
    std::vector<double> orientation, principal;
    const auto append = [](std::vector<double>& rows, const Eigen::Quaterniond& q) {
        rows.insert(rows.end(), {q.w(), q.x(), q.y(), q.z()});
    };
    std::vector<Vector<double>> inertia;
    for (const auto& [number, unused] : numbers) {
        const BodyReference body = of.bodyHandler.getObject(number);
        ids.push_back(number), masses.push_back(body.getMass()), volumes.push_back(body.getVolume());
        position.push_back(toVector(body.getPosition())), velocity.push_back(toVector(body.getVelocity()));
        spin.push_back(toVector(body.getAngularVelocity())), force.push_back(toVector(body.getForce()));
        torque.push_back(toVector(body.getTorque()));
        append(orientation, body.getOrientation()), append(principal, body.getPrincipalAxes());
        inertia.push_back(toVector(body.getInertia()));
    }
    py::dict made;
    made["body"] = arrayOf(std::move(ids));
    made["mass_kg"] = arrayOf(std::move(masses)), made["volume_m3"] = arrayOf(std::move(volumes));
    made["position_m"] = arrayOf(std::move(position));
    made["velocity_m_per_s"] = arrayOf(std::move(velocity));
    made["spin_rad_per_s"] = arrayOf(std::move(spin));
    made["force_N"] = arrayOf(std::move(force)), made["torque_Nm"] = arrayOf(std::move(torque));
    made["orientation"] = arrayOf(std::move(orientation), {rows, 4});
    made["principal_axes"] = arrayOf(std::move(principal), {rows, 4});
    made["inertia_kg_m2"] = arrayOf(std::move(inertia));
    return made;
}

}  // namespace

void bindBodies(py::module_& module, SceneClass& scene) {
    py::class_<AnyShape> shape(module, "Shape",
                               "What grains are that are no spheres: a clump, a superquadric, a block.");
    refuseCopies(shape, anew);
    shape
        .def_property_readonly("volume", &volumeOf,
                               "m^3, of the shape as it is given; that of a body is scale^3 times it.")
        .def("__repr__", [](const AnyShape& s) {
            return fmt::format("<pendular.Shape: {}>",
                               std::array{"clump", "superquadric", "block"}[s.of.index()]);
        });
    module.def("clump", &clump, py::arg("spheres"), py::kw_only(), py::arg("mass") = py::none(),
               py::arg("centre") = py::none(), py::arg("inertia") = py::none(),
               comment("ClumpTemplate",
                       "spheres: N x 4 numbers, x, y, z and radius, in m, or in any unit where sizes scale "
                       "them. mass: kg, centre: of mass, the origin where it is not given, and inertia: 3 x "
                       "3, kg m^2, about it: of the shape "
                       "as it is given; without them, those of the solid that the spheres make."));
    module.def(
        "superquadric",
        [](const Vec3D& half, int n1, int n2) {
            return AnyShape{SuperquadricGrain({half.x(), half.y(), half.z(), n1, n2})};
        },
        py::arg("half_lengths"), py::arg("n1") = 2, py::arg("n2") = 2,
        comment("Superquadric", "half_lengths: a, b and c, m."));
    module.def(
        "block", [](const Vec3D& half, double radius) { return AnyShape{BlockGrain(half, radius)}; },
        py::arg("half_lengths"), py::arg("edge_radius"),
        comment("BlockGrain", "half_lengths: m, from the centre to the faces; edge_radius: m."));
    module.def("shaped_species", &shapedSpecies, "The names of species types for Scene(superquadrics=NAME).");

    scene
        .def("add_shape", &addShape, py::arg("species"), py::arg("shape"), py::arg("position"), py::kw_only(),
             py::arg("orientation") = py::make_tuple(1, 0, 0, 0), py::arg("velocity") = Vec3D(0, 0, 0),
             py::arg("spin") = Vec3D(0, 0, 0), py::arg("scale") = 1.0,
             "Adds one clump, superquadric or block; returns the number of its body.\n\n"
             "species: its material. position: m, of its centre of mass. orientation: a quaternion w, x, y, "
             "z of any length that turns the shape. velocity: m/s, spin: rad/s. scale: the factor of all "
             "lengths.")
        .def("join", &join, py::arg("identities"), py::kw_only(), py::arg("mass") = py::none(),
             py::arg("centre") = py::none(), py::arg("inertia") = py::none(),
             comment("BodyHandler::join",
                     "identities: of the grains. mass: kg, centre: m, of mass, in space, as the grains are "
                     "now (the origin where it is not given), and inertia: 3 x 3, kg m^2, about it. Returns "
                     "the number of the body."))
        .def("bodies", &bodies,
             "Columns of all rigid bodies, in the order of their numbers: body (the number), mass_kg, "
             "volume_m3; position_m, velocity_m_per_s, spin_rad_per_s, force_N and torque_Nm, along the axes "
             "of space, of and about the centre of mass; orientation, a quaternion w, x, y, z that turns the "
             "shape into space, as add_shape() takes it (of joined grains: from how they were then); "
             "principal_axes, one that turns the principal axes into space, and inertia_kg_m2 about these.")
        .def(
            "body_of",
            [](PythonScene& s, std::uint32_t grain) { return s.scene().bodyHandler.bodyOf(grain); },
            py::arg("identity"),
            comment("BodyHandler::bodyOf", "identity: of the grain. Returns None where it is in none."))
        .def(
            "grains_of_body",
            [](PythonScene& s, std::size_t body) {
                return s.scene().bodyHandler.getObject(body).getGrains();
            },
            py::arg("body"), comment("BodyReference::getGrains", "body: its number."))
        .def(
            "remove_body",
            [](PythonScene& s, std::size_t body) {
                s.requireNoViews();
                s.scene().bodyHandler.removeObject(body);
            },
            py::arg("body"),
            comment("BodyHandler::removeObject", "body: its number. Raises InputError where there is none."))
        .def(
            "set_body_velocity",
            [](PythonScene& s, std::size_t body, const std::optional<Vec3D>& velocity,
               const std::optional<Vec3D>& spin) {
                BodyReference of = s.scene().bodyHandler.getObject(body);
                if (velocity) of.setVelocity(*velocity);
                if (spin) of.setAngularVelocity(*spin);
            },
            py::arg("body"), py::arg("velocity") = py::none(), py::arg("spin") = py::none(),
            "Gives a body a velocity (m/s), a spin (rad/s), or both.")
        .def(
            "hold_body",
            [](PythonScene& s, std::size_t body, const std::string& axes) {
                s.scene().bodyHandler.getObject(body).setHeldAxes(heldAxesNamed(axes));
            },
            py::arg("body"), py::arg("axes") = "all",
            comment("BodyReference::setHeldAxes",
                    "body: its number; axes: of x, y, z, about_x, about_y and about_z, with blanks between "
                    "them; 'all'; 'in_plane'; \'\': it is free."))
        .def(
            "fix_body",
            [](PythonScene& s, std::size_t body, bool fix) {
                s.scene().bodyHandler.getObject(body).fixBody(fix);
            },
            py::arg("body"), py::arg("fix") = true,
            comment("BodyReference::fixBody", "body: its number; fix: or let it go."));
}

}  // namespace pendular::python
