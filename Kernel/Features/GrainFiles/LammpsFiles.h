#pragma once

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

/// The grains of a data file: https://docs.lammps.org/read_data.html, sections Atoms and Velocities.
std::vector<GrainRow> readLammpsData(const InputFile& file);
/// The grains of a snapshot in a dump: https://docs.lammps.org/dump.html, style custom.
std::vector<GrainRow> readLammpsDump(const InputFile& file, std::optional<std::int64_t> timestep);

/// The lines of a text, one after the other, each as its words.
class WordLines {
public:
    explicit WordLines(const InputFile& of, std::size_t offset = 0);

    /// Goes to the next line that has words; false at the end of the file.
    bool next();
    [[nodiscard]] const std::vector<std::string_view>& words() const { return all; }
    /// The comment of the line: what is behind a #, without it.
    [[nodiscard]] std::string_view comment() const { return behindHash; }
    [[nodiscard]] std::size_t line() const { return number; }
    /// Whether the first word begins with a letter.
    [[nodiscard]] bool beginsWithLetter() const;

    // The word with this number; they throw InputError with the line.
    [[nodiscard]] std::int64_t whole(std::size_t word) const;
    [[nodiscard]] double finite(std::size_t word) const;
    [[nodiscard]] double length(std::size_t word) const;  // m
    [[nodiscard]] Vec3D vector(std::size_t first) const;
    [[noreturn]] void refuse(std::string_view reason) const { file->refuse("line", number, reason); }

private:
    const InputFile* file;
    std::string_view rest, behindHash;
    std::size_t number = 0;
    std::vector<std::string_view> all;
};

/// Grains with their numbers in the file.
class NumberedGrains {
public:
    /// Checks radius and density. @param where the line of the file
    void add(const WordLines& where, std::int64_t number, const GrainRow& grain);
    [[nodiscard]] std::size_t size() const { return grains.size(); }
    /// Sorts the grains by their numbers, once all are added. Throws InputError where two have the same.
    void sort(const InputFile& file);
    /// The grain with a number; nullptr if there is none. Only after sort(), as rows().
    [[nodiscard]] GrainRow* find(std::int64_t number);
    [[nodiscard]] std::vector<GrainRow> rows() const;

private:
    struct Numbered {
        std::int64_t number;
        GrainRow grain;
    };
    std::vector<Numbered> grains;
};

/// Throws InputError unless it is SI.
void refuseOtherUnits(const InputFile& file, std::string_view units);

}  // namespace pendular
