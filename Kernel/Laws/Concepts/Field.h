#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "Kernel/Foundation/Math/Scalar.h"

namespace pendular {

/// The value of a parameter that the user has not given (NaN, which fails every check).
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

constexpr bool isSet(double value) { return value == value; }

/// The values that a parameter may have. Not-a-number and infinity lie in no range.
struct Range {
    double lowest;
    double highest;
    bool lowestIncluded = true;
    bool highestIncluded = true;

    [[nodiscard]] constexpr bool contains(double value) const {
        const bool aboveLowest = lowestIncluded ? value >= lowest : value > lowest;
        const bool belowHighest = highestIncluded ? value <= highest : value < highest;
        return aboveLowest && belowHighest;
    }
    /// The range as a message tells it: "greater than 0 Pa and finite".
    [[nodiscard]] std::string text(std::string_view unit) const;
};

inline constexpr Range positive{0, infinity, false, false};
inline constexpr Range notNegative{0, infinity, true, false};
inline constexpr Range anyFinite{-infinity, infinity, false, false};
inline constexpr Range positiveUpTo(double highest) { return {0, highest, false, true}; }
inline constexpr Range fromZeroTo(double highest) { return {0, highest, true, true}; }

/// How the value for a pair of species follows from the values a and b of the two.
enum class Mixing {
    Arithmetic,  ///< (a + b) / 2
    Geometric,   ///< sqrt(a b): zero where one of the two is zero
    Harmonic,    ///< 2 a b / (a + b): springs in series
    Largest,     ///< max(a, b): an option that one of the two asks for
    MeanCosine   ///< arccos((cos a + cos b) / 2): two contact angles in one bridge
};

double mix(Mixing rule, double a, double b);
std::string_view formula(Mixing rule);

/// One parameter of a law. The table of a law's fields drives checks, error texts, mixing and
/// the reference page.
template <class Law>
struct Field {
    std::string_view name;
    double Law::*member;
    std::string_view unit;
    Range range;
    Mixing mixing;
    std::string_view meaning;
    std::string_view source;
    std::string_view ifUnset =
        {};  ///< where not empty: what a value that the user has not given is derived from

    /// This field, as one of a law that is derived from this one.
    template <class Derived>
    constexpr operator Field<Derived>() const {
        return {name, member, unit, range, mixing, meaning, source, ifUnset};
    }
};

/// The tables of the parts that a law is made of, as one.
template <class Law, class... Tables>
constexpr auto joinedFields(const Tables&... tables) {
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
        const auto at = [&](std::size_t wanted) {
            Field<Law> found{};
            std::size_t begin = 0;
            const auto look = [&](const auto& table) {
                if (wanted >= begin && wanted < begin + table.size()) found = table[wanted - begin];
                begin += table.size();
            };
            (look(tables), ...);
            return found;
        };
        return std::array<Field<Law>, sizeof...(k)>{at(k)...};
    }
    (std::make_index_sequence<(std::tuple_size_v<Tables> + ...)>{});
}

/// Throws InputError, in one sentence with owner, field, value, unit and range, unless the value is in the
/// range.
void checkValue(std::string_view owner, std::string_view field, double value, std::string_view unit,
                const Range& range);

/// Sets one field of a law, after the check that its table demands.
template <class Law, class Owner>
void setField(Law& law, double Owner::*member, double value) {
    for (const auto& field : Law::fields())
        if (field.member == member) checkValue(Law::name, field.name, value, field.unit, field.range);
    law.*member = value;
}

/// Throws InputError if a field is not set or out of range.
template <class Law>
void checkFields(const Law& law) {
    for (const auto& field : Law::fields())
        checkValue(Law::name, field.name, law.*field.member, field.unit, field.range);
}

/// The law of a pair of species: each field that `own` sets, and the mixture of a and b in all others.
template <class Law>
Law mixLaws(const Law& own, const Law& a, const Law& b) {
    Law result = own;
    for (const auto& field : Law::fields())
        if (!isSet(own.*field.member))
            result.*field.member = mix(field.mixing, a.*field.member, b.*field.member);
    return result;
}

/// Makes every field of a law unset.
template <class Law>
void unsetFields(Law& law) {
    for (const auto& field : Law::fields()) law.*field.member = unset;
}

}  // namespace pendular
