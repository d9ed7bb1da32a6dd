#include "Kernel/Analysis/Output/Hdf5Output.h"

#include "Kernel/Analysis/Output/FieldFile.h"

namespace pendular {

namespace {

PolyDataField positions(const std::string& name, const std::vector<Vector<double>>& points) {
    std::vector<double> numbers;
    numbers.reserve(3 * points.size());
    for (const Vector<double>& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    return {name, 3, std::move(numbers)};
}

/// The vector from the centre of particle1 to that of particle2 (its nearest image) or to the wall's surface.
PolyDataField branches(const PolyData& lines) {
    std::vector<float> numbers;
    numbers.reserve(3 * lines.ends.size());
    const auto point = [&](std::size_t k) {
        return lines.points[static_cast<std::size_t>(lines.corners[k])];
    };
    for (std::size_t k = 0; k < lines.ends.size(); ++k) {
        const Vector<double> branch = point(2 * k + 1) - point(2 * k);
        for (const double part : {branch.x, branch.y, branch.z}) numbers.push_back(static_cast<float>(part));
    }
    return {"branch_m", 3, std::move(numbers)};
}

}  // namespace

void Hdf5Frames::add(const SceneFrame& frame, int threads) {
    FieldFile file(series.fileOf(frame.step));
    file.attribute("/", "time_s", frame.time);
    file.attribute("/", "step", static_cast<double>(frame.step));
    const auto write = [&](const std::string& group, const std::vector<PolyDataField>& fields) {
        for (const PolyDataField& field : fields) file.column(group, field, threads);
    };
    write("particles", {positions("position_m", frame.grains.points)});
    write("particles", frame.grains.pointFields);
    if (frame.contacts) {
        write("contacts", {branches(*frame.contacts)});
        write("contacts", frame.contacts->cellFields);
    }
    if (frame.walls) {
        write("walls", {positions("corner_m", frame.walls->points), {"end", 1, frame.walls->ends}});
        write("walls", frame.walls->cellFields);
    }
    if (frame.droplets) {
        write("droplets", {positions("position_m", frame.droplets->points)});
        write("droplets", frame.droplets->pointFields);
    }
    file.close();
    series.add(frame.step, frame.time);
}

}  // namespace pendular
