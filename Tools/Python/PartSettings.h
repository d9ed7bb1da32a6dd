#pragma once

#include <map>
#include <string>
#include <vector>

#include "Tools/Python/Bindings.h"

namespace pendular {
class StateArchive;
}

namespace pendular::python {

/// The settings of an object of Python that acts in the steps of a scene: what is in its dict `settings`, or
/// without that the numbers, texts and arrays of numbers among its own attributes. They are taken when the
/// object is given to the scene; a run that is resumed with others is refused.
class PartSettings {
public:
    PartSettings() = default;
    /// @param who "part 'still air'"; Throws InputError where `settings` is no dict of numbers and texts.
    PartSettings(const py::object& given, const std::string& who);

    void compare(StateArchive& archive) const;

private:
    std::map<std::string, std::vector<double>> numbers;
    std::map<std::string, std::string> texts;
};

}  // namespace pendular::python
