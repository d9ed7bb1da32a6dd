#include "Kernel/Core/Particles/ParticleStore.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

template <class Value>
static void permute(std::vector<Value>& column, const std::vector<std::uint32_t>& order, int threads) {
    constexpr std::size_t worthAThread = 4096;
    std::vector<Value> sorted;
    reserveLarge(sorted, order.size());
    sorted.resize(order.size());
    inParts(
        order.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) sorted[k] = column[order[k]];
        },
        worthAThread);
    column.swap(sorted);
}

void ParticleStore::reserve(std::size_t count) {
    reserveLarge(translation, count);
    if (hasSpin) reserveLarge(rotation, count);
    reserveLarge(acceleration, count);
    reserveLarge(species, count);
    reserveLarge(identity, count);
}

std::uint32_t ParticleStore::add(const TranslationRecord& grain, const Vector<double>& spin,
                                 std::uint16_t speciesIndex) {
    const std::uint32_t number = next++;
    const std::uint32_t at = freePlace();
    place.set(number, at);
    bodies.forgetPlaces();
    translation[at] = grain;
    acceleration[at] = {0, 0, 0};
    species[at] = speciesIndex;
    identity[at] = number;
    if (!earlier.empty()) earlier[at] = {};
    if (remembersStart) atStart[at] = {};
    if (!held.empty()) held[at] = {};
    if (hasSpin) rotation[at] = {spin, 2.5 * grain.inverseMass / (grain.radius * grain.radius), {0, 0, 0}};
    for (GrainColumn& column : columns) column.values[at] = column.initial;
    return number;
}

std::uint32_t ParticleStore::freePlace() {
    if (!gaps.empty()) {
        const std::uint32_t at = gaps.back();
        gaps.pop_back();
        return at;
    }
    const std::size_t count = size() + 1;
    translation.resize(count), acceleration.resize(count), species.resize(count), identity.resize(count);
    if (remembersEarlier || !earlier.empty()) earlier.resize(count);
    if (remembersStart) atStart.resize(count);
    if (!held.empty()) held.resize(count);
    if (hasSpin) rotation.resize(count);
    for (GrainColumn& column : columns) column.values.resize(count);
    return static_cast<std::uint32_t>(count - 1);
}

void ParticleStore::remove(std::uint32_t at) {
    gaps.push_back(at);
    place.erase(identity[at]);
    translation[at].radius = translation[at].inverseMass = 0;
    translation[at].velocity = {0, 0, 0};
    acceleration[at] = {0, 0, 0};
    if (hasSpin) rotation[at] = {};
    if (!earlier.empty()) earlier[at] = {};
    if (!held.empty()) held[at] = {};
}

void ParticleStore::reorder(const std::vector<std::uint32_t>& order, int threads) {
    gaps.clear();
    permute(translation, order, threads);
    permute(acceleration, order, threads);
    permute(species, order, threads);
    permute(identity, order, threads);
    if (hasSpin) permute(rotation, order, threads);
    if (!earlier.empty()) permute(earlier, order, threads);
    if (remembersStart) permute(atStart, order, threads);
    if (!held.empty()) permute(held, order, threads);
    for (GrainColumn& column : columns) permute(column.values, order, threads);
    const std::size_t own = ownSize();
    for (std::size_t k = 0; k < identity.size(); ++k)
        (k < own ? place : ghostPlace).set(identity[k], static_cast<std::uint32_t>(k));
    bodies.forgetPlaces();
}

void ParticleStore::keepOnly(const std::vector<std::uint32_t>& places) {
    place.clear();
    ghostPlace.clear();
    reorder(places);
}

std::size_t ParticleStore::addPlace(std::uint32_t number, PlaceIndex& index) {
    const std::uint32_t at = freePlace();
    index.set(number, at);
    identity[at] = number;
    return at;
}

void ParticleStore::visitState(StateArchive& archive) {
    if (archive.isReading()) {
        visitColumns(archive);
        return visitBodies(archive);
    }
    ParticleStore byIdentity = *this;
    byIdentity.reorder({place.begin(), place.end()});
    byIdentity.visitColumns(archive);
    byIdentity.visitBodies(archive);
}

void ParticleStore::visitColumns(StateArchive& archive) {
    // A member that is added has to be added here.
    auto& [spins, shared, t, r, a, e, earlierIsKept, start, startIsKept, h, s, i, p, ghosts, named, joined, n,
           free] = *this;
    archive.column<double>("translation", t);
    archive.column<double>("rotation", r);
    archive.column<double>("acceleration", a);
    archive.column<double>("earlier", e);
    if (archive.isReading()) earlierIsKept = !e.empty();
    if (archive.isReading()) h.clear();
    if (archive.isWriting() ? !h.empty() : archive.holds("held")) archive.column<std::uint8_t>("held", h);
    archive.column<std::uint16_t>("species", s);
    archive.column<std::uint32_t>("identity", i);
    archive.value("nextIdentity", n);
    std::string names;
    for (const GrainColumn& column : named) names += column.fieldName() + " ";
    archive.same("columnNames", names);
    archive.group("columns", [&, &all = named] {
        for (GrainColumn& column : all) archive.column<double>(column.name, column.values);
    });
    requireWhole(archive);
    if (!archive.isReading()) return;
    place.clear();
    gaps.clear();
    for (std::size_t k = 0; k < size(); ++k) place.set(identity[k], static_cast<std::uint32_t>(k));
}

void ParticleStore::visitBodies(StateArchive& archive) {
    archive.group("bodies", [&] { bodies.visitState(archive, *this); });
}

void ParticleStore::requireWhole(const StateArchive& archive) const {
    constexpr std::string_view rows = "has another number of rows than particles/translation";
    const std::size_t grains = size();
    archive.require(rotation.size() == (hasSpin ? grains : 0), "rotation", rows);
    archive.require(acceleration.size() == grains, "acceleration", rows);
    archive.require(earlier.empty() || earlier.size() == grains, "earlier", rows);
    archive.require(held.empty() || held.size() == grains, "held", rows);
    for (const HeldBits axes : held)
        archive.require(axes.byte() < HeldBits::all, "held", "has axes that there are not");
    archive.require(species.size() == grains, "species", rows);
    archive.require(identity.size() == grains, "identity", rows);
    for (const GrainColumn& column : columns)
        archive.require(column.values.size() == grains, "columns/" + column.name, rows);
    archive.requireFinite("translation", translation);
    archive.requireFinite("rotation", rotation);
    archive.requireFinite("acceleration", acceleration);
    archive.requireFinite("earlier", earlier);
    for (const TranslationRecord& grain : translation)
        archive.require(grain.radius > 0 && grain.inverseMass >= 0, "translation",
                        "has a radius or a mass that is not positive");
    for (std::size_t k = 0; k < grains; ++k)
        if (!isResolved(translation[k].position, translation[k].radius))
            archive.require(false, "translation",
                            fmt::format("has a particle {} whose position {}", identity[k],
                                        objectionToPlace(translation[k].position, translation[k].radius)));
    const auto isNext = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
    const bool ascends = std::ranges::adjacent_find(identity, isNext) == identity.end();
    archive.require(ascends && (identity.empty() || identity.back() < next), "identity",
                    "does not ascend, or is not below nextIdentity");
    archive.require(next <= largestIdentity + 1, "nextIdentity", "is above 2^31");
}

}  // namespace pendular
