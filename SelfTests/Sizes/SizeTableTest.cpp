#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::sizeTableTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TemporaryFile;

SizeDistribution read(const std::string& text, std::optional<InClass> within = {}) {
    return readSizeTable(TemporaryFile(".csv", text).path, within);
}

TEST(SizeTable, readsWhatItsFirstLineSays) {
    const auto number = [](const SizeDistribution& sizes) {
        return sizes.cumulative(SizeBasis::Number, 3e-3);
    };
    // One distribution, even in number from 2 to 6 mm, in all forms.
    for (const std::string text : {"diameter_mm,cumulative_number\n2,0\n6,1\n",
                                   "# sieved\r\nradius_um, class_number_percent\r\n1000,0\r\n\r\n3000,100",
                                   "diameter_m,density_number\n2e-3,7\n6e-3,7",
                                   "\xEF\xBB\xBF"
                                   "diameter_mm,cumulative_number\n2,0\n6,1\n",
                                   "radius_m,cumulative_number_percent\n1e-3,0\n2e-3,50\n3e-3,100\n"}) {
        const SizeDistribution sizes = read(text);
        EXPECT_DOUBLE_EQ(sizes.smallest(), 2e-3) << text;
        EXPECT_DOUBLE_EQ(sizes.largest(), 6e-3) << text;
        EXPECT_NEAR(number(sizes), 0.25, 1e-15) << text;
    }
    EXPECT_EQ(read("diameter_mm,single_mass\n1,0.5\n2,0.5\n").cumulative(SizeBasis::Volume, 1e-3), 0.5);
    // In a class: the volume is even in the diameter, or the number.
    const std::string sieve = "diameter_mm,class_volume\n2,0\n4,1\n";
    EXPECT_NEAR(read(sieve).cumulative(SizeBasis::Volume, 3e-3), 0.5, 1e-15);
    EXPECT_NEAR(number(read(sieve, InClass::EvenInNumber)), 0.5, 1e-15);
}

TEST(SizeTable, refusesWithFilePlaceAndReason) {
    const std::string head = "diameter_mm,cumulative_volume\n", sieve = "diameter_mm,class_volume_percent\n";
    struct Case {
        std::string text, place, reason;
    };
    const std::vector<Case> cases{
        {"", "", "has no line that names its columns"},
        {"# nothing\n", "", "has no line that names its columns"},
        {"1,0\n2,1\n", "line 1", "must name two columns"},
        {"diameter,cumulative_volume\n1,0\n", "line 1", "must name two columns"},
        {"diameter_km,cumulative_volume\n1,0\n", "line 1", "must name two columns"},
        {"diameter_mm,cumulative_weight\n1,0\n", "line 1", "must name two columns"},
        {"diameter_mm,density_volume_percent\n1,0\n", "line 1", "must name two columns"},
        {"diameter_mm,cumulative_volume,x\n", "line 1", "must name two columns"},
        {head, "", "has 0 rows; there must be 2"},
        {head + "1,0\n", "", "has 1 rows; there must be 2"},
        {head + "1,0\n2,0.5,3\n", "line 3", "3 columns; there must be 2"},
        {head + "1,0\n2\n", "line 3", "1 column; there must be 2"},
        {head + "1 0\n", "line 2", "1 column; there must be 2"},
        {head + "1,0\n2,nan\n", "line 3", "the value is nan"},
        {head + "1,0\nnan,1\n", "line 3", "the size is nan"},
        {head + "1,0\n2,inf\n", "line 3", "the value is inf"},
        {head + "1,0\n2,-0.5\n", "line 3", "the value is -0.5; it must be 0 or more"},
        {head + "-1,0\n", "line 2", "the size is -1"},
        {head + "0,0\n", "line 2", "the diameter is 0 m; it must be at least 2e-12 m"},
        {head + "1e13,0\n", "line 2", "the diameter is 1e+10 m"},
        {head + "1,0\n2,half\n", "line 3", "the value 'half' is not a number"},
        {head + "1,0\n2,\n", "line 3", "the value '' is not a number"},
        {head + "1,0\n3,0.5\n2,1\n", "line 4", "not larger than that of the row before"},
        {head + "1,0\n2,0.5\n2,1\n", "line 4", "not larger than that of the row before"},
        {head + "1,0\n2,0.6\n3,0.5\n", "line 4", "smaller than that of the row before"},
        {head + "1,0.1\n2,1\n", "line 2", "the first value is 0.1; it must be 0"},
        {head + "1,0\n2,0.99\n", "line 3", "end at 0.99; they must end at 1"},
        {head + "1,0\n2,100\n", "line 3", "end at 100; they must end at 1"},
        {sieve + "1,0\n2,40\n3,50\n", "", "values whose sum is 90; it must be 100"},
        {sieve + "1,5\n2,95\n", "line 2", "the first value is 5; it must be 0"},
        {"diameter_mm,single_number\n1,0.3\n", "", "values whose sum is 0.3; it must be 1"},
    };
    for (const Case& c : cases) {
        const std::string text = refusal([&] { read(c.text); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "size table")) << c.text;
        EXPECT_TRUE(contains(text, c.place));
        EXPECT_TRUE(contains(text, c.reason));
    }
    EXPECT_TRUE(contains(refusal([] { read("diameter_mm,density_volume\n1,0\n2,0\n"); }), "no grains"));
    EXPECT_TRUE(contains(refusal([] { readSizeTable("/no/such.csv"); }), "does not exist"));
}

TEST(SizeTable, functionsRefuseToo) {
    const std::array<double, 2> d{1e-3, 2e-3}, falling{2e-3, 1e-3}, short_{1e-3, unset};
    const std::array<double, 1> one{1.0}, negative{-1.0};
    const std::array<double, 2> half{0.0, 0.5};
    const auto basis = SizeBasis::Volume;
    for (const auto& text :
         {refusal([&] { sizesFromClasses(d, d, basis); }), refusal([&] { sizesFromClasses({}, {}, basis); }),
          refusal([&] { sizesFromClasses(falling, one, basis); }),
          refusal([&] { sizesFromClasses(short_, one, basis); }),
          refusal([&] { sizesFromClasses(d, negative, basis); }),
          refusal([&] { sizesFromCumulative(d, half, basis); }),
          refusal([&] { sizesFromDensity(d, one, basis); })})
        EXPECT_TRUE(isOneSentence(text));
}

// A million rows of the cumulative curve of a law even in number.
TEST(SizeTable, readsAMillionRows) {
    constexpr int rows = 1000000;
    std::string text = "diameter_um,cumulative_number\n";
    for (int k = 0; k <= rows; ++k)
        text += fmt::format("{},{}\n", 1000 + 0.001 * k, static_cast<double>(k) / rows);
    const SizeDistribution sizes = read(text);
    // Round-off of a sum of a million terms: at most 1e6 units of 1e-16 of it.
    EXPECT_NEAR(sizes.mean(1, 0), 1.5e-3, 1.5e-3 * 1e-10);
    EXPECT_NEAR(sizes.mean(3, 0) / std::cbrt((16.0 - 1) / 4), 1e-3, 1e-13);
    EXPECT_NEAR(sizes.quantile(SizeBasis::Number, 0.25), 1.25e-3, 1.25e-3 * 1e-10);
}

}  // namespace
}  // namespace pendular::sizeTableTest
