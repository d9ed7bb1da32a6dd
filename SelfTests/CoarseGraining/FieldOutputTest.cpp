// Fields of runs and of their frames: identities with what the scene knows, averages, files, restart.
#include <gtest/gtest.h>

#include <cmath>

#include "BuildFolders.h"
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::fieldOutputTest {
namespace {

using namespace support;
using Sum = FieldSums::Sum;

const Vector<double> lowest{-0.02, -0.02, -0.02}, highest{0.03, 0.03, 0.06};

double integral(const FieldSums& sums, std::size_t sum) {
    double total = 0;
    for (std::size_t k = 0; k < sums.grid().size(); ++k) total += sums.ofAll(sum, k);
    return total * sums.grid().volume() / static_cast<double>(sums.grid().size());
}

/// Runs wet grains on walls for some steps.
std::unique_ptr<KeptRun> settled(const std::filesystem::path& folder) {
    auto run = std::make_unique<KeptRun>(folder, 400);
    for (std::size_t w = 0; w < run->wallHandler.getSize(); ++w)
        run->wallHandler.getObject(w).keepForces(true);
    run->solve();
    return run;
}

// The mass and the momentum of the scene, the virial of its contacts, and its forces on walls.
TEST(FieldsOfAScene, areItsMassMomentumVirialAndWallForces) {
    const TestFolder folder;
    const auto run = settled(folder.path());
    const GrainState state = stateOf(*run);
    ASSERT_GT(state.contacts.size(), 20u);
    const double w = 2e-3;
    FieldSums sums(FieldGrid("XZ", lowest, highest, 0.7 * w),
                   SmoothingKernel(KernelShape::Gauss, 2, w, 8.5 * w));
    sums.add(state, 2);
    EXPECT_NEAR(integral(sums, Sum::Mass) / run->getTotalMass(), 1, 1e-12);
    EXPECT_NEAR(integral(sums, Sum::Momentum + 2) / run->getTotalMomentum().z(), 1, 1e-11);
    double virial = 0, largest = 0;
    Vector<double> onGrains{0, 0, 0};
    for (const ObservedContact& c : run->interactions()) {
        virial -= dot(c.force, c.shift);
        largest += std::abs(dot(c.force, c.shift));
        if (c.wall >= 0) onGrains += c.force;
    }
    EXPECT_NEAR(integral(sums, Sum::ContactStress) + integral(sums, Sum::ContactStress + 4) +
                    integral(sums, Sum::ContactStress + 8),
                virial, 1e-12 * largest);
    Vec3D walls = Vec3D::Zero();
    for (std::size_t k = 0; k < run->wallHandler.getSize(); ++k)
        walls += run->wallHandler.getObject(k).getForce();
    ASSERT_GT(walls.norm(), 0);
    EXPECT_NEAR(integral(sums, Sum::Traction + 2), -walls.z(), 1e-11 * walls.norm());
    EXPECT_NEAR(onGrains.z, -walls.z(), 1e-11 * walls.norm());
}

// What fields take of contacts is what an observer sees, in the same order, by any number of threads.
TEST(FieldsOfAScene, takeTheContactsThatAreObserved) {
    const TestFolder folder;
    const auto run = settled(folder.path());
    for (const int threads : {1, 3}) {
        run->setNumberOfThreads(threads);
        const GrainState state = stateOf(*run);
        std::size_t k = 0, bridged = 0, walls = 0;
        for (const ObservedContact& seen : run->interactions()) {
            ASSERT_LT(k, state.contacts.size());
            const GrainState::Contact& taken = state.contacts[k++];
            EXPECT_EQ(taken.shift, seen.shift);
            EXPECT_EQ(taken.force, seen.force);
            EXPECT_EQ(taken.adhesiveForce, seen.adhesiveForce);
            EXPECT_EQ(taken.liquid, seen.bridgeVolume);
            EXPECT_EQ(taken.touching, seen.touching);
            EXPECT_EQ(taken.second == GrainState::Contact::wall, seen.wall >= 0);
            bridged += seen.bridged, walls += seen.wall >= 0;
        }
        EXPECT_EQ(k, state.contacts.size());
        EXPECT_GT(bridged, 0u);
        EXPECT_GT(walls, 0u);
    }
}

TEST(FieldsOfAScene, areThoseOfItsFrames) {
    const TestFolder folder;
    const auto run = settled(folder.path());
    const GrainState state = stateOf(*run);
    const PolyData grains = grainPoints<double>(run->particleHandler.store(), run->laws()),
                   contacts =
                       contactLines<double>(run->contacts(), run->particleHandler.store(), run->laws());
    const GrainState again = stateOf(grains, contacts, {});
    ASSERT_EQ(again.contacts.size(), state.contacts.size());
    const FieldGrid grid("Z", lowest, highest, 2e-3);
    FieldSums one(grid, SmoothingKernel(KernelShape::Lucy, 1, 2e-3)),
        other(grid, SmoothingKernel(KernelShape::Lucy, 1, 2e-3));
    one.add(state), other.add(again);
    for (std::size_t sum = 0; sum < FieldSums::count; ++sum)
        for (std::size_t k = 0; k < grid.size(); ++k)
            EXPECT_NEAR(one.ofAll(sum, k), other.ofAll(sum, k), 1e-10 * std::abs(one.ofAll(sum, k)) + 1e-12)
                << sum;
    PolyData fewer = grains;
    std::erase_if(fewer.pointFields, [](const PolyDataField& f) { return f.name == "mass_kg"; });
    EXPECT_TRUE(isOneSentence(refusal([&] { stateOf(fewer, contacts, {}); })));
    PolyData strange = contacts;
    for (PolyDataField& f : strange.cellFields)
        if (f.name == "particle1") std::get<std::vector<std::int32_t>>(f.numbers)[0] = 1000000;
    EXPECT_TRUE(isOneSentence(refusal([&] { stateOf(grains, strange, {}); })));
}

FieldOutput profile(double interval, double window) {
    return FieldOutput(FieldGrid("Z", lowest, highest, 5e-3), KernelShape::Gauss, 4e-3)
        .withInterval(interval)
        .averagedOver(window);
}
FieldOutput plane(double interval, double window) {
    return FieldOutput(FieldGrid("XZ", lowest, highest, 5e-3), KernelShape::Gauss, 4e-3)
        .withInterval(interval)
        .averagedOver(window)
        .withName("plane");
}

TEST(FieldOutput, writesATableOfAverages) {
    const TestFolder folder;
    const double step = 0x1p-17;  // s, of the scene
    {
        KeptRun run(folder.path(), 100);
        run.addOutput(profile(10 * step, 50 * step));
        run.addOutput(profile(10 * step, infinity).withName("all"));
        run.addOutput(profile(50 * step, 0).withName("each"));
        run.solve();
    }
    const auto rows = rowsOf(contentOf(folder.path() / "run-coarse.csv"));
    ASSERT_EQ(rows.size(), 3 * 16u);  // steps 0 to 40, 50 to 90, and 100
    EXPECT_EQ(std::stod(rows[0].at("time_s")), 20 * step);
    EXPECT_EQ(std::stod(rows[16].at("time_s")), 70 * step);
    EXPECT_EQ(std::stod(rows[32].at("time_s")), 100 * step);
    EXPECT_EQ(rows[0].at("velocity_z_m_per_s"), "");  // no grains there
    EXPECT_NE(rows[5].at("velocity_z_m_per_s"), "");
    EXPECT_EQ(rowsOf(contentOf(folder.path() / "run-all.csv")).size(), 16u);
    // Eleven samples: the mean of all is that of the parts, 5, 5 and 1.
    const auto all = rowsOf(contentOf(folder.path() / "run-all.csv"));
    for (std::size_t k = 0; k < 16; ++k) {
        const auto density = [&](std::size_t part) {
            return std::stod(rows[16 * part + k].at("density_kg_per_m3"));
        };
        EXPECT_NEAR(std::stod(all[k].at("density_kg_per_m3")),
                    (5 * density(0) + 5 * density(1) + density(2)) / 11, 1e-9);
    }
    EXPECT_EQ(rowsOf(contentOf(folder.path() / "run-each.csv")).size(), 3 * 16u);
}

TEST(HeavyFieldOutput, goesOnAfterAnyStop) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is NOT tested.";
    const TestFolder folder;
    const double step = 0x1p-17;
    const auto runTo = [&](const std::string& name, std::size_t steps) {
        std::filesystem::create_directories(folder.path() / name);
        KeptRun run(folder.path() / name, steps);
        run.addOutput(profile(10 * step, 40 * step));
        run.addOutput(plane(10 * step, 40 * step));
        run.addOutput(plane(20 * step, 0).withName("each"));
        run.addOutput(plane(10 * step, 40 * step).withName("listed").asHdf5());
        run.addOutput(profile(10 * step, 40 * step).withName("grains").withoutContacts());
        run.solve();
    };
    runTo("whole", 120);
    for (const std::size_t stop : {std::size_t{14}, std::size_t{35}, std::size_t{40}, std::size_t{77}})
        runTo("part", stop);
    runTo("part", 120);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "whole")) {
        const std::string name = entry.path().filename().string();
        if (name.find("restart") != name.npos) continue;
        EXPECT_TRUE(contentOf(entry.path()) == contentOf(folder.path() / "part" / name)) << name;
    }
    std::size_t files[2] = {0, 0};
    for (int k = 0; k < 2; ++k)
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / (k ? "part" : "whole")))
            files[k] += entry.path().extension() == ".vti";
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], 4u + 7u);  // 0 to 30, 40 to 70, 80 to 110, 120; and every 20
}

