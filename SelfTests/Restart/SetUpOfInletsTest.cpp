// A run is resumed with the inlets that it began with, or is refused: each value that they compare is
// changed.
#include <gtest/gtest.h>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/Restart/ResumedScenes.h"
#include "SelfTests/Restart/ResumedWith.h"

namespace pendular::setUpOfInletsTest {
namespace {

using resumed::expectAllHaveRows;
using resumed::expectRefusals;
using resumed::FewGrains;

enum class What { Grains, Clumps, Mixture };

struct InletSettings {
    Vec3D lowest{0.001, 0.001, 0.02}, highest{0.02, 0.02, 0.04};  // m
    Vec3D velocity{0, 0, -0.1}, spin{0, 0, 0};                    // m/s, rad/s
    SizeDistribution sizes = evenSizes(1e-3, 1.2e-3);
    double number = 5000, first = 0, last = 1, mass = 0;  // 1/s, s, s, kg/s
    NoRoom noRoom = NoRoom::Later;
    std::uint32_t tries = 50;
    std::uint64_t seed = 3;
    std::size_t species = 0;
    double rise = 1e-3, mostRise = 2e-3;  // m
    What what = What::Grains;
    bool areWhole = true, followsWall = false, areTurned = true, areHeld = false, isBall = false,
         isTwice = false;
    double apart = 0.4, turn = 0;  // of the spheres of a clump, of their diameter; rad
    double share = 0.3;            // of the second kind of a mixture
};

void setBodies(Inlet& inlet, const InletSettings& s, const resumed::S* species) {
    SphericalParticle grain;
    grain.setSpecies(species), grain.setVelocity(s.velocity), grain.setAngularVelocity(s.spin);
    if (s.areHeld) grain.setHeldAxes({.x = true});
    const std::vector<Ball> spheres{{{0, 0, -s.apart}, 0.5}, {{0, 0, s.apart}, 0.5}};
    Clump clump{ClumpTemplate(spheres)};
    clump.setSpecies(species), clump.setVelocity(s.velocity);
    clump.setOrientation(Eigen::Quaterniond(Eigen::AngleAxisd(s.turn, Vec3D(1, 0, 0))));
    BodyMixture mixture;
    mixture.add(grain, s.sizes, 1 - s.share), mixture.add(clump, s.sizes, s.share);
    if (s.what == What::Mixture) return inlet.setBodies(mixture);
    inlet.setSizes(s.sizes);
    if (s.what == What::Clumps) inlet.setClump(clump);
    else inlet.setGrain(grain);
}

template <What what>
std::unique_ptr<FewGrains> sceneWith(InletSettings s) {
    if (s.what == What::Grains) s.what = what;
    auto scene = std::make_unique<FewGrains>();
    scene->speciesHandler.copyAndAddObject(FewGrains::linear());
    InfiniteWall floor({0, 0, -1}, {0, 0, -0.01}, scene->glass);
    scene->wallHandler.copyAndAddObject(floor);
    Inlet inlet;
    setBodies(inlet, s, scene->speciesHandler.getObject(s.species));
    if (s.mass > 0) inlet.setMassFlow(s.mass);
    else inlet.setNumberFlow(s.number);
    inlet.setTimes(s.first, s.last);
    if (s.isBall) inlet.setRegion(SphereRegion({0.01, 0.01, 0.03}, 0.009));
    else inlet.setRegion(BoxRegion(s.lowest, s.highest));
    inlet.setNoRoom(s.noRoom), inlet.setTries(s.tries), inlet.setSeed(s.seed);
    inlet.setWholeGrains(s.areWhole), inlet.setRandomTurns(s.areTurned);
    if (s.followsWall) inlet.setFollowsWall(0);
    else inlet.setFollowsFill({0, 0, 1}, s.rise, s.mostRise);
    for (int k = 0; k < (s.isTwice ? 2 : 1); ++k) scene->inletHandler.copyAndAddObject(inlet);
    scene->setTimeMax(1);
    return scene;
}

using I = InletSettings;

TEST(SetUpOfInlets, ofGrains) {
    const auto sentences = expectRefusals<I>(
        sceneWith<What::Grains>,
        {{"parts/inlets/count", [](I& s) { s.isTwice = true; }},
         {"parts/inlets/0/region/shape", [](I& s) { s.isBall = true; }},
         {"parts/inlets/0/region/lowest", [](I& s) { s.lowest.z() = 0.021; }},
         {"parts/inlets/0/region/highest", [](I& s) { s.highest.z() = 0.041; }},
         {"parts/inlets/0/kinds", [](I& s) { s.what = What::Mixture; }},
         {"parts/inlets/0/kind0/kind is grain in the file and clump in the scene",
          [](I& s) { s.what = What::Clumps; }},
         {"parts/inlets/0/kind0/species", [](I& s) { s.species = 1; }},
         {"parts/inlets/0/kind0/velocity is (0, 0, -0.1) m/s in the file and (0, 0, -0.2) m/s in the scene",
          [](I& s) { s.velocity.z() = -0.2; }},
         {"parts/inlets/0/kind0/spin", [](I& s) { s.spin.x() = 1; }},
         {"parts/inlets/0/kind0/held", [](I& s) { s.areHeld = true; }},
         {"parts/inlets/0/kind0/smallest", [](I& s) { s.sizes = evenSizes(0.9e-3, 1.2e-3); }},
         {"parts/inlets/0/kind0/largest", [](I& s) { s.sizes = evenSizes(1e-3, 1.3e-3); }},
         {"parts/inlets/0/kind0/meanDiameter",
          [](I& s) { s.sizes = normalSizes(1.05e-3, 1e-4, 1e-3, 1.2e-3).sizes; }},
         {"parts/inlets/0/massFlow", [](I& s) { s.mass = 0.01; }},
         {"parts/inlets/0/numberFlow", [](I& s) { s.number = 6000; }},
         {"parts/inlets/0/firstTime", [](I& s) { s.first = 0.1; }},
         {"parts/inlets/0/lastTime", [](I& s) { s.last = 0.9; }},
         {"parts/inlets/0/lost", [](I& s) { s.noRoom = NoRoom::Lost; }},
         {"parts/inlets/0/tries", [](I& s) { s.tries = 51; }},
         {"parts/inlets/0/seed", [](I& s) { s.seed = 4; }},
         {"parts/inlets/0/wholeGrains", [](I& s) { s.areWhole = false; }},
         {"parts/inlets/0/followsWall", [](I& s) { s.followsWall = true; }},
         {"parts/inlets/0/rise", [](I& s) { s.rise = 0.5e-3, s.mostRise = 1e-3; }},
         {"parts/inlets/0/mostRises", [](I& s) { s.mostRise = 3e-3; }}});
    expectAllHaveRows(sceneWith<What::Grains>({}), {"inlets"}, sentences,
                      {"inlets/0/kind0/share", "inlets/0/kind0/orientation", "inlets/0/randomTurns",  // below
                       "inlets/0/kind0/film",  // SetUpOfParts.liquid
                       // other moments of sizes whose mean is the same to the last digit
                       "inlets/0/kind0/meanSquare", "inlets/0/kind0/meanVolume"});
}

TEST(SetUpOfInlets, ofClumps) {
    auto sentences = expectRefusals<I>(sceneWith<What::Clumps>,
                                       {{"parts/inlets/0/kind0/spheres", [](I& s) { s.apart = 0.3; }},
                                        {"parts/inlets/0/kind0/orientation", [](I& s) { s.turn = 0.1; }},
                                        {"parts/inlets/0/randomTurns", [](I& s) { s.areTurned = false; }}});
    for (const std::string& sentence : expectRefusals<I>(
             sceneWith<What::Mixture>, {{"parts/inlets/0/kind0/share", [](I& s) { s.share = 0.4; }}}))
        sentences.push_back(sentence);
    EXPECT_EQ(sentences.size(), 4u);
}

struct ShapeSettings {
    Superquadric shape{1, 1.2, 0.8, 4, 3};
};

TEST(SetUpOfInlets, ofSuperquadrics) {
    const auto make = [](const ShapeSettings& s) {
        auto scene = std::make_unique<SuperquadricSimulation<resumed::S>>();
        auto* const glass = scene->speciesHandler.copyAndAddObject(FewGrains::linear());
        SuperquadricGrain grain(s.shape);
        grain.setSpecies(glass);
        Inlet inlet;
        inlet.setSuperquadric(grain), inlet.setSizes(evenSizes(1e-3, 1.2e-3));
        inlet.setNumberFlow(5000), inlet.setRegion(BoxRegion({0, 0, 0.02}, {0.02, 0.02, 0.04}));
        scene->inletHandler.copyAndAddObject(inlet);
        scene->setTimeStep(2e-6), scene->setTimeMax(1), scene->setQuiet();
        return scene;
    };
    using Q = ShapeSettings;
    expectRefusals<Q>(make, {{"parts/inlets/0/kind0/halfLengths", [](Q& s) { s.shape.b = 1.3; }},
                             {"parts/inlets/0/kind0/n1", [](Q& s) { s.shape.n1 = 5; }},
                             {"parts/inlets/0/kind0/n2", [](Q& s) { s.shape.n2 = 4; }}});
}

}  // namespace
}  // namespace pendular::setUpOfInletsTest
