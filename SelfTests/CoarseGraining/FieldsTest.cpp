// Fields against closed forms and an independent program (five grains, four contacts, a wall).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Foundation/Math/GaussLegendre.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SharedData.h"

namespace pendular::fieldsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using Sum = FieldSums::Sum;
using V = Vector<double>;

constexpr std::uint32_t wall = GrainState::Contact::wall;

/// Five grains of 2500 kg/m^3 on the plane z = 0, with four contacts; the numbers of the reference.
GrainState fiveGrains() {
    GrainState state;
    const auto add = [&](V position, double radius, V velocity) {
        state.grains.push_back(
            {position, velocity, radius, 2500 * 4.0 / 3 * std::numbers::pi * radius * radius * radius});
    };
    add({0, 0, 0.00049}, 0.0005, {0.01, 0, 0});
    add({0.00095, 0.0001, 0.0006}, 0.0005, {0.02, -0.01, 0.005});
    add({0.0004, 0.0008, 0.001}, 0.00045, {0, 0.03, -0.01});
    add({0.0005, 0.0001, 0.00135}, 0.0005, {0.05, 0, 0});
    add({-0.0002, 0.0005, 0.0018}, 0.0004, {0.02, 0.02, -0.03});
    const auto join = [&](std::uint32_t i, std::uint32_t j, V force) {
        state.contacts.push_back({i, j, state.grains[j].position - state.grains[i].position, force});
    };
    join(0, 1, {-0.0002, -3e-05, -4e-05});
    join(0, 3, {-0.0001, 2e-05, -0.0003});
    join(1, 3, {0.00015, 1e-05, -0.00025});
    join(2, 4, {0.0001, 5e-05, -0.00012});
    state.contacts.push_back({0, wall, {0, 0, -0.00049}, {1e-05, -2e-05, 0.0006}});
    return state;
}

/// Fields at one place: a grid of one point, or, where a direction is averaged over, over 2, 2 and 3 mm.
FieldSums fieldsAt(const GrainState& state, KernelShape shape, const std::string& coordinates, V place,
                   double width, double cutOff) {
    const double half = 1e-5;
    V low{-1e-3, -1e-3, -0.5e-3}, high{1e-3, 1e-3, 2.5e-3};
    const auto narrow = [&](char name, double V::*axis) {
        if (coordinates.find(name) == coordinates.npos) return;
        low.*axis = place.*axis - half;
        high.*axis = place.*axis + half;
    };
    narrow('X', &V::x), narrow('Y', &V::y), narrow('Z', &V::z);
    const FieldGrid grid(coordinates, low, high, 2 * half);
    FieldSums sums(grid, SmoothingKernel(shape, grid.dimensions(), width, cutOff));
    sums.add(state);
    return sums;
}

std::string textOf(const std::string& file) {
    std::string text = support::contentOf(support::sharedData(file));
    std::erase(text, '\r');
    return text;
}

TEST(Fields, areThoseOfTheIndependentProgram) {
    const std::string file = "scenes-and-shapes/cg_fields.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    int compared = 0;
    for (const support::Row& row : support::rowsOf(textOf(file))) {
        const auto number = [&](const std::string& name) {
            return row.at(name).empty() ? 0.0 : std::stod(row.at(name));
        };
        const KernelShape shape = kernelShapeNamed(row.at("kernel"));
        const double cutOff = number("cutoff"), width = shape == KernelShape::Gauss ? number("w") : cutOff;
        const FieldSums sums = fieldsAt(fiveGrains(), shape, row.at("coordinates"),
                                        {number("x"), number("y"), number("z")}, width, cutOff);
        ASSERT_EQ(sums.grid().size(), 1u);
        const auto compare = [&](std::size_t sum, const std::string& name, double scale) {
            // The file has about fourteen digits; its numbers of a field share the largest one's last digit.
            EXPECT_NEAR(sums.ofAll(sum, 0), number(name), 2e-11 * scale)
                << name << " of " << row.at("kernel") << " " << row.at("coordinates");
            ++compared;
        };
        compare(Sum::Volume, "volume_fraction", 1);
        compare(Sum::Mass, "density", number("density"));
        const char* axes = "xyz";
        for (std::size_t i = 0; i < 3; ++i) {
            compare(Sum::Momentum + i, fmt::format("p{}", axes[i]), std::abs(number("px")) + 1);
            compare(Sum::Traction + i, fmt::format("t{}", axes[i]), std::abs(number("tz")) + 1);
        }
        std::size_t half = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::string part = fmt::format("_{}{}", axes[i], axes[j]);
                compare(Sum::ContactStress + 3 * i + j, "contact" + part, std::abs(number("contact_zz")));
                if (j < i) continue;
                compare(Sum::Flux + half, "flux" + part, std::abs(number("flux_xx")) + 1);
                compare(Sum::Fabric + half, "fabric" + part, 1);
                ++half;
            }
    }
    EXPECT_GT(compared, 300);
}

