#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

enum class NumberKind { Float64, Float32, UInt64, UInt32, Int32, UInt16, UInt8 };

/// A table of numbers of one kind, row by row.
struct TableShape {
    NumberKind kind;
    std::size_t rows;
    std::size_t columns;

    friend bool operator==(const TableShape&, const TableShape&) = default;
};

/// Tables and texts under names with slashes (groups), in a file of the HDF5 library. All functions throw
/// InputError, with the file and the reason, where the file does not let them do what they say.
class Hdf5File {
public:
    enum class Access { Create, Read };
    /// Before the file's own content there is room for so many bytes of a user (HDF5's "user block").
    static constexpr std::size_t userBlock = 512;
    /// Whether this build has the HDF5 library; without it the constructor throws.
    static bool isAvailable();

    /// Only regular files. What is read is in the file itself: a link to another place, in this file or in
    /// another one, and numbers that are kept in another file are refused.
    Hdf5File(std::filesystem::path path, Access access);
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;
    ~Hdf5File();

    void write(const std::string& name, const TableShape& shape, const void* numbers);
    void write(const std::string& name, std::string_view text);

    /// The names of all tables and texts, sorted.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] bool holds(const std::string& name) const;
    /// Nothing if a text has this name. A list is a table of one column.
    [[nodiscard]] std::optional<TableShape> shapeOf(const std::string& name) const;
    void read(const std::string& name, const TableShape& shape, void* numbers) const;
    [[nodiscard]] std::string readText(const std::string& name) const;

    /// Completes a file that was created.
    void close();

    [[nodiscard]] const std::filesystem::path& path() const { return place; }

private:
    using Id = std::int64_t;  // the library's hid_t

    [[noreturn]] void fail(std::string_view what) const;
    Id check(Id result, std::string_view what) const;
    void writeDataset(const std::string& name, Id type, Id space, const void* data);
    /// Whether all parts of a name are there, without opening any; throws where one is a link elsewhere.
    [[nodiscard]] bool isOwn(const std::string& name) const;
    /// It stays open until another one is: its shape is asked for before it is read.
    [[nodiscard]] Id openDataset(const std::string& name) const;
    void closeDataset() const;

    std::filesystem::path place;
    Id file = -1;
    mutable std::set<std::string, std::less<>> own;  // names that isOwn() has looked at
    mutable std::string openName;
    mutable Id openSet = -1;
};

}  // namespace pendular
