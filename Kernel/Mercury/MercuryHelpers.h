#pragma once

#include <cmath>
#include <string>

#include "Kernel/Core/Particles/SphericalParticle.h"

// MercuryDPM's namespaces of small functions, as far as its public programs call them.

namespace helpers {

/// Writes a text to a file, in the place of one that is there. Throws InputError if that fails.
void writeToFile(const std::string& file, const std::string& text);
/// Whether there is a file of this name.
bool fileExists(const std::string& file);
/// The steps from one save to the next for so many saves, with that at the start, in the time (s); at
/// least 1.
std::size_t getSaveCountFromNumberOfSavesAndTimeMaxAndTimeStep(std::size_t saves, double timeMax,
                                                               double timeStep);
/// A value of the command line: program -NAME VALUE; the standard value where it is not there. Throws
/// InputError for a value that is missing or no number.
double readFromCommandLine(int argc, const char* const* argv, const std::string& name, double standard);
std::string readFromCommandLine(int argc, const char* const* argv, const std::string& name,
                                const std::string& standard);
/// Whether the word is there.
bool readFromCommandLine(int argc, const char* const* argv, const std::string& name);
/// Throws RunError, with what was checked, unless the value is the expected one up to the error.
void check(double value, double expected, double error, const std::string& whatIsChecked);
void check(const pendular::Vec3D& value, const pendular::Vec3D& expected, double error,
           const std::string& whatIsChecked);

}  // namespace helpers

namespace mathsFunc {

using std::cos, std::exp, std::log, std::sin;
constexpr double square(double value) { return value * value; }
constexpr double cubic(double value) { return value * value * value; }
/// Whether two values differ by no more than the error; not for one that is not a number.
constexpr bool isEqual(double value, double other, double error) {
    const double difference = value - other;
    return -error <= difference && difference <= error;
}
/// The same for each of the three numbers.
inline bool isEqual(const pendular::Vec3D& value, const pendular::Vec3D& other, double error) {
    return isEqual(value.x(), other.x(), error) && isEqual(value.y(), other.y(), error) &&
           isEqual(value.z(), other.z(), error);
}

}  // namespace mathsFunc
