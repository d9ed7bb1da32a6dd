#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace pendular {

/// "velocity_m_per_s" is the quantity "velocity" in the unit "m/s". The unit is empty where the name ends
/// with none that is known.
struct FieldName {
    std::string quantity, unit;
};

inline FieldName splitFieldName(std::string_view name) {
    constexpr std::pair<std::string_view, std::string_view> units[] = {
        {"_m_per_s", "m/s"}, {"_rad_per_s", "rad/s"}, {"_m3", "m^3"}, {"_m", "m"},
        {"_N", "N"},         {"_Pa", "Pa"},           {"_J", "J"},    {"_K", "K"},
        {"_s", "s"},         {"_Nm", "N m"},          {"_kg", "kg"}};
    for (const auto& [ending, unit] : units)
        if (name.ends_with(ending))
            return {std::string(name.substr(0, name.size() - ending.size())), std::string(unit)};
    return {std::string(name), ""};
}

}  // namespace pendular
