// What a change of bodies, laws or the time step during a run does to contacts, events, energies and
// restarts.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "Kernel/Contacts/SeveralSpeciesHandler.h"
#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Species/Laws.h"
#include "Kernel/State/RestartFile.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular {
namespace {

using scenes::endOf;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;
using Rolling = Species<LinearViscoelastic, SlidingRollingTorsion>;
template <class S>
using Hooked = scenes::HookedGrains<S>;

constexpr double r = 1e-3;          // m
constexpr double step = 1e-6;       // s
constexpr double stiffness = 1000;  // N/m
constexpr double density = 2000;    // kg/m^3

Smooth smooth(double springConstant = stiffness) {
    Smooth species;
    species.setDensity(density);
    species.setStiffness(springConstant);
    species.setDissipation(0);
    return species;
}

// ---- The first grain of a scene

TEST(FirstGrainInARun, isCheckedLikeThoseOfTheSetUp) {
    // It may not move its radius in a step,
    Hooked<Smooth> fast(smooth(), {}, step);
    std::string text = endOf<Smooth>(fast, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0}, {2 * r / step, 0, 0}));
    });
    EXPECT_TRUE(contains(text,
                         "particle 0 moves at 2000 m/s, farther in a step of 1e-06 s than the smallest "
                         "radius, 0.001 m"));
    // nor that of a smaller one that comes later.
    Hooked<Smooth> smaller(smooth(), {}, step);
    smaller.run(3);
    smaller.particleHandler.copyAndAddObject(smaller.grain(r, {0, 0, 0}));
    smaller.steps(3);
    smaller.particleHandler.copyAndAddObject(smaller.grain(r / 4, {0, 5 * r, 0}, {0.5 * r / step, 0, 0}));
    text.clear();
    try {
        smaller.step();
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(contains(text,
                         "particle 1 moves at 500 m/s, farther in a step of 1e-06 s than the smallest "
                         "radius, 0.00025 m"));
    // Nor may it overlap a wall, or be too small for the step.
    Hooked<Smooth> walled(smooth(), {}, step, {{{0, 0, -1}, {0, 0, 0}}});
    text = endOf<Smooth>(walled, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0.8 * r}));
    });
    EXPECT_TRUE(contains(text, "particle 0 and wall 0: initial overlap = 0.0002 m is 20 %"));
    Hooked<Smooth> tiny(smooth(), {}, step);
    text = endOf<Smooth>(tiny, [](auto& s) {
        s.particleHandler.copyAndAddObject(s.grain(r / 50, {0, 0, 0}));
    });
    EXPECT_TRUE(contains(text, "is above the stability limit"));
}

// Grains that come into an empty scene and meet: the list was infinitely wide. Without a dashpot equal grains
// exchange their velocities, up to the error of the step, (h w)^2 with w^2 = 2 k / m: 2e-4.
TEST(FirstGrainInARun, meetsTheSecondOne) {
    Hooked<Smooth> scene(smooth(), {}, step);
    scene.hook = [](auto& s) {
        if (s.getNumberOfTimeSteps() == 3)
            s.particleHandler.copyAndAddObject(s.grain(r, {0, 0, 0}, {1, 0, 0}));
        if (s.getNumberOfTimeSteps() == 5)
            s.particleHandler.copyAndAddObject(s.grain(r, {2.5 * r, 0, 0}, {-1, 0, 0}));
    };
    scene.run(1500);
    EXPECT_NEAR(scene.motion(0).velocity.x(), -1, 1e-3);
    EXPECT_NEAR(scene.motion(1).velocity.x(), 1, 1e-3);
    EXPECT_GT(scene.contacts().rebuildCount(), 2u);
}

// ---- Walls

