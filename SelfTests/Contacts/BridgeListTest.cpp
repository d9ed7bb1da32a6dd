#include <gtest/gtest.h>

#include <set>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/ContactKey.h"

namespace pendular::bridgeListTest {
namespace {

using scenes::SettlingBox;
using support::ContactKey;
using support::keyOf;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

constexpr double skin = 2e-5;  // m, against ruptures at some 1.3e-4 m
constexpr double step = 0x1p-17;

/// A wet scene and, beside it, who is joined by a bridge, by plain loops over all pairs: those that have
/// touched and have been nearer than the rupture distance since.
class Bridges {
public:
    explicit Bridges(const PeriodicBox& periodic) : scene(6), box(periodic) {
        scene.speciesHandler.mixAll();
        if (box.any()) scene.wallHandler.clear(), scene.planes.clear();
        system.prepare(scene.laws(), scene.wallHandler, box, SkinChoice::fixed(skin), false);
    }

    void advance() {
        auto& grains = scene.particleHandler.store();
        const std::size_t before = system.rebuildCount();
        system.refresh(grains, std::sqrt(TimeIntegration::begin(grains, step)), 0);
        if (system.rebuildCount() > before) expectListed();
        system.computeForces(grains, step);
        TimeIntegration::finish(grains, system.store(), box.any() ? weightless : weight, step);
        takeNote();
        EXPECT_EQ(joinedInStore(), joined);
    }

    std::set<ContactKey> joined;
    int ruptured = 0, keptApart = 0;  // bridges that have ended, and those a rebuild kept beyond the skin

private:
    /// Calls function(key, separation in m, function of the rupture distance in m) for all pairs, and all
    /// grains with all walls.
    template <class Function>
    void forEachPair(Function&& function) {
        const auto& g = scene.particleHandler.store();
        const auto rupture = [&](std::size_t a, int other, const Bodies& bodies) {
            return [&, a, other, bodies] {
                return scene.speciesHandler.mixture(g.species[a], other).range(bodies);
            };
        };
        for (std::size_t i = 0; i < g.size(); ++i) {
            const TranslationRecord& a = g.translation[i];
            for (std::size_t j = 0; j < i; ++j) {
                const TranslationRecord& b = g.translation[j];
                const double separation = norm(box.nearest(b.position - a.position)) - (a.radius + b.radius);
                function(
                    ContactKey{-1, std::min(g.identity[i], g.identity[j]),
                               std::max(g.identity[i], g.identity[j])},
                    separation,
                    rupture(i, g.species[j], {std::min(a.radius, b.radius), std::max(a.radius, b.radius)}));
            }
            for (std::size_t w = 0; w < scene.planes.size(); ++w) {
                const auto& plane = scene.planes[w];
                const double distance = plane.normal.dot(plane.point - toEigen(a.position));
                function(ContactKey{static_cast<int>(w), g.identity[i], g.identity[i]}, distance - a.radius,
                         rupture(i, plane.species, {a.radius}));
            }
        }
    }
    void takeNote() {
        forEachPair([&](const ContactKey& key, double separation, auto rupture) {
            if (separation < 0) joined.insert(key);
            else if (joined.contains(key) && separation >= rupture())
                ruptured += static_cast<int>(joined.erase(key));
        });
    }
    /// A new list holds the pairs that can touch before the next one, those joined by a bridge, the walls
    /// within the length of a grain's bridge at a wall, to which it may pass on, and no others: nothing else
    /// is searched at the bridges' length.
    void expectListed() {
        std::set<ContactKey> expected = joined, listed;
        std::set<std::uint32_t> atWalls;  // grains with a bridge at one
        for (const ContactKey& key : joined)
            if (std::get<0>(key) >= 0) atWalls.insert(std::get<1>(key));
        forEachPair([&](const ContactKey& key, double separation, auto rupture) {
            const bool mayPass = std::get<0>(key) >= 0 && atWalls.contains(std::get<1>(key));
            if (separation < skin || (mayPass && separation < skin + rupture())) expected.insert(key);
            if (separation >= skin) keptApart += joined.contains(key) ? 1 : 0;
        });
        system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            listed.insert(keyOf(system.store(), scene.particleHandler.store().identity, bucket, c));
        });
        EXPECT_EQ(listed, expected);
    }
    std::set<ContactKey> joinedInStore() {
        std::set<ContactKey> result;
        system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            if (system.isBridged(c))
                result.insert(keyOf(system.store(), scene.particleHandler.store().identity, bucket, c));
        });
        return result;
    }

    static constexpr Vector<double> weightless{0, 0, 0}, weight{0, 0, -9.81};
    SettlingBox<Wet> scene;
    PeriodicBox box;
    ContactSystem system;
};

void expectNoBridgeIsLost(const PeriodicBox& box) {
    Bridges bridges(box);
    for (int n = 0; n < 2500 && !testing::Test::HasFailure(); ++n) bridges.advance();
    EXPECT_GT(bridges.joined.size(), 20u);
    EXPECT_GT(bridges.ruptured, 20);
    EXPECT_GT(bridges.keptApart, 200);
}

TEST(BridgeList, keepsEveryBridgeAndSearchesNoneThatCannotBe) { expectNoBridgeIsLost({}); }

TEST(BridgeList, doesSoInAPeriodicScene) {
    constexpr double width = 0x1.9p-7,
                     height = 0x1.4p-6;  // m: 12 and 20 mm, a little more than the grains take
    expectNoBridgeIsLost({{0, 0, 0}, {width, width, height}});
}

}  // namespace
}  // namespace pendular::bridgeListTest
