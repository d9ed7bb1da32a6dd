#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/Meshes/TriangleReader.h"

namespace pendular {

/// A drum about the y axis with square bars along it on its inside, as triangles whose normals point in.
struct LifterDrum {
    /// A face of a lifter, or the shell between two lifters, in a drum that turns about -y.
    enum class Face { Shell, Leading, Top, Trailing };
    static constexpr std::size_t faceCount = 4;
    static constexpr int facets = 6;  // of the shell between two lifters

    double radius = 0.02;  // m
    double length = 6e-3;  // m
    int lifters = 8;
    double height = 3e-3;  // m

    /// @param beyond m, that the drum goes on past both of its ends
    [[nodiscard]] std::vector<Triangle> triangles(double beyond) const {
        std::vector<Triangle> result;
        const std::vector<Vector<double>> ring = profile();
        const Vector<double> low{0, -beyond, 0}, high{0, length + beyond, 0};
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Vector<double>&a = ring[k], &b = ring[(k + 1) % ring.size()];
            result.push_back({a + low, b + low, b + high});
            result.push_back({a + low, b + high, a + high});
        }
        return result;
    }
    /// On which face a triangle lies.
    [[nodiscard]] Face faceOf(std::size_t triangle) const {
        const std::size_t side = triangle / 2 % (facets + 3);
        if (side >= 3) return Face::Shell;
        return std::array{Face::Trailing, Face::Top, Face::Leading}[side];
    }

private:
    /// The corners of the cross-section, from +x towards +z: of each lifter four, then the shell's.
    [[nodiscard]] std::vector<Vector<double>> profile() const {
        std::vector<Vector<double>> ring;
        const double pitch = 2 * std::numbers::pi / lifters, width = 2 * std::asin(0.5 * height / radius);
        const auto at = [&](double angle) {
            return Vector<double>{radius * std::cos(angle), 0, radius * std::sin(angle)};
        };
        for (int l = 0; l < lifters; ++l) {
            const double begin = l * pitch, end = begin + width, middle = 0.5 * (begin + end);
            const Vector<double> in = -height * Vector<double>{std::cos(middle), 0, std::sin(middle)};
            ring.insert(ring.end(), {at(begin), at(begin) + in, at(end) + in});
            for (int f = 0; f < facets; ++f) ring.push_back(at(end + (pitch - width) * f / facets));
        }
        return ring;
    }
};

}  // namespace pendular
