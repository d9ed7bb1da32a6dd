#pragma once

#include <optional>
#include <string>

#include "Kernel/Analysis/Output/FrameFile.h"
#include "Kernel/Core/Run/OutputInterval.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

class ContactSystem;
class ParticleStore;
class Scene;
class WallHandler;

/// The files NAME.data, NAME.fstat and NAME.ene of MercuryDPM, for the tools of its users (XBalls, MercuryCG,
/// scripts). Given to Simulation::addOutput(); the energies need keepSpringEnergy(). Source of the columns:
/// MercuryDPM's documentation, "Visualising your results", 3D; see the page on output.
class MercuryOutput {
public:
    /// @param beginning NAME; that of the simulation if empty
    explicit MercuryOutput(std::string beginning = {});

    /// NAME.ene, on by default.
    MercuryOutput& withEnergies(bool yes = true) { return energiesToo = yes, *this; }
    /// NAME.data, on by default.
    MercuryOutput& withData(bool yes = true) { return dataToo = yes, *this; }
    /// NAME.fstat, on by default.
    MercuryOutput& withContacts(bool yes = true) { return contactsToo = yes, *this; }
    /// A file for each frame instead of one with all: NAME.data.0, NAME.data.1, ..., and so on.
    /// @param digits at least so many in the number
    MercuryOutput& withManyFiles(bool yes = true, int digits = 1) {
        return many = yes, digitsOfNumber = digits, *this;
    }
    /// The box in the headers, m; if not given that of the scene (setDomain()), or else that of the grains.
    MercuryOutput& withDomain(const Eigen::Vector3d& lowest, const Eigen::Vector3d& highest) {
        return domain = {toVector(lowest), toVector(highest)}, *this;
    }

    /// A frame at the step nearest to each multiple of this time (s), at the start and at the end.
    MercuryOutput& withInterval(double seconds) {
        return times = OutputInterval("MercuryOutput", seconds), *this;
    }
    [[nodiscard]] OutputInterval interval() const { return times; }

    void write(const Scene& scene);
    void visitState(StateArchive& archive, const Scene& scene);

private:
    struct Domain {
        Vector<double> lowest, highest;  // m
    };

    static FrameFile textOf(const std::string& ending);
    void beginFrame();
    [[nodiscard]] std::string nameIn(const Scene& scene) const;
    void visitOwn(StateArchive& archive, const std::string& beginning);
    [[nodiscard]] Domain domainIn(const Scene& scene) const;
    static Domain domainOf(const ParticleStore& grains);
    /// N time xmin ymin zmin xmax ymax zmax, then for each grain rx ry rz vx vy vz rad alpha beta gamma omex
    /// omey omez info: the angles are 0 (spheres), the info is the species.
    void writeData(const ParticleStore& grains, const Domain& box, double time);
    /// Three lines of header, then time i j cx cy cz delta deltat fn ft nx ny nz tx ty tz: for grains a line
    /// for each of the two, by their indices. The force on i is fn n + ft t, where n points from j to i. At
    /// the wall with the index w, j is -w - 1, and n and t are reversed, as MercuryDPM does it ("an old
    /// bug").
    void writeContacts(const ContactSystem& system, const ParticleStore& grains, const WallHandler& walls,
                       const Domain& box, double time);

    std::string name;
    std::optional<Domain> domain;
    OutputInterval times;
    double last = -1;  // s, of the last frame; negative: none
    bool dataToo = true, energiesToo = true, contactsToo = true, many = false;
    int digitsOfNumber = 1;
    std::uint64_t frames = 0;  // that have been written, where each has a file
    FrameFile data = textOf(".data"), contacts = textOf(".fstat"), energies = textOf(".ene");
};

}  // namespace pendular
