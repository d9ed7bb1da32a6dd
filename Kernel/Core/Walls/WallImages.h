#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Where a surface lies: the middle of a box along the axes around it, and half the lengths of the box, m.
struct SurroundingBox {
    Vector<double> middle{0, 0, 0}, half{0, 0, 0};
};

/// The images of a wall in a scene that repeats itself: it stands there again after each period. A contact
/// knows which one it is at by the number of its part, whose nine highest bits have the number of the image
/// along each axis, modulo 8; the wall itself is image 0. As no wall is longer than four periods, and no
/// grain reaches farther than half a period, a grain meets at most seven images that follow each other along
/// an axis, and its place tells which of those eight apart it is.
class WallImages {
public:
    static constexpr std::uint32_t mostParts = 1u << 23;
    static constexpr double mostPeriods = 4;

    /// @param lengths m, of the periods; 0 along an axis without one
    void repeat(const Vector<double>& lengths) { periods = lengths; }
    [[nodiscard]] bool areThere() const { return periods.x + periods.y + periods.z > 0; }

    /// The part of the wall that a part of an image is.
    static std::uint32_t partOf(std::uint32_t part) { return part & (mostParts - 1); }
    static std::uint32_t imageOf(std::uint32_t part) { return part & ~(mostParts - 1); }

    /// Calls function(shift, image) for each image that may be within reach (m) of a point: how far it is
    /// from the wall itself (m), and what its parts have in their highest bits.
    template <class Function>
    void forEachWithin(const Vector<double>& point, double reach, const SurroundingBox& box,
                       Function&& function) const {
        const auto alongX = near(point.x - box.middle.x, box.half.x + reach, periods.x),
                   alongY = near(point.y - box.middle.y, box.half.y + reach, periods.y),
                   alongZ = near(point.z - box.middle.z, box.half.z + reach, periods.z);
        for (int x = alongX[0]; x <= alongX[1]; ++x)
            for (int y = alongY[0]; y <= alongY[1]; ++y)
                for (int z = alongZ[0]; z <= alongZ[1]; ++z)
                    function(Vector<double>{x * periods.x, y * periods.y, z * periods.z}, bitsOf({x, y, z}));
    }

    /// m, how far the image of a part is from the wall itself.
    /// @param point m, of a grain that is within reach of it
    [[nodiscard]] Vector<double> shiftOf(std::uint32_t part, const Vector<double>& point,
                                         const SurroundingBox& box) const {
        const std::array<int, 3> bits = numbersIn(part);
        return {periods.x * numberOf(bits[0], point.x - box.middle.x, periods.x),
                periods.y * numberOf(bits[1], point.y - box.middle.y, periods.y),
                periods.z * numberOf(bits[2], point.z - box.middle.z, periods.z)};
    }

    /// The part that a grain meets where it met this one, when it has been brought back.
    /// @param way m, by which it was: whole periods, to round-off
    [[nodiscard]] std::uint32_t partAfter(const Vector<double>& way, std::uint32_t part) const {
        const std::array<int, 3> bits = numbersIn(part);
        return partOf(part) |
               bitsOf({bits[0] + periodsIn(way.x, periods.x), bits[1] + periodsIn(way.y, periods.y),
                       bits[2] + periodsIn(way.z, periods.z)});
    }

private:
    static constexpr int modulus = 8;  // per axis, three bits

    static int periodsIn(double way, double period) {
        return period > 0 ? static_cast<int>(std::lround(way / period)) : 0;
    }
    /// The first and the last number of an image whose middle is not farther away than this (m).
    static std::array<int, 2> near(double apart, double farthest, double period) {
        if (!(period > 0)) return {0, 0};
        const int nearest = periodsIn(apart, period);
        return {std::max(nearest - 3, static_cast<int>(std::ceil((apart - farthest) / period))),
                std::min(nearest + 3, static_cast<int>(std::floor((apart + farthest) / period)))};
    }
    static std::uint32_t bitsOf(const std::array<int, 3>& numbers) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits |= (static_cast<std::uint32_t>(numbers[k]) % modulus) << (3 * k);
        return bits * mostParts;
    }
    static std::array<int, 3> numbersIn(std::uint32_t part) {
        const auto bits = static_cast<int>(part / mostParts);
        return {bits % modulus, bits / modulus % modulus, bits / (modulus * modulus)};
    }
    /// The number of an image, which is at most four from that nearest to a grain.
    static int numberOf(int bits, double apart, double period) {
        const int nearest = periodsIn(apart, period);
        const auto above =
            static_cast<int>(static_cast<std::uint32_t>(bits - nearest + modulus / 2) % modulus);
        return period > 0 ? nearest + above - modulus / 2 : 0;
    }

    Vector<double> periods{0, 0, 0};  // m
};

}  // namespace pendular
