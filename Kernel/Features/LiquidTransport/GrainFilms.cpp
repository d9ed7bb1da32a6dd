#include "Kernel/Features/LiquidTransport/GrainFilms.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

InputError noLawError(std::uint32_t identity, double volume) {
    return InputError(
        fmt::format("particle {}: liquid volume = {:.6g} m^3, but no species of this scene moves liquid; "
                    "take an adhesion "
                    "law whose name begins with LiquidMigration, or leave it out.",
                    identity, volume));
}

}  // namespace

double GrainFilms::areaOf(const ParticleStore& grains, std::uint32_t at) {
    const double radius = grains.translation[at].radius;
    const double share = grains.bodies.empty() ? 1 : grains.bodies.exposedShareOf(grains.identity[at]);
    return share * (4 * std::numbers::pi * radius * radius);
}

double GrainFilms::of(const ParticleStore& grains, std::uint32_t at) const {
    if (areKept()) return grains.columns[column].values[at];
    const auto found = waiting.find(grains.identity[at]);
    return found == waiting.end() ? 0 : found->second;
}

void GrainFilms::set(ParticleStore& grains, std::uint32_t at, double volume) {
    if (!areKept()) {
        if (isSettled) throw noLawError(grains.identity[at], volume);
        waiting[grains.identity[at]] = volume;
        return;
    }
    double& film = grains.columns[column].values[at];
    if (unit == 0) {
        film = volume;
        return;
    }
    if (const auto objection = objectionToMore(volume - film)) throw InputError(*objection);
    const double whole = std::nearbyint(volume / unit) * unit;
    come += whole - film;
    film = whole;
    wetted.push_back(grains.identity[at]);
}

void GrainFilms::emit(double volume) {
    if (const auto objection = objectionToMore(volume)) throw InputError(*objection);
    sprayed += volume;
}

void GrainFilms::remove(ParticleStore& grains, std::uint32_t at) {
    if (!areKept()) {
        waiting.erase(grains.identity[at]);
        return;
    }
    double& film = grains.columns[column].values[at];
    gone += film;
    film = 0;
    std::erase(wetted, grains.identity[at]);
}

void GrainFilms::settle(ParticleStore& grains, bool areMoved) {
    isSettled = true;
    for (const auto& [identity, volume] : waiting)
        if (!areMoved && volume > 0) throw noLawError(identity, volume);
    if (!areMoved) return;
    const NamedColumn films{"liquid_film", "m3", 0};
    requireNewColumn(films, "grains", hasColumn(grains.columns, films.name));
    column = grains.columns.size();
    grains.columns.push_back({films, std::vector<double>(grains.size(), 0)});
    for (const auto& [identity, volume] : waiting)
        if (grains.place.contains(identity)) grains.columns[column].values[grains.place[identity]] = volume;
    waiting.clear();
}

void GrainFilms::begin(ParticleStore& grains, double toCome) {
    int exponent = 0;
    // 4 x all = m 2^exponent with m < 1
    static_cast<void>(std::frexp(4 * (sum(grains) + toCome), &exponent));
    unit = std::ldexp(1, std::max(exponent, -900) - 53);
    for (double& film : grains.columns[column].values) film = std::nearbyint(film / unit) * unit;
    atStart = sum(grains);
    come = gone = sprayed = 0;
    wetted.assign(grains.identity.begin(), grains.identity.end());
}

std::optional<std::string> GrainFilms::objectionToMore(double volume) const {
    const double all = come + sprayed + volume;
    if (atStart + all <= capacity()) return std::nullopt;
    return fmt::format(
        "Simulation: {:.6g} m^3 of liquid have come to the {:.6g} m^3 at the start of the run, and the "
        "quantum "
        "in which liquid is counted was chosen for {:.6g} m^3 in all; say by setLiquidToCome() before the "
        "run "
        "how much will come.",
        all, atStart, capacity());
}

double GrainFilms::sum(const ParticleStore& grains) const {
    double all = 0;
    for (const std::uint32_t at : grains.place) all += grains.columns[column].values[at];
    return all;
}

bool GrainFilms::isWhole(double volume) const {
    return volume >= 0 && volume <= 0x1p53 * unit && std::nearbyint(volume / unit) * unit == volume;
}

void GrainFilms::visitState(StateArchive& archive, const ParticleStore& grains) {
    archive.finite("quantum", unit);
    int exponent = 0;
    archive.require(unit > 0 && std::frexp(unit, &exponent) == 0.5, "quantum", "is no power of two");
    archive.finite("initial", atStart);
    archive.finite("absorbed", come);
    archive.finite("removed", gone);
    archive.finite("emitted", sprayed);
    archive.require(isWhole(atStart) && isWhole(std::abs(come)) && isWhole(gone) && isWhole(sprayed),
                    "initial", "or what was absorbed, removed or emitted is no multiple of the quantum");
    for (const double film : grains.columns[column].values)
        archive.require(isWhole(film), "quantum", "does not divide all films");
    if (archive.isReading()) wetted.assign(grains.identity.begin(), grains.identity.end());
}

}  // namespace pendular
