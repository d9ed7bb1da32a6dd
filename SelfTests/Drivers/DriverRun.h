#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"

/// What tests of drivers as programs share.
namespace pendular::driverRuns {

inline const std::string drivers = folders::drivers;

/// The folders under Drivers/ with a program of their own name.
inline std::vector<std::string> everyDriver() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folders::source / "Drivers")) {
        const std::string name = entry.path().filename().string();
        if (std::filesystem::exists(entry.path() / (name + ".cpp"))) names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

/// With these a driver's run is short; empty where it is without them.
inline std::string shortOptionsOf(const std::string& driver) {
    static const std::map<std::string, std::string> options{
        {"DryingBed", "--number 100 --begin-s 0.002 --end-time-s 0.004"},
        {"EllipsoidPacking", "--number 12 --width 3 --aspects 1 1.4 --friction 0.5 --stiffness 1000"},
        {"FluidisedColumn", "--cells 2 --stage-s 0.002"},
        {"HopperDischarge",
         "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 --begin-s 0.02 "
         "--end-time-s 0.06"},
        {"LiquidInShear", "--width-m 0.02 --end-time-s 0.01 --interval-s 0.005"},
        {"ObliqueImpact", "--angles-deg 10 --angles-deg 60"},
        {"MixedHopper",
         "--number 50 --hopper-diameter-m 0.016 --shares 1 0 0 0 --orifice-m 0.012 0.015 "
         "--elastic-modulus-Pa 1e6 --begin-s 0.06 --end-time-s 0.12"},
        {"Penetration", "--number 120 --softening 100 --end-time-s 0.001"},
        {"RodPacking", "--number 12 --width 3.5 --aspects 1 1.4 --stiffness 1000"},
        {"ShatteringPlate", "--plate-radius-m 0.008 --end-time-s 0.0003"},
        {"RotatingDrum", "--number 120 --softening 1000 --end-time-s 0.001"},
        {"ShearCell", "--number 108 --stiffness 1e4 --strain 0.2 --interval-strain 0.1"},
        {"SiloFilling", "--mass-kg 0.002 --fill-time-s 0.02 --end-time-s 0.04 --average-s 0.01"},
        {"ShearedSuspension", "--number 60 --strain 0.1 --begin-strain 0.05 --interval-strain 0.05"},
        {"SplitBottom", "--cylinder-m 0.008 --disc-m 0.004 --layers 3 --begin-s 0.01 --end-time-s 0.03"},
        {"SprayCoating", "--length-m 0.008 --begin-s 0.01 --end-time-s 0.03 --interval-s 0.01"},
        {"WetPlaneShear", "--strain 0.2"},
        {"TriaxialTest",
         "--number 64 --stiffness 1e3 --inertial-number 0.05 --strain 0.1 --interval-strain 0.05"},
        {"TriaxialSleeve", "--number 100 --inertial-number 0.03 --strain 0.05 --interval-strain 0.01"},
        {"UserDefinedLaw", "--end-time-s 0.005"},
        {"UserDefinedPart", "--end-time-s 0.01"},
        {"UserDefinedWall", "--end-time-s 0.05"},
        {"WetWallCollision", "--speeds-m/s 1"},
        {"WornDrum", "--end-time-s 0.02"},
        {"WornPlates", "--number 1 --speed-m/s 15"}};
    const auto found = options.find(driver);
    return found == options.end() ? "" : found->second;
}

/// The rows of a table without its header, numbers only.
inline std::vector<std::vector<double>> rowsOf(const std::filesystem::path& file) {
    return support::numbersOf(support::contentOf(file));
}
inline std::string headerOf(const std::filesystem::path& file) {
    const std::string text = support::contentOf(file);
    return text.substr(0, text.find('\n'));
}

}  // namespace pendular::driverRuns
