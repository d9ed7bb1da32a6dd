#include "Kernel/Foundation/State/Hdf5File.h"

#include <fmt/format.h>

#include <cerrno>

#include "Kernel/Foundation/Files/Deflate.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"
#include "Kernel/Foundation/State/Hdf5Fault.h"

#ifdef PENDULAR_HAS_HDF5
    #include <algorithm>
    #include <array>
    #include <map>
    #include <memory>
    #include <mutex>
    #include <utility>

    #include "Kernel/Foundation/State/Hdf5Library.h"
    #include "Kernel/Foundation/State/Hdf5Reading.h"
#endif

namespace pendular {

void Hdf5File::fail(std::string_view what) const { hdf5::refuse(place, what); }

#ifdef PENDULAR_HAS_HDF5

using hdf5::makeQuiet, hdf5::nativeType, hdf5::Object;

namespace {

/// What this process does with the library, which is not made for several threads, while scenes of several
/// may be read at the same time. Each file that is read has a child process, in which the functions below go
/// to the library; in this process they go to the child. A child begins with a Use of its own: the lock of
/// this process would stay held in it, and the children are not its own.
struct Use {
    std::recursive_mutex mutex;
    std::map<const Hdf5File*, std::unique_ptr<Hdf5Reading>> readings;
};
Use* use = new Use;  // never deleted: files may be closed when the program ends

Hdf5Reading* readingOf(const Hdf5File* file) {
    const auto found = use->readings.find(file);
    return found == use->readings.end() ? nullptr : found->second.get();
}

struct Alone {
    const std::scoped_lock<std::recursive_mutex> lock{use->mutex};
    const hdf5::WithoutMessages messages{};
};

/// The most bytes of numbers that a table can have by what is stored of it.
double mostBytes(hid_t set, double stored, double fileSize) {
    const Object creation(H5Dget_create_plist(set), H5Pclose);  // to ask takes longer than all the rest
    if (H5Pget_layout(creation) != H5D_CHUNKED) return fileSize;
    return (H5Pget_nfilters(creation) > 0 ? largestDeflateRatio : 1) * std::min(stored, fileSize);
}

}  // namespace

bool Hdf5File::isAvailable() { return true; }

Hdf5File::Hdf5File(std::filesystem::path path, Access access) : place(std::move(path)) {
    const Alone alone;
    makeQuiet();
    if (access == Access::Read) {
        requireRegularIfThere(place);
        const auto open = [this] {
            use = new Use;
            errno = 0;
            file = check(H5Fopen(place.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "cannot be read");
        };
        use->readings[this] = std::make_unique<Hdf5Reading>(open, *this);
        return;
    }
    const Object creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_userblock(creation, userBlock);
    makeRoomFor(place);
    errno = 0;
    file = check(H5Fcreate(place.c_str(), H5F_ACC_EXCL, creation, H5P_DEFAULT), "cannot be written");
}

Hdf5File::~Hdf5File() {
    const Alone alone;
    use->readings.erase(this);
    closeDataset();
    if (file >= 0) H5Fclose(file);
}

Hdf5File::Id Hdf5File::check(Id result, std::string_view what) const {
    if (result < 0) fail(what);
    return result;
}

void Hdf5File::writeDataset(const std::string& name, Id type, Id space, const void* data) {
    errno = 0;
    static const hid_t links = [] {
        const hid_t list = H5Pcreate(H5P_LINK_CREATE);
        H5Pset_create_intermediate_group(list, 1);
        return list;
    }();
    static const hid_t creation = [] {
        const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_obj_track_times(list, false);  // equal states make equal files
        return list;
    }();
    const Object set(
        check(H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT), "cannot be written"),
        H5Dclose);
    if (data) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot be written");
}

void Hdf5File::write(const std::string& name, const TableShape& shape, const void* numbers) {
    const Alone alone;
    const std::array<hsize_t, 2> extent{shape.rows, shape.columns};
    const Object space(H5Screate_simple(2, extent.data(), nullptr), H5Sclose);
    writeDataset(name, nativeType(shape.kind), space, shape.rows > 0 ? numbers : nullptr);
}

void Hdf5File::write(const std::string& name, std::string_view text) {
    const Alone alone;
    const std::string ended(text);  // HDF5 knows no empty fixed string: the terminator is part of it
    const Object type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, ended.size() + 1);
    const Object space(H5Screate(H5S_SCALAR), H5Sclose);
    writeDataset(name, type, space, ended.c_str());
}

std::vector<std::string> Hdf5File::names() const {
    const Alone alone;
    if (Hdf5Reading* const reading = readingOf(this)) return reading->names();
    std::vector<std::string> found;
    const auto take = [](hid_t, const char* name, const hdf5::ObjectInfo* info, void* list) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
    };
    errno = 0;
    check(hdf5::visitObjects(file, H5_INDEX_NAME, H5_ITER_INC, take, &found, H5O_INFO_BASIC),
          "cannot be read");
    std::sort(found.begin(), found.end());
    return found;
}

