/// Makes a clump: from a list of spheres, or by filling a mesh with spheres; its mass, centre and inertia,
/// how far it is from the mesh, and a picture.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Meshes/MeshSolid.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/RigidBodies/SphereGroups.h"
#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Clump/MeshFilling.h"
#include "Tools/Snapshot/Render.h"

using namespace pendular;

namespace {

constexpr std::string_view program = "clump";

struct Options {
    std::string spheres, mesh, method = "surface", output, picture, errors;
    double unit = 1, density = 1, smallest = 0, volumeError = 0;
    std::size_t most = 32;
    int cells = 40;
    double overlap = 0.6;
    std::uint64_t seed = 1;
    bool sceneOnly = false;
};

std::vector<Ball> fill(const std::vector<Triangle>& mesh, const Options& o, std::size_t most) {
    const clump::Filling filling{most, o.smallest, o.cells, o.overlap, o.seed};
    if (o.method == "surface") return clump::growFromSurface(mesh, filling);
    return clump::fillFromWithin(mesh, filling);
}

/// How a clump differs from the mesh, relative.
struct Errors {
    double volume, inertia, surface, centre;  // inertia: of the worst principal moment; centre: over the size
};
Errors errorsOf(const MassProperties& made, double madeArea, const MassProperties& solid, double area) {
    const Vec3D moments = principalAxes(made.inertia).moments, exact = principalAxes(solid.inertia).moments;
    double worst = 0;
    for (int k = 0; k < 3; ++k)
        if (const double error = moments[k] / exact[k] - 1; std::abs(error) > std::abs(worst)) worst = error;
    return {made.volume / solid.volume - 1, worst, madeArea / area - 1,
            (made.centre - solid.centre).norm() / std::cbrt(solid.volume)};
}

constexpr double tolerance = 1e-5;  // of volume, inertia and surface of many spheres

void describe(const MassProperties& p, std::size_t spheres, double area, double density) {
    const PrincipalAxes principal = principalAxes(density * p.inertia);
    fmt::print("spheres {}\nvolume_m3 {:.12g}\nmass_kg {:.12g}\nsurface_m2 {:.9g}\n", spheres, p.volume,
               density * p.volume, area);
    fmt::print("centre_m {:.12g} {:.12g} {:.12g}\n", p.centre.x(), p.centre.y(), p.centre.z());
    const Eigen::Matrix3d i = density * p.inertia;
    fmt::print("inertia_kg_m2 xx {:.12g} yy {:.12g} zz {:.12g} xy {:.12g} xz {:.12g} yz {:.12g}\n", i(0, 0),
               i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
    fmt::print("principal_moments_kg_m2 {:.12g} {:.12g} {:.12g}\nerror_at_most {:.2g}\n",
               principal.moments[0], principal.moments[1], principal.moments[2], p.error);
}

void writeSpheres(const std::vector<Ball>& spheres, const std::string& path) {
    CsvFile file(path, "x_m,y_m,z_m,radius_m");
    for (const Ball& ball : spheres) file.row(ball.centre.x(), ball.centre.y(), ball.centre.z(), ball.radius);
    file.close();
    fmt::print("wrote {}\n", path);
}

void drawPicture(const std::vector<Ball>& spheres, const std::vector<Triangle>& mesh, const Options& o) {
    snapshot::Picture picture;
    picture.wallTransparency = 0.6;
    std::vector<Vector<double>> points;
    for (const Ball& ball : spheres) {
        const Vector<double> centre = toVector(ball.centre);
        picture.balls.push_back({centre, ball.radius, {0.75, 0.55, 0.25}});
        for (const double sign : {-0.9, 0.9})
            for (const Vector<double>& axis : {Vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
                points.push_back(centre + (sign * ball.radius) * axis);
    }
    for (const Triangle& t : mesh) {
        picture.walls.push_back({t.begin(), t.end()});
        points.insert(points.end(), t.begin(), t.end());
    }
    picture.size = 0;
    for (const Vector<double>& p : points) picture.size = std::max(picture.size, norm(p - points.front()));
    constexpr int width = 800, height = 600;  // pixels
    const snapshot::Camera camera = snapshot::cameraOn(points, {0.4, -1, 0.35}, width, height, 0);
    fmt::print("wrote {}\n", snapshot::draw(picture, camera, o.picture, width, height, o.sceneOnly).string());
}

/// The table of errors over the number of spheres: 1, 2, 3, 4, 6, 8, 12, ... up to the most.
void writeErrors(const std::vector<Triangle>& mesh, const MassProperties& solid, const Options& o) {
    CsvFile file(o.errors, "method,spheres,volume_error,inertia_error,surface_error,centre_error");
    std::size_t before = 0;
    const double area = areaOfMesh(mesh);
    const std::vector<Ball> all = fill(mesh, o, o.most);
    for (std::size_t base = 1; base <= all.size(); base *= 2)
        for (const std::size_t count : {base, base + base / 2}) {
            if (count <= before || count > all.size()) continue;
            before = count;
            const std::span<const Ball> some = std::span(all).first(count);  // both ways add one by one
            const Errors e =
                errorsOf(unionOfSpheres(some, tolerance), surfaceOfUnion(some, tolerance), solid, area);
            file.row(o.method, count, e.volume, e.inertia, e.surface, e.centre);
        }
    file.close();
    fmt::print("wrote {}\n", o.errors);
}

/// The fewest spheres that have an error of the volume below what is asked for, or all.
std::vector<Ball> fewest(std::vector<Ball> spheres, const MassProperties& solid, double volumeError) {
    for (std::size_t count = 1; volumeError > 0 && count < spheres.size(); ++count)
        if (std::abs(unionOfSpheres(std::span(spheres).first(count), 1e-3).volume / solid.volume - 1) <
            volumeError) {
            spheres.resize(count);
            break;
        }
    return spheres;
}

void check(const Options& o) {
    if (o.spheres.empty() == o.mesh.empty())
        throw InputError(fmt::format("{}: give either --spheres or --mesh.", program));
    if (o.mesh.empty() && !o.errors.empty())
        throw InputError(fmt::format("{}: --errors compares with a mesh; give --mesh.", program));
    checkValue(program, "unit", o.unit, "m", positive);
    checkValue(program, "density", o.density, "kg/m^3", positive);
    checkValue(program, "number of spheres", static_cast<double>(o.most), "", {1, 10000});
    checkValue(program, "smallest radius", o.smallest, "m", notNegative);
    checkValue(program, "error of the volume", o.volumeError, "", {0, 1});
    checkValue(program, "cells", o.cells, "", {4, 400});
    checkValue(program, "overlap", o.overlap, "", fromZeroTo(1));
}

int run(const Options& o) {
    check(o);
    std::vector<Triangle> mesh;
    std::vector<Ball> spheres;
    if (o.mesh.empty()) spheres = readSpheres(o.spheres, o.unit);
    else {
        mesh = MeshRegion::fromFile(o.mesh, o.unit).getTriangles();  // throws where it is not closed
        const MassProperties solid = massOfMesh(mesh);
        spheres = fewest(fill(mesh, o, o.most), solid, o.volumeError);
        if (spheres.empty())
            throw InputError(fmt::format("{}: no sphere of a radius of at least {:.6g} m is in the mesh.",
                                         program, o.smallest));
        fmt::print("# the mesh\n");
        describe(solid, 0, areaOfMesh(mesh), o.density);
        if (!o.errors.empty()) writeErrors(mesh, solid, o);
    }
    const MassProperties made = unionOfSpheres(spheres, spheres.size() > 16 ? tolerance : 1e-10);
    const double area = surfaceOfUnion(spheres, tolerance);
    if (const auto gap = gapInClump(spheres)) writeToLog(fmt::format("Warning: {}: {}.\n", program, *gap));
    fmt::print("# the spheres\n");
    describe(made, spheres.size(), area, o.density);
    if (!mesh.empty()) {
        const Errors e = errorsOf(made, area, massOfMesh(mesh), areaOfMesh(mesh));
        fmt::print(
            "# against the mesh: volume {:+.3g}, worst principal moment {:+.3g}, surface {:+.3g}, centre "
            "{:.3g}\n",
            e.volume, e.inertia, e.surface, e.centre);
    }
    if (!o.output.empty()) writeSpheres(spheres, o.output);
    if (!o.picture.empty()) drawPicture(spheres, mesh, o);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Makes a clump from a list of spheres, or fills a closed mesh with spheres; prints volume, mass, "
        "centre\nand inertia of the union of the spheres (and of the mesh, by the divergence theorem).\n"
        "A driver reads the spheres by ClumpTemplate::fromFile().");
    Options o;
    app.option_defaults()->always_capture_default();
    app.add_option("--spheres", o.spheres, "file of rows x y z radius, parted by commas or blanks");
    app.add_option("--mesh", o.mesh, "closed mesh: STL, OBJ, PLY, or rows of nine numbers");
    app.add_option("--unit-m", o.unit, "m for one unit of the file");
    app.add_option("--density-kg-per-m3", o.density, "of the solid");
    app.add_option(
           "--method", o.method,
           "surface: spheres grow from points of the surface until they meet another one (Ferellec and "
           "McDowell 2010); within: in the deepest places of a map of distances (Angelidakis et al. 2021)")
        ->check(CLI::IsMember({"surface", "within"}));
    app.add_option("--number", o.most, "of spheres, at most");
    app.add_option("--smallest-radius-m", o.smallest, "none is smaller");
    app.add_option("--volume-error", o.volumeError,
                   "as few spheres as have a volume that differs by less from the mesh's, relative; 0: all");
    app.add_option("--cells", o.cells, "of the map, along the longest side (within)");
    app.add_option("--overlap", o.overlap,
                   "share of a sphere's radius that the next ones may reach into (within)");
    app.add_option("--seed", o.seed, "the order of spheres of one size (surface)");
    app.add_option("--output", o.output, "file for the spheres, CSV");
    app.add_option("--errors", o.errors, "file for the errors over the number of spheres, CSV");
    app.add_option("--picture", o.picture, "PNG of the spheres in the mesh; needs POV-Ray");
    app.add_flag("--scene-only", o.sceneOnly, "writes what POV-Ray reads (.pov), and does not run it");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(o); });
}
