#include "Kernel/Mercury/MercuryFiles.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

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
    if (energies.isWritten()) settings->readsLedger ? scene.keepEnergyLedger() : scene.keepSpringEnergy();
    // Files of one count and one form together.
    std::set<std::pair<std::size_t, FileType>> kinds;
    const auto kindOf = [](const MercuryFile& file) {
        return std::pair(file.getSaveCount(), file.getFileType());
    };
    for (const MercuryFile* file : {&data, &contacts, &energies})
        if (file->isWritten()) kinds.insert(kindOf(*file));
    for (const auto& kind : kinds) {
        const auto isOfThese = [&](const MercuryFile& file) {
            return file.isWritten() && kindOf(file) == kind;
        };
        const auto& [count, type] = kind;
        MercuryOutput frames;
        frames.withData(isOfThese(data)).withContacts(isOfThese(contacts)).withEnergies(isOfThese(energies));
        if (type != FileType::ONE_FILE)
            frames.withManyFiles(true, type == FileType::MULTIPLE_FILES_PADDED ? 5 : 1);
        if (count > 0) frames.withInterval(static_cast<double>(count) * scene.getTimeStep());
        scene.addOutput(frames);
    }
}

void MercuryFiles::visitState(StateArchive& archive, const Scene& /*scene*/) {
    settings->random.visitState(archive);
}

}  // namespace pendular
