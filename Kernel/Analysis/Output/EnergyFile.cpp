#include "Kernel/Analysis/Output/EnergyFile.h"

#include <fmt/format.h>

#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {
namespace {

std::string header() {
    std::string columns = "time_s";
    for (const auto& entry : EnergyLedger::entries()) columns += fmt::format(",{}_J", entry.name);
    return columns;
}

}  // namespace

EnergyFile::EnergyFile(double time) : table("EnergyFile", "-energy.csv", time) {}

void EnergyFile::prepare(Scene& scene) const { scene.keepEnergyLedger(); }

void EnergyFile::write(const Scene& scene) {
    const double time = scene.getTime();
    if (table.has(time)) return;
    const EnergyLedger& ledger = scene.energyLedger();
    std::string row = fmt::format("{}", time);
    for (const auto& entry : EnergyLedger::entries()) row += fmt::format(",{}", ledger.*entry.member);
    table.of(scene, header()).row(row);
    table.wroteAt(time);
}

void EnergyFile::complete(const Scene& scene) { table.of(scene, header()).close(); }

void EnergyFile::visitState(StateArchive& archive, const Scene& scene) {
    table.visitState(archive, scene, header());
}

}  // namespace pendular
