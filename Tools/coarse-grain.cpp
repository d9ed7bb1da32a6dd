/// Makes fields at points out of the frames of a run: density, velocity, stress, ...

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Output/BoxFields.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"

using namespace pendular;

namespace {

constexpr std::string_view program = "coarse-grain";

struct Options {
    std::string frames, coordinates = "Z", kernel = "gauss", image;
    double width = unset, cutOff = 0;
    std::optional<double> spacing;
    double from = -infinity, to = infinity;
    std::vector<double> box, periodic, sizes, plateau;
    std::size_t species = 0;
    bool eachFrame = false, withoutContacts = false, againstFlow = false;
    int threads = 1;
};

/// The files of grains of a series, between two times, each with its contacts.
struct FrameFiles {
    double time;  // s
    std::filesystem::path grains, contacts;
};

std::vector<FrameFiles> framesOf(const Options& o) {
    std::vector<FrameFiles> frames;
    const std::vector<ParaViewEntry> entries = readParaViewSeries(o.frames);
    for (const ParaViewEntry& entry : entries) {
        if (entry.kind != "particles" || entry.time < o.from || entry.time > o.to) continue;
        FrameFiles frame{entry.time, entry.file, {}};
        for (const ParaViewEntry& other : entries)
            if (other.kind == "contacts" && other.time == entry.time) frame.contacts = other.file;
        frames.push_back(frame);
    }
    if (frames.empty())
        throw InputError(fmt::format("{}: {} has no frame of grains from {:g} s to {:g} s.", program,
                                     o.frames, o.from, o.to));
    return frames;
}

/// The periods that were given, or those of a frame.
PeriodicBox periodicOf(const Options& o, const PolyData& frame) {
    const PeriodicBox own = boxOf(frame).value_or(PeriodicBox{});
    if (o.periodic.empty()) return own;
    if (own.imagesMove)
        throw InputError(
            fmt::format("{}: the frames have periods whose images move, and --periodic-m would put them to "
                        "rest; leave it out.",
                        program));
    for (const double length : o.periodic) checkValue(program, "period", length, "m", notNegative);
    PeriodicBox box;
    box.length = {o.periodic[0], o.periodic[1], o.periodic[2]};
    return box;
}

GrainState read(const FrameFiles& frame, const Options& o) {
    const PolyData grains = readPolyData(frame.grains);
    const bool hasContacts = !frame.contacts.empty() && !o.withoutContacts;
    GrainState state =
        stateOf(grains, hasContacts ? readPolyData(frame.contacts) : PolyData{}, periodicOf(o, grains));
    if (!o.againstFlow) return state;
    if (!state.periodic.imagesMove)
        throw InputError(fmt::format(
            "{}: the frames know of no flow (shear or strain); leave --against-flow out.", program));
    takeFlowAway(state);
    return state;
}

FieldContent contentOf(const Options& o) {
    return o.withoutContacts ? FieldContent::WithoutContacts : FieldContent::All;
}

/// The box that was given, or the one around all grains of a state, and the periods that its frame has.
std::array<Vector<double>, 2> boxOf(const Options& o, const GrainState& state) {
    if (!o.box.empty())
        return {Vector<double>{o.box[0], o.box[2], o.box[4]}, Vector<double>{o.box[1], o.box[3], o.box[5]}};
    Vector<double> low{infinity, infinity, infinity}, high = -low;
    for (const GrainState::Grain& g : state.grains) {
        const Vector<double>& p = g.position;
        low = {std::min(low.x, p.x - g.radius), std::min(low.y, p.y - g.radius),
               std::min(low.z, p.z - g.radius)};
        high = {std::max(high.x, p.x + g.radius), std::max(high.y, p.y + g.radius),
                std::max(high.z, p.z + g.radius)};
    }
    if (!o.periodic.empty()) return {low, high};
    const PeriodicBox& box = state.periodic;
    for (double Vector<double>::*axis : {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z})
        if (box.length.*axis > 0) low.*axis = box.lowest.*axis, high.*axis = low.*axis + box.length.*axis;
    return {low, high};
}

GrainGroups groupsOf(const Options& o) {
    if (o.species > 0 && !o.sizes.empty())
        throw InputError(fmt::format("{}: give either --by-species or --by-size-m.", program));
    if (o.species > 0) {
        checkValue(program, "number of species", static_cast<double>(o.species), "", {1, 1000});
        return GrainGroups::bySpecies(o.species);
    }
    return o.sizes.empty() ? GrainGroups::none() : GrainGroups::bySize(o.sizes);
}

void printRows(const FieldSums& sums, double time) {
    forEachRow(sums, time, [](const std::string& row) { fmt::print("{}\n", row); });
}

/// Fields of all frames together, or of each.
void average(const Options& o, const std::vector<FrameFiles>& frames, const FieldGrid& grid) {
    FieldSums sums(grid, SmoothingKernel(kernelShapeNamed(o.kernel), grid.dimensions(), o.width, o.cutOff),
                   groupsOf(o), contentOf(o));
    std::optional<ParaViewSeries> series;
    if (!o.image.empty()) series.emplace(o.image, -infinity, ".vti");
    else fmt::print("{}\n", headerOf(sums));
    const auto finish = [&](double time, std::size_t number) {
        if (!series) return printRows(sums, time);
        writeImage(series->add("fields", time, number), sums, time, o.threads);
        series->write();
    };
    for (std::size_t k = 0; k < frames.size(); ++k) {
        if (o.eachFrame) sums.clear();
        sums.add(read(frames[k], o), o.threads);
        if (o.eachFrame) finish(frames[k].time, k);
    }
    if (!o.eachFrame) finish(0.5 * (frames.front().time + frames.back().time), 0);
}

/// The fields in the middle of the box over the width of the kernel, from all frames: where they hardly
/// change there is a plateau.
void printPlateau(const Options& o, const std::vector<FrameFiles>& frames, const Vector<double>& low,
                  const Vector<double>& high) {
    std::vector<GrainState> states;
    for (const FrameFiles& frame : frames) states.push_back(read(frame, o));
    checkValue(program, "smallest width", o.plateau[0], "m", positive);
    checkValue(program, "largest width", o.plateau[1], "m", {o.plateau[0], infinity, false, false});
    constexpr int widths = 41;
    for (int k = 0; k < widths; ++k) {
        const double width = o.plateau[0] * std::pow(o.plateau[1] / o.plateau[0], k / (widths - 1.0));
        // One cell as large as the box: its point is the middle.
        const FieldGrid point(o.coordinates, low, high, 1e9);
        FieldSums sums(point,
                       SmoothingKernel(kernelShapeNamed(o.kernel), point.dimensions(), width,
                                       o.cutOff > 0 ? o.cutOff / o.width * width : 0),
                       groupsOf(o), contentOf(o));
        for (const GrainState& state : states) sums.add(state, o.threads);
        if (k == 0) fmt::print("width_m,{}\n", headerOf(sums));
        forEachRow(sums, 0.5 * (frames.front().time + frames.back().time),
                   [&](const std::string& row) { fmt::print("{},{}\n", width, row); });
    }
}

int run(const Options& o) {
    checkValue(program, "number of threads", o.threads, "", {1, 4096});
    if (!(o.from <= o.to))
        throw InputError(fmt::format("{}: the times go from {:g} s to {:g} s; they must be in order.",
                                     program, o.from, o.to));
    if (o.plateau.empty() || o.cutOff > 0) checkValue(program, "width", o.width, "m", positive);
    const std::vector<FrameFiles> frames = framesOf(o);
    const GrainState first = read(frames.front(), o);
    if (first.grains.empty() && o.box.empty())
        throw InputError(fmt::format("{}: the first frame has no grains; give a --box-m.", program));
    const auto [low, high] = boxOf(o, first);
    if (!o.plateau.empty()) printPlateau(o, frames, low, high);
    else average(o, frames, FieldGrid(o.coordinates, low, high, o.spacing.value_or(o.width)));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Fields from the grains and contacts of frames for ParaView (with contacts, best with doubles): "
        "density, velocity, granular temperature, stress, traction, fabric, liquid; as CSV, or for "
        "ParaView.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("frames", o.frames, "series of frames, NAME.pvd")->required();
    app.add_option("--coordinates", o.coordinates,
                   "directions that are resolved: O (none), X, Y, Z, XY, XZ, YZ, XYZ, R, RZ; fields are "
                   "averaged over the others");
    app.add_option("--kernel", o.kernel, "gauss, lucy or heaviside");
    app.add_option("--width-m", o.width, "width of the kernel, m");
    app.add_option("--cut-off-m", o.cutOff,
                   "distance at which the kernel ends, m; 0: 3 widths (gauss), 2 (lucy), 1 (heaviside)");
    app.add_option("--spacing-m", o.spacing, "distance between points, m; the width if it is not given");
    app.add_option("--box-m", o.box,
                   "x from, x to, y from, y to, z from, z to, m; that of the grains if not given")
        ->expected(6);
    app.add_option("--periodic-m", o.periodic,
                   "periods along x, y, z, m; 0: none; those that the frames have, with shear and strain, if "
                   "not given")
        ->expected(3);
    app.add_option("--from-s", o.from, "first time of frames, s");
    app.add_option("--to-s", o.to, "last time of frames, s");
    app.add_flag("--each-frame", o.eachFrame, "fields of each frame, not the average over all");
    app.add_flag(
        "--without-contacts", o.withoutContacts,
        "only fields of the grains themselves: no stress of contacts, traction, fabric, coordination "
        "and liquid");
    app.add_flag("--against-flow", o.againstFlow,
                 "velocities against the flow of a shear or a strain that the frames know");
    app.add_option("--by-species", o.species, "fields of so many species as well, each for itself");
    app.add_option("--by-size-m", o.sizes, "fields of grains between these diameters (m) as well")
        ->expected(1, 100);
    app.add_option("--image", o.image, "write NAME.pvd for ParaView, not CSV");
    app.add_option("--plateau-m", o.plateau,
                   "smallest and largest width, m: the fields in the middle of the box over the width")
        ->expected(2);
    app.add_option("--threads", o.threads, "threads");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
