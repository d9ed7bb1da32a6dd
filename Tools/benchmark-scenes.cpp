/// Measures how fast a scene runs, and prints one row of CSV.

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <deque>

#include "Drivers/Shared/BenchmarkScenes.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/StateHash.h"
#include "Tools/Studies/BulkComparison/FlowScene.h"

using namespace pendular;

namespace {

struct Options {
    scenes::BenchmarkChoice choice;
    int threads = 1;
    std::size_t steps = 2000, warm = 500;
    std::size_t exchange = 0;  // grains that come and go in a step
    bool header = false;
    bool grains = false;    // print these instead
    bool ranks = false;     // print what they did
    double wander = 0;      // share of the grains that go to another rank at each list
    std::string paraView;   // beginning of the names of frames; empty: none
    std::string peerFiles;  // folder for a flow's files for other codes, instead of a run; empty: none
};

/// Bytes of memory that this process has taken at most so far.
double peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Says what share of 1000 steps a frame for ParaView takes: the fastest of five.
/// @param stepTime s
void measureFrames(Scene& scene, double stepTime) {
    for (const bool withContacts : {false, true}) {
        double fastest = infinity;
        for (int k = 0; k < 5; ++k) {
            ParaViewOutput output;  // each writes the moment once
            output.withContacts(withContacts);
            const auto start = std::chrono::steady_clock::now();
            output.write(scene);
            const auto time = std::chrono::steady_clock::now() - start;
            fastest = std::min(fastest, std::chrono::duration<double>(time).count());
        }
        fmt::print(stderr, "a frame {} contacts: {:.3g} s, {:.2g} % of 1000 steps\n",
                   withContacts ? "with" : "without", fastest, 0.1 * fastest / stepTime);
    }
}

/// A steady flow of grains: in each step some are put above the scene, at rest, and as many that were put
/// there fifty steps ago are removed.
class GrainFlow {
public:
    GrainFlow(Scene& changed, std::size_t count) : scene(changed), perStep(count) {
        if (count == 0) return;
        Vec3D lowest = Vec3D::Constant(infinity), highest = -lowest;
        for (GrainReference grain : scene.particleHandler) {
            lowest = lowest.cwiseMin(grain.getPosition());
            highest = highest.cwiseMax(grain.getPosition());
            radius = std::max(radius, grain.getRadius());
        }
        start = {lowest.x() + radius, lowest.y() + radius, highest.z() + 3 * radius};
        width = std::max<std::size_t>(1, static_cast<std::size_t>((highest.x() - lowest.x()) / (3 * radius)));
    }
    void operator()() {
        if (perStep == 0) return;
        const auto begin = std::chrono::steady_clock::now();
        for (std::size_t k = 0; k < perStep; ++k) {
            if (alive.size() == stay * perStep) {
                scene.particleHandler.removeObject(alive.front());
                alive.pop_front();
            }
            const std::size_t place = added % (2 * stay * perStep);
            const auto at = static_cast<double>(place % width), row = static_cast<double>(place / width);
            SphericalParticle grain;
            const FirstSpecies first{scene.laws().owner()};
            grain.setSpecies(&first);
            grain.setRadius(radius);
            grain.setPosition(start + 3 * radius * Vec3D(at, 0, row));
            alive.push_back(scene.particleHandler.copyAndAddObject(grain).getId());
            ++added;
        }
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    void report(double all) const {
        if (perStep == 0) return;
        fmt::print(stderr,
                   "{} grains came and {} went: {:.3g} us each, {:.2g} % of the time without what the "
                   "step does with them\n",
                   added, added - alive.size(), 0.5e6 * seconds / static_cast<double>(added),
                   100 * seconds / all);
    }

private:
    static constexpr std::size_t stay = 50;  // steps
    /// The first species of the scene, whatever its type.
    struct FirstSpecies {
        const SpeciesOwner* owner;
        [[nodiscard]] int getIndex() const { return 0; }
        [[nodiscard]] const SpeciesOwner* getOwner() const { return owner; }
    };
    Scene& scene;
    std::size_t perStep, added = 0, width = 1;
    double radius = 0, seconds = 0;  // m, s
    Vec3D start = Vec3D::Zero();     // m
    std::deque<std::uint32_t> alive;
};

/// What ranks do in the timed steps.
class RanksAtWork {
public:
    explicit RanksAtWork(Scene& shared) : scene(shared), ranks(ranksOfProgram()) {}

