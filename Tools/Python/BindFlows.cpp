#include <fmt/format.h>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/Insertable.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

namespace {

/// What inlets have, whatever comes by them.
struct InletSettings {
    std::optional<double> massFlow, numberFlow;  // kg/s, 1/s
    double start, end;                           // s
    bool lost;
    std::uint64_t seed;
    bool wholeGrains, randomTurns;
    std::uint32_t tries;
    std::optional<std::tuple<Vec3D, double, double>> followsFill;
    std::optional<WallHandle> followsWall;
};

std::size_t addInlet(PythonScene& scene, const Mixture& mixture, const AnyRegion& region,
                     const InletSettings& s) {
    if (s.massFlow.has_value() + s.numberFlow.has_value() != 1)
        throw InputError("An inlet takes one of mass_flow (kg/s) and number_flow (1/s).");
    Inlet inlet;
    region.giveTo(inlet, scene);
    inlet.setBodies(mixture.in(scene));
    if (s.massFlow) inlet.setMassFlow(*s.massFlow);
    else inlet.setNumberFlow(*s.numberFlow);
    if (s.start != 0 || s.end != infinity) inlet.setTimes(s.start, s.end);
    inlet.setNoRoom(s.lost ? NoRoom::Lost : NoRoom::Later);
    inlet.setSeed(s.seed), inlet.setWholeGrains(s.wholeGrains);
    inlet.setRandomTurns(s.randomTurns), inlet.setTries(s.tries);
    if (s.followsFill) {
        const auto& [direction, step, most] = *s.followsFill;
        inlet.setFollowsFill(direction, step, most);
    }
    if (s.followsWall) {
        s.followsWall->requireOf(scene, "wall");
        inlet.setFollowsWall(s.followsWall->number);
    }
    return scene.scene().inletHandler.copyAndAddObject(inlet);
}

std::size_t addOutlet(PythonScene& scene, const std::optional<AnyRegion>& region,
                      const std::optional<Vec3D>& normal, const std::optional<Vec3D>& point,
                      const std::optional<ArrayLike>& sizeClasses, double leastAge,
                      std::optional<py::function> condition) {
    if (normal.has_value() != point.has_value() || region.has_value() == normal.has_value())
        throw InputError("add_outlet() takes a region, or the normal and a point (m) of a plane.");
    Outlet outlet;
    if (region) region->giveTo(outlet, scene);
    else outlet.setPlane(*normal, *point);
    if (sizeClasses) {
        const Doubles borders = rowsOf(*sizeClasses, "size_classes", 1);
        outlet.setSizeClasses({borders.data(), static_cast<std::size_t>(borders.size())});
    }
    if (leastAge != 0) outlet.setLeastAge(leastAge);
    if (condition)
        outlet.setCondition([kept = scene.keep(std::move(*condition)), &scene](const GrainReference& grain) {
            return scene.ask([&] { return isTrue((*kept)(grain.getId())); });
        });
    return scene.scene().outletHandler.copyAndAddObject(outlet);
}

py::dict inlet(const PythonScene& scene, std::size_t number) {
    const InletCount& count = scene.scene().inletHandler.countOf(number);
    py::dict made;
    made["number"] = count.number, made["mass_kg"] = count.mass, made["lost"] = count.lost;
    made["waits"] = count.waits;
    return made;
}

py::dict outlet(const PythonScene& scene, std::size_t number) {
    const GrainTally& tally = scene.scene().outletHandler.countOf(number);
    std::vector<std::int64_t> numbers;
    std::vector<double> masses;
    for (std::size_t species = 0; species < tally.speciesCount(); ++species)
        for (std::size_t size = 0; size < tally.classCount(); ++size) {
            numbers.push_back(static_cast<std::int64_t>(tally.of(species, size).number));
            masses.push_back(tally.of(species, size).mass);
        }
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(tally.speciesCount()),
                                         static_cast<py::ssize_t>(tally.classCount())};
    py::dict made;
    made["number"] = tally.all().number, made["mass_kg"] = tally.all().mass;
    made["number_of"] = arrayOf(std::move(numbers), shape),
    made["mass_of_kg"] = arrayOf(std::move(masses), shape);
    return made;
}

py::dict flux(const PythonScene& scene, std::size_t number) {
    const FluxCount& count = scene.scene().fluxPlaneHandler.countOf(number);
    py::dict made;
    made["forwards"] = count.forwards, made["backwards"] = count.backwards;
    made["mass_forwards_kg"] = count.massForwards, made["mass_backwards_kg"] = count.massBackwards;
    made["net"] = count.net(), made["net_mass_kg"] = count.netMass();
    made["net_momentum_kg_m_per_s"] = arrayOf(count.netMomentum()), made["net_liquid_m3"] = count.netLiquid();
    return made;
}

}  // namespace

