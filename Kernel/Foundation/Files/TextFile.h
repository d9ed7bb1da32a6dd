#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

/// A file of the user, whole in memory, and how it is refused.
struct InputFile {
    std::string kind;  // for messages: "triangle file"
    std::string name;
    std::string text;

    /// @param place what is counted ("line", "offset"); @param where its number
    template <class Place>
    [[noreturn]] void refuse(std::string_view place, Place where, std::string_view reason) const {
        throw InputError(fmt::format("The {} {}, {} {}: {}.", kind, name, place, where, reason));
    }
    /// @param column of the first character, from 1
    [[noreturn]] void refuseWord(std::size_t line, std::size_t column, std::string_view reason) const {
        refuse(fmt::format("line {}, column", line), column, reason);
    }
    [[noreturn]] void refuse(std::string_view reason) const {
        throw InputError(fmt::format("The {} {} {}.", kind, name, reason));
    }
};

/// Throws InputError unless the path is a regular file of 4 GiB at most that can be read.
InputFile loadInputFile(std::string_view kind, const std::filesystem::path& path);

/// Loads a text as loadInputFile() does, in one form: without the mark of UTF-8, and each line ended by a
/// line feed, whether the file has LF, CR LF or CR. Throws InputError for what is no text, and says what it
/// is.
InputFile loadTextFile(std::string_view kind, const std::filesystem::path& path);
/// Gives a file that is in memory the form that loadTextFile() gives, or throws.
void takeAsText(InputFile& file);
/// Throws InputError if the file is of a kind that recognise() knows; to be called where a reader of another
/// kind does not understand it.
void refuseOtherContent(const InputFile& file);

/// Takes the words of a text one by one and counts its lines.
class Words {
public:
    explicit Words(std::string_view source) : text(source) {}

    /// The next word; empty at the end.
    std::string_view next() {
        skipSpace();
        const std::size_t begin = at;
        while (at < text.size() && !isSpace(text[at])) ++at;
        return text.substr(begin, at - begin);
    }
    void skipLine() {
        while (at < text.size() && text[at] != '\n') ++at;
    }
    [[nodiscard]] std::size_t line() const { return lineNumber; }

    static bool isSpace(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
    }

private:
    void skipSpace() {
        for (; at < text.size() && isSpace(text[at]); ++at)
            if (text[at] == '\n') ++lineNumber;
    }

    std::string_view text;
    std::size_t at = 0;
    std::size_t lineNumber = 1;
};

/// A word in a message: short, and printable whatever the file holds.
std::string shown(std::string_view word);

/// Whether the whole word is a number.
bool parseNumber(std::string_view word, double& value);
/// Why a word is none, for a message.
std::string whyNoNumber(std::string_view word);

inline constexpr double largestLength = 1e9;  // m; of a coordinate or a radius in a file

/// A length in m, read and multiplied by the scale; empty, or why it is refused.
std::string parseLength(std::string_view word, double scale, double& value);

/// Reads rows of lengths, parted by blanks or by commas. Empty lines, lines that begin with # and a first
/// line of words (the names of the columns: the first one begins with a letter, and none is a number or
/// "l.0O1") are skipped. A row that has both commas within its words and blanks between them has decimal
/// commas, and is refused.
/// @param scale m for one unit of the file
/// @param use is given the number of the line, from 1, and the row's numbers (m)
void forEachRow(const InputFile& file, double scale,
                const std::function<void(std::size_t line, const std::vector<double>& row)>& use);

}  // namespace pendular
