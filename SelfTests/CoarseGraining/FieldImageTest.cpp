// Files of fields, read again: the numbers of the sums at each point of the grid, and the places of these
// points.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <tuple>

#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/CoarseGraining/FieldImage.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fieldImageTest {
namespace {

using support::refusal;

FieldSums someFields(std::string_view coordinates) {
    const FieldGrid grid(coordinates, {-0.01, -0.01, 0}, {0.01, 0.01, 0.03}, 4e-3);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), 3e-3));
    support::Random random(3);
    GrainState state;
    for (int k = 0; k < 20; ++k)
        state.grains.push_back(
            {{random.uniform(-9e-3, 9e-3), random.uniform(-9e-3, 9e-3), random.uniform(0, 0.02)},
             {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
             1e-3,
             1e-5});
    sums.add(state);
    return sums;
}

TEST(FieldImage, hasTheNumbersOfTheSums) {
    const support::TestFolder folder;
    for (const std::string coordinates : {"XZ", "YZ", "XYZ", "RZ", "Z"}) {
        const FieldSums sums = someFields(coordinates);
        const FieldGrid& grid = sums.grid();
        const std::vector<PolyDataField> fields = fieldsOf(sums);
        for (const std::string ending : {".vti", ".h5"}) {
            if (ending == ".h5" && !Hdf5File::isAvailable()) continue;
            const std::filesystem::path path = folder.path() / (coordinates + ending);
            if (ending == ".h5") writeHdf5(path, sums, 0.25, 7);
            else writeImage(path, sums, 0.25);
            for (const PolyDataField& field : fields) {
                const FieldImage image = readFieldImage(path, field.name);
                ASSERT_EQ(image.field.name, field.name);
                ASSERT_EQ(image.known.size(), fields.size());
                EXPECT_EQ(image.axes[0], coordinates == "RZ" ? "r" : "x") << coordinates << ending;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    ASSERT_EQ(image.places[axis].size(), grid.counts()[axis]);
                    for (std::size_t k = 0; grid.isResolved(axis) && k < grid.counts()[axis]; ++k)
                        EXPECT_NEAR(image.places[axis][k], grid.at(axis, k), 1e-12);
                }
                const auto& n = grid.counts();
                for (std::size_t k = 0; k < grid.size(); ++k)
                    for (std::size_t c = 0; c < field.components; ++c) {
                        const double expected = field.at(k * field.components + c),
                                     found = image.at({k / (n[1] * n[2]), k / n[2] % n[1], k % n[2]}, c);
                        EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)));
                    }
            }
            EXPECT_EQ(readFieldImage(path, "").field.name, readFieldImage(path, "").known.front().name);
            const std::string text = refusal([&] { readFieldImage(path, "colour"); });
            EXPECT_TRUE(support::contains(text, "has no field 'colour'"));
            EXPECT_TRUE(support::isOneSentence(text));
        }
        if (coordinates == "XZ") {
            EXPECT_EQ(readFieldImage(folder.path() / "XZ.vti", "").time, 0.25);
        }
    }
}

TEST(FieldImage, thatIsNoneIsRefused) {
    const support::TestFolder folder;
    const std::filesystem::path path = folder.path() / "a.vti";
    writeImage(path, someFields("XZ"), 0);
    std::ifstream stream(path, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(stream), {}};
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        text.replace(at, from.size(), to);
        std::ofstream(path, std::ios::binary) << text;
        return refusal([&] { readFieldImage(path, ""); });
    };
    for (const auto& [from, to, words] :
         {std::tuple{"WholeExtent=\"0 4", "WholeExtent=\"0 400000000", "no grid"},
          {"WholeExtent=\"0 4", "WholeExtent=\"0 5", "wrong size"},
          {"WholeExtent=\"0 4", "WholeExtent=\"0 20000000", "early"},
          {"WholeExtent=\"0 4", "WholeExtent=\"-1 4", "no grid"},
          {"Spacing=\"", "Spacing=\"-", "no grid"},
          {"Origin=\"", "Origin=\"x", "3 numbers"},
          {"ImageData\" version", "PolyData\" version", "only 'ImageData'"},
          {"<ImageData", "<PolyData", "no image"},
          {"</ImageData>", "<ImageData WholeExtent=\"0 0 0 0 0 0\" Origin=\"0 0 0\" Spacing=\"1 1 1\">",
           "two grids"},
          {"<AppendedData", "<Appended", "appended"}}) {
        const std::string text = refused(from, to);
        EXPECT_TRUE(support::contains(text, words)) << from;
        EXPECT_TRUE(support::isOneSentence(text));
    }
}

}  // namespace
}  // namespace pendular::fieldImageTest
