#include "Kernel/State/Hdf5File.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "Kernel/InputError.h"

#ifdef PENDULAR_HAS_HDF5
    #include <hdf5.h>

    #include <algorithm>
    #include <array>
    #include <utility>
#endif

namespace pendular {

void Hdf5File::fail(std::string_view what) const {
    const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : std::string();
    throw InputError(fmt::format("The file {} {}{}.", place.string(), what, reason));
}

#ifdef PENDULAR_HAS_HDF5

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

namespace {

/// An object of the library, closed at the end of the scope.
class Object {
public:
    Object(hid_t identity, herr_t (*closing)(hid_t)) : id(identity), close(closing) {}
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() { close(id); }
    operator hid_t() const { return id; }

private:
    hid_t id;
    herr_t (*close)(hid_t);
};

hid_t nativeType(NumberKind kind) {
    switch (kind) {
        case NumberKind::Float64:
            return H5T_NATIVE_DOUBLE;
        case NumberKind::UInt64:
            return H5T_NATIVE_UINT64;
        case NumberKind::UInt32:
            return H5T_NATIVE_UINT32;
        case NumberKind::Int32:
            return H5T_NATIVE_INT32;
        case NumberKind::UInt16:
            return H5T_NATIVE_UINT16;
        case NumberKind::UInt8:
            return H5T_NATIVE_UINT8;
    }
    return -1;
}

/// The library prints no messages of its own, and does not try to complete files when the program ends (a
/// full disk is not less full then).
void makeQuiet() {
    static const bool once = [] {
        H5dont_atexit();
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        return true;
    }();
    static_cast<void>(once);
}

}  // namespace

bool Hdf5File::isAvailable() { return true; }

Hdf5File::Hdf5File(std::filesystem::path path, Access access) : place(std::move(path)) {
    makeQuiet();
    errno = 0;
    if (access == Access::Read) {
        file = check(H5Fopen(place.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "cannot be read");
        return;
    }
    const Object creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_userblock(creation, userBlock);
    file = check(H5Fcreate(place.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT), "cannot be written");
}

Hdf5File::~Hdf5File() {
    if (file >= 0) H5Fclose(file);
}

Hdf5File::Id Hdf5File::check(Id result, std::string_view what) const {
    if (result < 0) fail(what);
    return result;
}

void Hdf5File::writeDataset(const std::string& name, Id type, Id space, const void* data) {
    errno = 0;
    const Object links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Object creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);  // equal states make equal files
    const Object set(
        check(H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT), "cannot be written"),
        H5Dclose);
    if (data) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot be written");
}

void Hdf5File::write(const std::string& name, const TableShape& shape, const void* numbers) {
    const std::array<hsize_t, 2> extent{shape.rows, shape.columns};
    const Object space(H5Screate_simple(2, extent.data(), nullptr), H5Sclose);
    writeDataset(name, nativeType(shape.kind), space, shape.rows > 0 ? numbers : nullptr);
}

void Hdf5File::write(const std::string& name, std::string_view text) {
    const std::string ended(text);  // HDF5 knows no empty fixed string: the terminator is part of it
    const Object type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, ended.size() + 1);
    const Object space(H5Screate(H5S_SCALAR), H5Sclose);
    writeDataset(name, type, space, ended.c_str());
}

std::vector<std::string> Hdf5File::names() const {
    std::vector<std::string> found;
    const auto take = [](hid_t, const char* name, const H5O_info_t* info, void* list) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    errno = 0;
    check(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, take, &found, H5O_INFO_BASIC), "cannot be read");
    std::sort(found.begin(), found.end());
    return found;
}

bool Hdf5File::holds(const std::string& name) const {
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1))
        if (H5Lexists(file, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5File::Id Hdf5File::openDataset(const std::string& name) const {
    errno = 0;
    return check(H5Dopen2(file, name.c_str(), H5P_DEFAULT), fmt::format("has no {}", name));
}

std::optional<TableShape> Hdf5File::shapeOf(const std::string& name) const {
    const Object set(openDataset(name), H5Dclose), type(H5Dget_type(set), H5Tclose),
        space(H5Dget_space(set), H5Sclose);
    std::array<hsize_t, 2> extent{};
    if (H5Sget_simple_extent_ndims(space) != 2) return {};
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    for (const NumberKind kind : {NumberKind::Float64, NumberKind::UInt64, NumberKind::UInt32,
                                  NumberKind::Int32, NumberKind::UInt16, NumberKind::UInt8})
        if (H5Tget_class(type) == H5Tget_class(nativeType(kind)) &&
            H5Tget_size(type) == H5Tget_size(nativeType(kind)) &&
            (H5Tget_class(type) != H5T_INTEGER || H5Tget_sign(type) == H5Tget_sign(nativeType(kind))))
            return TableShape{kind, extent[0], extent[1]};
    return {};
}

void Hdf5File::read(const std::string& name, const TableShape& shape, void* numbers) const {
    const Object set(openDataset(name), H5Dclose);
    if (shape.rows > 0)
        check(H5Dread(set, nativeType(shape.kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers),
              fmt::format("cannot be read at {}", name));
}

std::string Hdf5File::readText(const std::string& name) const {
    const Object set(openDataset(name), H5Dclose), type(H5Dget_type(set), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING) fail(fmt::format("has no text {}", name));
    std::string text(H5Tget_size(type), '\0');
    check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
          fmt::format("cannot be read at {}", name));
    return text.c_str();
}

void Hdf5File::close() {
    errno = 0;
    check(H5Fclose(std::exchange(file, -1)), "cannot be completed");
}

#else

bool Hdf5File::isAvailable() { return false; }
Hdf5File::Hdf5File(std::filesystem::path path, Access) : place(std::move(path)) {
    errno = 0;
    fail("cannot be used: this build of Pendular has no HDF5 library");
}
Hdf5File::~Hdf5File() = default;
void Hdf5File::write(const std::string&, const TableShape&, const void*) {}
void Hdf5File::write(const std::string&, std::string_view) {}
std::vector<std::string> Hdf5File::names() const { return {}; }
bool Hdf5File::holds(const std::string&) const { return false; }
std::optional<TableShape> Hdf5File::shapeOf(const std::string&) const { return {}; }
void Hdf5File::read(const std::string&, const TableShape&, void*) const {}
std::string Hdf5File::readText(const std::string&) const { return {}; }
void Hdf5File::close() {}

#endif

}  // namespace pendular