// What h5py finds are the numbers of the table, with their shapes and units.
TEST(FieldOutput, isReadByH5py) {
    const std::string python = "/usr/bin/python3";
    if (support::isMissing(support::run(python + " -c 'import h5py'").exitCode == 0, "python3-h5py"))
        GTEST_SKIP() << support::without("python3-h5py", "that h5py reads the HDF5 files of fields");
    const TestFolder folder;
    const double step = 0x1p-17;
    {
        KeptRun run(folder.path(), 100);
        run.addOutput(profile(10 * step, 50 * step));
        run.addOutput(profile(10 * step, 50 * step).withName("listed").asHdf5());
        run.solve();
    }
    const auto rows = rowsOf(contentOf(folder.path() / "run-coarse.csv"));
    const std::string script = (folders::source / "SelfTests/Output/read_fields.py").string();
    const auto result =
        support::run(python + " " + script + " " + (folder.path() / "run-listed.h5").string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::istringstream lines(result.output);
    std::size_t frames = 0, compared = 0;
    for (std::string line, numbers; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string path, unit, type, packed;
        words >> path;
        if (path == "frame") {
            double time = 0;
            words >> unit >> time;
            EXPECT_EQ(time, std::stod(rows[16 * frames++].at("time_s")));
            continue;
        }
        std::size_t rank = 0, points = 0;
        words >> unit >> type >> packed >> rank >> points;
        EXPECT_EQ(points, 16u) << path;
        std::getline(lines, numbers);
        std::istringstream values(numbers);
        const std::string name = path.substr(path.find('/') + 1);
        const std::string column = name == "velocity_m_per_s" ? "velocity_z_m_per_s" : name;
        if (column != name) {
            EXPECT_EQ(unit, "m/s");
        }
        if (!rows[0].contains(column)) continue;  // a tensor
        for (std::size_t k = 0; k < points; ++k) {
            std::string number;
            for (int part = 0; part < (column == name ? 1 : 3); ++part) values >> number;
            const std::string& expected = rows[16 * (frames - 1) + k].at(column);
            if (expected.empty()) EXPECT_EQ(number, "nan");
            else EXPECT_EQ(std::stod(number), std::stod(expected)) << path;
            ++compared;
        }
    }
    EXPECT_EQ(frames, 3u);
    EXPECT_GE(compared, 3 * 16 * 8u);
}

TEST(FieldOutput, takesNoFileOfOthers) {
    if (!Hdf5File::isAvailable())
        GTEST_SKIP() << "This build has no HDF5 library: names of its files are NOT tested.";
    const TestFolder folder;
    const double step = 0x1p-17;
    for (const std::string name : {"fields", "restart"}) {
        KeptRun run(folder.path(), 1);
        const std::string sentence =
            refusal([&] { run.addOutput(profile(step, 0).withName(name).asHdf5()), run.solve(); });
        EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "NAME-" + name + ".h5")) << sentence;
    }
}

