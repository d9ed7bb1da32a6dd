#pragma once

// Included by the sources that call the HDF5 library, and by no others.

#include <hdf5.h>

#include <cstdint>

#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular::hdf5 {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

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

// HDF5 1.12 gave the record that H5Ovisit passes to its callback a new layout, and both a new number. Without
// a number, a name means what H5_USE_..._API selects: the newest one.
#if H5_VERSION_GE(1, 12, 0)
using ObjectInfo = H5O_info2_t;
inline constexpr auto visitObjects = &H5Ovisit3;
#else
using ObjectInfo = H5O_info_t;
inline constexpr auto visitObjects = &H5Ovisit2;
#endif

inline hid_t nativeType(NumberKind kind) {
    switch (kind) {
        case NumberKind::Float64:
            return H5T_NATIVE_DOUBLE;
        case NumberKind::Float32:
            return H5T_NATIVE_FLOAT;
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
/// full disk is not less full then). In a program of somebody else, who may use the library too, it completes
/// files as that program has it, and prints nothing while WithoutMessages lives.
inline void makeQuiet() {
    static const bool once = [] {
        if (isHosted()) return false;
        H5dont_atexit();
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
        return true;
    }();
    static_cast<void>(once);
}

/// While it lives, the library prints no messages, also in a program of somebody else, who is told by
/// exceptions.
class WithoutMessages {
public:
    WithoutMessages() {
        makeQuiet();  // before the library is used at all
        H5Eget_auto2(H5E_DEFAULT, &print, &argument);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    WithoutMessages(const WithoutMessages&) = delete;
    WithoutMessages& operator=(const WithoutMessages&) = delete;
    ~WithoutMessages() { H5Eset_auto2(H5E_DEFAULT, print, argument); }

private:
    H5E_auto2_t print = nullptr;
    void* argument = nullptr;
};

}  // namespace pendular::hdf5
