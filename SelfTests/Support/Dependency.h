#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace pendular::support {

/// Whether a program or a library that a test needs is missing: the test is to be skipped then. It fails
/// where PENDULAR_REQUIRE_DEPENDENCIES is set (Tools/run-tests.sh in CI, which has installed it).
/// @param package of Debian
inline bool isMissing(bool isThere, const std::string& package) {
    if (!isThere && std::getenv("PENDULAR_REQUIRE_DEPENDENCIES"))
        ADD_FAILURE() << "The Debian package " << package << " is not there, and it is needed here.";
    return !isThere;
}

/// What a test says that is skipped without it.
inline std::string without(const std::string& package, const std::string& what) {
    return "The Debian package " + package + " is not there: " + what + " is NOT tested.";
}

}  // namespace pendular::support
