#pragma once

#include <string>
#include <string_view>

namespace pendular {

/// Checks the beginning of the names of files: folders may be in it, but it ends with a name, which is
/// neither empty ("runs/") nor "." or "..", and has no characters that cannot be printed (a NUL would end
/// it). Throws InputError, "OWNER: name = 'runs/' ...".
void requireFileName(std::string_view owner, std::string_view name);

/// A part of a name of a file, of a column, or of a field, or a unit in one: letters, digits and _, so that
/// XML, HDF5 and tables hold it as it is.
[[nodiscard]] bool isWord(std::string_view text);

/// A text of a user in a sentence: what cannot be printed as ?.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace pendular
