#include <gtest/gtest.h>

#include <array>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Periodic/ObliquePair.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/ShearOf.h"

namespace pendular::leesEdwardsTest {
namespace {

using periodic::Dry;
using periodic::Smooth;
using periodic::Wet;
using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::ShearedCloud;
using support::Random;

/// The box of the tables: 4 x 3 x 2 m, 0.5 /s, flow along x, gradient along y.
PeriodicBox boxOfTables(double time) {
    PeriodicBox box{{0, 0, 0}, {4, 3, 2}};
    support::shearOf(0, 1, 0.5).settle(box).move(box, time);
    return box;
}

/// Rows of the reference: time, place, velocity, and both inside the box (14 digits).
TEST(LeesEdwards, wrapsPlacesAndVelocities) {
    const std::array<std::array<double, 13>, 6> rows{
        {{0, -0.384, -0.015, 5.142, -0.816, 0.2, 0.457, 3.616, 2.985, 1.142, 0.684, 0.2, 0.457},
         {0, 0.916, -1.127, 0.46, 0.022, 0.782, 0.551, 0.916, 1.873, 0.46, 1.522, 0.782, 0.551},
         {0, 2.166, 2.934, 5.621, -0.124, 0.784, 0.227, 2.166, 2.934, 1.621, -0.124, 0.784, 0.227},
         {1, 0.851, 6.737, 2.921, 0.532, -0.186, -0.608, 1.851, 0.737, 0.921, -2.468, -0.186, -0.608},
         {1, 4.504, 2.745, 3.173, 0.013, 0.93, -0.547, 0.504, 2.745, 1.173, 0.013, 0.93, -0.547},
         {1, 6.819, 1.459, 0.184, -0.902, -0.221, -0.268, 2.819, 1.459, 0.184, -0.902, -0.221, -0.268}}};
    for (const auto& row : rows) {
        const PeriodicBox box = boxOfTables(row[0]);
        const Vector<double> place{row[1], row[2], row[3]}, velocity{row[4], row[5], row[6]};
        const Vector<double> wrapped = box.wrap(place);
        const Vector<double> after = velocity - PeriodicBox::slid(box.imageOf(place), box.imageVelocity);
        EXPECT_LT(norm(wrapped - Vector<double>{row[7], row[8], row[9]}), 1e-14);
        EXPECT_LT(norm(after - Vector<double>{row[10], row[11], row[12]}), 1e-14);
    }
}

TEST(LeesEdwards, findsTheNearestImageOfTheTables) {
    int compared = 0;
    const std::string file = "scenes-and-shapes/le_nearest.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    for (const auto& row : support::numbersOf(support::contentOf(support::sharedData(file)))) {
        const PeriodicBox box = boxOfTables(row[0]);
        const Vector<double> a{row[1], row[2], row[3]}, b{row[4], row[5], row[6]};
        // A contact knows the nearest image where it is nearer than half of each length.
        if (row[19] > 1) continue;
        const Vector<double> d = a - b;
        EXPECT_LT(norm(box.nearest(d) - Vector<double>{row[13], row[14], row[15]}), 1e-12);
        const Vector<double> speed{row[7] - row[10], row[8] - row[11], row[9] - row[12]};
        EXPECT_LT(norm(speed - PeriodicBox::slid(box.imagesIn(d), box.imageVelocity) -
                       Vector<double>{row[16], row[17], row[18]}),
                  1e-12);
        ++compared;
    }
    EXPECT_GT(compared, 0);
}

/// All pairs of a search are those of brute force over 27 images, for each choice of axes and grains of any
/// size.
TEST(LeesEdwards, searchFindsThePairsOfBruteForce) {
    Random random(11);
    for (int flow = 0; flow < 3; ++flow)
        for (int gradient = 0; gradient < 3; ++gradient)
            for (const double time : {0.0, 0.7, 123.4}) {
                if (flow == gradient) continue;
                PeriodicBox box{{-1, 2, 0.5}, {5, 6, 4}};
                support::shearOf(flow, gradient, time > 1 ? -0.3 : 0.4).settle(box).move(box, time);
                std::vector<TranslationRecord> grains;
                for (int k = 0; k < 300; ++k) {
                    const Vec3D place = Vec3D(1.5, 5, 2.5) + Vec3D(random.inCube(4));
                    grains.push_back(
                        {toVector(place), random.uniform(0.05, k % 10 == 0 ? 0.9 : 0.3), {0, 0, 0}, 1});
                }
                const double margin = 0.1;
                const NeighbourSearch search(grains, margin, box);
                std::size_t found = 0;
                for (std::uint32_t k = 0; k < grains.size(); ++k)
                    search.forEachPartner(k, [&](std::uint32_t) { ++found; });
                std::size_t expected = 0;
                for (std::size_t a = 0; a < grains.size(); ++a)
                    for (std::size_t b = 0; b < a; ++b) {
                        const Vector<double> d = box.wrap(grains[a].position) - box.wrap(grains[b].position);
                        bool near = false;
                        for (int n = -1; n <= 1; ++n)
                            for (int l = -3; l <= 3; ++l)
                                for (int m = -1; m <= 1; ++m) {
                                    Vector<double> image = d - PeriodicBox::slid(double(n), box.imageShift);
                                    const int third = 3 - flow - gradient;
                                    image.*vectorAxes[flow] -= l * box.length.*vectorAxes[flow];
                                    image.*vectorAxes[third] -= m * box.length.*vectorAxes[third];
                                    near |= norm(image) < grains[a].radius + grains[b].radius + margin;
                                }
                        expected += near ? 1 : 0;
                    }
                EXPECT_EQ(found, expected) << flow << gradient << " at " << time;
                EXPECT_GT(expected, 200u);
            }
}

/// Two grains that meet across the face, in closed form (linear spring, e = 0.8; reference table). They fly
/// from time 0 to 3 ms, where the table begins.
TEST(LeesEdwards, aCollisionAcrossTheFaceIsThatOfTheClosedForm) {
    const auto error = [](double step) {
        Smooth species = boxMaterial<Smooth>(0);
        species.setDensity(2500);
        const double mass = 2500 * 4.0 / 3 * std::numbers::pi * 1e-9;
        species.setStiffnessAndRestitutionCoefficient(1000, 0.8, mass);
        const double before = 3e-3;  // s
        FewGrains<Smooth> scene(species,
                                {{.position = Vec3D(0.004, 0.0096, 0.005) - before * Vec3D(0.1, 0.05, 0),
                                  .velocity = {0.1, 0.05, 0}},
                                 {.position = Vec3D(0.00382, 0.00136, 0.005) - before * Vec3D(-0.7, -0.35, 0),
                                  .velocity = {-0.7, -0.35, 0}}},
                                step);
        scene.setPeriodic(0, 0, 0.02);
        scene.setPeriodic(1, 0, 0.01);
        scene.setPeriodic(2, 0, 0.02);
        scene.setLeesEdwards(0, 1, 50);
        scene.run(static_cast<int>(std::lround(4e-3 / step)));
        const PeriodicBox& box = scene.getPeriodicBox();
        const std::array<std::array<Vector<double>, 2>, 2> expected{
            {{{{0.00396534785087414, 0.00947046380116551, 0.005}, {-0.17, -0.31, 0}}},
             {{{0.00325465214912587, 0.00118953619883449, 0.005}, {-0.43, 0.01, 0}}}}};
        // The step errs to second order: (omega h)^2 / 12 of half the speed, of each grain.
        const double omega = std::sqrt(1000 / (0.5 * mass));
        const double bound = 0.5 * square(omega * step) / 12;
        double largest = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const GrainMotion found = scene.motion(k);
            const Vector<double> place = toVector(found.position);
            const Vector<double> velocity =
                toVector(found.velocity) - PeriodicBox::slid(box.imageOf(place), box.imageVelocity);
            EXPECT_LT(norm(velocity - expected[k][1]), bound);
            EXPECT_LT(norm(box.wrap(place) - expected[k][0]), 1e-3 * bound);  // less than 1 ms has gone
            largest = std::max(largest, norm(velocity - expected[k][1]));
        }
        return largest;
    };
    const double coarse = error(4e-7), fine = error(2e-7);
    EXPECT_GT(coarse, 3 * fine);
}

