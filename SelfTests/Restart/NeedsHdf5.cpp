#include <gtest/gtest.h>

#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Support/Dependency.h"

namespace pendular::needsHdf5 {
namespace {

/// Skips all tests of this program in a build that has no restart files.
class NeedsHdf5 : public testing::Environment {
public:
    void SetUp() override {
        if (support::isMissing(Hdf5File::isAvailable(), "libhdf5-dev"))
            GTEST_SKIP() << support::without("libhdf5-dev", "restart");
    }
};

[[maybe_unused]] const auto* const needsHdf5 = testing::AddGlobalTestEnvironment(new NeedsHdf5);

}  // namespace
}  // namespace pendular::needsHdf5
