#pragma once

#include <cstdint>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

/// Spheres of any sizes, one after the other: whether there is room for another one. Cells of space, of one
/// size for each factor of two of the radius, are entries of a hash table; an entry may hold several cells,
/// which costs time only, as distances decide.
class SphereGrid {
public:
    explicit SphereGrid(const PeriodicBox& box) : periodic(box), heads(64, none) {}
    /// A grid with the grains of a scene that a sphere of at most this radius (m) can meet in a box.
    SphereGrid(const ParticleStore& grains, const PeriodicBox& periodic, const Box& within, double radius);

    /// @param centre m; @param radius m
    void add(const Vector<double>& centre, double radius);
    /// Whether a sphere overlaps none of those that were added, or of their periodic images.
    [[nodiscard]] bool isFree(const Vector<double>& centre, double radius) const;
    [[nodiscard]] std::size_t size() const { return spheres.size(); }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    struct Sphere {
        Vector<double> centre;
        double radius;
        int level;
        std::uint32_t next;  // in the same entry of the table
    };
    /// Radii from 2^n to 2^(n+1); cells are as wide as the largest sphere.
    static int levelOf(double radius);
    static double cellSize(int level);

    [[nodiscard]] std::size_t entry(int level, std::int64_t x, std::int64_t y, std::int64_t z) const;
    void link(std::uint32_t sphere);
    [[nodiscard]] bool overlaps(const Sphere& sphere, const Vector<double>& centre, double radius) const;
    [[nodiscard]] bool isFreeOfLevel(int level, const Vector<double>& image, double radius) const;

    [[nodiscard]] bool isFreeAtImages(int level, const Vector<double>& at, double radius) const;

    PeriodicBox periodic;
    std::vector<Sphere> spheres;
    std::vector<std::uint32_t> heads;  // of the table: a power of two
    std::vector<int> levels;           // those that have spheres
};

}  // namespace pendular
