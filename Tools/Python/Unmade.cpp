#include "Tools/Python/Unmade.h"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace py = pybind11;

/// pybind11 gives an object without content memory where it is first used, for constructors that fill it
/// later; all of this module make their content themselves. So a function that would give this memory is
/// called for objects that were never made alone, and is told a size and no class: each class has its own.

namespace pendular::python {

namespace {

constexpr std::size_t mostClasses = 32;

std::array<std::string, mostClasses>& names() {
    static auto* const all = new std::array<std::string, mostClasses>;  // the interpreter may end after it
    return *all;
}

template <std::size_t number>
void* refuse(std::size_t /*size*/) {
    const std::string& name = names()[number];
    throw py::type_error("This " + name + " was made by __new__() alone and has no content; call " + name +
                         "(), or the function that returns one.");
}

template <std::size_t... numbers>
constexpr auto refusals(std::index_sequence<numbers...> /*all*/) {
    return std::array{&refuse<numbers>...};
}

}  // namespace

void refuseUnmadeObjects(py::module_& module) {
    constexpr auto ofClasses = refusals(std::make_index_sequence<mostClasses>());
    std::size_t count = 0;
    for (const auto& [key, member] : py::dict(module.attr("__dict__"))) {
        if (!PyType_Check(member.ptr())) continue;
        py::detail::type_info* const type =
            py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(member.ptr()));
        if (!type) continue;  // an error
        if (count == mostClasses) throw std::length_error("Unmade.cpp: mostClasses is too small.");
        names()[count] = py::str(key);
        type->operator_new = ofClasses[count++];
    }
}

}  // namespace pendular::python
