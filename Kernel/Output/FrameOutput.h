#pragma once

#include <cmath>
#include <string>

#include "Kernel/Files/FileName.h"
#include "Kernel/Output/OutputInterval.h"
#include "Kernel/Output/SceneFields.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {

/// Frames of a scene at intervals, in the files of a Series. Given to Simulation::addOutput().
///
/// A Series has a constructor (name, keptUntil), which keeps the frames of an earlier part of the run up to
/// that time (s; -infinity: none) and removes later ones; add(SceneFrame, threads); the path indexOf(name) of
/// the file that lists the frames; prepare(), which throws InputError if this build cannot write it; and
/// check(name), which throws InputError if that file is there and cannot be gone on with.
template <class Series>
class FrameOutput {
public:
    /// @param beginning what the names of files begin with; the name of the simulation if empty
    explicit FrameOutput(std::string beginning = {}) : name(std::move(beginning)) {
        if (!name.empty()) requireFileName("Output of frames", name);
    }

    /// A frame at the step nearest to each multiple of this time (s), and at the end, whenever other outputs
    /// are due; 0: when they are.
    FrameOutput& withInterval(double seconds) {
        return times = OutputInterval("Output of frames", seconds), *this;
    }
    [[nodiscard]] OutputInterval interval() const { return times; }
    /// A number or a Vec3D of each grain, by its identity; the name ends with the unit.
    template <class Function>
    FrameOutput& addField(const std::string& fieldName, Function valueOf) {
        return content.addField(fieldName, std::move(valueOf)), *this;
    }
    /// The field stress_Pa of each grain as well; see grainStresses().
    FrameOutput& withStress(bool yes = true) { return content.stress = yes, *this; }
    /// The contacts, which are the larger part of a large scene's; on by default.
    FrameOutput& withContacts(bool yes = true) { return content.contacts = yes, *this; }
    /// The field contact_point_m of each contact as well: in the middle of the overlap or of the gap, at a
    /// wall on its surface. It takes 12 bytes a contact, or 24 of doubles.
    FrameOutput& withContactPoints(bool yes = true) { return content.contactPoints = yes, *this; }
    /// Fields of 64 bits, as the run has them; 32 by default. Positions always have 64.
    FrameOutput& withDoubles(bool yes = true) { return content.doubles = yes, *this; }

    template <class Scene>
    void prepare(const Scene&) const {
        Series::prepare();
    }

    template <class Scene>
    void write(const Scene& scene) {
        if (scene.getTime() <= last) return;  // it has this state
        if (!series) series.emplace(nameIn(scene), keptUntil(scene));
        series->add(content.of(scene), scene.getNumberOfThreads());
        last = scene.getTime();
    }

    /// Of a run that goes on from a file that knows no frames, and that has no output any more: its end.
    template <class Scene>
    void complete(const Scene& scene) {
        if (scene.isRestarted() && !isKnown && !series) write(scene);
    }

    /// The time of the last frame, so that a run that goes on repeats none and leaves none out.
    template <class Scene>
    void visitState(StateArchive& archive, const Scene& scene) {
        const std::string entry = Series::indexOf(nameIn(scene)).filename().string() + "-last-time";
        if (archive.isReading()) isKnown = archive.holds(entry);
        if (isKnown || series) archive.value(entry, last);
        if (archive.isReading()) Series::check(nameIn(scene));
    }

private:
    template <class Scene>
    [[nodiscard]] std::string nameIn(const Scene& scene) const {
        return name.empty() ? scene.getName() : name;
    }
    /// A restart file that knows nothing of this output was written by a run without it.
    template <class Scene>
    [[nodiscard]] double keptUntil(const Scene& scene) const {
        if (!scene.isRestarted()) return -INFINITY;
        return isKnown ? last : scene.getTime();
    }

    FrameContent content;
    std::optional<Series> series;
    std::string name;
    OutputInterval times;
    double last = -INFINITY;  // s, of the last frame
    bool isKnown = false;     // `last`, from a restart file
};

}  // namespace pendular
