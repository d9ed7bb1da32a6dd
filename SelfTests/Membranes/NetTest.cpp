// The mechanics of membranes as functions of where their vertices are. Numbers of Hencky's disc, of nets that
// are pulled and of nets that are bent come from a program of its own in another language, with closed forms
// beside it (tables membrane_uniaxial, _biaxial, _bending_net, _disc).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "Kernel/Features/Membranes/MembraneNet.h"
#include "Kernel/Foundation/State/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::netTest {
namespace {

using Point = Vector<double>;
using Points = std::vector<Point>;
using support::contains;
using support::refusal;

constexpr MembraneMaterial rubber{.youngsModulus = 2e6, .thickness = 3e-4, .density = 1000};
constexpr double pull = rubber.youngsModulus * rubber.thickness;  // N/m, E t

template <class Function>
Points moved(const Points& points, Function&& to) {
    Points result;
    for (const Point& p : points) result.push_back(to(p));
    return result;
}

double area(const MembraneNet& net, const Points& at) {
    double sum = 0;
    for (const auto& [a, b, c] : net.triangles()) sum += 0.5 * norm(cross(at[b] - at[a], at[c] - at[a]));
    return sum;
}

std::vector<Triangle> equilateral(std::vector<Triangle> sheet) {
    const double whole = 0.25 * std::sqrt(3.0) * 1e-6;  // m^2
    std::erase_if(sheet, [&](const Triangle& t) {
        return std::abs(0.5 * norm(cross(t[1] - t[0], t[2] - t[0])) - whole) > 1e-9 * whole;
    });
    return sheet;
}

/// A sheet that is strained along x and y: since each triangle has its own share of its springs, its energy
/// over its area is that of an infinite net.
struct StrainedNet {
    MembraneNet net{equilateral(membraneSheet(4, 4, 1e-3)), rubber};
    double sheet = area(net, net.vertices());

    [[nodiscard]] double energy(double alongX, double alongY) const {  // N/m
        return net.stretchingEnergy(moved(net.vertices(), [&](const Point& p) {
            return Point{(1 + alongX) * p.x, (1 + alongY) * p.y, 0};
        })) / sheet;
    }
    /// N/m, a central difference: its error is 1e-16 energy / h + h^2 N / 6 / strain^2, below 1e-9 of N.
    [[nodiscard]] double tensionX(double x, double y) const {
        const double h = 1e-5;
        return (energy(x + h, y) - energy(x - h, y)) / (2 * h);
    }
    [[nodiscard]] double tensionY(double x, double y) const {
        const double h = 1e-5;
        return (energy(x, y + h) - energy(x, y - h)) / (2 * h);
    }
};

/// Pulled along one of its springs a net has N = E t strain at any strain (linear springs), and Poisson's
/// ratio grows from 1/3: table membrane_uniaxial.
TEST(MembraneNet, pulledInOneDirectionIsTheSheetOfTheTable) {
    const StrainedNet pulled;
    for (const auto& [strain, poisson] : {std::pair{0.001, 0.333555629679},
                                          {0.01, 0.335563012677},
                                          {0.05, 0.344636016259},
                                          {0.1, 0.356349239007},
                                          {0.2, 0.381197846483},
                                          {-0.01, 0.331118469463}}) {
        double low = -0.5 * std::abs(strain), high = 0.5 * std::abs(strain);  // of the strain across
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            (pulled.tensionY(strain, middle) > 0 ? high : low) = middle;
        }
        // Tensions are differences of energies over 2e-5: round-off of 1e-16 E t strain^2 over that.
        EXPECT_NEAR(-low / strain, poisson, 1e-7) << strain;
        EXPECT_NEAR(pulled.tensionX(strain, low) / (pull * strain), 1, 1e-7) << strain;
    }
}

