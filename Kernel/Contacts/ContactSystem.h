#pragma once

#include <algorithm>
#include <atomic>
#include <vector>

#include "Kernel/Contacts/ContactKernel.h"
#include "Kernel/Contacts/ContactList.h"
#include "Kernel/Contacts/ObservedContact.h"
#include "Kernel/Contacts/OverlapWatch.h"
#include "Kernel/Contacts/SkinChoice.h"
#include "Kernel/Contacts/StoredContacts.h"
#include "Kernel/Contacts/WallContacts.h"
#include "Kernel/Contacts/WallPointSearch.h"
#include "Kernel/Parallel.h"
#include "Kernel/Species/DomainLimit.h"

namespace pendular {

/// The contacts of a scene: their list, and the forces of a step.
template <class S>
class ContactSystem {
public:
    using Grains = ParticleStore<S::hasTorque>;

    /// To be called when species, walls and grains are known.
    /// @param skinChoice contacts are listed anew when bodies can have approached by the skin: the sum over
    /// the steps of the largest shifts of two bodies
    void prepare(const SpeciesHandler<S>& speciesHandler, const WallHandler& wallHandler,
                 const PeriodicBox& box, const SkinChoice& skinChoice, bool withLedger) {
        periodic = box;
        species = &speciesHandler;
        walls = &wallHandler;
        skin = skinChoice;
        ledger = withLedger;
        unlisted = infinity;
        overlapWatch = OverlapWatch(overlapLimit<typename S::Mixed>().largest);
    }

    /// Takes note of how far grains and walls have moved in a step (the farthest of each, m), and lists the
    /// contacts anew where it is time; says whether it did.
    bool refresh(Grains& grains, double grainShift, double wallShift) {
        unlisted += grainShift + std::max(grainShift, wallShift);
        ++stepsListed;
        const bool sameBodies = listedGrains == grains.size() && listedWalls == walls->getSize();
        if (sameBodies && unlisted < skin.width()) return false;
        if (rebuilds > 0) skin.choose(unlisted, stepsListed);
        ContactList<S>(*species, *walls, periodic, skin.width(), ledger, threads).rebuild(grains, contacts);
        skin.listed(contacts, grains.size());
        stepsListed = 0;
        listedGrains = grains.size();
        listedWalls = walls->getSize();
        prepareLaws();
        unlisted = 0;
        ++rebuilds;
        return true;
    }

    /// After prepare(); the species, the walls and the grains are visited by themselves, before.
    void visitState(StateArchive& archive, const Grains& grains) {
        contacts.visitState(archive);
        archive.record<double>("skin", skin);
        archive.value("stepsListed", stepsListed);
        archive.value("listedGrains", listedGrains);
        archive.value("listedWalls", listedWalls);
        archive.value("unlisted", unlisted);
        archive.value("rebuilds", rebuilds);
        archive.group("overlap", [&] { overlapWatch.visitState(archive); });
        if (!archive.isReading()) return;
        archive.require(skin.isPossible(), "skin", "is not that of a list of contacts");
        archive.require(unlisted >= 0, "unlisted", "is negative or not a number");
        archive.require(listedGrains <= grains.size(), "listedGrains", "is above the number of grains");
        archive.require(listedWalls <= walls->getSize(), "listedWalls", "is above the number of walls");
        StoredContacts<S>(contacts, species->getSize(), listedGrains, *walls, listedWalls)
            .require(archive, ledger);
        prepareLaws();
        sumWallForces(grains);  // also those that the run of the file did not keep
    }

    /// Threads for the forces; the results do not depend on it.
    void setThreads(int count) { threads = count; }

    /// The force records of all contacts, for grains at the end of a step (s) with their predicted
    /// velocities.
    void computeForces(const Grains& grains, double step, ContactTiming timing = {}) {
        computePairForces(grains, step, timing);
        computeWallForces(grains, step, timing);
    }
    /// The first half of it: grains with grains.
    void computePairForces(const Grains& grains, double step, ContactTiming timing = {}) {
        compute(grains, step, timing, 0, firstWallBucket());
    }
    /// The second half of it.
    void computeWallForces(const Grains& grains, double step, ContactTiming timing = {}) {
        compute(grains, step, timing, firstWallBucket(), contacts.buckets.size());
        sumWallForces(grains);
    }