// Two of the numbers, for machines without the reference: a Gauss of 0.4 mm cut at 1.2 mm, at z = 0.9 mm.
TEST(Fields, ofFiveGrainsAtOneHeight) {
    const FieldSums sums = fieldsAt(fiveGrains(), KernelShape::Gauss, "Z", {0, 0, 0.9e-3}, 4e-4, 1.2e-3);
    EXPECT_NEAR(sums.ofAll(Sum::Mass, 0), 858.94994027584, 1e-8);
    EXPECT_NEAR(sums.ofAll(Sum::ContactStress + 8, 0), 127.79429517969, 1e-9);
    EXPECT_NEAR(sums.ofAll(Sum::Traction + 2, 0), 11934.59039855, 1e-6);
    EXPECT_NEAR(sums.ofAll(Sum::Fabric, 0), 0.28563547147163, 1e-12);
}

TEST(SmoothingKernel, hasItsNormAndLineMeans) {
    const SmoothingKernel gauss(KernelShape::Gauss, 3, 0.5, 1.5), lucy(KernelShape::Lucy, 1, 1, 1),
        lucy3(KernelShape::Lucy, 3, 1, 1), heaviside(KernelShape::Heaviside, 3, 1, 1);
    EXPECT_NEAR(gauss.value(0.0), 0.523276314632215, 1e-14);
    EXPECT_NEAR(gauss.value(1.44), 0.0293739918185989, 1e-15);
    EXPECT_EQ(gauss.value(2.26), 0);
    EXPECT_NEAR(lucy.value(0.81), 0.00462500000000032, 1e-13);
    EXPECT_NEAR(lucy3.value(0.0625), 1.54220207307552, 1e-13);
    EXPECT_NEAR(heaviside.value(0.25), 0.238732414637843, 1e-14);
    // Lines against quadrature with many nodes, for places within and beyond the cut-off; the integrand of a
    // cut function is not smooth, so that pieces between its ends are taken.
    for (const SmoothingKernel& kernel :
         {gauss, lucy3, heaviside, SmoothingKernel(KernelShape::Gauss, 3, 0.2, 1.5)})
        for (const double along : {-0.7, -0.1, 0.3, 1.0, 2.2})
            for (const double across : {0.0, 1e-9, 0.2, 0.9}) {
                const double length = 0.8, c = kernel.cutOff(), reach2 = c * c - across * across;
                double expected = 0;
                if (reach2 > 0) {
                    const double from = std::max(0.0, along - std::sqrt(reach2)),
                                 to = std::min(length, along + std::sqrt(reach2));
                    // Two pieces: the root in Lucy's function has a corner where the line is nearest.
                    const double middle = std::clamp(along, from, std::max(from, to));
                    for (const auto& [a, b] : {std::pair{from, middle}, std::pair{middle, to}})
                        for (const QuadratureNode& node : gaussLegendre(64)) {
                            if (!(a < b)) continue;
                            const double s = 0.5 * (a + b) + 0.5 * (b - a) * node.position;
                            expected += 0.5 * (b - a) * node.weight / length *
                                        kernel.value((s - along) * (s - along) + across * across);
                        }
                }
                // With 64 nodes the quadrature itself errs most where t is small but not 0 (q has a bend).
                EXPECT_NEAR(kernel.lineMean(along, across * across, length), expected,
                            1e-7 * kernel.value(0.0))
                    << along << " " << across;
            }
}

