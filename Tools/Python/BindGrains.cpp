#include <fmt/format.h>

#include <set>

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

HeldAxes heldAxesNamed(const std::string& axes) {
    if (axes == "all") return HeldAxes::all();
    if (axes == "in_plane") return HeldAxes::inPlane();
    HeldAxes held;
    const std::pair<std::string_view, bool HeldAxes::*> known[] = {{"x", &HeldAxes::x},
                                                                   {"y", &HeldAxes::y},
                                                                   {"z", &HeldAxes::z},
                                                                   {"about_x", &HeldAxes::aboutX},
                                                                   {"about_y", &HeldAxes::aboutY},
                                                                   {"about_z", &HeldAxes::aboutZ}};
    std::string_view left = axes;
    while (!left.empty()) {
        const std::string_view word = left.substr(0, left.find(' '));
        left.remove_prefix(std::min(left.size(), word.size() + 1));
        if (word.empty()) continue;
        const auto* const found =
            std::ranges::find(known, word, &std::pair<std::string_view, bool HeldAxes::*>::first);
        if (found == std::end(known))
            throw InputError(fmt::format(
                "held axis '{}'; there are x, y, z, about_x, about_y and about_z, all and in_plane.", word));
        held.*found->second = true;
    }
    return held;
}

namespace {

py::array addGrains(PythonScene& scene, const SpeciesHandle& species, const ArrayLike& position,
                    const ArrayLike& radius, const ArrayLike& velocity, const ArrayLike& spin,
                    const ArrayLike& film, bool fixed, const std::string& held) {
    scene.requireNoViews();
    if (fixed && !held.empty())
        throw InputError(
            fmt::format("add_grains(): fixed grains are held along and about all axes; held = '{}' must be "
                        "left out.",
                        held));
    const Doubles places = rowsOf(position, "position", 3);
    const py::ssize_t count = places.size() == 0 ? 0 : places.shape(0);
    const PerGrain radii(radius, "radius", 1, count), velocities(velocity, "velocity", 3, count),
        spins(spin, "spin", 3, count), films(film, "film", 1, count);
    const HeldAxes axes = fixed ? HeldAxes::all() : heldAxesNamed(held);
    ParticleHandler& grains = scene.scene().particleHandler;
    std::vector<SphericalParticle> checked(
        static_cast<std::size_t>(count));  // all, before the first is added
    const double* place = places.data();
    for (py::ssize_t k = 0; k < count; ++k, place += 3) {
        SphericalParticle& grain = checked[static_cast<std::size_t>(k)];
        grain.setSpecies(&species);
        try {
            grain.setRadius(radii.number(k)), grain.setPosition({place[0], place[1], place[2]});
            if (axes != HeldAxes{}) grain.setHeldAxes(axes);
            grain.setVelocity(velocities.vector(k)), grain.setAngularVelocity(spins.vector(k));
            grain.setLiquidVolume(films.number(k));
        } catch (const InputError& error) {
            throw InputError(fmt::format("add_grains(), row {}: {}", k, error.what()));
        }
    }
    grains.reserve(grains.getSize() + checked.size());
    std::vector<std::int64_t> identities;
    identities.reserve(checked.size());
    for (const SphericalParticle& grain : checked)
        identities.push_back(grains.copyAndAddObject(grain).getId());
    return arrayOf(std::move(identities));
}

void remove(PythonScene& scene, const ArrayLike& identities) {
    scene.requireNoViews();
    ParticleHandler& grains = scene.scene().particleHandler;
    const std::vector<std::uint32_t> gone = identitiesOf(identities, "identities");
    std::set<std::uint32_t> all;
    for (const std::uint32_t identity : gone) {  // all or none
        static_cast<void>(grains.getObject(identity));
        if (!all.insert(identity).second)
            throw InputError(fmt::format("remove_grains(): identities has {} twice.", identity));
    }
    for (const std::uint32_t identity : gone) grains.removeObject(identity);
}

void addFromFile(PythonScene& scene, const std::vector<SpeciesHandle>& types,
                 const std::filesystem::path& file, std::optional<std::int64_t> step) {
    scene.requireNoViews();
    std::vector<SphericalParticle> ofTypes(types.size());
    for (std::size_t k = 0; k < types.size(); ++k) ofTypes[k].setSpecies(&types[k]);
    addGrains(scene.scene().particleHandler, readGrainFile(file, step), ofTypes);
}

}  // namespace

