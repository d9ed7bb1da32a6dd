#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

/// Some groups and tables, so that most of the bytes are those of their headers.
void visit(StateArchive& archive) {
    std::vector<double> curve{1, 2, 3};
    std::vector<std::uint32_t> identity{0, 7};
    std::string remark = "a remark";
    UniformRandom random(1);
    archive.column<double>("curve", curve);
    archive.text("remark", remark);
    for (const char* group : {"particles", "contacts", "walls"})
        archive.group(group, [&] {
            archive.column<std::uint32_t>("identity", identity);
            archive.group("random", [&] { random.visitState(archive); });
        });
}

/// All that is in a file, as restart-to-text prints it.
void readAll(const std::filesystem::path& path) {
    const Hdf5File file(path, Hdf5File::Access::Read);
    for (const std::string& name : file.names()) {
        const auto shape = file.shapeOf(name);
        std::vector<char> numbers(shape ? 8 * shape->rows * shape->columns : 0);
        if (shape) file.read(name, *shape, numbers.data());
        else static_cast<void>(file.readText(name));
    }
}

}  // namespace

/// Any bytes as a restart file with the right checksum: the HDF5 library reads what is in its headers.
Target restartBytes() {
    return {
        "RestartBytes",
        [] { return std::vector{written("a.h5", [](const auto& path) { writeRestartFile(path, visit); })}; },
        [](std::string_view bytes) {
            return takesFile("a.h5", bytes, [](const auto& path) {
                sealRestartFile(path);
                readRestartFile(path, visit);
                readAll(path);
            });
        }};
}

/// Any bytes as an HDF5 frame: chunks and their sizes besides.
Target hdf5Bytes() {
    const auto write = [](const std::filesystem::path& path) {
        FieldFile file(path);
        file.column("particles", {"position_m", 3, std::vector<double>(180, 1e-3)});
        file.column("particles", {"radius_m", 1, std::vector<float>(60, 1e-3f)});
        file.close();
    };
    return {"Hdf5Bytes", [=] { return std::vector{written("a.h5", write)}; },
            [](std::string_view bytes) {
                return takesFile("a.h5", bytes, [](const auto& path) { readHdf5Frame(path); });
            }};
}

}  // namespace pendular::fuzz