TEST(SmoothingKernel, lineMeansAreThoseOfTheReference) {
    const std::string file = "scenes-and-shapes/cg_line_integrals.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    int compared = 0;
    for (const support::Row& row : support::rowsOf(textOf(file))) {
        const int dimensions = std::stoi(row.at("dimensions"));
        const KernelShape shape = kernelShapeNamed(row.at("kernel"));
        const double cutOff = std::stod(row.at("cutoff"));
        const SmoothingKernel kernel(shape, dimensions,
                                     shape == KernelShape::Gauss ? std::stod(row.at("w")) : 1, cutOff);
        const auto vector = [&](const std::string& name) {
            std::array<double, 3> v{};
            std::istringstream words(row.at(name));
            for (double& part : v) words >> part;
            return V{v[0], v[1], v[2]};
        };
        const V x = vector("x"), a = vector("a"), b = vector("b"), branch = b - a;
        const double length = norm(branch), expected = std::stod(row.at("integral over s in 0..1"));
        if (length == 0) {
            EXPECT_NEAR(kernel.value(squaredNorm(x - a)), expected, 1e-13);
        } else {
            const V unit = (1 / length) * branch, across = (x - a) - dot(x - a, unit) * unit;
            EXPECT_NEAR(kernel.lineMean(dot(x - a, unit), squaredNorm(across), length), expected, 1e-13);
        }
        ++compared;
    }
    EXPECT_GT(compared, 15);
}

/// The integral of a sum over the grid.
double integral(const FieldSums& sums, std::size_t sum) {
    const FieldGrid& grid = sums.grid();
    const auto& n = grid.counts();
    double total = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        double cell = grid.measure(k / (n[1] * n[2]));
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (grid.isResolved(axis)) cell *= grid.spacing(axis);
        total += sums.ofAll(sum, k) * cell;
    }
    return total;
}

// A Gauss that is cut where it is 2e-16 (8.5 w), at points with distances of 0.7 w: the sum over the points
// is the integral to 1e-15 (the reference: 6e-18 of the aliases).
TEST(Fields, haveTheirIntegralsToRoundOff) {
    const GrainState state = fiveGrains();
    double mass = 0;
    V momentum{0, 0, 0};
    for (const auto& g : state.grains) {
        mass += g.mass;
        momentum += g.mass * g.velocity;
    }
    const double virial[] = {3.675e-07, 6e-08,   -7.96e-08, 5.3e-08,  1.6e-08,
                             -7.12e-08, 3.5e-09, -2e-09,    8.399e-07};
    for (const std::string coordinates : {"O", "X", "Z", "XZ", "XYZ"}) {
        const double w = 2e-4;
        const FieldGrid grid(coordinates, {-3e-3, -3e-3, -2e-3}, {4e-3, 4e-3, 4e-3}, 0.7 * w);
        FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), w, 8.5 * w));
        sums.add(state);
        // 1e6 points of one size each add a rounding of 1e-16 of the whole: 1e-13 with all.
        EXPECT_NEAR(integral(sums, Sum::Mass) / mass, 1, 1e-13) << coordinates;
        EXPECT_NEAR(integral(sums, Sum::Momentum) / momentum.x, 1, 1e-13);
        EXPECT_NEAR(integral(sums, Sum::Number), 5, 5e-13);
        for (std::size_t k = 0; k < 9; ++k)
            EXPECT_NEAR(integral(sums, Sum::ContactStress + k), virial[k], 1e-13 * 8.4e-7) << coordinates;
        EXPECT_NEAR(integral(sums, Sum::Traction + 2), 0.0006, 1e-13 * 0.0006);
    }
}

