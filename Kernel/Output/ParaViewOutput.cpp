#include "Kernel/Output/ParaViewOutput.h"

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

}  // namespace pendular
