// Frames read again: those of HDF5 files are those for ParaView; droplets of sprays are in both.
#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/ShapeFields.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::readFramesTest {
namespace {

using support::refusal;
using support::TestFolder;
using Wet = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;
using Smooth = Species<LinearViscoelastic>;

class ReadFrames : public testing::Test {
protected:
    void SetUp() override {
        if (support::isMissing(Hdf5File::isAvailable(), "libhdf5-dev"))
            GTEST_SKIP() << support::without("libhdf5-dev", "the output of fields");
    }
    [[nodiscard]] std::string pathOf(const std::string& kind, std::size_t step) const {
        return fmt::format("{}-{}-{:09}", folder.name(), kind, step);
    }
    const TestFolder folder;
};

/// Each field of the one is in the other, with the same numbers.
void expectSameFields(const std::vector<PolyDataField>& expected, const std::vector<PolyDataField>& found) {
    ASSERT_EQ(expected.size(), found.size());
    for (const PolyDataField& field : expected) {
        const auto same = std::ranges::find(found, field.name, &PolyDataField::name);
        ASSERT_NE(same, found.end()) << field.name;
        EXPECT_EQ(same->components, field.components) << field.name;
        EXPECT_EQ(same->numbers, field.numbers) << field.name;
    }
}

void expectNear(const Vector<double>& a, const Vector<double>& b, double tolerance) {
    EXPECT_LE(norm(a - b), tolerance);
}

Wet wetGlass() {
    Wet species;
    species.setDensity(2500), species.setStiffness(100), species.setDissipation(1e-3);
    species.setLiquidBridgeVolumeMax(1e-11), species.setContactAngle(0), species.setSurfaceTension(0.07);
    return species;
}

/// Grains in a corner of two planes, under rain.
class Rained : public scenes::FewGrains<Wet> {
public:
    explicit Rained(const std::string& name)
        : FewGrains<Wet>(wetGlass(), {}, 1e-5, {{{0, 0, -1}, {0, 0, 0}}, {{-1, 0, 0}, {0, 0, 0}}}) {
        for (int k = 0; k < 6; ++k) {
            SphericalParticle grain;
            grain.setSpecies(speciesHandler.getObject(0));
            grain.setRadius(1e-3);
            grain.setPosition({0.99e-3 + 1.98e-3 * (k % 3), 5e-3, 0.99e-3 + 1.98e-3 * (k / 3)});
            particleHandler.copyAndAddObject(grain);
        }
        Spray rain;
        rain.setRain({0, 0, 0.02}, {6e-3, 0, 0}, {0, 6e-3, 0}, {0, 0, -1});
        rain.setDropletRadius(1e-4), rain.setSpeed(2), rain.setFlow(1e-7);
        sprayHandler.copyAndAddObject(rain);
        setName(name);
        setTimeMax(3e-4), setQuiet();
    }
};

TEST_F(ReadFrames, areThoseForParaView) {
    Rained scene(folder.name());
    scene.addOutput(ParaViewOutput());
    scene.addOutput(Hdf5Output());
    scene.solve();
    const std::vector<Hdf5Entry> list = readHdf5Series(Hdf5Frames::indexOf(folder.name()));
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list.back().time, scene.getTime());
    const SceneFrame frame = readHdf5Frame(list.back().file);
    const auto paraView = [&](const std::string& kind) {
        return readPolyData(pathOf(kind, scene.getNumberOfTimeSteps()) + ".vtp");
    };
    const PolyData grains = paraView("particles"), contacts = paraView("contacts"), walls = paraView("walls"),
                   droplets = paraView("droplets");
    EXPECT_EQ(frame.grains.points, grains.points);
    EXPECT_EQ(frame.grains.corners, grains.corners);
    EXPECT_EQ(frame.grains.ends, grains.ends);
    expectSameFields(grains.pointFields, frame.grains.pointFields);

    ASSERT_TRUE(frame.contacts && frame.walls && frame.droplets);
    EXPECT_FALSE(shapeSurfaces(frame.grains));
    ASSERT_GT(contacts.ends.size(), 6u);
    ASSERT_EQ(frame.contacts->ends.size(), contacts.ends.size());
    expectSameFields(contacts.cellFields, frame.contacts->cellFields);
    for (std::size_t k = 0; k < 2 * contacts.ends.size(); ++k) {
        const auto point = [&](const PolyData& data) {
            return data.points[static_cast<std::size_t>(data.corners[k])];
        };
        expectNear(point(*frame.contacts), point(contacts), 2e-3 * 0x1p-24);  // branches are floats
    }
    EXPECT_EQ(frame.walls->points, walls.points);
    EXPECT_EQ(frame.walls->ends, walls.ends);
    expectSameFields(walls.cellFields, frame.walls->cellFields);

