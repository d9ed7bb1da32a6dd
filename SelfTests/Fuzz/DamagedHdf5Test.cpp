// Damaged HDF5 files: what they claim is compared with what is stored, and what ends the library itself
// becomes a sentence. RestartBytes and Hdf5Bytes (ReadersTest) change bytes at random; these are the cases
// that were found.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Fuzz/Target.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"

namespace pendular::damagedHdf5Test {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

void readNames(const std::filesystem::path& file) {
    static_cast<void>(Hdf5File(file, Hdf5File::Access::Read).names());
}

class DamagedHdf5 : public testing::Test {
protected:
    void SetUp() override {
        if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library.";
    }
    /// Puts another number of 64 bits in the place of one, wherever the file has it; returns how often.
    int replace(std::uint64_t number, std::uint64_t by) const {
        const auto text = [](std::uint64_t of) {
            return std::string(reinterpret_cast<const char*>(&of), sizeof of);
        };
        std::string bytes = fuzz::bytesOf(path);
        int found = 0;
        for (std::size_t at = bytes.find(text(number)); at != bytes.npos;
             at = bytes.find(text(number), at + 8)) {
            bytes.replace(at, 8, text(by));
            ++found;
        }
        fuzz::writeBytes(path, bytes);
        return found;
    }

    const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path path = folder.path() / "file.h5";
};

/// A chunk of zeros has some 50 bytes, which can be 50 kB of numbers. A million rows were read as 24 MB of
/// zeros, since the whole file, with its other columns, is large enough for them.
TEST_F(DamagedHdf5, packedColumnsClaimNoMoreThanTheirChunksHold) {
    {
        FieldFile file(path);
        file.column("particles", {"position_m", 3, std::vector<double>(3 * 997)});
        file.column("particles", {"radius_m", 1, std::vector<double>(997, 1e-3)});
        std::vector<double> noise(997);
        for (std::size_t k = 0; k < noise.size(); ++k) noise[k] = std::sin(1e3 * static_cast<double>(k));
        for (int k = 0; k < 5; ++k) file.column("others", {"field" + std::to_string(k), 1, noise});
        file.close();
    }
    ASSERT_GT(1032 * std::filesystem::file_size(path), 24'000'000u);
    EXPECT_GT(replace(997, 1'000'000), 0);
    const std::string text = refusal([&] { readHdf5Frame(path); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "has fewer bytes than particles/position_m is to have numbers") ||
                contains(text, "has no table or text at"))
        << text;
}

/// Rows without columns take no bytes: a program that goes through them has no end.
TEST_F(DamagedHdf5, tablesOfNoColumnsClaimNoRows) {
    std::vector<double> curve(12345);
    writeRestartFile(path, [&](StateArchive& archive) { archive.column<double>("curve", curve); });
    std::string bytes = fuzz::bytesOf(path);
    const std::uint64_t before[] = {12345, 1}, claimed[] = {std::uint64_t{1} << 60, 0};
    const std::string one(reinterpret_cast<const char*>(before), sizeof before);
    int found = 0;
    for (std::size_t at = bytes.find(one); at != bytes.npos; at = bytes.find(one, at + one.size()), ++found)
        bytes.replace(at, one.size(), reinterpret_cast<const char*>(claimed), sizeof claimed);
    ASSERT_GT(found, 0);
    fuzz::writeBytes(path, bytes);
    const Hdf5File file(path, Hdf5File::Access::Read);
    const std::string text = refusal([&] { static_cast<void>(file.shapeOf("curve")); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "has fewer bytes than curve is to have numbers") ||
                contains(text, "has no table or text at curve"))
        << text;
}

/// A file can be read after another one that was damaged.
TEST_F(DamagedHdf5, leavesOtherFilesReadable) {
    std::vector<double> curve{1, 2, 3}, read;
    writeRestartFile(path, [&](StateArchive& archive) { archive.column<double>("curve", curve); });
    const std::filesystem::path damaged = folder.path() / "damaged.h5";
    std::string bytes = fuzz::bytesOf(path);
    bytes.replace(bytes.find("TREE"), 4, "tree");
    fuzz::writeBytes(damaged, bytes);
    EXPECT_TRUE(isOneSentence(refusal([&] { readNames(damaged); })));
    readRestartFile(path, [&](StateArchive& archive) { archive.column<double>("curve", read); });
    EXPECT_EQ(read, curve);
}

/// HDF5 1.10.8 follows the address of a group's node, and copies from outside of its buffer: SIGSEGV.
TEST_F(DamagedHdf5, theLibrarysOwnCrashIsASentence) {
    const std::string file = "damaged/restart-hdf5-crash.h5.gz";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    gzFile packed = gzopen(support::sharedData(file).c_str(), "rb");
    ASSERT_TRUE(packed);
    std::string bytes(1 << 20, '\0');
    const int length = gzread(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    ASSERT_GT(length, 100000);
    fuzz::writeBytes(path, bytes.substr(0, static_cast<std::size_t>(length)));
    sealRestartFile(path);  // of the format of today
    checkRestartFile(path);
    const std::string text = refusal([&] { readNames(path); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, path.string())) << text;
}

TEST_F(DamagedHdf5, aFrameWithOneChangedByteTakesNoMemory) {
    const std::string file = "damaged/frame-one-byte.h5";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    std::filesystem::copy_file(support::sharedData(file), path);
    const std::string text = refusal([&] { readHdf5Frame(path); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "has fewer bytes than particles/body is to have numbers") ||
                contains(text, "has no table or text at particles/body"))
        << text;
}

}  // namespace
}  // namespace pendular::damagedHdf5Test
