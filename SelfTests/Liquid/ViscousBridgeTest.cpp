#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Liquid/ViscousPair.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Bridges that resist motion: their coefficients against closed forms and given numbers, and the speeds that
// scenes lose between two gaps.

namespace pendular::viscousBridgeTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

using namespace wet;

// Only scenes whose bridges resist pay for it: four numbers a contact, and torques.
using Plain = Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>;
static_assert(columnsOf<Wet::Adhesion::Interaction> == columnsOf<Plain::Adhesion::Interaction> + 4);
static_assert(!Plain::hasTorque && Wet::hasContactTorque);
static_assert(!HasDynamicRupture<LiquidBridgeWillett> && HasDynamicRupture<ViscousLiquidBridgeWillett>);

const Vec3D none = Vec3D::Zero();

BridgeResistance<double> resistance(ViscousLiquidBridgeWillett law, const Bodies& bodies, double gap) {
    law.setViscousScheme(ViscousScheme::Implicit);
    auto bridge = law.prepare(bodies);
    BridgeMotion<double> motion{};
    motion.separation = gap;
    motion.step = 1e-6;
    motion.effectiveRadius = bodies.effectiveRadius();
    motion.asymmetry = std::isinf(bodies.radius2)
                           ? 1
                           : (bodies.radius2 - bodies.radius1) / (bodies.radius1 + bodies.radius2);
    return bridge.resist(law, motion);
}

// F (N) at 10 mm/s with V = 1e-11 m^3 and 0.1 Pa s, from an independent program: plain, and with the end of
// the liquid; seven digits are given.
TEST(ViscousBridge, givesTheNormalForcesOfTheTable) {
    struct Row {
        Bodies bodies;
        double gap, plain, finite;
    };
    for (const Row& row :
         {Row{{1e-3, 1e-3}, 1 * um, 4.712389e-3, 4.595016e-3},
          Row{{1e-3, 1e-3}, 10 * um, 4.712389e-4, 3.613215e-4},
          Row{{1e-3, 1e-3}, 100 * um, 4.712389e-5, 2.246203e-6},
          Row{{1e-3}, 1 * um, 1.884956e-2, 1.818738e-2}, Row{{1e-3}, 10 * um, 1.884956e-3, 1.284425e-3},
          Row{{1e-3}, 100 * um, 1.884956e-4, 3.139380e-6},
          Row{{0.5e-3, 0.8e-3}, 1 * um, 1.784573e-3, 1.749656e-3},
          Row{{0.5e-3, 0.8e-3}, 10 * um, 1.784573e-4, 1.452431e-4},
          Row{{0.5e-3, 0.8e-3}, 100 * um, 1.784573e-5, 1.594524e-6}})
        for (const bool finite : {false, true}) {
            const double force =
                0.01 * resistance(liquid(0.1, 1e-11, 0.1 * um, finite), row.bodies, row.gap).normal;
            EXPECT_NEAR(force / (finite ? row.finite : row.plain), 1, 5e-7) << row.gap << finite;
        }
}

// Slip u (m/s), spin difference Omega (rad/s) -> tangential force and torque of both laws, from an
// independent program; ten digits are given.
TEST(ViscousBridge, givesTheTangentialForcesOfTheTable) {
    struct Row {
        Bodies bodies;
        double viscosity, gap, slip, spin, popular, pair, torque;
    };
    for (const Row& row :
         {Row{{1e-3, 1e-3}, 1e-3, 10 * um, 0.1, 0, -2.870044948e-6, -6.548922185e-7, 0},
          Row{{1e-3}, 1e-3, 10 * um, 0.1, 50, -6.436917446e-6, -2.413063681e-6, -2.632433107e-9},
          Row{{0.5e-3, 0.8e-3}, 0.1, 20 * um, 0.05, -20, -7.007964086e-5, -1.58709783e-5, 9.034712503e-11},
          Row{{0.5e-3, 0.8e-3},
              0.1,
              0.1 * um,
              0.05,
              -20,
              -1.164125418e-4,
              -4.458485467e-5,
              2.538037268e-10}}) {
        auto law = liquid(row.viscosity, 1e-11, 1 * um, true);
        const double radius = row.bodies.effectiveRadius(), roll = radius * row.spin;
        const auto pair = resistance(law, row.bodies, row.gap);
        EXPECT_NEAR(-(pair.sliding * row.slip + pair.coupling * roll) / row.pair, 1, 1e-9);
        EXPECT_NEAR(-radius * (pair.coupling * row.slip + pair.rolling * roll), row.torque,
                    1e-9 * std::abs(row.torque));
        law.setTangentialLubrication(TangentialLubrication::Popular);
        const auto popular = resistance(law, row.bodies, row.gap);
        EXPECT_NEAR(-popular.sliding * row.slip / row.popular, 1, 1e-9);
        EXPECT_EQ(popular.coupling, 0);
        EXPECT_EQ(popular.rolling, 0);
        law.setTangentialLubrication(TangentialLubrication::None);
        EXPECT_EQ(resistance(law, row.bodies, row.gap).sliding, 0);
    }
}

