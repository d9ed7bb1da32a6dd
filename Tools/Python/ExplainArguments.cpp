#include "Tools/Python/ExplainArguments.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <unordered_map>

/// What is said of arguments that no function takes: a sentence of Package/_arguments.py, in the place of the
/// types of C++ that pybind11 lists.
///
/// pybind11 has one function in C for all that it binds, which Python calls. Each record of it is given
/// another one, which calls that, and looks only where an error comes back: 1 ns a call. (A last overload for
/// all other arguments would convert the arguments of each call twice, and help() would show it.)

namespace pendular::python {

namespace {

using FunctionOfC = PyObject* (*)(PyObject*, PyObject*, PyObject*);

FunctionOfC calledBefore = nullptr;
/// A function that is bound, under the name that users know: add_plane, Scene, time_step.
struct Known {
    std::string name;
    py::handle attribute;  // that it sets
    bool isMethod = false;
    py::handle function{};
};
/// By the object that C hands on, which lives as long as the module.
std::unordered_map<PyObject*, Known>& known() {
    static auto* const all = new std::unordered_map<PyObject*, Known>;
    return *all;
}
PyMethodDef* recordOf(py::handle function) {
    return reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
}

py::handle explain;  // of Package/_arguments.py

std::string textOf(PyObject* object) {
    const char* const text = object ? PyUnicode_AsUTF8(object) : nullptr;
    if (!text) PyErr_Clear();
    return text ? text : "";
}

/// The signature of a function as pybind11 quotes it in a message: with that of a constructor,
/// (self: Scene, name: str) -> None, it writes Scene(name: str).
/// @param help whose first line is the name and the signature
std::string quotedSignature(std::string_view help) {
    const std::size_t begin = help.find('(');
    if (begin == std::string_view::npos) return {};
    const std::string_view own = help.substr(begin, help.find('\n') - begin);
    constexpr std::string_view self = "(self: ";
    if (!help.starts_with("__init__") || !own.starts_with(self)) return std::string(own);
    const std::size_t end = own.find_first_of(",)"), arrow = own.rfind(" -> ");
    const std::size_t rest = own[end] == ',' ? end + 2 : end;
    return fmt::format("{}({}", own.substr(self.size(), end - self.size()), own.substr(rest, arrow - rest));
}

/// Said as it is, unless the sentence of Package/_arguments.py is better: of vectorOf(), and of memory.
bool isKept(const std::string& said) { return said.starts_with("A vector must be ") || said == outOfMemory; }

/// The sentence; null where the error is not of the arguments. By that pybind11 then quotes the signature:
/// its words change with its version, and what a function that is called raises has no such part.
PyObject* sentenceFor(const Known& of, const std::string& said, PyObject* arguments, PyObject* named) {
    const auto help = py::reinterpret_steal<py::object>(PyObject_GetAttrString(of.function.ptr(), "__doc__"));
    if (!help) return nullptr;
    const std::string quoted = quotedSignature(textOf(help.ptr()));
    if (!isKept(said) && (quoted.empty() || said.find(quoted) == std::string::npos)) return nullptr;
    const py::object kept = isKept(said) ? py::object(py::str(said)) : py::none();
    const py::object byName = named ? py::reinterpret_borrow<py::object>(named) : py::dict();
    return PyObject_CallFunction(explain.ptr(), "OsOOOO", kept.ptr(), of.name.c_str(), help.ptr(), arguments,
                                 byName.ptr(), of.attribute ? of.attribute.ptr() : Py_None);
}

/// Whether a method is called of None, for which pybind11 may hand a null pointer on.
bool isOfNone(PyObject* self, PyObject* arguments) {
    if (PyTuple_GET_SIZE(arguments) == 0 || PyTuple_GET_ITEM(arguments, 0) != Py_None) return false;
    const auto of = known().find(self);
    return of != known().end() && of->second.isMethod;
}

PyObject* callAndExplain(PyObject* self, PyObject* arguments, PyObject* named) {
    if (isOfNone(self, arguments)) {
        const std::string text = known().find(self)->second.name + " is of an object, and None has it not.";
        PyErr_SetString(PyExc_TypeError, text.c_str());
        return nullptr;
    }
    PyObject* const answer = calledBefore(self, arguments, named);
    if (answer || !explain) return answer;
    PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
    PyErr_Fetch(&type, &value, &trace);
    const auto of = known().find(self);
    const bool mayBe = PyErr_GivenExceptionMatches(type, PyExc_TypeError) ||
                       PyErr_GivenExceptionMatches(type, PyExc_ValueError) ||
                       PyErr_GivenExceptionMatches(type, PyExc_MemoryError);
    const auto said = py::reinterpret_steal<py::object>(mayBe && value ? PyObject_Str(value) : nullptr);
    if (of != known().end() && said)
        if (PyObject* const sentence = sentenceFor(of->second, textOf(said.ptr()), arguments, named)) {
            Py_XDECREF(value);
            value = sentence;
        }
    PyErr_Clear();
    PyErr_Restore(type, value, trace);
    return nullptr;
}

void explainOne(py::handle function, const Known& of) {
    if (!function || function.is_none()) return;
    if (PyInstanceMethod_Check(function.ptr())) function = PyInstanceMethod_Function(function.ptr());
    if (!PyCFunction_Check(function.ptr())) return;
    PyMethodDef* const record = recordOf(function);
    PyObject* const self = PyCFunction_GetSelf(function.ptr());
    const auto ours = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&callAndExplain));
    if (!self || record->ml_flags != (METH_VARARGS | METH_KEYWORDS) || record->ml_meth == ours) return;
    calledBefore = reinterpret_cast<FunctionOfC>(reinterpret_cast<void (*)()>(record->ml_meth));
    record->ml_meth = ours;
    known().emplace(self, Known{of.name, of.attribute, of.isMethod, function});
}

void explainClass(py::handle type) {
    const std::string own = py::str(type.attr("__name__"));
    for (const auto& [key, member] : py::dict(type.attr("__dict__"))) {
        const std::string name = py::str(key);
        if (py::isinstance(member, reinterpret_cast<PyObject*>(&PyProperty_Type))) {
            explainOne(member.attr("fset"), {name, member, true});
            explainOne(member.attr("fget"), {name, {}, true});
        } else explainOne(member, {name == "__init__" ? own : name, {}, true});
    }
}

}  // namespace

void explainArguments(py::module_& module) {
    for (const auto& [key, member] : py::dict(module.attr("__dict__"))) {
        if (PyType_Check(member.ptr())) explainClass(member);
        else explainOne(member, {std::string(py::str(key)), {}});
    }
    module.def(
        "_set_explanation", [](py::object function) { explain = function.release(); }, py::arg("function"));
}

}  // namespace pendular::python
