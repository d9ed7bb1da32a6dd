#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Tools/Snapshot/Colours.h"

namespace pendular::snapshot {

/// A bar of colours with numbers, or a square for each name.
struct Legend {
    struct Mark {
        double place;  // along the bar, from 0 to 1
        std::string text;
        std::optional<Colour> square;
    };
    std::string title;
    const ColourMap* map = nullptr;  // of the bar; none with squares
    std::vector<Mark> marks;
};

/// The width of a text over the size of its letters. POV-Ray's font 2 is about as wide as Helvetica, whose
/// widths (Adobe, "Font metrics of the 14 PDF core fonts") are rounded up here.
inline double widthOf(std::string_view text) {
    const auto isOneOf = [](char c, std::string_view group) { return group.find(c) != group.npos; };
    double width = 0;
    for (const char c : text) {
        if (isOneOf(c, "ijl' ,.:;/!|It f")) width += 0.3;
        else if (isOneOf(c, "r()[]-`\"*{}")) width += 0.4;
        else if (isOneOf(c, "mM%@W")) width += 1;
        else if ((c >= 'A' && c <= 'Z') || isOneOf(c, "w&+=<>~")) width += 0.8;
        else width += 0.57;  // digits, and most small letters
    }
    return width;
}

/// Where a legend lies in a picture. One unit is half of the picture's height, as in PovScene.
struct LegendPlace {
    double strip;    // the width on the right that has no grains
    double left;     // of the bar
    double letters;  // their size
    double bar;      // its width

    [[nodiscard]] double textLeft() const { return left + 1.5 * bar; }
};

/// A fifth of the picture's width, or as much as the texts need; where that is more than half of it, letters
/// and bar are smaller.
/// @param aspect the picture's width over its height
inline LegendPlace placeOf(const Legend& legend, double aspect) {
    constexpr double letters = 0.07, bar = 0.09, gap = 0.04;
    double marks = 0;
    for (const Legend::Mark& mark : legend.marks) marks = std::max(marks, widthOf(mark.text));
    const double fromBar = 1.5 * bar + letters * marks + gap;  // to the picture's edge
    const double strip = std::max({0.4 * aspect, fromBar + gap, letters * widthOf(legend.title) + 2 * gap});
    const double scale = std::min(1.0, aspect / strip);
    return {scale * strip, aspect - scale * std::max(0.85 * strip, fromBar), scale * letters, scale * bar};
}

}  // namespace pendular::snapshot