// A(100 um) - A(1 um) and A(infinity) - A(1 um) for V = 1e-11 m^3, R* = 0.5 mm, to the digits given; plain it
// is a logarithm.
TEST(ViscousBridge, integratesItsResistanceInClosedForm) {
    const auto finite = lubricationIntegral(1e-11 / (std::numbers::pi * 0.5e-3), 1 * um);
    const auto plain = lubricationIntegral(LubricationIntegral<double>::endless, 1 * um);
    const auto way = [](const auto& integral, double from, double to) {
        return integral.at(to, 1 * um) - integral.at(from, 1 * um);
    };
    EXPECT_NEAR(way(finite, 1 * um, 100 * um), 3.00294180, 1e-8);
    EXPECT_NEAR(way(finite, 1 * um, 1), 3.01807157, 1e-8);
    EXPECT_NEAR(way(plain, 1 * um, 100 * um), std::log(100), 1e-12);
    EXPECT_NEAR(way(plain, 0, 1 * um), 1, 1e-14);
    // Its slope is the resistance: differences over d with an error of d^2 / 6 m (m + 1) / gap^2 of
    // it where it falls with the power m, which is 5 at most.
    for (const double gap : {0.5 * um, 2 * um, 10 * um, 90 * um}) {
        const double d = 1e-4 * gap;
        for (const auto& integral : {finite, plain})
            EXPECT_NEAR(way(integral, gap - d, gap + d) / (2 * d) / integral.slope(gap, 1 * um), 1, 5e-8)
                << gap;
    }
}

// At any step: the speed lost on the way in is K (A(h0) - A(0)), and on the way out up to the rupture
// K (A(S_c) - A(h0)). Round-off: some 1e3 steps of 2^-53 of the speed, and of gaps (1e-16 of 1 mm) over the
// roughness.
TEST(ViscousBridge, losesTheExactSpeedBetweenTwoGapsAtAnyStep) {
    for (const bool atWall : {false, true})
        for (const bool withVolume : {false, true})
            for (const double shift : {0.01, 0.1, 1.0, 3.0, 10.0}) {  // of the roughness in a step
                Pair pair{.atWall = atWall, .withVolume = withVolume};
                const double step = shift * pair.roughness / pair.speed;
                auto in = pair.scene(ghosts(pair), step);
                begin(in, pair.gap);
                while (pair.gapIn(in) > 0) in.step();
                in.step(), in.step();
                EXPECT_NEAR(pair.closing(in) / pair.speed, 1 - pair.k() / pair.speed * pair.way(0, pair.gap),
                            1e-9)
                    << atWall << withVolume << shift;

                pair.speed = -0.1, pair.gap = 2 * um;
                auto out = pair.scene(ghosts(pair), step);
                begin(out, pair.gap);
                while (pair.gapIn(out) < pair.rupture()) out.step();
                out.step(), out.step();
                EXPECT_NEAR(pair.closing(out) / pair.speed,
                            1 + pair.k() / pair.speed * pair.way(pair.gap, pair.rupture()), 1e-9)
                    << atWall << withVolume << shift;
            }
}

// Liquid as thick as syrup stops a pair at the gap h0 exp(-v / K), whatever the step is. (At 1e-3 s, 40 times
// h / K, two tangents leave some 5e-4 of the way, and then the pair stands.)
TEST(ViscousBridge, stopsAPairWhereItsSpeedIsUsedUp) {
    Pair pair{.radius = 0.5e-3, .viscosity = 1, .volume = 2e-12, .gap = 50 * um, .speed = 0.3};
    for (const double step : {1e-6, 1e-5, 1e-4, 1e-3}) {
        auto scene = pair.scene(ghosts(pair), step);
        begin(scene, pair.gap);
        while (scene.getTime() < 0.1) {
            scene.step();
            ASSERT_GT(pair.closing(scene), -1e-12 * pair.speed) << step;
        }
        EXPECT_NEAR(pair.gapIn(scene) / (pair.gap * std::exp(-pair.speed / pair.k())), 1,
                    step > 1e-4 ? 1e-3 : 1e-9)
            << step;
    }
}

// The restitution of both sets, at a step of 1/20 of the roughness over the speed: without capillary force it
// is the closed form but for the contact's own error (1e-4 at 50 steps a contact, and it has 600); with it
// the scheme is of second order.
TEST(ViscousBridge, followsTheGivenCollisions) {
    struct Row {
        GivenSet set;
        bool capillary, withVolume;
        double restitution;
    };
    for (const Row& row : {Row{setA(), false, false, 0.6942948069}, Row{setA(), false, true, 0.7753658422},
                           Row{setA(), true, false, 0.332267226}, Row{setA(), true, true, 0.483103928},
                           Row{setB(), false, false, 0.3345346142}, Row{setB(), false, true, 0.5138362061}}) {
        const double step = 0.05 * row.set.pair.roughness / row.set.pair.speed;
        auto scene = row.set.pair.scene(material(row.set, row.capillary, row.withVolume), step);
        begin(scene, row.set.pair.gap);
        const double rupture = row.set.pair.rupture();
        do scene.step();
        while (row.set.pair.gapIn(scene) < rupture);
        scene.step(), scene.step();
        EXPECT_NEAR(-row.set.pair.closing(scene) / row.set.pair.speed, row.restitution, 1e-4)
            << row.set.pair.radius << row.capillary << row.withVolume;
    }
}

