#include "Kernel/Features/SizeDistributions/SizeTable.h"

#include <cmath>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfTable = "SizeDistribution";

/// How far a sum of fractions with six digits may be from the whole.
constexpr double sumTolerance = 1e-6;

void checkTable(std::span<const double> diameters, std::span<const double> values, std::size_t expected,
                std::string_view what) {
    if (diameters.empty() || values.size() != expected)
        throw InputError(fmt::format("{}: {} diameters need {} values of {}, but there are {}.", ownerOfTable,
                                     diameters.size(), expected, what, values.size()));
    for (std::size_t k = 0; k < diameters.size(); ++k) {
        checkValue(ownerOfTable, "diameter", diameters[k], "m", diameterRange);
        if (k > 0 && !(diameters[k] > diameters[k - 1]))
            throw InputError(fmt::format("{}: the diameter {:g} m follows {:g} m; diameters must increase.",
                                         ownerOfTable, diameters[k], diameters[k - 1]));
    }
    for (const double value : values) checkValue(ownerOfTable, what, value, "", notNegative);
}

/// m^(k+1), the integral of d^k over a class.
double integralOfPower(double low, double high, int k) {
    return (std::pow(high, k + 1) - std::pow(low, k + 1)) / (k + 1);
}

}  // namespace

SizeDistribution sizesFromClasses(std::span<const double> edges, std::span<const double> fractions,
                                  SizeBasis basis, InClass within) {
    checkTable(edges, fractions, edges.empty() ? 0 : edges.size() - 1, "fraction of a class");
    // The density of numbers is A d^-p, with p = 0 (even in number) or that of the basis r; the class has
    // A times the integral of d^(r - p) on the basis.
    const bool isEvenInNumber = within == InClass::EvenInNumber;
    const int ofClass = isEvenInNumber ? static_cast<int>(basis) : 0;
    std::vector<SizePanel> panels;
    for (std::size_t k = 0; k < fractions.size(); ++k) {
        const double amount = fractions[k] / integralOfPower(edges[k], edges[k + 1], ofClass);
        panels.push_back({edges[k], edges[k + 1], amount, amount, k});
    }
    return {std::move(panels), isEvenInNumber ? SizeBasis::Number : basis};
}

SizeDistribution sizesFromCumulative(std::span<const double> diameters, std::span<const double> cumulative,
                                     SizeBasis basis, InClass within) {
    checkTable(diameters, cumulative, diameters.size(), "cumulative fraction");
    if (cumulative.front() != 0 || !(std::abs(cumulative.back() - 1) <= 1e-9))
        throw InputError(fmt::format(
            "{}: the cumulative fraction goes from {:g} to {:g}; it must go from 0 to 1 (begin with the "
            "diameter that no grain is smaller than).",
            ownerOfTable, cumulative.front(), cumulative.back()));
    std::vector<double> fractions;
    for (std::size_t k = 1; k < cumulative.size(); ++k) {
        if (cumulative[k] < cumulative[k - 1])
            throw InputError(fmt::format("{}: the cumulative fraction falls from {:g} to {:g} at {:g} m.",
                                         ownerOfTable, cumulative[k - 1], cumulative[k], diameters[k]));
        fractions.push_back(cumulative[k] - cumulative[k - 1]);
    }
    return sizesFromClasses(diameters, fractions, basis, within);
}

SizeDistribution sizesFromDensity(std::span<const double> diameters, std::span<const double> densities,
                                  SizeBasis basis) {
    checkTable(diameters, densities, diameters.size(), "density");
    std::vector<SizePanel> panels;
    for (std::size_t k = 1; k < diameters.size(); ++k)
        panels.push_back({diameters[k - 1], diameters[k], densities[k - 1], densities[k], k - 1});
    return {std::move(panels), basis};
}

