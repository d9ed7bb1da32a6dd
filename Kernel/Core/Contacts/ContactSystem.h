#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/CapillaryWatch.h"
#include "Kernel/Core/Contacts/ContactColumn.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/HeldContacts.h"
#include "Kernel/Core/Contacts/IdleLanes.h"
#include "Kernel/Core/Contacts/ListLife.h"
#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Contacts/OverlapWatch.h"
#include "Kernel/Core/Contacts/PrefetchChoice.h"
#include "Kernel/Core/Contacts/SkinChoice.h"
#include "Kernel/Core/Contacts/WallPointSearch.h"
#include "Kernel/Core/Particles/GrainLoad.h"
#include "Kernel/Core/Particles/NamedColumn.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/ContactEvents/ContactEvents.h"
#include "Kernel/Features/LiquidTransport/ContactLiquid.h"
#include "Kernel/Features/Meshes/WallPatches.h"

namespace pendular {

class GrainSharing;
class RememberedContacts;
enum class GatheredOn;

/// How many contacts of a scene there are.
struct ContactCounts {
    std::size_t touching = 0, bridged = 0;
    std::size_t acting = 0;  // that do one of both
};

/// What was changed between two steps, by places in the present list.
struct ChangedBodies {
    std::vector<bool> grains;  // by place: they were added, or changed in place, size, species or in how held
    int firstNewWall = 0;      // walls from this number on were added
};
/// What follows where contacts have other forces by a change.
struct ChangedContacts {
    double given = 0;                   // J, what is stored in them gained; where a ledger is kept
    std::vector<std::uint32_t> places;  // of grains that have such contacts
};

/// The contacts of a scene: their list, and the forces of a step.
class ContactSystem {
public:
    using Grains = ParticleStore;

