#include "Kernel/Mercury/MercuryFiles.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Simulation/Scene.h"

namespace pendular {

/// The name of a scene that was given none.
static constexpr std::string_view nameOfUnnamed = "pendular";

/// It is called when the output is added, and again when the scene has been set up, which is when the
/// settings count.
void MercuryFiles::prepare(Scene& scene) {
    if (!std::exchange(isAdded, true) || std::exchange(isDone, true)) return;
    if (settings->atSetUp) settings->atSetUp();
    addPictures(scene);
    if (settings->restart.isWritten()) {
        scene.keepRestartFile();
        if (settings->restart.getSaveCount() > 0) scene.setRestartCount(settings->restart.getSaveCount());
    }
    if (scene.getName() != nameOfUnnamed) addFrames(scene);
}

void MercuryFiles::addPictures(Scene& scene) const {
    if (settings->picturesOfGrains || settings->picturesOfWalls || settings->picturesOfContacts)
        scene.addOutput(ParaViewOutput());
}

void MercuryFiles::addFrames(Scene& scene) const {
    const MercuryFile &data = settings->data, &contacts = settings->fStat, &energies = settings->energies;
    if (energies.isWritten()) scene.keepEnergyLedger();
    // Files of one count together.
    std::set<std::size_t> counts;
    for (const MercuryFile* file : {&data, &contacts, &energies}) {
        if (file->isWritten()) counts.insert(file->getSaveCount());
        if (file->isSplit())
            scene.logger(LogLevel::Info, "{}: it is one file with all frames, not many files.",
                         file->getName());
    }
    for (const std::size_t count : counts) {
        const auto isOfThese = [count](const MercuryFile& file) {
            return file.isWritten() && file.getSaveCount() == count;
        };
        MercuryOutput frames;
        frames.withData(isOfThese(data)).withContacts(isOfThese(contacts)).withEnergies(isOfThese(energies));
        if (count > 0) frames.withInterval(static_cast<double>(count) * scene.getTimeStep());
        scene.addOutput(frames);
    }
}

void MercuryFiles::visitState(StateArchive& archive, const Scene& /*scene*/) {
    settings->random.visitState(archive);
}

}  // namespace pendular
