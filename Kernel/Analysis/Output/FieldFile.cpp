#include "Kernel/Analysis/Output/FieldFile.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <utility>

#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/State/Hdf5Fault.h"

#ifdef PENDULAR_HAS_HDF5
    #include <algorithm>
    #include <span>

    #include "Kernel/Analysis/Output/Compression.h"
    #include "Kernel/Analysis/Output/FieldName.h"
    #include "Kernel/Foundation/State/Hdf5Library.h"
    #include "Kernel/Foundation/State/StateArchive.h"
#endif

namespace pendular {

void FieldFile::fail(std::string_view what) const { hdf5::refuse(target, what); }

#ifdef PENDULAR_HAS_HDF5

using hdf5::Object;

namespace {

constexpr std::size_t wholeChunk = std::size_t{1} << 17;  // bytes

/// The number of rows in a chunk of a column that has so many.
std::size_t rowsOfChunk(std::size_t rows, std::size_t bytesOfRow) {
    return std::min(rows, std::max<std::size_t>(wholeChunk / bytesOfRow, 1));
}

}  // namespace

FieldFile::FieldFile(std::filesystem::path path)
    : target(std::move(path)), beside(target.string() + ".part") {
    hdf5::makeQuiet();
    makeRoomFor(beside);
    errno = 0;
    file = check(H5Fcreate(beside.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT));
}

FieldFile::~FieldFile() {
    if (file < 0) return;
    H5Fclose(file);
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
}

FieldFile::Id FieldFile::check(Id result) const {
    if (result < 0) fail("cannot be written");
    return result;
}

void FieldFile::column(const std::string& group, const PolyDataField& field, int threads) {
    errno = 0;
    std::visit(
        [&]<class Number>(const std::vector<Number>& numbers) {
            const hid_t type = hdf5::nativeType(kindOf<Number>());
            const std::size_t rowBytes = field.components * sizeof(Number);
            const std::array<hsize_t, 2> extent{numbers.size() / field.components, field.components};
            const std::array<hsize_t, 2> chunk{rowsOfChunk(extent[0], rowBytes), field.components};
            const int axes = field.components == 1 ? 1 : 2;
            const Object space(H5Screate_simple(axes, extent.data(), nullptr), H5Sclose);
            const Object links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
            H5Pset_create_intermediate_group(links, 1);
            const Object creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
            H5Pset_obj_track_times(creation, false);  // equal frames make equal files
            if (!numbers.empty()) {
                H5Pset_chunk(creation, axes, chunk.data());
                H5Pset_shuffle(creation);
                H5Pset_deflate(creation, 1);
            }
            const std::string name = group + "/" + field.name;
            const Object set(check(H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT)),
                             H5Dclose);
            if (const std::string unit = splitFieldName(field.name).unit; !unit.empty())
                setText(set, "unit", unit);
            if (numbers.empty()) return;
            const std::vector<std::string> chunks = compressShuffled(
                std::as_bytes(std::span(numbers)), sizeof(Number), chunk[0] * rowBytes, threads);
            std::array<hsize_t, 2> corner{0, 0};
            for (const std::string& bytes : chunks) {
                check(H5Dwrite_chunk(set, H5P_DEFAULT, 0, corner.data(), bytes.size(), bytes.data()));
                corner[0] += chunk[0];
            }
        },
        field.numbers);
}

FieldFile::Id FieldFile::openGroup(const std::string& name) const {
    if (name == "/" || H5Lexists(file, name.c_str(), H5P_DEFAULT) > 0)
        return check(H5Gopen2(file, name.c_str(), H5P_DEFAULT));
    return check(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

void FieldFile::setAttribute(Id object, const std::string& name, Id type, const void* value) const {
    const Object space(H5Screate(H5S_SCALAR), H5Sclose);
    const Object attribute(check(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT)),
                           H5Aclose);
    check(H5Awrite(attribute, type, value));
}

void FieldFile::setText(Id object, const std::string& name, std::string_view text) const {
    const Object type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    setAttribute(object, name, type, text.empty() ? "" : std::string(text).c_str());
}

void FieldFile::attribute(const std::string& group, const std::string& name, double number) {
    errno = 0;
    setAttribute(Object(openGroup(group), H5Gclose), name, H5T_NATIVE_DOUBLE, &number);
}

void FieldFile::attribute(const std::string& group, const std::string& name, std::string_view text) {
    errno = 0;
    setText(Object(openGroup(group), H5Gclose), name, text);
}

void FieldFile::link(const std::string& name, const std::string& otherFile) {
    errno = 0;
    const Object links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    check(H5Lcreate_external(otherFile.c_str(), "/", file, name.c_str(), links, H5P_DEFAULT));
}

void FieldFile::close() {
    errno = 0;
    if (H5Fclose(std::exchange(file, -1)) < 0) fail("cannot be completed");
    std::error_code problem;
    std::filesystem::rename(beside, target, problem);
    if (problem) fail("cannot be renamed to its final name");
}

#else

FieldFile::FieldFile(std::filesystem::path path) : target(std::move(path)) {
    errno = 0;
    fail(hdf5::isMissing);
}
FieldFile::~FieldFile() = default;
void FieldFile::column(const std::string&, const PolyDataField&, int) {}
void FieldFile::attribute(const std::string&, const std::string&, double) {}
void FieldFile::attribute(const std::string&, const std::string&, std::string_view) {}
void FieldFile::link(const std::string&, const std::string&) {}
void FieldFile::close() {}

#endif

}  // namespace pendular
