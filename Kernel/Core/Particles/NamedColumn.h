#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

/// A number that a driver or a piece of physics keeps of each grain or each contact, with a name and a unit:
/// film volume, temperature, age. It follows its owner when grains are sorted, removed, written and
/// restarted.
struct NamedColumn {
    std::string name, unit;
    double initial = 0;  // of what is new

    /// The column's name in files.
    [[nodiscard]] std::string fieldName() const { return unit.empty() ? name : name + "_" + unit; }
};

/// Throws InputError unless a column like this can be added to those of the owners.
/// @param owners "grains" or "contacts"
/// @param isTaken the owners have a column of this name
void requireNewColumn(const NamedColumn& added, std::string_view owners, bool isTaken);

/// Whether one of the columns has this name.
template <class Column>
bool hasColumn(const std::vector<Column>& columns, const std::string& name) {
    return std::ranges::find(columns, name, &Column::name) != columns.end();
}

}  // namespace pendular
