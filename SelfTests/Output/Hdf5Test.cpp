// The HDF5 files of fields, read back by Hdf5File and, where it is installed, by h5py.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Quantum.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::hdf5Test {
namespace {

using support::contentOf;
using support::TestFolder;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

class Hdf5Fields : public testing::Test {
protected:
    void SetUp() override {
        if (support::isMissing(Hdf5File::isAvailable(), "libhdf5-dev"))
            GTEST_SKIP() << support::without("libhdf5-dev", "the output of fields");
    }
    const TestFolder folder;
};

/// The numbers of a column, which has this many components.
std::vector<double> numbersOf(const Hdf5File& file, const std::string& name, std::size_t components) {
    const TableShape shape = file.shapeOf(name).value();
    EXPECT_EQ(shape.columns, components) << name;
    const std::size_t count = shape.rows * shape.columns;
    const auto read = [&]<class Number>(Number) {
        std::vector<Number> numbers(count);
        file.read(name, shape, numbers.data());
        return std::vector<double>(numbers.begin(), numbers.end());
    };
    return shape.kind == NumberKind::Float64   ? read(0.0)
           : shape.kind == NumberKind::Float32 ? read(0.0f)
                                               : read(std::int32_t{0});
}

struct Box : scenes::SettlingBox<Wet> {
    explicit Box(const std::string& name, int layers = 3) : SettlingBox(layers) {
        setName(name);
        setTimeMax(1500 * 0x1p-17);
    }
};

/// Any numbers, of each type and of more than one chunk, come back through the library's own filters.
TEST_F(Hdf5Fields, giveBackEveryBit) {
    support::Random random(11);
    for (const std::size_t rows : {0, 1, 3, 32768, 32769, 70001})
        for (const std::size_t components : {1, 3}) {
            std::vector<double> doubles;
            std::vector<float> floats;
            std::vector<std::int32_t> integers;
            for (std::size_t k = 0; k < rows * components; ++k) {
                doubles.push_back(std::exp(random.uniform(-600, 600)) * (k % 2 == 0 ? 1 : -1));
                floats.push_back(static_cast<float>(random.uniform(-1, 1)));
                integers.push_back(static_cast<std::int32_t>(k) - 100);
            }
            const std::string path = folder.name() + ".h5";
            for (const int threads : {3, 1}) {
                FieldFile file(path);
                file.column("a", {"x_m", components, doubles}, threads);
                file.column("a/b", {"y_N", components, floats}, threads);
                file.column("a", {"n", components, integers}, threads);
                EXPECT_FALSE(std::filesystem::exists(path) && threads == 3 && rows == 0 && components == 1);
                file.close();
            }
            const Hdf5File read(path, Hdf5File::Access::Read);
            EXPECT_EQ(read.names(), (std::vector<std::string>{"a/b/y_N", "a/n", "a/x_m"}));
            EXPECT_EQ(numbersOf(read, "a/x_m", components), doubles);
            EXPECT_EQ(numbersOf(read, "a/b/y_N", components),
                      std::vector<double>(floats.begin(), floats.end()));
            EXPECT_EQ(numbersOf(read, "a/n", components),
                      std::vector<double>(integers.begin(), integers.end()));
        }
}

TEST_F(Hdf5Fields, doNotDependOnTheThreads) {
    const auto fileOf = [&](int threads) {
        const std::string path = folder.name() + ".h5";
        std::vector<float> floats(100000);
        for (std::size_t k = 0; k < floats.size(); ++k) floats[k] = std::sqrt(static_cast<float>(k));
        FieldFile file(path);
        file.column("a", {"x_m", 1, floats}, threads);
        file.close();
        return contentOf(path);
    };
    EXPECT_EQ(fileOf(1), fileOf(3));
}

TEST_F(Hdf5Fields, areThoseOfTheScene) {
    for (const bool doubles : {false, true}) {
        Box scene(folder.name());
        scene.addOutput(Hdf5Output().withDoubles(doubles).withStress().addField(
            "height_m", [&](std::size_t k) { return scene.particleHandler.getObject(k).getPosition().z(); }));
        scene.solve();
        const Hdf5File file(folder.name() + "-fields-000001500.h5", Hdf5File::Access::Read);
        const auto rounded = [&](double x) { return doubles ? x : static_cast<float>(x); };
        const std::vector<double> position = numbersOf(file, "particles/position_m", 3),
                                  velocity = numbersOf(file, "particles/velocity_m_per_s", 3),
                                  spin = numbersOf(file, "particles/spin_rad_per_s", 3),
                                  radius = numbersOf(file, "particles/radius_m", 1),
                                  mass = numbersOf(file, "particles/mass_kg", 1),
                                  fixed = numbersOf(file, "particles/fixed", 1),
                                  height = numbersOf(file, "particles/height_m", 1),
                                  species = numbersOf(file, "particles/species", 1),
                                  total = numbersOf(file, "particles/force_N", 3);
        ASSERT_EQ(position.size(), 3 * 48u);
        std::vector<Vec3D> sums;
        for (std::size_t k = 0; k < 48; ++k) {
            const auto grain = scene.particleHandler.getObject(k);
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t n = 3 * k + static_cast<std::size_t>(axis);
                EXPECT_EQ(position[n], grain.getPosition()[axis]);  // of 64 bits in any case
                EXPECT_EQ(velocity[n], rounded(grain.getVelocity()[axis]));
                EXPECT_EQ(spin[n], rounded(grain.getAngularVelocity()[axis]));
            }
            EXPECT_EQ(radius[k], rounded(grain.getRadius()));
            EXPECT_EQ(mass[k], rounded(grain.getMass()));
            EXPECT_EQ(fixed[k], 0);
            EXPECT_EQ(height[k], rounded(grain.getPosition().z()));
            EXPECT_EQ(species[k], grain.getRadius() > 1.2e-3 ? 1 : 0);
            sums.push_back(grain.getMass() * scene.getGravity());
        }
        const auto first = numbersOf(file, "contacts/particle1", 1),
                   second = numbersOf(file, "contacts/particle2", 1);
        const auto wall = numbersOf(file, "contacts/wall", 1), force = numbersOf(file, "contacts/force_N", 3);
        const auto branch = numbersOf(file, "contacts/branch_m", 3),
                   overlap = numbersOf(file, "contacts/overlap_m", 1);
        const auto bridged = numbersOf(file, "contacts/bridged", 1),
                   volume = numbersOf(file, "contacts/bridge_volume_m3", 1);
        ASSERT_GT(first.size(), 40u);
        int bridges = 0;
        for (std::size_t k = 0; k < first.size(); ++k) {
            const auto one = static_cast<std::size_t>(first[k]);
            const Vec3D f(force[3 * k], force[3 * k + 1], force[3 * k + 2]);
            const Vec3D b(branch[3 * k], branch[3 * k + 1], branch[3 * k + 2]);
            double length = scene.particleHandler.getObject(one).getRadius();
            sums[one] += f;
            if (second[k] >= 0) {
                const auto other = scene.particleHandler.getObject(static_cast<std::size_t>(second[k]));
                length += other.getRadius();
                sums[static_cast<std::size_t>(second[k])] -= f;
            } else {
                EXPECT_GE(wall[k], 0);
            }
            // Each part of the branch is rounded to 24 bits, and so is the overlap.
            EXPECT_NEAR(b.norm(), length - overlap[k], 2 * 6e-8 * length);
            EXPECT_EQ(volume[k] > 0, bridged[k] == 1);
            bridges += bridged[k] == 1 ? 1 : 0;
        }
        EXPECT_GT(bridges, 20);
        // The dozen forces of up to 5 mN on a grain make the whole one: to 24 bits, or to 53.
        const double error =
            12 * (5e-3 * (doubles ? 2.3e-16 : 1.2e-7) + 0.5 * support::quantumOf(scene, 1.4e-3));
        for (std::size_t k = 0; k < 48; ++k)
            EXPECT_LT((sums[k] - Vec3D(total[3 * k], total[3 * k + 1], total[3 * k + 2])).norm(), error) << k;
        EXPECT_EQ(numbersOf(file, "particles/stress_Pa", 9).size(), 9 * 48u);
        const std::vector<double> ends = numbersOf(file, "walls/end", 1);
        EXPECT_EQ(3 * ends.back(), static_cast<double>(numbersOf(file, "walls/corner_m", 3).size()));
        EXPECT_EQ(numbersOf(file, "walls/wall", 1).size(), ends.size());
    }
}

