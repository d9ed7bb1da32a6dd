#pragma once

#include <array>
#include <span>
#include <vector>

#include "Kernel/Features/RigidBodies/HalvedIntervals.h"
#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

/// Cuts spheres by planes across z, to unions of discs.
class SphereSlices {
public:
    /// What is integrated over a slice: area, and the moments of x, y, xx, yy, xy.
    enum Part { Area, X, Y, XX, YY, XY, Parts };
    using Sums = ValuesAtHeight<Parts>;

    /// They must stay where they are.
    explicit SphereSlices(std::span<const Ball> spheres) : all(spheres) {}

    /// The integrals over the slice at a height z (m).
    Sums at(double z);
    /// rad, of the rim of the first sphere's disc, that no other disc covers; 0 where it has no disc.
    double freeAngleOfFirst(double z);

private:
    struct Disc {
        double x, y, radius;  // m
    };
    /// The angles (rad) of a disc's rim that another one covers, if any.
    struct Cover {
        double from, to;
    };

    void cut(double z);
    template <class Use>
    void forFreeArcs(std::size_t disc, Use&& use);
    bool findCovers(std::size_t disc);
    void addCover(double from, double to);
    static void addArc(const Disc& disc, double from, double to, Sums& sums);

    std::span<const Ball> all;
    std::vector<Disc> discs;
    std::vector<Cover> covers;
};

/// The heights (m) at which slices are not smooth, ascending: poles, and the ends of the circles in which two
/// spheres cut each other (of up to 64 spheres; of more, the halving of intervals finds them).
std::vector<double> heightsOfChange(std::span<const Ball> spheres);

}  // namespace pendular
