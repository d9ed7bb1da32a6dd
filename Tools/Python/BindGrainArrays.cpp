#include <fmt/format.h>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/StateHash.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

/// A copy of numbers of all grains, in the order of their identities.
/// @param write puts those of the grain at a place to a pointer
template <class Number, std::size_t width, class Write>
py::array copyOf(const PythonScene& scene, Write&& write) {
    scene.requireRows("an array of all grains");
    const ParticleStore& grains = scene.scene().particleHandler.store();
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(grains.count())};
    if constexpr (width > 1) shape.push_back(static_cast<py::ssize_t>(width));
    py::array_t<Number> made(std::move(shape));
    Number* to = made.mutable_data();
    for (const std::uint32_t place : grains.place) {
        write(grains, place, to);
        to += width;
    }
    return made;
}

void put(double* to, const Vector<double>& vector) { to[0] = vector.x, to[1] = vector.y, to[2] = vector.z; }

py::array positions(const PythonScene& scene) {
    return copyOf<double, 3>(scene, [](const auto& grains, auto place, double* to) {
        put(to, grains.translation[place].position);
    });
}
py::array velocities(const PythonScene& scene) {
    return copyOf<double, 3>(scene, [](const auto& grains, auto place, double* to) {
        put(to, grains.translation[place].velocity);
    });
}
py::array spins(const PythonScene& scene) {
    return copyOf<double, 3>(scene, [](const auto& grains, auto place, double* to) {
        put(to, grains.hasSpin ? grains.rotation[place].spin : Vector<double>{0, 0, 0});
    });
}
py::array radii(const PythonScene& scene) {
    return copyOf<double, 1>(
        scene, [](const auto& grains, auto place, double* to) { *to = grains.translation[place].radius; });
}
py::array masses(const PythonScene& scene) {
    const GrainMasses masses(scene.scene().particleHandler.store(), scene.scene().laws());
    return copyOf<double, 1>(scene, [&](const auto&, auto place, double* to) { *to = masses(place); });
}
/// For what the kernel tells of one grain.
GrainReference grainAt(const PythonScene& scene, const ParticleStore& grains, std::uint32_t place) {
    return const_cast<Scene&>(scene.scene()).particleHandler.getObject(grains.identity[place]);
}
py::array forces(const PythonScene& scene) {
    const GrainMasses masses(scene.scene().particleHandler.store(), scene.scene().laws());
    return copyOf<double, 3>(scene, [&](const auto& grains, auto place, double* to) {
        const bool isHeld = grains.translation[place].inverseMass == 0;
        put(to, isHeld ? toVector(grainAt(scene, grains, place).getForce()) : forceOn(grains, masses, place));
    });
}
py::array identities(const PythonScene& scene) {
    return copyOf<std::int64_t, 1>(
        scene, [](const auto& grains, auto place, auto* to) { *to = grains.identity[place]; });
}
py::array species(const PythonScene& scene) {
    return copyOf<std::int64_t, 1>(
        scene, [](const auto& grains, auto place, auto* to) { *to = grains.species[place]; });
}
py::array films(const PythonScene& scene) {
    return copyOf<double, 1>(scene, [&](const auto& grains, auto place, double* to) {
        *to = grainAt(scene, grains, place).getLiquidVolume();
    });
}
py::array torques(const PythonScene& scene) {
    return copyOf<double, 3>(scene, [&](const auto& grains, auto place, double* to) {
        put(to, toVector(grainAt(scene, grains, place).getTorque()));
    });
}
py::array contactForces(const PythonScene& scene) {
    return copyOf<double, 3>(scene, [&](const auto& grains, auto place, double* to) {
        put(to, toVector(scene.scene().contactForceOn(grains.identity[place])));
    });
}
py::array held(const PythonScene& scene) {
    return copyOf<bool, 6>(scene, [&](const auto& grains, auto place, bool* to) {
        const HeldAxes axes = grainAt(scene, grains, place).getHeldAxes();
        for (const bool is : {axes.x, axes.y, axes.z, axes.aboutX, axes.aboutY, axes.aboutZ}) *to++ = is;
    });
}

/// Sets numbers of all grains, or of those with these identities; each is checked as if it were set alone.
/// Where one is refused, all are as before.
template <class Get, class Set>
void setAll(PythonScene& scene, const ArrayLike& rows, std::string_view name, py::ssize_t width,
            const std::optional<ArrayLike>& which, const Get& get, const Set& set) {
    ParticleHandler& grains = scene.scene().particleHandler;
    std::vector<std::uint32_t> identities;
    if (which) identities = identitiesOf(*which, "identities");
    else {
        scene.requireRows(name);
        for (const GrainReference grain : grains.ownGrains()) identities.push_back(grain.getId());
    }
    const PerGrain values(rows, name, width, static_cast<py::ssize_t>(identities.size()));
    std::vector<decltype(get(grains.getObject(0)))> before;
    for (const std::uint32_t identity : identities) before.push_back(get(grains.getObject(identity)));
    std::size_t done = 0;
    try {
        for (; done < identities.size(); ++done) {
            const auto k = static_cast<py::ssize_t>(done);
            if constexpr (std::is_same_v<typename decltype(before)::value_type, Vec3D>)
                set(grains.getObject(identities[done]), values.vector(k));
            else set(grains.getObject(identities[done]), values.number(k));
        }
    } catch (...) {
        while (done > 0) --done, set(grains.getObject(identities[done]), before[done]);
        throw;
    }
}

