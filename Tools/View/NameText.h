#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pendular::view {

/// A name of a file or folder, or a path, as a text that JSON can have. A name may have any bytes: those that
/// are no UTF-8 are written "%E9", and "%" is "%25", so that the text leads back to the name.
std::string textOfName(std::string_view name);

/// The name that has this text; nothing where none has it.
std::optional<std::string> nameOfText(std::string_view text);

}  // namespace pendular::view
