#include <gtest/gtest.h>

#include <array>

#include "SelfTests/Periodic/PavedFloor.h"

// Grains that a hook changes while they are just outside a face: their contacts at walls go on.

namespace pendular::periodic::floors::changedAtFaceTest {
namespace {

template <class S>
class ChangedAtFace : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet, Migrating>;
TYPED_TEST_SUITE(ChangedAtFace, SpeciesOfAllKinds);

/// A groove along x whose sides rise by 30 degrees, between two places (m), paved so that grains go from part
/// to part, and other parts are at each face.
TriangleWall groove(double lowest, double highest) {
    std::vector<Triangle> triangles;
    for (const double side : {-1.0, 1.0})
        for (const Triangle& flat : paving(lowest, highest)) {
            Triangle& tilted = triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const double up = flat[k].y - lowest;
                tilted[k] = {flat[k].x, side * up * std::sqrt(0.75), 0.5 * up};
            }
        }
    return meshOf(triangles);
}

/// A nudge leaves a grain on its part of the wall; a place is farther outside than any grain that moves by
/// itself.
enum class Change { Radius, Nudge, Place };

/// Two grains slide along a groove, and one along the other way. Each is changed once.
template <class S>
std::unique_ptr<ThroughFaces<S>> inGroove(const TriangleWall& wall, double shift) {
    const double height = 0.9998 * r * 2 / std::sqrt(3.0);
    std::vector<GrainMotion> grains{
        {.radius = r, .position = {0.6 * length, 0, height}, .velocity = {1.9, 0, 0}},
        {.radius = r, .position = {0.25 * length, 0, height}, .velocity = {1.7, 0, 0}, .spin = {0, 900, 50}}};
    for (GrainMotion& grain : grains) {
        grain.position.x() += shift;
        if (grain.position.x() > length) grain.position.x() -= length;
    }
    auto scene = filmedGrains<S>(grains, {0});
    scene->listenToContacts();
    scene->keepEnergyLedger();
    scene->add(wall);
    return scene;
}

struct Event {
    std::size_t step, grain;
};

template <class S>
void apply(scenes::HookedGrains<S>& scene, std::size_t grain, Change change) {
    auto changed = scene.particleHandler.getObject(grain);
    if (change == Change::Radius) return changed.setRadius(1.0001 * r);
    const double way = change == Change::Nudge ? 0.02 * r : 0.5 * r;
    changed.setPosition(changed.getPosition() + Vec3D(way, 0, 0));
}

/// Runs a scene in which each grain is changed in the third step that begins with it outside; notes when.
template <class S>
std::vector<Event> changeOutside(ThroughFaces<S>& scene, Change change, int steps) {
    std::vector<Event> events;
    std::array<int, 2> outside{};
    scene.hook = [&](scenes::HookedGrains<S>& s) {
        for (std::size_t g = 0; g < 2; ++g) {
            if (!(s.motion(g).position.x() > length) || ++outside[g] != 3) continue;
            events.push_back({s.getNumberOfTimeSteps(), g});
            apply(s, g, change);
        }
    };
    scene.initialise();
    scene.steps(steps);
    scene.hook = nullptr;
    return events;
}

/// The other scene is half a period farther, so that these grains are far from any face when they change.
template <class S>
void expectGoesOnAsInside(const std::function<TriangleWall(double)>& wall, bool isRepeated, Change change) {
    constexpr int steps = 3000;
    auto found = inGroove<S>(wall(0), 0), expected = inGroove<S>(wall(0.5 * length), 0.5 * length);
    const std::vector<Event> events = changeOutside(*found, change, steps);
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(found->wallHandler.getObject(0).isRepeated(), isRepeated);
    expected->hook = [&](scenes::HookedGrains<S>& s) {
        for (const Event& event : events)
            if (event.step == s.getNumberOfTimeSteps()) {
                EXPECT_NEAR(s.motion(event.grain).position.x(), 0.5 * length, r);
                apply(s, event.grain, change);
            }
    };
    expected->initialise();
    expected->steps(steps);
    for (std::size_t g = 0; g < 2; ++g) {
        const GrainMotion a = found->motion(g), b = expected->motion(g);
        const Vec3D apart = a.position + Vec3D(0.5 * length, 0, 0) - b.position;
        EXPECT_LT(norm(found->getPeriodicBox().nearest(toVector(apart))), roundOff * r) << g;
        EXPECT_LT((a.velocity - b.velocity).norm(), roundOff) << g;
        EXPECT_LT((a.spin - b.spin).norm(), roundOff / r) << g;
    }
    EXPECT_EQ(found->heard.size(), expected->heard.size());
    const EnergyLedger &one = found->energyLedger(), &other = expected->energyLedger();
    EXPECT_NEAR(one.closed(), other.closed(), 1e-9 * other.kinetic);
    EXPECT_NEAR(one.sliding, other.sliding, 1e-7 * other.kinetic);
}

TYPED_TEST(ChangedAtFace, aContactAtAnImageGoesOn) {
    for (const Change change : {Change::Radius, Change::Place})
        for (const double begin : {0.3 * length, -2.1 * length}) {
            SCOPED_TRACE(begin / length);
            expectGoesOnAsInside<TypeParam>(
                [&](double shift) { return groove(begin + shift, begin + length + shift); }, true, change);
        }
}

TYPED_TEST(ChangedAtFace, aContactAtAWallThatIsAlikeGoesOn) {
    for (const Change change : {Change::Radius, Change::Nudge})
        expectGoesOnAsInside<TypeParam>([&](double) { return groove(-reach, length + reach); }, false,
                                        change);
}

/// A grain that is put from one period into the next one is on the groove there, unless it is lifted.
TEST(ChangedAtFace, aContactThatTheChangeTakesApartEnds) {
    for (const bool isFar : {false, true}) {
        auto scene = inGroove<Dry>(groove(0.3 * length, 1.3 * length), 0);
        scene->initialise();
        scene->steps(50);
        std::size_t touching = 0, ended = 0, begun = 0;
        for (const ObservedContact& seen : scene->interactions())
            touching += seen.particle1 == 0 && seen.touching;
        auto grain = scene->particleHandler.getObject(0);
        grain.setPosition({length + 0.1 * r, 0, (isFar ? 1.5 : 0.9998) * r * 2 / std::sqrt(3.0)});
        grain.setVelocity({0, 0, 0});
        scene->heard.clear();
        scene->steps(1);
        for (const ContactEvent& event : scene->heard) {
            ended += event.particle1 == 0 && event.kind == ContactEvent::Kind::TouchEnds;
            begun += event.particle1 == 0 && event.kind == ContactEvent::Kind::TouchBegins;
        }
        EXPECT_EQ(ended, touching);
        EXPECT_EQ(begun, isFar ? 0u : 2u);
        EXPECT_NEAR(scene->motion(0).position.x(), 0.1 * r, 1e-6 * r);
    }
}

}  // namespace
}  // namespace pendular::periodic::floors::changedAtFaceTest