using Which = std::optional<ArrayLike>;

void setPositions(PythonScene& scene, const ArrayLike& rows, const Which& which) {
    setAll(
        scene, rows, "position", 3, which,
        [](const GrainReference grain) -> Vec3D { return grain.getPosition(); },
        [](GrainReference grain, const Vec3D& place) { grain.setPosition(place); });
}
/// Velocities may be given in prepare() of a part of the step, too.
PythonScene& toGiveVelocities(const PythonScene& scene) {
    scene.requireMayGiveVelocities();
    return const_cast<PythonScene&>(scene);
}
void setVelocities(const PythonScene& scene, const ArrayLike& rows, const Which& which) {
    setAll(
        toGiveVelocities(scene), rows, "velocity", 3, which,
        [](const GrainReference grain) -> Vec3D { return grain.getVelocity(); },
        [](GrainReference grain, const Vec3D& velocity) { grain.setVelocity(velocity); });
}
void setSpins(const PythonScene& scene, const ArrayLike& rows, const Which& which) {
    setAll(
        toGiveVelocities(scene), rows, "spin", 3, which,
        [](const GrainReference grain) -> Vec3D { return grain.getAngularVelocity(); },
        [](GrainReference grain, const Vec3D& spin) { grain.setAngularVelocity(spin); });
}
void setRadii(PythonScene& scene, const ArrayLike& rows, const Which& which) {
    setAll(
        scene, rows, "radius", 1, which, [](const GrainReference grain) { return grain.getRadius(); },
        [](GrainReference grain, double radius) { grain.setRadius(radius); });
}
void setFilms(PythonScene& scene, const ArrayLike& rows, const Which& which) {
    setAll(
        scene, rows, "film", 1, which, [](const GrainReference grain) { return grain.getLiquidVolume(); },
        [](GrainReference grain, double film) { grain.setLiquidVolume(film); });
}

/// An array that looks into the memory of the scene, which it keeps alive.
py::array viewOf(const std::shared_ptr<PythonScene>& scene, const std::string& what) {
    scene->requireThisThread(),
        scene->requireMayChange();  // pybind11 asks the scene itself only where it is given by reference
    scene->requireRows("view()");
    ParticleStore& grains = scene->scene().particleHandler.store();
    using Kept = std::shared_ptr<PythonScene>;
    const auto look = [&]<class Number>(Number* first, py::ssize_t width, std::size_t bytes) {
        scene->addView();
        const py::capsule owner(new Kept(scene), [](void* memory) {
            auto* const kept = static_cast<Kept*>(memory);
            (*kept)->removeView();
            delete kept;
        });
        std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(grains.size())};
        std::vector<py::ssize_t> strides{static_cast<py::ssize_t>(bytes)};
        if (width > 1) shape.push_back(width), strides.push_back(sizeof(Number));
        py::array made(py::dtype::of<Number>(), shape, strides, first, owner);
        made.attr("setflags")(py::arg("write") = false);
        return made;
    };
    TranslationRecord* const first = grains.translation.data();
    if (what == "position") return look(&first->position.x, 3, sizeof *first);
    if (what == "velocity") return look(&first->velocity.x, 3, sizeof *first);
    if (what == "radius") return look(&first->radius, 1, sizeof *first);
    if (what == "identity") return look(grains.identity.data(), 1, sizeof(std::uint32_t));
    unknownName("view", what, {"position", "velocity", "radius", "identity"});
}

py::dict fieldsOfGrains(const PythonScene& scene, bool stress) {
    scene.requireRows("grains()");
    FrameContent content;
    content.doubles = true, content.contacts = false, content.stress = stress;
    SceneFrame frame;
    {
        const PythonScene::WithoutPython others(scene);
        frame = content.of(scene.scene());
    }
    py::dict made;
    made["position_m"] = arrayOf(std::move(frame.grains.points));
    for (PolyDataField& field : frame.grains.pointFields)
        made[py::str(field.name)] = arrayOf(std::move(field));
    return made;
}

GrainColumn& columnNamed(ParticleStore& grains, const std::string& name) {
    std::vector<std::string_view> names;
    for (GrainColumn& column : grains.columns) {
        if (column.name == name) return column;
        names.push_back(column.name);
    }
    if (names.empty()) throw InputError("Grains have no columns of their own; add one with add_column().");
    unknownName("column of grains", name, names);
}

