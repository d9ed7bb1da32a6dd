#include "Kernel/Features/Insertion/DenseBodies.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Features/Insertion/MayOverlap.h"
#include "Kernel/Features/Insertion/SpreadPoints.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Features/Superquadrics/CoveringBalls.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

namespace {

using Point = Vector<double>;

constexpr std::uint32_t purposeOfBodyPlaces = 0x1257200, purposeOfBodyTurns = 0x1257210;
constexpr std::size_t bodiesWorthAThread = 1024;
constexpr int mostBodyIterations = 2000, bodyPatience = 200;

/// Bodies that push and turn each other. Spheres behind those of bodies are grains of the scene, which stay.
class BodyRelaxation {
public:
    BodyRelaxation(std::vector<PlacedBody>& wanted, const StandInSpheres& spheresOf, const InsertionScene& of,
                   const Region& within, const InsertOptions& options)
        : placed(wanted), standIns(spheresOf), scene(of), region(within), hasMargin(options.wholeGrains) {
        placeAll(options.seed);
        double volume = 0;
        for (const PlacedBody& body : placed) volume += sphereMass(body.radius, 1);
        const double fraction = volume / region.volume();
        // Spheres are a little larger than wanted, below the fraction at which they would jam.
        excess = std::cbrt(std::max(std::min(1.1 * fraction, 0.62), fraction * 1.01) / fraction);
        firstScale = std::min(0.9, std::cbrt(0.05 / fraction));
        addSpheres();
        for (const TranslationRecord& grain :
             ParticleHandler::Inside::grainsInStep(scene.particles).translation)
            if (grain.radius > 0) spheres.push_back({grain.position, grain.radius, none});
        skin = smallestSphere();
    }

    DenseBodies run() {
        DenseBodies made;
        while (made.iterations < mostBodyIterations) {
            scale = std::min(1.0, firstScale + (1 - firstScale) * made.iterations / stepsOfGrowth);
            ++made.iterations;
            if (relax() && scale == 1) return finish(made);
            // Borders and grains may leave less room than the region's volume says.
            if (made.iterations % bodyPatience == 0) excess = 1 + 0.5 * (excess - 1);
        }
        while (scale > 0.1) {
            scale *= 0.98;
            for (int k = 0; k < bodyPatience / 2; ++k, ++made.iterations)
                if (relax()) return finish(made);
        }
        return finish(made);
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr int stepsOfGrowth = 60;
    static constexpr double stepShare = 0.3, usualContacts = 8, inertia = 0.85;
    /// Wanted spheres are apart by so much of their radii, so that round-off of adding them makes no overlap.
    static constexpr double apart = 1 + 1e-10;

    struct Body {
        Point place;  // m
        Eigen::Quaterniond turn;
        double radius;                              // m, of the sphere of its volume
        double lever;                               // m, of its farthest sphere
        std::uint32_t first, end;                   // of its spheres
        Point way{0, 0, 0}, spin{0, 0, 0};          // m, rad: of the last iteration
        Point nextWay{0, 0, 0}, nextSpin{0, 0, 0};  // of this one
    };
    struct Sphere {
        Point place;  // m
        double size;  // m, the wanted radius
        std::uint32_t body;
    };

    void placeAll(std::uint64_t seed) {
        const SpreadPoints points(placed.size(), seed, purposeOfBodyPlaces);
        const CountedRandom random(seed);
        std::uint64_t number = 0;
        for (PlacedBody& body : placed) {
            askForInterruption();
            for (int attempt = 0; attempt < 1000; ++attempt, ++number) {
                body.place = region.candidate(points[number], hasMargin ? body.radius : 0);
                if (region.contains(body.place, 0)) break;
            }
            body.turn = evenTurn(random.uniform(number, purposeOfBodyTurns),
                                 random.uniform(number, purposeOfBodyTurns + 1),
                                 random.uniform(number, purposeOfBodyTurns + 2));
            ++number;
        }
    }

    /// In an order in which neighbours in space are mostly neighbours in memory.
    void addSpheres() {
        std::vector<TranslationRecord> records;
        double mean = 0;
        for (const PlacedBody& body : placed) {
            records.push_back({scene.periodic.wrap(body.place), body.radius, {0, 0, 0}, 1});
            mean += 2 * body.radius / static_cast<double>(placed.size());
        }
        order = spatialOrder(records, mean, scene.threads);
        for (const std::uint32_t k : order) {
            const PlacedBody& one = placed[k];
            const auto first = static_cast<std::uint32_t>(spheres.size());
            double lever = 0;
            for (const Ball& ball : standIns.of({one.kind, one.radius})) {
                arms.push_back(ball.centre);
                lever = std::max(lever, ball.centre.norm());
                spheres.push_back({one.place, ball.radius, static_cast<std::uint32_t>(bodies.size())});
            }
            bodies.push_back(
                {one.place, one.turn, one.radius, lever, first, static_cast<std::uint32_t>(spheres.size())});
        }
    }

    [[nodiscard]] double smallestSphere() const {
        double least = infinity;
        for (const Sphere& sphere : spheres) least = std::min(least, sphere.size);
        return least;
    }

    /// Where bodies are not free, all of them step; returns whether they are.
    bool relax() {
        askForInterruption();
        placeSpheres();
        list();
        if (push()) return true;
        move();
        return false;
    }

    DenseBodies finish(DenseBodies made) {
        made.scale = scale;
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            placed[order[k]].place = scene.periodic.wrap(bodies[k].place);
            placed[order[k]].turn = bodies[k].turn;
        }
        return made;
    }