// The bridges of set B hold: where the grains turn back, m.
TEST(ViscousBridge, holdsThePairsThatAreGivenAsHeld) {
    for (const bool withVolume : {false, true}) {
        const GivenSet set = setB();
        auto scene = set.pair.scene(material(set, true, withVolume), 1e-7);
        begin(scene, set.pair.gap);
        while (set.pair.gapIn(scene) > 0) scene.step();
        double farthest = 0;
        while (set.pair.closing(scene) > 0 || set.pair.gapIn(scene) < 0) scene.step();
        while (set.pair.closing(scene) < 0)
            scene.step(), farthest = std::max(farthest, set.pair.gapIn(scene));
        EXPECT_NEAR(farthest / (withVolume ? 128.9376443 * um : 50.83969169 * um), 1, 1e-3) << withVolume;
    }
}

// Set F: capillarity pulls grains together through syrup. The time of the touch, and its speed.
TEST(ViscousBridge, creepsInAtStepsFarAboveTheExplicitLimit) {
    const GivenSet set = setF();
    for (const bool withVolume : {false, true})
        for (const double step : {1e-5, 1e-4}) {
            auto scene = set.pair.scene(material(set, true, withVolume), step);
            begin(scene, set.pair.gap);
            double gap = set.pair.gap, time = 0, speed = 0;
            while (set.pair.gapIn(scene) > 0) {
                gap = set.pair.gapIn(scene), time = scene.getTime();
                speed = set.pair.closing(scene);
                scene.step();
            }
            time += step * gap / (gap - set.pair.gapIn(scene));
            // 1e-5 s is 9 times 2 eps / K. Backward Euler with c(h) errs by 1.4e-3 there and by 8.6e-3 at ten
            // times the step, as an independent program finds; this is to be twice as good.
            const double error = time / (withVolume ? 19.5859202e-3 : 32.1572807e-3) - 1;
            EXPECT_LT(std::abs(error), 0.5 * (step > 5e-5 ? 8.6e-3 : 1.4e-3)) << step;
            EXPECT_NEAR(speed / (withVolume ? 1.942888e-4 : 1.866663e-4), 1, 0.02) << step;
        }
}

/// A - A(0) at the gap h: what the speed pays, over K, between there and the touch.
double waysOf(const Pair& pair, double gap) { return pair.way(0, gap); }

// e over the Stokes number, in both conventions. Full: damped on both ways, e = (e_dry (v0 - K L_in) - K
// L_out) / v0, with L = A(h0) - A(0) inward and A(S_c) - A(0) outward. Inward only (cavitation, the
// literature's e_dry (1 - St_c / St)): L_out = 0. Here the closed form of the law's own integral against
// given numbers.
TEST(ViscousBridge, hasTheRestitutionOfBothConventions) {
    struct Row {
        Pair pair;
        double k, in, out, full, inward, fullFinite, inwardFinite;
    };
    Pair b = setB().pair, g{.radius = 0.2e-3,
                            .density = 2650,
                            .viscosity = 0.85e-3,
                            .volume = 8e-14,
                            .gap = 10 * um,
                            .speed = 0.1};
    for (const Row& row :
         {Row{setA().pair, 1.8e-3, 5.605170186, 6.383413117, 0.694294807, 0.809196243, 0.775365842,
              0.841001183},
          Row{b, 1.206e-2, 5.605170186, 6.677266107, 0.334534614, 0.656645931, 0.513836206, 0.717763171},
          Row{g, 3.60849057e-3, 3.302585093, 4.784576186, 0.620092895, 0.792743876, 0.739663496,
              0.825719110}})
        for (const bool finite : {false, true}) {
            Pair pair = row.pair;
            pair.withVolume = finite;
            EXPECT_NEAR(pair.k() / row.k, 1, 2e-9);
            const double in = waysOf(pair, pair.gap), out = waysOf(pair, pair.rupture());
            if (!finite) {
                EXPECT_NEAR(in, row.in, 1e-9);
                EXPECT_NEAR(out, row.out, 1e-9);
            }
            const double inverse = pair.k() / pair.speed;  // 1 / St
            EXPECT_NEAR(0.9 * (1 - inverse * in) - inverse * out, finite ? row.fullFinite : row.full, 1e-9);
            EXPECT_NEAR(0.9 * (1 - inverse * in), finite ? row.inwardFinite : row.inward, 1e-9);
        }
}