/// Pulled in both: N = sqrt(3) k strain over the length without force, k = (sqrt(3) / 2) E t: table
/// membrane_biaxial.
TEST(MembraneNet, pulledInAllDirectionsIsTheSheetOfTheTable) {
    const StrainedNet pulled;
    const double k = 0.5 * std::sqrt(3.0) * pull;
    for (const auto& [strain, tension] :
         {std::pair{0.001, 0.00173205080757}, {0.01, 0.0173205080757}, {0.5, 0.866025403784}})
        EXPECT_NEAR(pulled.tensionX(strain, strain) / k, tension, 1e-9) << strain;
}

TEST(MembraneNet, shearsAsASheet) {
    const StrainedNet sheared;
    const double gamma = 1e-3;
    const Points at = moved(sheared.net.vertices(), [&](const Point& p) {
        return Point{p.x + gamma * p.y, p.y, 0};
    });
    const double shear = 2 * sheared.net.stretchingEnergy(at) / sheared.sheet / (gamma * gamma);
    // sqrt(3)/4 k = (3/8) E t = E t / (2 (1 + 1/3)); the next term is gamma^2.
    EXPECT_NEAR(shear / (0.375 * pull), 1, 3 * gamma * gamma);
}

TEST(MembraneNet, springsAtFreeEdgesAreHalfAndMassesAreAThirdOfTheTriangles) {
    const MembraneNet net(membraneSheet(4, 4, 1e-3), rubber);
    const double k = 0.5 * std::sqrt(3.0) * pull;
    int whole = 0, half = 0;
    for (const auto& spring : net.springs()) {
        const bool free = net.rim()[spring.ends[0]] && net.rim()[spring.ends[1]];
        const double y0 = net.vertices()[spring.ends[0]].y, y1 = net.vertices()[spring.ends[1]].y;
        if (free && y0 == y1 && (y0 == 0 || y0 > 3.4e-3))
            half += std::abs(spring.stiffness - 0.5 * k) < 1e-12 * k ? 1 : 0;
        if (!net.rim()[spring.ends[0]] && !net.rim()[spring.ends[1]])
            whole += std::abs(spring.stiffness - k) < 1e-12 * k ? 1 : -100;
    }
    EXPECT_EQ(half, 8);
    EXPECT_GT(whole, 8);
    double mass = 0;
    for (const double m : net.masses()) mass += m;
    const double sheet = 4e-3 * 4 * 0.5 * std::sqrt(3.0) * 1e-3 * rubber.thickness * rubber.density;
    EXPECT_NEAR(mass, sheet, 1e-13 * sheet);
}

/// 2 x energy per area x R^2 / k of the hinges, of a surface of radius R = 1000 edges: table
/// membrane_bending_net. Each vertex has a hinge of each of three directions, on an area of (sqrt(3) / 2)
/// edge^2.
double bendingOf(const std::function<double(double, double)>& height, bool across) {
    const double edge = 1, radius = 1000;
    std::vector<Triangle> sheet = membraneSheet(6, 6, edge);
    if (across)
        for (Triangle& triangle : sheet)
            for (Point& p : triangle) p = {-p.y, p.x, 0};
    const MembraneNet net(sheet, {.youngsModulus = 1, .thickness = 1, .density = 1});
    const double d = 1.0 / (12 * (1 - 1.0 / 9)), k = 2 / std::sqrt(3.0) * d;
    const Points at = moved(net.vertices(), [&](const Point& p) {
        return Point{p.x, p.y, height(p.x, p.y) / (2 * radius)};
    });
    std::array<double, 3> energies{};
    for (const auto& hinge : net.hinges()) {
        const auto corner = [&](int c) { return at[hinge.corners[static_cast<std::size_t>(c)]]; };
        const Point along = net.vertices()[hinge.corners[1]] - net.vertices()[hinge.corners[0]];
        if (std::abs(norm(along) - edge) > 1e-9) continue;  // of a half triangle at the side
        if (std::abs(hinge.stiffness / k - 1) > 1e-9) continue;
        const double angle = hingeAngle({corner(0), corner(1), corner(2), corner(3)}).angle;
        double direction = std::atan2(along.y, along.x);
        if (direction < -1e-9) direction += std::numbers::pi;
        const auto third = static_cast<std::size_t>(std::lround(direction / (std::numbers::pi / 6))) % 6;
        energies.at(third / 2) = 0.5 * hinge.stiffness * angle * angle;
    }
    return 2 * (energies[0] + energies[1] + energies[2]) / (0.5 * std::sqrt(3.0) * edge * edge) * radius *
           radius / k;
}

