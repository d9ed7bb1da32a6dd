#include "Kernel/Output/RunTable.h"

#include <cstdlib>
#include <fstream>

namespace pendular {

std::uintmax_t bytesBefore(const std::filesystem::path& table, std::string_view header, double time) {
    std::filesystem::path file = table.string() + ".part";
    if (!std::filesystem::exists(file)) file = table;
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    if (!std::getline(stream, line) || line != header || stream.eof()) return 0;
    std::uintmax_t bytes = line.size() + 1;
    // A last line without an end was cut off.
    while (std::getline(stream, line) && !stream.eof() && std::strtod(line.c_str(), nullptr) < time)
        bytes += line.size() + 1;
    return bytes;
}

void RunTable::goOnFrom(double time) { goOnAfter(bytesBefore(place, columns, time)); }

}  // namespace pendular
