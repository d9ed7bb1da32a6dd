#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace pendular {

/// A table of comma-separated values, written beside its name and renamed when it is complete, so that no
/// reader meets half a file. The header names each column with its unit: "time_s,separation_m".
class CsvFile {
public:
    /// Throws InputError if the file cannot be written.
    CsvFile(std::filesystem::path path, std::string_view header);
    CsvFile(const CsvFile&) = delete;
    CsvFile& operator=(const CsvFile&) = delete;
    ~CsvFile();

    /// One line; numbers with all their digits.
    template <class... Values>
    void row(const Values&... values) {
        std::string line;
        (fmt::format_to(std::back_inserter(line), "{},", values), ...);
        line.back() = '\n';
        write(line);
    }
    /// A line as it is.
    void line(std::string_view text) { write(fmt::format("{}\n", text)); }
    /// A line of its own, for comments that begin with '#'.
    void comment(std::string_view text) { write(fmt::format("# {}\n", text)); }

    /// Completes the file under its name. Throws InputError if that fails (a full disk).
    void close();

private:
    void write(std::string_view text);
    [[noreturn]] void fail(std::string_view what) const;

    std::filesystem::path target;
    std::filesystem::path beside;
    std::FILE* file = nullptr;
};

}  // namespace pendular
