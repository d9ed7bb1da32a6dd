#pragma once

#include <algorithm>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Contacts/WallContacts.h"
#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

/// Finds where grains are nearest to a wall, for the contacts of its bucket; and which of these contacts goes
/// on as that with another part of the wall.
class WallPointSearch {
public:
    using Grains = ParticleStore;

    /// The contacts of one grain follow each other in the bucket.
    /// @param laws between the grains and the wall; @param step s; @param handsOver contacts that another
    /// part of the wall covers go on there; @param wake gives memory to a block
    template <class Wake>
    void find(ContactStore& contacts, const Grains& grains, const Bucket& bucket, const Wall& wall,
              const ContactLaws& laws, double step, int threads, bool handsOver, Wake&& wake) {
        if (const auto plane = wall.planeAtRest()) {
            inParts(
                bucket.end - bucket.begin, threads,
                [&](int, std::size_t from, std::size_t to) {
                    for (std::size_t b = bucket.begin + from; b < bucket.begin + to; ++b)
                        findAtPlane(contacts, grains, bucket, wall, *plane, step, b);
                },
                worthAThread / Pack::lanes);
            return;
        }
        const std::size_t first = bucket.begin * Pack::lanes;
        std::size_t end = bucket.end * Pack::lanes;
        while (end > first && !contacts.bitOf(contacts.states[(end - 1) / Pack::lanes].listed, end - 1))
            --end;
        const auto atNextGrain = [&](std::size_t c) {
            while (c > first && c < end && grainOf(contacts, c) == grainOf(contacts, c - 1)) ++c;
            return c;
        };
        const bool findsEight = wall.findsEight() && !laws.shapes();
        handOvers.resize(static_cast<std::size_t>(threads));
        for (std::vector<HandOver>& own : handOvers) own.clear();
        inParts(
            end - first, threads,
            [&](int part, std::size_t from, std::size_t to) {
                const std::size_t last = atNextGrain(first + to);
                std::vector<HandOver>& found = handOvers[static_cast<std::size_t>(part)];
                for (std::size_t c = atNextGrain(first + from); c < last;) {
                    std::size_t next = last;
                    if (findsEight) {
                        if (isBlockOfSingles(contacts, c, first, last, end)) {
                            findAtBlock(contacts, grains, bucket, wall, step, c / Pack::lanes);
                            c += Pack::lanes;
                            continue;
                        }
                        next = std::min(last, atNextGrain((c / Pack::lanes + 1) * Pack::lanes));
                    }
                    findPart(contacts, grains, bucket, wall, laws, step, c, next, found);
                    c = next;
                }
            },
            worthAThread);
        if (handsOver) handOver(contacts, laws, handOvers, wake);
    }

private:
    static std::uint32_t grainOf(const ContactStore& contacts, std::size_t c) {
        return contacts.blocks[c / Pack::lanes].first[c % Pack::lanes];
    }

