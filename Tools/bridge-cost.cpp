/// Measures what the force of each liquid bridge law costs in the contact kernel's form, eight bridges at a
/// time, and what its preparation costs for each new bridge.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <bit>
#include <chrono>
#include <random>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Output/CsvFile.h"
#include "Kernel/Simulation/Program.h"
#include "Kernel/Species/Laws.h"

using namespace pendular;

namespace {

constexpr std::size_t blocks = 16;  // so that all stays in the first-level cache

struct Bridge {
    double volume, contactAngle, radius, share;  // of the rupture distance
};

/// Bridges of V* = 1e-5 ... 0.1 between equal spheres, theta = 0.3, so that all laws take them.
std::vector<Bridge> someBridges() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Bridge> bridges(blocks * Pack::lanes);
    for (Bridge& bridge : bridges) {
        bridge.radius = 1e-3 * (1 + uniform(random));
        bridge.volume = 1e-5 * std::pow(1e4, uniform(random)) * std::pow(bridge.radius, 3);
        bridge.contactAngle = 0.3;
        bridge.share = uniform(random);
    }
    return bridges;
}

template <class Law>
typename Law::template Interaction<double> prepared(const Bridge& bridge) {
    Law law;
    law.liquidBridgeVolume = bridge.volume;
    law.contactAngle = bridge.contactAngle;
    law.surfaceTension = 0.07;
    return law.prepare(Bodies{bridge.radius, bridge.radius});
}

/// Nanoseconds of the fastest of many runs of an action: what else the machine does only adds time.
template <class Action>
double fastest(int runs, Action&& action) {
    double best = infinity;
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        action();
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
        best = std::min(best, time.count());
    }
    return best;
}

/// Keeps the compiler from leaving out what makes these numbers, or from moving it out of the loop.
void use(const void* numbers) { asm volatile("" : : "g"(numbers) : "memory"); }

/// Nanoseconds for the force of eight bridges, loaded from columns as the contact kernel does.
template <class Law>
double forceTime(const std::vector<Bridge>& bridges, int runs) {
    MemoryColumns<Law::template Interaction> memory;
    memory.resize(blocks);
    std::vector<LaneColumn> separations(blocks), forces(blocks);
    for (std::size_t k = 0; k < bridges.size(); ++k) {
        const auto interaction = prepared<Law>(bridges[k]);
        memory.set(k, interaction);
        separations[k / Pack::lanes].lane[k % Pack::lanes] = bridges[k].share * interaction.range();
    }
    constexpr int rounds = 100;
    return fastest(runs,
                   [&] {
                       for (int round = 0; round < rounds; ++round) {
                           for (std::size_t b = 0; b < blocks; ++b) {
                               const auto bridge = memory.load(b);
                               const Pack separation = Pack::load(separations[b].lane.data());
                               select(separation < bridge.range(), bridge.force(separation), Pack(0))
                                   .store(forces[b].lane.data());
                           }
                           use(forces.data());
                       }
                   }) /
           (rounds * blocks);
}

template <class Law>
double prepareTime(const std::vector<Bridge>& bridges, int runs) {
    return fastest(runs,
                   [&] {
                       for (const Bridge& bridge : bridges) {
                           const auto interaction = prepared<Law>(bridge);
                           use(&interaction);
                       }
                   }) /
           static_cast<double>(bridges.size());
}

void measure(const std::string& path, int runs) {
    const auto bridges = someBridges();
    const double reference = forceTime<LiquidBridgeBagheri>(bridges, runs);
    CsvFile file(path,
                 "law,numbers_per_contact,force_ns_per_8_bridges,force_over_Bagheri,prepare_ns_per_bridge");
    AdhesionLaws::forEach([&]<class Law>() {
        if constexpr (requires(const Law law, const Bodies bodies) { law.scales(bodies); }) {
            const double force = forceTime<Law>(bridges, runs), prepare = prepareTime<Law>(bridges, runs);
            const std::size_t numbers = columnsOf<Law::template Interaction>;
            fmt::print(
                "{:<32} {:2} numbers  force {:6.2f} ns for eight ({:.2f} of Bagheri)  prepare {:6.0f} ns\n",
                Law::name, numbers, force, force / reference, prepare);
            file.row(Law::name, numbers, force, force / reference, prepare);
        }
    });
    file.close();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("What the force of each liquid bridge law costs (ns), on data in the first-level cache.");
    std::string path = "bridge-cost.csv";
    int runs = 300;
    app.add_option("--output", path, "table to write")->capture_default_str();
    app.add_option("--runs", runs, "measurements, of which the fastest counts")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000000));
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        measure(path, runs);
        return 0;
    });
}