// Scenes give these restitutions, too, from the dry restitution 0.9 at Stokes numbers from where no grain
// returns to where the liquid is hardly felt: within the error of the contact at the steps that its 300 or
// more samples are, 1e-4.
TEST(ViscousBridge, collidesWithTheRestitutionOfItsStokesNumber) {
    for (const double stokes : {8.0, 14.0, 30.0, 100.0, 1000.0}) {
        GivenSet set = setA();
        set.pair.withVolume = true;
        set.pair.speed = stokes * set.pair.k();
        const double inverse = 1 / stokes;
        const double expected = 0.9 * (1 - inverse * waysOf(set.pair, set.pair.gap)) -
                                inverse * waysOf(set.pair, set.pair.rupture());
        auto scene = set.pair.scene(material(set, false, true), 2e-4 * set.pair.gap / set.pair.speed);
        begin(scene, set.pair.gap);
        while (set.pair.gapIn(scene) > 0) scene.step();
        while (set.pair.gapIn(scene) < 0) scene.step();
        while (set.pair.gapIn(scene) < set.pair.rupture() && set.pair.closing(scene) < -1e-6 * set.pair.speed)
            scene.step();
        scene.step(), scene.step();
        EXPECT_NEAR(-set.pair.closing(scene) / set.pair.speed, std::max(expected, 0.0), 1e-4) << stokes;
    }
}

// The numbers that matter are V*, St, eps / R and h0 / R: grains of a metre and of a micrometre are alike.
TEST(ViscousBridge, isTheSameAtAnySize) {
    double first = 0;
    for (const double scale : {1e-3, 1.0, 1e3}) {  // of grains of 1 mm
        GivenSet set = setA();
        set.pair.withVolume = true;
        set.pair.radius *= scale, set.pair.roughness *= scale, set.pair.gap *= scale;
        set.pair.volume *= scale * scale * scale;
        set.pair.speed /= scale;  // K goes with 1 / R
        set.pair.tension = 1e-15 / scale;
        auto s = set.pair.species<HertzWet>();
        s.setEffectiveElasticModulusAndRestitutionCoefficient(1e7 / (scale * scale), 0.9);
        auto scene = set.pair.scene(s, 0.05 * set.pair.roughness / set.pair.speed);
        begin(scene, set.pair.gap);
        for (int k = 0; k < 90000; ++k) scene.step();
        ASSERT_GT(set.pair.gapIn(scene), set.pair.rupture());
        const double restitution = -set.pair.closing(scene) / set.pair.speed;
        if (first == 0) first = restitution;
        // Round-off: gaps are differences of positions, with 2^-53 of the radius over the roughness, 1e-13,
        // in each of 1e5 steps, which add up like a random walk.
        EXPECT_NEAR(restitution, first, 1e-9) << scale;
    }
}

// A wall is a sphere of infinite radius: one of 1000 times the radius, held, is nearly so. Also the gap at
// which the liquid is thicker than the roughness hides nothing: viscosities of 0 and 1 Pa s at a wall differ
// by K (L_in + L_out), to the error of the elastic contact.
TEST(ViscousBridge, isFeltAtWallsAndAtVeryLargeSpheresAlike) {
    const auto collide = [](double viscosity, double otherRadius) {
        Pair pair{.viscosity = viscosity, .speed = 40, .atWall = true};
        auto s = pair.species<Wet>();
        s.setStiffness(1e6);
        s.setDissipation(0);
        std::vector<GrainMotion> grains{{.radius = pair.radius,
                                         .position = {-pair.radius - pair.gap, 0, 0},
                                         .velocity = {pair.speed, 0, 0}}};
        std::vector<scenes::PlaneAt> planes;
        if (std::isinf(otherRadius)) planes.push_back({{1, 0, 0}, none});
        else grains.push_back({.radius = otherRadius, .position = {otherRadius, 0, 0}, .fixed = true});
        FewGrains<Wet> scene(s, grains, 1e-7, planes);
        begin(scene, pair.gap);
        for (int k = 0; k < 400; ++k) scene.step();
        return -scene.motion(0).velocity.x();
    };
    const Pair pair{.viscosity = 1, .atWall = true};
    const double lost = collide(0, infinity) - collide(1, infinity);
    const double expected = pair.k() * (waysOf(pair, pair.gap) + waysOf(pair, pair.rupture()));
    EXPECT_NEAR(lost / expected, 1, 1e-3);
    EXPECT_NEAR((collide(0, 1) - collide(1, 1)) / lost, 1, 0.01);
}