TEST(MembraneNet, bendsAsTheNetOfTheTable) {
    const auto cylinder = [](double x, double) { return x * x; };
    const auto sphere = [](double x, double y) { return x * x + y * y; };
    // Slopes of 6/1000 change lengths by 2e-5 of them.
    for (const bool across : {false, true}) {
        EXPECT_NEAR(bendingOf(cylinder, across), 0.866025, 1e-4) << across;
        EXPECT_NEAR(bendingOf(sphere, across), 1.154700, 1e-4) << across;
    }
}

/// A closed net that is not regular: two tubes' ends are closed by fans.
MembraneNet closedNet() {
    std::vector<Triangle> triangles = membraneTube(1, 2, 9);
    const MembraneNet open(triangles, rubber);
    const std::size_t count = triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
        const auto c = triangles[t];  // a copy: the list grows
        for (std::size_t k = 0; k < 3; ++k) {
            const Point a = c[k], b = c[(k + 1) % 3];
            if (a.z != b.z || (a.z > 1e-9 && a.z < 2 - 1e-9)) continue;
            if (a.z > 1) triangles.push_back({b, a, {0.1, 0, 2.5}});
            else triangles.push_back({b, a, {0, 0.1, -0.5}});
        }
    }
    return {triangles, rubber};
}

Points shaken(const MembraneNet& net, double by) {
    UniformRandom random(7);
    return moved(net.vertices(), [&](const Point& p) {
        return p + Point{random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by)};
    });
}

TEST(MembraneNet, pressureInAClosedNetHasNoForceAndNoTorqueAndWorksAsPTimesDV) {
    const MembraneNet net = closedNet();
    ASSERT_TRUE(net.isClosed());
    const Points at = shaken(net, 0.05);
    constexpr double pressure = 300;
    Points forces(at.size(), {0, 0, 0});
    net.addPressureForces(at, pressure, forces);
    Point force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (std::size_t v = 0; v < at.size(); ++v) {
        force += forces[v];
        torque += cross(at[v], forces[v]);
        size += norm(forces[v]);
    }
    EXPECT_LT(norm(force), 1e-14 * size);  // sums of some hundred numbers of this size
    EXPECT_LT(norm(torque), 1e-14 * size * net.diagonal());
    // The volume is a cubic function of a shift d: V(d) - V(-d) = 2 dV + 2 x its cubic term, of (d / size)^3.
    Points there = at, back = at;
    double work = 0;
    UniformRandom random(8);
    for (std::size_t v = 0; v < at.size(); ++v) {
        const Point d{random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4)};
        there[v] += d, back[v] -= d;
        work += dot(forces[v], d);
    }
    const double change = 0.5 * (net.volume(there) - net.volume(back));
    EXPECT_NEAR(work, pressure * change, 1e-9 * pressure * 1e-4 * area(net, at));
}

