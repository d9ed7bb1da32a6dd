#pragma once

#include <algorithm>
#include <atomic>
#include <vector>

#include "Kernel/Contacts/ContactKernel.h"
#include "Kernel/Contacts/ContactList.h"
#include "Kernel/Contacts/SkinChoice.h"
#include "Kernel/Contacts/WallContacts.h"
#include "Kernel/Parallel.h"

namespace pendular {

/// Energy by kind, summed over all contacts.
struct ContactEnergies {
    double elastic = 0;     // J, stored in the normal overlaps
    double damping = 0;     // W, lost in the normal dashpots
    double adhesion = 0;    // W, done against the adhesion
    double tangential = 0;  // W, given to tangential springs, dashpots and sliders
};

/// One contact as an observer sees it after a step.
struct ObservedContact {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::uint32_t particle1;
    std::uint32_t particle2;  // `none` at a wall
    int wall;                 // -1: grain with grain
    double separation;        // m, of the surfaces; negative where they overlap
    double normalForce;       // N, elastic and damping, repulsion positive
    double adhesiveForce;     // N, attraction positive
    bool bridged;
    Vector<double> shift;  // m, from the centre of particle 1 to that of particle 2 or to the wall's surface
    Vector<double> force;  // N, on particle 1
};

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

    /// After prepare(); the species, the walls and the grains are visited by themselves.
    void visitState(StateArchive& archive) {
        contacts.visitState(archive);
        archive.record<double>("skin", skin);
        archive.value("stepsListed", stepsListed);
        archive.value("listedGrains", listedGrains);
        archive.value("listedWalls", listedWalls);
        archive.value("unlisted", unlisted);
        archive.value("rebuilds", rebuilds);
        if (archive.isReading()) prepareLaws();
    }

    /// Threads for the forces; the results do not depend on it.
    void setThreads(int count) { threads = count; }

    /// The force records of all contacts, for grains at the end of a step (s) with their predicted
    /// velocities.
    void computeForces(const Grains& grains, double step, ContactTiming timing = {}) {
        if (ledger) computeAll<true>(grains, step, timing);
        else computeAll<false>(grains, step, timing);
    }

    [[nodiscard]] const ContactStore<S>& store() const { return contacts; }
    [[nodiscard]] const PeriodicBox& periodicBox() const { return periodic; }
    /// Of memory that the contacts take.
    [[nodiscard]] std::size_t bytes() const { return contacts.bytes(); }
    [[nodiscard]] std::size_t rebuildCount() const { return rebuilds; }

    [[nodiscard]] ContactEnergies energies() const {
        ContactEnergies sum;
        if (!ledger) return sum;
        contacts.forEachListed([&](const Bucket&, std::uint32_t c) {
            const EnergyRecord& e = contacts.memory.energies[contacts.slotOf(c)];
            sum.elastic += e.elastic;
            sum.damping += e.damping;
            sum.adhesion += e.adhesion;
            sum.tangential += e.tangential;
        });
        return sum;
    }

    [[nodiscard]] ObservedContact observe(const Grains& grains, const Bucket& bucket,
                                          std::uint32_t contact) const {
        const ContactBlock& block = contacts.blocks[contact / Pack::lanes];
        const BlockState& state = contacts.states[contact / Pack::lanes];
        const std::size_t lane = contact % Pack::lanes;
        const TranslationRecord& first = grains.translation[block.first[lane]];
        ObservedContact seen{grains.identity[block.first[lane]],
                             ObservedContact::none,
                             bucket.wall,
                             0,
                             contacts.recordOf(contact).normalForce,
                             0,
                             (state.bridged >> lane & 1) != 0,
                             {},
                             contacts.recordOf(contact).force};
        if (bucket.wall < 0) {
            const TranslationRecord& second = grains.translation[block.second[lane]];
            seen.particle2 = grains.identity[block.second[lane]];
            seen.shift = periodic.nearest(second.position - first.position);
            seen.separation = norm(seen.shift) - (first.radius + second.radius);
        } else {
            const std::uint32_t part = block.second[lane];
            WallPoint point;
            walls->getObject(static_cast<std::size_t>(bucket.wall))
                .findPoints(first.position, first.radius, {&part, 1}, {&point, 1});
            seen.separation = point.distance - first.radius;
            seen.shift = point.distance * point.normal;
        }
        if constexpr (S::Adhesion::acts)
            if (seen.bridged)
                seen.adhesiveForce = contacts.memory.interaction.get(contacts.slotOf(contact))
                                         .force(separationFor<typename S::Adhesion>(-seen.separation));
        seen.normalForce += seen.adhesiveForce;
        return seen;
    }

private:
    /// Blocks are independent: each writes only its own memory and records.
    template <bool withLedger>
    void computeAll(const Grains& grains, double step, ContactTiming timing) {
        const TranslationRecord* translation = grains.translation.data();
        const RotationRecord* rotation = grains.rotation.data();
        for (std::size_t k = 0; k < contacts.buckets.size(); ++k) {
            const Bucket& bucket = contacts.buckets[k];
            ContactKernel<S, withLedger> kernel(laws[k], step, timing, contacts);
            const auto forEachBlock = [&](auto geometryOf) {
                std::atomic<bool> allHaveMemory = true;
                inParts(
                    bucket.end - bucket.begin, threads,
                    [&, kernel](int, std::size_t begin, std::size_t end) mutable {
                        bool all = true;
                        for (std::size_t b = bucket.begin + begin; b < bucket.begin + end; ++b)
                            if (contacts.slots[b] != ContactStore<S>::asleep || unlisted > contacts.gaps[b])
                                all &= kernel.computeBlock(b, geometryOf(b));
                        if (!all) allHaveMemory = false;
                    });
                if (allHaveMemory) return;
                for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
                    if (contacts.slots[b] != ContactStore<S>::waking) continue;
                    wake(b, bucket, grains);
                    kernel.computeBlock(b, geometryOf(b));
                }
            };
            const auto pairOf = [&]<bool isPeriodic>(std::size_t b) {
                return PairGeometry<S, isPeriodic>(translation, rotation, contacts.blocks[b], periodic);
            };
            if (bucket.wall >= 0) {
                findWallPoints(grains, bucket, step);
                forEachBlock([&, first = contacts.firstWallBlock()](std::size_t b) {
                    return WallGeometry<S>(translation, rotation, contacts.blocks[b],
                                           contacts.wallPoints[b - first]);
                });
            } else if (periodic.any()) {
                forEachBlock([&](std::size_t b) { return pairOf.template operator()<true>(b); });
            } else {
                forEachBlock([&](std::size_t b) { return pairOf.template operator()<false>(b); });
            }
        }
        sumWallForces(grains);
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

