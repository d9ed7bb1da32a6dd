/// Curves of Figures 3, 4, 5 and 9 of Yang, Sega and Harting, "Capillary-bridge forces between solid
/// particles", AIChE Journal 67 (2021) e17350, with the exact solution added: models A to F, whatever their
/// rupture rule allows, at the volumes, angles and radii of the paper. And the exact outlines of the bridges
/// of Figure 6, on and off the axis.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"
#include "Kernel/Features/LiquidBridges/Shared/UnequalToroid.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Reference/FreeDrop.h"

using namespace pendular;

namespace {

using std::numbers::pi;

/// Two spheres and the bridge between them; lengths in R = 2 r1 r2 / (r1 + r2), forces in R gamma.
struct Scene {
    double degrees;         // contact angle
    double relativeVolume;  // V*, in volumes of a sphere of radius R
    double asymmetry = 0;   // (r2 - r1) / (r1 + r2)

    [[nodiscard]] double angle() const { return degrees * pi / 180; }
    [[nodiscard]] double volume() const { return 4 * pi / 3 * relativeVolume; }
    [[nodiscard]] Bodies bodies() const { return {1 / (1 + asymmetry), 1 / (1 - asymmetry)}; }
    [[nodiscard]] BridgeConditions conditions() const {
        return {{bodies().radius1, angle()}, {bodies().radius2, angle()}, volume()};
    }
};

/// Spheres of 70 and 90 cells of the lattice.
constexpr double unequal = (90.0 - 70.0) / (90.0 + 70.0);

constexpr double largestGap = 1.45;  // as in the paper

/// A column of a table: a number for growing gaps, unset where there is none.
struct Curve {
    std::string name;
    std::function<double(double)> at;
};

double inDegrees(double angle) { return angle * (180 / pi); }

/// What a function says of the exact bridge, up to its rupture.
template <class Property>
Curve exactCurve(const std::string& name, const Scene& scene, Property property) {
    const auto rupture = findRupture(scene.conditions());
    const double end = rupture ? rupture->last.gap() : 0;
    return {name, [=](double gap) {
                const auto bridge = gap < end ? solveBridge(scene.conditions(), gap) : std::nullopt;
                return bridge ? property(*bridge) : unset;
            }};
}

/// What a function says of the toroid that holds the volume, where there is one.
template <class Toroids, class Property>
Curve toroidCurve(const std::string& name, Toroids toroids, Property property) {
    return {name, [toroids, property](double gap) mutable {
                const auto toroid = toroids.at(gap);
                return toroid ? property(*toroid) : unset;
            }};
}

/// A law's force up to its rupture distance; stretch: of the separation.
template <class Law>
Curve lawCurve(const std::string& name, const Scene& scene, double stretch = 1) {
    Law law;
    law.setLiquidBridgeVolume(scene.volume());
    law.setContactAngle(scene.angle());
    law.setSurfaceTension(1);
    const auto bridge = law.prepare(scene.bodies());
    return {name, [=](double gap) { return gap < bridge.range() ? bridge.force(stretch * gap) : unset; }};
}

Curve cutAt(double end, const Curve& curve) {
    return {curve.name, [=](double gap) { return gap < end ? curve.at(gap) : unset; }};
}

constexpr auto exactForce = [](const CapillaryBridge& bridge) { return bridge.force(); };

std::vector<Curve> forcesBetweenEqualSpheres(const Scene& scene) {
    const double lian = lianRupture(scene.volume(), scene.angle());
    const ToroidsOfVolume toroids(scene.volume(), scene.angle());
    return {
        exactCurve("exact", scene, exactForce),
        cutAt(lian, toroidCurve("lian", toroids, [](const Toroid& t) { return t.gorgeForce(); })),
        cutAt(lian, toroidCurve("pietsch_rumpf", toroids, [](const Toroid& t) { return t.boundaryForce(); })),
        lawCurve<LiquidBridgeClassicalWillett>("classical_willett", scene),
        lawCurve<LiquidBridgeLambert>("rabinovich", scene),
        lawCurve<LiquidBridgeMikami>("mikami", scene),
        lawCurve<LiquidBridgeMikami>("mikami_half_separation", scene, 0.5)};
}

std::vector<Curve> forcesBetweenUnequalSpheres(const Scene& scene) {
    const UnequalToroidsOfVolume toroids(scene.volume(), scene.angle(), scene.asymmetry);
    return {exactCurve("exact", scene, exactForce),
            lawCurve<LiquidBridgeClassicalWillett>("classical_willett", scene),
            cutAt(lianRupture(scene.volume(), scene.angle()),
                  toroidCurve("chen", toroids, [](const UnequalToroid& t) { return t.gorgeForce(); }))};
}

/// The filling angles at the first and the second sphere.
std::vector<Curve> fillingAngles(const Scene& scene) {
    std::vector<Curve> curves{
        exactCurve("exact_first", scene,
                   [](const CapillaryBridge& b) { return inDegrees(b.firstFillingAngle()); }),
        exactCurve("exact_second", scene,
                   [](const CapillaryBridge& b) { return inDegrees(b.secondFillingAngle()); })};
    for (const std::size_t body : {0, 1}) {
        const std::string name = body == 0 ? "toroid_first" : "toroid_second";
        const Curve toroid =
            scene.asymmetry == 0
                ? toroidCurve(name, ToroidsOfVolume(scene.volume(), scene.angle()),
                              [](const Toroid& t) { return inDegrees(t.fillingAngle); })
                : toroidCurve(name, UnequalToroidsOfVolume(scene.volume(), scene.angle(), scene.asymmetry),
                              [body](const UnequalToroid& t) {
                                  return inDegrees(std::asin(t.contactRadius[body] * t.curvature[body]));
                              });
        curves.push_back(cutAt(lianRupture(scene.volume(), scene.angle()), toroid));
    }
    return curves;
}

/// Nothing where a curve has no value, so that charts have a gap there.
std::string cell(double value) { return isSet(value) ? fmt::format("{:.5g}", value) : std::string(); }

using Curves = std::vector<Curve> (*)(const Scene&);

void writeFigure(const std::filesystem::path& path, const std::vector<Scene>& scenes, Curves curves,
                 std::string_view unit, int points) {
    std::string header = "contact_angle_deg,volume_over_sphere,radius_ratio,separation_over_R";
    for (const Curve& curve : curves(scenes.front())) header += fmt::format(",{}_{}", curve.name, unit);
    CsvFile file(path, header);
    for (const Scene& scene : scenes) {
        const auto columns = curves(scene);
        for (int k = 0; k < points; ++k) {
            const double gap = largestGap * k / (points - 1);
            std::string line = fmt::format("{},{},{:.5g},{:.5g}", scene.degrees, scene.relativeVolume,
                                           scene.bodies().radius2 / scene.bodies().radius1, gap);
            bool any = false;
            for (const Curve& curve : columns) {
                const double value = curve.at(gap);
                any = any || isSet(value);
                line += fmt::format(",{}", cell(value));
            }
            if (any) file.line(line);
        }
    }
    file.close();
}

struct Point {
    double x, z;  // in R, from the apex of the lower sphere; z along the axis
};

/// The meridian of a bridge on the axis and its mirror image, or the circle of a drop off the axis, of which
/// the spheres cover the rest.
std::vector<Point> outlineOfLiquid(const Scene& scene, double gap, int points) {
    const auto [r1, r2] = scene.bodies();
    std::vector<Point> outline;
    if (const auto drop = findFreeDrop(scene.conditions(), gap)) {
        const double between = r1 + r2 + gap, d1 = r1 + drop->firstHeight, d2 = r2 + drop->secondHeight;
        const double along = 0.5 * (between + (d1 - d2) * (d1 + d2) / between);
        const double aside = std::sqrt((d1 - along) * (d1 + along));
        for (int k = 0; k < points; ++k) {
            const double turn = 2 * pi * k / (points - 1);
            outline.push_back(
                {aside + drop->radius * std::cos(turn), along - r1 + drop->radius * std::sin(turn)});
        }
        return outline;
    }
    const auto bridge = solveBridge(scene.conditions(), gap);
    if (!bridge) return outline;
    for (const MeridianPoint& point : bridge->profile(points)) outline.push_back({point.radius, point.axial});
    for (auto k = static_cast<std::size_t>(points); k-- > 0;)
        outline.push_back({-outline[k].x, outline[k].z});
    return outline;
}

/// Figure 6: outlines of the liquid (part 0) and of the spheres (1, 2), with the force in equilibrium and
/// that of a bridge which is kept on the axis.
void writeFigure6(const std::filesystem::path& path, int points) {
    CsvFile file(path,
                 "contact_angle_deg,volume_over_sphere,separation_over_R,part,x_over_R,z_over_R,"
                 "force_over_R_gamma,force_on_axis_over_R_gamma");
    struct Case {
        Scene scene;
        double gap;
    };
    for (const auto& [scene, gap] : {Case{{90, 0.5}, 0.572}, Case{{132, 0.5}, 0.572}, Case{{90, 0.65}, 1.144},
                                     Case{{132, 0.65}, 1.144}}) {
        const auto bridge = solveBridge(scene.conditions(), gap);
        const double onAxis = bridge ? bridge->pinnedForce() : unset;
        const double force = findFreeDrop(scene.conditions(), gap) ? 0 : onAxis;
        std::array<std::vector<Point>, 3> outlines{outlineOfLiquid(scene, gap, points)};
        for (int k = 0; k < points; ++k) {
            const double turn = 2 * pi * k / (points - 1);
            outlines[1].push_back({std::cos(turn), std::sin(turn) - 1});
            outlines[2].push_back({std::cos(turn), std::sin(turn) + 1 + gap});
        }
        for (std::size_t part = 0; part < outlines.size(); ++part)
            for (const Point& point : outlines[part])
                file.row(scene.degrees, scene.relativeVolume, gap, part, point.x, point.z, force, onAxis);
    }
    file.close();
}

void writeFigures(const std::filesystem::path& folder, int points) {
    checkValue("bridge-figures", "points", points, "", {2, 1e5});
    const std::vector<Scene> angles{{34.6, 0.133}, {48, 0.133}, {60, 0.133}}, volumes{{48, 0.07}, {48, 0.25}};
    std::vector<Scene> all = angles, allUnequal;
    all.insert(all.end(), volumes.begin(), volumes.end());
    for (Scene scene : all) {
        scene.asymmetry = unequal;
        allUnequal.push_back(scene);
    }
    constexpr std::string_view force = "force_over_R_gamma";
    writeFigure(folder / "figure-3.csv", angles, forcesBetweenEqualSpheres, force, points);
    writeFigure(folder / "figure-4.csv", volumes, forcesBetweenEqualSpheres, force, points);
    writeFigure(folder / "figure-5.csv", allUnequal, forcesBetweenUnequalSpheres, force, points);
    writeFigure6(folder / "figure-6.csv", std::max(points, 100));
    all.insert(all.end(), allUnequal.begin(), allUnequal.end());
    writeFigure(folder / "figure-9.csv", all, fillingAngles, "filling_angle_deg", points);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Curves of Figures 3, 4, 5, 6 and 9 of Yang, Sega and Harting (2021), with the exact ones, as CSV.");
    std::string folder = "bridge-figures";
    int points = 59;
    app.add_option("--output", folder,
                   "folder for figure-3.csv, figure-4.csv, figure-5.csv, figure-6.csv, figure-9.csv")
        ->capture_default_str();
    app.add_option("--points", points, "separations from 0 to 1.45 R")->capture_default_str();
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        writeFigures(folder, points);
        return 0;
    });
}
