#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/GrainCloud.h"
#include "SelfTests/Support/Refusal.h"

// The four phases of a wet collision between two bodies with films.

namespace pendular::liquidFilmsTest {
namespace {

using scenes::cloudOfGrains;
using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::PlaneAt;
using support::contains;
using support::isOneSentence;
using support::refusal;

template <class Films>
using Wet = Species<HertzianViscoelastic, MindlinSecant, Films>;

static_assert(!BridgeLaw<LiquidFilmsWillett>, "drivers of bridges take no films");
static_assert(LiquidFilmsYoungLaplace::name == "LiquidFilmsYoungLaplace");

constexpr double r = 0.5e-3;         // m
constexpr double film = 10e-6;       // m
constexpr double eta = 2e-3;         // Pa s
constexpr double roughness = 1e-6;   // m
constexpr double density = 2500;     // kg/m^3
constexpr double restitution = 0.9;  // dry
constexpr double tension = 0.0728;   // N/m

template <class Films>
Wet<Films> species(double surfaceTension = tension) {
    Wet<Films> s;
    s.setDensity(density);
    s.setEffectiveElasticModulusAndRestitutionCoefficient(1e9, restitution);
    s.setEffectiveShearModulus(2e8);
    s.setSlidingDissipation(0.1);
    s.setSpringFactor(1);
    s.setSlidingFrictionCoefficient(0.2);
    s.setLiquidBridgeVolume(5e-12);
    s.setContactAngle(0.1);
    s.setSurfaceTension(surfaceTension);
    s.setFilmThickness(film);
    s.setViscosity(eta);
    s.setRoughness(roughness);
    return s;
}

double massOf(double radius) { return 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * density; }

/// Two bodies meet along an axis; how they part.
struct Outcome {
    double normal = 0;     // m/s, of parting; 0: they stay together
    Vec3D velocity, spin;  // of body 1, m/s, rad/s
    double longest = 0;    // m, separation at the rupture
};

struct Impact {
    double radius2 = r;         // m; infinite: a plane
    double speed = 0.3;         // m/s
    Vec3D tangential{0, 0, 0};  // m/s, of body 1
    Vec3D spin{0, 0, 0};        // rad/s, of body 1
    Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
    double step = 5e-8;   // s
    bool isHeld = false;  // body 2
};

template <class Films>
class Scene : public FewGrains<Wet<Films>> {
public:
    Scene(const Wet<Films>& material, const Impact& given)
        : FewGrains<Wet<Films>>(material, grains(given), given.step,
                                std::isinf(given.radius2)
                                    ? std::vector<PlaneAt>{{-given.frame.col(2), Vec3D::Zero()}}
                                    : std::vector<PlaneAt>{}),
          impact(given) {
        this->acceptUnstableTimeStep();
        this->setQuiet();
        this->initialise();
    }
    [[nodiscard]] double separation() {
        const Vec3D x = this->motion(0).position;
        if (std::isinf(impact.radius2)) return x.dot(impact.frame.col(2)) - r;
        return (x - this->motion(1).position).norm() - r - impact.radius2;
    }
    [[nodiscard]] double partingSpeed() {
        const Vec3D v = this->motion(0).velocity;
        if (std::isinf(impact.radius2)) return v.dot(impact.frame.col(2));
        const Vec3D shift = this->motion(0).position - this->motion(1).position;
        return (v - this->motion(1).velocity).dot(shift.normalized());
    }
    [[nodiscard]] bool isJoined() const { return this->contacts().counts().bridged > 0; }
    Outcome finish() {
        bool touched = false, joined = false;
        for (int k = 0; k < 2000000; ++k) {
            this->step();
            touched |= separation() < 0;
            const bool isNow = isJoined();
            const auto body = this->motion(0);
            if (joined && !isNow) return {partingSpeed(), body.velocity, body.spin, separation()};
            if (touched && separation() > 0 && partingSpeed() < 0) return {0, body.velocity, body.spin, 0};
            joined = isNow;
        }
        ADD_FAILURE() << "no end";
        return {};
    }

private:
    static std::vector<GrainMotion> grains(const Impact& given) {
        const Vec3D normal = given.frame.col(2);
        const double start = r + 2 * film + given.speed * given.step;
        std::vector<GrainMotion> all{{.radius = r,
                                      .position = start * normal,
                                      .velocity = given.frame * given.tangential - given.speed * normal,
                                      .spin = given.frame * given.spin}};
        if (std::isinf(given.radius2)) return all;
        all.push_back({.radius = given.radius2, .position = -given.radius2 * normal, .fixed = given.isHeld});
        return all;
    }

