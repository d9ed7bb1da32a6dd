#include "Kernel/Output/ParaViewOutput.h"

#include <utility>

#include "Kernel/Output/FrameParts.h"

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
    if (frame.walls) {
        frame.walls->time = frame.time;
        writePolyData(series.add("walls", frame.time, frame.step), *frame.walls, threads);
    }
    series.write();
}

}  // namespace pendular
