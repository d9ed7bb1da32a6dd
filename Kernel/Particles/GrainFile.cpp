#include "Kernel/Particles/GrainFile.h"

#include "Kernel/Files/CsvFile.h"
#include "Kernel/Files/TextFile.h"

namespace pendular {

std::vector<GrainRow> readGrainFile(const std::filesystem::path& path) {
    const InputFile file = loadInputFile("grain file", path);
    std::vector<GrainRow> grains;
    forEachRow(file, 1, [&](std::size_t line, const std::vector<double>& row) {
        if (row.size() != 4 && row.size() != 6)
            file.refuse("line", line,
                        fmt::format("{} numbers; a grain has 4, radius x y z in m", row.size()));
        if (row.size() == 6 && row[1] != row[2])
            file.refuse("line", line,
                        fmt::format("the radius {} m and the contact radius {} m differ", row[1], row[2]));
        const double radius = row.size() == 6 ? row[1] : row[0];
        if (!radiusRange.contains(radius))
            file.refuse("line", line,
                        fmt::format("the radius {} m must be {}", radius, radiusRange.text("m")));
        grains.push_back({radius, Vec3D(row[row.size() - 3], row[row.size() - 2], row[row.size() - 1])});
    });
    if (grains.empty()) file.refuse("holds no grains");
    return grains;
}

void writeGrainFile(const std::filesystem::path& path, const std::vector<GrainRow>& grains) {
    CsvFile file(path, "radius_m x_m y_m z_m");
    for (const GrainRow& g : grains)
        file.line(fmt::format("{} {} {} {}", g.radius, g.position.x(), g.position.y(), g.position.z()));
    file.close();
}

}  // namespace pendular
