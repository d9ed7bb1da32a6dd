#include <fmt/format.h>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Scene/Scene.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/Insertable.h"
#include "Tools/Python/Regions.h"
#include "Tools/Python/WallHandle.h"

namespace pendular::python {

namespace {

Amount amountOf(std::optional<std::size_t> number, std::optional<double> mass,
                std::optional<double> fraction) {
    if (number.has_value() + mass.has_value() + fraction.has_value() != 1)
        throw InputError("insert() takes one of number, mass (kg) and solid_fraction.");
    if (number) return Amount::grains(*number);
    return mass ? Amount::mass(*mass) : Amount::solidFraction(*fraction);
}

py::dict insertMixture(PythonScene& scene, const Mixture& mixture, const AnyRegion& region,
                       std::optional<std::size_t> number, std::optional<double> mass,
                       std::optional<double> fraction, std::uint64_t seed, bool isRandom, bool wholeGrains,
                       bool withFlow, std::uint32_t tries) {
    scene.requireNoViews();
    const Amount amount = amountOf(number, mass, fraction);
    const BodyMixture& bodies = mixture.in(scene);
    const Region& in = region.regionIn(scene);
    InsertOptions options;
    options.seed = seed;
    options.sample = isRandom ? Sample::Random : Sample::Exact;
    options.wholeGrains = wholeGrains;
    options.withFlow = withFlow, options.tries = tries;
    Inserted made;
    {
        const PythonScene::WithoutPython others(scene);
        made = scene.scene().insert(bodies, in, amount, options);
    }
    py::dict answer;
    answer["number"] = made.number, answer["wanted"] = made.wanted;
    answer["mass_kg"] = made.mass, answer["wanted_mass_kg"] = made.wantedMass;
    answer["solid_fraction"] = made.solidFraction, answer["first_left_out_m"] = made.firstLeftOut;
    answer["orientation_order"] = made.orientationOrder;
    return answer;
}

py::dict insert(PythonScene& scene, const SpeciesHandle& species, const SizeDistribution& sizes,
                const AnyRegion& region, std::optional<std::size_t> number, std::optional<double> mass,
                std::optional<double> fraction, const std::optional<AnyShape>& shape, const Vec3D& velocity,
                const Vec3D& spin, double film, std::uint64_t seed, bool isRandom, bool wholeGrains,
                bool withFlow, std::uint32_t tries) {
    Mixture one;
    one.add({species, shape, velocity, spin, film}, sizes);
    return insertMixture(scene, one, region, number, mass, fraction, seed, isRandom, wholeGrains, withFlow,
                         tries);
}

std::string_view nameOfRegion(const AnyRegion& region) {
    return std::array{"box", "cylinder", "sphere", "inside of a mesh", "between walls"}[region.of.index()];
}

void bindMixture(py::module_& module) {
    py::class_<Mixture> mixture(module, "Mixture", comment("BodyMixture"));
    refuseCopies(mixture, anew);
    mixture
        .def(py::init([](const std::string& by) { return Mixture{BodyMixture(basisNamed(by))}; }),
             py::arg("by") = "number", "by: what shares count, number or volume.")
        .def(
            "add",
            [](Mixture& of, const SpeciesHandle& species, const SizeDistribution& sizes, double share,
               const std::optional<AnyShape>& shape, const Vec3D& velocity, const Vec3D& spin, double film) {
                of.add({species, shape, velocity, spin, film}, sizes, share);
            },
            py::arg("species"), py::arg("sizes"), py::arg("share") = 1.0, py::kw_only(),
            py::arg("shape") = py::none(), py::arg("velocity") = Vec3D(0, 0, 0),
            py::arg("spin") = Vec3D(0, 0, 0), py::arg("film") = 0.0, py::keep_alive<1, 2>(),
            "Adds a kind of grains, with its share in any unit. species: of them; shape: of grains that are "
            "no spheres; sizes are then diameters of spheres of their volume. velocity: m/s, spin: rad/s, "
            "film: m^3.")
        .def("__len__", [](const Mixture& of) { return of.of.size(); })
        .def("__repr__",
             [](const Mixture& of) { return fmt::format("<pendular.Mixture: {} kinds>", of.of.size()); });
}

}  // namespace

void bindRegions(py::module_& module, SceneClass& scene) {
    bindMixture(module);
    py::class_<AnyRegion> region(module, "Region", "A part of space: where grains come, or where they go.");
    refuseCopies(region, anew);
    region
        .def("__repr__",
             [](const AnyRegion& r) { return fmt::format("<pendular.Region: {}>", nameOfRegion(r)); })
        .def_property_readonly(
            "volume", [](const AnyRegion& r) { return r.region().volume(); }, "m^3")
        .def(
            "contains",
            [](const AnyRegion& r, const Vec3D& point, double margin) {
                return r.region().contains(point, margin);
            },
            py::arg("point"), py::arg("margin") = 0.0, comment("Region::contains"));

    module.def(
        "box",
        [](const Vec3D& lowest, const Vec3D& highest) { return AnyRegion{BoxRegion(lowest, highest)}; },
        py::arg("lowest"), py::arg("highest"),
        "A box with edges along the axes.\n\nlowest, highest: m, its corners.");
    module.def(
        "cylinder",
        [](const Vec3D& from, const Vec3D& to, double radius) {
            return AnyRegion{CylinderRegion(from, to, radius)};
        },
        py::arg("start"), py::arg("end"), py::arg("radius"),
        "A solid cylinder.\n\nstart, end: m, the middles of its ends; radius: m.");
    module.def(
        "sphere", [](const Vec3D& centre, double radius) { return AnyRegion{SphereRegion(centre, radius)}; },
        py::arg("centre"), py::arg("radius"), "A ball.\n\ncentre: m; radius: m.");
    module.def(
        "mesh_inside",
        [](const py::object& mesh, double scale) { return AnyRegion{MeshRegion(trianglesOf(mesh, scale))}; },
        py::arg("mesh"), py::arg("scale") = 1.0,
        comment("MeshRegion",
                "mesh: the name of a file (STL, OBJ, PLY), or an array of triangles, N x 3 x 3 numbers; "
                "scale: m for one unit of it. Raises InputError where it is not closed."));

    scene
        .def(
            "between_walls",
            [](PythonScene& s, const Vec3D& lowest, const Vec3D& highest) {
                return AnyRegion{BetweenWalls(s.scene().wallHandler, lowest, highest), &s};
            },
            py::arg("lowest"), py::arg("highest"), py::keep_alive<0, 1>(),
            comment("BetweenWalls", "lowest, highest: m, corners of the box."))
        .def("insert", &insert, py::arg("species"), py::arg("sizes"), py::arg("region"), py::kw_only(),
             py::arg("number") = py::none(), py::arg("mass") = py::none(),
             py::arg("solid_fraction") = py::none(), py::arg("shape") = py::none(),
             py::arg("velocity") = Vec3D(0, 0, 0), py::arg("spin") = Vec3D(0, 0, 0), py::arg("film") = 0.0,
             py::arg("seed") = 1, py::arg("random_sizes") = false, py::arg("whole_grains") = true,
             py::arg("with_flow") = false, py::arg("tries") = 10000,
             comment("Scene::insert",
                     "species: of the grains; sizes: of diameters, m; region: where they are. number, mass "
                     "(kg) or solid_fraction (of the region, up to 0.6): how much. shape: of grains that "
                     "are no spheres, each turned at random; sizes are then diameters of spheres of their "
                     "volume. velocity: m/s, spin: rad/s, film: m^3 of liquid, of each. seed: of places. "
                     "random_sizes: each is drawn for itself, else the sample is as exact as its number "
                     "allows. whole_grains: whole grains are in the region, else their centres. with_flow: "
                     "velocities are on top of those of shear and strain. tries: random places for each "
                     "grain, up to a solid fraction of 0.2. Returns number, wanted, mass_kg, "
                     "wanted_mass_kg, solid_fraction, first_left_out_m (the radius of the first that found "
                     "no room; 0) and orientation_order."))
        .def("insert_mixture", &insertMixture, py::arg("mixture"), py::arg("region"), py::kw_only(),
             py::arg("number") = py::none(), py::arg("mass") = py::none(),
             py::arg("solid_fraction") = py::none(), py::arg("seed") = 1, py::arg("random_sizes") = false,
             py::arg("whole_grains") = true, py::arg("with_flow") = false, py::arg("tries") = 10000,
             "Inserts grains of several kinds, as exactly in their shares as their number allows; the rest "
             "is as in insert().\n\n"
             "mixture: of them; region: where they are. number, mass (kg) or solid_fraction: how much. "
             "seed, random_sizes, whole_grains, with_flow, tries: as there. Returns the same.");
}

}  // namespace pendular::python
