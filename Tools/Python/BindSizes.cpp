#include <fmt/format.h>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/Insertable.h"

namespace pendular::python {

SizeBasis basisNamed(std::string_view name) {
    for (const SizeBasis basis : {SizeBasis::Number, SizeBasis::Length, SizeBasis::Area, SizeBasis::Volume})
        if (nameOf(basis) == name) return basis;
    if (name == "mass") return SizeBasis::Volume;
    unknownName("basis of sizes", name, {"number", "length", "area", "volume", "mass"});
}

namespace {

std::vector<double> numbersOf(const ArrayLike& given, std::string_view name) {
    const Doubles rows = rowsOf(given, name, 1);
    return {rows.data(), rows.data() + rows.size()};
}

SizeDistribution table(const ArrayLike& diameters, const std::optional<ArrayLike>& cumulative,
                       const std::optional<ArrayLike>& classes, const std::optional<ArrayLike>& single,
                       const std::string& basis) {
    if (cumulative.has_value() + classes.has_value() + single.has_value() != 1)
        throw InputError("sizes() takes one of cumulative, classes and single.");
    const std::vector<double> at = numbersOf(diameters, "diameters");
    const SizeBasis on = basisNamed(basis);
    if (cumulative) return sizesFromCumulative(at, numbersOf(*cumulative, "cumulative"), on);
    if (classes) return sizesFromClasses(at, numbersOf(*classes, "classes"), on);
    return singleSizes(at, numbersOf(*single, "single"), on);
}

}  // namespace

void bindSizes(py::module_& module) {
    using Sizes = SizeDistribution;
    py::class_<Sizes> sizes(module, "Sizes", "How many grains there are of each diameter (m).");
    refuseCopies(sizes, anew);
    sizes.def_property_readonly("smallest", &Sizes::smallest, "m, diameter")
        .def_property_readonly("largest", &Sizes::largest, "m, diameter")
        .def("mean", &Sizes::mean, py::arg("k") = 1, py::arg("m") = 0, comment("SizeDistribution::mean"))
        .def(
            "cumulative",
            [](const Sizes& s, double diameter, const std::string& basis) {
                checkValue("cumulative()", "diameter", diameter, "m", notNegative);
                return s.cumulative(basisNamed(basis), diameter);
            },
            py::arg("diameter"), py::arg("basis") = "number",
            comment("SizeDistribution::cumulative",
                    "diameter: m; basis: number, length, area, volume or mass. Returns 0 to 1."))
        .def(
            "quantile",
            [](const Sizes& s, double fraction, const std::string& basis) {
                return s.quantile(basisNamed(basis), fraction);
            },
            py::arg("fraction"), py::arg("basis") = "number",
            comment("SizeDistribution::quantile",
                    "fraction: 0 to 1; basis: number, length, area, volume or mass. Returns a diameter, m."))
        .def(
            "radii",
            [](const Sizes& s, std::size_t grains) {
                return arrayOf(withoutPython([&] { return exactRadii(s, grains); }));
            },
            py::arg("grains"), comment("exactRadii", "grains: how many. Returns N radii, m."))
        .def(
            "random_radii",
            [](const Sizes& s, std::size_t grains, std::uint64_t seed) {
                return arrayOf(withoutPython([&] { return randomRadii(s, grains, seed); }));
            },
            py::arg("grains"), py::arg("seed") = 1,
            comment("randomRadii", "grains: how many; seed: of the random numbers."))
        .def("__repr__", [](const Sizes& s) {
            return fmt::format("<pendular.Sizes: {:g} to {:g} m, mean {:g} m>", s.smallest(), s.largest(),
                               s.mean(1, 0));
        });

    module.def("even_sizes", &evenSizes, py::arg("low"), py::arg("high"),
               comment("evenSizes", "low, high: m, diameters."));
    module.def("bidisperse_sizes", &bidisperseSizes, py::arg("small"), py::arg("large"),
               py::arg("volume_of_large"),
               comment("bidisperseSizes",
                       "small, large: m, diameters; volume_of_large: the fraction of the volume that large "
                       "grains have, 0 to 1."));
    module.def(
        "one_size",
        [](double diameter) { return singleSizes(std::array{diameter}, std::array{1.0}, SizeBasis::Number); },
        py::arg("diameter"), "Grains of one diameter (m).");
    module.def(
        "normal_sizes",
        [](double mean, double deviation, double low, double high) {
            return normalSizes(mean, deviation, low, high).sizes;
        },
        py::arg("mean"), py::arg("deviation"), py::arg("low"), py::arg("high"),
        comment(
            "normalSizes",
            "mean, deviation: m; low, high: m, the smallest and the largest diameter: others are left out."));
    module.def(
        "lognormal_sizes",
        [](double median, double geometricDeviation, double low, double high, const std::string& basis) {
            return lognormalSizes(median, geometricDeviation, low, high, basisNamed(basis)).sizes;
        },
        py::arg("median"), py::arg("geometric_deviation"), py::arg("low"), py::arg("high"),
        py::arg("basis") = "number",
        comment("lognormalSizes",
                "median: m; geometric_deviation: s; low, high: m, the smallest and the largest diameter: "
                "others are left out; basis: of the median, number, length, area, volume or mass."));
    module.def(
        "rosin_rammler_sizes",
        [](double size, double exponent, double low, double high) {
            return rosinRammlerSizes(size, exponent, low, high).sizes;
        },
        py::arg("size"), py::arg("exponent"), py::arg("low"), py::arg("high"),
        comment("rosinRammlerSizes",
                "size: m; exponent: 0.1 to 100; low, high: m, the smallest and the largest diameter: others "
                "are left out."));
    module.def("sizes", &table, py::arg("diameters"), py::kw_only(), py::arg("cumulative") = py::none(),
               py::arg("classes") = py::none(), py::arg("single") = py::none(), py::arg("basis") = "number",
               "A table of sizes at diameters (m), on a basis (number, length, area, volume or mass): "
               "cumulative, from 0 to 1; or classes, fractions of what is between the diameters; or single, "
               "of grains of just these sizes.");
    module.def(
        "read_sizes", [](const std::filesystem::path& file) { return readSizeTable(file); }, py::arg("file"),
        comment("readSizeTable"));
}

}  // namespace pendular::python
