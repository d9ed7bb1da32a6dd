#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "Tools/View/OpenFolder.h"

namespace pendular::view {

/// In the folder of a run that was started from the page: what with.
inline const std::string startFile = "view-start.json";
/// Where what such a run prints goes. There is none before it is started.
inline const std::string logFile = "view-output.txt";
/// How the name of a list of HDF5 frames ends, behind that of its run.
inline constexpr std::string_view hdf5Frames = "-fields.h5";

/// The files of a run: those whose names begin with `name` (its setName()), in a folder beneath the
/// root, which is open as long as this lives.
struct RunFiles {
    std::string id;  // from the root, as NameText.h writes it: "RotatingDrum-output/run"
    std::shared_ptr<const OpenFolder> folder;
    std::string name;  // "run"

    /// The name of a file of the run.
    [[nodiscard]] std::string file(std::string_view ending) const { return std::string(name).append(ending); }
    /// Of the run that makes its first grains.
    [[nodiscard]] static std::string preparationFile(std::string_view ending) {
        return std::string("preparation").append(ending);
    }
};

/// All runs beneath a folder. Links are not followed, hidden names not seen, so that nothing outside of it
/// can be reached.
class RunFolder {
public:
    /// Throws InputError unless it is a folder.
    explicit RunFolder(const std::filesystem::path& root);

    static constexpr int deepest = 5;              // folders in each other
    static constexpr std::size_t mostRuns = 1000;  // that are listed

    [[nodiscard]] const OpenFolder& root() const { return *top; }
    /// The ids of all runs, sorted.
    [[nodiscard]] std::vector<std::string> list() const;
    /// The run of an id, which may be any text; nothing where there is none.
    [[nodiscard]] std::optional<RunFiles> find(const std::string& id) const;

private:
    std::shared_ptr<const OpenFolder> top;
};

/// Whether a series for ParaView is one of fields of coarse graining, which is no run of its own.
bool isOfFields(const OpenFolder& folder, const std::string& series);

/// The locks that processes of this machine have now.
class Locks {
public:
    Locks();
    /// The process that has a lock (Kernel/Foundation/Files/FileLock.h), seen without touching the lock; 0:
    /// none.
    [[nodiscard]] pid_t holderOf(const OpenFolder& folder, const std::string& file) const;

private:
    struct Lock {
        unsigned long long inode = 0;
        unsigned major = 0, minor = 0;  // of the device
        int process = 0;
    };
    std::vector<Lock> all;
};

}  // namespace pendular::view
