#pragma once

#include <fmt/format.h>

#include <fstream>

#include "Kernel/Files/CsvFile.h"
#include "Tools/Studies/BulkComparison/FrameFigures.h"

// What LIGGGHTS and LAMMPS begin with, and the frames that they write.

namespace pendular::bulk {

/// The grains, as a file for their `read_data`; type 4 is the walls.
inline void writePeerData(const std::string& path, const BulkScene& scene) {
    std::string text = fmt::format("grains\n\n{} atoms\n4 atom types\n\n", scene.grains.size());
    for (int k = 0; k < 3; ++k)
        text += fmt::format("{0:.12g} {1:.12g} {2}lo {2}hi\n", scene.lowest[k], scene.highest[k], "xyz"[k]);
    std::string velocities = "\nVelocities\n\n";
    text += "\nAtoms\n\n";
    for (std::size_t k = 0; k < scene.grains.size(); ++k) {
        const PeerGrain& g = scene.grains[k];
        text +=
            fmt::format("{} {} {:.16g} {:.16g} {:.16g} {:.16g} {:.16g}\n", k + 1, static_cast<int>(g.kind),
                        2 * g.radius, g.density, g.position.x(), g.position.y(), g.position.z());
        velocities += fmt::format("{} {:.16g} {:.16g} {:.16g} 0 0 0\n", k + 1, g.velocity.x(), g.velocity.y(),
                                  g.velocity.z());
    }
    WrittenBeside file(path);
    file.write(text);
    file.write(velocities);
    file.close();
}

/// The grains of such a file, in place of those of the scene.
inline void readPeerData(const std::string& path, BulkScene& scene) {
    std::ifstream file(path);
    std::string word;
    std::size_t count = 0, identity = 0;
    file >> word >> count;
    while (file >> word && word != "Atoms") {}
    scene.grains.assign(count, {});
    for (PeerGrain& g : scene.grains) {
        int kind = 0;
        file >> identity >> kind >> g.radius >> g.density >> g.position[0] >> g.position[1] >> g.position[2];
        g.kind = static_cast<GrainKind>(kind), g.radius *= 0.5;
    }
    file >> word;
    double spin = 0;
    for (PeerGrain& g : scene.grains) {
        file >> identity >> g.velocity[0] >> g.velocity[1] >> g.velocity[2];
        for (int k = 0; k < 3; ++k) file >> spin;
    }
    if (!file || count == 0 || identity != count)
        throw InputError(fmt::format("{}: is no start that bulk-figures --data has written.", path));
}

/// Reads frames of rows `id x y z vx vy vz` in a box, until the last whole one.
/// @param step s
inline void readPeerFrames(const std::string& path, const BulkScene& scene, double step,
                           FrameFigures& figures) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (line != "ITEM: TIMESTEP") continue;
        double steps = 0;
        std::size_t count = 0;
        file >> steps;
        while (std::getline(file, line) && line != "ITEM: NUMBER OF ATOMS") {}
        file >> count;
        while (std::getline(file, line) && !line.starts_with("ITEM: ATOMS")) {}
        std::vector<PeerGrain> grains;
        for (std::size_t k = 0; k < count; ++k) {
            std::size_t identity = 0;
            Vec3D x, v;
            if (!(file >> identity)) return;
            std::array<std::string, 6> words;  // "nan" is no number for a stream
            for (std::string& word : words) file >> word;
            for (int i = 0; i < 3; ++i) {
                x[i] = std::strtod(words[static_cast<std::size_t>(i)].c_str(), nullptr);
                v[i] = std::strtod(words[static_cast<std::size_t>(i) + 3].c_str(), nullptr);
            }
            if (identity < 1 || identity > scene.grains.size())
                throw InputError(
                    fmt::format("{}: there is no grain {} in the scene {}.", path, identity, scene.name));
            grains.push_back(scene.grains[identity - 1]);
            grains.back().position = x, grains.back().velocity = v;
        }
        figures.add(steps * step, grains);
    }
}

}  // namespace pendular::bulk