    /// Called when species, walls and grains are known.
    /// @param skinChoice contacts are listed again when bodies can have approached by the skin: the sum over
    /// the steps of the largest shifts of two bodies; @param films of the grains, where liquid moves
    void prepare(ContactLaws& contactLaws, const WallHandler& wallHandler, const PeriodicBox& box,
                 const SkinChoice& skinChoice, bool withLedger, GrainFilms* films = nullptr);
    /// The scene is one of several that share their grains: they are distributed where contacts are listed.
    void share(GrainSharing* with);
    /// All grains and contacts come to all ranks, until refresh() distributes them again.
    void gather(Grains& grains);
    /// They come to the first rank alone, which calls the function and drops them again; the others keep
    /// theirs, and wait for it.
    void withAllOnFirst(Grains& grains, const std::function<void()>& look);
    /// What all ranks that share the scene know together; each contact counts on the rank that owns its body
    /// 1.
    [[nodiscard]] const AllRanks& ranks() const { return allRanks; }
    /// Ghosts get the motion, with accelerations, of the grains and bodies that they stand for.
    void renewGhosts(Grains& grains) const;
    /// Ghosts get the numbers of the grains and bodies that they stand for, by their places.
    void tellGhosts(std::span<double> ofGrains, std::span<double> ofBodies) const;
    /// Grains have been added at the end of the store. They are listed when bodies can have approached by the
    /// distance of the nearest of them to all others, so that most need no list of their own. False if one is
    /// so near that contacts must be listed at once, and the first time: lists keep their cells from then on.
    bool takeIn(const Grains& grains, std::span<const std::uint32_t> identities);
    /// Lists contacts again at once, where takeIn() says so.
    void listNow(Grains& grains) { listNow(grains, true); }
    /// Bodies or laws have changed: contacts are listed again at once, and their bridges prepared again, for
    /// the volumes for which they were prepared: what has not changed keeps its bits.
    /// Contacts whose bodies the change takes apart end, also where both bodies are held now, and contacts
    /// whose pair has other laws now, which know nothing of what the contact remembers. Returns the energy
    /// (J) that was stored in what has ended, where a ledger is kept.
    double renew(Grains& grains, bool hasNewLaws);
    /// The forces of contacts whose bodies or laws were changed between two steps, as of now: a body that was
    /// put into another one touches it since before the step. What is stored in these contacts is what they
    /// have now. After renew() or listNow(); the accelerations of grains are left to the caller, those of
    /// rigid bodies and the forces of walls follow.
    /// @param step s, of the step that comes
    ChangedContacts computeChanged(Grains& grains, const ChangedBodies& changed, double step,
                                   ContactTiming timing);
    /// Which contacts of bodies that are held along all axes are listed, from the next list rebuild on.
    void setHeldContacts(HeldContacts which) {
        heldIsNew |= which != heldContacts;
        heldContacts = which;
    }
    [[nodiscard]] HeldContacts getHeldContacts() const { return heldContacts; }
    /// A part of the step needs them: all are listed, unless the scene has None.
    void askForHeldContacts() { partsNeedHeld = true; }
    [[nodiscard]] const ListedOfHeld& listedOfHeld() const { return ofHeld; }
    /// Whether there were grains that are held along all axes, on any rank, when the contacts were listed.
    [[nodiscard]] bool hasHeldGrains() const { return hasHeld; }
    /// Whether contacts of held bodies are needed that are not listed, or the reverse: the same on all ranks
    /// where their settings are the same.
    [[nodiscard]] bool needsOtherHeld(const Grains& grains);
    /// Brings grains back into a periodic scene whose walls have ends that were put outside between two
    /// steps: their contacts at walls go on at what the walls have behind the face. Before renew().
    /// @param places of these grains; @param hasEnds of each wall; @param bringBack changes their positions
    void bringBackPlaced(const Grains& grains, std::span<const std::uint32_t> places,
                         const std::vector<bool>& hasEnds, const std::function<void()>& bringBack);
    /// Ends the contacts of the grain at a place, or at a wall, which is about to be removed; returns the
    /// energy (J) that was stored in them, where a ledger is kept.
    double endContactsOf(Grains& grains, std::uint32_t place);
    double endContactsAtWall(Grains& grains, int wall);
    /// On several ranks new grains come to all of them, between these two calls, and stay where they belong:
    /// ghosts go before, and contacts are listed again.
    void beginArrival(Grains& grains);
    [[nodiscard]] bool isArriving() const { return arriving != nullptr; }
    void finishArrival(Grains& grains);
    /// How many grains have come so since this was called last.
    [[nodiscard]] std::size_t takeArrived() { return std::exchange(arrived, 0); }
    /// On several ranks grains go from all of them, in the same order: of each, beginRemoval() with its place
    /// in this order, then the removal of the grain itself or of its ghost. What walls lose by it they lose
    /// on all ranks.
    void beginRemoval(std::uint32_t number) { removal = number; }
    [[nodiscard]] bool isRemoving() const { return removal.has_value(); }
    /// @param stored J, as endContactsOf() gives it
    void noteEnded(double stored) { lost.push_back({.removal = *removal, .energy = stored}); }
    /// Removes the ghost of a grain, or of a rigid body with all of its grains, if it is here.
    /// @param body its number, or RigidBodies::none
    void removeGhost(Grains& grains, std::uint32_t identity, std::uint32_t body);
    /// Returns the energies (J) that were stored in contacts of the grains that have gone, in their order.
    std::vector<double> finishRemovals(const Grains& grains);
    /// Finds the starts and ends of touches and bridges in each step from now on.
    void listen(bool on) { contactEvents.listen(on); }
    [[nodiscard]] const ContactEvents& events() const { return contactEvents; }
    /// Takes note of how far grains and walls have moved in a step (the farthest of each, m), and lists the
    /// contacts again where it is time; says whether it did.
    bool refresh(Grains& grains, double grainShift, double wallShift);
    /// Sees to it that all bodies are listed whose surfaces are not farther apart than the reach (m).
    void listWithin(Grains& grains, double reach);
    /// Brings grains back into a periodic scene whose walls have ends: contacts at walls go on at what the
    /// walls have behind the face. After refresh(), at the same places of the grains. Returns the energy (J)
    /// that was stored in contacts that have ended by it, where a ledger is kept.
    /// @param places of these grains; @param hasEnds of each wall; @param bringBack changes their positions
    double goThroughFaces(Grains& grains, std::span<const std::uint32_t> places,
                          const std::vector<bool>& hasEnds, double time,
                          const std::function<void()>& bringBack);
    /// Visits what contacts remember, by who they join: how they are listed is not kept. It is called after
    /// prepare(); the species, the walls and the grains are visited by themselves, before.
    void visitState(StateArchive& archive, Grains& grains);
    /// The smallest radius (m) of all grains; it may have changed since prepare().
    void setSmallestRadius(double radius) { skin.setSmallestRadius(radius); }
    /// Threads for the forces; the results do not depend on it.
    void setThreads(int count) { threads = count; }
    /// Bytes of the cache that this scene has; results do not depend on it.
    void setCache(std::size_t bytes) { cache = bytes; }

