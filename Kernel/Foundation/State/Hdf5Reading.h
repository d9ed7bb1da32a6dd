#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Foundation/Files/ReadingProcess.h"
#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular {

/// An HDF5 file that a child process reads: the library itself crashes on some damaged files, as no check of
/// a checksum or of a size can rule out. The functions are those of Hdf5File.
class Hdf5Reading {
public:
    /// @param open opens the file, in the child; @param file then reads it there
    Hdf5Reading(const std::function<void()>& open, const Hdf5File& file);

    [[nodiscard]] std::vector<std::string> names();
    [[nodiscard]] bool holds(const std::string& name);
    [[nodiscard]] std::optional<TableShape> shapeOf(const std::string& name);
    void read(const std::string& name, const TableShape& shape, void* numbers);
    [[nodiscard]] std::string readText(const std::string& name);

private:
    enum class What : std::uint32_t { Names, Holds, Shape, Table, Text };
    struct Request {
        What what;
        NumberKind kind{};
        std::uint64_t rows = 0, columns = 0, nameLength = 0;
    };
    struct Answer {
        std::uint32_t isRefused, isThere;
        NumberKind kind;
        std::uint64_t rows, columns, bytes;
    };

    static void serve(const ReadingProcess::Channel& channel, const std::function<void()>& open,
                      const Hdf5File& file);
    static Answer answerTo(const Request& request, const std::string& name, const Hdf5File& file,
                           std::string& content);
    Answer ask(Request request, const std::string& name);
    /// Throws InputError where the child has refused; @param received whether its answer has come
    void requireTaken(const Answer& answer, bool received);
    std::string contentOf(const Answer& answer);

    std::filesystem::path place;
    ReadingProcess process;
};

}  // namespace pendular
