#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fuzz {

/// A reader of files that must stand any bytes: it takes them, or refuses them with an InputError. Anything
/// else that it throws, or does, is a fault.
struct Target {
    std::string name;
    /// Good inputs to begin with, made by the project's own writers.
    std::function<std::vector<std::string>()> makeSeeds;
    /// Gives the bytes to the reader; returns whether it has taken them.
    std::function<bool(std::string_view bytes)> take;
};

Target grainFile();
Target lammpsFile();
Target triangleRows();
Target stlFile();
Target objFile();
Target plyFile();
Target polyData();
Target paraViewSeries();
Target fieldImage();
Target summaryTable();
Target hdf5Index();
Target hdf5Frame();
Target hdf5Bytes();
Target restartFile();
Target restartContent();
Target restartBytes();
#ifdef PENDULAR_HAS_VIEW
Target request();
#endif

inline std::vector<Target> allTargets() {
    return {
#ifdef PENDULAR_HAS_VIEW
        request(),
#endif
        grainFile(), lammpsFile(),     triangleRows(),   stlFile(),      objFile(),   plyFile(),
        polyData(),  paraViewSeries(), fieldImage(),     summaryTable(), hdf5Index(), hdf5Frame(),
        hdf5Bytes(), restartFile(),    restartContent(), restartBytes()};
}

inline void writeBytes(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}
inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The bytes as a file of this name, given to a reader.
template <class Read>
bool takesFile(std::string_view name, std::string_view bytes, Read&& read) {
    static const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path path = folder.path() / name;
    writeBytes(path, bytes);
    try {
        read(path);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// What a writer leaves in a file of this name.
template <class Write>
std::string written(std::string_view name, Write&& write) {
    const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path path = folder.path() / name;
    write(path);
    return bytesOf(path);
}

}  // namespace pendular::fuzz
