#include "Kernel/Analysis/Output/Hdf5Columns.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"

namespace pendular {

PolyDataField readColumn(const Hdf5File& file, const std::string& name) {
    const auto shape = file.shapeOf(name);
    PolyDataField column{name.substr(name.rfind('/') + 1), shape ? shape->columns : 0, {}};
    const auto take = [&]<class Number>(Number) {
        std::vector<Number> numbers(shape->rows * shape->columns);
        file.read(name, *shape, numbers.data());
        column.numbers = std::move(numbers);
    };
    const bool isRow = column.components >= 1 && column.components <= 9;
    if (isRow && shape->kind == NumberKind::Float32) take(float{});
    else if (isRow && shape->kind == NumberKind::Float64) take(double{});
    else if (isRow && shape->kind == NumberKind::Int32) take(std::int32_t{});
    else
        throw InputError(fmt::format("The file {} has no column of one to nine numbers at {}.",
                                     file.path().string(), printable(name)));
    return column;
}

std::vector<PolyDataField> readColumns(const Hdf5File& file, const std::string& group) {
    std::vector<PolyDataField> columns;
    for (const std::string& name : file.names())
        if (name.starts_with(group + "/") && name.find('/', group.size() + 1) == name.npos)
            columns.push_back(readColumn(file, name));
    return columns;
}

}  // namespace pendular