// A grain slides along a wall at a constant gap, without gravity: v and spin against the given exact
// solution, to their ten digits; the scheme is of second order, (rate x step)^2 / 12 of the exponent, < 1e-7
// here.
TEST(ViscousBridge, slidesAndRollsAtAWallAsGiven) {
    struct Row {
        double time, popular, popularSpin, pair, pairSpin;
    };
    for (const Row& row : {Row{1e-4, 0.09446942999, 13.82642502, 0.09834024515, 1.01717414},
                           Row{3e-4, 0.08641271973, 33.96820066, 0.09511503044, 2.878457862},
                           Row{1e-3, 0.07475209666, 63.11975836, 0.08474139955, 7.838081406},
                           Row{3e-3, 0.07147354248, 71.3161438, 0.06143219541, 13.43403674}})
        for (const bool popular : {false, true}) {
            const Pair pair{.viscosity = 0.1, .gap = 10 * um, .atWall = true};
            Wet s = ghosts(pair);
            if (popular) s.setTangentialLubrication(TangentialLubrication::Popular);
            const double step = 5e-7;
            FewGrains<Wet> scene(s,
                                 {{.radius = pair.radius,
                                   .position = {0, 0, pair.radius + pair.gap},
                                   .velocity = {0.1, 0, 0}}},
                                 step, {{{0, 0, -1}, none}});
            begin(scene, pair.gap);
            for (int k = 0; k < std::lround(row.time / step); ++k) scene.step();
            EXPECT_NEAR(scene.motion(0).velocity.x() / (popular ? row.popular : row.pair), 1, 1e-7)
                << row.time;
            EXPECT_NEAR(scene.motion(0).spin.y() / (popular ? row.popularSpin : row.pairSpin), 1, 1e-6)
                << row.time;
        }
}

// Two unequal grains slip, roll and part: their linear and angular momentum stay, to the round-off of each of
// 3000 steps.
TEST(ViscousBridge, keepsTheMomentaOfAPair) {
    for (const auto law : {TangentialLubrication::Pair, TangentialLubrication::Popular}) {
        const Pair pair{.viscosity = 0.05, .gap = 20 * um};
        Wet s = ghosts(pair);
        s.setTangentialLubrication(law);
        FewGrains<Wet> scene(
            s,
            {{.radius = 1e-3, .position = {0, 0, 0}, .velocity = {0.01, 0.05, 0.02}, .spin = {10, -20, 30}},
             {.radius = 0.6e-3,
              .position = {1.6e-3 + pair.gap, 0, 0},
              .velocity = {-0.01, -0.05, 0},
              .spin = {5, 0, -40}}},
            1e-6);
        begin(scene, pair.gap);
        const Vec3D before = scene.angularMomentum(), linear = scene.linearMomentum();
        const Vec3D spin = scene.motion(0).spin;
        for (int k = 0; k < 3000; ++k) scene.step();
        EXPECT_GT((scene.motion(0).spin - spin).norm(), 1);
        EXPECT_LT((scene.angularMomentum() - before).norm(), 3000 * 0x1p-53 * before.norm());
        EXPECT_LT((scene.linearMomentum() - linear).norm(), 3000 * 0x1p-53 * linear.norm());
    }
}

// Equal grains that roll on each other without slip get a torque and no force.
TEST(ViscousBridge, resistsPureRollingOfEqualGrainsByTorqueOnly) {
    const auto law = liquid(1e-3, 1e-11, 1 * um, true);
    const auto found = resistance(law, {1e-3, 1e-3}, 10 * um);
    EXPECT_EQ(found.coupling, 0);
    EXPECT_GT(found.rolling, 0);
}

/// A crystal of 3^3 face-centred cells of equal grains with gaps of half the roughness, all joined, with
/// random velocities (of at most 0.1 mm/s: no gap closes in the run).
class Crystal : public FewGrains<Wet> {
public:
    Crystal(const Pair& pair, double step, double neighbours, int threads = 1)
        : FewGrains<Wet>(material(pair, neighbours), grains(pair), step) {
        setNumberOfThreads(threads);
    }

private:
    static Wet material(const Pair& pair, double neighbours) {
        Wet s = ghosts(pair);
        s.setTangentialLubrication(TangentialLubrication::None);
        s.setViscousNeighbours(neighbours);
        return s;
    }
    static std::vector<GrainMotion> grains(const Pair& pair) {
        std::vector<GrainMotion> all;
        const double edge = std::numbers::sqrt2 * (2 * pair.radius + 0.5 * pair.roughness);
        std::uint32_t seed = 1;
        const auto random = [&] {
            seed = seed * 1664525u + 1013904223u;
            return 1e-4 * (2.0 * seed / 4294967296.0 - 1);
        };
        for (int cell = 0; cell < 27; ++cell)
            for (const Vec3D& site :
                 {Vec3D(0, 0, 0), Vec3D(0.5, 0.5, 0), Vec3D(0.5, 0, 0.5), Vec3D(0, 0.5, 0.5)}) {
                const double x = random(), y = random(), z = random();
                all.push_back({.radius = pair.radius,
                               .position = edge * (Vec3D(cell % 3, cell / 3 % 3, cell / 9) + site),
                               .velocity = {x, y, z}});
            }
        return all;
    }
};
double kineticOf(FewGrains<Wet>& scene) {
    double sum = 0;
    for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k)
        sum += scene.motion(k).velocity.squaredNorm();
    return sum;
}

