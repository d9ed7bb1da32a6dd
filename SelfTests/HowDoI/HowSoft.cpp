#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct HowSoftScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        // [snippet]
        SoftnessQuestion question = softnessOf(*this, 1000);   // of the scene; and the pressure of a lid, Pa
        question.modulus = 6e10, question.poissonRatio = 0.2;  // glass: Pa, 1
        question.figures = {WantedFigure::SolidFraction, WantedFigure::Friction};
        question.error = 0.01;                                       // 1 %
        fmt::print("{}\n", softestModulus(*this, question).text());  // and what its step gains
        // [end]
        const double effective = softestModulus(question).modulus / (2 * (1 - 0.2 * 0.2));
        EXPECT_LT(effective, 1e-2 * 6e10);
        speciesHandler.getLastObject()->setEffectiveElasticModulusAndRestitutionCoefficient(effective, 0.5);
    }
};

TEST_F(HowDoI, HowSoft) {
    HowSoftScene scene;
    EXPECT_TRUE(contains(run(scene), "Softest modulus: "));
}

}  // namespace
