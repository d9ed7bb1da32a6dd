#include "Kernel/Features/GrainFiles/GrainFile.h"
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

const std::string lammpsData =
    "data file, units = si\n\n2 atoms\n2 atom types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nMasses\n\n1 "
    "1\n2 1\n\n"
    "Atoms # sphere\n\n2 2 0.002 7850 -1 0 0.125 0 0 1\n1 1 0.001 2500 0.25 -0.5 1 0 0 0\n\n"
    "Velocities\n\n1 1 2 3 4 5 6\n2 -1 0 0 0 0 7\n";
const std::string lammpsDump =
    "ITEM: UNITS\nsi\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n-1 1\n-1 1\n0 "
    "2.5\n"
    "ITEM: ATOMS id xs ys zs diameter\n1 0.5 0.5 0.5 0.001\nITEM: TIMESTEP\n500\nITEM: NUMBER OF ATOMS\n2\n"
    "ITEM: BOX BOUNDS pp pp ff\n-1 1\n-1 1\n0 2.5\n"
    "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz radius mass\n"
    "2 2 -1 0 0.125 -1 0 0 0 0 7 0.001 1e-5\n1 1 0.25 -0.5 1 1 2 3 4 5 6 0.0005 1e-6\n";

/// Reads the last snapshot, and one that is asked for.
void readLammps(const std::filesystem::path& path) {
    for (const GrainRow& grain : readGrainFile(path))
        if (!radiusRange.contains(grain.radius) || grain.type < 0 || !grain.position.allFinite() ||
            !grain.velocity.allFinite() || !grain.angularVelocity.allFinite())
            throw std::logic_error("a grain that no scene takes");
    try {
        readGrainFile(path, 0);
    } catch (const InputError&) {  // there may be none
    }
}

}  // namespace

Target lammpsFile() {
    return {"LammpsFile",
            [] {
                return std::vector{lammpsData, lammpsDump};
            },
            [](std::string_view bytes) { return takesFile("grains.data", bytes, readLammps); }};
}

Target grainFile() {
    return {"GrainFile",
            [] {
                return std::vector<std::string>{
                    written("grains.txt",
                            [](const auto& path) {
                                writeGrainFile(path, {{1e-3, {0, 1, 2}}, {2.5e-3, {-1e-7, 1e6, 0.1}}});
                            }),
                    "type radius contact x y z\r\n0 1e-3 1e-3 0 0 0\r\n# 1\r\n0 2 2 +1 .5 -1.e2\r\n"};
            },
            [](std::string_view bytes) { return takesFile("grains.txt", bytes, read); }};
}

}  // namespace pendular::fuzz