// No motion of a bed may be fed: its energy falls in every step up to the stability limit, which knows the
// resistance at the roughness, and does not at three times it. (At the exact limit of this scheme, c dt / m*
// = 1/3 in such a crystal, the fastest motion changes its sign from step to step.)
TEST(ViscousBridge, takesEnergyFromABedInEveryStepUpToTheStabilityLimit) {
    const Pair pair{.viscosity = 1};
    Crystal asked(pair, 1e-9, 1);
    const double limit = asked.stabilityLimit(), share = pair.k() / pair.roughness * limit;
    EXPECT_LE(share, 1.0 / 3);
    EXPECT_GT(share, 0.2);
    for (const double part : {0.1, 0.5, 1.0, 3.0}) {
        Crystal scene(pair, part * limit, 1);
        begin(scene, pair.roughness);
        double energy = kineticOf(scene);
        const double start = energy;
        bool rises = false;
        for (int k = 0; k < 100; ++k) {
            scene.step();
            rises |= kineticOf(scene) > energy;
            energy = kineticOf(scene);
            if (energy > 1e6 * start) break;
        }
        EXPECT_EQ(rises, part > 2) << part;
    }
}

// With viscousNeighbours of twelve the step is free: up to 1000 times the limit nothing grows, and in the end
// most of the energy is gone.
TEST(ViscousBridge, isStableInABedAtAnyStepForItsNumberOfNeighbours) {
    const Pair pair{.viscosity = 1};
    const double limit = Crystal(pair, 1e-9, 1).stabilityLimit();
    EXPECT_GT(Crystal(pair, 1e-9, 12).stabilityLimit(), 1e6 * limit);
    for (const double part : {0.5, 3.0, 30.0, 1000.0}) {
        Crystal scene(pair, part * limit, 12);
        begin(scene, pair.roughness);
        const double start = kineticOf(scene);
        for (int k = 0; k < 100; ++k) {
            scene.step();
            ASSERT_LE(kineticOf(scene), start) << part << " " << k;
        }
        EXPECT_LT(kineticOf(scene), 0.1 * start) << part;
    }
}

// The ledger's loss in viscous bridges is what the closed form says, the rest of its entries closes.
TEST(ViscousBridge, isInTheLedgerOfTheEnergy) {
    Pair pair{.atWall = true, .withVolume = true};
    auto scene = pair.scene(ghosts(pair), 1e-7);
    scene.keepEnergyLedger();
    begin(scene, pair.gap);
    const EnergyLedger& ledger = scene.energyLedger();
    const double start = ledger.closed();
    while (pair.gapIn(scene) > 0) scene.step();
    scene.step(), scene.step();
    const double touch = pair.speed - pair.k() * waysOf(pair, pair.gap);
    const double lost = 0.5 * pair.mass() * (pair.speed * pair.speed - touch * touch);
    EXPECT_NEAR(ledger.viscousBridges / lost, 1, 1e-8);
    EXPECT_NEAR(ledger.closed(), start, 1e-12 * lost);
}