    const Impact impact;
};

template <class Films>
Outcome collide(const Impact& impact, const Wet<Films>& material = species<Films>()) {
    return Scene<Films>(material, impact).finish();
}

// Without capillarity the speed lost between two gaps is K ln(h1 / h2), K = 6 pi eta R*^2 / m*, and K on the
// plateau below the roughness, whatever the speed. With a tension next to nothing the capillary number would
// lengthen the bridge without bound; it is held at its static length.
TEST(LiquidFilms, lubricationTakesWhatTheClosedFormSays) {
    for (const double radius2 : {r, 2 * r, infinity}) {
        auto material = species<LiquidFilmsWillett>(1e-12);
        material.setLargestCapillaryNumber(0);
        Impact impact{.radius2 = radius2, .speed = 0.6};
        const Bodies bodies{r, radius2};
        const double radius = bodies.effectiveRadius();
        const double mass =
            std::isinf(radius2) ? massOf(r) : massOf(r) * massOf(radius2) / (massOf(r) + massOf(radius2));
        const double K = 6 * std::numbers::pi * eta * radius * radius / mass;
        const auto& films = static_cast<const LiquidFilmsWillett&>(material);
        const double reach = 0.98 * films.range(bodies);
        const double in = K * (1 + std::log(2 * film / roughness)),
                     out = K * (1 + std::log(reach / roughness));
        const double expected = restitution * (impact.speed - in) - out;
        ASSERT_GT(expected, 0.05);
        const double coarse = collide<LiquidFilmsWillett>(impact, material).normal - expected;
        // Kicks at points: the trapezoidal rule of 1/h over the first gaps beyond the roughness errs by (v dt
        // / epsilon)^2 / 12 of K (and its derivative 1/epsilon^2), on both ways; the dry contact as in
        // DryCollisionTest; the ends of the range lie within a step, K v dt / h, of which the nearer is 20
        // um.
        const double way = impact.speed * impact.step;
        const double error =
            K * (way * way / (6 * roughness * roughness) + 2 * way / (2 * film)) + 3e-4 * impact.speed;
        EXPECT_NEAR(coarse, 0, error) << radius2;
        EXPECT_LT(error, 0.02 * (in + out));
    }
}

TEST(LiquidFilms, aWallIsTheLimitOfALargeSphere) {
    const auto compare = [&]<class Films>() {
        Impact impact{.radius2 = infinity, .speed = 0.5, .tangential = {0.2, 0.05, 0}, .spin = {10, 40, 20}};
        const auto wall = collide<Films>(impact);
        ASSERT_GT(wall.normal, 0.1);
        impact.radius2 = 1000 * r, impact.isHeld = true;
        const auto sphere = collide<Films>(impact);
        EXPECT_NEAR(sphere.normal / wall.normal, 1, 0.01) << Films::name;
        EXPECT_NEAR(sphere.longest / wall.longest, 1, 0.01);
        EXPECT_LT((sphere.velocity - wall.velocity).norm(), 0.01 * wall.velocity.norm());
        EXPECT_LT((sphere.spin - wall.spin).norm(), 0.01 * wall.spin.norm());
    };
    compare.operator()<LiquidFilmsWillett>();
    compare.operator()<LiquidFilmsBagheri>();
    compare.operator()<LiquidFilmsYoungLaplace>();
}

TEST(LiquidFilms, anyDirectionIsAlikeAndMomentumIsKept) {
    Impact impact{.radius2 = 0.7 * r, .speed = 0.5, .tangential = {0.2, -0.1, 0}, .spin = {100, 40, 20}};
    const auto upright = collide<LiquidFilmsYoungLaplace>(impact);
    ASSERT_GT(upright.normal, 0.1);
    UniformRandom random(3);
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector3d axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        impact.frame = Eigen::AngleAxisd(random.uniform(0, 3), axis.normalized()).toRotationMatrix();
        Scene<LiquidFilmsYoungLaplace> scene(species<LiquidFilmsYoungLaplace>(), impact);
        const Vec3D linear = scene.linearMomentum(), angular = scene.angularMomentum();
        const auto turned = scene.finish();
        EXPECT_NEAR(turned.normal / upright.normal, 1, 1e-12);
        EXPECT_LT((turned.velocity - impact.frame * upright.velocity).norm(),
                  1e-12 * upright.velocity.norm());
        EXPECT_LT((turned.spin - impact.frame * upright.spin).norm(), 1e-12 * upright.spin.norm());
        // Some 4e4 steps, each of which rounds by 1e-16.
        EXPECT_LT((scene.linearMomentum() - linear).norm(), 4e-12 * linear.norm());
        EXPECT_LT((scene.angularMomentum() - angular).norm(), 4e-12 * angular.norm());
    }
}

TEST(LiquidFilms, bridgeRupturesAtTheLengthOfItsSpeed) {
    for (const double speed : {0.4, 1.0}) {
        const Impact impact{.speed = speed};
        const auto material = species<LiquidFilmsWillett>();
        const auto outcome = collide<LiquidFilmsWillett>(impact, material);
        const double number = eta * outcome.normal / tension;
        LiquidBridgeWillett bridge;
        bridge.setLiquidBridgeVolume(5e-12);  // less than the films have, 4 pi (r^2 + r^2) delta = 6.3e-11
        bridge.setContactAngle(0.1);
        bridge.setSurfaceTension(tension);
        const double expected = bridge.range({r, r}) * (1 + std::sqrt(number));
        // It ends in the step after the one in which it is that long.
        EXPECT_NEAR(outcome.longest, expected, 2.01 * impact.step * outcome.normal + 1e-4 * expected)
            << speed;
    }
}

TEST(LiquidFilms, bridgeHoldsTheFilmsWhereTheyAreLess) {
    auto law = species<LiquidFilmsWillett>();
    law.setFilmThickness(1e-7);
    const auto& films = static_cast<const LiquidFilmsWillett&>(law);
    EXPECT_NEAR(films.volume({r, 2 * r}), 4 * std::numbers::pi * 5 * r * r * 1e-7, 1e-25);
    EXPECT_EQ(films.volume({r}), 5e-12);
    // Its force is that of the bridge law at this volume; in the films that at their surface.
    LiquidBridgeWillett bridge;
    bridge.setLiquidBridgeVolume(films.volume({r, r}));
    bridge.setContactAngle(0.1);
    bridge.setSurfaceTension(tension);
    auto own = films.prepare({r, r});
    EXPECT_EQ(own.force(1e-7), bridge.prepare({r, r}).force(2e-7));
    EXPECT_EQ(own.force(-1e-7), 0);
    own.wetted = 1;
    EXPECT_EQ(own.force(1e-5), bridge.prepare({r, r}).force(1e-5));
    law.setCapillaryInContact(true);
    EXPECT_EQ(static_cast<const LiquidFilmsWillett&>(law).prepare({r, r}).force(-1e-7), own.force(1e-7));
    law.setFilmThickness(0);  // dry
    EXPECT_EQ(static_cast<const LiquidFilmsWillett&>(law).range({r, r}), 0);
}

TEST(LiquidFilms, slidingResistanceIsThatOfLubricationTheory) {
    const auto law = species<LiquidFilmsWillett>();
    for (const double radius2 : {r, 3 * r, infinity}) {
        const Bodies bodies{r, radius2};
        const double radius = bodies.effectiveRadius(), h = 3e-6,
                     kappa = std::isinf(radius2) ? 1 : (radius2 - r) / (radius2 + r);
        auto contact = static_cast<const LiquidFilmsWillett&>(law).prepare(bodies);
        BridgeMotion<double> motion{};
        motion.separation = h;
        motion.asymmetry = kappa;
        motion.forms = true;
        const auto found = contact.resist(law, motion);
        const double L = 0.5 * std::log(1 + 5e-12 / (std::numbers::pi * radius * h * h));
        const double scale = 6 * std::numbers::pi * eta * radius * L;
        EXPECT_NEAR(found.sliding / scale, 1.0 / 3 + kappa * kappa / 5, 1e-14);
        EXPECT_NEAR(found.coupling / scale, 0.4 * kappa, 1e-14);
        EXPECT_NEAR(found.rolling / scale, 0.8, 1e-14);
        // Jeffrey and Onishi (1984), without spin: 4 l (2 + l + 2 l^2) / (15 (1 + l)^3) of 6 pi eta r1, at
        // the centres.
        if (std::isinf(radius2)) continue;
        const double l = radius2 / r;
        EXPECT_NEAR(found.sliding / (6 * std::numbers::pi * eta * r * L),
                    4 * l * (2 + l + 2 * l * l) / (15 * std::pow(1 + l, 3)), 1e-14);
    }
}

/// 27 grains that collide, stick and part.
class Cloud : public FewGrains<Wet<LiquidFilmsWillett>> {
public:
    explicit Cloud(int threads) : FewGrains(species<LiquidFilmsWillett>(), cloudOfGrains(r), 2e-7) {
        setNumberOfThreads(threads);
        setQuiet();
        initialise();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
};

TEST(HeavyLiquidFilms, givesTheSameBitsForAnyThreadsAndLists) {
    Cloud one(1), three(3), relisted(1);
    for (int k = 0; k < 10000; ++k) {
        one.step();
        three.step();
        auto grain = relisted.particleHandler.getObject(5);
        grain.setRadius(grain.getRadius());  // lists and prepares again
        relisted.step();
    }
    EXPECT_EQ(one.hash(), three.hash());
    EXPECT_EQ(one.hash(), relisted.hash());
}

TEST(LiquidFilms, closesTheAccountOfTheEnergy) {
    FewGrains<Wet<LiquidFilmsWillett>> cloud(species<LiquidFilmsWillett>(), cloudOfGrains(r), 2e-7);
    cloud.setQuiet();
    cloud.keepEnergyLedger();
    cloud.initialise();
    const EnergyLedger& ledger = cloud.energyLedger();
    const double start = ledger.closed(), kinetic = ledger.kinetic;
    for (int k = 0; k < 10000; ++k) cloud.step();
    // The error is as in BedTest.cpp: five times the round-off of all that has been turned over.
    EXPECT_LT(std::abs(ledger.closed() - start), 5 * std::sqrt(10000.0) * 0x1p-53 * kinetic);
    EXPECT_GT(ledger.viscousBridges, 0.01 * kinetic);
    EXPECT_GT(ledger.brokenAdhesion, 0) << "a bridge takes more than it gave";
}

TEST(LiquidFilms, refusesWhatIsNoFilm) {
    LiquidFilmsWillett law;
    const auto expectRefused = [&](auto setter, double value, std::string_view part) {
        const std::string text = refusal([&] { (law.*setter)(value); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, part));
    };
    for (const double wrong : {std::nan(""), infinity, -infinity, -1e-9}) {
        expectRefused(&LiquidFilmsWillett::setLiquidBridgeVolume, wrong, "liquidBridgeVolume");
        expectRefused(&LiquidFilmsWillett::setContactAngle, wrong, "contactAngle");
        expectRefused(&LiquidFilmsWillett::setSurfaceTension, wrong, "surfaceTension");
        expectRefused(&LiquidFilmsWillett::setFilmThickness, wrong, "filmThickness");
        expectRefused(&LiquidFilmsWillett::setViscosity, wrong, "viscosity");
        expectRefused(&LiquidFilmsWillett::setRoughness, wrong, "roughness");
        expectRefused(&LiquidFilmsWillett::setLargestCapillaryNumber, wrong, "largestCapillaryNumber");
    }
    expectRefused(&LiquidFilmsWillett::setRoughness, 0.0, "roughness");
    law.setLiquidBridgeVolume(1e-12), law.setContactAngle(0), law.setSurfaceTension(0.07);
    law.setFilmThickness(1e-5), law.setViscosity(1e-3);
    EXPECT_TRUE(contains(refusal([&] { checkFields(law); }), "roughness"));
    law.setContactAngle(2);
    EXPECT_TRUE(isOneSentence(law.objection({r, r}).value_or("")));
}

}  // namespace
}  // namespace pendular::liquidFilmsTest
