#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace pendular::support {

using Row = std::map<std::string, std::string>;

/// The rows of a table, by the names of its columns.
inline std::vector<Row> rowsOf(const std::string& table) {
    const auto cells = [](const std::string& line) {
        std::vector<std::string> parts;
        std::istringstream stream(line + ",");
        for (std::string cell; std::getline(stream, cell, ',');) parts.push_back(cell);
        return parts;
    };
    std::istringstream lines(table);
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#")) continue;
        const auto parts = cells(line);
        if (names.empty()) {
            names = parts;
            continue;
        }
        EXPECT_EQ(parts.size(), names.size()) << line;
        for (std::size_t k = 0; k < std::min(parts.size(), names.size()); ++k) {
            if (k == 0) rows.emplace_back();
            rows.back()[names[k]] = parts[k];
        }
    }
    return rows;
}

/// The rows of a table without its header, numbers only.
inline std::vector<std::vector<double>> numbersOf(const std::string& table) {
    std::istringstream lines(table);
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

}  // namespace pendular::support
