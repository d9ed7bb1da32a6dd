#pragma once

#include <optional>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// How many bytes a table has before its first row whose time (s), in the first column, is not before the
/// given one; of the table that is not complete, else of the complete one. 0 where there is none with this
/// header.
std::uintmax_t bytesBefore(const std::filesystem::path& table, std::string_view header, double time);

/// A table to which a run adds rows. It is opened with the first of them, so that a scene that is refused
/// leaves none. A run that is restarted goes on with it, after the rows that it had when the restart file was
/// written, without those of later times; where there is none, in another folder, it begins a new table. A
/// table of another run, or one that was changed, is refused.
class RunTable {
public:
    RunTable(std::filesystem::path path, std::string header)
        : place(std::move(path)), columns(std::move(header)) {}

    /// Throws InputError if the file cannot be written.
    template <class... Values>
    void row(const Values&... values) {
        open();
        file->row(values...);
    }
    /// Goes on after so many bytes of a table that is there; 0: begins with the first row. What is behind
    /// them goes with the next row, or at the end: a run that is refused until then leaves the table as it
    /// is.
    void goOnAfter(std::uintmax_t bytes) { kept = bytes; }
    /// Goes on after the rows of a table that is there whose times, in the first column, are earlier.
    /// @param time s
    void goOnFrom(double time);
    /// Completes the file under its name.
    void close() {
        if (kept > 0) open();
        if (file) file->close();
    }

    /// Called in the driver's visitState(). Throws InputError where the table that is there is not the
    /// one that the restart file knows.
    void visitState(StateArchive& archive);

private:
    void open() {
        if (file) return;
        if (kept > 0) file.emplace(place, columns, kept);
        else file.emplace(place, columns);
    }

    std::filesystem::path place;
    std::string columns;
    std::uintmax_t kept = 0;  // bytes of a table that is there
    std::optional<CsvFile> file;
};

}  // namespace pendular