void setGrainColumn(PythonScene& scene, const std::string& name, const ArrayLike& rows) {
    scene.requireRows("set_column()");
    ParticleStore& grains = scene.scene().particleHandler.store();
    GrainColumn& column = columnNamed(grains, name);
    const PerGrain values(rows, name, 1, static_cast<py::ssize_t>(grains.count()));
    py::ssize_t k = 0;
    for (const std::uint32_t place : grains.place) column.values[place] = values.number(k++);
}

}  // namespace

void bindGrainArrays(SceneClass& scene) {
    const auto all = []<class Scene>(void (*set)(Scene&, const ArrayLike&, const Which&)) {
        return [set](Scene& s, const ArrayLike& rows) { set(s, rows, std::nullopt); };
    };
    scene
        .def_property(
            "position", &positions, all(&setPositions),
            "m, N x 3: a row for each grain, in the order of identities, as all arrays of this class. A "
            "copy; what is set is checked as each alone.")
        .def_property("velocity", &velocities, all(&setVelocities), "m/s, N x 3")
        .def_property("spin", &spins, all(&setSpins), "rad/s, N x 3; zeros without friction")
        .def_property("radius", &radii, all(&setRadii), "m, N; the mass follows it")
        .def_property("film", &films, all(&setFilms), "m^3, N: the liquid on each grain, where liquid moves")
        .def_property_readonly("mass", &masses, "kg, N; in rigid bodies the share of each grain")
        .def_property_readonly("force", &forces, comment("GrainReference::getForce"))
        .def_property_readonly("torque", &torques, comment("GrainReference::getTorque"))
        .def_property_readonly(
            "contact_force", &contactForces,
            "N, N x 3: of all contacts on each grain in the last step, also on one that is held; without "
            "its weight")
        .def_property_readonly("held", &held,
                               "N x 6: whether each grain is held along x, y and z, and about x, y and z")
        .def_property_readonly("identity", &identities,
                               "N: the numbers of the grains, given once and for all")
        .def_property_readonly("grain_species", &species, "N: the index of the material of each")
        .def("set_position", &setPositions, py::arg("position"), py::arg("identities") = py::none(),
             "Puts these grains elsewhere.\n\n"
             "position: m, three numbers, or N x 3. identities: of the grains; all without them.")
        .def("set_velocity", &setVelocities, py::arg("velocity"), py::arg("identities") = py::none(),
             "Gives these grains velocities.\n\n"
             "velocity: m/s, three numbers, or N x 3. identities: of the grains; all without them.")
        .def("set_spin", &setSpins, py::arg("spin"), py::arg("identities") = py::none(),
             "Gives these grains spins.\n\n"
             "spin: rad/s, three numbers, or N x 3. identities: of the grains; all without them.")
        .def("set_radius", &setRadii, py::arg("radius"), py::arg("identities") = py::none(),
             comment("GrainReference::setRadius",
                     "radius: m, one or N. identities: of the grains; all without them."))
        .def("set_film", &setFilms, py::arg("film"), py::arg("identities") = py::none(),
             comment("GrainReference::setLiquidVolume",
                     "film: m^3, one or N. identities: of the grains; all without them."))
        .def("view", &viewOf, py::arg("name"),
             "An array that looks into the memory of the scene, without a copy, by its name: position, "
             "velocity (N x 3), radius or identity. It is read-only, its rows are by place and not by "
             "identity, and a place without a grain has a radius of 0. While it lives, whatever would move "
             "the memory raises BufferError.")
        .def("grains", &fieldsOfGrains, py::kw_only(), py::arg("stress") = false,
             "All fields of the grains, by the names that they have in the HDF5 files: position_m, "
             "radius_m, ...; with stress also stress_Pa (N x 3 x 3, tension positive).")
        .def(
            "add_column",
            [](PythonScene& s, const std::string& name, const std::string& unit, double initial) {
                static_cast<void>(s.scene().particleHandler.addColumn(name, unit, initial));
            },
            py::arg("name"), py::arg("unit") = "", py::arg("initial") = 0.0,
            comment("ParticleHandler::addColumn", "name, unit: words; initial: of all grains."))
        .def(
            "column",
            [](PythonScene& s, const std::string& name) {
                const GrainColumn& column = columnNamed(s.scene().particleHandler.store(), name);
                return copyOf<double, 1>(
                    s, [&](const auto&, auto place, double* to) { *to = column.values[place]; });
            },
            py::arg("name"), "N: a copy of what add_column() keeps under this name.")
        .def("set_column", &setGrainColumn, py::arg("name"), py::arg("values"),
             "Sets what add_column() keeps under this name. values: one number, or one for each grain.")
        .def(
            "hash",
            [](const PythonScene& s) {
                s.requireAllRows("hash()");
                return fmt::format("{:016x}", stateHash(s.scene().particleHandler.store()));
            },
            comment("stateHash"));
}

}  // namespace pendular::python
