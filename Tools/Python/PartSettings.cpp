#include "Tools/Python/PartSettings.h"

#include <fmt/format.h>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular::python {

namespace {

bool isText(const py::handle& value) { return py::isinstance<py::str>(value); }

/// Whether it is a number, or an array of numbers: no list, whose conversion could run code of its own.
bool isNumbers(const py::handle& value) {
    if (py::isinstance<py::array>(value))
        return std::string_view("fiub").find(py::reinterpret_borrow<py::array>(value).dtype().kind()) !=
               std::string_view::npos;
    return py::isinstance<py::float_>(value) || py::isinstance<py::int_>(value);
}

}  // namespace

PartSettings::PartSettings(const py::object& given, const std::string& who) {
    const bool areGiven = py::hasattr(given, "settings");
    py::object from = py::getattr(given, areGiven ? "settings" : "__dict__", py::dict());
    if (!py::isinstance<py::dict>(from))
        throw InputError(fmt::format("{}: settings must be a dict of numbers and texts by name.", who));
    const py::dict attributes(from);
    for (const auto& [key, value] : attributes) {
        const std::string name = py::str(key);
        const bool isUsable = !name.empty() && name.find('/') == std::string::npos;
        if (isText(value) && isUsable) {
            texts.emplace(name, py::str(value));
            continue;
        }
        const bool areNumbers = isUsable && isNumbers(value);
        if (!areNumbers && !areGiven) continue;  // an object, a function, its state
        const Doubles column =
            areNumbers ? arrayOrNone<Doubles>(py::reinterpret_borrow<py::object>(value)) : Doubles();
        if (!areNumbers || !column) {
            throw InputError(
                fmt::format("{}: settings['{}'] must be a number, an array of numbers or a text, "
                            "and its name must have a letter, and no /.",
                            who, name));
        }
        numbers.emplace(name, std::vector<double>(column.data(), column.data() + column.size()));
    }
}

void PartSettings::compare(StateArchive& archive) const {
    std::string names;
    for (const auto& [name, own] : numbers) names += name + " ";
    for (const auto& [name, own] : texts) names += name + " ";
    archive.group("settings", [&] {
        archive.same("names of settings", names);
        for (const auto& [name, own] : numbers) archive.same<double>(name, std::span<const double>(own));
        for (const auto& [name, own] : texts) archive.same(name, own);
    });
}

}  // namespace pendular::python