    /// Joins all bodies of the scene by bridges that are within their range and not farther apart than the
    /// gap (m), where bridges begin with a touch and their volume is constant. After the first list.
    void join(Grains& grains, double gap);

    /// The force records of all contacts, for grains at the end of a step (s) with their predicted
    /// velocities.
    void computeForces(const Grains& grains, double step, ContactTiming timing = {}) {
        computePairForces(grains, step, timing);
        computeWallForces(grains, step, timing);
    }
    /// The first half of computeForces(): grains with grains.
    void computePairForces(const Grains& grains, double step, ContactTiming timing = {});
    /// The second half of computeForces(): grains with walls.
    void computeWallForces(const Grains& grains, double step, ContactTiming timing = {});

    /// Gives a wall the sum of the forces of the last step.
    void sumForcesOn(const Grains& grains, std::size_t wall);
    /// Sums the forces again on walls that are moved by forces, where contacts have ended since then:
    /// exactly, so that a restart makes the same sum.
    void sumLostForces(const Grains& grains);

    /// Called after the forces of a step (s) that ends at a time (s), in a scene in which liquid moves.
    void moveLiquid(Grains& grains, double time, double length);
    void setEvaporation(const Evaporation& law) { liquid.setEvaporation(law); }
    [[nodiscard]] const ContactLiquid& movingLiquid() const { return liquid; }
    [[nodiscard]] ContactLiquid& movingLiquid() { return liquid; }
    /// The energy (J) that changes of the volumes of bridges have given to them since this was called last.
    [[nodiscard]] LiquidEnergy takeLiquidEnergy() { return liquid.takeEnergy(); }
    [[nodiscard]] bool movesLiquid() const { return liquid.moves(); }
    [[nodiscard]] LiquidLedger liquidLedger(const Grains& grains) const {
        return liquid.ledger(contacts, grains);
    }
    /// m^3, what a wet wall has got back minus what it gave.
    [[nodiscard]] double liquidOfWall(std::size_t wall) const { return liquid.ofWall(wall); }

    [[nodiscard]] const ContactStore& store() const { return contacts; }
    /// @throw InputError before prepare()
    [[nodiscard]] const ContactLaws& laws() const {
        if (!species) throwWithoutLaws();
        return *species;
    }
    [[nodiscard]] const PeriodicBox& periodicBox() const { return periodic; }
    /// Takes the box after the images have moved, in shear and strain.
    void setPeriodicBox(const PeriodicBox& box) { periodic = box; }
    /// m, the gap at which films meet, for which contacts were listed
    [[nodiscard]] double filmReach() const { return std::max(filmsReach, largestFilmContactGap()); }
    /// The memory (bytes) that the contacts take.
    [[nodiscard]] std::size_t bytes() const { return contacts.bytes(); }
    [[nodiscard]] std::size_t rebuildCount() const { return rebuilds; }
    /// The overlaps of all contacts since the scene began; on several ranks those of all, which call this
    /// together.
    [[nodiscard]] OverlapWatch overlaps() const;
    /// Those that this rank has seen.
    [[nodiscard]] const OverlapWatch& ownOverlaps() const { return overlapWatch; }
    /// Takes the largest overlap to come, over the effective radius: see OverlapWatch::expect().
    void expectOverlaps(double largest) { overlapWatch.expect(largest); }
    /// On several ranks of all, as overlaps().
    [[nodiscard]] CapillaryWatch capillaryNumbers() const;

