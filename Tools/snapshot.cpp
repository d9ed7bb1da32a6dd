/// Draws the state of a run: shaded spheres, bridges, transparent walls, a legend. Rendered by POV-Ray,
/// without a display.

#include <cstdlib>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/Snapshot/Compose.h"
#include "Tools/Snapshot/Render.h"

using namespace pendular;
using namespace pendular::snapshot;

namespace {

struct Options {
    std::string input;
    std::string output = "snapshot.png";
    View view;
    double time = -1;  // s; negative: the last frame of a series
    bool all = false;
    bool sceneOnly = false;
};

void describe(CLI::App& app, Options& o) {
    app.option_defaults()->always_capture_default();
    app.add_option("input", o.input,
                   "NAME.pvd, NAME-particles-STEP.vtp, or, of grains only, NAME-restart.h5 or "
                   "NAME-last-state.csv, which a run writes when it ends with an error")
        ->required();
    app.add_option("--output", o.output, "the picture, PNG; with --all, frames get numbers: NAME-0000.png");
    app.add_option(
        "--field", o.view.field,
        "field that colours the grains; of a vector its length, or a part: velocity_m_per_s.z; none: "
        "one colour");
    app.add_option("--range", o.view.range,
                   "values at the ends of the colours; if not given, the smallest and the largest that occur")
        ->expected(2);
    app.add_option("--colours", o.view.map, "viridis, coolwarm or grey");
    app.add_option("--contacts", o.view.contacts,
                   "none; bridges: liquid as cylinders of its volume; forces: rods instead of grains")
        ->check(CLI::IsMember({"none", "bridges", "forces"}));
    app.add_option("--view", o.view.from, "direction from the scene to the eye, x y z; z is up")->expected(3);
    app.add_option("--box-m", o.view.box, "shows grains with centres in x0 x1 y0 y1 z0 z1 only, m")
        ->expected(6);
    app.add_option("--wall-transparency", o.view.wallTransparency, "from 0 to 1; 1: no walls");
    app.add_option("--caption", o.view.caption, "text in the corner; time: that of the frame");
    app.add_flag("!--no-legend", o.view.legend, "no legend");
    app.add_option("--width", o.view.width, "of the picture, pixels");
    app.add_option("--height", o.view.height, "of the picture, pixels");
    auto* time =
        app.add_option("--time-s", o.time, "the frame nearest to this time, s; the last one if negative");
    app.add_flag("--all", o.all, "all frames of a series, with one view and one range of colours")
        ->excludes(time);
    app.add_flag("--scene-only", o.sceneOnly, "writes what POV-Ray reads (.pov), and does not run it");
}

void check(const Options& o) {
    checkValue("snapshot", "width", o.view.width, "pixels", {16, 16384});
    checkValue("snapshot", "height", o.view.height, "pixels", {16, 16384});
    checkValue("snapshot", "wall transparency", o.view.wallTransparency, "", fromZeroTo(1));
    const Vector<double> from{o.view.from[0], o.view.from[1], o.view.from[2]};
    checkValue("snapshot", "length of the view's direction", norm(from), "", positive);
    mapOf(o.view);
    for (std::size_t k = 0; k < o.view.box.size(); k += 2)
        checkValue("snapshot", "length of a side of the box", o.view.box[k + 1] - o.view.box[k], "m",
                   positive);
    if (!o.view.range.empty())
        checkValue("snapshot", "width of the range", o.view.range[1] - o.view.range[0], "", positive);
}

/// The files to draw.
std::vector<std::filesystem::path> chosenFrames(const Options& o) {
    std::vector<std::filesystem::path> frames = framesOf(o.input);
    if (o.all || frames.size() == 1) return frames;
    if (o.time < 0) return {frames.back()};
    std::vector<ParaViewEntry> entries = readParaViewSeries(o.input);
    std::erase_if(entries, [](const ParaViewEntry& entry) { return entry.kind != "particles"; });
    return {
        std::min_element(entries.begin(), entries.end(), [&](const ParaViewEntry& a, const ParaViewEntry& b) {
            return std::abs(a.time - o.time) < std::abs(b.time - o.time);
        })->file};
}

int run(const Options& o) {
    check(o);
    requireFileName("snapshot --output", o.output);
    const std::vector<std::filesystem::path> files = chosenFrames(o);
    Span span;
    std::vector<Vector<double>> points;
    const double aspect = static_cast<double>(o.view.width) / o.view.height;
    double share = 0;  // of the picture's width, of the widest legend
    const auto makeRoom = [&](const Picture& picture) {
        if (picture.legend) share = std::max(share, placeOf(*picture.legend, aspect).strip / (2 * aspect));
    };
    // Once through all frames for what they share, and once more to draw them.
    for (const std::filesystem::path& file : files) {
        const Frame frame = readAny(file);
        for (const double value : shownScalar(frame, o.view).values) span.take(value);
        const Picture picture = compose(frame, o.view, span);
        if (picture.legend && !picture.legend->map)
            makeRoom(picture);  // all frames have one bar, but other names
        const std::vector<Vector<double>> seen = outline(picture);
        points.insert(points.end(), seen.begin(), seen.end());
    }
    if (points.empty()) throw InputError(fmt::format("snapshot: nothing of {} is to be seen.", o.input));
    if (!o.view.range.empty()) span = {o.view.range[0], o.view.range[1]};
    double size = 0;
    for (const Vector<double>& p : points) size = std::max(size, norm(p - points.front()));
    const Vector<double> from{o.view.from[0], o.view.from[1], o.view.from[2]};
    for (std::size_t k = 0; k < files.size(); ++k) {
        Picture picture = compose(readAny(files[k]), o.view, span);
        makeRoom(picture);
        const Camera camera = cameraOn(points, from, o.view.width, o.view.height, share);
        picture.size = size;
        picture.wallEdges = sharpEdges(picture.walls, size);
        std::filesystem::path target = o.output;
        if (o.all)
            target.replace_filename(
                fmt::format("{}-{:04}{}", target.stem().string(), k, target.extension().string()));
        const auto written = draw(picture, camera, target, o.view.width, o.view.height, o.sceneOnly);
        fmt::print("wrote {}\n", written.string());
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Draws grains as shaded spheres coloured by a field, with liquid bridges, transparent walls and a "
        "legend.\n"
        "Walls and bridges of a restart file: go on from it to the same end time with --resume\n"
        "--paraview-interval-s 1, which writes its state as NAME.pvd.\n"
        "A film of a series: snapshot NAME.pvd --all --caption time --output film/frame.png, then\n"
        "ffmpeg -i film/frame-%04d.png film.mp4");
    Options options;
    describe(app, options);
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(options); });
}
