#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "Kernel/Analysis/Output/PolyData.h"

namespace pendular {

/// A file of the HDF5 library for its users: columns in compressed chunks under names with slashes, each with
/// its unit as an attribute. It is written beside its name, and renamed by close(). All functions throw
/// InputError, with the file and the reason, where they cannot do what they say.
class FieldFile {
public:
    explicit FieldFile(std::filesystem::path path);
    FieldFile(const FieldFile&) = delete;
    FieldFile& operator=(const FieldFile&) = delete;
    /// A file that was not completed is removed.
    ~FieldFile();

    /// Numbers of points or cells, a row for each; a list where they have one component. The unit is taken
    /// from the name of the field.
    /// @param threads that compress; the file does not depend on it
    void column(const std::string& group, const PolyDataField& field, int threads = 1);
    /// Gives an attribute to the group of this name, which may be "/".
    void attribute(const std::string& group, const std::string& name, double number);
    void attribute(const std::string& group, const std::string& name, std::string_view text);
    /// Makes another file in the same folder appear as a group of this one.
    void link(const std::string& name, const std::string& otherFile);
    void close();

private:
    using Id = std::int64_t;  // the library's hid_t

    [[noreturn]] void fail(std::string_view what) const;
    Id check(Id result) const;
    void setAttribute(Id object, const std::string& name, Id type, const void* value) const;
    void setText(Id object, const std::string& name, std::string_view text) const;
    [[nodiscard]] Id openGroup(const std::string& name) const;

    std::filesystem::path target, beside;
    Id file = -1;
};

}  // namespace pendular
