#include <gtest/gtest.h>

#include "Kernel/State/Hdf5File.h"

namespace pendular {
namespace {

/// Skips all tests of this program in a build that has no restart files.
class NeedsHdf5 : public testing::Environment {
public:
    void SetUp() override {
        if (!Hdf5File::isAvailable())
            GTEST_SKIP() << "This build has no HDF5 library: restart is not tested (install libhdf5-dev).";
    }
};

[[maybe_unused]] const auto* const needsHdf5 = testing::AddGlobalTestEnvironment(new NeedsHdf5);

}  // namespace
}  // namespace pendular
