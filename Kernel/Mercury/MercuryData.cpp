#include "Kernel/Mercury/MercuryData.h"

#include <array>
#include <cmath>
#include <sstream>

#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {
namespace {

/// The numbers of the next line of a file. Throws InputError unless there are so many.
template <std::size_t Count>
std::array<double, Count> numbersOfLine(const InputFile& file, std::istringstream& text, std::size_t line,
                                        const char* what) {
    std::string row;
    if (!std::getline(text, row))
        file.refuse("line", line, "there is none; the header announces more grains");
    Words words(row);
    std::array<double, Count> numbers{};
    for (double& number : numbers) {
        const std::string_view word = words.next();
        if (word.empty()) file.refuse("line", line, fmt::format("{} has {} numbers", what, Count));
        if (!parseNumber(word, number)) file.refuse("line", line, whyNoNumber(word));
    }
    if (!words.next().empty())
        file.refuse("line", line, fmt::format("{} has no more than {} numbers", what, Count));
    return numbers;
}

bool isCount(double number) { return number >= 0 && number < 4e9 && number == std::floor(number); }

}  // namespace

MercuryFrame readMercuryData(const std::filesystem::path& path) {
    const InputFile file = loadTextFile("data file", path);
    std::istringstream text(file.text);
    const auto head = numbersOfLine<8>(file, text, 1, "a header of MercuryDPM in 3D");
    if (!isCount(head[0])) file.refuse("line", 1, "the number of grains must be a whole number, at least 0");
    MercuryFrame frame{head[1], {head[2], head[3], head[4]}, {head[5], head[6], head[7]}, {}};
    for (std::size_t k = 0; k < static_cast<std::size_t>(head[0]); ++k) {
        const std::size_t line = k + 2;
        const auto row = numbersOfLine<14>(file, text, line, "a grain in 3D");
        if (!isCount(row[13]) || row[13] > 1e4)
            file.refuse("line", line, "the last number is that of a species, a whole number, at least 0");
        frame.grains.push_back({.radius = row[6],
                                .position = {row[0], row[1], row[2]},
                                .velocity = {row[3], row[4], row[5]},
                                .angularVelocity = {row[10], row[11], row[12]},
                                .type = static_cast<int>(row[13]) + 1});
    }
    return frame;
}

}  // namespace pendular
