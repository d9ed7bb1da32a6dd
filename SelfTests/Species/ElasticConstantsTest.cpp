#include "Kernel/Laws/Concepts/ElasticConstants.h"

#include <gtest/gtest.h>

#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"
#include "Kernel/Laws/Species/AnySpecies.h"
#include "SelfTests/Support/Refusal.h"

// E* and G* of a material: 1/E* = 2 (1 - nu^2) / E, 1/G* = 2 (2 - nu) 2 (1 + nu) / E.

namespace pendular::elasticConstantsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

TEST(ElasticConstants, areThoseOfTwoBodiesOfTheMaterial) {
    SeveralSpeciesHandler species;
    AnySpecies* const mindlin = species.addByName("HertzianViscoelasticMindlinSpecies");
    for (const double nu : {-0.5, 0.0, 0.25, 0.5}) {
        setElasticConstants(*mindlin, 5e6, nu);
        EXPECT_NEAR(5e6 / mindlin->get("effectiveElasticModulus"), 2 * (1 - nu * nu), 1e-14);
        EXPECT_NEAR(5e6 / mindlin->get("effectiveShearModulus"), 4 * (2 - nu) * (1 + nu), 1e-14);
    }
    AnySpecies* const frictionless = species.addByName("HertzianViscoelasticSpecies");
    setElasticConstants(*frictionless, 5e6, 0.2);  // no G*
    EXPECT_GT(frictionless->get("effectiveElasticModulus"), 0);
}

// A material with a ratio above 0.5 shrinks where it is pulled, with one of -1 or less it has no shape.
TEST(ElasticConstants, areRefusedOfWhatIsNoMaterial) {
    SeveralSpeciesHandler species;
    AnySpecies* const mindlin = species.addByName("HertzianViscoelasticMindlinSpecies");
    setElasticConstants(*mindlin, 5e6, 0.25);
    const double before = mindlin->get("effectiveShearModulus");
    for (const double nu : {0.51, 0.6, 0.99, 1.0, -1.0, -1.5}) {
        for (const std::string& text :
             {refusal([&] { setElasticConstants(*mindlin, 5e6, nu); }),
              refusal([&] { static_cast<void>(computeEffectiveElasticModulus(5e6, nu)); }),
              refusal([&] { static_cast<void>(computeEffectiveShearModulus(5e6, nu)); })}) {
            EXPECT_TRUE(isOneSentence(text)) << text;
            EXPECT_TRUE(contains(text, "oisson")) << text;
        }
    }
    EXPECT_TRUE(contains(refusal([&] { setElasticConstants(*mindlin, -5e6, 0.2); }), "youngModulus"));
    EXPECT_TRUE(contains(
        refusal([&] { setElasticConstants(*species.addByName("LinearViscoelasticSpecies"), 5e6, 0.2); }),
        "effectiveElasticModulus"));
    EXPECT_EQ(mindlin->get("effectiveShearModulus"), before);
}

}  // namespace
}  // namespace pendular::elasticConstantsTest