    struct HandOver {
        std::size_t from, to;  // contacts
        Vector<double> oldNormal, newNormal;
    };

    /// Where the grains of a wall's bucket are nearest to it; the contacts of one grain follow each other.
    void findWallPoints(const Grains& grains, const Bucket& bucket, double step) {
        const std::size_t first = bucket.begin * Pack::lanes;
        std::size_t end = bucket.end * Pack::lanes;
        while (!contacts.bitOf(contacts.states[(end - 1) / Pack::lanes].listed, end - 1)) --end;
        const auto grainOf = [&](std::size_t c) {
            return contacts.blocks[c / Pack::lanes].first[c % Pack::lanes];
        };
        const auto atNextGrain = [&](std::size_t c) {
            while (c > first && c < end && grainOf(c) == grainOf(c - 1)) ++c;
            return c;
        };
        handOvers.resize(static_cast<std::size_t>(threads));
        inParts(end - first, threads, [&](int part, std::size_t from, std::size_t to) {
            std::vector<HandOver>& own = handOvers[static_cast<std::size_t>(part)];
            own.clear();
            findWallPoints(grains, bucket, step, atNextGrain(first + from), atNextGrain(first + to), own);
        });
        for (const auto& part : handOvers)
            for (const HandOver& h : part) {
                if (!contacts.acts(h.from)) continue;
                if (contacts.slots[h.to / Pack::lanes] == ContactStore<S>::asleep)
                    wake(h.to / Pack::lanes, bucket, grains);
                handOver(contacts, h.from, h.to, h.oldNormal, h.newNormal);
            }
    }
    /// The same for the contacts [c, end), which begin with a grain's first.
    void findWallPoints(const Grains& grains, const Bucket& bucket, double step, std::size_t c,
                        std::size_t end, std::vector<HandOver>& found) {
        const Wall& wall = walls->getObject(static_cast<std::size_t>(bucket.wall));
        std::vector<std::uint32_t> parts;
        std::vector<WallPoint> points;
        Bodies last{-1};
        double range = 0;
        while (c < end) {
            const std::uint32_t grain = contacts.blocks[c / Pack::lanes].first[c % Pack::lanes];
            const std::size_t begin = c;
            parts.clear();
            for (; c < end && contacts.blocks[c / Pack::lanes].first[c % Pack::lanes] == grain; ++c)
                parts.push_back(contacts.blocks[c / Pack::lanes].second[c % Pack::lanes]);
            points.resize(parts.size());
            const TranslationRecord& record = grains.translation[grain];
            if constexpr (S::Adhesion::acts)
                if (record.radius != last.radius1) {
                    last = {record.radius};
                    range = species->mixture(bucket.species1, bucket.species2).range(last);
                }
            wall.findPoints(record.position, record.radius + range, parts, points);
            for (std::size_t k = 0; k < points.size(); ++k) {
                const WallPoint& point = points[k];
                contacts.wallPoints[(begin + k) / Pack::lanes - contacts.firstWallBlock()].set(
                    (begin + k) % Pack::lanes, point);
                if (point.coveredBy >= 0) {
                    const auto other = static_cast<std::size_t>(point.coveredBy);
                    found.push_back({begin + k, begin + other, point.normal, points[other].normal});
                }
                refuseCrossing(wall, bucket.wall, record, grains.identity[grain], point, step);
            }
        }
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
    std::vector<std::vector<HandOver>> handOvers;  // of each thread
};

}  // namespace pendular