constexpr double side = 0x1p-6;   // m
constexpr double step = 0x1p-20;  // s
constexpr double rate = 60;       // 1/s
const Vec3D middle = Vec3D::Constant(side / 2);

/// Two grains that meet obliquely at a place of a flow.
template <class S>
class PairInFlow : public FewGrains<S> {
public:
    PairInFlow(const Vec3D& place, int flow, int gradient, double shearRate)
        : FewGrains<S>(boxMaterial<S>(0), motions(place, flow, gradient, shearRate), step) {
        periodic::repeatAlongAllAxes(*this, side);
        this->setLeesEdwards(flow, gradient, shearRate);
    }

private:
    static std::vector<GrainMotion> motions(const Vec3D& place, int flow, int gradient, double shearRate) {
        // What carries the pair as a whole: a flow that is at rest in the middle of the box.
        return periodic::obliquePair(place, shearRate * (place[gradient] - side / 2) * Vec3D::Unit(flow));
    }
};

template <class S>
class LeesEdwardsPair : public testing::Test {};
TYPED_TEST_SUITE(LeesEdwardsPair, periodic::SpeciesOfAllKinds);

/// A pair with friction or bridges, too, for all axes: carried with the flow of its place, it meets as in the
/// middle of the box. The tolerances are those of FaceTest, and for the speed of the flow that is added to
/// each velocity: round-off of 1 m/s in 1500 steps, 1500 x 2.2e-16, below them.
TYPED_TEST(LeesEdwardsPair, meetsEverywhereAsInTheMiddle) {
    constexpr int steps = 1500;
    for (int flow = 0; flow < 3; ++flow)
        for (int gradient = 0; gradient < 3; ++gradient) {
            if (flow == gradient) continue;
            PairInFlow<TypeParam> expected(middle, flow, gradient, rate);
            expected.run(steps);
            ASSERT_GT((expected.motion(0).velocity - Vec3D(0.3, 0.5, 0.2)).norm(), 0.03);
            ASSERT_LT((expected.motion(0).velocity - Vec3D(0.3, 0.5, 0.2)).norm(), 0.2);  // 0.25 before
            for (int offset = -4; offset <= 4; ++offset) {
                Vec3D place = middle;
                place[gradient] += side / 2 + 0.25 * offset * 1e-3;
                place[flow] += 0.4 * side;
                PairInFlow<TypeParam> scene(place, flow, gradient, rate);
                scene.run(steps);
                const PeriodicBox& box = scene.getPeriodicBox();
                periodic::expectPairsMoveAlike(scene, expected);
                for (std::size_t k : {0, 1}) {
                    Vec3D shift = place - middle;
                    shift[flow] += rate * (place[gradient] - side / 2) * steps * step;
                    const Vector<double> off =
                        toVector(Vec3D(scene.motion(k).position - expected.motion(k).position - shift));
                    EXPECT_LT(norm(box.nearest(off)), periodic::pairSpeedTolerance * steps * step);
                }
            }
        }
}

