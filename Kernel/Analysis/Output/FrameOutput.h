#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "Kernel/Analysis/Output/SceneBox.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Run/OutputInterval.h"

namespace pendular {

class StateArchive;

/// Frames of a scene at intervals, in the files of a Series. Given to Simulation::addOutput().
///
/// A Series has a constructor (name, keptUntil), which keeps the frames of an earlier part of the run up to
/// that time (s; -infinity: none) and removes later ones; add(SceneFrame, threads); hasParts, and where it is
/// true addPart(SceneFrame, threads, AllRanks); the path indexOf(name) of
/// the file that lists the frames; prepare(), which throws InputError if this build cannot write it; and
/// check(name), which throws InputError if that file is there and cannot be gone on with. FrameOutput.cpp
/// lists them all.
template <class Series>
class FrameOutput {
public:
    /// @param beginning what the names of files begin with; the name of the simulation if empty
    explicit FrameOutput(std::string beginning = {});

    /// A frame at the step nearest to each multiple of this time (s), and at the end, whenever other outputs
    /// are due; 0: when they are.
    FrameOutput& withInterval(double seconds);
    [[nodiscard]] OutputInterval interval() const { return times; }
    /// A number or a Vec3D of each grain, by its identity; the name ends with the unit.
    FrameOutput& addField(const std::string& fieldName, FrameContent::GrainValue valueOf);
    /// The field stress_Pa of each grain as well; see grainStresses().
    FrameOutput& withStress(bool yes = true) { return content.stress = yes, *this; }
    /// The contacts, which are the larger part of a large scene's; on by default.
    FrameOutput& withContacts(bool yes = true) { return content.contacts = yes, *this; }
    /// The field contact_point_m of each contact as well: in the middle of the overlap or of the gap, at a
    /// wall on its surface. It takes 12 bytes a contact, or 24 of doubles.
    FrameOutput& withContactPoints(bool yes = true) { return content.contactPoints = yes, *this; }
    /// Fields of 64 bits, as the run has them; 32 by default. Positions always have 64.
    FrameOutput& withDoubles(bool yes = true) { return content.doubles = yes, *this; }

    /// On several ranks, each writes a file with its own grains and contacts, and the first one what names
    /// them (see ParaViewFrames). Where one process has all grains, there is one file.
    FrameOutput& withParts(bool yes = true) requires(Series::hasParts) { return parts = yes, *this; }
    [[nodiscard]] bool writesParts() const { return parts; }

    void prepare(const Scene& scene) const;
    void write(const Scene& scene);
    /// Writes the end of a run that goes on from a file that knows no frames, and that has had no output
    /// since.
    void complete(const Scene& scene);
    /// The time of the last frame, so that a run that is resumed repeats none and leaves none out, and the
    /// box in which walls are drawn.
    void visitState(StateArchive& archive, const Scene& scene);

private:
    void add(SceneFrame frame, const Scene& scene);
    [[nodiscard]] std::string nameIn(const Scene& scene) const;
    /// A restart file that knows nothing of this output was written by a run without it.
    [[nodiscard]] double keptUntil(const Scene& scene) const;

    FrameContent content;
    SceneBox box;
    std::optional<Series> series;
    std::string name;
    OutputInterval times;
    double last = -INFINITY;  // s, of the last frame
    bool isKnown = false;     // `last`, from a restart file
    bool parts = false;
};

}  // namespace pendular
