// Random scenes that were at fault once, as they were minimised.
#include <gtest/gtest.h>

#include "SelfTests/Fuzz/RandomScenes/Judge.h"

namespace pendular::fuzz {
namespace {

struct FoundScene {
    const char *name, *recipe;
};

class FoundScenes : public testing::TestWithParam<FoundScene> {};

TEST_P(FoundScenes, holdWhatMustHold) {
    const Recipe recipe = recipeFrom(GetParam().recipe);
    const Verdict verdict = judge(recipe);
    EXPECT_TRUE(verdict.faults.empty()) << report(recipe, verdict);
}

INSTANTIATE_TEST_SUITE_P(
    , FoundScenes,
    testing::Values(
        FoundScene{"bridgePassesOnToAnotherWall",
                   "seed=186 features=LinearViscoelasticSlidingFrictionLiquidMigrationWillett,Gravity,Grains,"
                   "Planes,VibratingPlane,Velocity,Add steps=128 grains=32"},
        FoundScene{"fieldsKeepNoAverageThatGoesOn", "seed=744 features=Fields,RestartFile steps=4 grains=1"},
        FoundScene{"contactPassesFromAPlaneToAPiston",
                   "seed=1276 features=Ledger,Grains,Planes,Piston steps=1 grains=32"},
        FoundScene{"stepIsCheckedForABodyJoinedInTheRun",
                   "seed=1378 features=HertzianViscoelasticMindlinLiquidBridgeWillett,Grains,JoinInRun "
                   "steps=4 grains=1"},
        FoundScene{"springsInStepWhenTheLastBodyGoes",
                   "seed=4152 features=LinearViscoelasticSlidingFrictionLiquidMigrationWillett,Grains,"
                   "BodyChange,InsertedClumps steps=4 grains=4"},
        FoundScene{
            "strainOfWetGrains",
            "seed=1585 features=HertzianViscoelasticMindlinViscousLiquidMigrationLS,Strain,Grains,Films "
            "grains=16"},
        FoundScene{"aPlaneThatVibratesBeyondAllNumbers",
                   "seed=8774 features=Grains,VibratingPlane wrong=VibratingPlane#3:1e+300 steps=2 grains=4"},
        FoundScene{"aViscousBridgeThatFormsAgainOwesNothing",
                   "seed=3389 features=HertzianViscoelasticMindlinViscousLiquidBridgeWillett,Grains,Planes,"
                   "VibratingPlane,Radius steps=64 grains=8"},
        FoundScene{"aSpringFactorBeyondAllNumbers",
                   "seed=1080 features=Grains wrong=HertzianViscoelasticMindlin#5:1e+300 steps=4 grains=8"},
        FoundScene{"aClumpWithoutVolume", "seed=3710 features=Clumps wrong=Clumps#3:1e-300 steps=2 grains=1"},
        FoundScene{"wallForcesWhenAServoIsTakenAway",
                   "seed=1641 features=Grains,ForceServo,WallForces steps=16 grains=1"},
        FoundScene{"wallForcesOfAWallThatComes",
                   "seed=17 features=Grains,WallThatComes,WallForces steps=40 grains=9"}),
    [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace pendular::fuzz