    const std::vector<Droplet>& flying = scene.sprayHandler.droplets();
    ASSERT_GT(flying.size(), 3u);
    for (const PolyData& read : {droplets, *frame.droplets}) {
        ASSERT_EQ(read.points.size(), flying.size());
        for (std::size_t k = 0; k < flying.size(); ++k) {
            EXPECT_EQ(read.points[k], flying[k].position);
            EXPECT_EQ(read.pointField("radius_m")->at(k), static_cast<float>(flying[k].radius));
            EXPECT_EQ(read.pointField("volume_m3")->at(k), static_cast<float>(flying[k].volume));
            EXPECT_EQ(read.pointField("velocity_m_per_s")->at(3 * k + 2),
                      static_cast<float>(flying[k].velocity.z));
            EXPECT_EQ(read.pointField("spray")->at(k), 0);
        }
    }
}

/// The surfaces that the fields of a frame tell of are those that ParaView gets, up to fields of 32 bits.
TEST_F(ReadFrames, haveTheShapesOfSuperquadrics) {
    Smooth soft;
    soft.setDensity(2500), soft.setStiffness(1000), soft.setDissipation(0);
    const Eigen::Quaterniond turn = Eigen::Quaterniond(1, 2, -1, 0.5).normalized();
    scenes::FewSuperquadrics<Smooth> scene(
        soft,
        {{{1e-3, 1.5e-3, 0.7e-3, 4, 3}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, turn},
         {{1e-3, 1e-3, 2e-3}, {0, 0.01, 0}},
         {{1e-3, 1e-3, 1e-3}, {0, 0, 0.01}}},  // a ball, which is left out
        1e-6);
    scene.setName(folder.name());
    scene.addOutput(ParaViewOutput());
    scene.addOutput(Hdf5Output());
    scene.setQuiet(), scene.setTimeMax(1e-5);
    scene.solve();
    const std::optional<PolyData> surfaces =
        shapeSurfaces(readHdf5Frame(pathOf("fields", scene.getNumberOfTimeSteps()) + ".h5").grains);
    const PolyData shapes = readPolyData(pathOf("shapes", scene.getNumberOfTimeSteps()) + ".vtp");
    ASSERT_TRUE(surfaces);
    ASSERT_FALSE(shapes.points.empty());
    ASSERT_EQ(3 * surfaces->points.size(), 2 * shapes.points.size());
    for (std::size_t k = 0; k < surfaces->points.size(); ++k)
        expectNear(surfaces->points[k], shapes.points[k], 1e-5 * 2e-3);
    ASSERT_EQ(3 * surfaces->ends.size(), 2 * shapes.ends.size());
    EXPECT_TRUE(std::ranges::equal(surfaces->ends, std::span(shapes.ends).first(surfaces->ends.size())));
    const auto identityOf = [](const PolyData& data, std::size_t k) {
        return data.cellField("identity")->at(k);
    };
    for (std::size_t k = 0; k < surfaces->ends.size(); ++k)
        EXPECT_EQ(identityOf(*surfaces, k), identityOf(shapes, k));
}

TEST_F(ReadFrames, areRefusedInOneSentence) {
    const std::string path = folder.name() + "-fields-000000001.h5";
    const auto refused = [&](const std::vector<std::pair<std::string, PolyDataField>>& columns) {
        FieldFile file(path);
        for (const auto& [group, column] : columns) file.column(group, column);
        file.close();
        return refusal([&] { readHdf5Frame(path); });
    };
    using Doubles = std::vector<double>;
    using Wholes = std::vector<std::int32_t>;
    const PolyDataField places{"position_m", 3, Doubles(6)}, radii{"radius_m", 1, Doubles{1, 1}},
        identity{"identity", 1, Wholes{7, 9}}, branch{"branch_m", 3, Doubles(3)},
        corner{"corner_m", 3, Doubles(9)};
    EXPECT_EQ(refused({{"particles", places}, {"particles", radii}}), "");
    for (const auto& [columns, words] :
         {std::pair{std::vector<std::pair<std::string, PolyDataField>>{{"particles", radii}},
                    "no position_m of 3"},
          {{{"particles", places}, {"particles", {"radius_m", 1, Doubles(3)}}}, "longer or shorter"},
          {{{"particles", places}, {"contacts", branch}}, "no particle1"},
          {{{"particles", places},
            {"particles", identity},
            {"contacts", branch},
            {"contacts", {"particle1", 1, Wholes{8}}}},
           "a grain 8 that is not there"},
          {{{"particles", places}, {"walls", corner}, {"walls", {"end", 1, Wholes{4}}}},
           "no corners in order"},
          {{{"particles", places}, {"walls", corner}, {"walls", {"end", 1, Wholes{2, 1}}}},
           "no corners in order"},
          {{{"particles", {"position_m", 3, Doubles(6)}}, {"particles", {"wide", 10, Doubles(20)}}},
           "no column of one to nine"}}) {
        const std::string text = refused(columns);
        EXPECT_TRUE(support::contains(text, words));
        EXPECT_TRUE(support::isOneSentence(text));
    }
    EXPECT_TRUE(support::isOneSentence(refusal([&] { readHdf5Series(path); })));
    EXPECT_TRUE(support::isOneSentence(refusal([&] { readHdf5Frame(folder.path() / "none.h5"); })));
}

}  // namespace
}  // namespace pendular::readFramesTest
