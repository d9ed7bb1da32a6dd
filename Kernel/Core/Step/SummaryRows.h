#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Files/CsvFile.h"

namespace pendular {

/// The rows of a summary: a quantity, its value and its unit.
class SummaryRows {
public:
    template <class Value>
    void add(std::string quantity, const Value& value, std::string_view unit = {}) {
        std::string text = fmt::format("{}", value), shown = withUnit(text, unit);
        rows.push_back({std::move(quantity), std::move(text), std::string(unit), std::move(shown)});
    }
    /// Adds a number, which is shown with fewer digits than the file has.
    /// @param behind is shown behind the unit
    void addNumber(std::string quantity, double value, std::string_view unit, std::string_view behind = {}) {
        add(std::move(quantity), value, unit);
        rows.back().shown = withUnit(fmt::format("{:.4g}", value), unit).append(behind);
    }

    /// Text with commas is quoted. Sentences of others, as of a driver's own warnings, may have lines and
    /// quotes: a row has neither.
    void write(CsvFile& file) const {
        for (const Row& row : rows) {
            std::string text = row.value;
            for (char& letter : text)
                if (letter == '\n' || letter == '\r') letter = ' ';
                else if (letter == '"') letter = '\'';
            file.row(row.quantity, text.find(',') == text.npos ? text : '"' + text + '"', row.unit);
        }
    }
    /// Lines for eyes.
    [[nodiscard]] std::string shown() const {
        std::string text;
        for (const Row& row : rows) text += fmt::format("  {:<36} {}\n", row.quantity, row.shown);
        return text;
    }

private:
    static std::string withUnit(const std::string& value, std::string_view unit) {
        return unit.empty() ? value : fmt::format("{} {}", value, unit);
    }

    struct Row {
        std::string quantity, value, unit, shown;
    };
    std::vector<Row> rows;
};

}  // namespace pendular