    // Of the last step.
    /// On several ranks those of all, which call this together.
    [[nodiscard]] ContactCounts counts() const;
    [[nodiscard]] bool touches(std::size_t contact) const { return contacts.touches(contact); }
    [[nodiscard]] bool isBridged(std::size_t contact) const { return contacts.isBridged(contact); }
    [[nodiscard]] bool acts(std::size_t contact) const { return contacts.acts(contact); }
    /// N, on its first grain
    [[nodiscard]] Vector<double> forceOf(std::size_t contact) const { return contacts.forceOf(contact); }
    /// N, repulsion positive
    [[nodiscard]] double normalForceOf(std::size_t contact) const { return contacts.normalForceOf(contact); }
    /// The place of its first grain, and of its second one; at a wall, the part of it.
    [[nodiscard]] std::uint32_t firstOf(std::size_t contact) const { return contacts.firstOf(contact); }
    [[nodiscard]] std::uint32_t secondOf(std::size_t contact) const { return contacts.secondOf(contact); }
    /// What contacts remember.
    [[nodiscard]] const ContactLayout& layout() const { return contacts.memory.getLayout(); }

    /// Calls function(bucket, contact) for each pair that is near enough to be listed, whether it acts or
    /// not, in the order of the list.
    template <class Function>
    void forEachListed(Function&& function) const {
        contacts.forEachListed(function);
    }
    /// Calls function(bucket, contact) for each contact that has a force, in the order of identities: of body
    /// 1, then of body 2, then walls by number and part. On several ranks, each calls it for those whose body
    /// 1 it owns.
    template <class Function>
    void forEachActing(const Grains& grains, Function&& function) const {
        forEachWithMemory(grains, [&](std::uint32_t slot) { callIfActing(slot, function); });
    }

    /// Calls function(bucket, contact) for each contact of the grain at a place that has a force, in the
    /// order of its partners.
    template <class Function>
    void forEachActingOf(std::uint32_t place, Function&& function) const {
        for (const std::uint32_t side : sidesOf(place)) callIfActing(side / 2, function);
    }

    /// How many records of energy there are, where there is an account.
    [[nodiscard]] std::size_t energyRecordCount() const { return contacts.memory.slotCount(); }
    /// Calls function(bucket, block, lane, record) for each contact that acts, or did at the end of the last
    /// step, also where it counts on another rank, as they lie in memory.
    /// @param first, end of the records that are visited: several threads may visit some each
    template <class Function>
    void forEachEnergyRecord(const Grains& grains, std::size_t first, std::size_t end, Function&& function) {
        constexpr std::size_t ahead = 8;
        for (std::size_t slot = std::max<std::size_t>(first, Pack::lanes); slot < end; ++slot) {
            if (slot + ahead < end) prefetchRecord(grains, static_cast<std::uint32_t>(slot + ahead));
            visitRecord(grains, static_cast<std::uint32_t>(slot), function);
        }
    }
    /// The same in the order of identities, and then those of other ranks.
    template <class Function>
    void forEachEnergyRecordInOrder(const Grains& grains, Function&& function) {
        forEachWithMemory(grains, [&](std::uint32_t slot) { visitRecord(grains, slot, function); });
        for (std::uint32_t slot = Pack::lanes; slot < contacts.memory.slotCount(); ++slot)
            if (contacts.firstOf(contacts.contactAt(slot)) >= grains.ownSize())
                visitRecord(grains, slot, function);
    }