TEST(LeesEdwards, ofRateZeroHasTheBitsOfAPeriodicScene) {
    ShearedCloud<Dry> periodic(std::nullopt);
    EXPECT_EQ(ShearedCloud<Dry>(0).hashAfter(1000), periodic.hashAfter(1000));
}

TEST(LeesEdwards, hasTheSameBitsForAnyThreads) {
    periodic::expectSameBitsForAnyThreads([] { return ShearedCloud<Wet>(200); }, {2, 3, 8});
}

/// No pair is missed by a list that lasts: all that overlap are known to touch. Grains move by several
/// diameters against each other.
TEST(LeesEdwards, noContactIsMissed) {
    for (const int gradient : {0, 1, 2}) {
        ShearedCloud<Dry> scene(400, gradient);
        EXPECT_GT(periodic::overlapsKnownInRounds(scene, 60, 200), 1000u);
        EXPECT_GT(scene.contacts().rebuildCount(), 20u);
        EXPECT_LT(scene.contacts().rebuildCount(), 1000u);  // not at each step, as with the speed of the flow
    }
}

/// d/dt of the energy is what the sliding images give, minus what is lost: to round-off, in a flow that has
/// gone by several diameters, with friction and bridges, with grains that go over to other images.
TEST(LeesEdwards, energyLedgerCloses) {
    ShearedCloud<Wet> scene(400);
    scene.keepEnergyLedger();
    scene.initialise();
    const double atStart = scene.energyLedger().closed();
    scene.step(6000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.images, 0);
    EXPECT_GT(ledger.sliding, 0);
    // 6000 steps add some 3000 contacts each, whose largest is the kinetic energy: round-off of the sums
    // grows as the root of their number.
    const double scale = ledger.kinetic + ledger.images;
    EXPECT_LT(std::abs(ledger.closed() - atStart), 2.2e-16 * std::sqrt(6000 * 3000.0) * scale);
}