/// Forces are the gradient of the energy; they move and turn nothing as a whole.
TEST(MembraneNet, elasticForcesAreTheGradientOfTheEnergy) {
    // The sheet is as thick as an edge, so that hinges count as springs do.
    MembraneMaterial thick = rubber;
    thick.thickness = 0.5;
    const MembraneNet net(
        [] {
            std::vector<Triangle> triangles = membraneTube(1, 2, 9);
            return triangles;
        }(),
        thick);
    const Points at = shaken(net, 0.1);
    Points forces(at.size(), {0, 0, 0});
    net.addElasticForces(at, forces);
    Point force{0, 0, 0}, torque{0, 0, 0};
    double size = 0;
    for (std::size_t v = 0; v < at.size(); ++v) {
        force += forces[v], torque += cross(at[v], forces[v]);
        size += norm(forces[v]);
    }
    EXPECT_LT(norm(force), 1e-13 * size);
    EXPECT_LT(norm(torque), 1e-13 * size * net.diagonal());
    const auto energy = [&](const Points& p) { return net.stretchingEnergy(p) + net.bendingEnergy(p); };
    EXPECT_GT(net.bendingEnergy(at), 0.05 * net.stretchingEnergy(at));
    UniformRandom random(9);
    for (int k = 0; k < 20; ++k) {
        const auto v = static_cast<std::size_t>(random.uniform(0, static_cast<double>(at.size())));
        const Point d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        constexpr double h = 1e-5;  // error h^2 of the third derivative; round-off 1e-16 energy / h
        Points there = at, back = at;
        there[v] += h * d, back[v] -= h * d;
        EXPECT_NEAR((energy(back) - energy(there)) / (2 * h), dot(forces[v], d), 1e-7 * size);
    }
}

/// The frequencies of a whole net are below the bound: by power iteration of forces on small shifts.
TEST(MembraneNet, noFrequencyIsAboveTheBound) {
    for (const double thickness : {1e-4, 1e-3, 4e-3}) {
        MembraneMaterial material = rubber;
        material.thickness = thickness;
        const MembraneNet net(membraneSheet(8, 8, 1e-3), material);
        const std::size_t n = net.vertices().size();
        UniformRandom random(3);
        Points shift(n);
        for (Point& s : shift) s = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        double squared = 0;
        for (int k = 0; k < 400; ++k) {
            double size = 0;
            for (std::size_t v = 0; v < n; ++v) size += net.masses()[v] * squaredNorm(shift[v]);
            Points at = net.vertices();
            for (std::size_t v = 0; v < n; ++v)
                shift[v] = std::sqrt(net.masses()[0] / size) * shift[v], at[v] += 1e-9 * shift[v];
            Points forces(n, {0, 0, 0});
            net.addElasticForces(at, forces);
            double work = 0;
            for (std::size_t v = 0; v < n; ++v) {
                work -= 1e9 * dot(forces[v], shift[v]);
                shift[v] = (-1e9 / net.masses()[v]) * forces[v];
            }
            squared = work / net.masses()[0];
        }
        EXPECT_LT(squared, net.squaredFrequency()) << thickness;
        EXPECT_GT(squared, 0.5 * net.squaredFrequency()) << thickness;
    }
    const MembraneNet sheet(membraneSheet(8, 8, 1e-3), rubber);
    const double springs = 6 * rubber.youngsModulus / rubber.density / 1e-6;  // 6 k / m, edges of 1 mm
    const MembraneNet alike(equilateral(membraneSheet(8, 8, 1e-3)), rubber);
    EXPECT_NEAR(alike.squaredFrequency(alike.rim()) / springs, 1, 1e-9);
    EXPECT_GT(sheet.squaredFrequency(), springs);  // the half triangles at its sides are light
}