    /// The liquid (m^3) of the bridges of the grain at a place: half of each to another grain, all of one to
    /// a wall.
    [[nodiscard]] double liquidAt(const Grains& grains, std::uint32_t place) const;

    /// A number of the driver's own that is kept of each contact from its first touch (or bridge) until it
    /// neither touches nor is bridged. Returns the column's number. Before prepare(). Throws InputError for a
    /// name that is there already.
    std::size_t addColumn(const NamedColumn& column);
    [[nodiscard]] const std::vector<NamedColumn>& columns() const { return namedColumns; }
    /// The value in a column for a contact as it was observed. Throws InputError if contacts have been listed
    /// again since then.
    [[nodiscard]] double& columnOf(const ObservedContact& seen, std::size_t column);
    [[nodiscard]] double columnOf(const ObservedContact& seen, std::size_t column) const;

    /// A number that the adhesion law of a contact remembers, as for columnOf().
    [[nodiscard]] double& adhesionNumberOf(const ObservedContact& seen, std::size_t number);
    /// Sets what the friction law, or the normal law, of a contact remembers, as for columnOf(): the numbers
    /// of its History.
    void setFrictionHistory(const ObservedContact& seen, const std::vector<double>& numbers);
    void setNormalHistory(const ObservedContact& seen, const std::vector<double>& numbers);

    [[nodiscard]] ObservedContact observe(const Grains& grains, const Bucket& bucket,
                                          std::uint32_t contact) const;
    /// The sum over the contacts of the grain at a place, of the last step, also of one that is held.
    [[nodiscard]] GrainLoad loadOn(const Grains& grains, std::uint32_t place) const;
    /// The length (m) of the tangential spring.
    [[nodiscard]] double springLength(std::uint32_t contact) const;

    /// Where an account is kept for the wear of walls alone, contacts with walls have samples, and others do
    /// not: of all walls, as a contact may go over from one to another.
    void sampleWallsAlone() {
        samplesPairs = false;
        contacts.memory.energies.makeSparse();
    }
    /// The listed contacts with walls, in the order of identities: of the grain, the wall and its part.
    [[nodiscard]] std::vector<std::uint32_t> contactsAtWalls(const Grains& grains) const;
    /// Calls function(k, bucket, block, lane, record) for those of the contacts [begin, end) at walls that
    /// have a force, or had one at the end of the last step.
    /// @param atWalls those of contactsAtWalls(), as of the same list
    template <class Function>
    void forEachRecordAtWalls(const Grains& grains, std::span<const std::uint32_t> atWalls, std::size_t begin,
                              std::size_t end, Function&& function) {
        constexpr std::size_t ahead = 4;
        for (std::size_t k = begin; k < end; ++k) {
            if (k + ahead < end) prefetchAtWall(grains, atWalls[k + ahead]);
            const std::uint32_t slots = contacts.slots[atWalls[k] / Pack::lanes];
            if (slots == ContactStore::asleep || slots == ContactStore::waking) continue;
            const auto withNumber = [&](const Bucket& bucket, const ContactBlock& block, std::size_t lane,
                                        EnergyRecord& record) { function(k, bucket, block, lane, record); };
            visitRecord(grains, static_cast<std::uint32_t>(contacts.slotOf(atWalls[k])), withNumber);
        }
    }

