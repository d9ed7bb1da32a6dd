#include "Kernel/Scene/RankAgreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace pendular {

namespace {

using Entries = std::vector<StateDigest::Entry>;

// Between the parts of an entry, and between entries: names and values have none of these.
constexpr char unitSeparator = '\x1f', recordSeparator = '\x1e';

std::string textOf(const Entries& entries) {
    std::string text;
    for (const StateDigest::Entry& entry : entries)
        text += fmt::format("{}{}{}{}{}{}", entry.name, unitSeparator, entry.value, unitSeparator, entry.hash,
                            recordSeparator);
    return text;
}

/// What comes before the separator; the rest stays in the text.
std::string takeUpTo(char separator, std::string_view& text) {
    const std::size_t end = std::min(text.find(separator), text.size());
    std::string taken(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return taken;
}

Entries entriesOf(std::string_view text) {
    Entries entries;
    while (!text.empty()) {
        StateDigest::Entry entry;
        entry.name = takeUpTo(unitSeparator, text);
        entry.value = takeUpTo(unitSeparator, text);
        entry.hash = std::stoull(takeUpTo(recordSeparator, text));
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// What is different between the first rank and another one.
std::optional<std::string> differenceOf(const Entries& first, const Entries& other, std::size_t rank) {
    const auto isSame = [](const StateDigest::Entry& a, const StateDigest::Entry& b) {
        return a.name == b.name && a.hash == b.hash;
    };
    const auto [a, b] = std::ranges::mismatch(first, other, isSame);
    const bool firstHasIt = a != first.end(), otherHasIt = b != other.end();
    if (!firstHasIt && !otherHasIt) return {};
    if (!firstHasIt || !otherHasIt || a->name != b->name)
        return fmt::format("{} is on rank {} only", firstHasIt ? a->name : b->name, firstHasIt ? 0 : rank);
    if (a->value == b->value)
        return fmt::format("{} on rank {} are others than on rank 0 ({})", a->name, rank, a->value);
    return fmt::format("{} is {} on rank 0 and {} on rank {}", a->name, a->value, b->value, rank);
}

/// Of what must be alike of one grain.
void visitGrain(StateArchive& archive, ParticleStore& grains, std::uint32_t identity) {
    archive.same("identity", identity);
    TranslationRecord& grain = grains.translation[grains.place[identity]];
    archive.same("radius", grain.radius, "m");
    archive.sameRecord<double>("position", grain.position, "m");
    archive.sameRecord<double>("velocity", grain.velocity, "m/s");
    archive.same("mass", 1 / grain.inverseMass, "kg");
    archive.same("species", static_cast<int>(grains.species[grains.place[identity]]));
    if (grains.hasSpin)
        archive.sameRecord<double>("angular velocity", grains.rotation[grains.place[identity]].spin, "rad/s");
    archive.same("held axes", static_cast<int>(grains.heldAt(grains.place[identity]).byte()));
    for (GrainColumn& column : grains.columns)
        archive.same(column.name, column.values[grains.place[identity]], column.unit);
}

std::uint64_t hashOfGrain(ParticleStore& grains, std::uint32_t place) {
    WordHash hash;
    hash.add(std::uint64_t{grains.identity[place]});
    grains.visitRow(place, [&](const auto& value) { hash.add(&value, sizeof value); });
    return hash.value();
}

}  // namespace

std::uint64_t hashOf(const ToAgreeOn& visit, std::size_t largestTable) {
    StateDigest digest(StateDigest::Keep::HashOnly, largestTable);
    StateArchive archive(digest);
    visit(archive);
    return digest.hash();
}

std::uint64_t hashOfGrains(ParticleStore& grains) {
    WordHash hash;
    for (const std::uint32_t place : grains.place) hash.add(hashOfGrain(grains, place));
    std::uint64_t ofBodies = 0;  // a sum: they may be in another order
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        WordHash one;
        one.add(std::uint64_t{grains.bodies.numberOf(k)});
        one.add(&grains.bodies[k], sizeof(RigidBody));
        ofBodies += one.value();
    }
    hash.add(ofBodies);
    return hash.value();
}

std::string differenceOfRanks(GrainSharing& ranks, const ToAgreeOn& visit) {
    StateDigest digest(StateDigest::Keep::Names);
    StateArchive archive(digest);
    visit(archive);
    const std::vector<std::string> all = ranks.textsOfAll(textOf(digest.entries()));
    const Entries first = entriesOf(all[0]);
    for (std::size_t rank = 1; rank < all.size(); ++rank)
        if (const auto difference = differenceOf(first, entriesOf(all[rank]), rank)) return *difference;
    return {};
}

std::string differenceOfGrains(GrainSharing& ranks, ParticleStore& grains) {
    std::uint64_t count = grains.count();
    if (std::string other = differenceOfRanks(
            ranks, [&](StateArchive& archive) { archive.value("the number of particles", count); });
        !other.empty())
        return other;
    std::string own;
    for (const std::uint32_t place : grains.place) {
        const std::uint64_t hash = hashOfGrain(grains, place);
        own.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    }
    const std::vector<std::string> all = ranks.textsOfAll(own);
    std::size_t firstByte = own.size();
    for (const std::string& one : all)
        firstByte = std::min<std::size_t>(
            firstByte, static_cast<std::size_t>(std::ranges::mismatch(all[0], one).in1 - all[0].begin()));
    if (firstByte == own.size()) return "what is kept of rigid bodies is not the same on all ranks";
    auto at = grains.place.begin();
    for (std::size_t k = 0; k < firstByte / sizeof(std::uint64_t); ++k) ++at;
    const std::uint32_t identity = grains.identity[*at];
    const std::string difference = differenceOfRanks(ranks, [&](StateArchive& archive) {
        archive.group(fmt::format("particle {}", identity), [&] { visitGrain(archive, grains, identity); });
    });
    if (!difference.empty()) return difference;
    return fmt::format("the acceleration of particle {} is not the same on all ranks", identity);
}

}  // namespace pendular
