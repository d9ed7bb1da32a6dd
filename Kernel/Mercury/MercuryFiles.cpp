#include "Kernel/Mercury/MercuryFiles.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Base/InputError.h"
#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Simulation/Scene.h"

namespace pendular {

/// The name of a scene that was given none.
static constexpr std::string_view nameOfUnnamed = "pendular";

void MercuryFile::setFileType(FileType asked) {
    if (asked != FileType::NO_FILE && asked != FileType::ONE_FILE)
        throw InputError(
            fmt::format("{}: MULTIPLE_FILES are not written here; it may be ONE_FILE, with all "
                        "frames, or NO_FILE.",
                        name));
    type = asked;
}

/// It is called when the output is added, and again when the scene has been set up, which is when the
/// settings count.
void MercuryFiles::prepare(Scene& scene) {
    if (!std::exchange(isAdded, true) || std::exchange(isDone, true)) return;
    if (settings->picturesOfGrains || settings->picturesOfWalls) scene.addOutput(ParaViewOutput());
    if (settings->restart.isWritten()) scene.keepRestartFile();
    const bool data = settings->data.isWritten(), contacts = settings->fStat.isWritten(),
               energies = settings->energies.isWritten();
    if (scene.getName() == nameOfUnnamed || !(data || contacts || energies)) return;
    if (energies) scene.keepEnergyLedger();
    frames.emplace().withData(data).withContacts(contacts).withEnergies(energies);
}

void MercuryFiles::write(const Scene& scene) {
    if (frames) frames->write(scene);
}

void MercuryFiles::visitState(StateArchive& archive, const Scene& scene) {
    settings->random.visitState(archive);
    if (frames) frames->visitState(archive, scene);
}

}  // namespace pendular
