#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/CoarseGraining/FieldImage.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

std::string grains() {
    PolyData data;
    data.time = 0.25;
    data.points = {{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 2e-3}};
    data.corners = {0, 1, 2};
    data.ends = {1, 2, 3};
    data.pointFields = {{"radius_m", 1, std::vector<float>{1, 2, 3}},
                        {"force_N", 3, std::vector<double>(9, 0.5)},
                        {"species", 1, std::vector<std::int32_t>{0, 1, 0}}};
    return written("grains.vtp", [&](const auto& path) { writePolyData(path, data); });
}

std::string series() {
    return written("run.pvd", [](const std::filesystem::path& path) {
        ParaViewSeries list((path.parent_path() / "run").string(), 0);
        for (const std::size_t step : {0, 100}) {
            list.add("particles", 1e-3 * static_cast<double>(step), step);
            list.add("a <\"kind\"> & more", 1e-3 * static_cast<double>(step), step);
        }
        list.write();
    });
}

std::string fields() {
    const FieldGrid grid("RZ", {0, 0, 0}, {4e-3, 4e-3, 6e-3}, 2e-3);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, 2, 2e-3), GrainGroups::none(),
                   FieldContent::WithoutContacts);
    GrainState state;
    state.grains.push_back({{1e-3, 2e-3, 3e-3}, {0, 0, 1}, 1e-3, 1e-5});
    sums.add(state);
    return written("fields.vti", [&](const auto& path) { writeImage(path, sums, 0.25); });
}

/// Each point that is told of has its values.
void readImage(const std::filesystem::path& path) {
    for (const std::string field : {"", "velocity_m_per_s"}) {
        const FieldImage image = readFieldImage(path, field);
        const std::array last{image.places[0].size() - 1, image.places[1].size() - 1,
                              image.places[2].size() - 1};
        if ((last[0] + 1) * (last[1] + 1) * (last[2] + 1) * image.field.components != image.field.size())
            throw std::logic_error("a field has not a value for each point");
        static_cast<void>(image.at(last, image.field.components - 1));
    }
}

/// What is read has the sizes that it says.
void readPoly(const std::filesystem::path& path) {
    const PolyData data = readPolyData(path);
    for (const auto& [fields, cells] :
         {std::pair{&data.pointFields, false}, std::pair{&data.cellFields, true}})
        for (const PolyDataField& field : *fields) {
            if (field.size() % field.components != 0) throw std::logic_error("a field has half a value");
            if (!cells && field.size() > 0) static_cast<void>(field.at(field.size() - 1));
        }
    for (const std::int32_t corner : data.corners)
        static_cast<void>(data.points.at(static_cast<std::size_t>(corner)));
}

}  // namespace

Target polyData() {
    return {"PolyData", [] { return std::vector{grains()}; },
            [](std::string_view bytes) { return takesFile("grains.vtp", bytes, readPoly); }};
}

Target fieldImage() {
    return {"FieldImage", [] { return std::vector{fields()}; },
            [](std::string_view bytes) { return takesFile("fields.vti", bytes, readImage); }};
}

Target paraViewSeries() {
    return {"ParaViewSeries", [] { return std::vector{series()}; },
            [](std::string_view bytes) {
                return takesFile("run.pvd", bytes, [](const auto& path) { readParaViewSeries(path); });
            }};
}

}  // namespace pendular::fuzz
