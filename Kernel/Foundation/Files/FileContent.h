#pragma once

#include <string_view>

namespace pendular {

/// The kind of a file by its bytes, whatever its name says.
enum class FileContent {
    Unknown,
    BinaryStl,
    AsciiStl,
    Obj,
    Ply,
    LammpsData,
    LammpsDump,
    OtherText,  ///< XML, HTML, STEP, ...
    NoText      ///< archives, pictures, UTF-16, ...
};

struct RecognisedContent {
    FileContent content = FileContent::Unknown;
    std::string_view name;    // for a message: "a PNG picture"; empty if unknown
    std::string_view advice;  // how it becomes a file that can be read; may be empty
};

/// Looks at the beginning of a file, and at its length for binary STL, which has no mark of its own.
RecognisedContent recognise(std::string_view bytes);

/// The mark of UTF-8 that some editors put at the beginning of a text.
inline constexpr std::string_view utf8Mark = "\xEF\xBB\xBF";

}  // namespace pendular
