// Fields along one axis against sums point by point.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular::axisFieldsTest {
namespace {

using Sum = FieldSums::Sum;
using V = Vector<double>;

constexpr double length = 0.02, width = 1e-3;  // m

double part(const V& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Grains of three species in a box, and contacts of neighbours in the list: long and short lines, one of no
/// length along each axis, some with adhesion, some at walls, some across a face of a periodic axis.
GrainState someGrains(std::size_t axis, bool isPeriodic, bool hasShortLines) {
    GrainState state;
    UniformRandom random(7);
    const auto some = [&](double low, double high) {
        const double x = random.uniform(low, high), y = random.uniform(low, high);
        return V{x, y, random.uniform(low, high)};
    };
    for (int k = 0; k < 150; ++k) {
        const V position = some(0.1 * length, 0.9 * length), velocity = some(-1, 1);
        const double radius = random.uniform(2e-4, 6e-4);
        state.grains.push_back(
            {position, velocity, radius, random.uniform(1e-6, 2e-6), random.uniform(0, 1e-12), k % 3});
    }
    if (isPeriodic) {
        double& period = axis == 0   ? state.periodic.length.x
                         : axis == 1 ? state.periodic.length.y
                                     : state.periodic.length.z;
        period = length;
        for (GrainState::Grain& grain : state.grains) {  // also beside the faces
            double& place = axis == 0 ? grain.position.x : axis == 1 ? grain.position.y : grain.position.z;
            place = (place - 0.1 * length) / 0.8;
        }
    }
    for (std::uint32_t k = 0; k + 1 < 150; ++k) {
        const bool atWall = k % 20 == 7;
        V shift = state.periodic.nearest(state.grains[k + 1].position - state.grains[k].position);
        if (atWall) shift = {2e-4, 1e-4, -3e-4};
        // A line shorter than the closed form has digits for. (Of two groups its parts would be longer.)
        if (k % 10 == 3 && hasShortLines) shift = 1e-3 * shift;
        if (k % 10 == 5) shift.x = 0;
        state.contacts.push_back({k, atWall ? GrainState::Contact::wall : k + 1, shift, some(-1, 1),
                                  k % 4 == 1 ? random.uniform(0, 1) : 0, random.uniform(0, 1e-12),
                                  k % 5 != 0});
    }
    return state;
}

/// All sums of a grid, one point, kernel and image after another. Stress is that of straight lines between
/// the centres, or from a wall's point: those of two groups are divided at their contact point.
class PointByPoint {
public:
    PointByPoint(const GrainState& of, const SmoothingKernel& phi, std::size_t along)
        : state(of), kernel(phi), axis(along) {}

    /// The sum over all groups, and the sum of the magnitudes of its terms.
    struct Value {
        double sum = 0, size = 0;
        void add(double term) { sum += term, size += std::abs(term); }
    };
    [[nodiscard]] Value stress(std::size_t i, std::size_t j, double place) const {
        Value all;
        for (const GrainState::Contact& c : state.contacts) {
            const V end = state.grains[c.first].position + c.shift, branch = -c.shift;
            all.add(part(c.force, i) * part(branch, j) *
                    lineMean(part(end, axis), part(branch, axis), place));
        }
        return all;
    }
    [[nodiscard]] Value adhesive(double place) const {  // xy
        Value all;
        for (const GrainState::Contact& c : state.contacts) {
            const V end = state.grains[c.first].position + c.shift;
            if (c.adhesiveForce != 0)
                all.add(-c.adhesiveForce / norm(c.shift) * c.shift.x * c.shift.y *
                        lineMean(part(end, axis), -part(c.shift, axis), place));
        }
        return all;
    }
    template <class Of>
    [[nodiscard]] Value ofGrains(double place, Of&& of) const {
        Value all;
        for (std::size_t k = 0; k < state.grains.size(); ++k)
            forImages(part(state.grains[k].position, axis),
                      [&](double at) { all.add(of(k) * kernel.value((place - at) * (place - at))); });
        return all;
    }

private:
    template <class Use>
    void forImages(double at, Use&& use) const {
        const double period = part(state.periodic.length, axis);
        for (int image = -2; image <= 2; ++image)
            if (image == 0 || period > 0) use(at + image * period);
    }
    [[nodiscard]] double lineMean(double from, double way, double place) const {
        double sum = 0;
        forImages(from, [&](double at) {
            const double d = place - at, size = std::abs(way);
            // On a short line the mean is that of the middle, but for (way / width)^2 / 24 of it.
            if (size < kernel.shortestLine()) sum += kernel.value((d - 0.5 * way) * (d - 0.5 * way));
            else sum += kernel.lineMean(way > 0 ? d : -d, 0.0, size);
        });
        return sum;
    }

    const GrainState& state;
    const SmoothingKernel& kernel;
    std::size_t axis;
};

void compare(const std::string& coordinates, std::size_t axis, double spacing, KernelShape shape,
             bool isPeriodic, bool inGroups) {
    const GrainState state = someGrains(axis, isPeriodic, !inGroups);
    const FieldGrid grid(coordinates, {0, 0, 0}, {length, length, length}, spacing);
    const SmoothingKernel kernel(shape, 1, width);
    FieldSums sums(grid, kernel, inGroups ? GrainGroups::bySpecies(3) : GrainGroups::none());
    sums.add(state);
    const PointByPoint expected(state, kernel, axis);
    // 5e-15 of an erf on each of the lines, over the shortest of which, 1e-3 of the cut-off, it is a
    // difference. The short lines of this test err by (1e-3 c / w)^2 / 24 = 4e-7 of theirs.
    const double ofLines = inGroups ? 1e-11 : 1e-6;
    const double area = length * length;
    for (std::size_t k = 0; k < grid.size(); k += 1 + grid.size() / 40) {
        const double place = grid.at(axis, k);
        const auto near = [&](std::size_t sum, const PointByPoint::Value& value, double tolerance) {
            EXPECT_NEAR(area * sums.ofAll(sum, k), value.sum, tolerance * value.size)
                << coordinates << " sum " << sum << " at " << place << " spacing " << spacing;
        };
        near(Sum::Mass, expected.ofGrains(place, [&](std::size_t g) { return state.grains[g].mass; }), 1e-13);
        near(Sum::Momentum + 1,
             expected.ofGrains(
                 place, [&](std::size_t g) { return state.grains[g].mass * state.grains[g].velocity.y; }),
             1e-13);
        near(Sum::Contacts,
             expected.ofGrains(place,
                               [&](std::size_t g) {
                                   double touches = 0;
                                   for (const GrainState::Contact& c : state.contacts)
                                       if (c.touching && (c.first == g || c.second == g)) ++touches;
                                   return touches;
                               }),
             1e-13);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                near(Sum::ContactStress + 3 * i + j, expected.stress(i, j, place), ofLines);
        near(Sum::AdhesiveStress + 1, expected.adhesive(place), ofLines);
    }
}

// A few points in reach and many; more points than one share has sums for; all axes and shapes of kernels.
TEST(AxisFields, areSumsPointByPoint) {
    for (const double spacing : {2 * width, width, 0.3 * width, 0.05 * width}) {
        compare("Z", 2, spacing, KernelShape::Gauss, false, false);
        compare("X", 0, spacing, KernelShape::Gauss, false, true);
        compare("Y", 1, spacing, KernelShape::Gauss, true, false);
        compare("Z", 2, spacing, KernelShape::Lucy, true, true);
        compare("Y", 1, spacing, KernelShape::Heaviside, false, true);
    }
}

}  // namespace
}  // namespace pendular::axisFieldsTest