/// Brings a net to rest with some vertices held (Bitzek et al. (2006), Phys. Rev. Lett. 97, 170201).
/// @param follows the pressure: it acts along the normals as they are, and not as they were
Points atRest(const MembraneNet& net, double pressure, const std::vector<bool>& held, bool follows) {
    const std::size_t n = net.vertices().size();
    Points at = net.vertices(), velocity(n, {0, 0, 0});
    const double largest = 1 / std::sqrt(net.squaredFrequency());
    double step = 0.2 * largest, mixing = 0.1;
    int downhill = 0;
    for (int k = 0; k < 200000; ++k) {
        Points forces(n, {0, 0, 0});
        net.addElasticForces(at, forces);
        net.addPressureForces(follows ? at : net.vertices(), pressure, forces);
        double power = 0, speed = 0, size = 0;
        for (std::size_t v = 0; v < n; ++v) {
            if (held[v]) forces[v] = {0, 0, 0};
            forces[v] = (1 / net.masses()[v]) * forces[v];
            power += dot(forces[v], velocity[v]);
            speed += squaredNorm(velocity[v]), size += squaredNorm(forces[v]);
        }
        if (std::sqrt(size) < 1e-9 * pressure / net.masses()[0]) break;
        if (power <= 0) {
            downhill = 0, step *= 0.5, mixing = 0.1;
            for (Point& v : velocity) v = {0, 0, 0};
        } else {
            for (std::size_t v = 0; v < n; ++v)
                velocity[v] = (1 - mixing) * velocity[v] + (mixing * std::sqrt(speed / size)) * forces[v];
            if (++downhill > 5) step = std::min(1.1 * step, largest), mixing *= 0.99;
        }
        for (std::size_t v = 0; v < n; ++v) {
            velocity[v] += step * forces[v];
            at[v] += step * velocity[v];
        }
    }
    return at;
}

/// A disc of concentric rings, the i-th of 6 i vertices.
std::vector<Triangle> disc(int rings) {
    const auto at = [&](int ring, int k) {
        const double angle = ring == 0 ? 0 : 2 * std::numbers::pi * k / (6 * ring), r = double(ring) / rings;
        return Point{r * std::cos(angle), r * std::sin(angle), 0};
    };
    std::vector<Triangle> triangles;
    for (int ring = 1; ring <= rings; ++ring)
        for (int sector = 0; sector < 6; ++sector)
            for (int k = 0; k < ring; ++k) {
                const int outer = sector * ring + k, inner = sector * (ring - 1) + k;
                triangles.push_back({at(ring - 1, inner % std::max(1, 6 * (ring - 1))), at(ring, outer),
                                     at(ring, (outer + 1) % (6 * ring))});
                if (k + 1 < ring)
                    triangles.push_back({at(ring - 1, inner), at(ring, (outer + 1) % (6 * ring)),
                                         at(ring - 1, (inner + 1) % (6 * (ring - 1)))});
            }
    return triangles;
}

/// Hencky's disc, held at its rim, under a pressure on its first area along its first normal: the height of a
/// net of six rings (table membrane_disc), within 0.7 % of the continuum, 0.64477642 (q a / E t)^(1/3) for
/// Poisson's ratio 1/3.
TEST(MembraneNet, discUnderPressureIsThatOfTheTable) {
    // The sheet is so thin that hinges do not count: D / (E t a^2) = 1e-13.
    const MembraneNet net(disc(6), {.youngsModulus = 1e6, .thickness = 1e-6, .density = 1e6});
    for (const auto& [pressure, height] : {std::pair{1e-4, 0.029740}, {1e-2, 0.138693}}) {
        const Points at = atRest(net, pressure, net.rim(), false);
        double highest = 0;
        for (const Point& p : at) highest = std::max(highest, p.z);
        EXPECT_NEAR(highest, height, 1e-6) << pressure;  // the digits of the table
        EXPECT_NEAR(highest / (0.64477642 * std::cbrt(pressure)), 1, 0.007) << pressure;
    }
}

