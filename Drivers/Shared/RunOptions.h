#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

class Scene;

/// What the user of any driver can say of its run, besides the scene.
struct RunOptions {
    std::string output;  // folder; empty, which no command line can say: the run keeps no restart file
    int threads = 1;
    std::string restart{};  // file; empty: none
    bool resume = false;
    double restartInterval = 600;  // s of the clock on the wall
    std::string wallTime{};        // [[hours:]minutes:]seconds; empty: no limit
    bool quiet = false;
    double paraViewInterval = 0;   // s; 0: no files for ParaView
    bool paraViewParts = false;    // on several ranks, one of each
    double hdf5Interval = 0;       // s; 0: no HDF5 files of fields
    double energyInterval = 0;     // s; 0: no ledger of the energy
    double wallForceInterval = 0;  // s; 0: no forces on walls

    /// The restart file from which a run of this name goes on; empty if it begins.
    [[nodiscard]] std::filesystem::path restartSource(const std::string& run = "run") const;
    /// When the run of this scene begins, and so not before all of it has been checked, it removes the
    /// restart files that earlier runs of these names have left, unless they are to be gone on with.
    void forgetAtStart(Scene& scene, const std::vector<std::string>& runs) const;
    /// Gives a run that makes the initial state what these options say of it. It keeps only a restart file of
    /// its own, from which --resume goes on, and not from one that an earlier run has left, and a summary,
    /// which tells how far it is.
    void applyToPreparation(Scene& scene) const;
    /// Gives a scene a name in the folder, and what these options say of its run.
    void apply(Scene& scene, const std::string& run = "run") const;

private:
    /// That of a scene: with the folder.
    [[nodiscard]] std::string nameOf(const std::string& run) const;
    void applyToAny(Scene& scene, const std::string& run) const;
};

/// Makes the folder if there is none. Throws InputError unless files can be written into it.
void requireOutputFolder(std::string_view driver, const std::filesystem::path& folder);

/// "11:30:00", "90:00" or "45" in s. Throws InputError.
double secondsOf(const std::string& clock);

/// Throws InputError for no grain, more than 1e8, or more than fit into the memory of this machine.
void checkNumberOfGrains(std::string_view program, std::size_t number);

/// Throws InputError, before a scene is made, unless a run with these options can begin.
/// @param endTime s; @param interval s
void checkRun(std::string_view driver, std::size_t number, double endTime, double interval);

/// Whole steps nearest to an interval of output, at least one; 0 (no output between) where they are more than
/// 1e15.
/// @param interval s; @param timeStep s
std::size_t stepsOf(double interval, double timeStep);

}  // namespace pendular
