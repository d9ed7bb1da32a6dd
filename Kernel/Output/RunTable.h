#pragma once

#include <optional>

#include "Kernel/Output/CsvFile.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {

/// A table to which a run adds rows. It is opened with the first of them, so that a scene that is refused
/// leaves none. A run that is restarted goes on with it, after the rows that it had when the restart file was
/// written, without those of later times; in another folder it begins a new table.
class RunTable {
public:
    RunTable(std::filesystem::path path, std::string header)
        : place(std::move(path)), columns(std::move(header)) {}

    /// Throws InputError if the file cannot be written.
    template <class... Values>
    void row(const Values&... values) {
        if (!file) file.emplace(place, columns);
        file->row(values...);
    }
    /// Completes the file under its name.
    void close() {
        if (file) file->close();
    }

    /// To be called in the driver's visitState().
    void visitState(StateArchive& archive) {
        std::uint64_t bytes = !archive.isReading() && file ? file->flush() : 0;
        archive.value(place.filename().string() + "-bytes", bytes);
        if (archive.isReading() && bytes > 0) file.emplace(place, columns, bytes);
    }

private:
    std::filesystem::path place;
    std::string columns;
    std::optional<CsvFile> file;
};

}  // namespace pendular
