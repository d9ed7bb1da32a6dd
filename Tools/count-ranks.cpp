/// Counts what each of several ranks would have of the grains in a restart file, before anybody waits for a
/// queue: own grains, ghosts, neighbours, bytes.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/DomainDecomposition/Bisection.h"
#include "Kernel/Features/DomainDecomposition/GrainExtents.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Concepts/Field.h"

using namespace pendular;

namespace {

struct Options {
    std::string file;
    std::vector<std::size_t> ranks{1, 2, 4, 8, 16, 32, 64, 128};
    std::vector<double> grains;  // of larger scenes; none: only the one in the file
    double skin = 0.1;           // of the smallest radius
    double rate = 1e7;           // grains and ghosts x steps / s
    double latency = 2e-6;       // s, of a message
    double bandwidth = 10e9;     // byte/s
};

struct Scene {
    std::vector<TranslationRecord> grains;
    PeriodicBox box;
    bool hasSpin = false;
};

template <class Row>
std::vector<Row> tableOf(const Hdf5File& file, const std::string& name) {
    const auto shape = file.shapeOf(name);
    std::vector<Row> rows(shape ? shape->rows : 0);
    if (!shape || shape->kind != NumberKind::Float64 || shape->columns * sizeof(double) != sizeof(Row))
        throw InputError(fmt::format("The restart file {} has no table {} of the expected form.",
                                     file.path().string(), name));
    file.read(name, *shape, rows.data());
    return rows;
}

Scene read(const std::string& path) {
    requireRestartFiles();
    checkRestartFile(path);
    const Hdf5File file(path, Hdf5File::Access::Read);
    Scene scene{tableOf<TranslationRecord>(file, "particles/translation"),
                {},
                file.shapeOf("particles/rotation")->rows > 0};
    const auto along = [&](const std::string& group) {
        return Vector<double>{tableOf<double>(file, group + "/x").at(0),
                              tableOf<double>(file, group + "/y").at(0),
                              tableOf<double>(file, group + "/z").at(0)};
    };
    scene.box.lowest = along("periodicLowest");
    scene.box.length = along("periodicLength");
    return scene;
}

/// Of all ranks.
struct Counts {
    double meanOwn = 0, mostOwn = 0, meanGhosts = 0, mostGhosts = 0, meanNeighbours = 0, mostNeighbours = 0;
};

Counts count(const Scene& scene, std::size_t ranks, double skin) {
    const auto positionOf = [&](const TranslationRecord& grain) { return scene.box.wrap(grain.position); };
    std::vector<Bisection::Point> points;
    double largest = 0, smallest = infinity;
    for (const TranslationRecord& grain : scene.grains) {
        points.push_back({positionOf(grain), 1});
        largest = std::max(largest, grain.radius);
        smallest = std::min(smallest, grain.radius);
    }
    Bisection cuts;
    cuts.cut(std::move(points), std::vector<double>(ranks, 1));
    const double reach = skin * smallest;  // m
    std::vector<GrainExtents> extents(ranks);
    std::vector<double> own(ranks), ghosts(ranks), neighbours(ranks);
    for (const TranslationRecord& grain : scene.grains) {
        const std::size_t owner = cuts.ownerOf(positionOf(grain));
        ++own[owner];
        extents[owner].add(positionOf(grain), grain.radius, largest);
    }
    const std::vector<Vector<double>> images = imageOffsets(scene.box);
    std::vector<std::set<std::size_t>> partners(ranks);
    for (const TranslationRecord& grain : scene.grains) {
        const std::size_t owner = cuts.ownerOf(positionOf(grain));
        std::set<std::size_t> wanting;
        for (const Vector<double>& offset : images) {
            const Vector<double> image = positionOf(grain) + offset;
            cuts.forEachNear(image, (grain.radius + largest + reach) * (1 + 1e-9), [&](std::size_t rank) {
                if (rank != owner && extents[rank].areNear(image, grain.radius, reach)) wanting.insert(rank);
            });
        }
        for (const std::size_t rank : wanting) {
            ++ghosts[rank];
            partners[rank].insert(owner), partners[owner].insert(rank);
        }
    }
    for (std::size_t q = 0; q < ranks; ++q) neighbours[q] = static_cast<double>(partners[q].size());
    const auto mean = [&](const std::vector<double>& of) {
        return std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(ranks);
    };
    return {mean(own),        std::ranges::max(own),       mean(ghosts), std::ranges::max(ghosts),
            mean(neighbours), std::ranges::max(neighbours)};
}

/// Of a scene with more grains, alike all over, that grows in all directions, where a rank has so many of its
/// own: as many ranks as give each so many are counted in this scene; where it has too few grains for that,
/// ghosts grow as the surface of a part.
Counts onPaper(const Scene& scene, double own, double skin) {
    constexpr double enough = 27;  // ranks, so that the part of one lies between those of others
    const auto all = static_cast<double>(scene.grains.size());
    const double ranks = std::clamp(std::round(all / own), enough, std::max(enough, all));
    Counts found = count(scene, static_cast<std::size_t>(ranks), skin);
    const double ratio = own / found.meanOwn, ofSurface = std::cbrt(ratio * ratio);
    for (double* const number : {&found.meanOwn, &found.mostOwn}) *number *= ratio;
    for (double* const number : {&found.meanGhosts, &found.mostGhosts}) *number *= ofSurface;
    return found;
}

/// s, of a step: the work of the fullest rank, its messages, and a reduction over all ranks. A model, not a
/// measurement: it knows no walls, lists or outputs.
double modelOfStep(const Options& o, const Counts& found, std::size_t ranks, double bytesOfGhost) {
    const double work = (found.mostOwn + found.mostGhosts) / o.rate;
    if (ranks == 1) return work;
    return work + found.mostNeighbours * o.latency + bytesOfGhost * found.mostGhosts / o.bandwidth +
           2 * std::ceil(std::log2(static_cast<double>(ranks))) * o.latency;
}

void run(const Options& o) {
    checkValue("count-ranks", "skin", o.skin, "of the smallest radius", notNegative);
    checkValue("count-ranks", "rate", o.rate, "1/s", positive);
    checkValue("count-ranks", "latency", o.latency, "s", notNegative);
    checkValue("count-ranks", "bandwidth", o.bandwidth, "byte/s", positive);
    for (const std::size_t ranks : o.ranks)
        checkValue("count-ranks", "number of ranks", static_cast<double>(ranks), "", {1, 1e6});
    const Scene scene = read(o.file);
    const auto inFile = static_cast<double>(scene.grains.size());
    for (const double grains : o.grains)
        checkValue("count-ranks", "number of grains", grains, "", {inFile, 1e12});
    const double bytes = scene.hasSpin ? 72 : 48;
    fmt::print(
        "grains,ranks,own_mean,own_largest_over_mean,ghosts_mean,ghosts_largest,neighbours_mean,"
        "neighbours_largest,bytes_sent_a_step_mean,model_step_s,model_speed_up\n");
    const auto row = [&](double grains, std::size_t ranks, const Counts& found) {
        const double step = modelOfStep(o, found, ranks, bytes);
        fmt::print("{:.6g},{},{:.6g},{:.4g},{:.6g},{:.6g},{:.4g},{:.6g},{:.6g},{:.4g},{:.4g}\n", grains,
                   ranks, found.meanOwn, found.mostOwn / found.meanOwn, found.meanGhosts, found.mostGhosts,
                   found.meanNeighbours, found.mostNeighbours, bytes * found.meanGhosts, step,
                   grains / o.rate / step);
    };
    if (o.grains.empty())
        for (const std::size_t ranks : o.ranks) row(inFile, ranks, count(scene, ranks, o.skin));
    for (const double grains : o.grains)
        for (const std::size_t ranks : o.ranks)
            row(grains, ranks, onPaper(scene, grains / static_cast<double>(ranks), o.skin));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Counts what each of several ranks would have of the grains in a restart file, one row of CSV for "
        "each\n"
        "number of ranks, and gives a model of the time of a step: the work of the fullest rank, its "
        "messages and\n"
        "a reduction. It is a model, with numbers of a machine that you give it.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("file", o.file, "the restart file")->required();
    app.add_option("--ranks", o.ranks, "numbers of ranks");
    app.add_option("--grains", o.grains,
                   "numbers of grains of larger scenes that are as this one all over: on paper");
    app.add_option("--skin", o.skin, "gap up to which contacts are listed, over the smallest radius");
    app.add_option("--rate-1/s", o.rate, "grains x steps that one rank does, with its threads, 1/s");
    app.add_option("--latency-s", o.latency, "time of a message without content, s");
    app.add_option("--bandwidth-byte/s", o.bandwidth, "of a rank, byte/s");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        run(o);
        return 0;
    });
}