TEST(Fields, aroundAnAxisHaveTheirIntegrals) {
    const GrainState state = fiveGrains();
    const double w = 2e-4;
    for (const std::string coordinates : {"R", "RZ"}) {
        const FieldGrid grid(coordinates, {-4e-3, -4e-3, -2e-3}, {4e-3, 4e-3, 4e-3}, 0.5 * w);
        FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), w, 8.5 * w));
        sums.add(state);
        EXPECT_NEAR(integral(sums, Sum::Number), 5, 1e-12);
        // What does not turn with the angle has its integral: z parts, and traces.
        EXPECT_NEAR(integral(sums, Sum::ContactStress + 8) / 8.399e-07, 1, 1e-12);
        EXPECT_NEAR((integral(sums, Sum::ContactStress) + integral(sums, Sum::ContactStress + 4)) /
                        (3.675e-07 + 1.6e-08),
                    1, 1e-12);
        EXPECT_NEAR(integral(sums, Sum::Traction + 2), 0.0006, 1e-15);
    }
    // A grain beside the axis that moves around it: its speed is along theta.
    GrainState one;
    one.grains.push_back({{0, 1e-3, 0}, {-0.5, 0, 0}, 1e-4, 1});
    const FieldGrid grid("R", {-3e-3, -3e-3, -1e-3}, {3e-3, 3e-3, 1e-3}, 1e-4);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, 1, w, 8 * w));
    sums.add(one);
    EXPECT_NEAR(integral(sums, Sum::Momentum), 0, 1e-13);
    EXPECT_NEAR(integral(sums, Sum::Momentum + 1), 0.5, 1e-13);
}

/// All sums at a point, of a state.
std::array<double, FieldSums::count> sumsAt(const GrainState& state, const V& place) {
    const FieldSums sums = fieldsAt(state, KernelShape::Gauss, "XYZ", place, 4e-4, 3.4e-3);
    std::array<double, FieldSums::count> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = sums.ofAll(k, 0);
    return all;
}

// Differences over 2e of a field with the length w err by (e / w)^2 / 6 of it, and by round-off w 1e-15 / e:
// 1e-7 with e = 3e-4 w.
TEST(Fields, keepMassAndMomentum) {
    const GrainState state = fiveGrains();
    const double w = 4e-4, e = 3e-4 * w, time = e / 0.05;
    GrainState before = state, after = state;
    for (std::size_t k = 0; k < state.grains.size(); ++k) {
        before.grains[k].position += (-time) * state.grains[k].velocity;
        after.grains[k].position += time * state.grains[k].velocity;
    }
    const V place{3e-4, 2e-4, 7e-4};
    const auto here = sumsAt(state, place);
    const V steps[] = {{e, 0, 0}, {0, e, 0}, {0, 0, e}};
    double divergence = 0;
    V force{0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto up = sumsAt(state, place + steps[axis]), down = sumsAt(state, place - steps[axis]);
        divergence += (up[Sum::Momentum + axis] - down[Sum::Momentum + axis]) / (2 * e);
        // The force on grain i along a is the sum over the contacts of f_a, and sigma_ab has b as its second.
        force.x -= (up[Sum::ContactStress + axis] - down[Sum::ContactStress + axis]) / (2 * e);
        force.y -= (up[Sum::ContactStress + 3 + axis] - down[Sum::ContactStress + 3 + axis]) / (2 * e);
        force.z -= (up[Sum::ContactStress + 6 + axis] - down[Sum::ContactStress + 6 + axis]) / (2 * e);
    }
    const double rate = (sumsAt(after, place)[Sum::Mass] - sumsAt(before, place)[Sum::Mass]) / (2 * time);
    EXPECT_NEAR(rate / -divergence, 1, 2e-6);
    // -div sigma + t = sum of F_i phi_i with the contact forces on grain i.
    force += V{here[Sum::Traction], here[Sum::Traction + 1], here[Sum::Traction + 2]};
    V expected{0, 0, 0};
    const SmoothingKernel kernel(KernelShape::Gauss, 3, w, 3.4e-3);
    for (const auto& c : state.contacts) {
        expected += kernel.value(squaredNorm(place - state.grains[c.first].position)) * c.force;
        if (c.second != wall)
            expected += -kernel.value(squaredNorm(place - state.grains[c.second].position)) * c.force;
    }
    EXPECT_NEAR(norm(force - expected) / norm(expected), 0, 2e-6);
}

