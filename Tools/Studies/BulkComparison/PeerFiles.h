#pragma once

#include <fmt/format.h>

#include <fstream>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Foundation/Files/FileFault.h"
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

/// A mesh as a text file of STL. LIGGGHTS computes the normals.
inline void writePeerMesh(const std::string& path, const PeerMesh& mesh) {
    std::string text = fmt::format("solid {}\n", mesh.name);
    for (const Triangle& triangle : mesh.triangles) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const Vector<double>& corner : triangle)
            text += fmt::format("  vertex {:.12g} {:.12g} {:.12g}\n", corner.x, corner.y, corner.z);
        text += " endloop\nendfacet\n";
    }
    WrittenBeside file(path);
    file.write(text + fmt::format("endsolid {}\n", mesh.name));
    file.close();
}

/// All that LIGGGHTS and LAMMPS need for a flow (Peers/flow.liggghts): a folder with the grains (`start`),
/// the meshes (NAME.stl), and the numbers of the scene as commands (`variables`).
/// @param step s
inline void writePeerFolder(const std::filesystem::path& folder, const BulkScene& scene, double step) {
    makeFolder(folder);
    writePeerData((folder / "start").string(), scene);
    double turns = 0;
    for (const PeerMesh& mesh : scene.meshes) {
        writePeerMesh((folder / (mesh.name + ".stl")).string(), mesh);
        turns += mesh.spin / (2 * std::numbers::pi);  // one of them turns
    }
    std::string boundary;
    for (const bool isPeriodic : scene.periodic) boundary += isPeriodic ? "p " : "f ";
    WrittenBeside file((folder / "variables").string());
    const auto number = [&](std::string_view name, double value) {
        file.write(fmt::format("variable {} index {:.17g}\n", name, value));
    };
    file.write(fmt::format("variable boundary index \"{}\"\n", boundary));
    number("meshed", scene.meshes.empty() ? 0 : 1);
    number("drum", scene.cylinder > 0 ? 1 : 0);
    number("hopper", scene.drains ? 1 : 0);
    // m: the radius of the drum, half of the hopper
    number("wide", scene.cylinder > 0 ? scene.cylinder : scene.highest.x());
    number("spin", scene.spin);
    number("period", turns > 0 ? 1 / turns : 0);  // s, of the mesh that turns
    number("wall_friction", scene.wallFriction);
    number("step", step);
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