void bindGrains(SceneClass& scene) {
    scene
        .def("add_grains", &addGrains, py::arg("species"), py::arg("position"), py::arg("radius"),
             py::kw_only(), py::arg("velocity") = py::make_tuple(0, 0, 0),
             py::arg("spin") = py::make_tuple(0, 0, 0), py::arg("film") = 0.0, py::arg("fixed") = false,
             py::arg("held") = "",
             "Adds grains, at set-up or between steps; returns their identities.\n\n"
             "species: their material. position: N x 3, m. radius: m, one or N. velocity (m/s), spin "
             "(rad/s): three numbers, or N x 3. film: m^3 of liquid, one or N, where liquid moves. fixed: "
             "held in place, and moved by velocity and spin alone. held: axes along and about which they "
             "are held, as 'z about_x about_y'. Raises InputError, and adds none then.")
        .def("remove_grains", &remove, py::arg("identities"),
             comment("ParticleHandler::removeObject", "identities: of those that go; all or none."))
        .def("add_grains_of_file", &addFromFile, py::arg("species"), py::arg("file"),
             py::arg("step") = py::none(),
             comment("readGrainFile",
                     "species: a list; grains of the file's type 1 get the first one, and so on. file: its "
                     "name. step: of a dump."))
        .def(
            "write_grains",
            [](PythonScene& s, const std::filesystem::path& file) {
                s.requireAllRows("write_grains()");
                std::vector<GrainRow> rows;
                for (const GrainReference grain : s.scene().particleHandler)
                    rows.push_back({grain.getRadius(), grain.getPosition()});
                writeGrainFile(file, rows);
            },
            py::arg("file"), comment("writeGrainFile"))
        .def(
            "hold",
            [](PythonScene& s, const ArrayLike& identities, const std::string& axes) {
                const HeldAxes held = heldAxesNamed(axes);
                ParticleHandler& grains = s.scene().particleHandler;
                const std::vector<std::uint32_t> those = identitiesOf(identities, "identities");
                for (const std::uint32_t identity : those)
                    static_cast<void>(grains.getObject(identity));  // all or none
                for (const std::uint32_t identity : those) grains.getObject(identity).setHeldAxes(held);
            },
            py::arg("identities"), py::arg("axes") = "all",
            comment("GrainReference::setHeldAxes",
                    "identities: of the grains; axes: of x, y, z, about_x, about_y and about_z, with blanks "
                    "between them; 'all'; 'in_plane'; \'\': they are free."))
        .def(
            "hold_all",
            [](PythonScene& s, const std::string& axes) {
                s.scene().particleHandler.holdAll(heldAxesNamed(axes));
            },
            py::arg("axes") = "in_plane",
            "Holds all grains and rigid bodies along and about these axes, those that are there and those "
            "to come: 'in_plane' is a scene in the plane of x and y. A velocity or a spin there is refused. "
            "At set-up.")
        .def(
            "set_grains_are_discs", [](PythonScene& s) { s.setGrainsAreDiscs(); },
            comment("SpeciesOwner::setGrainsAreDiscs"))
        .def(
            "set_species",
            [](PythonScene& s, const ArrayLike& identities, const SpeciesHandle& species) {
                for (const std::uint32_t identity : identitiesOf(identities, "identities"))
                    s.scene().particleHandler.getObject(identity).setSpecies(&species);
            },
            py::arg("identities"), py::arg("species"),
            "Gives grains another material, also during a run.\n\n"
            "identities: of the grains; species: of this scene.")
        .def("__len__", [](const PythonScene& s) { return s.scene().particleHandler.getSize(); });
}

}  // namespace pendular::python