void bindFlows(SceneClass& scene) {
    scene
        .def(
            "add_inlet",
            [](PythonScene& s, const SpeciesHandle& species, const SizeDistribution& sizes,
               const AnyRegion& region, std::optional<double> massFlow, std::optional<double> numberFlow,
               const std::optional<AnyShape>& shape, const Vec3D& velocity, const Vec3D& spin, double film,
               double start, double end, bool lost, std::uint64_t seed, bool wholeGrains, bool randomTurns,
               std::uint32_t tries, const std::optional<std::tuple<Vec3D, double, double>>& followsFill,
               const std::optional<WallHandle>& followsWall) {
                Mixture one;
                one.add({species, shape, velocity, spin, film}, sizes);
                return addInlet(s, one, region,
                                {massFlow, numberFlow, start, end, lost, seed, wholeGrains, randomTurns,
                                 tries, followsFill, followsWall});
            },
            py::arg("species"), py::arg("sizes"), py::arg("region"), py::kw_only(),
            py::arg("mass_flow") = py::none(), py::arg("number_flow") = py::none(),
            py::arg("shape") = py::none(), py::arg("velocity") = Vec3D(0, 0, 0),
            py::arg("spin") = Vec3D(0, 0, 0), py::arg("film") = 0.0, py::arg("start") = 0.0,
            py::arg("end") = infinity, py::arg("lost") = false, py::arg("seed") = 1,
            py::arg("whole_grains") = true, py::arg("random_turns") = true, py::arg("tries") = 100,
            py::arg("follows_fill") = py::none(), py::arg("follows_wall") = py::none(),
            comment("Inlet",
                    "species: of what comes; sizes: of diameters, m; region: where it comes. mass_flow: "
                    "kg/s, or number_flow: 1/s. shape: of grains that are no spheres; sizes are then "
                    "diameters of spheres of their volume; random_turns: each is turned at random. "
                    "velocity: m/s, spin: rad/s, film: m^3 of liquid, of each grain. start, end: s, between "
                    "which they come. lost: what finds no room is lost, else it comes later; tries: random "
                    "places in a step. seed: of sizes and places. whole_grains: whole grains are in the "
                    "region, else their centres. follows_fill: (direction, step in m, most in m): where no "
                    "room is found the region moves by the step, at most so far in all. follows_wall: the "
                    "region goes along with this wall. Returns its number. Raises InputError."))
        .def(
            "add_mixture_inlet",
            [](PythonScene& s, const Mixture& mixture, const AnyRegion& region,
               std::optional<double> massFlow, std::optional<double> numberFlow, double start, double end,
               bool lost, std::uint64_t seed, bool wholeGrains, bool randomTurns, std::uint32_t tries,
               const std::optional<std::tuple<Vec3D, double, double>>& followsFill,
               const std::optional<WallHandle>& followsWall) {
                return addInlet(s, mixture, region,
                                {massFlow, numberFlow, start, end, lost, seed, wholeGrains, randomTurns,
                                 tries, followsFill, followsWall});
            },
            py::arg("mixture"), py::arg("region"), py::kw_only(), py::arg("mass_flow") = py::none(),
            py::arg("number_flow") = py::none(), py::arg("start") = 0.0, py::arg("end") = infinity,
            py::arg("lost") = false, py::arg("seed") = 1, py::arg("whole_grains") = true,
            py::arg("random_turns") = true, py::arg("tries") = 100, py::arg("follows_fill") = py::none(),
            py::arg("follows_wall") = py::none(),
            "An inlet at which grains of several kinds come; the rest is as in add_inlet().\n\n"
            "mixture: of them; region: where they come. mass_flow: kg/s, or number_flow: 1/s. start, end: "
            "s; lost, tries, seed, whole_grains, random_turns, follows_fill, follows_wall: as there. "
            "Returns its number. Raises InputError.")
        .def("inlet", &inlet, py::arg("number"),
             "What has come through an inlet: number, mass_kg; lost, and what waits for room, in the unit "
             "of its flow.\n\n"
             "number: that add_inlet() has returned.")
        .def("add_outlet", &addOutlet, py::kw_only(), py::arg("region") = py::none(),
             py::arg("normal") = py::none(), py::arg("point") = py::none(),
             py::arg("size_classes") = py::none(), py::arg("least_age") = 0.0,
             py::arg("condition") = py::none(),
             comment("Outlet",
                     "region: where grains go, or normal, of any length, and point (m) of a plane, beyond "
                     "which they go. size_classes: m, diameters between the classes in which outlet() "
                     "counts. least_age: s, that they have been in the scene. condition: a function of the "
                     "identity that says whether it goes; it may read the scene, and not change it. Returns "
                     "its number. Raises InputError."))
        .def("outlet", &outlet, py::arg("number"),
             "What has gone through an outlet: number and mass_kg; and by species and class of size, "
             "number_of and mass_of_kg.")
        .def(
            "add_flux_plane",
            [](PythonScene& s, const Vec3D& normal, const Vec3D& point) {
                return s.scene().fluxPlaneHandler.copyAndAddObject({normal, point});
            },
            py::arg("normal"), py::arg("point"),
            comment("FluxPlaneHandler", "normal: of any length; point: m, on the plane. Returns its number."))
        .def("flux", &flux, py::arg("number"),
             "What has gone through a flux plane, grains and rigid bodies, each as one: forwards, backwards "
             "and net; mass_forwards_kg, mass_backwards_kg, net_mass_kg; net_momentum_kg_m_per_s, "
             "net_liquid_m3.\n\n"
             "number: that add_flux_plane() has returned.");
}

}  // namespace pendular::python
