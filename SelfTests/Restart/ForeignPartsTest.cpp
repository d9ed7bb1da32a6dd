// HDF5 files whose parts are elsewhere: who reads one would be given the numbers of any file that its maker
// has chosen, or wait at a pipe.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

#ifdef PENDULAR_HAS_HDF5

    #include <fstream>

    #include "Kernel/Foundation/State/Hdf5Library.h"

namespace pendular::foreignPartsTest {
namespace {

using hdf5::Object;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

constexpr hsize_t length = 4;

class ForeignParts : public testing::Test {
protected:
    ForeignParts() {
        writeList(other);
        writeList(file);
    }
    /// Writes a file with a list of numbers in a group, kept where the properties say.
    static void writeList(const std::filesystem::path& path, hid_t properties = H5P_DEFAULT) {
        const Object made(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
        const Object group(H5Gcreate2(made, "group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
        const Object space(H5Screate_simple(1, &length, nullptr), H5Sclose);
        const Object set(
            H5Dcreate2(group, "list", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
            H5Dclose);
        ASSERT_GE(static_cast<hid_t>(set), 0);
    }
    [[nodiscard]] Object opened() const {
        return {H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose};
    }
    /// Expects that all ways to read what has this name are refused.
    void expectRefused(const std::string& name, const std::string& part) const {
        const Hdf5File read(file, Hdf5File::Access::Read);
        std::vector<double> numbers(length);
        for (const std::string& text : {refusal([&] { static_cast<void>(read.shapeOf(name)); }), refusal([&] {
                                            read.read(name, {NumberKind::Float64, length, 1}, numbers.data());
                                        }),
                                        refusal([&] { static_cast<void>(read.readText(name)); })}) {
            EXPECT_TRUE(isOneSentence(text));
            EXPECT_TRUE(contains(text, part));
        }
    }

    const TestFolder folder;
    const std::filesystem::path file = folder.path() / "file.h5", other = folder.path() / "other.h5";
};

TEST_F(ForeignParts, areNotThereInAFileOfOurs) {
    const Hdf5File read(file, Hdf5File::Access::Read);
    EXPECT_TRUE(read.holds("group/list"));
    EXPECT_FALSE(read.holds("group/none"));
    EXPECT_FALSE(read.holds("none/list"));
    EXPECT_EQ(read.shapeOf("group/list"), (TableShape{NumberKind::Float64, length, 1}));
    EXPECT_TRUE(
        contains(refusal([&] { static_cast<void>(read.shapeOf("group/none")); }), "has no group/none"));
}

TEST_F(ForeignParts, behindLinksAreRefused) {
    const auto pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    {
        const Object made = opened();
        H5Lcreate_external(other.c_str(), "/group/list", made, "list", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_external(other.c_str(), "/group", made, "there", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_external(pipe.c_str(), "/", made, "waits", H5P_DEFAULT, H5P_DEFAULT);
        H5Lcreate_soft("/group/list", made, "soft", H5P_DEFAULT, H5P_DEFAULT);
    }
    expectRefused("list", "has a link to another place at list");
    expectRefused("there/list", "has a link to another place at there");
    expectRefused("waits/list", "has a link to another place at waits");
    expectRefused("soft", "has a link to another place at soft");
    const Hdf5File read(file, Hdf5File::Access::Read);
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(read.holds("waits/list")); }), "link to another"));
    EXPECT_EQ(read.names(), std::vector<std::string>{"group/list"});
}

TEST_F(ForeignParts, ofAListAreRefused) {
    const auto numbers = folder.path() / "numbers";
    std::ofstream(numbers) << "eight bytes for each of the four";
    const Object outside(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_external(outside, numbers.c_str(), 0, H5F_UNLIMITED);
    writeList(file, outside);
    expectRefused("group/list", "keeps group/list in another file");

    const Object gathered(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const Object space(H5Screate_simple(1, &length, nullptr), H5Sclose);
    ASSERT_GE(H5Pset_virtual(gathered, space, other.c_str(), "/group/list", space), 0);
    writeList(file, gathered);
    expectRefused("group/list", "keeps group/list in another file");
}

}  // namespace
}  // namespace pendular::foreignPartsTest

#else

TEST(ForeignParts, areRefused) {
    GTEST_SKIP() << "This build has no HDF5 library: its files are not tested.";
}

#endif
