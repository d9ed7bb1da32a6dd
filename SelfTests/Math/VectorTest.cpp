#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/Four.h"
#include "Kernel/Foundation/Math/Vector.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace pendular::vectorTest {
namespace {

// Small integers: every result below is exact.
const Vector<double> a = {1, -2, 3};
const Vector<double> b = {4, 5, -6};

TEST(Vector, hasTheOperationsOfALinearSpace) {
    EXPECT_EQ(a + b, (Vector<double>{5, 3, -3}));
    EXPECT_EQ(a - b, (Vector<double>{-3, -7, 9}));
    EXPECT_EQ(-a, (Vector<double>{-1, 2, -3}));
    EXPECT_EQ(2 * a, (Vector<double>{2, -4, 6}));
    EXPECT_EQ(a * 2, 2 * a);
    Vector<double> c = a;
    EXPECT_EQ(c += b, a + b);
    EXPECT_EQ(c -= b, a);
    EXPECT_EQ(c *= 3, 3 * a);
    EXPECT_EQ(fma(2.0, a, b), 2 * a + b);
    EXPECT_FALSE(a == b);
}

TEST(Vector, isHalfARecordOfFourAndLeavesTheNumberBehindItAsItIs) {
    struct alignas(32) Half {
        Vector<double> vector;
        double behind;
    } half{a, 7};
    const Four before = loadFour(half.vector);
    EXPECT_EQ(vectorOf(before), a);
    EXPECT_EQ(before[3], 7);
    EXPECT_EQ(vectorOf(fourOf(b)), b);
    storeVector(half.vector, 2 * before + fourOf(b), before);
    EXPECT_EQ(half.vector, 2 * a + b);
    EXPECT_EQ(half.behind, 7);
}

TEST(Vector, productsAgreeWithClosedForms) {
    EXPECT_EQ(dot(a, b), 4 - 10 - 18);
    EXPECT_EQ(cross(Vector<double>{1, 0, 0}, Vector<double>{0, 1, 0}), (Vector<double>{0, 0, 1}));
    EXPECT_EQ(cross(a, b), (Vector<double>{-3, 18, 13}));
    EXPECT_EQ(cross(b, a), -cross(a, b));
    EXPECT_EQ(dot(a, cross(a, b)), 0);
    EXPECT_EQ(squaredNorm(cross(a, b)), squaredNorm(a) * squaredNorm(b) - dot(a, b) * dot(a, b));  // Lagrange
    EXPECT_EQ(norm(Vector<double>{2, 3, 6}), 7);
}

TEST(Vector, productsAgreeWithEigen) {
    EXPECT_EQ(toVector(toEigen(a)), a);
    EXPECT_EQ(toEigen(cross(a, b)), toEigen(a).cross(toEigen(b)));
    EXPECT_EQ(dot(a, b), toEigen(a).dot(toEigen(b)));
    EXPECT_EQ(toEigen(a), Eigen::Vector3d(1, -2, 3));
}

Vector<double> lane(const Vector<Pack>& v, std::size_t k) { return {v.x[k], v.y[k], v.z[k]}; }

TEST(Vector, ofPacksGivesTheBitsOfEightVectors) {
    const Vector<Pack> p = {Pack::fromLanes({1, 2, 3, 4, 5, 6, 7, 8}), Pack(0.1),
                            Pack::fromLanes({8, 7, 6, 5, 4, 3, 2, 1})};
    const Vector<Pack> q = {Pack(0.3), Pack::fromLanes({3, 1, 4, 1, 5, 9, 2, 6}), Pack(-1.7)};
    const Mask longer = norm(p) > norm(q);
    Vector<Pack> sum = p;
    sum += q * norm(p);
    for (std::size_t k = 0; k < 8; ++k) {
        const Vector<double> pk = lane(p, k);
        const Vector<double> qk = lane(q, k);
        EXPECT_EQ(lane(p + q, k), pk + qk);
        EXPECT_EQ(lane(p - q, k), pk - qk);
        EXPECT_EQ(lane(-p, k), -pk);
        EXPECT_EQ(lane(cross(p, q), k), cross(pk, qk));
        EXPECT_EQ(lane(0.7 * p, k), 0.7 * pk);
        EXPECT_EQ(lane(sum, k), pk + norm(pk) * qk);
        EXPECT_EQ(dot(p, q)[k], dot(pk, qk));
        EXPECT_EQ(norm(p)[k], norm(pk));
        EXPECT_EQ(lane(select(longer, p, q), k), norm(pk) > norm(qk) ? pk : qk);
    }
}

}  // namespace
}  // namespace pendular::vectorTest
