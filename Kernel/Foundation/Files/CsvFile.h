#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

/// A table of comma-separated values. The header names each column with its unit: "time_s,separation_m".
class CsvFile {
public:
    /// Throws InputError if the file cannot be written.
    CsvFile(std::filesystem::path path, std::string_view header) : file(std::move(path)) { line(header); }
    /// Goes on with a table after its first bytes, as WrittenBeside says.
    CsvFile(std::filesystem::path path, std::string_view header, std::uintmax_t bytes)
        : file(std::move(path), bytes) {
        if (file.flush() == 0) line(header);
    }

    /// One line; numbers with all their digits. (Not by fmt::format_to, which is compiled again in every file
    /// that uses it: a fifth of the time to compile a driver.)
    template <class... Values>
    void row(const Values&... values) {
        std::string line;
        ((line += fmt::format("{},", values)), ...);
        line.back() = '\n';
        file.write(line);
    }
    /// A line as it is.
    void line(std::string_view text) { file.write(fmt::format("{}\n", text)); }
    /// A line of its own, for comments that begin with '#'.
    void comment(std::string_view text) { file.write(fmt::format("# {}\n", text)); }

    /// Waits until all rows are on the disk; returns how many bytes there are.
    std::uintmax_t flush() { return file.flush(); }
    /// Completes the file under its name. Throws InputError if that fails (a full disk).
    void close() { file.close(); }

private:
    WrittenBeside file;
};

}  // namespace pendular
