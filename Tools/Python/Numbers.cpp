#include "Tools/Python/Numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <limits>
#include <memory>
#include <variant>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::python {

namespace {

/// In one line.
std::string shown(py::handle given) {
    std::string text =
        py::str(" ").attr("join")(py::str(py::repr(given)).attr("split")()).cast<std::string>();
    if (text.size() <= 60) return text;
    std::size_t end = 57;
    while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // within a letter of UTF-8
    return text.substr(0, end) + "...";
}

/// (4, 2)
std::string shapeOf(const py::array& numbers) { return py::str(numbers.attr("shape")); }

/// To numbers of another type, also of less range: numpy's safe conversion gives nothing at all of some.
template <class Array>
Array converted(const py::array& any, std::string_view name, std::string_view what) {
    using Number = typename Array::value_type;
    using Converted = py::array_t<Number, py::array::c_style | py::array::forcecast>;
    auto made = arrayOrNone<Converted>(any);
    if (!made) refuseGiven(any, name, what);
    return arrayOrNone<Array>(made);
}

template <class Array>
Array numbersOf(py::handle given, std::string_view name, std::string_view what) {
    // numpy would read text as numbers, and take the real part of complex ones.
    const py::array any = arrayOrNone<py::array>(given);
    if (!any || std::string_view("bifu").find(any.dtype().kind()) == std::string_view::npos)
        refuseGiven(given, name, what);
    return converted<Array>(any, name, what);
}

/// Copies n rows of numbers into an array.
template <std::size_t n>
Doubles copied(const std::array<double, n>& numbers, std::vector<py::ssize_t> shape) {
    Doubles made(std::move(shape));
    std::copy(numbers.begin(), numbers.end(), made.mutable_data());
    return made;
}

}  // namespace

void refuseGiven(py::handle given, std::string_view name, std::string_view what) {
    throw InputError(fmt::format("{} must be {}; it is {}.", name, what, shown(given)));
}

bool isTrue(const py::object& given) {
    const int answer = PyObject_IsTrue(given.ptr());
    if (answer < 0) throw py::error_already_set();
    return answer > 0;
}

bool isFalse(const py::object& given) {
    if (!py::isinstance<py::bool_>(given) &&
        !py::isinstance(given, py::object(py::dtype::of<bool>().attr("type"))))
        return false;
    return !isTrue(given);
}

Vec3D vectorOf(py::handle given, std::string_view name) {
    const Doubles numbers = numbersOf<Doubles>(given, name, "three numbers");
    if (numbers.ndim() != 1 || numbers.size() != 3) refuseGiven(given, name, "three numbers");
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

Doubles arrayOf(const Vec3D& vector) { return copied<3>({vector.x(), vector.y(), vector.z()}, {3}); }

Doubles arrayOf(const Eigen::Matrix3d& matrix) {
    Doubles made({3, 3});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) made.mutable_at(row, column) = matrix(row, column);
    return made;
}

Doubles rowsOf(const ArrayLike& given, std::string_view name, py::ssize_t width) {
    const std::string what = width == 1 ? "numbers" : fmt::format("rows of {} numbers", width);
    Doubles numbers = numbersOf<Doubles>(given.given, name, what);
    if (width == 1 ? numbers.ndim() != 1
                   : numbers.ndim() != 2 || (numbers.shape(1) != width && numbers.size() > 0))
        throw InputError(
            fmt::format("{} must be {}; it is an array of the shape {}.", name, what, shapeOf(numbers)));
    return numbers;
}

std::vector<std::uint32_t> identitiesOf(const ArrayLike& given, std::string_view name) {
    const py::array any = arrayOrNone<py::array>(given.given);
    if (!any || any.ndim() > 1 ||
        (any.size() > 0 && std::string_view("iu").find(any.dtype().kind()) == std::string_view::npos))
        refuseGiven(given.given, name, "whole numbers");
    // A number that 64 bits with a sign do not hold becomes negative, which is refused below.
    const Integers numbers = converted<Integers>(any, name, "whole numbers");
    std::vector<std::uint32_t> made;
    for (py::ssize_t k = 0; k < numbers.size(); ++k) {
        const std::int64_t number = numbers.data()[k];
        if (number < 0 || number > std::numeric_limits<std::int32_t>::max())
            throw InputError(fmt::format("{} has {}, which is no number of one.", name, number));
        made.push_back(static_cast<std::uint32_t>(number));
    }
    return made;
}

PerGrain::PerGrain(const ArrayLike& given, std::string_view name, py::ssize_t width, py::ssize_t count) {
    const std::string what =
        width == 1 ? "one number, or one for each grain" : "three numbers, or a row of three for each grain";
    rows = numbersOf<Doubles>(given.given, name, what);
    single = rows.size() == width && rows.ndim() < (width == 1 ? 1 : 2);
    const bool isEach = rows.ndim() == (width == 1 ? 1 : 2) && rows.shape(0) == count &&
                        (width == 1 || rows.shape(1) == width);
    if (!single && !isEach)
        throw InputError(fmt::format("{} must be {}; there are {} grains, and it has the shape {}.", name,
                                     what, count, shapeOf(rows)));
    first = rows.data();
}

py::array arrayOf(std::vector<Vector<double>>&& points) {
    static_assert(sizeof(Vector<double>) == 3 * sizeof(double));
    const auto count = static_cast<py::ssize_t>(points.size());
    auto kept = std::make_unique<std::vector<Vector<double>>>(std::move(points));
    auto* const data = reinterpret_cast<double*>(kept->data());
    const py::capsule owner(kept.release(),
                            [](void* memory) { delete static_cast<std::vector<Vector<double>>*>(memory); });
    return py::array(py::dtype::of<double>(), {count, py::ssize_t{3}}, data, owner);
}

py::array arrayOf(PolyDataField&& field) {
    return std::visit(
        [&](auto&& numbers) {
            std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(numbers.size() / field.components)};
            if (field.components == 9) shape.insert(shape.end(), {3, 3});
            else if (field.components > 1) shape.push_back(static_cast<py::ssize_t>(field.components));
            return arrayOf(std::move(numbers), std::move(shape));
        },
        std::move(field.numbers));
}

const char* comment(std::string_view name, std::string_view arguments) {
    static std::deque<std::string> all;
    std::string text = comment(name);
    text.resize(
        std::min(text.find('\n'), text.size()));  // arguments of the kernel follow in lines of their own
    return all.emplace_back(text.append("\n\n").append(arguments)).c_str();
}

std::string camelCase(std::string_view name) {
    std::string made;
    bool isStart = false;
    for (const char letter : name) {
        if (letter == '_') isStart = true;
        else {
            made += isStart ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
            isStart = false;
        }
    }
    return made;
}

std::string snakeCase(std::string_view name) {
    std::string made;
    for (const char letter : name) {
        if (std::isupper(static_cast<unsigned char>(letter)) != 0 && !made.empty()) made += '_';
        made += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return made;
}

}  // namespace pendular::python