// A column of grains at rest: each contact carries what is above. -d sigma_zz / dz + t_z = rho g at every
// height; without the traction it fails where the floor is near (Weinhart et al. 2012).
TEST(Fields, balanceTheWeightOfAColumnAtRest) {
    constexpr double d = 1e-3, mass = 1e-6, g = 9.8, w = 0.7e-3, e = 3e-4 * w;
    constexpr int count = 8;
    GrainState column;
    for (int k = 0; k < count; ++k)
        column.grains.push_back({{0, 0, (k + 0.5) * d}, {0, 0, 0}, 0.5 * d, mass});
    column.contacts.push_back({0, wall, {0, 0, -0.5 * d}, {0, 0, count * mass * g}});
    for (std::uint32_t k = 0; k + 1 < count; ++k)
        column.contacts.push_back({k, k + 1, {0, 0, d}, {0, 0, -(count - 1.0 - k) * mass * g}});
    const auto at = [&](double z) {
        return fieldsAt(column, KernelShape::Gauss, "Z", {0, 0, z}, w, 8.5 * w);
    };
    const double weight = mass * g / (d * 4e-6);  // N/m^3, for scale
    for (const double z : {-0.3e-3, 0.0, 0.2e-3, 0.9e-3, 4e-3, 7.9e-3, 8.5e-3}) {
        const double slope =
            (at(z + e).ofAll(Sum::ContactStress + 8, 0) - at(z - e).ofAll(Sum::ContactStress + 8, 0)) /
            (2 * e);
        const FieldSums here = at(z);
        const double traction = here.ofAll(Sum::Traction + 2, 0);
        EXPECT_NEAR((-slope + traction - here.ofAll(Sum::Mass, 0) * g) / weight, 0, 1e-5) << z;
        if (std::abs(z) < 0.5e-3) {
            EXPECT_GT(traction / weight, 1);
        }
    }
}

// Rows of grains with v_x = rate z and no fluctuations: the width makes a kinetic stress of rho (rate w)^2.
TEST(Fields, takeShearForFluctuationsByTheirWidth) {
    constexpr double w = 1e-3, rate = 7;
    GrainState rows;
    for (int k = -40; k <= 40; ++k)
        rows.grains.push_back({{0, 0, 0.5 * w * k}, {rate * 0.5 * w * k, 0, 0}, 1e-4, 1e-6});
    const FieldSums sums = fieldsAt(rows, KernelShape::Gauss, "Z", {0, 0, 0.13e-3}, w, 8.5 * w);
    const double density = sums.ofAll(Sum::Mass, 0), momentum = sums.ofAll(Sum::Momentum, 0);
    EXPECT_NEAR(momentum / density, rate * 0.13e-3, 1e-14);
    EXPECT_NEAR((sums.ofAll(Sum::Flux, 0) - momentum * momentum / density) / (density * rate * rate * w * w),
                1, 1e-12);
}

/// Moves a state across the faces of a periodic box.
GrainState moved(GrainState state, const V& by, const PeriodicBox& box) {
    state.periodic = box;
    for (auto& g : state.grains) g.position = box.wrap(g.position + by);
    return state;
}