SizeDistribution singleSizes(std::span<const double> diameters, std::span<const double> fractions,
                             SizeBasis basis) {
    checkTable(diameters, fractions, diameters.size(), "fraction of a size");
    std::vector<SizePanel> panels;
    for (std::size_t k = 0; k < diameters.size(); ++k) {
        const double number = fractions[k] / std::pow(diameters[k], static_cast<int>(basis));
        panels.push_back({diameters[k], diameters[k], number, number, k});
    }
    return {std::move(panels), SizeBasis::Number};
}

namespace {

enum class TableKind { Cumulative, Class, Single, Density };

/// The columns, as the first line of a file says them.
struct TableColumns {
    double scale;  // m, of one unit as a diameter
    TableKind kind;
    SizeBasis basis;
    double whole;  // 1 or 100
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && Words::isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && Words::isSpace(text.back())) text.remove_suffix(1);
    return text;
}

/// The cells of a line, which commas part.
std::vector<std::string_view> cellsOf(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0;;) {
        const std::size_t comma = line.find(',', begin);
        cells.push_back(trimmed(line.substr(begin, comma - begin)));
        if (comma == line.npos) return cells;
        begin = comma + 1;
    }
}

/// The value beside a name; nothing if it is not there.
template <class Value, std::size_t n>
std::optional<Value> lookUp(const std::pair<std::string_view, Value> (&table)[n], std::string_view name) {
    for (const auto& [key, value] : table)
        if (key == name) return value;
    return {};
}

std::optional<double> scaleOf(std::string_view name) {
    static constexpr std::pair<std::string_view, double> scales[] = {
        {"diameter_m", 1}, {"diameter_mm", 1e-3}, {"diameter_um", 1e-6},
        {"radius_m", 2},   {"radius_mm", 2e-3},   {"radius_um", 2e-6}};
    return lookUp(scales, name);
}

std::optional<TableColumns> tableColumnsOf(std::string_view line) {
    static constexpr std::pair<std::string_view, TableKind> kinds[] = {{"cumulative", TableKind::Cumulative},
                                                                       {"class", TableKind::Class},
                                                                       {"single", TableKind::Single},
                                                                       {"density", TableKind::Density}};
    static constexpr std::pair<std::string_view, SizeBasis> bases[] = {{"number", SizeBasis::Number},
                                                                       {"length", SizeBasis::Length},
                                                                       {"area", SizeBasis::Area},
                                                                       {"volume", SizeBasis::Volume},
                                                                       {"mass", SizeBasis::Volume}};
    const std::vector<std::string_view> cells = cellsOf(line);
    if (cells.size() != 2) return {};
    std::string_view second = cells[1];
    constexpr std::string_view percent = "_percent";
    const bool isPercent = second.ends_with(percent);
    if (isPercent) second.remove_suffix(percent.size());
    const std::size_t bar = second.find('_');
    if (bar == second.npos) return {};
    const auto scale = scaleOf(cells[0]);
    const auto kind = lookUp(kinds, second.substr(0, bar));
    const auto basis = lookUp(bases, second.substr(bar + 1));
    if (!scale || !kind || !basis || (*kind == TableKind::Density && isPercent)) return {};
    return TableColumns{*scale, *kind, *basis, isPercent ? 100.0 : 1.0};
}

struct Rows {
    TableColumns columns;
    std::vector<double> diameters, values;  // m; of the whole
    std::size_t lastLine = 0;
};

/// A cell as a number that is not negative and finite.
double numberIn(const InputFile& file, std::size_t line, std::string_view cell, std::string_view what) {
    double number = unset;
    if (!parseNumber(cell, number))
        file.refuse("line", line, fmt::format("the {} {}", what, whyNoNumber(cell)));
    if (!notNegative.contains(number))
        file.refuse("line", line,
                    fmt::format("the {} is {:g}; it must be 0 or more, and finite", what, number));
    return number;
}

