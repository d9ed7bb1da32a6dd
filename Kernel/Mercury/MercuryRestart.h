#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"

namespace pendular {

/// A restart file of MercuryDPM's, in text: what of it a scene takes over. Everything else in it is refused
/// by its name, or passed over and counted. Read are the files of its versions 1.0 and 0.14 ("MercuryDPM 1.0
/// name ...") and the older forms "restart_version 1.0", "3" and "2".
struct MercuryRestart {
    struct Species {
        std::string type;                                    // by the kernel's name
        std::vector<std::pair<std::string, double>> fields;  // by the kernel's names
        std::size_t line = 0;
    };
    /// The laws of the contacts between two species.
    struct Pair {
        std::size_t a = 0, b = 0;
        Species laws;
    };
    struct Wall {
        enum class Shape { Plane, Solid, Axisymmetric };
        Shape shape = Shape::Plane;
        std::size_t species = 0, line = 0;
        std::uint64_t id = 0;
        std::vector<SolidFace> faces;                           // of a plane: one; relative to the position
        Vec3D position = Vec3D::Zero(), axis = Vec3D::UnitX();  // m, -
        Vec3D velocity = Vec3D::Zero(), spin = Vec3D::Zero();   // m/s, rad/s
    };
    struct Period {
        int axis = 0;
        double lowest = 0, highest = 0;  // m
    };
    /// Grains beyond a plane are deleted.
    struct Deletion {
        Vec3D normal = Vec3D::Zero();
        double distance = 0;  // m
    };
    struct Grain {
        GrainRow row;
        std::uint64_t id = 0;
        double inverseMass = 0;   // 1/kg; 0: a fixed particle
        double liquidVolume = 0;  // m^3
        std::size_t line = 0;
    };
    /// The history of a contact: of a particle against another one, or against a wall.
    struct History {
        std::size_t first = 0, second = 0;  // places in `grains`; at a wall, second: its place in `walls`
        bool isWithWall = false;
        Vec3D sliding = Vec3D::Zero(), rolling = Vec3D::Zero(), torsion = Vec3D::Zero();  // m, as there
        double flattening = 0;  // m, the largest, or the plastic, overlap
        bool isBonded = false, isBridged = false;
        std::size_t line = 0;
        [[nodiscard]] bool remembers() const {
            return sliding != Vec3D::Zero() || rolling != Vec3D::Zero() || torsion != Vec3D::Zero() ||
                   flattening != 0;
        }
    };

    std::filesystem::path file;
    std::string version, name;
    Vec3D lowest = Vec3D::Zero(), highest = Vec3D::Zero(), gravity = Vec3D::Zero();  // m, m, m/s^2
    double timeStep = 0, time = 0, timeMax = 0;                                      // s
    int systemDimensions = 3, particleDimensions = 3;
    std::size_t saveCount = 0;
    std::vector<Species> species;
    std::vector<Pair> pairs;
    std::vector<Wall> walls;
    std::vector<Period> periods;
    std::vector<Deletion> deletions;
    std::vector<Grain> grains;
    std::vector<History> histories;
    std::map<std::string, std::size_t> passedOver;  // by the word with which the line begins; a hundred

    /// What was read, and what was passed over, in one line.
    [[nodiscard]] std::string summary() const;
    /// Throws InputError with the file, the line and the reason.
    [[noreturn]] void refuse(std::size_t line, std::string_view reason) const;
};

/// Whether a file begins as one of these does.
bool isMercuryRestart(const std::filesystem::path& file);
/// The file of this name, or with the ending .restart where only that is there.
std::filesystem::path withRestartEnding(const std::filesystem::path& file);
/// Throws InputError with the file, the line and the reason.
MercuryRestart readMercuryRestart(const std::filesystem::path& file);

}  // namespace pendular
