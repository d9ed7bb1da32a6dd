#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace pendular::view {

/// In the folder of a run that was started from the page: what with.
inline constexpr std::string_view startFile = "view-start.json";
/// How the name of a list of HDF5 frames ends, behind that of its run.
inline constexpr std::string_view hdf5Frames = "-fields.h5";

/// The files of a run: those whose names begin with `name` (its setName()), in a folder beneath the
/// root.
struct RunFiles {
    std::string id;  // from the root: "RotatingDrum-output/run"
    std::filesystem::path folder;
    std::string name;  // "run"

    [[nodiscard]] std::filesystem::path file(std::string_view ending) const {
        return folder / (name + std::string(ending));
    }
    /// Of the run that makes its first grains.
    [[nodiscard]] std::filesystem::path preparationFile(std::string_view ending) const {
        return folder / ("preparation" + std::string(ending));
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

    [[nodiscard]] const std::filesystem::path& root() const { return top; }
    /// Sorted by id.
    [[nodiscard]] std::vector<RunFiles> list() const;
    /// The run of an id, which may be any text; nothing where there is none.
    [[nodiscard]] std::optional<RunFiles> find(const std::string& id) const;

private:
    std::filesystem::path top;
};

/// Whether the path is a regular file, and no link.
bool isOwnFile(const std::filesystem::path& path);
/// Whether a series for ParaView is one of fields of coarse graining, which is no run of its own.
bool isOfFields(const std::filesystem::path& series);

/// The locks that processes of this machine have now.
class Locks {
public:
    Locks();
    /// The process that has a lock (Kernel/Files/FileLock.h), seen without touching the lock; 0: none.
    [[nodiscard]] pid_t holderOf(const std::filesystem::path& lock) const;

private:
    struct Lock {
        unsigned long long inode = 0;
        unsigned major = 0, minor = 0;  // of the device
        int process = 0;
    };
    std::vector<Lock> all;
};

}  // namespace pendular::view
