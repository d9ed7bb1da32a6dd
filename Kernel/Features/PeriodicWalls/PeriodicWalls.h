#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

struct GrainSizes;

/// The walls of a scene that repeats itself. Grains that go through a face must see the same of them behind
/// it: what a wall has within their reach of one face it must have at the other one, too. A mesh that has not
/// is repeated with the scene, and a membrane always; other shapes are refused. Where walls have ends, grains
/// are brought back as soon as one of them is outside by more than a band, and nowhere else: so no wall is
/// looked at from farther outside, and no bit depends on when contacts are listed. The band is a fifth of the
/// smallest radius where walls are alike for so much farther, and twice that; where they are not, it is
/// narrower, and contacts are listed more often.
class PeriodicWalls {
public:
    /// Looks at the walls. Throws InputError where one is not alike at both faces, and cannot be repeated.
    /// @param haveChanged walls have been added or removed since the last time; @param widestBody m; @param
    /// smallestRadius m, infinite without grains
    void check(const WallHandler& walls, bool haveChanged, const PeriodicBox& box, const ContactLaws& laws,
               const GrainSizes& sizes, double widestBody, double smallestRadius);
    /// Whether the walls that are not repeated need not be for such grains either, by the last look.
    [[nodiscard]] bool areKnownFor(const WallHandler& walls, const ContactLaws& laws, const GrainSizes& sizes,
                                   double widestBody) const;
    /// The walls that check() would repeat and that are not repeated yet.
    [[nodiscard]] static std::vector<RepeatedWall*> wallsToRepeat(const WallHandler& walls,
                                                                  const PeriodicBox& box,
                                                                  const ContactLaws& laws,
                                                                  const GrainSizes& sizes, double widestBody,
                                                                  double smallestRadius);
    /// Looks again where walls have moved by at most a shift (m) since the last time. Throws RunError.
    void follow(const WallHandler& walls, double shift, double time);

    /// Whether walls have got images that no list of contacts has yet; not again until others have.
    [[nodiscard]] bool takeNewImages() { return std::exchange(imagesAreNew, false); }

    /// Whether there is a wall that is not the same after any shift along the periods.
    [[nodiscard]] bool haveEnds() const { return anyHasEnds; }
    /// Whether each wall is one that is not the same after any shift.
    [[nodiscard]] const std::vector<bool>& endsOfWalls() const { return hasEnds; }

    /// Whether a grain is too far outside, when grains have moved by at most a shift (m) since the last time.
    /// @param haveBodies there are rigid bodies, on this rank or on others
    [[nodiscard]] bool isBringingBackDue(const ParticleStore& grains, double shift, bool haveBodies,
                                         const AllRanks& ranks);
    /// Grains have been put somewhere else.
    void lookAgain() { nearest = 0; }
    /// The places of all grains that are outside.
    [[nodiscard]] std::vector<std::uint32_t> outside(const ParticleStore& grains) const;

    /// Called after check().
    void visitState(StateArchive& archive, const WallHandler& walls);

private:
    /// The findings at a wall along an axis.
    struct Look {
        bool isEndless = true, passes = false;
        double needed = 0;         // m, when it was looked at
        double margin = infinity;  // m, from the faces, as far as it is known to be alike at both
        Pose pose;                 // where it was then
        double moved = 0;          // m, since then
    };
    struct WallLooks {
        std::size_t number;  // of the wall
        double needed = 0;   // m, from a grain on a face, as far as it meets the wall
        std::array<Look, 3> along;
    };
    /// Takes what looks are made with. Returns whether grains go through faces and see walls that may end.
    bool begin(const PeriodicBox& box, double widestBody, double smallestRadius);
    /// Whether a wall must be repeated, which is seen like this at a pair of faces.
    /// @param met m, from a face, as far as grains meet it
    [[nodiscard]] static bool mustBeRepeated(const Wall& wall, const SurfaceAtFaces& seen,
                                             const PeriodicFaces& faces, double met);
    /// Keeps what was found at the walls that are still there.
    void takePresent(const WallHandler& walls);
    /// @param outside m, how far grains are outside
    void look(Wall& wall, WallLooks& of, std::size_t axis, double outside);
    /// Repeats a wall with the scene. Throws InputError where it is too long, or has too many parts.
    void repeat(RepeatedWall& wall, WallLooks& of);
    static void takeAsRepeated(WallLooks& of);
    /// Throws InputError where a wall that is repeated reaches over too many periods.
    void requireShort(const RepeatedWall& wall, std::size_t number) const;
    /// Returns whether it was looked at again.
    bool followOne(Wall& wall, WallLooks& of, double shift);
    [[nodiscard]] static bool isWhereItWas(const Wall& wall, const Look& last);
    void forgetChecks();
    /// m, from a grain on a face, as far as it meets a wall. @param bodyReach m
    [[nodiscard]] static double neededOf(const Wall& wall, const ContactLaws& laws, const GrainSizes& sizes,
                                         double bodyReach);
    [[nodiscard]] PeriodicFaces facesOf(std::size_t axis, double least) const;
    [[nodiscard]] std::string sentence(std::size_t wall, std::size_t axis, const SurfaceAtFaces& seen,
                                       double met) const;
    /// Whether a wall that may have moved (m) must be looked at again.
    [[nodiscard]] bool mustBeLookedAt(const Wall& wall, std::size_t axis, WallLooks& of, double shift) const;
    void collectEnds();
    void approach(const Vector<double>& centre);

    PeriodicBox periodic;
    double smallest = infinity;    // m, radius
    double bodyReach = 0;          // m, of the widest body around its centre
    double band = 0;               // m, as far as grains may be outside
    std::vector<WallLooks> looks;  // of the present walls
    std::vector<bool> hasEnds;     // by number
    bool anyHasEnds = false, imagesAreNew = false;
    double nearest = 0;  // m, by which grains must move until one of them is too far outside
};

/// Repeats the walls that a scene will repeat when it looks at its walls, for as long as this is there:
/// grains that are put into the scene before that are to see the images, too.
class ImagesForNow {
public:
    ImagesForNow() = default;
    ImagesForNow(std::vector<RepeatedWall*> walls, const Vector<double>& periods)
        : repeated(std::move(walls)) {
        for (RepeatedWall* const wall : repeated) wall->repeat(periods);
    }
    ImagesForNow(ImagesForNow&& other) noexcept : repeated(std::exchange(other.repeated, {})) {}
    ImagesForNow& operator=(ImagesForNow&&) = delete;
    ~ImagesForNow() {
        for (RepeatedWall* const wall : repeated) wall->repeat({0, 0, 0});
    }

private:
    std::vector<RepeatedWall*> repeated;
};

}  // namespace pendular
