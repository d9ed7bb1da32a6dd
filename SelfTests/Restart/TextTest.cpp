#include <gtest/gtest.h>

#include <sstream>

#include "BuildFolders.h"
#include "SelfTests/Restart/ChildRun.h"

namespace pendular::textTest {
namespace {

/// What follows the line of a name, up to the next name.
std::string after(const std::string& text, const std::string& name) {
    const std::string line = "# " + name + ": ";
    const std::size_t at = text.find(line);
    if (at == std::string::npos) return {};
    const std::size_t begin = text.find('\n', at) + 1;
    return text.substr(begin, text.find("\n#", begin) - begin + 1);
}

TEST(RestartToText, printsEveryDigitOfEverything) {
    const support::TestFolder folder;
    support::KeptRun scene(folder.path(), 50);
    scene.solve();
    const std::string tool = folders::tools.string() + "/restart-to-text ";
    const std::string file = scene.restartFile().string();
    const auto result = support::run(tool + file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(after(result.output, "species/name"),
              "HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies\n");
    EXPECT_EQ(after(result.output, "steps"), "50\n");
    EXPECT_EQ(after(result.output, "species/1/LiquidBridgeBagheri/liquidBridgeVolume"), "6e-12\n");
    std::istringstream rows(after(result.output, "particles/translation"));
    const ParticleStore& grains = scene.particleHandler.store();
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        std::vector<double> row(8);
        for (double& number : row) rows >> number;
        EXPECT_EQ(row, (std::vector<double>{grain.position.x, grain.position.y, grain.position.z,
                                            grain.radius, grain.velocity.x, grain.velocity.y,
                                            grain.velocity.z, grain.inverseMass}));
    }
    const auto names = support::run(tool + file + " --names --begin particles/");
    EXPECT_NE(names.output.find(fmt::format("# particles/translation: {} x 8\n", grains.size())),
              std::string::npos);
    EXPECT_EQ(names.output.find("# contacts"), std::string::npos);
    support::expectOneSentence(support::run(tool + "/no/such"), "/no/such does not exist");
}

}  // namespace
}  // namespace pendular::textTest
