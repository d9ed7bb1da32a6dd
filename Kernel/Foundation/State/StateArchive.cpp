#include "Kernel/Foundation/State/StateArchive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void StateArchive::refuseMissing(std::string_view name) const {
    throw InputError(fmt::format(
        "The restart file {} has no {} as this scene has it: it was written by another driver, for another "
        "species or with other options.",
        file->path().string(), fullName(name)));
}

void StateArchive::refuse(std::string_view name, std::string_view whatIsWrong) const {
    if (isReading())
        throw InputError(fmt::format(
            "The restart file {} is not consistent: {} {}; take another one, or start the run again.",
            file->path().string(), fullName(name), whatIsWrong));
    throw InputError(
        fmt::format("The state cannot be kept for a restart: {} {}.", fullName(name), whatIsWrong));
}

std::size_t StateArchive::rowsOf(std::string_view name, const TableShape& row) const {
    const std::string full = fullName(name);
    const auto shape = file->holds(full) ? file->shapeOf(full) : std::nullopt;
    if (!shape || shape->kind != row.kind || shape->columns != row.columns) refuseMissing(name);
    return shape->rows;
}

void StateArchive::transfer(std::string_view name, const TableShape& shape, void* numbers) {
    if (digest) return digest->add(prefix, name, std::exchange(unitOfNext, {}), shape, numbers);
    if (!isReading()) return file->write(fullName(name), shape, numbers);
    if (rowsOf(name, shape) != shape.rows)
        throw InputError(fmt::format("The restart file {} has another number of rows in {} than this scene.",
                                     file->path().string(), fullName(name)));
    file->read(fullName(name), shape, numbers);
}

void StateArchive::text(std::string_view name, std::string& content) {
    if (digest) return digest->add(prefix, name, content);
    if (!isReading()) return file->write(fullName(name), content);
    if (!file->holds(fullName(name))) refuseMissing(name);
    content = file->readText(fullName(name));
}

void StateArchive::same(std::string_view name, std::string_view text) {
    if (digest) return digest->add(prefix, name, text);
    if (!isReading()) return file->write(fullName(name), text);
    std::string kept;
    this->text(name, kept);
    requireSame(kept == text, name, kept, std::string(text), {},
                "a run goes on with the values it began with");
}

void StateArchive::sameValues(std::string_view name, std::vector<double> numbers, std::string_view unit) {
    unitOfNext = unit;
    std::vector<double> kept = numbers;
    column<double>(name, kept);
    unitOfNext = {};
    double largest = 0;
    for (const double number : kept)
        if (std::isfinite(number)) largest = std::max(largest, std::abs(number));
    const auto isNear = [&](double a, double b) {
        return a == b || (a != a && b != b) || std::abs(a - b) <= 1e-9 * largest;
    };
    const auto shownList = [](const std::vector<double>& list) {
        return shownNumbers({NumberKind::Float64, list.size(), 1}, list.data(), {});
    };
    requireSame(std::ranges::equal(kept, numbers, isNear), name, shownList(kept), shownList(numbers), unit,
                "a run goes on with the functions it began with");
}

std::string StateArchive::numberOfList(std::size_t at) { return fmt::format(", number {},", at); }

void StateArchive::requireSame(bool isSame, std::string_view name, const std::string& kept,
                               const std::string& now, std::string_view unit, std::string_view advice) const {
    if (isSame) return;
    const std::string space = unit.empty() ? "" : " ";
    throw InputError(
        fmt::format("The restart file {} does not fit this scene: {} is {}{}{} in the file and {}{}{} in the "
                    "scene; {}.",
                    file->path().string(), fullName(name), kept, space, unit, now, space, unit, advice));
}

/// A number is shown with all its digits: two numbers that are shown alike are equal, and so are two that are
/// not set.
std::string StateArchive::shown(double number) {
    return number == number ? fmt::format("{}", number) : std::string("not set");
}

}  // namespace pendular