// Fields of grains alone are the same bits as those beside fields of contacts.
TEST(FieldOutput, withoutContactsHasTheOtherFieldsOnly) {
    const TestFolder folder;
    const double step = 0x1p-17;
    {
        KeptRun run(folder.path(), 100);
        run.addOutput(profile(10 * step, 50 * step));
        run.addOutput(profile(10 * step, 50 * step).withName("grains").withoutContacts());
        run.solve();
    }
    const auto all = rowsOf(contentOf(folder.path() / "run-coarse.csv")),
               grains = rowsOf(contentOf(folder.path() / "run-grains.csv"));
    ASSERT_EQ(all.size(), grains.size());
    EXPECT_TRUE(grains[0].contains("kinetic_stress_zz_Pa"));
    for (const std::string name : {"contact_stress_zz_Pa", "coordination", "fabric_xx", "liquid_fraction"}) {
        EXPECT_TRUE(all[0].contains(name)) << name;
        EXPECT_FALSE(grains[0].contains(name)) << name;
    }
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const auto& [column, text] : grains[k]) EXPECT_EQ(text, all[k].at(column)) << column;
}

TEST(FieldOutput, refusesInOneSentence) {
    EXPECT_TRUE(isOneSentence(refusal([] { profile(-1, 0); })));
    EXPECT_TRUE(isOneSentence(refusal([] { profile(std::nan(""), 0); })));
    EXPECT_TRUE(isOneSentence(refusal([] { profile(1, -1); })));
    EXPECT_TRUE(isOneSentence(refusal([] { profile(1, std::nan("")); })));
    const TestFolder folder;
    KeptRun atRest(folder.path(), 1);
    const std::string sentence =
        refusal([&] { atRest.addOutput(profile(0x1p-17, 0).againstFlow()), atRest.solve(); });
    EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "againstFlow()")) << sentence;
}

}  // namespace
}  // namespace pendular::fieldOutputTest