    static constexpr std::string_view columns =
        ",ranks,processor_seconds_of_all,largest_work_over_mean,waiting_over_steps,lists,list_s,cuts,cut_s,"
        "migrated_a_list_over_grains,ghosts_of_rank,asked_of_rank,bytes_a_step_of_rank";

    void share(double wander) {
        if (ranks) scene.setRanks(*ranks, {.cutsWander = wander > 0, .wanderBy = wander});
    }
    void begin() { before = now(); }
    void end() { after = now(); }

    void print() const {
        const auto over = [](double value, double by) { return by > 0 ? value / by : 0; };
        double cuts = 0, migrated = 0, ghosts = 0, asked = 0;                              // of all ranks
        double cutting = 0, listing = 0, working = 0, waiting = 0, most = 0, seconds = 0;  // s
        for (std::size_t q = 0; q < after.size(); ++q) {
            const RankCounts &first = before[q].counts, &last = after[q].counts;
            cuts += static_cast<double>(last.cuts - first.cuts);
            migrated += static_cast<double>(last.migrated - first.migrated);
            // Of all lists: a bed at rest is listed once.
            const auto allLists = static_cast<double>(last.lists);
            ghosts += over(static_cast<double>(last.ghosts), allLists);
            asked += over(static_cast<double>(last.asked), allLists);
            cutting += last.cutting - first.cutting, listing += last.listing - first.listing;
            working += last.working - first.working, waiting += last.waiting - first.waiting;
            most = std::max(most, last.working - first.working);
            seconds += after[q].processor - before[q].processor;
        }
        const auto& grains = scene.particleHandler.store();
        const auto count = static_cast<double>(after.size());
        const std::size_t lists = after[0].counts.lists - before[0].counts.lists;  // of each rank
        fmt::print(",{},{:.6g},{:.4f},{:.4f},{},{:.4g},{},{:.4g},{:.4g},{:.1f},{:.1f},{:.0f}", after.size(),
                   seconds, over(most * count, working), over(waiting, working + waiting), lists,
                   over(listing / count, static_cast<double>(lists)), cuts / count, over(cutting, cuts),
                   over(migrated / static_cast<double>(grains.size()), static_cast<double>(lists)),
                   over(ghosts, count), over(asked, count), over(ghosts, count) * (grains.hasSpin ? 72 : 48));
    }

private:
    struct OfRank {
        RankCounts counts;
        double processor;  // s
    };
    [[nodiscard]] std::vector<OfRank> now() const {
        const OfRank own{scene.rankCounts(), processorTime()};
        return ranks ? ranks->ofAll(own) : std::vector{own};
    }

