#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/ContactKey.h"
#include "SelfTests/Support/Random.h"

namespace pendular::contactListTest {
namespace {

using scenes::boxMaterial;
using support::ContactKey;
using support::keyOf;
using support::Random;

/// An attraction at a distance, without a touch before, whose range depends on the radii.
struct Attraction {
    static constexpr std::string_view name = "Attraction";
    static constexpr std::string_view summary = "constant attraction near the surface";
    static constexpr std::string_view domain = "tests";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = false;

    double strength = 1e-6;  // N

    static constexpr auto fields() {
        return std::to_array<Field<Attraction>>(
            {{"strength", &Attraction::strength, "N", notNegative, Mixing::Geometric, "force", "this test"}});
    }
    template <class T>
    struct Interaction {
        T strength, width;
        [[nodiscard]] T force(T) const { return strength; }
        [[nodiscard]] T range() const { return width; }
    };
    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        return {strength, range(bodies)};
    }
    [[nodiscard]] double range(const Bodies& bodies) const { return 0.3 * bodies.effectiveRadius(); }
};

using Dry = Species<LinearViscoelastic>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Attracting = Species<LinearViscoelastic, NoFriction, Attraction>;

/// Grains of two species, every third one of the second, and a floor; listed by a contact system of the
/// test's own.
template <class S>
struct Listing {
    explicit Listing(double skinWidth) : skin(skinWidth) {
        scene.speciesHandler.copyAndAddObject(boxMaterial<S>(0));
        scene.speciesHandler.copyAndAddObject(boxMaterial<S>(1));
    }
    void add(double radius, const Vec3D& position, bool fixed = false) {
        SphericalParticle grain;
        grain.setRadius(radius);
        grain.setPosition(position);
        grain.setSpecies(scene.speciesHandler.getObject(grains().size() % 3 == 2 ? 1 : 0));
        if (fixed) grain.fixParticle();
        scene.particleHandler.copyAndAddObject(grain);
    }
    void addFloor(double z) {
        InfiniteWall floor;
        floor.set({0, 0, -1}, {0, 0, z});
        floor.setSpecies(scene.speciesHandler.getObject(1));
        scene.wallHandler.copyAndAddObject(floor);
        floors.push_back(z);
    }
    ParticleStore& grains() { return scene.particleHandler.store(); }

    /// m, from which two bodies act
    double range(std::uint16_t a, std::uint16_t b, const Bodies& bodies) {
        if constexpr (std::is_same_v<S, Attracting>) return scene.speciesHandler.mixture(a, b).range(bodies);
        else return 0;  // bridges begin with a touch
    }

    std::set<ContactKey> bruteForce() {
        std::set<ContactKey> result;
        const auto& g = grains();
        for (std::size_t i = 0; i < g.size(); ++i) {
            const TranslationRecord& a = g.translation[i];
            for (std::size_t j = 0; j < i; ++j) {
                const TranslationRecord& b = g.translation[j];
                if (a.inverseMass == 0 && b.inverseMass == 0) continue;
                const double reach =
                    a.radius + b.radius + range(g.species[i], g.species[j], {a.radius, b.radius}) + skin;
                if (squaredNorm(box.nearest(a.position - b.position)) < reach * reach)
                    result.emplace(-1, std::min(g.identity[i], g.identity[j]),
                                   std::max(g.identity[i], g.identity[j]));
            }
            for (std::size_t w = 0; w < floors.size(); ++w)
                if (a.inverseMass > 0 &&
                    a.position.z - floors[w] < a.radius + range(g.species[i], 1, {a.radius}) + skin)
                    result.emplace(static_cast<int>(w), g.identity[i], g.identity[i]);
        }
        return result;
    }

