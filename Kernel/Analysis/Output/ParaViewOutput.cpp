#include "Kernel/Analysis/Output/ParaViewOutput.h"

#include <optional>
#include <utility>

#include "Kernel/Analysis/Output/FrameParts.h"

namespace pendular {

void ParaViewFrames::add(SceneFrame frame, int threads) {
    const auto write = [&](std::string_view kind, PolyData& data) {
        data.time = frame.time;
        writePolyData(series.add(kind, frame.time, frame.step), data, threads);
    };
    write("particles", frame.grains);
    if (frame.contacts) write("contacts", *frame.contacts);
    if (frame.walls) write("walls", *frame.walls);
    if (frame.shapes) write("shapes", *frame.shapes);
    if (frame.droplets) write("droplets", *frame.droplets);
    series.write();
}

void ParaViewFrames::addPart(SceneFrame frame, int threads, const AllRanks& ranks) {
    std::vector<FramePart> parts;
    const auto part = [&](std::string_view kind, PolyData& data) {
        data.time = frame.time;
        parts.push_back({series.addParted(kind, frame.time, frame.step), std::move(data)});
    };
    part("particles", frame.grains);
    if (frame.contacts) part("contacts", *frame.contacts);
    if (frame.shapes) part("shapes", *frame.shapes);
    writeInParts(parts, threads, ranks);
    if (!ranks.isFirst()) return;
    const auto whole = [&](std::string_view kind, std::optional<PolyData>& data) {  // all ranks have it
        if (!data) return;
        data->time = frame.time;
        writePolyData(series.add(kind, frame.time, frame.step), *data, threads);
    };
    whole("walls", frame.walls);
    whole("droplets", frame.droplets);
    series.write();
}

}  // namespace pendular