/// A wall that shakes along its normal.
class Shaken : public Hooked<Smooth> {
public:
    Shaken(double frequency, double amplitude, bool turns = false) : Hooked<Smooth>(smooth(), {{}}, 1e-5) {
        InfiniteWall wall;
        wall.setSpecies(speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, -5 * r});
        wall.setMotion([=](double time) {
            const double phase = std::sin(2 * std::numbers::pi * frequency * time);
            Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
            if (turns) pose.rotate(Eigen::AngleAxisd(amplitude * phase, Vec3D::UnitY()));
            else pose.translation().z() = amplitude * phase;
            return pose;
        });
        wallHandler.copyAndAddObject(wall);
    }
};

TEST(WallOfAResumedRun, hasTheFunctionThatItHad) {
    const TestFolder folder;
    const auto file = folder.path() / "run.h5";
    const auto refusalOf = [&](const Shaken& given, double frequency, double amplitude, bool turns = false) {
        const_cast<Shaken&>(given).writeRestart(file);
        Shaken other(frequency, amplitude, turns);
        other.restartFrom(file);
        const std::string text = refusal([&] { other.initialise(); });
        if (!text.empty()) {
            EXPECT_TRUE(isOneSentence(text));
        }
        return text;
    };
    Shaken scene(50, 1e-4);
    scene.run(0);
    EXPECT_TRUE(contains(refusalOf(scene, 60, 1e-4), "walls/0/velocity is (0, 0, 0.0314"));
    scene.steps(1234);
    EXPECT_EQ(refusalOf(scene, 50, 1e-4), "");
    EXPECT_TRUE(contains(refusalOf(scene, 50, 2e-4), "walls/0/pose is (0, 0, "));
    EXPECT_TRUE(contains(refusalOf(scene, 50, 1e-4, true), "function of setMotion()"));
}

// ---- Laws

Rolling rolling() {
    Rolling species;
    species.setDensity(density);
    species.setStiffness(stiffness);
    species.setDissipation(0);
    species.setSlidingStiffness(300);
    species.setSlidingFrictionCoefficient(0.5);
    species.setRollingStiffness(300);
    species.setRollingFrictionCoefficient(0.3);
    return species;
}

// A value of a pair that no law can have: all pairs keep what they had, and the run ends with the last state.
TEST(MixtureThatIsRefused, leavesThePairsAsTheyWere) {
    SpeciesHandler<Smooth> one;
    one.copyAndAddObject(smooth());
    one.copyAndAddObject(smooth(3 * stiffness));
    one.mixAll();
    one.getObject(0)->setStiffness(2 * stiffness);
    one.getMixedObject(0, 1)->stiffnessConstant = -1;
    EXPECT_TRUE(contains(refusal([&] { one.mixAll(); }), "stiffness = -1 N/m"));
    EXPECT_EQ(one.mixture(0, 0).getStiffness(), stiffness);
    EXPECT_EQ(one.mixture(0, 1).getStiffness(), 1.5 * stiffness);
    EXPECT_EQ(one.mixture(1, 1).getStiffness(), 3 * stiffness);
    EXPECT_TRUE(one.hasChanged());

    Simulation<Smooth, Rolling> several;
    auto* first = several.speciesHandler.copyAndAddObject(smooth());
    auto* second = several.speciesHandler.copyAndAddObject(rolling());
    auto* pair = several.speciesHandler.getMixedObject<Smooth>(first, second);
    several.laws().mixAll();
    first->setStiffness(2 * stiffness);
    pair->stiffnessConstant = -1;
    EXPECT_TRUE(contains(refusal([&] { several.laws().mixAll(); }), "stiffness = -1 N/m"));
    for (const auto& [a, b] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 1)})
        EXPECT_EQ(several.laws().fields(a, b).at(0).value, stiffness) << a << b;
    EXPECT_TRUE(several.laws().hasChanged());

    Hooked<Smooth> scene(smooth(), {{}, {.position = {1.99 * r, 0, 0}}}, step);
    EXPECT_TRUE(contains(
        endOf<Smooth>(scene, [](auto& s) { s.speciesHandler.getMixedObject(0, 0)->stiffnessConstant = -1; }),
        "stiffness = -1 N/m"));
    EXPECT_EQ(scene.interactions().size(), 1u);
}

}  // namespace
}  // namespace pendular
