#include "Kernel/Features/Insertion/DenseStart.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Features/Insertion/MayOverlap.h"
#include "Kernel/Features/Insertion/SpreadPoints.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

namespace {

using Point = Vector<double>;

constexpr std::uint32_t purposeOfStartPlaces = 0x1257000;
constexpr std::size_t grainsWorthAThread = 4096;
constexpr int mostIterations = 3000, patience = 300;

/// Spheres that push each other apart. Those behind `count` are grains of the scene, which stay.
class Relaxation {
public:
    Relaxation(std::span<const double> given, bool wholeGrains, const Region& within,
               const ParticleStore& present, const WallHandler& wallHandler, const PeriodicBox& box,
               std::uint64_t seed, int threadCount)
        : count(given.size()),
          hasMargin(wholeGrains),
          region(within),
          walls(wallHandler),
          periodic(box),
          threads(threadCount) {
        double volume = 0;
        for (const double radius : given) volume += sphereMass(radius, 1);
        // Larger spheres than wanted, below the fraction at which they would jam.
        const double fraction = volume / region.volume();
        growth = std::cbrt(std::max(std::min(1.1 * fraction, 0.62), fraction * 1.01) / fraction);
        placeAll(given, seed);
        for (const TranslationRecord& grain : present.translation)
            if (grain.radius > 0) spheres.push_back({grain.position, -grain.radius});
        sortInSpace();
        shifts.resize(spheres.size(), Point{0, 0, 0});
        steps.resize(spheres.size(), Point{0, 0, 0});
        skin = 1.0 * growth * given.back();
    }

    DenseStart run() {
        DenseStart made;
        for (; made.iterations < mostIterations; ++made.iterations) {
            askForInterruption();
            list();
            made.shrink = push();
            if (made.shrink >= 1) break;
            if (made.iterations % patience == patience - 1) growLess();
            move();
        }
        made.shrink = std::min(made.shrink, 1.0);
        made.centres.resize(count);
        for (std::size_t k = 0; k < spheres.size(); ++k)
            if (order[k] < count) made.centres[order[k]] = periodic.wrap(spheres[k].position);
        return made;
    }

private:
    /// Four numbers, so that eight of them are loaded at once.
    struct alignas(32) Sphere {
        Point position;  // m
        double size;     // m, the radius with which it pushes; negative for a grain of the scene, which stays

        [[nodiscard]] bool moves() const { return size > 0; }
        [[nodiscard]] double radius() const { return std::abs(size); }
    };

    void placeAll(std::span<const double> radii, std::uint64_t seed) {
        const SpreadPoints points(radii.size(), seed, purposeOfStartPlaces);
        std::uint64_t number = 0;
        for (const double radius : radii) {
            askForInterruption();
            const double margin = hasMargin ? radius : 0;
            Point place{};
            for (int attempt = 0; attempt < 1000; ++attempt, ++number) {
                place = region.candidate(points[number], margin);
                if (region.contains(place, 0)) break;
            }
            ++number;
            spheres.push_back({place, growth * radius});
        }
    }

    void sortInSpace() {
        std::vector<TranslationRecord> records = asRecords();
        double mean = 0;
        for (const Sphere& sphere : spheres)
            mean += 2 * sphere.radius() / static_cast<double>(spheres.size());
        order = spatialOrder(records, mean, threads);
        std::vector<Sphere> sorted;
        sorted.reserve(spheres.size());
        for (const std::uint32_t k : order) sorted.push_back(spheres[k]);
        spheres.swap(sorted);
    }

    [[nodiscard]] std::vector<TranslationRecord> asRecords() const {
        std::vector<TranslationRecord> records;
        records.reserve(spheres.size());
        for (const Sphere& sphere : spheres)
            records.push_back({periodic.wrap(sphere.position), sphere.radius(), {0, 0, 0}, 1});
        return records;
    }

    /// Who may overlap whom while no sphere moves by more than half the skin.
    void list() {
        if (moved < 0.5 * skin) return;
        moved = 0;
        listed.clear();
        for (const Sphere& sphere : spheres) listed.push_back(sphere.position);
        border.resize(spheres.size());
        mayOverlap.list(
            asRecords(), skin, periodic, threads, grainsWorthAThread,
            [](std::uint32_t, std::uint32_t) { return true; },
            [&](std::size_t k) { border[k] = spheres[k].moves() && isNearBorder(spheres[k]); });
    }

    /// The lanes of the eight partners from `n` on that are before `end`.
    static Mask listedFrom(std::size_t n, std::size_t end) {
        const std::size_t left = std::min<std::size_t>(end - n, Pack::lanes);
        return maskFromBits(static_cast<std::uint8_t>((1U << left) - 1));
    }

    /// Borders and grains may leave less room than the region's volume says: then the spheres have jammed.
    void growLess() {
        const double before = std::exchange(growth, 1 + 0.5 * (growth - 1));
        for (Sphere& sphere : spheres)
            if (sphere.moves()) sphere.size *= growth / before;
    }

    [[nodiscard]] bool isNearBorder(const Sphere& sphere) const {
        return !region.contains(sphere.position, hasMargin ? sphere.size + skin : skin) ||
               touchesWall(walls, periodic, sphere.position, sphere.size + skin);
    }

