#include "Kernel/Analysis/Output/TimedTable.h"

#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

TimedTable::TimedTable(std::string_view owner, std::string_view ending, double time)
    : nameEnding(ending), times(owner, time) {}

RunTable& TimedTable::of(const Scene& scene, const std::string& header) {
    if (!table) table = std::make_unique<RunTable>(pathOf(scene), header);
    return *table;
}

void TimedTable::visitState(StateArchive& archive, const Scene& scene, const std::string& header) {
    RunTable& rows = of(scene, header);
    const std::string entry = pathOf(scene).filename().string() + "-last-time";
    if (archive.isReading() && !archive.holds(entry)) return rows.goOnFrom(scene.getTime());
    archive.value(entry, last);
    rows.visitState(archive);
}

std::filesystem::path TimedTable::pathOf(const Scene& scene) const { return scene.getName() + nameEnding; }

}  // namespace pendular
