// What a run changes between steps.
#include <gtest/gtest.h>

#include <set>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::changesTest {
namespace {

using namespace membraneTests;

/// The identities of the grains that touch a wall.
std::set<std::uint32_t> touching(Trampoline& scene) {
    std::set<std::uint32_t> found;
    const ContactSystem& contacts = scene.contacts();
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
        const std::uint32_t place = contacts.firstOf(c);
        if (bucket.wall >= 0 && contacts.touches(c))
            found.insert(scene.particleHandler.store().identity[place]);
    });
    return found;
}

void runUntilThreeTouch(Trampoline& scene) {
    scene.run(500);
    for (int k = 0; k < 2000 && touching(scene).size() < 3; ++k) scene.step();
    ASSERT_GE(touching(scene).size(), 3U);
}

/// One grain is put elsewhere; the forces of all others are found again where they touch.
TEST(Membrane, aGrainThatIsMovedLeavesTheForcesOfOthersAndARestartKnowsThem) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    Trampoline whole;
    runUntilThreeTouch(whole);
    const std::uint32_t moved = *touching(whole).begin();
    whole.particleHandler.getObject(moved).setPosition({0.1, 0.1, 0.1});
    whole.writeRestart(file);
    Trampoline resumed;
    resumed.sheet->keepForces();  // summed when the file is read
    resumed.restartFrom(file);
    resumed.initialise();
    Vec3D force = Vec3D::Zero(), torque = Vec3D::Zero();
    double size = 0;
    for (std::size_t v = 0; v < whole.sheet->getHeld().size(); ++v) {
        const Vec3D onVertex = whole.sheet->getForceOfGrains(v);
        force += onVertex;
        torque += whole.sheet->getPosition(v).cross(onVertex);
        size += onVertex.norm();
    }
    EXPECT_GT(size, 0);
    EXPECT_LT((force - resumed.sheet->getForce()).norm(), 1e-13 * size);
    EXPECT_LT((torque - resumed.sheet->getTorque()).norm(), 1e-13 * size * 24e-3);
    whole.steps(600);
    resumed.steps(600);
    EXPECT_EQ(wholeHash(resumed), wholeHash(whole));
}

TEST(Membrane, theLedgerKnowsMembranesThatComeAndGo) {
    Trampoline scene;
    scene.keepEnergyLedger();
    scene.run(400);
    const EnergyLedger& ledger = scene.energyLedger();
    const double first = ledger.closed(), elastic = ledger.membraneElastic;
    const double tolerance = 1e-12 * (std::abs(ledger.potential) + ledger.kinetic + elastic);
    ASSERT_GT(elastic, 1e6 * tolerance);
    ASSERT_TRUE(touching(scene).empty());
    scene.wallHandler.copyAndAddObject(*scene.sheet);
    scene.step();
    EXPECT_NEAR(ledger.closed(), first, tolerance);
    EXPECT_GT(ledger.membraneElastic, 1.9 * elastic);
    scene.wallHandler.removeObject(0);
    scene.step();
    EXPECT_NEAR(ledger.closed(), first, tolerance);
    EXPECT_LT(ledger.membraneElastic, 1.1 * elastic);
}

/// The copy has no contacts yet, and no step before its first.
TEST(Membrane, aCopyThatComesInARunHasItsOwnForces) {
    const support::TestFolder folder;
    for (const Integrator& integrator : integrators::all) {
        Trampoline scene;
        scene.setIntegrator(integrator);
        runUntilThreeTouch(scene);
        const Membrane* const copy = scene.wallHandler.copyAndAddObject(*scene.sheet);
        scene.writeRestart(folder.name() + ".h5");
        for (std::size_t v = 0; v < copy->getHeld().size(); ++v) {
            EXPECT_EQ(copy->getForceOfGrains(v), Vec3D::Zero()) << integrator.name;
            EXPECT_EQ(toEigen(copy->state().earlier.at(v)), toEigen(copy->state().acceleration[v]));
        }
        scene.steps(10);
    }
}

/// Nothing is damped, whatever the gravity.
TEST(Membrane, aChangeOfGravityIsNotDamping) {
    MembraneScene scene({});
    scene.add(wavySheet());
    scene.setGravity({0, 0, -10});
    scene.keepEnergyLedger();
    scene.run(100);
    scene.setGravity({5, 0, 30});
    scene.steps(100);
    const EnergyLedger& ledger = scene.energyLedger();
    ASSERT_GT(ledger.membranes, 0);
    EXPECT_LT(std::abs(ledger.membraneDamping), 1e-12 * ledger.membranes);
}

/// Two triangles on a square between two others: their common edge is one diagonal or the other.
TEST(Membrane, aRestartKnowsHowCornersAreJoined) {
    using Point = Vector<double>;
    const Point o{0, 0, 0}, x{edge, 0, 0}, y{0, edge, 0}, xy{edge, edge, 0};
    const Triangle below{Point{0.5 * edge, -edge, 0}, x, o}, above{y, xy, Point{0.5 * edge, 2 * edge, 0}};
    const std::vector<Triangle> one{below, above, {o, x, xy}, {o, xy, y}},
        other{below, above, {o, x, y}, {x, xy, y}};
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    MembraneScene scene({});
    scene.add(one);
    scene.run(2);
    scene.writeRestart(file);
    MembraneScene resumed({});
    resumed.add(other);
    resumed.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { resumed.initialise(); }), "cornersOfTriangles"));
}

/// A pressure whose forces are above all numbers; the last vertices are held, and stay where they are.
TEST(Membrane, aVertexThatIsNowhereEndsTheRun) {
    MembraneScene scene({});
    std::vector<Triangle> large = wavySheet();
    for (Triangle& triangle : large)
        for (Vector<double>& p : triangle) p = 1e4 * p;
    Membrane* const sheet = scene.add(large);
    sheet->holdRim();
    scene.initialise();
    sheet->setPressure(1.7e308);
    try {
        scene.steps(3);
        FAIL() << "it went on";
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        EXPECT_TRUE(support::contains(error.what(), "is not finite")) << error.what();
    }
}

}  // namespace
}  // namespace pendular::changesTest