TEST(Fields, doNotKnowWhereAPeriodBegins) {
    const PeriodicBox box{{-1.5e-3, -1.5e-3, 0}, {3e-3, 3e-3, 0}};
    GrainState inside = fiveGrains();
    inside.periodic = box;
    const GrainState across = moved(inside, {1.4e-3, -1.2e-3, 0}, box);
    for (const std::string coordinates : {"O", "Y", "Z", "XZ", "XYZ"}) {
        const FieldGrid grid(coordinates, {-1.5e-3, -1.5e-3, -1e-3}, {1.5e-3, 1.5e-3, 3e-3}, 2e-4);
        // Cut where it is nothing: at a cut that a point meets up to round-off, either side is right.
        const SmoothingKernel kernel(KernelShape::Gauss, grid.dimensions(), 3e-4, 8.5 * 3e-4);
        FieldSums one(grid, kernel), other(grid, kernel);
        one.add(inside), other.add(across);
        // 1.4 mm are 7 points; -1.2 mm are 6.
        const auto& n = grid.counts();
        for (std::size_t k = 0; k < grid.size(); ++k) {
            const std::size_t x = k / (n[1] * n[2]), y = k / n[2] % n[1], z = k % n[2];
            const std::size_t to = ((x + 7) % n[0] * n[1] + (y + n[1] - 6 % n[1]) % n[1]) * n[2] + z;
            for (const std::size_t sum :
                 {std::size_t{Sum::Mass}, std::size_t{Sum::ContactStress + 8},
                  std::size_t{Sum::ContactStress + 1}, std::size_t{Sum::Traction + 2}})
                EXPECT_NEAR(one.ofAll(sum, k), other.ofAll(sum, to),
                            1e-11 * std::abs(one.ofAll(sum, k)) + 1e-9)
                    << coordinates << " " << sum;
        }
    }
}

TEST(Fields, areTheSameForAnyNumberOfThreads) {
    const GrainState state = fiveGrains();
    for (const std::string coordinates : {"O", "Z", "XZ", "XYZ", "RZ"}) {
        const FieldGrid grid(coordinates, {-2e-3, -2e-3, -1e-3}, {2e-3, 2e-3, 3e-3}, 1e-4);
        const SmoothingKernel kernel(KernelShape::Gauss, grid.dimensions(), 3e-4);
        FieldSums one(grid, kernel);
        one.add(state);
        for (const int threads : {2, 3, 8}) {
            FieldSums more(grid, kernel);
            more.add(state, threads);
            EXPECT_EQ(one.numbers(), more.numbers());
        }
    }
}

// Groups sum up to all of them, and each keeps its own momentum: what contacts of two groups give to one goes
// to the other.
TEST(Fields, ofGroupsAreTheWhole) {
    GrainState state = fiveGrains();
    state.grains[2].species = state.grains[3].species = 1;
    const FieldGrid grid("Z", {-3e-3, -3e-3, -2e-3}, {4e-3, 4e-3, 4e-3}, 1e-4);
    const SmoothingKernel kernel(KernelShape::Gauss, 1, 3e-4);
    FieldSums all(grid, kernel), bySpecies(grid, kernel, GrainGroups::bySpecies(2)),
        bySize(grid, kernel, GrainGroups::bySize({0.85e-3, 0.95e-3}));
    all.add(state), bySpecies.add(state), bySize.add(state);
    ASSERT_EQ(bySize.groups().size(), 3u);
    for (std::size_t k = 0; k < grid.size(); ++k)
        for (std::size_t sum = 0; sum < FieldSums::count; ++sum) {
            const double scale = 1e-12 * std::abs(all.ofAll(sum, k)) + 1e-13;
            EXPECT_NEAR(all.ofAll(sum, k), bySpecies.ofAll(sum, k), scale) << sum;
            EXPECT_NEAR(all.ofAll(sum, k), bySize.ofAll(sum, k), scale) << sum;
        }
    EXPECT_GT(bySpecies.of(Sum::Mass, 1, grid.size() / 2), 0);
}