    Scene& scene;
    ProcessRanks* ranks;
    std::vector<OfRank> before, after;
};

void measure(Scene& scene, const Options& options, double memoryBefore) {
    scene.setNumberOfThreads(options.threads);
    if (!options.paraView.empty()) scene.setName(options.paraView);
    RanksAtWork ranks(scene);
    ranks.share(options.wander);
    scene.initialise();
    scene.step(options.warm);
    ranks.begin();
    const std::size_t rebuildsBefore = scene.contacts().rebuildCount(),
                      grainsBefore = scene.particleHandler.getSize();
    GrainFlow flow(scene, options.exchange);
    const double processorBefore = processorTime();
    const auto start = std::chrono::steady_clock::now();
    if (options.exchange == 0) scene.step(options.steps);
    else
        for (std::size_t k = 0; k < options.steps; ++k) {
            flow();
            scene.step();
        }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double processorSeconds = processorTime() - processorBefore;
    ranks.end();
    flow.report(seconds);
    scene.gather();

    const auto& grains = scene.particleHandler.store();
    const auto count = static_cast<double>(grains.count());
    // Of a hopper some have left.
    const double meanCount = 0.5 * (static_cast<double>(grainsBefore) + count);
    std::size_t listed = 0;
    scene.contacts().forEachListed([&](const Bucket&, std::uint32_t) { ++listed; });
    const std::size_t touching = scene.contacts().counts().touching;
    if (options.header)
        fmt::print(
            "scene,species,particles,listed_pairs,touching,threads,steps,seconds,million_particle_steps_per_"
            "second,bytes_per_particle,rebuilds,kinetic_energy_J,state_hash,peak_bytes_per_particle,"
            "processor_seconds{}\n",
            options.ranks ? RanksAtWork::columns : "");
    fmt::print("{},{},{},{},{},{},{},{:.6g},{:.4f},{:.1f},{},{:.6e},{:016x},{:.1f},{:.6g}",
               options.choice.scene, scene.laws().name, grains.count(), listed, touching, options.threads,
               options.steps, seconds, meanCount * static_cast<double>(options.steps) / seconds * 1e-6,
               static_cast<double>(grains.bytes() + scene.contacts().bytes()) / count,
               scene.contacts().rebuildCount() - rebuildsBefore, translationalEnergy(grains),
               stateHash(grains), (peakMemory() - memoryBefore) / count, processorSeconds);
    if (options.ranks) ranks.print();
    fmt::print("\n");
    if (!options.paraView.empty()) measureFrames(scene, seconds / static_cast<double>(options.steps));
}

/// Prints the box of a bed or a mixture, and its grains: what another code needs to run the same scene.
void printGrains(const Options& options) {
    check(options.choice);
    const scenes::Settled bed = scenes::settledIn(options.choice, options.threads);
    const auto& [lowest, highest] = bed.box;
    fmt::print("# box (m): {:.12g} {:.12g} {:.12g} {:.12g} {:.12g}\nradius_m,x_m,y_m,z_m\n", lowest.x(),
               highest.x(), lowest.y(), highest.y(), lowest.z());
    for (const auto& grain : bed.grains)
        fmt::print("{:.12g},{:.12g},{:.12g},{:.12g}\n", grain.radius, grain.position.x(), grain.position.y(),
                   grain.position.z());
}

/// Times a flow at the step that users of other codes take.
template <class SceneType>
void measureFlow(SceneType scene, const Options& options, double memoryBefore) {
    scene.setTimeStep(bulk::flowStep());
    scene.acceptUnstableTimeStep();
    scene.acceptOverlaps(bulk::largestFlowOverlap);
    measure(scene, options, memoryBefore);
    if constexpr (SceneType::isWet) fmt::print(stderr, "{} bridges\n", scene.contacts().counts().bridged);
}

/// A drum, a hopper or a mixer in flow, or its files for other codes.
void runFlow(const Options& options, double memoryBefore) {
    const scenes::BenchmarkChoice& choice = options.choice;
    const std::size_t grains = choice.particlesOr(bulk::ownFlowGrains(choice.scene));
    const bulk::BulkScene start = bulk::flowOf(choice.scene, grains, choice.states, options.threads);
    if (!options.peerFiles.empty()) return bulk::writePeerFolder(options.peerFiles, start, bulk::flowStep());
    if (bulk::isWetScene(choice.scene)) measureFlow(bulk::WetPeerScene(start), options, memoryBefore);
    else measureFlow(bulk::PeerScene(start), options, memoryBefore);
}

int run(const Options& options) {
    const bool flows = bulk::isFlowScene(options.choice.scene);
    if (options.grains && flows)
        throw InputError(fmt::format(
            "benchmark-scenes: the scene {} prints no grains; --peer-files writes what LIGGGHTS and "
            "LAMMPS read.",
            options.choice.scene));
    if (!options.peerFiles.empty() && !flows)
        throw InputError(
            fmt::format("benchmark-scenes: the scene {} has no files for other codes; --grains "
                        "prints the grains of a bed.",
                        options.choice.scene));
    constexpr std::size_t fewestInFlow = 200;
    if (flows && options.choice.particlesOr(fewestInFlow) < fewestInFlow)
        throw InputError(fmt::format("benchmark-scenes: particles = {}: the scene {} needs at least {}.",
                                     options.choice.particles, options.choice.scene, fewestInFlow));
    if (options.grains) return printGrains(options), 0;
    scenes::check(options.choice, bulk::flowSceneNames);
    checkValue("benchmark-scenes", "steps", static_cast<double>(options.steps), "", {1, 1e12});
    checkValue("benchmark-scenes", "wander", options.wander, "of the grains", {0, 1});
    const double memoryBefore = peakMemory();
    if (flows) return runFlow(options, memoryBefore), 0;
    scenes::withBenchmarkScene(options.choice, options.threads,
                               [&](Scene& scene) { measure(scene, options, memoryBefore); });
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Runs a scene of the benchmark and prints a row of CSV: how fast it ran, its memory, and a hash of "
        "its state.\n"
        "Initial states are made by the program when they are first asked for, which takes minutes for "
        "large scenes, and kept in the folder of --states.");
    Options o;
    app.add_option("--scene", o.choice.scene,
                   "in flow: flowing-drum, flowing-hopper, flowing-mixer (a screw of triangles), and each "
                   "with wet- in front (soft grains, a fifth of Rayleigh's time as step), drum (with a "
                   "mesh), gas; at rest: bed, clumps, wet-bed, wet-walls, sprayed-bed, "
                   "polydisperse, unless --shear is given; penetration: a sphere in a bed")
        ->capture_default_str();
    app.add_option("--particles", o.choice.particles,
                   "number of grains, about; the scene's own if not given");
    app.add_option(
        "--species", o.choice.species,
        "species by name, one that 'species --list' marks as instantiated; the scene's own if not given");
    app.add_option("--threads", o.threads, "threads")->capture_default_str();
    app.add_option("--steps", o.steps, "steps that are timed")->capture_default_str();
    app.add_option("--warm", o.warm, "steps before those")->capture_default_str();
    app.add_option("--ratio", o.choice.ratio, "radius of large grains to that of small ones (polydisperse)")
        ->capture_default_str();
    app.add_option("--clumps", o.choice.clumps,
                   "spheres that are joined to each rigid body (bed, wet-bed; clumps: so many rows of "
                   "--positions); 1: none")
        ->capture_default_str();
    app.add_option("--shear", o.choice.shear,
                   "speed along x over the height above the floor that the grains start with, 1/s (bed, "
                   "wet-bed, polydisperse)")
        ->capture_default_str();
    app.add_option("--positions", o.choice.positions,
                   "file of rows radius x y z (m): the bed of Dosta et al. (2024), repeated along x to the "
                   "number of --particles, or their drum or penetration; or clumps");
    app.add_option("--walls", o.choice.walls, "file of triangles, for the positions of drum and penetration");
    app.add_option("--states", o.choice.states, "folder of initial states")
        ->type_name("TEXT or ''")
        ->capture_default_str();
    app.add_option("--exchange", o.exchange,
                   "grains that come above the scene in each step, and leave it 50 steps later")
        ->capture_default_str();
    app.add_option("--paraview", o.paraView,
                   "writes a frame for ParaView of this name after the timed steps, and says what it costs");
    app.add_flag("--rank-columns", o.ranks, "also say what ranks did in the timed steps (mpirun)");
    app.add_option("--wander", o.wander,
                   "share of the grains that go to another rank at each list, by new cuts")
        ->capture_default_str();
    app.add_flag("--header", o.header, "print the names of the columns first");
    app.add_flag(
        "--grains", o.grains,
        "print the box and the grains of a bed or a mixture instead, for another code to run the same scene");
    app.add_option("--peer-files", o.peerFiles,
                   "write the files of a flow for LIGGGHTS and LAMMPS to this folder instead");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