/// Against the flow, energy is gained by -rate x volume x sigma_xy and lost in contacts, at each instant:
/// reference A3.
TEST(LeesEdwards, theStressDoesTheWorkOfTheShear) {
    constexpr double shearRate = 400;
    ShearedCloud<Dry> scene(shearRate);
    const Vec3D mean = scene.getTotalMomentum() / scene.getTotalMass();
    for (auto&& grain : scene.particleHandler) grain.setVelocity(grain.getVelocity() - mean);
    scene.keepEnergyLedger();
    scene.initialise();
    scene.step(3000);
    const PeriodicBox& box = scene.getPeriodicBox();
    const double volume = box.length.x * box.length.y * box.length.z;
    const auto power = [&] { return -shearRate * volume * meanStress(scene).total()(0, 1); };
    const double before = periodic::energyAgainstFlow(scene);
    const double work = periodic::workOver(scene, 2000, power);
    EXPECT_GT(work, 0);
    // A contact lasts some 300 steps, over which trapezoids err by (2 pi / 300)^2 / 12 of its power.
    EXPECT_NEAR(periodic::energyAgainstFlow(scene) - before, work, 1e-4 * work);
}

TEST(LeesEdwards, whatDoesNotFitIsRefused) {
    const auto refusal = [](auto&& change) { return periodic::refusalOfOneGrain(2, change); };
    EXPECT_EQ(refusal([](auto& s) { s.setLeesEdwards(0, 1, 3); }), "");
    for (const double bad : {std::nan(""), infinity, -infinity})
        EXPECT_TRUE(support::contains(refusal([=](auto& s) { s.setLeesEdwards(0, 1, bad); }), "shear rate"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setLeesEdwards(3, 1, 1); }), "axis of the flow"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setLeesEdwards(0, -1, 1); }), "gradient"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setLeesEdwards(1, 1, 1); }), "two axes"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setLeesEdwards(2, 1, 1); }), "setPeriodic"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) {
                                      s.setLeesEdwards(0, 1, 1);
                                      s.setGravity({0, -9.81, 0});
                                  }),
                                  "gravity along the gradient"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) {
                                      s.setLeesEdwards(0, 1, 1);
                                      InfiniteWall wall;
                                      wall.set({0, 0, -1}, {0, 0, 0});
                                      wall.setSpecies(s.speciesHandler.getObject(0));
                                      s.wallHandler.copyAndAddObject(wall);
                                  }),
                                  "walls"));
}

}  // namespace
}  // namespace pendular::leesEdwardsTest
