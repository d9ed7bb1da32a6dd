#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepPart.h"

namespace pendular {

/// Copies of grains, for scenes that go on beyond a face in another way than setPeriodic() does: by periods
/// of a few grains' width, turned about an axis, moved along the face, or as the box from which a flow is
/// fed. A copy is a grain of the scene that stands where the scene repeats another one, as far as that can
/// touch something in the cell. In each step it is given the motion of that grain, so that what it feels
/// itself counts for nothing. A grain that goes through a face and its copy behind the other face change
/// roles: the copy is the grain from then on. So nothing is put elsewhere, and contacts go on.
///
///     scene.addPart<GrainCopies>().addPeriod({1, 0, 0}, 0, 2.1e-3);  // m
///
/// Copies are grains in all outputs, counts and sums, also of the forces on walls (isCopy() tells), and where
/// grains are inserted there must be room for their copies. What the springs of friction remember of two
/// grains that touch is not handed to their copies: where both go through a face, they begin anew, and while
/// one has and the other has not, the forces of friction on both are not equal and opposite. Laws that
/// remember more (bridges, plastic overlaps) are refused, and so are columns, temperatures, bonds and
/// prescribed paths, which copies would not have, and a radius or species that a hook changes of a grain that
/// has copies.
class GrainCopies : public StepPart {
public:
    /// The scene repeats itself between two planes at these distances (m) along the unit normal, and the
    /// repetition above the higher one is moved along them by the shift (m), too.
    void addPeriod(const Vec3D& normal, double lowest, double highest, const Vec3D& shift = Vec3D::Zero());
    /// The same with a shift (m) and its velocity (m/s) that depend on the time (s).
    void addPeriod(const Vec3D& normal, double lowest, double highest, std::function<Vec3D(double)> shift,
                   std::function<Vec3D(double)> velocity);
    /// The cell is a wedge between two planes through a point (m), and is repeated by turning it about the
    /// line in which they meet. Wedges fill a turn: the angle is 360 degrees over a whole number from 3 on,
    /// else it throws InputError. @param inwards unit normal of the first plane, into the cell; @param
    /// outwards that of the second one, out of it
    void addTurn(const Vec3D& inwards, const Vec3D& outwards, const Vec3D& point);
    /// The grains that are between two planes when this is called, or when the run begins, are a box that
    /// feeds a flow: where one leaves at the higher plane, it comes again at the lower one, and a grain like
    /// it goes on in the flow. Without a gap the flow goes on at the plane, and what touches the box there
    /// acts on it; grains that go back through the lower plane leave. With a gap (m), which keeps both apart,
    /// the box is periodic, so that its flow depends on nothing else; the flow begins behind the gap, where
    /// copies of the box push it, and what comes back into the gap is taken out.
    /// @param shift m, of the higher plane along the planes
    void addMaser(const Vec3D& normal, double lowest, double highest, const Vec3D& shift, double gap);

    [[nodiscard]] bool isCopy(std::uint32_t identity) const { return copies.contains(identity); }
    [[nodiscard]] std::size_t numberOfCopies() const { return copies.size(); }
    /// How many grains have gone from the box into the flow.
    [[nodiscard]] std::uint64_t numberFed() const { return fed; }

    // Called by the step.

    [[nodiscard]] std::string_view name() const override { return "copies of grains"; }
    [[nodiscard]] Features features(const StepContext& /*scene*/) const override {
        return passages.empty() ? Features{} : Features{Feature::OwnPart};
    }
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override;
    void check(const StepContext& scene) override;
    void begin(StepContext& scene, bool isRestarted) override;
    void takeOver(StepContext& scene, const SceneChanges& changes) override;
    void prepare(StepContext& step) override;
    void moveSurroundings(StepContext& step) override { follow(step.grains(), step.timeAfter); }
    void finish(StepContext& step) override { follow(step.grains(), step.timeAfter); }
    void atEnd(StepContext& step) override { renew(step, step.timeAfter); }
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;
    void addTo(SummaryRows& rows) const override;

private:
    enum class Kind { Period, Feeding, FeedingBeyondGap };
    /// Two faces, and the motion that brings the cell from the first to what is beyond the second.
    struct Passage {
        Kind kind = Kind::Period;
        std::array<Vec3D, 2> outwards, points;  // unit; m; of the lower face and of the higher one
        double width = 0;                       // m, between parallel faces
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        double angle = 0;                                        // rad, of the turn
        std::function<Vec3D(double)> shift = {}, velocity = {};  // m, m/s, by s; parallel faces only
        double gap = 0;                                          // m

