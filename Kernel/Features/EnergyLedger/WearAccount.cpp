#include "Kernel/Features/EnergyLedger/WearAccount.h"

#include <algorithm>

#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

void remember(ParticleStore& grains, std::size_t place) {
    MotionAtStart& start = grains.atStart[place];
    start.velocity = grains.translation[place].velocity;
    if (grains.hasSpin) start.spin = grains.rotation[place].spin;
}

}  // namespace

/// Where images or ranks are, contacts may be listed again for other reasons than how far bodies have come.
void WearAccount::beforeMotion(ParticleStore& grains, const ContactSystem& contacts, int threads) {
    constexpr std::size_t worthAThread = 4096;
    constexpr double growth = 4;  // of shifts from one step to the next; where they grow more: afterMotion()
    grains.remembersStart = true;
    grains.atStart.resize(grains.size());
    remembersAll = listed != contacts.rebuildCount() || contacts.periodicBox().any() ||
                   contacts.ranks().areSeveral() || contacts.isListDueSoon(growth);
    if (remembersAll)
        return inParts(
            grains.size(), threads,
            [&](int, std::size_t first, std::size_t end) {
                for (std::size_t place = first; place < end; ++place) remember(grains, place);
            },
            worthAThread);
    for (const std::uint32_t place : near)
        if (place < grains.size()) remember(grains, place);
}

/// Where a list comes that nobody could foresee, as something was given a much higher speed all at once, a
/// grain that comes to a wall by it has the velocity of the middle of the step for that of its start.
void WearAccount::afterMotion(ParticleStore& grains, const ContactSystem& contacts, double grainShift,
                              double wallShift) {
    if (remembersAll || !contacts.isListDue(grainShift, wallShift)) return;
    std::vector<bool> isKnown(grains.size());
    for (const std::uint32_t place : near)
        if (place < grains.size()) isKnown[place] = true;
    for (std::size_t place = 0; place < grains.size(); ++place)
        if (!isKnown[place]) remember(grains, place);
}

void WearAccount::list(const ParticleStore& grains, const ContactSystem& contacts) {
    if (listed == contacts.rebuildCount()) return;
    listed = contacts.rebuildCount();
    atWalls = contacts.contactsAtWalls(grains);
    near.clear();
    for (const std::uint32_t contact : atWalls) near.push_back(contacts.store().firstOf(contact));
    worn.resize(atWalls.size());
    wears.resize(atWalls.size());
}

void WearAccount::finish(const ParticleStore& grains, ContactSystem& contacts, const WallHandler& walls,
                         double step, int threads) {
    constexpr std::size_t worthAThread = 256, share = 128;
    list(grains, contacts);
    const WearOfStep wear(walls);
    const bool isShaped = contacts.laws().shapes() != nullptr;
    inShares(
        atWalls.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k) wears[k] = 0;
            contacts.forEachRecordAtWalls(
                grains, atWalls, first, end,
                [&](std::size_t k, const Bucket& bucket, const ContactBlock& block, std::size_t lane,
                    EnergyRecord& record) {
                    const BodyMotion grain = meanMotion(grains, block.first[lane]);
                    const ContactKind kind{
                        .isWall = true,
                        .hasCouples = false,
                        .resistsMotion = false,
                        .keepsForce = contacts.laws().ofPair(bucket.species1, bucket.species2).keepsForce,
                        .isShaped = isShaped};
                    if (step > 0 && wear.wears(bucket.wall)) {
                        const double work = slidingWorkAtWall(record, grain, kind, step);
                        if (WearOfStep::isWorn(record, work)) {
                            wears[k] = 1;
                            worn[k] = WearOfStep::of(grains, contacts.periodicBox(), bucket, block, lane,
                                                     record, grain, work);
                        }
                    }
                    takeNowAsLast(record, kind);
                });
        },
        worthAThread, shareOf(share));
    if (!contacts.ranks().areSeveral()) {
        for (std::size_t k = 0; k < worn.size(); ++k)
            if (wears[k] != 0) wear.give(worn[k]);
        return;
    }
    std::vector<WearOfContact> own;
    for (std::size_t k = 0; k < worn.size(); ++k)
        if (wears[k] != 0) own.push_back(worn[k]);
    wear.give(own, contacts.ranks());
}

}  // namespace pendular
