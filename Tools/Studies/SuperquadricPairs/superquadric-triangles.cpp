/// How far the depths of superquadrics at triangles are from the least over many normals, and what a contact
/// takes.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Drivers/Shared/ProcessorTime.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "Kernel/Features/Superquadrics/ShapeAtWall.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/Studies/SuperquadricPairs/RandomDirection.h"

using namespace pendular;

namespace {

struct Options {
    std::size_t triangles = 200;
    double overlap = 0.2;
    std::size_t normals = 2000;
    std::size_t seed = 1;
};

/// A superquadric at the origin, whose largest half length is 1, and a triangle.
struct Pose {
    Superquadric shape;
    Axes<double> axes;
    double ball;  // the smallest radius of curvature
    Triangle triangle;
    TriangleWall wall;

    void place(const Triangle& of, const Vector<double>& shift) {
        triangle = of;
        for (Vector<double>& corner : triangle) corner += shift;
        wall.set(std::vector{triangle});
    }
    [[nodiscard]] WallPoint point() const {
        const ShapeAtWall grain(SuperquadricLanes<double>::from(shape), axes, {0, 0, 0}, ball);
        const std::uint32_t part = 0;
        WallPoint found;
        grain.findPoints(wall, 0, {&part, 1}, {&found, 1});
        return found;
    }
    /// h(n) - min over the corners of v.n
    [[nodiscard]] double overlapAlong(const Vector<double>& way) const {
        const Vector<double> n = (1 / norm(way)) * way;
        double least = infinity;
        for (const Vector<double>& corner : triangle) least = std::min(least, dot(corner, n));
        return heightAlong(n) - least;
    }
    [[nodiscard]] double heightAlong(const Vector<double>& n) const {
        return supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(n)).height;
    }
    [[nodiscard]] double depth() const {
        const WallPoint found = point();
        return heightAlong(found.normal) - found.distance;
    }
};

/// Half lengths spread evenly in the logarithm over a factor of `aspect`, and a triangle of edges as long as
/// they are, moved in along a random direction until it overlaps.
Pose randomPose(UniformRandom& random, int exponent, double aspect, double overlap) {
    const auto half = [&] { return std::pow(aspect, random.uniform(-1, 0)); };
    const double angle = random.uniform(0, std::numbers::pi);
    const Superquadric shape{1, half(), half(), exponent, exponent};
    Pose pose{shape,
              Axes<double>(Quaternion{std::cos(0.5 * angle), std::sin(0.5 * angle) * direction(random)}),
              extremeContact(shape).smallestRadius * shape.boundingRadius(),
              {},
              {}};
    Triangle triangle;
    for (Vector<double>& corner : triangle) corner = random.uniform(0.1, 1) * direction(random);
    const Vector<double> way = direction(random);
    const double wanted = overlap * pose.ball;
    double near = 3 * shape.boundingRadius(), far = near;
    for (pose.place(triangle, near * way); near > 0 && !(pose.depth() > wanted);
         pose.place(triangle, near * way))
        far = near, near -= 0.5 * pose.ball;
    if (!(near > 0)) return randomPose(random, exponent, aspect, overlap);  // it went by
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (near + far);
        pose.place(triangle, middle * way);
        (pose.depth() > wanted ? near : far) = middle;
    }
    pose.place(triangle, near * way);
    return pose;
}

/// The overlap of the best of many normals, half of them near the one that was found, over the size.
double excessOf(const Pose& pose, UniformRandom& random, std::size_t normals) {
    const Vector<double> found = pose.point().normal;
    const double depth = pose.depth();
    double least = depth;
    for (std::size_t k = 0; k < normals; ++k) {
        const Vector<double> any = direction(random);
        const double off = std::pow(0.1, 1 + static_cast<double>(k % 12) / 2);
        least = std::min(least, pose.overlapAlong(k % 2 == 0 ? any : found + off * any));
    }
    return (depth - least) / pose.shape.boundingRadius();
}

void measure(const Options& options, int exponent, double aspect) {
    UniformRandom random(options.seed);
    std::vector<Pose> poses;
    for (std::size_t k = 0; k < options.triangles; ++k)
        poses.push_back(randomPose(random, exponent, aspect, options.overlap));
    double worst = 0;
    int worse = 0;
    for (const Pose& pose : poses) {
        const double excess = excessOf(pose, random, options.normals);
        worst = std::max(worst, excess);
        worse += excess > 1e-9 ? 1 : 0;
    }
    double sum = 0;  // what is not used would not be computed
    const double time = leastTimeOf(4,
                                    [&] {
                                        for (const Pose& pose : poses) sum += pose.point().distance;
                                    }) /
                        static_cast<double>(options.triangles) * 1e9;
    if (sum == 0.125) fmt::print("#");
    fmt::print("{},{},{},{},{:.2g},{:.4g}\n", exponent, aspect, options.triangles, worse, worst, time);
    std::fflush(stdout);
}

int run(const Options& options) {
    if (options.triangles == 0 || options.normals == 0)
        throw InputError("superquadric-triangles: --triangles and --normals must be more than 0.");
    checkValue("superquadric-triangles", "--overlap", options.overlap, "", {0, 0.5, false, true});
    fmt::print(
        "exponent,largest_ratio_of_half_lengths,triangles,deeper_than_the_least_by_1e-9,"
        "largest_excess_of_depth_per_size,time_ns\n");
    for (int exponent = Superquadric::smallestExponent; exponent <= Superquadric::largestExponent; ++exponent)
        for (const double aspect : {1.0, 2.0, 5.0, 10.0}) measure(options, exponent, aspect);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Prints a row of CSV for each exponent and ratio of half lengths of random superquadrics that touch "
        "a "
        "triangle: at how many some of many normals has a smaller overlap than the one found, by how much at "
        "most, and the processor time of a contact.");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--triangles", o.triangles, "contacts of each row");
    app.add_option("--overlap", o.overlap, "share of the smallest radius of curvature, up to 0.5");
    app.add_option("--normals", o.normals, "that are tried at each contact");
    app.add_option("--seed", o.seed, "of the random numbers");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