void addRow(const InputFile& file, std::size_t line, std::string_view text, Rows& rows) {
    const std::vector<std::string_view> cells = cellsOf(text);
    if (cells.size() != 2)
        file.refuse("line", line,
                    fmt::format("{} column{}; there must be 2, parted by a comma (decimals have a point)",
                                cells.size(), cells.size() == 1 ? "" : "s"));
    const double diameter = rows.columns.scale * numberIn(file, line, cells[0], "size");
    const double value = numberIn(file, line, cells[1], "value") / rows.columns.whole;
    if (!diameterRange.contains(diameter))
        file.refuse("line", line,
                    fmt::format("the diameter is {:g} m; it must be {}", diameter, diameterRange.text("m")));
    if (!rows.diameters.empty() && !(diameter > rows.diameters.back()))
        file.refuse("line", line, "the size is not larger than that of the row before");
    const bool isCumulative = rows.columns.kind == TableKind::Cumulative;
    if (rows.diameters.empty() && (isCumulative || rows.columns.kind == TableKind::Class) && value != 0)
        file.refuse(
            "line", line,
            fmt::format(
                "the first value is {:g}; it must be 0, beside the size that no grain is smaller than",
                value * rows.columns.whole));
    if (isCumulative && !rows.values.empty() && value < rows.values.back())
        file.refuse("line", line, "the cumulative value is smaller than that of the row before");
    rows.diameters.push_back(diameter);
    rows.values.push_back(value);
    rows.lastLine = line;
}

Rows readSizeRows(const InputFile& file) {
    std::optional<TableColumns> columns;
    Rows rows;
    std::string_view rest = file.text;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (text.empty() || text.front() == '#') continue;
        if (columns) {
            addRow(file, line, text, rows);
            continue;
        }
        columns = tableColumnsOf(text);
        if (!columns) refuseOtherContent(file);
        if (!columns)
            file.refuse("line", line,
                        "the first line must name two columns, as in diameter_mm,cumulative_volume "
                        "(diameter or radius in m, mm or um; cumulative, class, single or density; number, "
                        "length, area, volume or mass; _percent where the whole is 100)");
        rows.columns = *columns;
    }
    if (!columns) file.refuse("has no line that names its columns, as in diameter_mm,cumulative_volume");
    return rows;
}

void checkWhole(const InputFile& file, const Rows& rows) {
    const auto [scale, kind, basis, whole] = rows.columns;
    if (rows.diameters.size() < (kind == TableKind::Single ? 1 : 2))
        file.refuse(fmt::format("has {} rows; there must be {} at least", rows.diameters.size(),
                                kind == TableKind::Single ? 1 : 2));
    if (kind == TableKind::Density) return;
    double sum = 0;
    for (const double value : rows.values) sum += value;
    if (kind == TableKind::Cumulative && !(std::abs(rows.values.back() - 1) <= 1e-9))
        file.refuse("line", rows.lastLine,
                    fmt::format("the cumulative values end at {:g}; they must end at {:g}",
                                rows.values.back() * whole, whole));
    if (kind != TableKind::Cumulative && !(std::abs(sum - 1) <= sumTolerance))
        file.refuse(fmt::format("has values whose sum is {:g}; it must be {:g}", sum * whole, whole));
}

}  // namespace

SizeDistribution readSizeTable(const std::filesystem::path& path, std::optional<InClass> within) {
    const InputFile file = loadTextFile("size table", path);
    const Rows rows = readSizeRows(file);
    checkWhole(file, rows);
    const std::span<const double> diameters = rows.diameters, values = rows.values;
    const SizeBasis basis = rows.columns.basis;
    const InClass inClass = within.value_or(InClass::EvenOnBasis);
    switch (rows.columns.kind) {
        case TableKind::Cumulative:
            return sizesFromCumulative(diameters, values, basis, inClass);
        case TableKind::Class:
            return sizesFromClasses(diameters, values.subspan(1), basis, inClass);
        case TableKind::Single:
            return singleSizes(diameters, values, basis);
        case TableKind::Density:
            break;
    }
    return sizesFromDensity(diameters, values, basis);
}

}  // namespace pendular