    void placeSpheres() {
        inBodies([&](int, Body& body) {
            const Eigen::Matrix3d turn = body.turn.toRotationMatrix();
            for (std::uint32_t k = body.first; k < body.end; ++k)
                spheres[k].place = body.place + toVector(Vec3D(scale * (turn * arms[k])));
        });
    }

    template <class Function>
    void inBodies(Function&& function) {
        inParts(
            bodies.size(), scene.threads,
            [&](int part, std::size_t from, std::size_t to) {
                for (std::size_t k = from; k < to; ++k) function(part, bodies[k]);
            },
            bodiesWorthAThread);
    }

    [[nodiscard]] double scaleOf(const Sphere& sphere) const { return sphere.body == none ? 1 : scale; }
    /// m, the radius with which a sphere pushes.
    [[nodiscard]] double sizeOf(const Sphere& sphere) const {
        return sphere.body == none ? sphere.size : scale * excess * sphere.size;
    }

    /// Who may overlap whom while no sphere moves by more than half the skin, or grows.
    void list() {
        if (scale == listedScale && farthestMoved() < 0.5 * skin) return;
        listedScale = scale;
        listed.resize(arms.size());
        for (std::size_t k = 0; k < arms.size(); ++k) listed[k] = spheres[k].place;
        std::vector<TranslationRecord> records;
        records.reserve(spheres.size());
        for (const Sphere& sphere : spheres)
            records.push_back({scene.periodic.wrap(sphere.place), sizeOf(sphere), {0, 0, 0}, 1});
        border.assign(arms.size(), 0);
        mayOverlap.list(
            records, skin, scene.periodic, scene.threads, bodiesWorthAThread,
            [&](std::uint32_t a, std::uint32_t b) { return spheres[a].body != spheres[b].body; },
            [&](std::size_t k) {
                if (k < arms.size()) border[k] = isNearBorder(spheres[k]);
            });
    }

    [[nodiscard]] double farthestMoved() {
        std::vector<double> farthest(static_cast<std::size_t>(scene.threads), 0);
        inParts(
            arms.size(), scene.threads,
            [&](int part, std::size_t from, std::size_t to) {
                double& own = farthest[static_cast<std::size_t>(part)];
                for (std::size_t k = from; k < to; ++k)
                    own = std::max(own, squaredNorm(spheres[k].place - listed[k]));
            },
            bodiesWorthAThread);
        return std::sqrt(std::ranges::max(farthest));
    }

    [[nodiscard]] bool isNearBorder(const Sphere& sphere) const {
        const double size = sizeOf(sphere) + skin;
        if (touchesWall(scene.walls, scene.periodic, sphere.place, size)) return true;
        if (hasMargin) return !region.contains(sphere.place, size);
        return !region.contains(bodies[sphere.body].place,
                                skin + norm(bodies[sphere.body].place - sphere.place));
    }

    /// The push of all that a body overlaps.
    struct Push {
        Point way{0, 0, 0}, torque{0, 0, 0};  // m, m^2
        int contacts = 0;
        bool isFree = true;  // the body of the wanted size overlaps nothing

        void add(const Point& push, const Point& arm) {
            way += push;
            torque += cross(arm, push);
            ++contacts;
        }
    };

    void addPushesOn(std::uint32_t k, const Body& body, Push& push) const {
        const Sphere& self = spheres[k];
        const double size = sizeOf(self), wanted = scale * self.size;
        const Point arm = self.place - body.place;
        for (const std::uint32_t partner : mayOverlap.of(k)) {
            const Sphere& other = spheres[partner];
            const Point from = scene.periodic.nearest(self.place - other.place);
            const double touch = size + sizeOf(other), squared = squaredNorm(from);
            if (squared >= touch * touch) continue;
            const double distance = std::sqrt(squared);
            push.isFree &= distance >= apart * (wanted + scaleOf(other) * other.size);
            // What stays gives way by nothing.
            const double part = (other.body == none ? 2 : 1) * (touch - distance);
            push.add(distance > 0 ? part / distance * from : Point{part, 0, 0}, arm);
        }
        if (border[k]) addBorderOn(self, arm, push);
    }

