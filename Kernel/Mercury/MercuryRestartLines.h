#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

/// The name of a type or a field in a message: all of it, unless it is none.
std::string shownName(std::string_view word);

/// The lines of a restart file of MercuryDPM's, one after the other, and their words: keywords, each with its
/// values behind it. All functions that look for a word throw InputError, with the file and the line, where
/// its values are not as they are asked for.
class MercuryRestartLines {
public:
    explicit MercuryRestartLines(const InputFile& of) : file(&of) {}

    /// The next line that is not empty; false at the end of the file. Throws for one of more words than any
    /// has.
    bool next();
    /// The same; throws InputError at the end of the file.
    void require();
    [[nodiscard]] const std::vector<std::string_view>& all() const { return words; }
    [[nodiscard]] std::string_view first() const { return words.front(); }
    [[nodiscard]] std::size_t number() const { return line; }

    [[nodiscard]] bool has(std::string_view word) const { return behind(word).has_value(); }
    /// The place behind the first, or the last, of these words of the line.
    [[nodiscard]] std::optional<std::size_t> behind(std::string_view word) const;
    [[nodiscard]] std::optional<std::size_t> behindLast(std::string_view word) const;
    /// How many numbers follow from a place on.
    [[nodiscard]] std::size_t countAt(std::size_t place) const;
    /// Throws for nan and infinity, which the text of MercuryDPM's has where a run went wrong.
    [[nodiscard]] double numberAt(std::size_t place) const;
    /// The same, for parameters that may be infinite.
    [[nodiscard]] double parameterAt(std::size_t place) const;
    /// The same, of a number of things, or of one of them.
    [[nodiscard]] std::uint64_t wholeAt(std::size_t place) const;
    [[nodiscard]] Vec3D vectorAt(std::size_t place) const;
    /// The value behind a word; the standard one where the word is not there.
    [[nodiscard]] double value(std::string_view word, std::optional<double> standard = {}) const;
    [[nodiscard]] std::uint64_t count(std::string_view word,
                                      std::optional<std::uint64_t> standard = {}) const;
    [[nodiscard]] Vec3D vector(std::string_view word, std::optional<Vec3D> standard = {}) const;
    /// The same, of which some versions wrote four numbers, as long as all of them were 0.
    [[nodiscard]] Vec3D spin(std::string_view word) const;
    /// The direction into which an orientation (a quaternion: its scalar part, then its vector) turns the
    /// axis x.
    [[nodiscard]] Vec3D directionAt(std::size_t place) const;
    [[nodiscard]] Vec3D turnedAt(std::size_t place, const Vec3D& vector) const;

    /// Throws InputError, by its name and value, for the first word that is not among these and has a value
    /// other than 0. @param what "a particle"
    void refuseOthers(std::string_view what, std::initializer_list<std::string_view> known) const;
    [[noreturn]] void refuse(std::string_view reason) const;

private:
    /// The word whose value a place has, for messages.
    [[nodiscard]] std::string keywordOf(std::size_t place) const;

    const InputFile* file;
    std::vector<std::string_view> words;
    std::size_t at = 0, line = 0;
};

}  // namespace pendular