    [[nodiscard]] const ContactStore<S>& store() const { return contacts; }
    [[nodiscard]] const PeriodicBox& periodicBox() const { return periodic; }
    /// Of memory that the contacts take.
    [[nodiscard]] std::size_t bytes() const { return contacts.bytes(); }
    [[nodiscard]] std::size_t rebuildCount() const { return rebuilds; }
    /// Of all contacts since the scene began.
    [[nodiscard]] const OverlapWatch& overlaps() const { return overlapWatch; }

    /// Calls function(bucket, block, lane, record) for each contact that acts, or did at the end of the last
    /// step, in the order of the list. Only where a ledger is kept.
    template <class Function>
    void forEachEnergyRecord(Function&& function) {
        contacts.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            const std::size_t b = c / Pack::lanes, lane = c % Pack::lanes;
            if (contacts.slots[b] == ContactStore<S>::asleep) return;
            EnergyRecord& record = contacts.memory.energies[contacts.slotOf(c)];
            if (!record.now.acts() && !record.last.acts()) return;
            if (bucket.wall >= 0) {
                record.now.wallVelocity = contacts.wallPoints[b - contacts.firstWallBlock()].velocityAt(lane);
                record.now.wallSpin = wallOf(bucket).angularVelocity();
            }
            function(bucket, contacts.blocks[b], lane, record);
        });
    }

    [[nodiscard]] ObservedContact observe(const Grains& grains, const Bucket& bucket,
                                          std::uint32_t contact) const {
        const Wall* wall = bucket.wall < 0 ? nullptr : &wallOf(bucket);
        return observeContact(contacts, grains, periodic, bucket, wall, contact);
    }