    /// Whether refresh() may list again with such shifts (m), as bodies may have come near each other.
    [[nodiscard]] bool isListDue(double grainShift, double wallShift) const {
        return isListDueAfter(approachBy(grainShift, wallShift));
    }
    /// Whether it may in a step with shifts so many times as large as those of the last one.
    [[nodiscard]] bool isListDueSoon(double times) const { return isListDueAfter(times * lastApproach); }

private:
    /// Asks for what the account reads of a contact: it lies all over the memory.
    [[gnu::always_inline]] void prefetchRecord(const Grains& grains, std::uint32_t slot) const {
        const EnergyRecord& record = contacts.memory.energies[slot];
        prefetch<true>(static_cast<const CoreSample*>(&record.now), sizeof(CoreSample));
        prefetch<true>(static_cast<const CoreSample*>(&record.last), sizeof(CoreSample));
        const std::uint32_t contact = contacts.contactAt(slot);
        const std::size_t b = contact / Pack::lanes, lane = contact % Pack::lanes;
        for (const std::uint32_t grain : {contacts.blocks[b].first[lane], contacts.blocks[b].second[lane]}) {
            if (grain >= grains.size()) continue;  // the part of a wall
            prefetch(&grains.atStart[grain], sizeof(MotionAtStart));
            prefetch(&grains.translation[grain], sizeof(TranslationRecord));
            if (grains.hasSpin) prefetch(&grains.rotation[grain], sizeof(RotationRecord));
        }
    }
    /// The same of a contact with a wall, of which the account for the wear of walls reads no more.
    [[gnu::always_inline]] void prefetchAtWall(const Grains& grains, std::uint32_t contact) const {
        const EnergyRecord& record = contacts.memory.energies[contacts.slotOf(contact)];
        prefetch<true>(&record.now, sizeof(CoreSample) + sizeof(WallSample));
        prefetch<true>(&record.last, sizeof(CoreSample) + sizeof(WallSample));
        const std::uint32_t grain = contacts.firstOf(contact);
        prefetch(&grains.atStart[grain], sizeof(MotionAtStart));
        prefetch(&grains.translation[grain], sizeof(TranslationRecord));
        if (grains.hasSpin) prefetch(&grains.rotation[grain], sizeof(RotationRecord));
    }
    template <class Function>
    void visitRecord(const Grains& grains, std::uint32_t slot, Function& function) {
        // Several threads visit contacts of one block: reading must not give it memory.
        const EnergyRecord& seen = std::as_const(contacts.memory.energies)[slot];
        if (!seen.now.acts() && !seen.last.acts()) return;
        EnergyRecord& record = contacts.memory.energies[slot];
        const std::uint32_t contact = contacts.contactAt(slot);
        const std::size_t b = contact / Pack::lanes;
        const Bucket& bucket = contacts.bucketOf(b);
        if (bucket.wall >= 0) showWallMotion(grains, bucket, contact, record);
        function(bucket, contacts.blocks[b], contact % Pack::lanes, record);
    }
    [[nodiscard]] bool hasSamples(const Bucket& bucket) const {
        return ledger && (samplesPairs || bucket.wall >= 0);
    }
    void chooseQuantum(const Grains& grains);
    /// m, by which two bodies can approach in a step with these largest shifts (m).
    static double approachBy(double grainShift, double wallShift) {
        return grainShift + std::max(grainShift, wallShift);
    }
    [[nodiscard]] bool isListDueAfter(double approach) const {
        return unlisted + approach >= listBefore || approach >= life.rest();
    }
    [[nodiscard]] const Wall& wallOf(const Bucket& bucket) const {
        return walls->getObject(static_cast<std::size_t>(bucket.wall));
    }
    /// The motion of a wall in the step, for the account of the energy.
    void showWallMotion(const Grains& grains, const Bucket& bucket, std::uint32_t contact,
                        EnergyRecord& record) const;
    /// Whether its contacts count on this rank: their body 1 is no ghost (ContactList lists them by
    /// themselves).
    [[nodiscard]] bool countsHere(const Bucket& bucket) const {
        return contacts.firstOf(std::size_t{bucket.begin} * Pack::lanes) < ownPlaces;
    }
    [[nodiscard]] std::size_t slotOf(const ObservedContact& seen) const;
    /// None of a grain that came after the list.
    [[nodiscard]] std::span<const std::uint32_t> sidesOf(std::uint32_t place) const {
        if (place >= contacts.sides.grainCount()) return {};
        return contacts.sidesOf(place);
    }
    /// Calls function(place in the memory) for each contact with memory, in the order of identities: of body
    /// 1, then of body 2.
    template <class Function>
    void forEachWithMemory(const Grains& grains, Function&& function) const {
        for (const std::uint32_t place : grains.place)
            for (const std::uint32_t side : sidesOf(place))
                if (side % 2 == 0) function(side / 2);  // the contact is that of its first body
    }
    template <class Function>
    void callIfActing(std::uint32_t slot, Function& function) const {
        const std::uint32_t contact = contacts.contactAt(slot);
        if (contacts.acts(contact)) function(contacts.bucketOf(contact / Pack::lanes), contact);
    }
    void listNow(Grains& grains, bool keepsBridges);
    /// @param shares the grains are distributed over the ranks, which had all of them
    void listAgain(Grains& grains, bool keepsBridges = true, double reach = 0, bool shares = false);
    /// Lists contacts again, with remembered ones whose memory is in the store; returns how many of these are
    /// listed again.
    std::size_t listAgain(Grains& grains, const RememberedContacts& remembered, bool keepsBridges = true,
                          double reach = 0);
    [[nodiscard]] double halfLifeOfList() const;
    /// Whether idle lanes cost more than a new list, on any rank.
    [[nodiscard]] bool newListPays();
    void listedOnRanks(Grains& grains);
    /// Grains go to the ranks that own them, with what their contacts remember.
    void distribute(Grains& grains, RememberedContacts& remembered, double reach);
    /// With what the contacts remember.
    void gatherGrains(Grains& grains, RememberedContacts& remembered, GatheredOn where);
    [[nodiscard]] RememberedContacts takeRemembered(const Grains& grains);
    void gatherCounts();
    void leaveCountsToFirstRank();
    double endContact(Grains& grains, std::uint32_t contact);
    void tellFilms(Grains& grains) const;
    void loseForce(int wall, const Vector<double>& force) const;
    /// The accelerations of its bodies, and of the rigid bodies that they are part of, gain or lose the force
    /// of a contact that is changed or ends between two steps: what acts in the first half of the next one.
    /// @param share 1 or -1
    void changeForce(Grains& grains, const Bucket& bucket, std::uint32_t contact, double share) const;
    void renewHeldMasses(const Grains& grains);
    [[nodiscard]] static bool areHeldAmong(const Grains& grains);
    [[nodiscard]] ListedOfHeld askedOfHeld() const;
    void computeAmong(const Grains& grains, const std::vector<bool>& isChanged, double step,
                      ContactTiming timing);
    void noteChangedLaws();
    [[nodiscard]] std::vector<bool> contactsOf(const ChangedBodies& changed) const;
    [[nodiscard]] bool lastsThroughChange(const Grains& grains, const Bucket& bucket, std::uint32_t contact,
                                          const ListedOfHeld& asked) const;
    void checkGap(const Grains& grains, const Bucket& bucket, std::uint32_t contact);
    /// m, the largest gap at which bridges of a fixed volume form.
    [[nodiscard]] double largestFilmContactGap() const;
    [[nodiscard]] double gapAround(const Grains& grains, std::size_t number) const;
    [[nodiscard]] std::size_t firstWallBucket() const;
    struct ComputedBy {
        OverlapWatch* overlaps;
        CapillaryWatch* capillaryNumbers;
        OwnTotals totals;
        double springsAhead = 0;  // s, as of ContactTask
    };
    /// Of a bucket; false if one needs memory first.
    bool computeBlocks(const Grains& grains, double step, ContactTiming timing, std::size_t bucket,
                       std::size_t begin, std::size_t end, const ComputedBy& by);
    void compute(const Grains& grains, double step, ContactTiming timing, std::size_t first, std::size_t end);
    /// computePairForces() without what comes before, with or without prefetches.
    void computePairs(const Grains& grains, double step, ContactTiming timing);
    void computeBucket(const Grains& grains, double step, ContactTiming timing, std::size_t number);
    void wake(std::size_t block, const Bucket& bucket, const Grains& grains);
    /// @param handsOver contacts go on at the part of the wall that stands for theirs
    void findWallPoints(const Grains& grains, const Bucket& bucket, double step, bool handsOver = true);
    /// Finds the points at all walls, of which one may stand for another: what is one contact is left once.
    void findWallPoints(const Grains& grains, double step, bool handsOver = true);
    void sumWallForces(const Grains& grains);