// Same bits for any threads, lists and restarts, with what is still to be charged.
TEST(ViscousBridge, givesTheSameBitsForAnyThreadsListsAndRestarts) {
    const Pair pair{.viscosity = 1};
    const double step = Crystal(pair, 1e-9, 1).stabilityLimit();
    const auto hash = [](FewGrains<Wet>& scene) { return stateHash(scene.particleHandler.store()); };
    Crystal one(pair, step, 1), three(pair, step, 1, 3), relisted(pair, step, 1);
    for (auto* scene : {&one, &three, &relisted}) {
        begin(*scene, pair.roughness);
        for (int k = 0; k < 200; ++k) {
            if (scene == &relisted) {
                auto grain = relisted.particleHandler.getObject(5);
                grain.setRadius(grain.getRadius());
            }
            scene->step();
        }
    }
    EXPECT_EQ(hash(one), hash(three));
    EXPECT_EQ(hash(one), hash(relisted));

    const support::TestFolder folder;
    Crystal half(pair, step, 1);
    begin(half, pair.roughness);
    for (int k = 0; k < 90; ++k) half.step();
    half.writeRestart(folder.path() / "half.h5");
    for (int k = 0; k < 110; ++k) half.step();
    half.writeRestart(folder.path() / "whole.h5");
    Crystal resumed(pair, step, 1);
    resumed.acceptUnstableTimeStep();
    resumed.setQuiet();
    resumed.joinAtStart(1.01 * pair.roughness);
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    for (int k = 0; k < 110; ++k) resumed.step();
    resumed.writeRestart(folder.path() / "resumed.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
}

// Those that join bodies at the start are told and counted as those that form later: at a gap, and where
// bodies touch once.
TEST(ViscousBridge, tellsOfBridgesThatJoinBodiesAtTheStart) {
    const Pair pair{.speed = 0};
    scenes::HookedGrains<Wet> scene(ghosts(pair),
                                    {{.radius = pair.radius, .position = {-2e-3 - pair.gap, 0, 0}},
                                     {.radius = pair.radius, .position = {0, 0, 0}},
                                     {.radius = pair.radius, .position = {2e-3 - 1 * um, 0, 0}}},
                                    1e-7);
    scene.listenToContacts();
    begin(scene, pair.gap);
    using Kind = ContactEvent::Kind;
    const std::vector<ContactEvent> expected{
        {0, 1, -1, 0, Kind::BridgeForms}, {1, 2, -1, 0, Kind::BridgeForms}, {1, 2, -1, 0, Kind::TouchBegins}};
    EXPECT_EQ(scene.heard, expected);
    EXPECT_EQ(scene.contactEventCounts().bridgesFormed, 2u);
    scene.step();
    EXPECT_EQ(scene.contactEventCounts().bridgesFormed, 2u);
}

// A grain that is put somewhere else has not moved there: nothing is charged for the way.
TEST(ViscousBridge, chargesNothingForGrainsThatArePutSomewhereElse) {
    const Pair pair{.viscosity = 1, .gap = 10 * um, .speed = 0, .atWall = true};
    auto scene = pair.scene(ghosts(pair), 1e-6);
    begin(scene, pair.gap);
    for (int k = 0; k < 3; ++k) scene.step();
    scene.particleHandler.getObject(0).setPosition({-pair.radius - 100 * um, 0, 0});
    for (int k = 0; k < 3; ++k) scene.step();
    EXPECT_TRUE(scene.interactions().at(0).bridged);
    EXPECT_NEAR(pair.closing(scene), 0, 1e-12);
}

// S_c (1 + sqrt(Ca)) at speeds up to the largest Ca, and no farther.
TEST(ViscousBridge, rupturesLaterTheFasterItIsPulled) {
    ViscousLiquidBridgeWillett law = liquid(1e-3, 1e-12, 1 * um, true);
    const Bodies bodies{1e-3, 1e-3};
    const double still = law.range(bodies);
    law.setDynamicRupture(true);
    law.setLargestCapillaryNumber(0.25);
    EXPECT_DOUBLE_EQ(law.range(bodies), 1.5 * still);
    const auto bridge = law.prepare(bodies);
    EXPECT_DOUBLE_EQ(bridge.range(law, -3.0), still);
    // Ca 1.37363e-3 makes it 1.037062 times as long.
    EXPECT_NEAR(bridge.range(law, 0.1) / still, 1.037062, 1e-6);
    EXPECT_DOUBLE_EQ(bridge.range(law, 1e6), 1.5 * still);

    // A scene in which a wall's grain is pulled off at a constant speed.
    for (const double speed : {0.01, 0.1, 1.0}) {
        Pair pair{.viscosity = 1e-3, .volume = 1e-12, .gap = 5 * um, .atWall = true, .tension = 0.0728};
        Wet s = ghosts(pair);
        static_cast<ViscousLiquidBridgeWillett&>(s).setDynamicRupture(true);
        FewGrains<Wet> scene(s, {{.radius = pair.radius, .position = {-pair.radius - pair.gap, 0, 0}}},
                             1e-7 / speed, {{{1, 0, 0}, none}});
        begin(scene, pair.gap);
        double last = 0;
        while (!scene.interactions().empty()) {
            last = pair.gapIn(scene);
            scene.particleHandler.getObject(0).setVelocity({-speed, 0, 0});
            scene.step();
        }
        const double expected = s.Adhesion::prepare(pair.bodies()).range(s, speed);
        EXPECT_NEAR(last, expected, 2e-7 + 0.01 * (expected - pair.rupture())) << speed;
    }
}

// The exact law's force falls to zero between its own rupture distance and the later one.
TEST(ViscousBridge, fadesBeyondTheExactRuptureDistance) {
    ViscousLiquidBridgeYoungLaplace law;
    law.setLiquidBridgeVolume(1e-12);
    law.setContactAngle(0);
    law.setSurfaceTension(0.0728);
    law.setViscosity(1e-3);
    law.setRoughness(1 * um);
    law.setDynamicRupture(true);
    const auto bridge = law.prepare({1e-3, 1e-3});
    const double end = bridge.range(), longest = bridge.range(law, 1.0);
    EXPECT_GT(longest, 1.1 * end);
    EXPECT_DOUBLE_EQ(bridge.force(law, 0.5 * end, longest), bridge.force(0.5 * end));
    EXPECT_NEAR(bridge.force(law, 0.5 * (end + longest), longest), 0.5 * bridge.force(end), 1e-12);
    EXPECT_NEAR(bridge.force(law, longest, longest), 0, 1e-18);
}

// With the resistance kept in contact, grains that overlap are slowed down on.
TEST(ViscousBridge, actsInContactWhereItIsAskedTo) {
    auto law = liquid(1e-3, 1e-11, 1 * um, false);
    EXPECT_EQ(resistance(law, {1e-3, 1e-3}, -1 * um).normal, 0);
    law.setViscousInContact(true);
    EXPECT_EQ(resistance(law, {1e-3, 1e-3}, -1 * um).normal, resistance(law, {1e-3, 1e-3}, 0.5 * um).normal);

    for (const bool isKept : {false, true}) {
        const Pair pair{.viscosity = 1e-3, .speed = 0.02, .atWall = true};
        Wet s = ghosts(pair);
        s.setViscousInContact(isKept);
        auto scene = pair.scene(s, 1e-6);
        begin(scene, pair.gap);
        while (pair.gapIn(scene) > -10 * um && scene.getTime() < 0.1) scene.step();
        // The plateau goes on: K per roughness.
        const double expected = pair.speed - pair.k() * (waysOf(pair, pair.gap) + (isKept ? 10 : 0));
        if (expected > 0) EXPECT_NEAR(pair.closing(scene) / expected, 1, 0.02) << isKept;
        else EXPECT_LT(pair.closing(scene), 1e-3 * pair.speed);
    }
}

/// Two wet grains of a species by its name, whose liquid moves, fly at each other, touch and part.
class ByName : public Simulation<> {
public:
    explicit ByName(double viscosity) {
        AnySpecies* const species =
            speciesHandler.addByName("HertzianViscoelasticMindlinViscousLiquidMigrationLSSpecies");
        for (const auto& [field, value] : {std::pair{"density", 2500.0},
                                           {"effectiveElasticModulus", 1e7},
                                           {"dissipation", 0.0},
                                           {"effectiveShearModulus", 1e7},
                                           {"slidingFrictionCoefficient", 0.3},
                                           {"liquidBridgeVolumeMax", 1e-11},
                                           {"contactAngle", 0.1},
                                           {"surfaceTension", 0.07},
                                           {"roughness", 1 * um}})
            species->set(field, value);
        species->set("viscosity", viscosity);
        for (const double side : {-1.0, 1.0}) {
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setRadius(1e-3);
            grain.setPosition({side * 1.001e-3, 0, 0});
            grain.setVelocity({-0.3 * side, 0.02 * side, 0});
            grain.setLiquidVolume(3e-12);
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(1e-6);
        setQuiet();
    }
};

// The bridge of 6e-12 m^3 forms at the touch, damps the way out and gives its liquid back to the films. On
// that way the grains lose K (A(S_c) - A(0)) of their speed, and something by what capillarity costs in both
// runs; but what is lost at a lower speed costs more speed, so that it is a bound.
TEST(ViscousBridge, composesWithLiquidThatMovesInASpeciesByName) {
    const auto separatingSpeed = [](double viscosity) {
        ByName scene(viscosity);
        scene.initialise();
        bool bridged = false;
        for (int k = 0; k < 10000; ++k) {
            scene.step();
            for (const ObservedContact& contact : scene.interactions()) bridged |= contact.bridged;
        }
        EXPECT_TRUE(bridged);
        EXPECT_TRUE(scene.interactions().empty());
        EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
        auto& grains = scene.particleHandler;
        return grains.getObject(1).getVelocity().x() - grains.getObject(0).getVelocity().x();
    };
    auto law = liquid(1e-3, 6e-12, 1 * um, true);
    law.setContactAngle(0.1);
    const Pair pair{.volume = 6e-12, .withVolume = true};
    const double lost = pair.k() * pair.way(0, law.range(pair.bodies()));
    const double difference = separatingSpeed(0) - separatingSpeed(1e-3);
    EXPECT_GT(difference, lost);
    EXPECT_LT(difference, 1.1 * lost);
}

using support::isOneSentence;
using support::refusal;

TEST(ViscousBridge, refusesWhatIsWrongInOneSentence) {
    const auto run = [](auto&& change) {
        const Pair pair{.atWall = true};
        Wet s = ghosts(pair);
        change(s);
        auto scene = pair.scene(s, 1e-7);
        return refusal([&] { begin(scene, pair.gap); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(run([](Wet&) {}), "");
    for (const auto& [text, field] :
         {std::pair{run([&](Wet& s) { s.roughness = nan; }), "roughness"},
          {run([&](Wet& s) { s.roughness = 0; }), "roughness"},
          {run([&](Wet& s) { s.viscosity = nan; }), "viscosity"},
          {run([&](Wet& s) { s.viscosity = -1; }), "viscosity"},
          {run([&](Wet& s) { s.viscosity = infinity; }), "viscosity"},
          {run([&](Wet& s) { s.tangentialLubrication = 1.5; }), "tangentialLubrication"},
          {run([&](Wet& s) { s.tangentialLubrication = 3; }), "tangentialLubrication"},
          {run([&](Wet& s) { s.viscousScheme = 0.5; }), "viscousScheme"},
          {run([&](Wet& s) { s.viscousNeighbours = 0.5; }), "viscousNeighbours"},
          {run([&](Wet& s) { s.largestCapillaryNumber = -1; }), "largestCapillaryNumber"},
          {refusal([] { Wet{}.setRoughness(-1e-6); }), "roughness"},
          {refusal([] { FewGrains<Wet>(Wet{}, {}, 1e-6).joinAtStart(-1); }), "gap of bridges"}}) {
        EXPECT_TRUE(isOneSentence(text)) << field;
        EXPECT_TRUE(support::contains(text, field));
    }
}

}  // namespace
}  // namespace pendular::viscousBridgeTest
