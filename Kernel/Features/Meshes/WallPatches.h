#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Contacts/WallContacts.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// Takes for one contact what is one, of the points of a grain on all walls (ContactPatch.h): pieces of
/// surface that continue each other though not to the last bit, in one mesh or in two walls. It asks the
/// points only, once they are found and before forces are computed: a point that is part of another one's
/// contact gets an infinite distance, so that it has neither force nor bridge, and what the contact remembers
/// goes on with the other one. Where it counts in part, its overlap gets smaller by its share.
///
/// Of a grain that is no sphere, contacts with different walls are compared by where it touches them; those
/// with parts of one wall are left to Kernel/Features/Superquadrics/ShapeAtWall.h.
///
/// Which pieces are near to several is known when contacts are listed: a scene whose grains touch one wall
/// each pays nothing.
class WallPatches {
public:
    /// Contacts have been listed.
    void listed(const ContactStore& contacts, const ContactLaws& laws, const ParticleStore& grains);

    /// Called when the points of all walls have been found.
    /// @param handsOver contacts that another part stands for go on there
    /// @param wake gives memory to a block of contacts
    void join(ContactStore& contacts, const ContactLaws& laws, const ParticleStore& grains,
              const WallHandler& walls, int threads, bool handsOver,
              const std::function<void(std::size_t)>& wake);

private:
    /// A grain for which several parts of walls are listed.
    struct Grain {
        std::uint32_t place;
        std::uint32_t begin;  // of its members
    };
    struct Member {
        std::uint32_t contact;
        std::int32_t bucket;
    };
    /// A point that is near enough to act.
    struct Point {
        std::uint32_t contact;
        const Bucket* bucket;
        Vector<double> normal;
        double distance, reach;  // m; reach: at which the contact ends
        double order;            // m, by which they are sorted
        double share;            // how far it counts
        double height;           // m, of the grain's surface above its centre, along the normal
        Vector<double> touched;  // m, from the centre to the point of the wall
    };
    void joinOf(std::size_t grain, ContactStore& contacts, const GrainShapes* shapes,
                const ParticleStore& grains, const WallHandler& walls, std::vector<Point>& points,
                std::vector<HandOver>& found) const;
    void findNear(std::size_t grain, const ContactStore& contacts, const GrainShapes* shapes,
                  const ParticleStore& grains, std::vector<Point>& points) const;
    [[nodiscard]] bool isAtOneWall(std::size_t grain, const ContactStore& contacts) const;
    static double depthBeside(const Point& near, const Point& far);
    static double ownShareOfShape(const Point& near, const Point& far);
    static double ownShare(const ContactStore& contacts, const WallHandler& walls, const Point& near,
                           const Point& far, const Vector<double>& centre);

    std::vector<Grain> several;   // and one more, for the end of the last one's members
    std::vector<Member> members;  // of each grain in the order of walls and parts
    std::vector<double> ranges;   // m, of each member; empty where nothing acts at a distance
    HandOvers handOvers;
};

}  // namespace pendular
