#include "Kernel/Contacts/ContactLiquid.h"

#include "Kernel/Contacts/WakeBlock.h"
#include "Kernel/RunError.h"

namespace pendular {

using Kind = ContactEvent::Kind;

bool ListedLiquid::moves(Number contact) const {
    return rulesOf(contact).largest > 0 || volumeOf(contact) > 0;
}

void ListedLiquid::setVolume(Number contact, Quanta volume) {
    double& held = store.memory.volumeOf(store.slotOf(contact));
    if (held == 0 && volume > 0) formed.push_back(contact);
    held = volumeOfQuanta(volume);
    changed.push_back(contact);
    std::uint8_t& bridged = store.states[contact / Pack::lanes].bridged;
    if (volume > 0) bridged = static_cast<std::uint8_t>(bridged | 1u << contact % Pack::lanes);
}

void ContactLiquid::prepareChanged(ContactStore& store, const ContactLaws& laws,
                                   const ParticleStore& grains) {
    for (const std::uint32_t contact : changed) {
        const std::size_t slot = store.slotOf(contact);
        if (store.memory.volumeOf(slot) == store.memory.preparedVolumeOf(slot)) continue;
        ContactNumbers before{};
        store.memory.interaction.get(slot, before.data());
        prepareAgain(store, laws, store.bucketOf(contact / Pack::lanes), contact, grains, before.data());
    }
    changed.clear();
}

void ContactLiquid::listed(const ContactStore& store, const ContactLaws& laws, std::size_t wallCount) {
    if (!moves()) return;
    walls.resize(std::max(walls.size(), wallCount));
    rules.clear();
    for (const Bucket& bucket : store.buckets)
        rules.emplace_back(laws.liquidRules(bucket.species1, bucket.species2).value_or(LiquidRules{}),
                           filmsOfGrains->quantum());
    changed.clear();
    for (std::size_t slot = Pack::lanes; slot < store.memory.slotCount(); ++slot)
        changed.push_back(store.contactAt(static_cast<std::uint32_t>(slot)));
    anyWetWall = std::ranges::any_of(rules, [](const QuantisedRules& r) { return r.wallDose > 0; });
}

void ContactLiquid::move(ContactStore& store, const ContactLaws& laws, ParticleStore& grains,
                         ContactEvents& events) {
    places.clear(), ruptured.clear(), formed.clear();
    const auto look = [&](const std::vector<std::uint32_t>& identities) {
        for (const std::uint32_t identity : identities)
            if (grains.place.contains(identity)) places.push_back(grains.place[identity]);
    };
    look(looked), look(filmsOfGrains->takeWetted());
    ListedLiquid liquid = of(store, laws, grains);
    for (const ContactChange& change : events.changes()) {
        if (!liquid.moves(change.contact)) continue;
        if (liquid.volumeOf(change.contact) > 0) {
            // A bridge that lasts draws no liquid, whether its grains touch or not.
            if (change.kind == Kind::BridgeRuptures) ruptured.push_back(change.contact);
            continue;
        }
        if (change.kind != Kind::TouchBegins && change.kind != Kind::TouchEnds) continue;
        // Where neither has a film and no wall is wet, there is nothing to draw.
        const auto lookAt = [&](std::uint32_t grain) {
            if (anyWetWall || filmsOfGrains->of(grains, grain) > 0) places.push_back(grain);
        };
        lookAt(liquid.grainOf(change.contact, 0));
        if (!liquid.isAtWall(change.contact)) lookAt(liquid.grainOf(change.contact, 1));
    }
    looked.clear();
    if (places.empty() && ruptured.empty()) return;
    step.run(liquid, ruptured, places);
    remember(grains);
    for (const std::uint32_t contact : formed) events.add(store, contact, grains.identity, Kind::BridgeForms);
    double fromWalls = 0;
    for (const double account : walls) fromWalls += std::max(-account, 0.0);
    if (const auto objection = filmsOfGrains->objectionToMore(fromWalls)) throw RunError(*objection);
}

/// By identity: places change when contacts are listed again.
void ContactLiquid::remember(const ParticleStore& grains) {
    for (const std::uint32_t place : places) looked.push_back(grains.identity[place]);
}

void ContactLiquid::release(ContactStore& store, const ContactLaws& laws, ParticleStore& grains,
                            std::uint32_t contact) {
    if (!moves() || store.slots[contact / Pack::lanes] == ContactStore::asleep) return;
    ListedLiquid liquid = of(store, laws, grains);
    places.clear();
    for (const std::uint32_t which : {0u, 1u})  // a touch ends, too
        if (which == 0 || !liquid.isAtWall(contact)) places.push_back(liquid.grainOf(contact, which));
    if (liquid.volumeOf(contact) > 0) LiquidStep<ListedLiquid>::release(liquid, contact, places);
    remember(grains);
}

void ContactLiquid::clip(ContactStore& store, const ContactLaws& laws, ParticleStore& grains) {
    if (!moves()) return;
    ListedLiquid liquid = of(store, laws, grains);
    places.clear();
    store.forEachListed([&](const Bucket&, std::uint32_t contact) {
        if (!store.acts(contact)) return;
        const Quanta excess = liquid.volumeOf(contact) - liquid.rulesOf(contact).largest;
        if (excess > 0) LiquidStep<ListedLiquid>::release(liquid, contact, places, excess);
    });
    // A lower V_min or a larger V_max lets others form.
    looked.assign(grains.identity.begin(), grains.identity.end());
}

LiquidLedger ContactLiquid::ledger(const ContactStore& store, const ParticleStore& grains) const {
    if (!moves()) return {};
    LiquidLedger found{.films = filmsOfGrains->sum(grains),
                       .removed = filmsOfGrains->removed(),
                       .initial = filmsOfGrains->initial(),
                       .absorbed = filmsOfGrains->absorbed()};
    for (std::size_t slot = 0; slot < store.memory.slotCount(); ++slot)
        found.bridges += store.memory.volumeOf(slot);
    for (const double account : walls) found.walls += account;
    return found;
}

void ContactLiquid::visitState(StateArchive& archive) {
    archive.column<double>("walls", walls);
    archive.requireFinite("walls", walls);
    for (const double account : walls)
        archive.require(filmsOfGrains->isWhole(std::abs(account)), "walls",
                        "has no multiples of the quantum");
    if (archive.isReading()) looked.clear();  // all films count as just set
}

void ContactLiquid::requireWhole(const StateArchive& archive, const ContactStore& store) const {
    for (std::size_t slot = 0; slot < store.memory.slotCount(); ++slot)
        archive.require(filmsOfGrains->isWhole(store.memory.volumeOf(slot)), "numbers",
                        "has the volume of a bridge that is no multiple of the quantum");
}

}  // namespace pendular
