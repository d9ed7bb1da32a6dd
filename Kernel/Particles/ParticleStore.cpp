#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

template <class Value>
static void permute(std::vector<Value>& column, const std::vector<std::uint32_t>& order) {
    std::vector<Value> sorted;
    reserveLarge(sorted, column.size());
    sorted.resize(column.size());
    for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = column[order[k]];
    column.swap(sorted);
}

void ParticleStore::reorder(const std::vector<std::uint32_t>& order) {
    permute(translation, order);
    permute(acceleration, order);
    permute(species, order);
    permute(identity, order);
    if (hasSpin) permute(rotation, order);
    if (!earlier.empty()) permute(earlier, order);
    for (std::size_t k = 0; k < identity.size(); ++k) place[identity[k]] = static_cast<std::uint32_t>(k);
}

void ParticleStore::visitState(StateArchive& archive) {
    if (archive.isReading()) return visitColumns(archive);
    ParticleStore byIdentity = *this;
    byIdentity.reorder(place);
    byIdentity.visitColumns(archive);
}

void ParticleStore::visitColumns(StateArchive& archive) {
    auto& [spins, t, r, a, e, s, i, p] = *this;  // a member that is added has to be added here
    archive.column<double>("translation", t);
    archive.column<double>("rotation", r);
    archive.column<double>("acceleration", a);
    archive.column<double>("earlier", e);
    archive.column<std::uint16_t>("species", s);
    archive.column<std::uint32_t>("identity", i);
    if (archive.isReading()) p = i;
    requireWhole(archive);
}

void ParticleStore::requireWhole(const StateArchive& archive) const {
    constexpr std::string_view rows = "has another number of rows than particles/translation";
    const std::size_t count = size();
    archive.require(rotation.size() == (hasSpin ? count : 0), "rotation", rows);
    archive.require(acceleration.size() == count, "acceleration", rows);
    archive.require(earlier.empty() || earlier.size() == count, "earlier", rows);
    archive.require(species.size() == count, "species", rows);
    archive.require(identity.size() == count, "identity", rows);
    archive.requireFinite("translation", translation);
    archive.requireFinite("rotation", rotation);
    archive.requireFinite("acceleration", acceleration);
    archive.requireFinite("earlier", earlier);
    for (const TranslationRecord& grain : translation)
        archive.require(grain.radius > 0 && grain.inverseMass >= 0, "translation",
                        "has a radius or a mass that is not positive");
    for (std::size_t k = 0; k < count; ++k)
        archive.require(identity[k] == k, "identity", "is not 0, 1, 2 ...");
}

}  // namespace pendular
