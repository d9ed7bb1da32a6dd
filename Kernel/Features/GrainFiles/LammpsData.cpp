#include <limits>

#include "Kernel/Features/GrainFiles/LammpsFiles.h"

namespace pendular {

namespace {

/// The words of the comment behind "Atoms", with which LAMMPS says the style of the rows.
std::vector<std::string_view> styleOf(std::string_view comment) {
    std::vector<std::string_view> style;
    Words words(comment);
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) style.push_back(word);
    return style;
}

bool isSphere(std::string_view style) { return style == "sphere" || style == "granular"; }

class DataReader {
public:
    explicit DataReader(const InputFile& of) : file(of), lines(of) {}

    std::vector<GrainRow> read() {
        takeTitle();
        bool more = takeHeader();
        while (more) {
            const std::string_view section = lines.words().front();
            if (section == "Atoms") more = takeAtoms();
            else if (section == "Velocities") more = takeVelocities();
            else more = skipSection();
        }
        if (grains.size() != atoms)
            file.refuse(fmt::format("has {} atoms by its header, and {} rows in its section Atoms", atoms,
                                    grains.size()));
        return grains.rows();
    }

private:
    /// The first line is a comment, in which write_data says the units.
    void takeTitle() {
        const std::string_view title = std::string_view(file.text).substr(0, file.text.find('\n'));
        constexpr std::string_view mark = "units = ";
        const std::size_t at = title.find(mark);
        if (at != title.npos) refuseOtherUnits(file, Words(title.substr(at + mark.size())).next());
        lines = WordLines(file, std::min(title.size() + 1, file.text.size()));
    }
    /// Each begins with a number; what begins with a letter is a section.
    bool takeHeader() {
        bool more = lines.next();
        for (; more && !lines.beginsWithLetter(); more = lines.next())
            if (lines.words().size() == 2 && lines.words()[1] == "atoms") {
                const std::int64_t count = lines.whole(0);
                if (count < 1)
                    lines.refuse(fmt::format("there are {} atoms; there must be one at least", count));
                atoms = static_cast<std::size_t>(count);
            }
        return more;
    }
    bool skipSection() {
        bool more = lines.next();
        while (more && !lines.beginsWithLetter()) more = lines.next();
        return more;
    }

    bool takeAtoms() {
        const std::vector<std::string_view> style = styleOf(lines.comment());
        isHybrid = !style.empty() && style.front() == "hybrid";
        const bool isKnown = style.empty() || isSphere(style.front()) ||
                             (isHybrid && (style.size() == 1 || isSphere(style[1])));
        if (!isKnown)
            lines.refuse(
                fmt::format("the atoms have the style '{}'; grains have the style sphere or granular, or "
                            "hybrid with that first",
                            shown(isHybrid ? style[1] : style.front())));
        const bool mayHaveMore = isHybrid && style.size() > 2;
        bool more = lines.next();
        for (; more && !lines.beginsWithLetter(); more = lines.next()) {
            const std::size_t size = lines.words().size();
            if (size != 7 && size != 10 && !(mayHaveMore && size > 7))
                lines.refuse(fmt::format(
                    "{} columns; a row of Atoms has 7, {}, or 10 with image flags{}", size,
                    isHybrid ? "id type x y z diameter density" : "id type diameter density x y z",
                    isHybrid && !mayHaveMore ? " (for more, the line 'Atoms # hybrid' must name the styles)"
                                             : ""));
            takeAtom();
        }
        grains.sort(file);
        return more;
    }
    void takeAtom() {
        const std::size_t place = isHybrid ? 2 : 4, diameter = isHybrid ? 5 : 2;
        const std::int64_t type = lines.whole(1);
        if (type < 1 || type > std::numeric_limits<int>::max())
            lines.refuse(fmt::format("the type {} must be a number from 1 on", type));
        GrainRow grain{0.5 * lines.length(diameter),
                       {lines.length(place), lines.length(place + 1), lines.length(place + 2)}};
        grain.type = static_cast<int>(type);
        grain.density = lines.finite(diameter + 1);
        grains.add(lines, lines.whole(0), grain);
    }

    bool takeVelocities() {
        std::size_t rows = 0;
        bool more = lines.next();
        for (; more && !lines.beginsWithLetter(); more = lines.next(), ++rows) {
            const std::size_t size = lines.words().size();
            if (size != 4 && size != 7 && !(isHybrid && size > 7))
                lines.refuse(
                    fmt::format("{} columns; a row of Velocities has 7, id vx vy vz wx wy wz", size));
            GrainRow* const grain = grains.find(lines.whole(0));
            if (!grain)
                lines.refuse(fmt::format("there is no atom {} in a section Atoms before", lines.whole(0)));
            grain->velocity = lines.vector(1);
            if (size >= 7) grain->angularVelocity = lines.vector(4);
        }
        if (rows != grains.size())
            file.refuse(
                fmt::format("has {} rows in its section Velocities, and {} in Atoms", rows, grains.size()));
        return more;
    }

    const InputFile& file;
    WordLines lines;
    std::size_t atoms = 0;
    bool isHybrid = false;
    NumberedGrains grains;
};

}  // namespace

std::vector<GrainRow> readLammpsData(const InputFile& file) { return DataReader(file).read(); }

}  // namespace pendular
