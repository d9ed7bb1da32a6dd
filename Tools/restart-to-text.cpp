/// Prints what is in a restart file, as text.

#include <fmt/format.h>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/State/RestartFile.h"

using namespace pendular;

namespace {

template <class Number>
void printRows(const Hdf5File& file, const std::string& name, const TableShape& shape) {
    std::vector<Number> numbers(shape.rows * shape.columns);
    file.read(name, shape, numbers.data());
    for (std::size_t row = 0; row < shape.rows; ++row) {
        std::string line;
        for (std::size_t k = 0; k < shape.columns; ++k)
            line += fmt::format("{}{}", k > 0 ? " " : "", numbers[row * shape.columns + k]);
        fmt::print("{}\n", line);
    }
}

void print(const Hdf5File& file, const std::string& name, const TableShape& shape) {
    switch (shape.kind) {
        case NumberKind::Float64:
            return printRows<double>(file, name, shape);
        case NumberKind::Float32:
            return printRows<float>(file, name, shape);
        case NumberKind::UInt64:
            return printRows<std::uint64_t>(file, name, shape);
        case NumberKind::UInt32:
            return printRows<std::uint32_t>(file, name, shape);
        case NumberKind::Int32:
            return printRows<std::int32_t>(file, name, shape);
        case NumberKind::UInt16:
            return printRows<std::uint16_t>(file, name, shape);
        case NumberKind::UInt8:
            return printRows<std::uint8_t>(file, name, shape);
    }
}

void print(const std::string& path, const std::string& begin, bool namesOnly) {
    requireRestartFiles();
    checkRestartFile(path);
    const Hdf5File file(path, Hdf5File::Access::Read);
    for (const std::string& name : file.names()) {
        if (!name.starts_with(begin)) continue;
        const auto shape = file.shapeOf(name);
        if (!shape) {
            fmt::print("# {}: text\n{}\n", name, file.readText(name));
            continue;
        }
        fmt::print("# {}: {} x {}\n", name, shape->rows, shape->columns);
        if (!namesOnly) print(file, name, *shape);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints what is in a restart file: its tables, each after a line with its name, rows and columns.\n"
        "Numbers have all their digits; the page on output says what they mean.");
    std::string path, begin;
    bool namesOnly = false;
    app.add_option("file", path, "the restart file")->required();
    app.add_option("--begin", begin, "only tables whose name starts with this, for example particles/");
    app.add_flag("--names", namesOnly, "names, rows and columns only");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        print(path, begin, namesOnly);
        return 0;
    });
}
