#include <gtest/gtest.h>

#include <map>
#include <set>

#include "SelfTests/Periodic/PavedFloor.h"

// The parts of walls that events of contacts name, where a scene repeats the walls.

namespace pendular::periodic::floors::eventPartsTest {
namespace {

using Kind = ContactEvent::Kind;

/// The part and the image that the one contact of a grain begins at, whose place (in periods) on a floor of
/// one period is given.
ContactEvent eventAt(double x, double y, double lowest) {
    ThroughFaces<Dry> scene(
        {{.radius = r, .position = {x * length, y * length, 1.0001 * r}, .velocity = {0, 0, -0.1}}}, {0, 1});
    scene.listenToContacts();
    scene.add(meshOf(paving(lowest, lowest + length)));
    scene.initialise();
    scene.steps(20);
    EXPECT_EQ(scene.heard.size(), 1u);
    return scene.heard.empty() ? ContactEvent{} : scene.heard.front();
}

/// A floor that begins at half a period, and grains on it and on its images: each names the part on which it
/// would be if the floor reached to it.
TEST(EventParts, areThoseOfTheWallItself) {
    const double lowest = 0.5 * length;
    std::set<std::uint32_t> images, parts;
    for (const double x : {0.07, 0.41, 0.58, 0.93})
        for (const double y : {0.12, 0.36, 0.71, 0.88}) {
            const ContactEvent event = eventAt(x, y, lowest);
            const bool isOwn = x > 0.5 && y > 0.5;
            EXPECT_EQ(event.image == 0, isOwn) << x << ' ' << y;
            EXPECT_LT(event.part, meshOf(paving(lowest, lowest + length)).partCount());
            EXPECT_EQ(event.wall, 0);
            images.insert(event.image), parts.insert(event.part);
            // By looking at all parts: the one below the grain, a period farther where it is an image.
            const TriangleWall floor = meshOf(paving(lowest, lowest + length));
            const Vector<double> centre{(x < 0.5 ? x + 1 : x) * length, (y < 0.5 ? y + 1 : y) * length, r};
            std::vector<std::uint32_t> found;
            floor.listParts(centre, 1.1 * r, found);
            std::vector<WallPoint> points(found.size());
            floor.findPoints(centre, 1.1 * r, found, points);
            for (std::size_t k = 0; k < found.size(); ++k)
                if (points[k].distance < 1.01 * r) {
                    EXPECT_EQ(event.part, found[k]) << x << ' ' << y;
                }
        }
    EXPECT_EQ(images.size(), 4u);
    EXPECT_GT(parts.size(), 8u);
}

/// A ramp of one period and half a radius: where it ends, its image begins. A grain in that corner touches
/// the foot of one and the end of the other, which are the same part of the same wall.
TEST(EventParts, twoImagesOfOnePartAreTwoContacts) {
    const double height = 0.5 * r, slope = height / length, reached = 0.9999 * r;
    double x = 0.5 * r, z = r;
    for (int k = 0; k < 100; ++k) {
        z = slope * x + reached * std::sqrt(1 + slope * slope);
        x = std::sqrt(reached * reached - (z - height) * (z - height));
    }
    ThroughFaces<Dry> scene({{.radius = r, .position = {x, 0, z + 1e-3 * r}, .velocity = {0, 0, -0.3}}}, {0});
    scene.listenToContacts();
    const TriangleWall* const ramp = scene.add(meshOf(strips(
        0, length, 1, [&](double at) { return slope * at; }, length)));
    scene.initialise();
    scene.steps(12);
    ASSERT_EQ(ramp->partCount(), 1u);
    ASSERT_EQ(scene.heard.size(), 2u);
    for (const ContactEvent& event : scene.heard) {
        EXPECT_EQ(event.kind, Kind::TouchBegins);
        EXPECT_EQ(event.wall, 0);
        EXPECT_EQ(event.part, 0u);
    }
    EXPECT_EQ(std::min(scene.heard[0].image, scene.heard[1].image), 0u);
    EXPECT_NE(scene.heard[0].image, scene.heard[1].image);
}

/// What begins at a part ends there, also where the grain has been brought back meanwhile, and where the wall
/// is removed.
TEST(EventParts, ofBeginsAndEndsAreAlike) {
    auto scene = onFloor<Dry>({true, 0.37 * length, 1.37 * length});
    scene->initialise();
    scene->steps(7000);
    EXPECT_GT(scene->crossings, 5);
    std::map<std::uint32_t, int> touching;  // of each grain
    const std::size_t parts = meshOf(paving(0.37 * length, 1.37 * length)).partCount();
    const auto follow = [&] {
        for (const ContactEvent& event : scene->heard) {
            if (event.wall < 0) continue;
            EXPECT_LT(event.part, parts);
            touching[event.particle1] += event.kind == Kind::TouchBegins ? 1 : -1;
        }
        scene->heard.clear();
    };
    follow();
    scene->wallHandler.removeObject(0);
    scene->steps(1);
    follow();
    EXPECT_GT(touching.size(), 1u);
    for (const auto& [grain, count] : touching) EXPECT_EQ(count, 0) << grain;
}

}  // namespace
}  // namespace pendular::periodic::floors::eventPartsTest