    /// Each sphere's step, from the overlaps of all; returns by how much radii would have to be multiplied
    /// for the wanted ones not to overlap.
    double push() {
        std::vector<double> least(static_cast<std::size_t>(threads), infinity);
        inParts(
            spheres.size(), threads,
            [&](int part, std::size_t from, std::size_t to) {
                double& own = least[static_cast<std::size_t>(part)];
                for (std::size_t k = from; k < to; ++k)
                    if (spheres[k].moves()) own = std::min(own, pushOne(k));
            },
            grainsWorthAThread);
        return growth * std::ranges::min(least);
    }

    /// The push of its neighbours on a sphere.
    struct Push {
        Point way{0, 0, 0};       // m, the sum of overlaps
        double least = infinity;  // radii would have to be multiplied by this
        int contacts = 0;
    };

    /// Eight partners at a time.
    [[nodiscard]] Push pushOfPartners(std::size_t k) const {
        const Sphere& self = spheres[k];
        const Pack size(self.size);
        Vector<Pack> sum{Pack(0), Pack(0), Pack(0)};
        Pack least(infinity);
        Push push;
        const std::span<const std::uint32_t> partners = mayOverlap.of(k);
        for (std::size_t n = 0; n < partners.size(); n += Pack::lanes) {
            const auto [x, y, z, sizes] = loadRecords<4>(&spheres[0].position.x, 4, partners.data() + n);
            const Vector<Pack> apart =
                periodic.nearest(Vector<Pack>{self.position.x - x, self.position.y - y, self.position.z - z});
            const Pack radii = abs(sizes), touch = size + radii, squared = squaredNorm(apart);
            const Mask overlap = (squared < touch * touch) & listedFrom(n, partners.size());
            if (none(overlap)) continue;
            const Pack distance = sqrt(squared);
            // A grain of the scene has the size that it has.
            const Pack share = select(sizes > Pack(0), distance / touch, (distance - radii) / size);
            least = select(overlap, min(least, share), least);
            push.contacts += std::popcount(bits(overlap));
            const Pack part = select(overlap & (distance > Pack(0)), touch / distance - Pack(1), Pack(0));
            sum += part * apart;
        }
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            push.way += Point{sum.x[lane], sum.y[lane], sum.z[lane]};
            push.least = std::min(push.least, least[lane]);
        }
        return push;
    }

    double pushOne(std::size_t k) {
        const Sphere& self = spheres[k];
        Push push = pushOfPartners(k);
        if (border[k]) {
            const double margin = hasMargin ? self.size : 0;
            const Point inwards = region.inwards(self.position, margin);
            push.way += 2 * inwards;  // a border gives way by nothing
            if (const double outside = norm(inwards); outside > 0)
                push.least = std::min(push.least, 1 - outside / self.size);
            forEachWallNear(walls, periodic, self.position, self.size,
                            [&](const WallPoint& point, std::size_t) {
                                push.way -= 2 * (self.size - point.distance) * point.normal;
                                push.least = std::min(push.least, point.distance / self.size);
                                ++push.contacts;
                            });
        }
        // Each pair would be apart after one step of half its overlap; of many contacts each gets a part, and
        // steps have inertia, by which slow modes go ten times as fast.
        const double share = stepShare * usualContacts / std::max<double>(usualContacts, push.contacts);
        steps[k] = inertia * shifts[k] + share * push.way;
        const double longest = 0.2 * self.size, length = norm(steps[k]);
        if (length > longest) steps[k] *= longest / length;
        return push.least;
    }

    void move() {
        std::vector<double> farthest(static_cast<std::size_t>(threads), 0);
        inParts(
            spheres.size(), threads,
            [&](int part, std::size_t from, std::size_t to) {
                double& own = farthest[static_cast<std::size_t>(part)];
                for (std::size_t k = from; k < to; ++k) {
                    spheres[k].position += steps[k];
                    shifts[k] = steps[k];
                    own = std::max(own, squaredNorm(spheres[k].position - listed[k]));
                }
            },
            grainsWorthAThread);
        moved = std::sqrt(std::ranges::max(farthest));
    }

    static constexpr double stepShare = 0.4, usualContacts = 6, inertia = 0.9;

    std::size_t count;
    bool hasMargin;
    const Region& region;
    const WallHandler& walls;
    const PeriodicBox& periodic;
    int threads;
    double growth = 1;        // of the radii, over the wanted ones
    double skin = 0;          // m
    double moved = infinity;  // m, the longest way of a sphere since the list was made
    std::vector<Sphere> spheres;
    std::vector<std::uint32_t> order;  // of the spheres as they were given
    std::vector<Point> shifts, steps;  // m, of the last iteration and of this one
    std::vector<Point> listed;         // m, where spheres were when the list was made
    MayOverlap mayOverlap;
    std::vector<std::uint8_t> border;
};

}  // namespace

DenseStart denseStart(std::span<const double> radii, bool margin, const Region& region,
                      const ParticleStore& present, const WallHandler& walls, const PeriodicBox& periodic,
                      std::uint64_t seed, int threads) {
    if (radii.empty()) return {};
    return Relaxation(radii, margin, region, present, walls, periodic, seed, threads).run();
}

}  // namespace pendular
