#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Scene/Scene.h"

namespace pendular::support {

/// Looks by brute force for bodies that touch and that the list of contacts lacks. Superquadrics count as the
/// spheres around them, as in the list.
class UnlistedTouches {
public:
    /// To be called after steps. Grains that have come since the last call are left out: an inlet may add
    /// them after the forces.
    /// @return what it has found first; nothing if all is well
    std::string lookAt(const Scene& scene) {
        const ContactSystem& contacts = scene.contacts();
        const ParticleStore& grains = scene.particleHandler.store();
        if (contacts.ranks().areSeveral()) return {};  // of which none has all grains
        readList(contacts, grains);
        std::string found;
        for (const std::uint32_t place : grains.place) {
            if (!found.empty()) break;
            if (!known.contains(grains.identity[place])) continue;
            found = lookAtPairs(contacts, grains, place);
            if (found.empty()) found = lookAtWalls(contacts, grains, scene.wallHandler, place);
        }
        known.clear();
        for (const std::uint32_t place : grains.place) known.insert(grains.identity[place]);
        return found;
    }

private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;                  // identities
    using AtWall = std::tuple<std::size_t, std::uint32_t, std::uint32_t>;  // wall, identity, part
    static constexpr double roundOff = 1e-12;                              // of a radius

    void readList(const ContactSystem& contacts, const ParticleStore& grains) {
        pairs.clear();
        atWalls.clear();
        contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            const std::uint32_t one = grains.identity[contacts.firstOf(contact)],
                                other = contacts.secondOf(contact);
            if (bucket.wall >= 0) atWalls.emplace(static_cast<std::size_t>(bucket.wall), one, other);
            else pairs.insert(std::minmax(one, grains.identity[other]));
        });
    }

    std::string lookAtPairs(const ContactSystem& contacts, const ParticleStore& grains,
                            std::uint32_t place) const {
        const TranslationRecord& a = grains.translation[place];
        for (const std::uint32_t other : grains.place) {
            const TranslationRecord& b = grains.translation[other];
            const Pair both = std::minmax(grains.identity[place], grains.identity[other]);
            if (grains.identity[place] >= grains.identity[other] || !known.contains(grains.identity[other]))
                continue;
            if (grains.bodies.areJoinedAt(place, other)) continue;
            if (a.inverseMass == 0 && b.inverseMass == 0 && !contacts.listedOfHeld().pairs) continue;
            const double reach = (1 - roundOff) * (a.radius + b.radius);
            if (squaredNorm(contacts.periodicBox().nearest(b.position - a.position)) < reach * reach &&
                !pairs.contains(both))
                return fmt::format("grains {} and {} touch and are not listed", both.first, both.second);
        }
        return {};
    }

    std::string lookAtWalls(const ContactSystem& contacts, const ParticleStore& grains,
                            const WallHandler& walls, std::uint32_t place) const {
        const TranslationRecord& grain = grains.translation[place];
        for (const auto& [number, wall] : walls.present()) {
            if (grain.inverseMass == 0 && !contacts.listedOfHeld().atWall(number)) continue;
            std::vector<std::uint32_t> parts;
            wall->listParts(grain.position, grain.radius, parts);
            if (parts.empty()) continue;
            std::vector<WallPoint> points(parts.size());
            wall->findPoints(grain.position, grain.radius, parts, points);
            for (std::size_t k = 0; k < parts.size(); ++k)
                if (points[k].distance < (1 - roundOff) * grain.radius &&
                    !atWalls.contains({number, grains.identity[place], parts[k]}))
                    return fmt::format("grain {} touches part {} of wall {} and is not listed there",
                                       grains.identity[place], parts[k], number);
        }
        return {};
    }

    std::set<std::uint32_t> known;  // identities of grains that were there at the last call
    std::set<Pair> pairs;
    std::set<AtWall> atWalls;
};

}  // namespace pendular::support