    /// The points of the eight contacts of a block with a plane.
    static void findAtPlane(ContactStore& contacts, const Grains& grains, const Bucket& bucket,
                            const Wall& wall, const PlaneAtRest& plane, double step, std::size_t block) {
        const std::uint32_t* const first = contacts.blocks[block].first.data();
        const auto* const base = reinterpret_cast<const double*>(grains.translation.data());
        const auto [x, y, z] = loadRecords<3>(base, 8, first);
        const auto [vx, vy, vz] = loadRecords<3>(base + 4, 8, first);
        const Vector<Pack> normal = inAllLanes<Pack>(plane.grains.normal),
                           surface = inAllLanes<Pack>(plane.surfaceVelocity);
        const Pack distance = Pack(plane.grains.offset) - dot(normal, Vector<Pack>{x, y, z});
        contacts.wallPoints[block - contacts.firstWallBlock()].set(normal, surface, distance);
        const Vector<Pack> way = Pack(step) * (Vector<Pack>{vx, vy, vz} - surface);
        refuseCrossings(contacts, grains, bucket, wall, step, block,
                        distance * abs(distance) <= squaredNorm(way));
    }
    /// Throws where a grain of a block has gone through the wall, as refuseCrossing().
    /// @param near those that are nearer to the wall than their way in this step
    static void refuseCrossings(const ContactStore& contacts, const Grains& grains, const Bucket& bucket,
                                const Wall& wall, double step, std::size_t block, Mask near) {
        const std::uint8_t asked = bits(near) & contacts.states[block].listed;
        if (asked == 0) return;
        const WallPointColumns& points = contacts.wallPoints[block - contacts.firstWallBlock()];
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            if ((asked >> lane & 1) == 0) continue;
            const std::uint32_t grain = contacts.blocks[block].first[lane];
            refuseCrossing(wall, bucket.wall, grains.translation[grain], grains.identity[grain],
                           points.pointAt(lane), step);
        }
    }

    /// Whether a block begins at this contact in which no two contacts are of one grain, nor with those
    /// before and after it: no other part of the wall then covers one of them.
    /// @param first, end of the contacts of the bucket; @param last those to be found end there
    static bool isBlockOfSingles(const ContactStore& contacts, std::size_t c, std::size_t first,
                                 std::size_t last, std::size_t end) {
        if (c % Pack::lanes != 0 || (c + Pack::lanes > last && last < end)) return false;
        const std::size_t from = c > first ? c - 1 : c, to = std::min(c + Pack::lanes, end - 1);
        bool areSingles = true;
        for (std::size_t k = from; k < to; ++k)
            areSingles &= grainOf(contacts, k) != grainOf(contacts, k + 1);
        return areSingles;
    }
    /// The points of the eight contacts of such a block.
    static void findAtBlock(ContactStore& contacts, const Grains& grains, const Bucket& bucket,
                            const Wall& wall, double step, std::size_t block) {
        const ContactBlock& contact = contacts.blocks[block];
        const auto* const base = reinterpret_cast<const double*>(grains.translation.data());
        const auto [x, y, z] = loadRecords<3>(base, 8, contact.first.data());
        const auto [vx, vy, vz] = loadRecords<3>(base + 4, 8, contact.first.data());
        EightWallPoints points;
        wall.findEight({x, y, z}, contact.second, points);
        contacts.wallPoints[block - contacts.firstWallBlock()].set(points.normal, points.velocity,
                                                                   points.distance);
        const Vector<Pack> way = Pack(step) * (Vector<Pack>{vx, vy, vz} - points.velocity);
        refuseCrossings(contacts, grains, bucket, wall, step, block,
                        !(points.distance * abs(points.distance) > squaredNorm(way)));
    }

    /// Finds the points of the contacts [c, end), which begin with a grain's first.
    static void findPart(ContactStore& contacts, const Grains& grains, const Bucket& bucket, const Wall& wall,
                         const ContactLaws& laws, double step, std::size_t c, std::size_t end,
                         std::vector<HandOver>& found) {
        std::vector<std::uint32_t> parts;
        std::vector<WallPoint> points;
        [[maybe_unused]] Bodies last{-1};
        double range = 0;
        while (c < end) {
            const std::uint32_t grain = grainOf(contacts, c);
            const std::size_t begin = c;
            parts.clear();
            for (; c < end && grainOf(contacts, c) == grain; ++c)
                parts.push_back(contacts.blocks[c / Pack::lanes].second[c % Pack::lanes]);
            points.resize(parts.size());
            // What is not listed is of a grain that has gone; another one may have its place.
            if (!ContactStore::bitOf(contacts.states[begin / Pack::lanes].listed, begin)) continue;
            const TranslationRecord& record = grains.translation[grain];
            if (laws.layout.interaction > 0 && record.radius != last.radius1) {
                last = {record.radius};
                range = laws.range(bucket.species1, bucket.species2, last);
            }
            if (const GrainShapes* const shapes = laws.shapes())
                shapes->findPoints(grains, grain, wall, range, parts, points);
            else wall.findPoints(record.position, record.radius + range, parts, points);
            for (std::size_t k = 0; k < points.size(); ++k) {
                const WallPoint& point = points[k];
                contacts.wallPoints[(begin + k) / Pack::lanes - contacts.firstWallBlock()].set(
                    (begin + k) % Pack::lanes, point);
                if (point.coveredBy >= 0) {
                    const auto other = static_cast<std::size_t>(point.coveredBy);
                    found.push_back({static_cast<std::uint32_t>(begin + k),
                                     static_cast<std::uint32_t>(begin + other), point.normal,
                                     points[other].normal});
                }
                refuseCrossing(wall, bucket.wall, record, grains.identity[grain], point, step);
            }
        }
    }

    static constexpr std::size_t worthAThread = 64;  // contacts
    HandOvers handOvers;
};

}  // namespace pendular
