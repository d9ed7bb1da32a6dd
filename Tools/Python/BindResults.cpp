#include <memory>

#include "Kernel/Analysis/Output/Hdf5Series.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

template <class Number>
py::object readNumbers(const Hdf5File& file, const std::string& name, const TableShape& shape) {
    py::array_t<Number> numbers({shape.rows, shape.columns});
    Number* const to = numbers.mutable_data();
    withoutPython([&] { file.read(name, shape, to); });
    return numbers;
}

py::object readTable(const Hdf5File& file, const std::string& name) {
    const auto shape = file.shapeOf(name);
    if (!shape) return py::bytes(file.readText(name));
    switch (shape->kind) {
        case NumberKind::Float64:
            return readNumbers<double>(file, name, *shape);
        case NumberKind::Float32:
            return readNumbers<float>(file, name, *shape);
        case NumberKind::UInt64:
            return readNumbers<std::uint64_t>(file, name, *shape);
        case NumberKind::UInt32:
            return readNumbers<std::uint32_t>(file, name, *shape);
        case NumberKind::Int32:
            return readNumbers<std::int32_t>(file, name, *shape);
        case NumberKind::UInt16:
            return readNumbers<std::uint16_t>(file, name, *shape);
        case NumberKind::UInt8:
            return readNumbers<std::uint8_t>(file, name, *shape);
    }
    return py::none();
}

/// All tables (rows x columns) and texts of an HDF5 file whose names begin so.
py::dict readTables(const std::filesystem::path& path, const std::string& begin) {
    const auto file = withoutPython([&] { return std::make_unique<Hdf5File>(path, Hdf5File::Access::Read); });
    py::dict tables;
    for (const std::string& name : file->names())
        if (name.starts_with(begin)) tables[py::str(name)] = readTable(*file, name);
    return tables;
}

std::vector<std::string> tableNames(const std::filesystem::path& path) {
    return withoutPython([&] { return Hdf5File(path, Hdf5File::Access::Read).names(); });
}

/// Time (s) and file of each frame of a list NAME.h5.
std::vector<std::pair<double, std::filesystem::path>> frameList(const std::filesystem::path& list) {
    std::vector<std::pair<double, std::filesystem::path>> frames;
    for (auto& [time, file] : withoutPython([&] { return readHdf5Series(list); }))
        frames.emplace_back(time, std::move(file));
    return frames;
}

}  // namespace

void bindResults(py::module_& module) {
    module.def("_read_tables", &readTables, py::arg("file"), py::arg("begin"));
    module.def("_frame_list", &frameList, py::arg("file"));
    module.def("_table_names", &tableNames, py::arg("file"));
}

}  // namespace pendular::python