    std::set<ContactKey> listed() {
        scene.speciesHandler.mixAll();
        system.prepare(scene.laws(), scene.wallHandler, box, SkinChoice::fixed(skin), false);
        system.refresh(grains(), 0, 0);
        std::set<ContactKey> result;
        system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            const auto& g = grains();
            const ContactBlock& block = system.store().blocks[c / Pack::lanes];
            const int s1 = g.species[block.first[c % Pack::lanes]];
            const int s2 = bucket.wall >= 0 ? 1 : g.species[block.second[c % Pack::lanes]];
            EXPECT_EQ(std::min(s1, s2), std::min(bucket.species1, bucket.species2));
            EXPECT_EQ(std::max(s1, s2), std::max(bucket.species1, bucket.species2));
            EXPECT_TRUE(result.insert(keyOf(system.store(), g.identity, bucket, c)).second) << "listed twice";
        });
        return result;
    }

    /// Each contact is once among the sides of each of its grains, and nothing else is.
    void checkSides() {
        const auto& store = system.store();
        std::multiset<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            expected.emplace(store.blocks[c / Pack::lanes].first[c % Pack::lanes], 2 * c);
            if (bucket.wall < 0)
                expected.emplace(store.blocks[c / Pack::lanes].second[c % Pack::lanes], 2 * c + 1);
        });
        for (std::uint32_t k = 0; k < grains().size(); ++k) {
            for (const std::uint32_t side : store.sidesOf(k))
                found.emplace(k, 2 * store.contactAt(side / 2) + side % 2);
            for (const std::uint32_t side : store.asleepSidesOf(k)) found.emplace(k, side);
        }
        EXPECT_EQ(found, expected);
    }

    /// No pair of a block can act before two bodies have approached by the block's gap; it is the smallest of
    /// its pairs, rounded to a float and lowered a little.
    void checkGaps() {
        const auto& g = grains();
        const auto& store = system.store();
        std::vector<double> smallest(store.firstWallBlock(), infinity);
        system.store().forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            if (bucket.wall >= 0) return;
            const std::uint32_t i = store.firstOf(c), j = store.secondOf(c);
            const TranslationRecord &a = g.translation[i], &b = g.translation[j];
            const double gap = norm(box.nearest(a.position - b.position)) - a.radius - b.radius -
                               range(g.species[i], g.species[j], {a.radius, b.radius});
            smallest[c / Pack::lanes] = std::min(smallest[c / Pack::lanes], gap);
        });
        for (std::size_t block = 0; block < smallest.size(); ++block) {
            EXPECT_LE(store.gaps[block], smallest[block]);
            EXPECT_GE(store.gaps[block], smallest[block] - 2e-6 * std::abs(smallest[block]) - 2e-9 * skin);
        }
    }

    Simulation<S> scene;
    ContactSystem system;
    PeriodicBox box;
    double skin;
    std::vector<double> floors;
};

template <class S>
class ContactListOf : public testing::Test {
protected:
    /// Fills a box of the given edge (m) with grains, and compares the lists.
    static void compare(int count, double smallest, double largest, double edge, double skin,
                        PeriodicBox box = {}) {
        Random random(static_cast<std::uint64_t>(count));
        Listing<S> listing(skin);
        listing.box = box;
        for (int k = 0; k < count; ++k)
            listing.add(smallest * std::pow(largest / smallest, random.uniform(0, 1)),
                        random.inCube(0.5 * edge), k % 5 == 4);
        listing.addFloor(-0.5 * edge);
        listing.addFloor(-0.4 * edge);
        const auto expected = [&] {
            listing.scene.speciesHandler.mixAll();
            return listing.bruteForce();
        }();
        EXPECT_EQ(listing.listed(), expected);
        EXPECT_GT(expected.size(), 0u);
        listing.checkSides();
        listing.checkGaps();
        EXPECT_EQ(listing.listed(), expected);  // again, for grains that are sorted already
    }
};
using AllSpecies = testing::Types<Dry, Wet, Attracting>;
TYPED_TEST_SUITE(ContactListOf, AllSpecies);

constexpr double r = 1e-3;  // m

