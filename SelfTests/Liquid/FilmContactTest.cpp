#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Viscous bridges that form before a touch, where the films of two bodies meet: of liquid that moves, and of
// fixed volumes.

namespace pendular::filmContactTest {
namespace {

using scenes::GrainMotion;
using scenes::HookedGrains;
using Kind = ContactEvent::Kind;

using Moving = Species<LinearViscoelastic, NoFriction, ViscousLiquidMigrationWillett>;
using Fixed = Species<LinearViscoelastic, NoFriction, ViscousLiquidBridgeWillett>;
static_assert(HasFilmContactGap<Fixed::Adhesion> && !HasFilmContactGap<Moving::Adhesion>);

constexpr double um = 1e-6;       // m
constexpr double r = 1e-3;        // m
constexpr double density = 2500;  // kg/m^3

/// Two equal grains, or a grain at a plane, whose films of a given thickness approach.
struct Meeting {
    double film = 0.5 * um;  // m, on each grain
    double speed = 0.01;     // m/s, of closing
    double roughness = 0.02 * um, viscosity = 1e-3;
    bool atWall = false, withVolume = false;
    double tension = 1e-15;    // N/m: as if there were no capillary force
    double gap = 1.5 * um;     // m, at the start
    double stiffness = 1e-12;  // N/m: as if there were no contact

    [[nodiscard]] Bodies bodies() const { return {r, atWall ? infinity : r}; }
    [[nodiscard]] double filmVolume() const { return 4 * std::numbers::pi * r * r * film; }  // m^3
    [[nodiscard]] double volume() const { return (atWall ? 1 : 2) * filmVolume(); }          // of the bridge
    [[nodiscard]] double meets() const { return (atWall ? 1 : 2) * film; }                   // m, gap
    [[nodiscard]] double mass() const {                                                      // kg, effective
        return (atWall ? 1 : 0.5) * 4.0 / 3 * std::numbers::pi * r * r * r * density;
    }
    /// m/s: 6 pi eta R*^2 / m*
    [[nodiscard]] double k() const {
        return 6 * std::numbers::pi * viscosity * std::pow(bodies().effectiveRadius(), 2) / mass();
    }
    /// A(h) - A(0) of the bridge: the speed that is lost between there and the touch, over K.
    [[nodiscard]] double way(double h) const {
        const double squaredReach = withVolume ? volume() / (std::numbers::pi * bodies().effectiveRadius())
                                               : LubricationIntegral<double>::endless;
        const auto integral = lubricationIntegral(squaredReach, roughness);
        return integral.at(h, roughness) - integral.at(0, roughness);
    }

    template <class S>
    [[nodiscard]] S species() const {
        S s;
        s.setDensity(density);
        s.setStiffness(stiffness);
        s.setDissipation(0);
        s.setContactAngle(0);
        s.setSurfaceTension(tension);
        s.setViscosity(viscosity);
        s.setRoughness(roughness);
        s.setViscousVolumeCorrection(withVolume);
        if constexpr (std::is_same_v<S, Moving>) {
            s.setLiquidBridgeVolumeMax(1e-10);
            s.setFormsAtFilmContact(true);
        } else {
            s.setLiquidBridgeVolume(volume());
            s.setFilmContactGap(meets());
        }
        return s;
    }
    [[nodiscard]] std::vector<GrainMotion> grains() const {
        const Vec3D toward(atWall ? speed : 0.5 * speed, 0, 0);
        std::vector<GrainMotion> all{{.radius = r, .position = {-r - gap, 0, 0}, .velocity = toward}};
        if (!atWall) all.push_back({.radius = r, .position = {r, 0, 0}, .velocity = -toward});
        return all;
    }
    [[nodiscard]] std::vector<scenes::PlaneAt> planes() const {
        if (!atWall) return {};
        return {{{1, 0, 0}, Vec3D::Zero()}};
    }
};

template <class S>
class Scene : public HookedGrains<S> {
public:
    Scene(const Meeting& given, const S& species, double step)
        : HookedGrains<S>(species, given.grains(), step, given.planes()), atWall(given.atWall) {
        if constexpr (std::is_same_v<S, Moving>) {
            for (auto&& grain : this->particleHandler) grain.setLiquidVolume(given.filmVolume());
            this->setLiquidToCome(1e-8);
        }
        this->listenToContacts();
        this->acceptUnstableTimeStep();
        this->setQuiet();
    }
    Scene(const Meeting& given, double step) : Scene(given, given.species<S>(), step) {}