TEST(Fields, averageSumsOverTime) {
    GrainState one;
    one.grains.push_back({{0, 0, 0}, {1, 0, 0}, 1e-3, 2});
    GrainState other = one;
    other.grains[0].velocity = {3, 0, 0};
    FieldSums sums(FieldGrid("O", {-1, -1, -1}, {1, 1, 1}, 1), SmoothingKernel(KernelShape::Gauss, 0, 0.1));
    sums.add(one), sums.add(other);
    EXPECT_EQ(sums.states(), 2u);
    EXPECT_DOUBLE_EQ(sums.ofAll(Sum::Mass, 0), 2.0 / 8);
    EXPECT_DOUBLE_EQ(sums.ofAll(Sum::Momentum, 0), 4.0 / 8);
    EXPECT_DOUBLE_EQ(sums.ofAll(Sum::Flux, 0), 10.0 / 8);
}

// A sum that was left out has no number.
TEST(Fields, ofContactsThatWereLeftOutAreRefused) {
    const FieldGrid all("O", {-1, -1, -1}, {1, 1, 1}, 1);
    const SmoothingKernel kernel(KernelShape::Gauss, 0, 0.1);
    FieldSums sums(all, kernel, GrainGroups::none(), FieldContent::WithoutContacts);
    sums.add(fiveGrains());
    EXPECT_GT(sums.ofAll(Sum::Mass, 0), 0);
    for (const std::size_t sum : {Sum::Fabric, Sum::ContactStress, Sum::Traction, Sum::count}) {
        const std::string sentence = refusal([&] { static_cast<void>(sums.of(sum, 0, 0)); });
        EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "WithoutContacts")) << sentence;
        EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(sums.ofAll(sum, 0)); })));
    }
    const FieldSums whole(all, kernel);
    EXPECT_EQ(whole.of(Sum::Traction + 2, 0, 0), 0);
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(whole.of(Sum::count, 0, 0)); })));
}

TEST(Fields, refuseInOneSentence) {
    const V low{0, 0, 0}, high{1, 1, 1};
    const double nan = std::nan("");
    const auto kernel = [](double w, double c) { SmoothingKernel(KernelShape::Gauss, 1, w, c); };
    const std::pair<std::string, std::string> cases[] = {
        {refusal([&] { FieldGrid("ZX", low, high, 1); }), "There are no coordinates \"ZX\""},
        {refusal([&] { FieldGrid("", low, high, 1); }), "There are no coordinates"},
        {refusal([&] { FieldGrid("X", high, low, 1); }), "highest x"},
        {refusal([&] {
             FieldGrid("X", {nan, 0, 0}, high, 1);
         }),
         "lowest x"},
        {refusal([&] {
             FieldGrid("X", low, {1, 1, infinity}, 1);
         }),
         "highest z"},
        {refusal([&] { FieldGrid("X", low, high, nan); }), "spacing"},
        {refusal([&] { FieldGrid("X", low, high, 0); }), "spacing"},
        {refusal([&] { FieldGrid("XYZ", low, high, 1e-4); }), "points or more"},
        {refusal([&] { kernel(nan, 0); }), "width"},
        {refusal([&] { kernel(0, 0); }), "width"},
        {refusal([&] { kernel(1, nan); }), "cut-off"},
        {refusal([&] { kernel(1, 0.5); }), "cut-off"},
        {refusal([&] { kernelShapeNamed("box"); }), "\"box\""},
        {refusal([&] {
             GrainGroups::bySize({2e-3, 1e-3});
         }),
         "between two groups"},
        {refusal([&] { GrainGroups::bySize({nan}); }), "between two groups"},
        {refusal([&] { FieldSums(FieldGrid("X", low, high, 1), SmoothingKernel(KernelShape::Lucy, 2, 1)); }),
         "the kernel has 2 dimensions"}};
    for (const auto& [text, part] : cases) {
        EXPECT_TRUE(isOneSentence(text)) << part;
        EXPECT_TRUE(contains(text, part));
    }
}

}  // namespace
}  // namespace pendular::fieldsTest
