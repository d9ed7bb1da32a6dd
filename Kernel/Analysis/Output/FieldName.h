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
    constexpr std::pair<std::string_view, std::string_view> units[] = {{"_kg_per_m3", "kg/m^3"},
                                                                       {"_kg_per_m2s", "kg/(m^2 s)"},
                                                                       {"_m2_per_s2", "m^2/s^2"},
                                                                       {"_N_per_m3", "N/m^3"},
                                                                       {"_per_m3", "1/m^3"},
                                                                       {"_m_per_s", "m/s"},
                                                                       {"_rad_per_s", "rad/s"},
                                                                       {"_m3", "m^3"},
                                                                       {"_m", "m"},
                                                                       {"_N", "N"},
                                                                       {"_Pa", "Pa"},
                                                                       {"_J", "J"},
                                                                       {"_K", "K"},
                                                                       {"_s", "s"},
                                                                       {"_Nm", "N m"},
                                                                       {"_kg", "kg"}};
    for (const auto& [ending, unit] : units)
        if (name.ends_with(ending))
            return {std::string(name.substr(0, name.size() - ending.size())), std::string(unit)};
    return {std::string(name), ""};
}

}  // namespace pendular
