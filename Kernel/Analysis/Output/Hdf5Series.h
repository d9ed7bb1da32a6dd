#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pendular {

/// A frame of a list.
struct Hdf5Entry {
    double time;                 // s
    std::filesystem::path file;  // beside the list
};

/// The frames of a list BEGINNING.h5, in order. Throws InputError if it is no such list.
/// @param named by what name its frames are known, where the path is not that one (that of an open file)
std::vector<Hdf5Entry> readHdf5Series(const std::filesystem::path& path,
                                      const std::filesystem::path& named = {});

/// A list of frames, BEGINNING.h5, in which each of them, a file BEGINNING-STEP.h5, appears as the group
/// frames/STEP. Every file is complete at any moment, so a run that is killed leaves all frames but the one
/// that it was writing.
class Hdf5Series {
public:
    /// Keeps the frames of an earlier part of the run up to a time (s; -infinity: none), removes later ones.
    Hdf5Series(std::string beginning, double keptUntil);
    static std::filesystem::path indexOf(const std::string& beginning) { return beginning + ".h5"; }
    /// Throws InputError if this build cannot write such files.
    static void prepare();
    /// Throws InputError if the list is there and cannot be gone on with.
    static void check(const std::string& beginning);

    /// The file of the frame of a step, which is to be written before the frame is added.
    [[nodiscard]] std::filesystem::path fileOf(std::uint64_t step) const;
    /// @param time s
    void add(std::uint64_t step, double time);

private:
    friend std::vector<Hdf5Entry> readHdf5Series(const std::filesystem::path& path,
                                                 const std::filesystem::path& named);
    using Times = std::map<std::uint64_t, double>;  // s, of each frame, by its step

    static Times readIndex(const std::filesystem::path& path);
    /// The times of a series that is there; none for one that cannot be read, if none of them are needed.
    [[nodiscard]] Times formerTimes(bool needed) const;
    void writeIndex() const;

    std::string beginning;
    Times times;
};

}  // namespace pendular