TYPED_TEST(ContactListOf, findsThePairsOfEqualGrains) { this->compare(800, r, r, 18 * r, 0.15 * r); }
TYPED_TEST(ContactListOf, findsThePairsOfSizesOneToTen) { this->compare(800, r, 10 * r, 60 * r, 0.15 * r); }
TYPED_TEST(ContactListOf, findsThePairsOfSizesOneToFifty) {
    this->compare(1500, r, 50 * r, 250 * r, 0.15 * r);   // dense
    this->compare(1500, r, 50 * r, 3000 * r, 0.15 * r);  // dilute
}
TYPED_TEST(ContactListOf, findsThePairsOfSizesOneToThousand) {
    this->compare(400, r, 1000 * r, 3000 * r, 0.15 * r);
}
TYPED_TEST(ContactListOf, findsThePairsOfADiluteScene) { this->compare(1500, r, 2 * r, 400 * r, 0.5 * r); }
TYPED_TEST(ContactListOf, findsThePairsInOneCell) { this->compare(60, r, r, 0.5 * r, 0.15 * r); }
TYPED_TEST(ContactListOf, findsThePairsWithAWideSkin) { this->compare(300, r, 3 * r, 30 * r, 5 * r); }
TYPED_TEST(ContactListOf, findsThePairsWithoutASkin) { this->compare(800, r, 2 * r, 20 * r, 0); }
TYPED_TEST(ContactListOf, findsThePairsOfAFewGrains) {
    for (int count : {1, 2, 3, 9}) this->compare(count, r, r, 1.5 * r, 0.1 * r);
}
TYPED_TEST(ContactListOf, findsTheNearestImages) {
    for (double length : {9.0, 13.7, 30.0}) {  // of few cells, and of many
        const PeriodicBox all{{-0.5 * length * r, -0.5 * length * r, -0.5 * length * r},
                              {length * r, length * r, length * r}};
        this->compare(300, r, 2 * r, length * r, 0.2 * r, all);
        const PeriodicBox one{{0, -0.5 * length * r, 0}, {0, length * r, 0}};
        this->compare(300, r, 2 * r, length * r, 0.2 * r, one);
        const PeriodicBox two{{-0.3 * length * r, 0, -0.5 * length * r}, {length * r, 0, length * r}};
        this->compare(300, r, 2 * r, length * r, 0.2 * r, two);
    }
    for (double largest : {10.0, 50.0}) {  // sizes in a scene of twice the largest distance of two centres
        const double length = 4.7 * largest * r;
        const PeriodicBox all{{-0.5 * length, -0.5 * length, -0.5 * length}, {length, length, length}};
        this->compare(600, r, largest * r, length, 0.15 * r, all);
    }
    const PeriodicBox wide{{-0.5, -0.5, -0.5}, {1, 1, 1}};
    this->compare(60, r, r, 0.5 * r, 0.15 * r, wide);       // in one cell
    this->compare(1500, r, 2 * r, 400 * r, 0.5 * r, wide);  // dilute
}

TYPED_TEST(ContactListOf, findsThePairsOfALattice) {
    // Multiples of powers of two: centres lie on the faces of cells, and distances are exactly 2 r, 2 r +
    // skin, ...
    const double radius = 0x1p-10;
    for (double spacing : {2 * radius, 2.125 * radius, 2.25 * radius, 1.9375 * radius}) {
        Listing<TypeParam> listing(0.125 * radius);
        for (int k = 0; k < 512; ++k)
            listing.add(radius, {spacing * (k % 8), spacing * (k / 8 % 8), spacing * (k / 64)});
        listing.addFloor(-radius);
        listing.scene.speciesHandler.mixAll();
        const auto expected = listing.bruteForce();
        EXPECT_EQ(listing.listed(), expected);
    }
}

TYPED_TEST(ContactListOf, findsThePairsOfALatticeThatRepeatsItself) {
    // Centres on the faces of cells and of the scene.
    const double radius = 0x1p-10, length = 16 * radius;
    for (double origin : {0.0, -length, 0.5 * length}) {
        Listing<TypeParam> listing(0.125 * radius);
        listing.box = {{origin, origin, origin}, {length, length, length}};
        for (int k = 0; k < 512; ++k) listing.add(radius, 2 * radius * Vec3D(k % 8, k / 8 % 8, k / 64));
        listing.scene.speciesHandler.mixAll();
        const auto expected = listing.bruteForce();
        EXPECT_EQ(expected.size(), 3u * 512);
        EXPECT_EQ(listing.listed(), expected);
    }
}

TYPED_TEST(ContactListOf, findsThePairsInALineAndInAPlane) {
    for (int dimensions : {1, 2}) {
        Listing<TypeParam> listing(0.1 * r);
        Random random(7);
        for (int k = 0; k < 300; ++k)
            listing.add(r, {random.uniform(0, 0.2), dimensions == 2 ? random.uniform(0, 0.03) : 0, 0});
        listing.scene.speciesHandler.mixAll();
        const auto expected = listing.bruteForce();
        EXPECT_EQ(listing.listed(), expected);
    }
}

}  // namespace
}  // namespace pendular::contactListTest
