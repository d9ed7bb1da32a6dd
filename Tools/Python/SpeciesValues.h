#pragma once

#include <map>
#include <string>
#include <string_view>

#include "Kernel/Laws/Species/AnySpecies.h"
#include "Tools/Python/Numbers.h"

/// Values of a species by the names that users give them.

namespace pendular::python {

/// The name of a type in the kernel: "Species" at its end may be left out.
std::string typeNamed(std::string name);
std::string withoutEnding(std::string_view name);

/// By their names in the kernel.
using Values = std::map<std::string, double>;
Values valuesOf(const py::kwargs& given);
/// Young's modulus may be given as elasticModulus, with Poisson's ratio beside it.
void nameYoungModulus(Values& values);
/// Throws InputError where a name is unknown, lacks another one beside it, or two give the same field; the
/// values do not matter.
void checkNames(AnyLaws& laws, const Values& values);
/// Sets fields, and calls the setters all of whose values are given. Where one is refused, all are as before.
void setValues(AnyLaws& laws, const Values& values);

/// As users give a value of a setter.
std::string nameOfSetter(const NamedSetter& setter, const SetterValue& value);
/// "collision_time, restitution_coefficient and mass", of each setter that takes this value and others; empty
/// where there is none.
std::string togetherWith(AnyLaws& laws, const std::string& name);
/// Throws InputError. @param name as it was not found
[[noreturn]] void refuseName(AnyLaws& laws, const std::string& name);

}  // namespace pendular::python