/// A balloon: N = p R / 2, and with N = sqrt(3) k strain a growth of p R (1 - nu) / (2 E t).
TEST(MembraneNet, balloonGrowsAsASphere) {
    const double g = 0.5 * (1 + std::sqrt(5.0));  // an icosahedron, divided
    std::vector<Point> corners;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-g, g}) corners.insert(corners.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
    for (Point& corner : corners) corner *= 1 / norm(corner);
    const double side = 2 / std::sqrt(1 + g * g) * 1.001;
    std::vector<Triangle> sphere;
    for (const Point& a : corners)
        for (const Point& b : corners)
            for (const Point& c : corners)
                if (std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z) &&
                    std::tuple(a.x, a.y, a.z) < std::tuple(c.x, c.y, c.z) && norm(a - b) < side &&
                    norm(b - c) < side && norm(c - a) < side && dot(cross(b - a, c - a), a) > 0.1)
                    sphere.push_back({a, b, c});
    ASSERT_EQ(sphere.size(), 20U);
    for (int level = 0; level < 3; ++level) {
        std::vector<Triangle> finer;
        for (const Triangle& t : sphere) {
            std::array<Point, 3> m;
            for (std::size_t k = 0; k < 3; ++k) {
                const Point sum = t[k] + t[(k + 1) % 3];
                m[k] = (1 / norm(sum)) * sum;
            }
            finer.insert(
                finer.end(),
                {{{t[0], m[0], m[2]}}, {{m[0], t[1], m[1]}}, {{m[2], m[1], t[2]}}, {{m[0], m[1], m[2]}}});
        }
        sphere = std::move(finer);
    }
    const MembraneNet net(sphere, {.youngsModulus = 1e6, .thickness = 1e-6, .density = 1e6});
    ASSERT_TRUE(net.isClosed());
    constexpr double pressure = 1e-3;
    const Points at = atRest(net, pressure, std::vector<bool>(net.vertices().size(), false), true);
    const double grown = std::cbrt(net.volume(at) / net.volume(net.vertices())) - 1;
    // Triangles that are not equilateral: 1 % as of the discs.
    EXPECT_NEAR(grown / (pressure * (1 - 1.0 / 3) / 2), 1, 0.02);
}

TEST(MembraneNet, refusesWhatIsNoSheet) {
    const auto net = [](const std::vector<Triangle>& triangles, const MembraneMaterial& material = rubber) {
        return [=] { MembraneNet made(triangles, material); };
    };
    const Point o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    EXPECT_TRUE(contains(refusal(net({})), "there are no triangles"));
    EXPECT_TRUE(contains(refusal(net({{{o, x, 2 * x}}})), "triangle 0 (counted from 0) has no area"));
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}, {{x, o, z}}, {{x, o, -y}}})), "share an edge"));
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}, {{o, x, -y}}})), "run in opposite senses"));
    EXPECT_TRUE(contains(refusal(net({{{x, x, x}}})), "its size = 0 m"));
    const Point overY{0, 1, 0.1};  // 6 degrees above the first one
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}, {{x, o, overY}}})), "is folded onto a neighbour"));
    MembraneMaterial wrong = rubber;
    wrong.poissonsRatio = 0.5;
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}}, wrong)), "Poisson's ratio = 0.5"));
    wrong = rubber;
    wrong.thickness = -1;
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}}, wrong)), "thickness"));
    wrong.thickness = std::nan("");
    EXPECT_TRUE(contains(refusal(net({{{o, x, y}}}, wrong)), "thickness"));
}

TEST(MembraneNet, findsTrianglesThatCollapseOrTouch) {
    const MembraneNet net(membraneSheet(2, 2, 1), rubber);
    Points at = net.vertices();
    EXPECT_EQ(net.collapsed(at), -1);
    for (Point& p : at) p.y *= 0.005;
    EXPECT_EQ(net.collapsed(at), 0);
    at = net.vertices();
    for (Point& p : at)
        if (p.y > 1) p = {p.x, 2 * 0.866025403784 - p.y + 1e-3, 0.05};  // the upper row, onto the lower one
    EXPECT_GE(net.collapsed(at), 0);
    at = net.vertices();
    at[3].x = std::nan("");
    EXPECT_GE(net.collapsed(at), 0);
}

}  // namespace
}  // namespace pendular::netTest
