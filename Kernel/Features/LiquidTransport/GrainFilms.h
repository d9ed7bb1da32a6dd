#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// The liquid films of grains, in scenes in which liquid moves: a column of the grains, "liquid_film" in m^3.
/// From the start of the run on, every volume is a multiple of a quantum q, a power of two, with
/// q 2^53 > 4 x all liquid of the scene: so sums of volumes are exact, in any order.
class GrainFilms {
public:
    /// m^3
    [[nodiscard]] double quantum() const { return unit; }
    [[nodiscard]] bool areKept() const { return column != none; }
    /// m^2, over which the film of the grain at a place is spread: of its surface, what is in no other grain
    /// of its rigid body.
    [[nodiscard]] static double areaOf(const ParticleStore& grains, std::uint32_t at);
    /// m, of a film that is spread evenly; 0 where there is no surface
    [[nodiscard]] double thicknessOf(const ParticleStore& grains, std::uint32_t at) const {
        const double volume = of(grains, at), area = volume > 0 ? areaOf(grains, at) : 0;
        return area > 0 ? volume / area : 0;
    }
    /// The film (m^3) of the grain at a place.
    [[nodiscard]] double of(const ParticleStore& grains, std::uint32_t at) const;
    /// Sets the film of a grain; in a run, the difference counts as absorbed. Throws InputError if that is
    /// more liquid than the quantum was made for, or if no law of the scene moves liquid.
    void set(ParticleStore& grains, std::uint32_t at, double volume);
    /// Liquid that moves: a multiple of the quantum.
    void add(ParticleStore& grains, std::uint32_t at, double volume) const {
        grains.columns[column].values[at] += volume;
    }
    /// A droplet of a spray, or liquid that touching contacts draw from in the next step.
    void wet(ParticleStore& grains, std::uint32_t at, double volume) {
        add(grains, at, volume);
        wetted.push_back(grains.identity[at]);
    }
    /// A spray emits liquid. Throws InputError if that is more than the quantum was made for.
    void emit(double volume);
    /// A grain is about to be removed, with its film.
    void remove(ParticleStore& grains, std::uint32_t at);

    /// The scene's laws are known: from now on films are a column, or there are none. Throws InputError if
    /// films were set that no law of the scene moves.
    void settle(ParticleStore& grains, bool areMoved);
    /// The run begins. @param toCome m^3, an upper bound of the liquid that will come to what is there
    void begin(ParticleStore& grains, double toCome);
    /// m^3: more liquid than this, in all that has been in films, cannot be counted.
    [[nodiscard]] double capacity() const { return 0x1p51 * unit; }
    /// Why so much more liquid (m^3) is beyond that, if so.
    [[nodiscard]] std::optional<std::string> objectionToMore(double volume) const;

    // m^3: at the start of the run; since then.
    [[nodiscard]] double initial() const { return atStart; }
    [[nodiscard]] double absorbed() const { return come; }
    [[nodiscard]] double emitted() const { return sprayed; }
    [[nodiscard]] double removed() const { return gone; }
    /// m^3, where ranks add them up.
    void setAccounts(double ofAbsorbed, double ofRemoved) { come = ofAbsorbed, gone = ofRemoved; }
    [[nodiscard]] double sum(const ParticleStore& grains) const;
    /// The identities of grains whose films were set since this was called last.
    [[nodiscard]] std::vector<std::uint32_t> takeWetted() { return std::exchange(wetted, {}); }

    void visitState(StateArchive& archive, const ParticleStore& grains);
    /// Whether a volume is what a film or a bridge can have: a multiple of the quantum, and not negative.
    [[nodiscard]] bool isWhole(double volume) const;

private:
    static constexpr std::size_t none = ~std::size_t{0};

    std::map<std::uint32_t, double> waiting;  // m^3, by identity, until there is a column
    std::size_t column = none;
    bool isSettled = false;
    double unit = 0;                                      // 0: the run has not begun
    double atStart = 0, come = 0, gone = 0, sprayed = 0;  // m^3
    std::vector<std::uint32_t> wetted;
};

}  // namespace pendular