        /// @param now s
        void compareSetUp(StateArchive& archive, double now) const;
        /// m, how far a place is beyond a face (0 or 1).
        [[nodiscard]] double beyond(int face, const Vec3D& place) const {
            return outwards[face].dot(place - points[face]);
        }
    };
    /// How often each passage is gone through on the way to a copy; `feeds`: the copy behind the gap.
    struct Image {
        std::array<int, 3> turns{0, 0, 0};
        bool feeds = false;
        friend auto operator<=>(const Image&, const Image&) = default;
    };
    struct Motion {
        Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
        Vec3D offset = Vec3D::Zero(), velocity = Vec3D::Zero();  // m, m/s
        bool turns = false;
    };
    using CopiesOfOne = std::map<Image, std::uint32_t>;

    void add(Passage passage);
    [[nodiscard]] Motion motionOf(const Image& image, double time) const;
    void addPower(Motion& to, const Passage& passage, int power, double time) const;
    static Vec3D placeOf(const Motion& motion, const Vec3D& place) {
        return motion.turns ? Vec3D(motion.turn * place + motion.offset) : Vec3D(place + motion.offset);
    }
    /// All images but the cell itself that may be within reach of it.
    [[nodiscard]] std::vector<Image> imagesWithin(double reach) const;
    [[nodiscard]] bool isNear(const Image& image, const Vec3D& own, const Vec3D& there, double reach) const;
    [[nodiscard]] bool isFeeding() const {
        return !passages.empty() && passages.front().kind != Kind::Period;
    }
    [[nodiscard]] bool repeats(std::uint32_t identity) const {
        return !copies.contains(identity) && (!isFeeding() || members.contains(identity));
    }

    static void refuseColumns(const StepContext& scene);
    void refuseFacesAcross(const PeriodicBox& box) const;
    void requireRoom(StepContext& step, std::uint32_t identity, const Image& image,
                     const SphericalParticle& copy, double time) const;
    [[nodiscard]] bool isCopyBy(const Image& image, std::uint32_t identity) const;
    void follow(ParticleStore& grains, double time) const;
    void adopt(StepContext& step);
    void renew(StepContext& step, double time);
    void forgetGone(StepContext& step);
    void goThroughFaces(StepContext& step, double time);
    void goThrough(StepContext& step, std::uint32_t identity, std::size_t passage, int face, double time);
    void feed(StepContext& step, std::uint32_t identity, int face);
    static void moveGrain(StepContext& step, std::uint32_t identity, const Motion& motion);
    void clearGap(StepContext& step);
    void makeCopies(StepContext& step, double time);
    void makeOne(StepContext& step, std::uint32_t identity, const Image& image, double time);
    void removeCopy(StepContext& step, std::uint32_t copy);
    void stopCopying(std::uint32_t copy) { copies.erase(copy); }

    std::vector<Passage> passages;
    std::map<std::uint32_t, CopiesOfOne> copiesOf;  // by the identity of the grain
    std::map<std::uint32_t, std::uint32_t> copies;  // the grain of each copy
    std::set<std::uint32_t> members;                // of the box that feeds
    bool hasMembers = false;                        // they have been found
    bool isAwake = false;                           // begin() was called
    std::uint64_t fed = 0;
};

}  // namespace pendular