    [[noreturn]] static void throwWithoutLaws();

    ContactLaws* species = nullptr;
    const WallHandler* walls = nullptr;
    PeriodicBox periodic;
    ContactStore contacts;
    std::vector<NamedColumn> namedColumns;
    SkinChoice skin;
    IdleLanes idleLanes;
    std::size_t stepsListed = 0;   // since the contacts were listed
    double unlisted = infinity;    // m, that two bodies can have approached since contacts were listed
    double lastApproach = 0;       // m, of it in the last step
    double filmsReach = 0;         // m, of films that meet, for which contacts were listed
    double listBefore = infinity;  // m, at which they must be listed, because of grains that came later
    struct Sphere {
        Vector<double> position;
        double radius;
    };
    std::vector<std::uint32_t> late;  // identities of grains that came after the list
    std::vector<Sphere> lateSpheres;  // these grains, when takeIn() looks at them
    bool takesInGrains = false;       // and keeps the cells for it
    float lastStep = 0;               // s
    std::optional<NeighbourSearch> cells;
    std::vector<std::uint32_t> passed;  // places of grains whose contacts are no longer in their order
    bool ledger = false;
    bool samplesPairs = true;         // where there is an account: of grains with grains
    GrainSharing* sharing = nullptr;  // null: this scene has all grains
    AllRanks allRanks;
    /// What a wall, or the account of the energy, has lost by a grain that has gone.
    struct Lost {
        std::uint32_t removal;
        int wall = -1;                  // -1: energy
        Vector<double> force{0, 0, 0};  // N, on the wall
        double energy = 0;              // J
    };
    std::shared_ptr<RememberedContacts> arriving;  // while grains come
    std::uint32_t firstToCome = 0;                 // identity
    std::size_t arrived = 0;
    std::optional<std::uint32_t> removal;  // that is under way
    mutable std::vector<Lost> lost;
    std::size_t ownPlaces = ~std::size_t{0};  // a grain beyond these is a ghost
    double rangeOfAll = 0;                    // m, the largest of two grains on whatever ranks
    int threads = 1;
    std::size_t cache = 0;  // bytes
    PrefetchChoice prefetching;
    bool asksAhead = false;  // in this step
    std::size_t rebuilds = 0;
    WallPointSearch wallPoints;
    WallPatches wallPatches;
    OverlapWatch overlapWatch;
    ContactEvents contactEvents;
    ContactLiquid liquid;
    CapillaryWatch capillaryWatch;
    std::vector<OverlapWatch> watches;  // of each thread
    std::vector<CapillaryWatch> capillaryWatches;
    HeldContacts heldContacts = HeldContacts::WhereAsked;
    bool partsNeedHeld = false, heldIsNew = false;
    bool hasHeld = false;            // some grain is held, or was since the list; on ranks: since set-up
    ListedOfHeld ofHeld;             // in the present list
    std::vector<double> heldMasses;  // kg, of all grains; none where no contacts of held ones are
    // As noteChangedLaws() found them last, by pairs of species (in both orders): the fields that are set of
    // a species, as the pair with itself, and of a pair that has values of its own; other pairs have none.
    std::vector<std::vector<double>> lawValues;
    // Since computeChanged() was called last:
    std::vector<bool> changedPairs;  // by pairs of species, as lawValues: whether their laws are others
    std::vector<bool> changedWalls;  // that have another species
    ListLife life;                   // of the list
};

}  // namespace pendular