private:
    [[nodiscard]] const Wall& wallOf(const Bucket& bucket) const {
        return walls->getObject(static_cast<std::size_t>(bucket.wall));
    }
    /// Buckets of walls come last.
    [[nodiscard]] std::size_t firstWallBucket() const {
        const auto atWall = [](const Bucket& bucket) { return bucket.wall >= 0; };
        return static_cast<std::size_t>(std::ranges::find_if(contacts.buckets, atWall) -
                                        contacts.buckets.begin());
    }
    void compute(const Grains& grains, double step, ContactTiming timing, std::size_t first,
                 std::size_t end) {
        for (std::size_t k = first; k < end; ++k)
            if (ledger) computeBucket<true>(grains, step, timing, k);
            else computeBucket<false>(grains, step, timing, k);
    }
    template <bool withLedger>
    void computeBucket(const Grains& grains, double step, ContactTiming timing, std::size_t number) {
        const TranslationRecord* translation = grains.translation.data();
        const RotationRecord* rotation = grains.rotation.data();
        const Bucket& bucket = contacts.buckets[number];
        const ContactKernel<S, withLedger> kernel(laws[number], step, timing, overlapWatch, contacts);
        const auto pairOf = [&]<bool isPeriodic>(std::size_t b) {
            return PairGeometry<S, isPeriodic>(translation, rotation, contacts.blocks[b], periodic);
        };
        if (bucket.wall >= 0) {
            findWallPoints(grains, bucket, step);
            const Vector<double> spin = wallOf(bucket).angularVelocity();
            computeBlocks(grains, bucket, kernel, [&, first = contacts.firstWallBlock()](std::size_t b) {
                return WallGeometry<S>(translation, rotation, contacts.blocks[b],
                                       contacts.wallPoints[b - first], spin);
            });
        } else if (periodic.any()) {
            computeBlocks(grains, bucket, kernel,
                          [&](std::size_t b) { return pairOf.template operator()<true>(b); });
        } else {
            computeBlocks(grains, bucket, kernel,
                          [&](std::size_t b) { return pairOf.template operator()<false>(b); });
        }
    }
    /// Blocks are independent: each writes only its own memory and records.
    template <class Kernel, class GeometryOf>
    void computeBlocks(const Grains& grains, const Bucket& bucket, const Kernel& kernel,
                       const GeometryOf& geometryOf) {
        std::atomic<bool> allHaveMemory = true;
        watches.assign(static_cast<std::size_t>(threads), overlapWatch.part());
        inParts(bucket.end - bucket.begin, threads, [&](int part, std::size_t begin, std::size_t end) {
            Kernel own = kernel;
            bool all = true;
            for (std::size_t b = bucket.begin + begin; b < bucket.begin + end; ++b)
                if (contacts.slots[b] != ContactStore<S>::asleep || unlisted > contacts.gaps[b])
                    all &= own.computeBlock(b, geometryOf(b));
            if (!all) allHaveMemory = false;
            watches[static_cast<std::size_t>(part)] = own.overlaps;
        });
        for (const OverlapWatch& watch : watches) overlapWatch.add(watch);
        if (allHaveMemory) return;
        Kernel last = kernel;
        for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
            if (contacts.slots[b] != ContactStore<S>::waking) continue;
            wake(b, bucket, grains);
            last.computeBlock(b, geometryOf(b));
        }
        overlapWatch.add(last.overlaps);
    }

    void wake(std::size_t block, const Bucket& bucket, const Grains& grains) {
        wakeBlock(contacts, block, bucket, species->mixture(bucket.species1, bucket.species2), grains);
        const auto contactOf = [&](std::uint32_t slot) { return contacts.contactAt(slot); };
        for (std::uint32_t lane = 0; lane < Pack::lanes; ++lane) {
            if (!contacts.bitOf(contacts.states[block].listed, lane)) continue;
            const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
            const auto slot = static_cast<std::uint32_t>(contacts.slotOf(contact));
            contacts.sides.wake(contacts.blocks[block].first[lane], contact, 0, slot, contactOf);
            if (bucket.wall < 0)
                contacts.sides.wake(contacts.blocks[block].second[lane], contact, 1, slot, contactOf);
        }
    }

    void findWallPoints(const Grains& grains, const Bucket& bucket, double step) {
        wallPoints.find(contacts, grains, bucket, wallOf(bucket),
                        species->mixture(bucket.species1, bucket.species2), step, threads,
                        [&](std::size_t block) { wake(block, bucket, grains); });
    }
    void sumWallForces(const Grains& grains) {
        for (std::size_t w = 0; w < walls->getSize(); ++w) {
            Wall& wall = walls->getObject(w);
            if (!wall.keepsForces()) continue;
            WallForce sum{.about = toVector(wall.getTorquePoint())};
            for (const Bucket& bucket : contacts.buckets)
                if (bucket.wall == static_cast<int>(w)) addWallForces(contacts, bucket, grains, sum);
            wall.setForce(sum.force, sum.torque);
        }
    }

    void prepareLaws() {
        laws.clear();
        for (const Bucket& bucket : contacts.buckets)
            laws.emplace_back(species->mixture(bucket.species1, bucket.species2));
    }

    const SpeciesHandler<S>* species = nullptr;
    const WallHandler* walls = nullptr;
    PeriodicBox periodic;
    ContactStore<S> contacts;
    std::vector<PreparedLaws<S>> laws;  // of each bucket
    SkinChoice skin;
    std::size_t stepsListed = 0;  // since the contacts were listed
    std::size_t listedGrains = 0, listedWalls = 0;
    double unlisted = infinity;  // m, that two bodies can have approached since contacts were listed
    bool ledger = false;
    int threads = 1;
    std::size_t rebuilds = 0;
    WallPointSearch<S> wallPoints;
    OverlapWatch overlapWatch;
    std::vector<OverlapWatch> watches;  // of each thread
};

}  // namespace pendular
