#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "Kernel/Foundation/Base/LargePages.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Foundation/State/StateDigest.h"

namespace pendular {

template <class Number>
constexpr NumberKind kindOf() {
    if constexpr (std::is_same_v<Number, double>) return NumberKind::Float64;
    else if constexpr (std::is_same_v<Number, float>) return NumberKind::Float32;
    else if constexpr (std::is_same_v<Number, bool>) return NumberKind::UInt8;
    else if constexpr (std::is_signed_v<Number>) {
        static_assert(sizeof(Number) == 4);
        return NumberKind::Int32;
    } else {
        static_assert(std::is_unsigned_v<Number>);
        return sizeof(Number) == 8   ? NumberKind::UInt64
               : sizeof(Number) == 4 ? NumberKind::UInt32
               : sizeof(Number) == 2 ? NumberKind::UInt16
                                     : NumberKind::UInt8;
    }
}

/// A record that is nothing but numbers of one kind: a Vector<double>, a column's block.
template <class Record, class Number>
concept RecordOf = std::is_trivially_copyable_v<Record> && sizeof(Record) % sizeof(Number) == 0;

/// The way of a scene's state into a restart file or out of one. A class lists what it remembers in one
/// function, visitState(StateArchive&), which serves both ways: what is read is what was written. All bits of
/// a number are kept. Names are unique within their group.
class StateArchive {
public:
    enum class Direction { Write, Read };

    StateArchive(Hdf5File& stateFile, Direction way) : file(&stateFile), direction(way) {}
    /// Writes into a hash instead of a file.
    explicit StateArchive(StateDigest& into) : direction(Direction::Write), digest(&into) {}

    [[nodiscard]] bool isReading() const { return direction == Direction::Read; }
    [[nodiscard]] bool isWriting() const { return direction == Direction::Write; }
    /// Whether a file that is read has something of this name.
    [[nodiscard]] bool holds(std::string_view name) const { return file && file->holds(fullName(name)); }

    /// All that is visited within the function is in this group.
    template <class Function>
    void group(std::string_view name, Function&& visit) {
        const std::size_t outside = prefix.size();
        prefix.append(name).push_back('/');
        visit();
        prefix.resize(outside);
    }

    /// A column of any length.
    template <class Number, RecordOf<Number> Record>
    void column(std::string_view name, std::vector<Record>& records) {
        constexpr TableShape one{kindOf<Number>(), 1, sizeof(Record) / sizeof(Number)};
        if (isReading()) {
            const std::size_t rows = rowsOf(name, one);
            records.clear();
            reserveLarge(records, rows);
            records.resize(rows);
        }
        transfer(name, {one.kind, records.size(), one.columns}, records.data());
    }
    /// A few numbers, such as a Vector<double>.
    template <class Number, RecordOf<Number> Record>
    void record(std::string_view name, Record& numbers) {
        transfer(name, {kindOf<Number>(), 1, sizeof(Record) / sizeof(Number)}, &numbers);
    }
    /// Numbers that a state which is whole has finite.
    template <RecordOf<double> Record>
    void finite(std::string_view name, Record& numbers) {
        record<double>(name, numbers);
        requireFinite(name, numbers);
    }
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void value(std::string_view name, Number& number) {
        if constexpr (std::is_same_v<Number, bool>) {
            std::uint8_t byte = number ? 1 : 0;
            record<std::uint8_t>(name, byte);
            require(byte <= 1, name, "is neither 0 nor 1");
            number = byte == 1;
        } else {
            record<Number>(name, number);
        }
    }
    void text(std::string_view name, std::string& content);

    /// Checks what must hold of a state that is whole. Throws InputError, with the name and what is wrong
    /// with it, where it does not: the content of a file is checked before anything uses it, and that of a
    /// scene before a good file is replaced.
    void require(bool holds, std::string_view name, std::string_view whatIsWrong) const {
        if (!holds) refuse(name, whatIsWrong);
    }
    template <class Record>
    void requireFinite(std::string_view name, const std::vector<Record>& records) const {
        require(std::all_of(records.begin(), records.end(), isFinite<Record>), name, notFinite);
    }
    template <class Record>
    void requireFinite(std::string_view name, const Record& record) const {
        require(isFinite<Record>(record), name, notFinite);
    }

