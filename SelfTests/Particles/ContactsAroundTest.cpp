#include "Kernel/Features/RigidBodies/ContactsAround.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

// By how much contacts move rigid bodies, against closed forms: sums over spheres that touch.

namespace pendular::contactsAroundTest {
namespace {

/// Numbers are rounded upwards to ten binary digits, at most one part of 512.
void expectRoundedUp(double found, double exact) {
    EXPECT_GE(found, exact * (1 - 1e-8));
    EXPECT_LE(found, exact * (1 + 1.0 / 512));
}

/// Spheres of mass 1 and radius r in a row along z at a distance, as if they did not overlap.
struct Row {
    std::vector<SphereOfBody> spheres;
    Vector<double> moments{0, 0, 0};
    double arms = 0;  // sum of squared arms

    Row(int count, double distance, double r = 1) {
        for (int k = 0; k < count; ++k) {
            const double z = distance * (k - 0.5 * (count - 1));
            spheres.push_back({{0, 0, z}, r});
            arms += z * z;
        }
        moments = {arms + count * 0.4 * r * r, arms + count * 0.4 * r * r, count * 0.4 * r * r};
    }
    [[nodiscard]] double mass() const { return static_cast<double>(spheres.size()); }
    [[nodiscard]] ContactsAround contacts() const { return contactsAround(spheres, mass(), moments); }
};

TEST(ContactsAround, ofASphereAreThoseOfASphere) {
    const ContactsAround one = Row(1, 0).contacts();
    expectRoundedUp(one.normal, 1);
    expectRoundedUp(one.sliding, 2.5);
    expectRoundedUp(one.spin, 2.5);
    expectRoundedUp(one.turning, 2.5);
    expectRoundedUp(one.wallNormal, 1);
    expectRoundedUp(one.wallSliding, 3.5);  // shift and spin of one contact: 1 + 5/2
}

// Of touching spheres all surfaces are exposed. Normal springs shift the row as n spheres, and turn it with
// the sum of squared arms M / I; friction turns it about its axis as n spheres, and about others with M
// sum(a^2
// + r^2) / I. A plane touches all of a row that lies on it.
TEST(ContactsAround, ofARowAreSumsOverItsSpheres) {
    for (const int count : {2, 3, 8}) {
        const Row row(count, 2);
        const ContactsAround found = row.contacts();
        const double n = count, turned = n * row.arms / row.moments.x;
        expectRoundedUp(found.normal, std::max(n, turned));
        const double spin = std::max(2.5 * n, n * (row.arms + n) / row.moments.x);
        expectRoundedUp(found.spin, spin);
        expectRoundedUp(found.sliding, std::max(n, spin));
        expectRoundedUp(found.wallNormal, std::max(n, turned));
        EXPECT_EQ(found.mean, 1);
        EXPECT_EQ(found.finer, 1);
    }
}

// Two of three fused spheres have 3/4 of a surface, the third one half: with r between their centres, the
// caps that are cut off have heights of r/2. What is left of the squares of cosines across the axis is, with
// t = 1/2, the integral of 12 (1 - x^2) / 2 from -1 to t and from -t to t, over the 8 of a whole sphere.
TEST(ContactsAround, ofFusedSpheresAreThoseOfTheirSurface) {
    const ContactsAround found = Row(3, 1).contacts();
    const auto part = [](double from, double to) {
        const auto integral = [](double x) { return x - x * x * x / 3; };
        return 0.75 * (integral(to) - integral(from));
    };
    const double shift = 2 * part(-1, 0.5) + part(-0.5, 0.5);
    EXPECT_LT(shift, 2.6);
    // In the grooves, a twentieth of the surface, a grain touches two.
    EXPECT_NEAR(found.normal, 1.05 * shift, 0.03 * shift);
    EXPECT_EQ(found.most, 2);
}

// Where spheres are dense, a grain of their size that overlaps one by 5 % of r touches all whose centres are
// within 2 r of its own: at a distance s along the row, those with x^2 < (2 r)^2 - (1.95 r)^2.
TEST(ContactsAround, countAllSpheresThatAGrainTouches) {
    const double spacing = 0.2;
    const ContactsAround found = Row(60, spacing).contacts();
    const double reach = std::sqrt(4 - 1.95 * 1.95);
    EXPECT_EQ(found.most, 1 + 2 * std::floor(reach / spacing));
    // Five on the half of each band where its own sphere is the nearest, one elsewhere and on the ends, each
    // as often as there are contacts: (2.9 x 25 + 4) / (2.9 x 5 + 4) = 4.1; four where the fifth is just out
    // of reach.
    EXPECT_NEAR(found.mean, 4, 0.5);
}

/// Rods along z in a hexagonal crystal, each shifted along itself, as near to each other as an overlap of 5 %
/// lets them.
struct Crystal {
    const Row& row;
    std::vector<Vec3D> places;

