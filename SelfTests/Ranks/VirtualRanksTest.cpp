#include "Tools/Reference/VirtualRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Features/DomainDecomposition/Bisection.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular::virtualRanksTest {
namespace {

TEST(VirtualRanks, sendMessages) {
    for (const std::size_t count : {1u, 2u, 5u})
        VirtualRanks(count).run([&](Exchange& exchange) {
            EXPECT_EQ(exchange.count(), count);
            for (int round = 0; round < 50; ++round) {
                std::vector<Message> toEach(count);
                for (std::size_t to = 0; to < count; ++to)
                    for (std::size_t k = 0; k < to; ++k) toEach[to].add(10.0 * exchange.rank() + round);
                std::vector<Message> fromEach = exchange.swap(std::move(toEach));
                for (std::size_t from = 0; from < count; ++from) {
                    for (std::size_t k = 0; k < exchange.rank(); ++k)
                        EXPECT_EQ(fromEach[from].take<double>(), 10.0 * from + round);
                    EXPECT_TRUE(fromEach[from].isTaken());
                }
            }
        });
}

TEST(VirtualRanks, findTheLargest) {
    VirtualRanks(4).run([](Exchange& exchange) {
        for (int round = 0; round < 50; ++round) {
            const auto own = static_cast<double>((exchange.rank() + round) % 4) - 10;
            EXPECT_EQ(exchange.largest(own), -7);
        }
        EXPECT_EQ(exchange.ofAll(exchange.rank()), (std::vector<std::size_t>{0, 1, 2, 3}));
    });
}

// The others wait for it: they must not do so for ever.
TEST(VirtualRanks, allEndWhenOneFails) {
    VirtualRanks ranks(4);
    const auto failing = [](Exchange& exchange) {
        for (int round = 0; round < 10; ++round) {
            if (exchange.rank() == 2 && round == 5) throw std::runtime_error("rank 2");
            static_cast<void>(exchange.largest(1));
        }
        ADD_FAILURE() << "rank " << exchange.rank() << " has not noticed";
    };
    try {
        ranks.run(failing);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& failure) {
        EXPECT_STREQ(failure.what(), "rank 2");
    }
    ranks.run([](Exchange& exchange) { EXPECT_EQ(exchange.largest(3), 3); });
}

TEST(VirtualRanks, allEndWhenOneReturns) {
    for (const std::size_t early : {0u, 2u}) {
        VirtualRanks ranks(3);
        EXPECT_THROW(ranks.run([&](Exchange& exchange) {
            for (int round = 0; round < 10; ++round) {
                if (exchange.rank() == early && round == 5) return;
                static_cast<void>(exchange.largest(1));
            }
            ADD_FAILURE() << "rank " << exchange.rank() << " has not noticed";
        }),
                     RunError);
    }
}

// 0.1 of each of seven ranks, and of one: 0.7 is not what a sum of doubles gives.
TEST(AllRanks, addUpExactly) {
    VirtualRanks(7).run([](Exchange& exchange) {
        const AllRanks ranks(exchange);
        ExactSum one, two;
        one.add(0.1);
        two.add(exchange.rank() == 3 ? 1e300 : exchange.rank() == 5 ? -1e300 : 1);
        ranks.addUp({&one, &two});
        EXPECT_EQ(one.value(), 0x1.6666666666667p-1);
        EXPECT_EQ(two.value(), 5);
        EXPECT_EQ(ranks.sum(std::uint64_t{exchange.rank()}), 21u);
        EXPECT_EQ(ranks.smallest(10.0 - static_cast<double>(exchange.rank())), 4);
        EXPECT_TRUE(ranks.any(exchange.rank() == 6));
        EXPECT_FALSE(ranks.any(false));
        EXPECT_EQ(ranks.largest(exchange.rank() == 2 ? std::nan("") : 0), infinity);
        const std::vector<std::size_t> own(exchange.rank() % 2, exchange.rank());
        EXPECT_EQ(ranks.gather(own), (std::vector<std::size_t>{1, 3, 5}));
        ExactSum notANumber;
        notANumber.add(exchange.rank() == 1 ? infinity : 0);
        EXPECT_TRUE(std::isnan(ranks.sum(notANumber)));
    });
    VirtualRanks(3).run([](Exchange& exchange) {
        bool doShare = false;
        const AllRanks ranks(exchange, doShare);
        EXPECT_EQ(ranks.sum(std::uint64_t{5}), 5u);
        doShare = true;
        EXPECT_EQ(ranks.sum(std::uint64_t{5}), 15u);
    });
    const AllRanks alone;
    EXPECT_EQ(alone.largest(-2), -2);
    EXPECT_EQ(alone.sum(std::uint64_t{3}), 3u);
}

/// Points at random in a box, those of its upper half thrice as heavy.
std::vector<Bisection::Point> heavyAbove(std::size_t count) {
    UniformRandom random(1);
    std::vector<Bisection::Point> points;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = random.uniform(0, 1), y = random.uniform(0, 1), z = random.uniform(0, 1);
        points.push_back({{2 * x, y, z}, z < 0.5 ? 1.0 : 3.0});
    }
    return points;
}

