/// Writes Kernel/Features/LiquidBridges/YoungLaplace/BridgeTableNumbers.cpp: the exact liquid bridge as a
/// table, from the Young-Laplace solver.

#include <fmt/format.h>

#include <cstdio>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTableMaking.h"

using namespace pendular;

namespace {

void printProduct(const auto& product) {
    std::string line = "    {{{";
    for (const std::int32_t number : product.coefficients) {
        const std::string text = fmt::format("{},", number);
        if (line.size() + text.size() > 110) {
            fmt::print("{}\n", line);
            line = "       ";
        }
        line += text;
    }
    line.pop_back();
    fmt::print("{}}}}}}},\n", line);
}

void printTable(const BridgeTable& table) {
    fmt::print(
        "// Written by make-bridge-table; not by hand.\n// clang-format off\n\n"
        "#include \"Kernel/Features/LiquidBridges/YoungLaplace/BridgeTable.h\"\n\nnamespace pendular {{\n\n"
        "const std::uint64_t bridgeTableChecksum = {:#x};\n\nconst BridgeTable bridgeTable{{\n",
        checksum(table));
    printProduct(table.rupture);
    printProduct(table.force);
    printProduct(table.area);
    fmt::print("}};\n\n}}  // namespace pendular\n");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Prints the source file of the table of exact liquid bridges; takes some seconds.");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        printTable(makeBridgeTable());
        return 0;
    });
}
