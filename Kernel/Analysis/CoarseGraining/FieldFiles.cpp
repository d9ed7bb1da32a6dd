#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/FieldName.h"
#include "Kernel/Analysis/Output/VtkDocument.h"

namespace pendular {

namespace {

using Sum = FieldSums::Sum;

/// The place in xx xy xz yy yz zz of a part of a symmetric tensor.
constexpr std::array<std::size_t, 9> symmetric{0, 1, 2, 1, 3, 4, 2, 4, 5};

/// Makes the fields of one group, or of all.
class FieldMaker {
public:
    FieldMaker(std::size_t count, std::string beginning, std::vector<PolyDataField>& all)
        : points(count), prefix(std::move(beginning)), fields(all) {}

    /// @param valueOf given the point and the part
    template <class Value>
    void add(std::string_view name, std::size_t components, Value&& valueOf) {
        std::vector<double> numbers;
        numbers.reserve(points * components);
        for (std::size_t k = 0; k < points; ++k)
            for (std::size_t part = 0; part < components; ++part) numbers.push_back(valueOf(k, part));
        fields.push_back({prefix + std::string(name), components, std::move(numbers)});
    }

private:
    std::size_t points;
    std::string prefix;
    std::vector<PolyDataField>& fields;
};

template <class SumOf>
void addContactFields(FieldMaker& maker, SumOf&& sum) {
    maker.add("contact_stress_Pa", 9,
              [&](std::size_t k, std::size_t part) { return sum(Sum::ContactStress + part, k); });
    maker.add("adhesive_stress_Pa", 9,
              [&](std::size_t k, std::size_t part) { return sum(Sum::AdhesiveStress + symmetric[part], k); });
    maker.add("traction_N_per_m3", 3,
              [&](std::size_t k, std::size_t part) { return sum(Sum::Traction + part, k); });
    maker.add("fabric", 9,
              [&](std::size_t k, std::size_t part) { return sum(Sum::Fabric + symmetric[part], k); });
    maker.add("coordination", 1,
              [&](std::size_t k, std::size_t) { return sum(Sum::Contacts, k) / sum(Sum::Number, k); });
    maker.add("liquid_fraction", 1, [&](std::size_t k, std::size_t) { return sum(Sum::Liquid, k); });
}

template <class SumOf>
void addFields(FieldMaker maker, bool withContacts, SumOf&& sum) {
    const auto kinetic = [&](std::size_t k, std::size_t part) {
        const double mass = sum(Sum::Mass, k);
        return sum(Sum::Flux + symmetric[part], k) -
               sum(Sum::Momentum + part / 3, k) * sum(Sum::Momentum + part % 3, k) / mass;
    };
    maker.add("number_density_per_m3", 1, [&](std::size_t k, std::size_t) { return sum(Sum::Number, k); });
    maker.add("volume_fraction", 1, [&](std::size_t k, std::size_t) { return sum(Sum::Volume, k); });
    maker.add("density_kg_per_m3", 1, [&](std::size_t k, std::size_t) { return sum(Sum::Mass, k); });
    maker.add("momentum_kg_per_m2s", 3,
              [&](std::size_t k, std::size_t part) { return sum(Sum::Momentum + part, k); });
    maker.add("velocity_m_per_s", 3, [&](std::size_t k, std::size_t part) {
        return sum(Sum::Momentum + part, k) / sum(Sum::Mass, k);
    });
    maker.add("granular_temperature_m2_per_s2", 1, [&](std::size_t k, std::size_t) {
        return (kinetic(k, 0) + kinetic(k, 4) + kinetic(k, 8)) / (3 * sum(Sum::Mass, k));
    });
    maker.add("kinetic_stress_Pa", 9, kinetic);
    if (withContacts) addContactFields(maker, sum);
}

}  // namespace

std::vector<PolyDataField> fieldsOf(const FieldSums& sums) {
    std::vector<PolyDataField> fields;
    const std::size_t count = sums.grid().size();
    addFields(FieldMaker(count, "", fields), sums.hasContacts(),
              [&](std::size_t sum, std::size_t k) { return sums.ofAll(sum, k); });
    const GrainGroups& groups = sums.groups();
    for (std::size_t group = 0; groups.size() > 1 && group < groups.size(); ++group)
        addFields(FieldMaker(count, groups.nameOf(group) + "_", fields), sums.hasContacts(),
                  [&](std::size_t sum, std::size_t k) { return sums.of(sum, group, k); });
    return fields;
}

std::string headerOf(const FieldSums& sums) {
    std::string header = "time_s";
    const FieldGrid& grid = sums.grid();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (grid.isResolved(axis)) header += fmt::format(",{}_m", grid.nameOf(axis));
    // Units of one point are as good as of all.
    FieldGrid onePoint("O", {0, 0, 0}, {1, 1, 1}, 1);
    const FieldSums names(onePoint, SmoothingKernel(KernelShape::Gauss, 0, 1), sums.groups(),
                          sums.hasContacts() ? FieldContent::All : FieldContent::WithoutContacts);
    for (const PolyDataField& field : fieldsOf(names)) {
        const std::size_t nameEnd = splitFieldName(field.name).quantity.size();
        const auto add = [&](const std::string& part) {
            header += fmt::format(",{}{}", field.name.substr(0, nameEnd), part);
            header += field.name.substr(nameEnd);
        };
        if (field.components == 1) add("");
        for (std::size_t i = 0; i < 3 && field.components > 1; ++i) {
            if (field.components == 3) add(fmt::format("_{}", grid.nameOf(i)));
            else
                for (std::size_t j = 0; j < 3; ++j)
                    add(fmt::format("_{}{}{}", grid.nameOf(i), grid.isCylindrical() ? "_" : "",
                                    grid.nameOf(j)));
        }
    }
    return header;
}

std::string rowOf(const FieldSums& sums, const std::vector<PolyDataField>& fields, double time,
                  std::size_t point) {
    std::string row = fmt::format("{}", time);
    const FieldGrid& grid = sums.grid();
    const auto& n = grid.counts();
    const std::array<std::size_t, 3> place{point / (n[1] * n[2]), point / n[2] % n[1], point % n[2]};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (grid.isResolved(axis)) row += fmt::format(",{}", grid.at(axis, place[axis]));
    for (const PolyDataField& field : fields)
        for (std::size_t part = 0; part < field.components; ++part) {
            const double value = field.at(point * field.components + part);
            row += std::isnan(value) ? "," : fmt::format(",{}", value);
        }
    return row;
}

void writeImage(const std::filesystem::path& path, const FieldSums& sums, double time, int threads) {
    const FieldGrid& grid = sums.grid();
    const auto& n = grid.counts();
    const std::string extent = fmt::format("0 {} 0 {} 0 {}", n[0] - 1, n[1] - 1, n[2] - 1);
    // VTK has no grids around an axis: x is r there, and whoever reads it is told.
    const std::vector<PolyDataField> whole =
        grid.isCylindrical() ? std::vector<PolyDataField>{{"cylindrical", 1, std::vector<double>{1}}}
                             : std::vector<PolyDataField>{};
    VtkDocument document(
        "ImageData", time,
        fmt::format(" WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\"", extent, grid.at(0, 0),
                    grid.at(1, 0), grid.at(2, 0), grid.spacing(0), grid.spacing(1), grid.spacing(2)),
        threads, whole);
    document.add(fmt::format("<Piece Extent=\"{}\">\n", extent));
    std::vector<PolyDataField> fields = fieldsOf(sums);
    // VTK has x the fastest.
    for (PolyDataField& field : fields) {
        std::vector<double> turned;
        turned.reserve(field.size());
        for (std::size_t z = 0; z < n[2]; ++z)
            for (std::size_t y = 0; y < n[1]; ++y)
                for (std::size_t x = 0; x < n[0]; ++x)
                    for (std::size_t part = 0; part < field.components; ++part)
                        turned.push_back(field.at(((x * n[1] + y) * n[2] + z) * field.components + part));
        field.numbers = std::move(turned);
    }
    document.addFields("PointData", fields);
    document.add("<CellData>\n</CellData>\n</Piece>\n");
    document.write(path);
}

void writeHdf5(const std::filesystem::path& path, const FieldSums& sums, double time, std::uint64_t step,
               int threads) {
    const FieldGrid& grid = sums.grid();
    FieldFile file(path);
    file.attribute("/", "time_s", time);
    file.attribute("/", "step", static_cast<double>(step));
    file.attribute("/", "kernel_width_m", sums.kernel().width());
    file.attribute("/", "kernel_cut_off_m", sums.kernel().cutOff());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!grid.isResolved(axis)) continue;
        std::vector<double> places;
        for (std::size_t k = 0; k < grid.counts()[axis]; ++k) places.push_back(grid.at(axis, k));
        file.column("points", {fmt::format("{}_m", grid.nameOf(axis)), 1, std::move(places)});
    }
    for (const PolyDataField& field : fieldsOf(sums)) file.column("fields", field, threads);
    file.close();
}

}  // namespace pendular
