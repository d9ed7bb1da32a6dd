#include "Kernel/Particles/GrainFile.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

/// What is read, and written again, is read as the same numbers.
void read(const std::filesystem::path& path) {
    const std::vector<GrainRow> grains = readGrainFile(path);
    writeGrainFile(path, grains);
    const std::vector<GrainRow> again = readGrainFile(path);
    if (again.size() != grains.size()) throw std::logic_error("grains are lost on the way");
    for (std::size_t k = 0; k < grains.size(); ++k)
        if (again[k].radius != grains[k].radius || again[k].position != grains[k].position)
            throw std::logic_error("a grain has changed on the way");
}

}  // namespace

Target grainFile() {
    return {"GrainFile",
            [] {
                return std::vector<std::string>{
                    written("grains.txt",
                            [](const auto& path) {
                                writeGrainFile(path, {{1e-3, {0, 1, 2}}, {2.5e-3, {-1e-7, 1e8, 0.1}}});
                            }),
                    "type radius contact x y z\r\n0 1e-3 1e-3 0 0 0\r\n# 1\r\n0 2 2 +1 .5 -1.e2\r\n"};
            },
            [](std::string_view bytes) { return takesFile("grains.txt", bytes, read); }};
}

}  // namespace pendular::fuzz