bool Hdf5File::isOwn(const std::string& name) const {
    for (std::size_t end = name.find('/');; end = name.find('/', end + 1)) {
        const std::string part = name.substr(0, end);
        if (!own.contains(part)) {
            H5L_info_t link{};
            if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0) return false;
            if (link.type != H5L_TYPE_HARD) {
                errno = 0;
                fail(fmt::format("has a link to another place at {}, which Pendular does not follow", part));
            }
            own.insert(part);
        }
        if (end == std::string::npos) return true;
    }
}

bool Hdf5File::holds(const std::string& name) const {
    const Alone alone;
    if (Hdf5Reading* const reading = readingOf(this)) return reading->holds(name);
    const std::size_t last = name.rfind('/');
    if (last != std::string::npos && !isOwn(name.substr(0, last))) return false;
    return own.contains(name) || H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::closeDataset() const {
    if (openSet >= 0) H5Dclose(std::exchange(openSet, -1));
}

Hdf5File::Id Hdf5File::openDataset(const std::string& name) const {
    if (openSet >= 0 && openName == name) return openSet;
    closeDataset();
    const bool isThere = isOwn(name);
    errno = 0;
    if (!isThere) fail(fmt::format("has no {}", name));
    // HDF5 1.14 does not open a table that is to be larger than its bytes; with 1.10, shapeOf() finds it.
    openSet = check(H5Dopen2(file, name.c_str(), H5P_DEFAULT),
                    fmt::format("has no table or text at {} that can be read", name));
    openName = name;
    const Object creation(H5Dget_create_plist(openSet), H5Pclose);
    if (H5Pget_layout(creation) != H5D_VIRTUAL && H5Pget_external_count(creation) == 0) return openSet;
    closeDataset();
    errno = 0;
    fail(fmt::format("keeps {} in another file, which Pendular does not read", name));
}

std::optional<TableShape> Hdf5File::shapeOf(const std::string& name) const {
    const Alone alone;
    if (Hdf5Reading* const reading = readingOf(this)) return reading->shapeOf(name);
    const Id set = openDataset(name);
    const Object type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    std::array<hsize_t, 2> extent{0, 1};
    if (const int axes = H5Sget_simple_extent_ndims(space); axes != 1 && axes != 2) return {};
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    // Nothing is believed of a table that promises more than there is, also where its rows are to be empty.
    const double promised = static_cast<double>(extent[0]) *
                            static_cast<double>(std::max<hsize_t>(extent[1], 1)) *
                            static_cast<double>(H5Tget_size(type)),
                 stored = static_cast<double>(H5Dget_storage_size(set)),
                 fileSize = static_cast<double>(sizeOf(place));
    if (promised > std::min(stored, fileSize) && promised > mostBytes(set, stored, fileSize))
        fail(fmt::format("has fewer bytes than {} is to have numbers", name));
    for (const NumberKind kind :
         {NumberKind::Float64, NumberKind::Float32, NumberKind::UInt64, NumberKind::UInt32, NumberKind::Int32,
          NumberKind::UInt16, NumberKind::UInt8})
        if (H5Tget_class(type) == H5Tget_class(nativeType(kind)) &&
            H5Tget_size(type) == H5Tget_size(nativeType(kind)) &&
            (H5Tget_class(type) != H5T_INTEGER || H5Tget_sign(type) == H5Tget_sign(nativeType(kind))))
            return TableShape{kind, extent[0], extent[1]};
    return {};
}

void Hdf5File::read(const std::string& name, const TableShape& shape, void* numbers) const {
    const Alone alone;
    if (Hdf5Reading* const reading = readingOf(this)) return reading->read(name, shape, numbers);
    const Id set = openDataset(name);
    if (shape.rows > 0)
        check(H5Dread(set, nativeType(shape.kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers),
              fmt::format("cannot be read at {}", name));
}

std::string Hdf5File::readText(const std::string& name) const {
    const Alone alone;
    if (Hdf5Reading* const reading = readingOf(this)) return reading->readText(name);
    const Id set = openDataset(name);
    const Object type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
    constexpr std::size_t longest = std::size_t{1} << 20;  // bytes
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_npoints(space) != 1 || H5Tget_size(type) > longest)
        fail(fmt::format("has no text {}", name));
    std::string text(H5Tget_size(type), '\0');
    check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()),
          fmt::format("cannot be read at {}", name));
    return text.c_str();
}

void Hdf5File::close() {
    const Alone alone;
    closeDataset();
    errno = 0;
    check(H5Fclose(std::exchange(file, -1)), "cannot be completed");
}

#else

bool Hdf5File::isAvailable() { return false; }
Hdf5File::Hdf5File(std::filesystem::path path, Access) : place(std::move(path)) {
    errno = 0;
    fail(hdf5::isMissing);
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
