#include "Kernel/Analysis/Output/FrameOutput.h"

#include <utility>

#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

template <class Series>
FrameOutput<Series>::FrameOutput(std::string beginning) : name(std::move(beginning)) {
    if (!name.empty()) requireFileName("Output of frames", name);
}

template <class Series>
FrameOutput<Series>& FrameOutput<Series>::withInterval(double seconds) {
    return times = OutputInterval("Output of frames", seconds), *this;
}

template <class Series>
FrameOutput<Series>& FrameOutput<Series>::addField(const std::string& fieldName,
                                                   FrameContent::GrainValue valueOf) {
    return content.addField(fieldName, std::move(valueOf)), *this;
}

template <class Series>
void FrameOutput<Series>::prepare(const Scene& /*scene*/) const {
    Series::prepare();
}

template <class Series>
void FrameOutput<Series>::write(const Scene& scene) {
    if (scene.getTime() <= last) return;  // it has this state
    if (!series) series.emplace(nameIn(scene), keptUntil(scene));
    add(content.of(scene, box), scene);
    last = scene.getTime();
}

template <class Series>
void FrameOutput<Series>::add(SceneFrame frame, const Scene& scene) {
    if constexpr (Series::hasParts) {
        const AllRanks& ranks = scene.contacts().ranks();
        if (parts && ranks.areSeveral())
            return series->addPart(std::move(frame), scene.getNumberOfThreads(), ranks);
    }
    series->add(std::move(frame), scene.getNumberOfThreads());
}

template <class Series>
void FrameOutput<Series>::complete(const Scene& scene) {
    // A run that ends with an error: the first rank alone comes here, without the grains of the others.
    if (scene.contacts().ranks().areSeveral()) return;
    if (scene.isRestarted() && !isKnown && !series) write(scene);
}

template <class Series>
void FrameOutput<Series>::visitState(StateArchive& archive, const Scene& scene) {
    const std::string index = Series::indexOf(nameIn(scene)).filename().string();
    const std::string entry = index + "-last-time";
    if (archive.isReading()) isKnown = archive.holds(entry);
    if (isKnown || series) {
        archive.value(entry, last);
        box.visitState(archive, index + "-box");
    }
    if (archive.isReading()) Series::check(nameIn(scene));
}

template <class Series>
std::string FrameOutput<Series>::nameIn(const Scene& scene) const {
    return name.empty() ? scene.getName() : name;
}

template <class Series>
double FrameOutput<Series>::keptUntil(const Scene& scene) const {
    if (!scene.isRestarted()) return -INFINITY;
    return isKnown ? last : scene.getTime();
}

template class FrameOutput<Hdf5Frames>;
template class FrameOutput<ParaViewFrames>;

}  // namespace pendular