TEST(Bisection, givesEachRankItsShare) {
    const std::vector<Bisection::Point> points = heavyAbove(3000);
    for (const std::vector<double>& shares :
         {std::vector<double>{1, 1, 1}, {1, 2, 5}, {3, 1, 1, 1, 2, 1, 1}, std::vector<double>(64, 1)})
        VirtualRanks(3).run([&](Exchange& exchange) {
            std::vector<Bisection::Point> own;
            for (std::size_t k = exchange.rank(); k < points.size(); k += 3) own.push_back(points[k]);
            Bisection cuts;
            cuts.cut(exchange, own, shares);
            std::vector<double> weights(shares.size());
            double all = 0, allShares = 0;
            for (const auto& [position, weight] : points)
                weights[cuts.ownerOf(position)] += weight, all += weight;
            for (const double share : shares) allShares += share;
            // Each cut is at most half of a point, of weight 3, off; there are at most six on the way to a
            // rank.
            for (std::size_t q = 0; q < shares.size(); ++q)
                EXPECT_NEAR(weights[q], shares[q] / allShares * all, 6 * 1.5);
        });
}

/// Brute force: a part of space is as near as some place in it.
TEST(Bisection, findsAllPartsThatAreNear) {
    const std::vector<Bisection::Point> points = heavyAbove(2000);
    Bisection cuts;
    cuts.cut(points, std::vector<double>(50, 1));
    for (std::size_t k = 0; k < 40; ++k) {
        std::vector<bool> found(50);
        cuts.forEachNear(points[k].position, 0.2, [&](std::size_t rank) { found[rank] = true; });
        EXPECT_TRUE(found[cuts.ownerOf(points[k].position)]);
        EXPECT_LT(std::count(found.begin(), found.end(), true), 50);
        for (const Bisection::Point& point : points) {
            if (norm(point.position - points[k].position) < 0.2) {
                EXPECT_TRUE(found[cuts.ownerOf(point.position)]);
            }
        }
    }
}

/// A block that is 1.2 times as long along y, with an antenna that makes it widest along x: fewest points lie
/// at a cut across y.
TEST(Bisection, cutsWhereFewestPointsAre) {
    UniformRandom random(1);
    std::vector<Bisection::Point> points;
    for (int k = 0; k < 4000; ++k) {
        const double x = random.uniform(0, 1), y = random.uniform(0, 1.2), z = random.uniform(0, 1);
        points.push_back({{k % 40 == 0 ? 5 * x : x, y, z}, 1});
    }
    Bisection cuts;
    cuts.cut(points, std::vector<double>{1, 1});
    for (const double x : {0.1, 0.9, 4.5}) {
        EXPECT_EQ(cuts.ownerOf({x, 0.5, 0.5}), 0u);
        EXPECT_EQ(cuts.ownerOf({x, 0.7, 0.5}), 1u);
    }
}

TEST(Bisection, standsWithoutPoints) {
    VirtualRanks(3).run([](Exchange& exchange) {
        Bisection cuts;
        cuts.cut(exchange, {}, std::vector<double>{1, 1, 1});
        EXPECT_LT(cuts.ownerOf({1, 2, 3}), 3u);
    });
}

}  // namespace
}  // namespace pendular::virtualRanksTest
