#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

/// Numbers on their way from numpy to the kernel and back.

namespace pendular::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style>;
using Integers = py::array_t<std::int64_t, py::array::c_style>;

/// Anything that numpy makes an array of.
struct ArrayLike {
    py::object given;
};

/// An argument that help() shows as Of; the function that takes it reads it by valueOf(), with a sentence of
/// its own for what is none. (pybind11 would list all types of all arguments instead.)
template <class Of>
struct Given {
    py::object object;
};

/// What numpy makes of it, or a null object where it makes nothing. What ends a program, as Ctrl-C, is thrown
/// on: array::ensure() of pybind11 forgets it, and the argument would get the blame.
template <class Array>
Array arrayOrNone(py::handle given) {
    try {
        return Array(py::reinterpret_borrow<py::object>(given));
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_Exception)) throw;
        return py::reinterpret_steal<Array>(py::handle());
    }
}

/// What InputError says of an argument or an answer that is something else. @param what "a number"
[[noreturn]] void refuseGiven(py::handle given, std::string_view name, std::string_view what);
/// Throws InputError, with that, where it is none.
template <class Of>
Of valueOf(py::handle given, std::string_view name, std::string_view what) {
    try {
        return given.cast<Of>();
    } catch (const py::cast_error&) {
        refuseGiven(given, name, what);
    }
}
template <class Of>
Of valueOf(const Given<Of>& given, std::string_view name, std::string_view what) {
    return valueOf<Of>(given.object, name, what);
}

/// Whether Python takes it as true.
bool isTrue(const py::object& given);
/// Whether it is the truth value False, also numpy's; None and 0 are not.
bool isFalse(const py::object& given);

/// Three numbers. Throws InputError, with the name, for anything else.
Vec3D vectorOf(py::handle given, std::string_view name = "A vector");
Doubles arrayOf(const Vec3D& vector);
inline Doubles arrayOf(const Vector<double>& vector) { return arrayOf(toEigen(vector)); }
Doubles arrayOf(const Eigen::Matrix3d& matrix);

/// Numbers in rows of the same width; a width of 1 is a list of numbers. Throws InputError, with the name,
/// for another shape, and for what are no numbers.
Doubles rowsOf(const ArrayLike& given, std::string_view name, py::ssize_t width);
/// Identities of grains, or other whole numbers from 0 on.
std::vector<std::uint32_t> identitiesOf(const ArrayLike& given, std::string_view name);

/// A number or a vector for each of several grains, or one for all of them.
class PerGrain {
public:
    /// Throws InputError unless there is one row, or one for each.
    PerGrain(const ArrayLike& given, std::string_view name, py::ssize_t width, py::ssize_t count);
    [[nodiscard]] double number(py::ssize_t k) const { return first[single ? 0 : k]; }
    [[nodiscard]] Vec3D vector(py::ssize_t k) const {
        const double* const row = first + (single ? 0 : 3 * k);
        return {row[0], row[1], row[2]};
    }

private:
    Doubles rows;
    const double* first;
    bool single;
};

/// An array that takes over the memory of a vector, without a copy.
template <class Number>
py::array arrayOf(std::vector<Number>&& numbers, std::vector<py::ssize_t> shape) {
    auto kept = std::make_unique<std::vector<Number>>(std::move(numbers));
    Number* const data = kept->data();
    const py::capsule owner(kept.release(),
                            [](void* memory) { delete static_cast<std::vector<Number>*>(memory); });
    return py::array(py::dtype::of<Number>(), std::move(shape), data, owner);
}
template <class Number>
py::array arrayOf(std::vector<Number>&& numbers) {
    const auto count = static_cast<py::ssize_t>(numbers.size());
    return arrayOf(std::move(numbers), {count});
}
py::array arrayOf(std::vector<Vector<double>>&& points);
/// Rows of a field: numbers, vectors or 3 x 3 tensors.
py::array arrayOf(PolyDataField&& field);

/// effective_elastic_modulus -> effectiveElasticModulus
std::string camelCase(std::string_view name);
/// effectiveElasticModulus -> effective_elastic_modulus
std::string snakeCase(std::string_view name);

/// What help() says: the comment of the kernel at this function or class, "Scene::setPeriodic", with names as
/// they are in Python. make-comments.py takes it from the header as the module is built.
const char* comment(std::string_view name);
/// The same, with what arguments are, and units, where the kernel has them in other functions.
const char* comment(std::string_view name, std::string_view arguments);

}  // namespace pendular::python

namespace pybind11::detail {

template <>
struct type_caster<pendular::python::ArrayLike> {
    PYBIND11_TYPE_CASTER(pendular::python::ArrayLike, const_name("ArrayLike"));
    bool load(handle source, bool) {
        if (!source || source.is_none()) return false;
        value.given = reinterpret_borrow<object>(source);
        return true;
    }
};

template <class Of>
struct type_caster<pendular::python::Given<Of>> {
    PYBIND11_TYPE_CASTER(pendular::python::Given<Of>, make_caster<Of>::name);
    bool load(handle source, bool) {
        if (!source) return false;
        value.object = reinterpret_borrow<object>(source);
        return true;
    }
};

template <>
struct type_caster<pendular::Vec3D> {
    PYBIND11_TYPE_CASTER(pendular::Vec3D, const_name("Vector"));
    bool load(handle source, bool) {
        value = pendular::python::vectorOf(source);
        return true;
    }
    static handle cast(const pendular::Vec3D& vector, return_value_policy, handle) {
        return pendular::python::arrayOf(vector).release();
    }
};

}  // namespace pybind11::detail