    /// Checks what a scene must set as it was when the file was written: a species' parameter, a wall's
    /// shape. Reading throws InputError where it is not so.
    /// @param advice ends the sentence: what to do
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void same(std::string_view name, Number number, std::string_view unit = {},
              std::string_view advice = "a run goes on with the values it began with") {
        if (!isReading()) {
            unitOfNext = unit;
            return value(name, number);
        }
        Number kept{};
        value(name, kept);
        const std::string before = shown(kept), after = shown(number);
        requireSame(before == after, name, before, after, unit, advice);
    }
    void same(std::string_view name, std::string_view text);
    /// Refuses a file that is read unless something is the same that is compared in another way.
    /// @param kept, now: what the sentence shows
    void requireSame(bool isSame, std::string_view name, const std::string& kept, const std::string& now,
                     std::string_view unit, std::string_view advice) const;
    /// A list of numbers, or of records of numbers. Where it is another one, the sentence has all of a short
    /// list, and of a long one the first number that differs.
    template <class Number, RecordOf<Number> Record>
    void same(std::string_view name, std::span<const Record> records, std::string_view unit = {}) {
        std::vector<Number> numbers(records.size_bytes() / sizeof(Number));
        if (!records.empty()) std::memcpy(numbers.data(), records.data(), records.size_bytes());
        if (!isReading()) {
            unitOfNext = unit;
            return column<Number>(name, numbers);
        }
        std::vector<Number> kept;
        column<Number>(name, kept);
        const auto isEqual = [](Number a, Number b) { return a == b || (a != a && b != b); };
        if (std::ranges::equal(kept, numbers, isEqual)) return;
        const auto shape = [](std::span<const Number> part) {
            return TableShape{kindOf<Number>(), part.size(), 1};
        };
        std::span<const Number> inFile(kept), inScene(numbers);
        std::string what(name);
        if (kept.size() == numbers.size() && kept.size() > mostShown) {
            const auto at =
                static_cast<std::size_t>(std::ranges::mismatch(kept, numbers, isEqual).in1 - kept.begin());
            inFile = inFile.subspan(at, 1), inScene = inScene.subspan(at, 1);
            what += numberOfList(at);
        }
        requireSame(false, what, shownNumbers(shape(inFile), inFile.data(), unit),
                    shownNumbers(shape(inScene), inScene.data(), unit), {},
                    "a run goes on with the values it began with");
    }
    template <class Number, RecordOf<Number> Record>
    void sameRecord(std::string_view name, const Record& numbers, std::string_view unit = {}) {
        same<Number>(name, std::span<const Record>(&numbers, 1), unit);
    }
    /// What a function of the driver gives, which another machine may compute with other last digits: the
    /// same within 1e-9 of the largest number.
    void sameValues(std::string_view name, std::vector<double> numbers, std::string_view unit);

private:
    [[nodiscard]] std::string fullName(std::string_view name) const { return prefix + std::string(name); }
    /// The rows of a table of the file, which has this kind and these columns.
    [[nodiscard]] std::size_t rowsOf(std::string_view name, const TableShape& row) const;
    static constexpr std::string_view notFinite = "has a number that is not finite";
    template <RecordOf<double> Record>
    static bool isFinite(const Record& record) {
        std::array<double, sizeof(Record) / sizeof(double)> numbers;
        std::memcpy(numbers.data(), &record, sizeof(Record));
        return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
    }
    [[noreturn]] void refuse(std::string_view name, std::string_view whatIsWrong) const;
    [[noreturn]] void refuseMissing(std::string_view name) const;
    void transfer(std::string_view name, const TableShape& shape, void* numbers);
    static constexpr std::size_t mostShown = 9;
    static std::string numberOfList(std::size_t at);
    static std::string shown(double number);
    static std::string shown(std::integral auto number) { return std::to_string(number); }

    Hdf5File* file = nullptr;
    Direction direction;
    std::string prefix;
    StateDigest* digest = nullptr;     // in place of a file
    std::string_view unitOfNext = {};  // of what same() writes, for the digest
};

}  // namespace pendular