TEST_F(Hdf5Fields, doNotChangeTheTrajectory) {
    const auto hashOf = [&](bool watched) {
        Box scene(folder.name(), 2);
        scene.setSaveCount(7);
        if (watched) scene.addOutput(Hdf5Output().withStress());
        scene.solve();
        return stateHash(scene.particleHandler.store());
    };
    EXPECT_EQ(hashOf(true), hashOf(false));
}

/// h5py follows the links of the series, and finds the numbers that ParaView's files have.
TEST_F(Hdf5Fields, areReadByH5py) {
    const std::string python = "/usr/bin/python3";
    if (support::isMissing(support::run(python + " -c 'import h5py'").exitCode == 0, "python3-h5py"))
        GTEST_SKIP() << support::without("python3-h5py", "that h5py reads the HDF5 files");
    Box scene(folder.name());
    scene.setSaveCount(1000);
    scene.addOutput(Hdf5Output());
    scene.addOutput(ParaViewOutput());
    scene.solve();
    const std::string script = (folders::source / "SelfTests/Output/read_fields.py").string();
    const auto result = support::run(python + " " + script + " " + folder.name() + "-fields.h5");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::istringstream lines(result.output);
    std::string line, frame;
    int frames = 0, columns = 0;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::string path, unit, type, packed, number;
        words >> path;
        if (path == "frame") {
            double time = 0;
            words >> frame >> time;
            EXPECT_EQ(time, std::stoi(frame) * 0x1p-17);
            ++frames;
            continue;
        }
        words >> unit >> type >> packed;
        std::string values;
        std::getline(lines, values);
        EXPECT_EQ(packed, "packed") << path;
        const std::string kind = path.substr(0, path.find('/')), name = path.substr(kind.size() + 1);
        const PolyData data = readPolyData(fmt::format("{}-{}-{}.vtp", folder.name(), kind, frame));
        const PolyDataField* field = kind == "particles" ? data.pointField(name) : data.cellField(name);
        if (name == "velocity_m_per_s") {
            EXPECT_EQ(unit, "m/s");
        }
        if (name == "mass_kg") {
            EXPECT_EQ(unit, "kg");
        }
        if (name == "position_m") {
            EXPECT_EQ(type, "float64");
            EXPECT_EQ(unit, "m");
        }
        if (!field) continue;
        std::istringstream parts(values);
        std::size_t k = 0;
        for (double value = 0; parts >> value; ++k) ASSERT_EQ(value, field->at(k)) << path << k;
        EXPECT_EQ(k, field->size()) << path;
        ++columns;
    }
    EXPECT_EQ(frames, 3);        // steps 0, 1000, 1500
    EXPECT_EQ(columns, 3 * 20);  // all but position, branch, corner and end
}

TEST_F(Hdf5Fields, thatCannotBeWrittenEndTheRunInOneSentence) {
    Box scene("/dev/null/run", 1);
    scene.addOutput(Hdf5Output());
    scene.initialise();
    const std::string reason = support::refusal([&] { scene.writeAll(); });
    EXPECT_TRUE(support::contains(reason, "/dev/null/run-fields-000000000.h5 cannot be written")) << reason;
}

}  // namespace
}  // namespace pendular::hdf5Test