    [[nodiscard]] double closing() {  // m/s
        return this->motion(0).velocity.x() - (atWall ? 0 : this->motion(1).velocity.x());
    }
    [[nodiscard]] double gap() {  // m
        return (atWall ? 0 : this->motion(1).position.x() - r) - this->motion(0).position.x() - r;
    }
    [[nodiscard]] bool isBridged() const {
        const auto seen = this->interactions();
        return !seen.empty() && seen.front().bridged;
    }
    [[nodiscard]] int count(Kind kind) const {
        int found = 0;
        for (const ContactEvent& event : this->heard) found += event.kind == kind ? 1 : 0;
        return found;
    }
    void toTouch() {
        while (gap() > 0) this->step();
        this->step(), this->step();
    }

private:
    bool atWall;
};

// v_touch = v0 - K (A(h0) - A(0)), h0 the sum of both films' thicknesses, which is K (1 + ln(h0 / eps))
// without an end of the liquid, at any step that sees the gap at least once between there and the touch, and
// at which the bodies do not creep (K dt < eps). Of round-off: gaps are differences of positions, with 2^-53
// of the radius over the roughness, 5e-12, in each of up to 1e3 steps, times K / v < 0.04.
TEST(FilmContact, theSpeedOfTheTouchIsThatOfTheClosedForm) {
    for (const bool atWall : {false, true})
        for (const bool withVolume : {false, true})
            for (const double shift : {0.1, 1.0, 3.0, 10.0, 20.0}) {  // of the roughness in a step
                const Meeting given{.speed = 0.05, .atWall = atWall, .withVolume = withVolume};
                const double step = shift * given.roughness / given.speed;
                const double expected = given.speed - given.k() * given.way(given.meets());
                ASSERT_LT(given.k() * step, given.roughness);
                Scene<Moving> moving(given, step);
                Scene<Fixed> fixed(given, step);
                moving.initialise(), fixed.initialise();
                moving.toTouch();
                fixed.toTouch();
                EXPECT_NEAR(moving.closing() / expected, 1, 1e-9) << atWall << withVolume << shift;
                EXPECT_NEAR(fixed.closing() / expected, 1, 1e-9) << atWall << withVolume << shift;
                EXPECT_EQ(moving.liquidLedger().unaccounted(), 0);
                EXPECT_NEAR(moving.liquidLedger().bridges / given.volume(), 1, 1e-12);
            }
    const Meeting given;
    EXPECT_NEAR(given.way(given.meets()), 1 + std::log(given.meets() / given.roughness), 1e-12);
}

// Films are f / (4 pi r^2) thick, each by its own grain; one may be dry.
TEST(FilmContact, filmsOfUnequalGrainsMeetAtTheSumOfTheirThicknesses) {
    const Meeting given{.film = 0, .speed = 0.1, .roughness = 1 * um, .gap = 50 * um};
    for (const auto& [film1, film2] : {std::pair{10 * um, 5 * um}, std::pair{0.0, 8 * um}}) {
        Scene<Moving> scene(given, 1e-6);
        auto larger = scene.particleHandler.getObject(1);
        larger.setRadius(2 * r);
        larger.setPosition({2 * r, 0, 0});
        scene.particleHandler.getObject(0).setLiquidVolume(4 * std::numbers::pi * r * r * film1);
        larger.setLiquidVolume(16 * std::numbers::pi * r * r * film2);
        scene.initialise();
        const auto gap = [&] { return (scene.motion(1).position - scene.motion(0).position).x() - 3 * r; };
        double before = gap();
        while (scene.count(Kind::BridgeForms) == 0 && gap() > 0) before = gap(), scene.step();
        EXPECT_GT(before, film1 + film2);
        EXPECT_LE(gap(), film1 + film2);
    }
}

// Without the option the first approach is not damped.
TEST(FilmContact, isOffByDefault) {
    const Meeting given;
    auto movingLaw = given.species<Moving>();
    movingLaw.setFormsAtFilmContact(false);
    auto fixedLaw = given.species<Fixed>();
    fixedLaw.setFilmContactGap(0);
    Scene<Moving> moving(given, movingLaw, 2e-6);
    Scene<Fixed> fixed(given, fixedLaw, 2e-6);
    moving.initialise(), fixed.initialise();
    while (moving.gap() > 0) moving.step();
    while (fixed.gap() > 0) fixed.step();
    EXPECT_DOUBLE_EQ(moving.closing(), given.speed);
    EXPECT_DOUBLE_EQ(fixed.closing(), given.speed);
}

// At a wall that is dry the film is that of the grain alone. Viscosities of 0 and 1 Pa s differ by
// K (L_in + L_out), from the films on and up to the rupture, to the error of the elastic contact, as for
// bridges that are joined at the start.
TEST(FilmContact, isFeltAtWalls) {
    const auto collide = [](double viscosity) {
        const Meeting given{.film = 5 * um,
                            .speed = 40,
                            .roughness = 1 * um,
                            .viscosity = viscosity,
                            .atWall = true,
                            .withVolume = true,
                            .gap = 100 * um,
                            .stiffness = 1e6};
        Scene<Moving> scene(given, 2e-8);
        scene.initialise();
        for (int k = 0; k < 2000; ++k) scene.step();
        EXPECT_EQ(scene.count(Kind::BridgeForms), 1);
        EXPECT_EQ(scene.count(Kind::BridgeRuptures), 1);
        return -scene.closing();
    };
    const Meeting given{
        .film = 5 * um, .roughness = 1 * um, .viscosity = 1, .atWall = true, .withVolume = true};
    const auto law = given.species<Fixed>();
    const double rupture = law.Adhesion::range(given.bodies());
    EXPECT_NEAR((collide(0) - collide(1)) / (given.k() * (given.way(given.meets()) + given.way(rupture))), 1,
                1e-3);
}

// Both ledgers: the energy closes, what viscosity takes is that of the closed form, and no liquid is lost in
// any step, from before the films meet until the grains are apart again.
TEST(FilmContact, isInBothLedgers) {
    for (const double tension : {1e-15, 0.0728}) {
        const Meeting given{.withVolume = true, .tension = tension, .stiffness = 1e4};
        Scene<Moving> scene(given, 1e-7);
        scene.keepEnergyLedger();
        scene.initialise();
        const double start = scene.energyLedger().closed(), energy = 0.5 * given.mass() * 1e-4;
        while (scene.gap() > 0) {
            scene.step();
            ASSERT_EQ(scene.liquidLedger().unaccounted(), 0);
        }
        const double touch = given.speed - given.k() * given.way(given.meets());
        const double lost = 0.5 * given.mass() * (given.speed * given.speed - touch * touch);
        // The step of the touch: a roughness over 20.
        if (tension < 1e-3) {
            EXPECT_NEAR(scene.energyLedger().viscousBridges / lost, 1, 0.02);
        }
        for (int k = 0; k < 3000; ++k) scene.step();
        EXPECT_NEAR(scene.energyLedger().closed(), start, 1e-10 * energy) << tension;
        EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    }
}

// A pair that passes without a touch: its bridge forms where the films meet, ruptures at S_c of its volume,
// and gives the liquid back to the films in equal parts.
TEST(FilmContact, aBridgeRupturesWithoutATouch) {
    const Meeting given{.film = 2 * um, .roughness = 1 * um, .viscosity = 1e-9};
    Scene<Moving> scene(given, 1e-5);
    const double nearest = 0.5 * given.meets(), speed = 0.1;
    for (const std::size_t k : {0, 1}) {
        auto grain = scene.particleHandler.getObject(k);
        grain.setPosition({(k == 0 ? -1 : 1) * (r + 0.5 * nearest), k == 0 ? -4e-4 : 4e-4, 0});
        grain.setVelocity({0, k == 0 ? 0.5 * speed : -0.5 * speed, 0});
    }
    const auto separation = [&] {
        return (scene.motion(1).position - scene.motion(0).position).norm() - 2 * r;
    };
    scene.initialise();
    double before = separation(), formed = 0, ruptured = 0, last = 0;
    while (scene.count(Kind::BridgeRuptures) == 0 && scene.getTime() < 0.05) {
        before = separation();
        scene.step();
        if (formed == 0 && scene.count(Kind::BridgeForms) > 0) {
            formed = separation();
            EXPECT_GT(before, given.meets());
            EXPECT_LE(formed, given.meets());
        }
        if (scene.count(Kind::BridgeRuptures) > 0) ruptured = separation(), last = before;
    }
    auto law = given.species<Fixed>();
    const double rupture = law.Adhesion::range(given.bodies());
    EXPECT_GT(formed, 0);
    EXPECT_LE(last, rupture);
    EXPECT_GE(ruptured, rupture);
    EXPECT_EQ(scene.count(Kind::TouchBegins), 0);
    scene.step(), scene.step();
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    EXPECT_EQ(scene.liquidLedger().bridges, 0);
    for (const std::size_t k : {0, 1})
        EXPECT_NEAR(scene.particleHandler.getObject(k).getLiquidVolume() / given.filmVolume(), 1, 1e-12);
    EXPECT_EQ(scene.count(Kind::BridgeForms), 1) << "at S_c the films do not meet";

    Scene<Fixed> fixed(given, 1e-5);
    for (const std::size_t k : {0, 1}) {
        auto grain = fixed.particleHandler.getObject(k);
        grain.setPosition({(k == 0 ? -1 : 1) * (r + 0.5 * nearest), k == 0 ? -4e-4 : 4e-4, 0});
        grain.setVelocity({0, k == 0 ? 0.5 * speed : -0.5 * speed, 0});
    }
    fixed.initialise();
    while (fixed.getTime() < 0.05) fixed.step();
    EXPECT_EQ(fixed.count(Kind::BridgeForms), 1);
    EXPECT_EQ(fixed.count(Kind::BridgeRuptures), 1);
    EXPECT_EQ(fixed.count(Kind::TouchBegins), 0);
}

// Films far thicker than the skin of the list, that come into the run, or get thicker: the search finds the
// pair in the step in which they meet.
TEST(FilmContact, theSearchFindsFilmsThatMeet) {
    const Meeting given{.film = 0.1 * r, .speed = 1, .roughness = 1 * um, .gap = 0.5 * r};
    Scene<Moving> thick(given, 1e-6);
    thick.initialise();
    double before = thick.gap();
    auto law = given.species<Fixed>();
    law.setFilmContactGap(0), law.setLiquidBridgeVolume(1e-10);
    // The largest bridge, of 1e-10 m^3, could not last farther out: then that is where it forms.
    const double reach = std::min(given.meets(), law.Adhesion::range(given.bodies()));
    EXPECT_LT(reach, 0.5 * r);
    while (thick.count(Kind::BridgeForms) == 0) before = thick.gap(), thick.step();
    EXPECT_GE(before, reach);
    EXPECT_LT(thick.gap(), reach);
    EXPECT_GT(reach, 0.11 * r) << "farther than a skin";

    // Grains that rest with a gap of 0.1 r, and get films.
    const Meeting dry{.film = 0, .speed = 0, .roughness = 1 * um, .gap = 0.1 * r};
    Scene<Moving> resting(dry, 1e-6);
    resting.initialise();
    resting.steps(3);
    EXPECT_TRUE(resting.heard.empty());
    for (const double film : {0.02 * r, 0.04 * r, 0.06 * r}) {
        const double volume = 4 * std::numbers::pi * r * r * film;
        for (const std::size_t k : {0, 1}) resting.particleHandler.getObject(k).setLiquidVolume(volume);
        resting.steps(2);
        EXPECT_EQ(resting.count(Kind::BridgeForms), film > 0.05 * r ? 1 : 0) << film;
    }
    EXPECT_EQ(resting.liquidLedger().unaccounted(), 0);
    EXPECT_NEAR(resting.closing(), 0, 1e-12) << "nothing is charged for a way that they have not gone";

    // A grain that is put beside another one in the run.
    Scene<Moving> added({.film = 10 * um, .speed = 0, .roughness = 1 * um, .gap = r}, 1e-6);
    added.initialise();
    added.steps(3);
    auto grain = added.grain(r, {-3 * r - r - 15 * um, 0, 0});
    grain.setLiquidVolume(4 * std::numbers::pi * r * r * 10 * um);
    added.particleHandler.copyAndAddObject(grain);
    added.steps(2);
    EXPECT_EQ(added.count(Kind::BridgeForms), 1);
    Scene<Fixed> fixed({.film = 10 * um, .speed = 0, .roughness = 1 * um, .gap = r}, 1e-6);
    fixed.initialise();
    fixed.steps(3);
    fixed.particleHandler.copyAndAddObject(fixed.grain(r, {-3 * r - r - 15 * um, 0, 0}));
    fixed.steps(2);
    EXPECT_EQ(fixed.count(Kind::BridgeForms), 1);
}

// Less liquid than V_min forms nothing, and a film serves all that it meets in equal parts.
TEST(FilmContact, sharesItsLiquidAsATouchDoes) {
    const Meeting given{.film = 3 * um, .speed = 0, .roughness = 1 * um, .gap = 5 * um};
    auto law = given.species<Moving>();
    law.setLiquidBridgeVolumeMin(2.1 * given.filmVolume());
    Scene<Moving> poor(given, law, 1e-6);
    poor.initialise();
    poor.steps(5);
    EXPECT_EQ(poor.count(Kind::BridgeForms), 0);

    Scene<Moving> chain(given, 1e-6);
    auto third = chain.grain(r, {3 * r + 5 * um, 0, 0});
    third.setLiquidVolume(given.filmVolume());
    chain.particleHandler.copyAndAddObject(third);
    chain.initialise();
    chain.steps(2);
    const auto seen = chain.interactions();
    ASSERT_EQ(seen.size(), 2);
    for (const ObservedContact& contact : seen)
        EXPECT_NEAR(contact.bridgeVolume / given.filmVolume(), 1.5, 1e-12);
    EXPECT_EQ(chain.liquidLedger().films, 0);
}

// A species by its name does this, too, across the edge of a scene that repeats itself.
TEST(FilmContact, knowsSpeciesByNameAndTheNearestImage) {
    Simulation<> scene;
    AnySpecies* const species =
        scene.speciesHandler.addByName("HertzianViscoelasticMindlinViscousLiquidMigrationLSSpecies");
    for (const auto& [field, value] : {std::pair{"density", density},
                                       {"effectiveElasticModulus", 1e7},
                                       {"effectiveShearModulus", 1e7},
                                       {"slidingFrictionCoefficient", 0.3},
                                       {"dissipation", 0.0},
                                       {"liquidBridgeVolumeMax", 1e-10},
                                       {"contactAngle", 0.1},
                                       {"surfaceTension", 0.07},
                                       {"viscosity", 1e-3},
                                       {"roughness", 1 * um},
                                       {"formsAtFilmContact", 1.0}})
        species->set(field, value);
    const double length = 10 * r, gap = 5 * um;
    for (const double x : {r, length - r - gap}) {
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(r);
        grain.setPosition({x, 0, 0});
        grain.setLiquidVolume(4 * std::numbers::pi * r * r * 3 * um);
        scene.particleHandler.copyAndAddObject(grain);
    }
    scene.setPeriodic(0, 0, length);
    scene.setTimeStep(1e-6);
    scene.acceptUnstableTimeStep();
    scene.setQuiet();
    scene.initialise();
    scene.step();
    const auto seen = scene.interactions();
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_TRUE(seen.front().bridged && !seen.front().touching);
    EXPECT_EQ(scene.liquidLedger().films, 0);
}

// A column of contacts starts where a bridge forms at a gap.
TEST(FilmContact, columnsOfContactsStartWithTheBridge) {
    const Meeting given;
    Scene<Moving> scene(given, 1e-6);
    auto column = scene.addContactColumn("age", "", 7);
    scene.initialise();
    while (!scene.isBridged()) scene.step();
    EXPECT_GT(scene.gap(), 0);
    EXPECT_EQ(column[scene.interactions().front()], 7);
}

/// The settling box with films of some micrometres, whose bridges form where these meet.
using BoxMaterial = Species<HertzianViscoelastic, NoFriction, ViscousLiquidMigrationWillett>;
class FilmBox : public wet::WetBox<BoxMaterial> {
public:
    explicit FilmBox(int layers, int threads = 1) : wet::WetBox<BoxMaterial>(layers, threads) {
        for (const std::size_t kind : {0, 1}) {
            BoxMaterial& material = *speciesHandler.getObject(kind);
            material.setViscosity(1e-3);
            material.setRoughness(1e-6);
            material.setFormsAtFilmContact(true);
            material.setLiquidBridgeVolumeMax(kind == 0 ? 4e-11 : 6e-11);
        }
        for (auto&& grain : particleHandler) grain.setLiquidVolume(8e-11 + 1e-15 * grain.getId());
        acceptUnstableTimeStep();
        listenToContacts();
    }
    void actionsOnContactEvent(const ContactEvent& event) override {
        if (event.kind != Kind::BridgeForms) return;
        for (const ObservedContact& seen : interactionsOf(event.particle1))
            if (seen.particle1 == event.particle1 && seen.particle2 == event.particle2 &&
                seen.wall == event.wall)
                ++(seen.touching ? formedAtTouch : formedAtFilms);
    }
    int formedAtTouch = 0, formedAtFilms = 0;
};

TEST(FilmContact, givesTheSameBitsForAnyThreadsAndRestarts) {
    const support::TestFolder folder;
    FilmBox box(3);
    box.initialise();
    wet::runTo(box, 250);
    // Most grains are so fast that they touch in the step in which their films meet.
    EXPECT_GT(box.formedAtFilms, 20);
    EXPECT_GT(box.formedAtTouch, 20);
    wet::expectSameBits<FilmBox>(folder.path(), {0, 250, 251, 400}, 600, 400, 420);
}

// The restart keeps what a bridge that has just formed still has to charge.
TEST(FilmContact, goesOnThroughARestartAndAChangeInTheStepInWhichFilmsMeet) {
    const support::TestFolder folder;
    const Meeting given{.withVolume = true};
    const double step = 3 * given.roughness / given.speed;
    Scene<Moving> whole(given, step), resumed(given, step), relisted(given, step);
    whole.initialise(), relisted.initialise();
    while (whole.count(Kind::BridgeForms) == 0) whole.step(), relisted.step();
    whole.writeRestart(folder.path() / "met.h5");
    auto grain = relisted.particleHandler.getObject(0);
    grain.setRadius(grain.getRadius());
    resumed.restartFrom(folder.path() / "met.h5");
    resumed.initialise();
    for (auto* scene : {&whole, &resumed, &relisted}) scene->toTouch();
    EXPECT_EQ(whole.closing(), resumed.closing());
    EXPECT_EQ(whole.closing(), relisted.closing());
    EXPECT_NEAR(whole.closing() / (given.speed - given.k() * given.way(given.meets())), 1, 1e-9);
}

using support::contains;
using support::isOneSentence;
using support::refusal;

TEST(FilmContact, refusesWhatIsWrongInOneSentence) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double wrong : {nan, infinity, -infinity, -1e-9}) {
        const std::string text = refusal([&] { Fixed{}.setFilmContactGap(wrong); });
        EXPECT_TRUE(isOneSentence(text)) << wrong;
        EXPECT_TRUE(contains(text, "filmContactGap"));
    }
    const Meeting given;
    for (const double wrong : {nan, infinity, -infinity, -1.0, 2.0}) {
        auto law = given.species<Moving>();
        law.formsAtFilmContact = wrong;
        Scene<Moving> scene(given, law, 1e-6);
        const std::string text = refusal([&] { scene.initialise(); });
        EXPECT_TRUE(isOneSentence(text)) << wrong;
        EXPECT_TRUE(contains(text, "formsAtFilmContact"));
    }
    auto law = given.species<Fixed>();
    const double rupture = law.Adhesion::range(given.bodies());
    for (const double gap : {0.99 * rupture, rupture, 1.0}) {
        law.setFilmContactGap(gap);
        Scene<Fixed> scene(given, law, 1e-6);
        const std::string text = refusal([&] { scene.initialise(); });
        if (gap < rupture) {
            EXPECT_EQ(text, "");
            continue;
        }
        EXPECT_TRUE(isOneSentence(text)) << text;
        EXPECT_TRUE(contains(text, "ViscousLiquidBridgeWillett: filmContactGap"));
    }
}

}  // namespace
}  // namespace pendular::filmContactTest