    void addBorderOn(const Sphere& self, const Point& arm, Push& push) const {
        const double size = sizeOf(self), wanted = scale * self.size;
        if (hasMargin) {
            if (const Point inwards = region.inwards(self.place, size); norm(inwards) > 0)
                push.add(2 * inwards, arm);
            push.isFree &= region.contains(self.place, apart * wanted);
        } else {
            const Point centre = self.place - arm;
            if (const Point inwards = region.inwards(centre, 0); norm(inwards) > 0)
                push.add(inwards, {0, 0, 0});
            push.isFree &= region.contains(centre, 0);
        }
        forEachWallNear(scene.walls, scene.periodic, self.place, size,
                        [&](const WallPoint& point, std::size_t) {
                            push.isFree &= point.distance >= apart * wanted;
                            push.add(-2 * (size - point.distance) * point.normal, arm);
                        });
    }

    /// Each body's step, from the overlaps of all; returns whether the bodies of the wanted sizes are free.
    bool push() {
        std::vector<std::uint8_t> areFree(static_cast<std::size_t>(scene.threads), 1);
        inBodies([&](int part, Body& body) {
            Push push;
            for (std::uint32_t k = body.first; k < body.end; ++k) addPushesOn(k, body, push);
            areFree[static_cast<std::size_t>(part)] &= push.isFree;
            const double share = stepShare * usualContacts / std::max<double>(usualContacts, push.contacts);
            body.nextWay = limited(inertia * body.way + share * push.way, 0.2 * scale * body.radius);
            body.nextSpin = {0, 0, 0};
            if (body.lever == 0) return;
            // A push at the end of the longest arm moves that end as much as it moves the body.
            const double lever = scale * body.lever;
            body.nextSpin = limited(inertia * body.spin + share / (lever * lever) * push.torque,
                                    0.2 * body.radius / body.lever);
        });
        return std::ranges::min(areFree) == 1;
    }
    static Point limited(const Point& step, double longest) {
        const double length = norm(step);
        return length > longest ? longest / length * step : step;
    }

    void move() {
        inBodies([](int, Body& body) {
            body.way = body.nextWay, body.spin = body.nextSpin;
            body.place += body.way;
            const double angle = norm(body.spin);
            if (angle > 0)
                body.turn =
                    (Eigen::Quaterniond(Eigen::AngleAxisd(angle, toEigen(1 / angle * body.spin))) * body.turn)
                        .normalized();
        });
    }

    std::vector<PlacedBody>& placed;
    const StandInSpheres& standIns;
    const InsertionScene& scene;
    const Region& region;
    bool hasMargin;
    double excess = 1;                 // of the radii with which spheres push, over the wanted ones
    double firstScale = 1, scale = 1;  // of all lengths of bodies
    double listedScale = 0;            // when the list was made
    double skin = 0;                   // m
    std::vector<Body> bodies;
    std::vector<std::uint32_t> order;  // of the bodies as they were given
    std::vector<Sphere> spheres;
    std::vector<Vec3D> arms;    // m, of the spheres of bodies, before their turn
    std::vector<Point> listed;  // m, where spheres were when the list was made
    MayOverlap mayOverlap;
    std::vector<std::uint8_t> border;
};

}  // namespace

StandInSpheres::StandInSpheres(const std::vector<PlacedBody>& bodies) {
    for (const PlacedBody& body : bodies)
        if (const auto* const grain = body.kind->shaped(); grain && !covers.contains(body.kind))
            covers.emplace(body.kind, coveringBalls(grain->getShape()));
}

std::vector<Ball> StandInSpheres::of(const PlacedBody& body) const {
    const auto cover = covers.find(body.kind);
    if (cover == covers.end()) return body.kind->spheres(body.radius, body.place, body.turn);
    return placedBalls(cover->second, body.kind->scale(body.radius), body.place, body.turn);
}

DenseBodies denseBodies(std::vector<PlacedBody>& bodies, const StandInSpheres& standIns,
                        const InsertionScene& scene, const Region& region, const InsertOptions& options) {
    if (bodies.empty()) return {};
    return BodyRelaxation(bodies, standIns, scene, region, options).run();
}

}  // namespace pendular