    Crystal(const Row& rods, const std::array<double, 3>& shifts) : row(rods) {
        double near = 1.5, far = 2;
        for (int halving = 0; halving < 30; ++halving) {
            const double middle = 0.5 * (near + far);
            place(middle, shifts);
            (deepest() < 0.05 ? far : near) = middle;
        }
        place(far, shifts);
    }
    void place(double distance, const std::array<double, 3>& shifts) {
        places.clear();
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j)
                if (std::abs(i + j) <= 2)
                    places.emplace_back(distance * (i + 0.5 * j), distance * std::sqrt(0.75) * j,
                                        shifts[static_cast<std::size_t>((i - j + 6) % 3)]);
    }
    /// Calls function(a, b, normal, point) for each two spheres of rods a and b that overlap.
    template <class Function>
    void forEachContact(Function&& function) const {
        for (std::size_t a = 0; a < places.size(); ++a)
            for (std::size_t b = a + 1; b < places.size(); ++b)
                for (const SphereOfBody& one : row.spheres)
                    for (const SphereOfBody& two : row.spheres) {
                        const Vec3D from = places[a] + toEigen(one.arm),
                                    apart = places[b] + toEigen(two.arm) - from;
                        if (const double overlap = 2 - apart.norm(); overlap > 0)
                            function(a, b, apart.normalized(), Vec3D(from + 0.5 * apart), overlap);
                    }
    }
    [[nodiscard]] double deepest() const {
        double most = 0;
        forEachContact([&](std::size_t, std::size_t, const Vec3D&, const Vec3D&, double overlap) {
            most = std::max(most, overlap);
        });
        return most;
    }
    /// Of the whole stiffness matrix over masses and moments, with springs of 1 along the normals.
    [[nodiscard]] double largestSquaredFrequency() const {
        const auto size = static_cast<Eigen::Index>(6 * places.size());
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        const Eigen::Vector3d turning = toEigen(row.moments).cwiseSqrt().cwiseInverse();
        forEachContact([&](std::size_t a, std::size_t b, const Vec3D& n, const Vec3D& point, double) {
            Eigen::VectorXd approach = Eigen::VectorXd::Zero(size);
            for (const std::size_t rod : {a, b}) {
                const double sign = rod == a ? 1 : -1;
                const auto at = static_cast<Eigen::Index>(6 * rod);
                approach.segment<3>(at) = sign / std::sqrt(row.mass()) * n;
                approach.segment<3>(at + 3) = sign * turning.cwiseProduct((point - places[rod]).cross(n));
            }
            matrix += approach * approach.transpose();
        });
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
            .eigenvalues()
            .maxCoeff();
    }
};

// Rods that lie along each other are the worst that bodies can do, as their grooves are in step: of each
// sphere of a rod 12 contacts or more. The limit of a bed, 0.9 of that of 2 x 4 k normal facing / M, is below
// the exact one there, and 0.68 to 0.99 of it for these.
TEST(ContactsAround, areEnoughForCrystalsOfRods) {
    for (const auto& [spacing, count] :
         {std::pair{2.0, 4}, std::pair{1.4, 5}, std::pair{1.0, 6}, std::pair{0.5, 10}, std::pair{0.2, 14}}) {
        const Row row(count, spacing);
        const ContactsAround found = row.contacts();
        double exact = 0;
        for (const std::array<double, 3>& shifts :
             {std::array{0.0, 0.0, 0.0}, {0.0, spacing / 3, 2 * spacing / 3}, {0.0, spacing / 2, 0.0}})
            exact = std::max(exact, Crystal(row, shifts).largestSquaredFrequency());
        const double limits = 2 * 4 * found.normal * found.facing() / row.mass();
        EXPECT_LT(0.9 * std::sqrt(exact / limits), 1) << spacing;
        EXPECT_GT(0.9 * std::sqrt(exact / limits), 0.65) << spacing;
    }
}

// Plates of 3 x 3 spheres that lie on each other in step: of the crystals of such plates with overlaps of 5 %
// that a search over lattices found, the largest squared frequency (Bloch's matrix at 15 wave vectors,
// without friction, in a script of its own) needs 2.95 and 1.63.
TEST(ContactsAround, areEnoughForCrystalsOfPlates) {
    for (const auto& [spacing, needed] : {std::pair{0.5, 2.95}, std::pair{1.0, 1.63}}) {
        std::vector<SphereOfBody> spheres;
        for (int k = 0; k < 9; ++k) spheres.push_back({{spacing * (k % 3 - 1), spacing * (k / 3 - 1), 0}, 1});
        const double facing = contactsAround(spheres, 1, {1, 1, 1.5}).facing();
        EXPECT_GT(facing, needed) << spacing;
        EXPECT_LT(facing, 1.2 * needed) << spacing;
    }
}

// A large sphere with a small one on it: contacts move it as the large one, not as a free sphere of the small
// one's size, which has 1/64 of the mass. One with m on an arm R is 1 + 5/2 at most; a small one has the room
// of a fraction of a sphere's contacts.
TEST(ContactsAround, ofASmallSphereOnALargeOneDoNotCountItsOwnMass) {
    const std::vector<SphereOfBody> spheres{{{0, 0, -0.02}, 1}, {{0, 0, 1.08}, 0.25}};
    const double large = 1, small = 1.0 / 64;
    const double across = 0.4 * large + large * 0.02 * 0.02 + 0.4 * small / 16 + small * 1.08 * 1.08;
    const ContactsAround found =
        contactsAround(spheres, large + small, {across, across, 0.4 * large + 0.4 * small / 16});
    EXPECT_LT(found.normal, 4.5);
    EXPECT_GT(found.normal, 1);
    EXPECT_GT(found.finer, 1);
    EXPECT_LT(found.finer, 1.3);  // the small one has a twentieth of the surface, of 4 R / R
}

// A cube has eight contacts on each face. Normal forces turn it with 32 h^2 k, where 16 contacts on the faces
// beside an axis have arms h; friction with 16 of arms 2 h^2, on the faces across the axis, and 32 of arms H.
TEST(ContactsAround, ofACubeAreThoseOfItsCorners) {
    const double h = 0.9, radius = 0.1, outer = h + radius, moment = 2.0 / 3;
    std::vector<SphereOfBody> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({{k & 1 ? h : -h, k & 2 ? h : -h, k & 4 ? h : -h}, radius});
    const ContactsAround found = contactsAroundBlock(corners, 1, {moment, moment, moment});
    expectRoundedUp(found.normal, std::max(16.0, 32 * h * h / moment) / 4);
    expectRoundedUp(found.spin, 32 * (h * h + outer * outer) / moment / 8);
    expectRoundedUp(found.wallNormal, std::max(4.0, 4 * h * h / moment));
}

// Eight touching spheres in a box that presses all faces of the cube: 4 k on each of two shift it, and
// friction turns it about an axis with 8 contacts of arms sqrt(2) on the faces across, and 16 of arms 2 on
// the others. Of one face it has the shift and the spin about an axis in it together, 4 (1 + 4 M / I).
TEST(ContactsAround, ofACubeInABoxAreThoseOfAllFaces) {
    std::vector<SphereOfBody> corners;
    for (int k = 0; k < 8; ++k)
        corners.push_back({{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0}, 1});
    const double moment = 8 * (0.4 + 2), mass = 8;
    const ContactsAround found = contactsAround(corners, mass, {moment, moment, moment});
    expectRoundedUp(found.wallNormal, 4);
    expectRoundedUp(found.wallSliding, 4 * (1 + 4 * mass / moment));
    expectRoundedUp(found.boxNormal, 8);
    expectRoundedUp(found.boxSliding, (8 * 2 + 16 * 4) * mass / moment);
    expectRoundedUp(found.boxSpin, (8 * 2 + 16 * 4) * mass / moment);
}

// The numbers belong to the shape: not to its size, nor to how its principal axes were found.
TEST(ContactsAround, areThoseOfTheShape) {
    std::vector<SphereOfBody> given{{{0, 0, 0}, 1}, {{1.1, 0.2, 0}, 0.7}, {{-0.3, 0.9, 0.4}, 0.5}};
    const Vector<double> moments{1.1, 1.3, 1.7};
    const ContactsAround one = contactsAround(given, 2, moments);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3D::UnitX()));
    std::vector<SphereOfBody> scaled;
    for (const SphereOfBody& sphere : given)
        scaled.push_back({toVector(3 * (turn.conjugate() * toEigen(sphere.arm))), 3 * sphere.radius});
    // About x by a quarter: y and z change places.
    const ContactsAround two = contactsAround(scaled, 2 * 27, {243 * 1.1, 243 * 1.7, 243 * 1.3},
                                              {turn.w(), toVector(Vec3D(turn.vec()))});
    EXPECT_TRUE(one.areWithin(two));
    EXPECT_TRUE(two.areWithin(one));
    ContactsAround other = one;
    other.normal *= 1.01;
    EXPECT_FALSE(other.areWithin(one));
    EXPECT_EQ(one.roundedUp(), one);
}

}  // namespace
}  // namespace pendular::contactsAroundTest
