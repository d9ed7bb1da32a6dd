#pragma once

#include <cstring>
#include <limits>
#include <map>
#include <optional>

#include "Kernel/Foundation/State/RestartFile.h"

namespace pendular::fuzz {

/// The content of an HDF5 file, which is edited and written again: bytes that are chosen at random change
/// the numbers and the sizes of its tables, and never the file format, which is the HDF5 library's affair.
class EditedState {
public:
    explicit EditedState(const std::filesystem::path& path) {
        const Hdf5File file(path, Hdf5File::Access::Read);
        for (const std::string& name : file.names()) {
            Table& table = tables[name];
            table.shape = file.shapeOf(name);
            if (table.shape) {
                table.bytes.resize(table.shape->rows * rowBytes(*table.shape));
                file.read(name, *table.shape, table.bytes.data());
            } else {
                table.bytes = file.readText(name);
            }
        }
    }

    /// Eight bytes name an edit: the table (2), what is done to it (1), where (4), with what (1); eight more
    /// are the number that some edits write.
    static constexpr std::size_t editBytes = 16;
    /// Seeds: no edit, and one of each kind for every so many-th table.
    static std::vector<std::string> eachEdit(int tableCount, int stride) {
        std::vector<std::string> seeds{""};
        for (int table = 0; table < tableCount; table += stride)
            for (const int what : {0, 64, 128, 160, 192, 240, 255}) {
                std::string edit(editBytes, '\1');
                edit[0] = static_cast<char>(table), edit[1] = 0, edit[2] = static_cast<char>(what);
                seeds.push_back(edit);
            }
        return seeds;
    }
    void edit(std::string_view bytes) {
        for (; bytes.size() >= editBytes; bytes.remove_prefix(editBytes)) {
            const auto number = [&]<class Number>(Number value, std::size_t at) {
                std::memcpy(&value, bytes.data() + at, sizeof value);
                return value;
            };
            const auto found =
                std::next(tables.begin(), number(std::uint16_t{}, 0) % static_cast<int>(tables.size()));
            apply(found->second, static_cast<unsigned char>(bytes[2]), number(std::uint32_t{}, 3),
                  static_cast<unsigned char>(bytes[7]), number(std::uint64_t{}, 8));
        }
    }

    /// A number of a table, of the k-th place.
    void setNumber(const std::string& name, std::size_t k, double number) {
        std::memcpy(tables.at(name).bytes.data() + k * sizeof number, &number, sizeof number);
    }

    /// Without a checksum: sealRestartFile() gives it.
    void write(const std::filesystem::path& path) const {
        Hdf5File file(path, Hdf5File::Access::Create);
        for (const auto& [name, table] : tables) {
            if (table.isGone) continue;
            if (table.shape) file.write(name, *table.shape, table.bytes.data());
            else file.write(name, table.bytes);
        }
        file.close();
    }

private:
    struct Table {
        std::optional<TableShape> shape;  // of a text: none
        std::string bytes;
        bool isGone = false;
    };

    static std::size_t width(NumberKind kind) {
        constexpr std::size_t widths[] = {8, 4, 8, 4, 4, 2, 1};
        return widths[static_cast<int>(kind)];
    }
    static std::size_t rowBytes(const TableShape& shape) { return shape.columns * width(shape.kind); }

    static void apply(Table& table, unsigned what, std::size_t where, unsigned with, std::uint64_t number) {
        if (what == 255) table.isGone = true;
        else if (!table.shape) editText(table.bytes, where, with);
        else if (what >= 192) resize(table, what, where);
        else editNumber(table, what, where, with, number);
    }
    static void editText(std::string& text, std::size_t where, unsigned with) {
        if (text.empty() || with < 64) text.resize(where % 4096, static_cast<char>(with));
        else text[where % text.size()] = static_cast<char>(with);
    }
    /// Fewer or more rows, or other columns for the same numbers.
    static void resize(Table& table, unsigned what, std::size_t where) {
        TableShape& shape = *table.shape;
        if (what >= 240 && shape.columns > 1) {
            shape.rows *= shape.columns;
            shape.columns = 1;
        } else {
            shape.rows = where % (2 * shape.rows + 2);
            table.bytes.resize(shape.rows * rowBytes(shape));
        }
    }
    static void editNumber(Table& table, unsigned what, std::size_t where, unsigned with,
                           std::uint64_t number) {
        if (table.bytes.empty()) return;
        const std::size_t size = width(table.shape->kind);
        char* const place = table.bytes.data() + where % (table.bytes.size() / size) * size;
        constexpr double infinite = std::numeric_limits<double>::infinity();
        constexpr double odd[] = {0,        -1,        1e-308, 1e308,
                                  infinite, -infinite, 1e12,   -1e12,
                                  1,        -0.0,      5e-324, std::numeric_limits<double>::quiet_NaN()};
        constexpr std::uint64_t whole[] = {
            0, 1, 7, 8, 0xff, 0xffff, 0x7fffffff, 0xffffffff, ~std::uint64_t{0}};
        if (what < 64) {
            std::memcpy(place, &number, size);
        } else if (what < 128) {
            place[with / 8 % size] = static_cast<char>(place[with / 8 % size] ^ (1 << with % 8));
        } else if (size == 8 && what < 160) {
            std::memcpy(place, &odd[with % std::size(odd)], size);
        } else {
            std::memcpy(place, &whole[with % std::size(whole)], size);
        }
    }

    std::map<std::string, Table> tables;
};

}  // namespace pendular::fuzz
