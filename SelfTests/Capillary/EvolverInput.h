#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

namespace pendular {

/// The input of Surface Evolver (K. Brakke; Debian package evolver-nox) for the liquid between two spheres of
/// any radii: a prism of six faces between them, moved aside by a length, whose liquid may slide over both.
/// The first sphere's apex is the origin. The wetted areas and the volume below the contact lines, which have
/// no faces, are integrals along these lines: with w the distance from a sphere's centre along the axis
/// towards the liquid, the area is that of (x dy - y dx) R / (R + w), and the volume below the sphere's
/// surface that of (x dy - y dx) (c/2 +- (R^2 + R w + w^2) / (3 (R + w))), the curl of which is its height.
class EvolverInput {
public:
    EvolverInput(const BridgeConditions& given, double gapBetween, double aside)
        : conditions(given), gap(gapBetween) {
        text = fmt::format("PARAMETER gap = {:.17g}\nGRAVITY_CONSTANT 0\n", gap);
        addSphere(1, conditions.first, "-R1", "(z + R1)", "+", "-1 * ");
        addSphere(2, conditions.second, "(gap + R2)", "(gap + R2 - z)", "-", "-1 * ");
        addPrism(aside);
    }
    [[nodiscard]] const std::string& str() const { return text; }

private:
    void addSphere(int number, const WettedBody& body, const std::string& centre, const std::string& w,
                   const std::string& sign, const std::string& orientation) {
        const std::string R = fmt::format("R{}", number);
        const std::string area = fmt::format("wetting{} * {} / ({} + {})", number, R, R, w);
        const std::string height = fmt::format("({} / 2 {} ({}^2 + {} * {} + {}^2) / (3 * ({} + {})))",
                                               centre, sign, R, R, w, w, R, w);
        text += fmt::format(
            "PARAMETER {} = {:.17g}\nPARAMETER wetting{} = {:.17g}\n"
            "CONSTRAINT {}\nFORMULA: x^2 + y^2 + {}^2 = {}^2\n"
            "ENERGY:\ne1: -y * {}\ne2: x * {}\ne3: 0\n"
            "CONTENT:\nc1: {}-1 * y * {}\nc2: {}x * {}\nc3: 0\n",
            R, body.radius, number, -std::cos(body.contactAngle), number, w, R, area, area, orientation,
            height, orientation, height);
    }
    void addPrism(double aside) {
        constexpr int sides = 6;
        const double width = 0.5 * std::min(conditions.first.radius, conditions.second.radius);
        const auto onSphere = [&](int body, int k) {
            const double turn = 2 * std::numbers::pi * k / sides;
            const double x = aside + width * std::cos(turn), y = width * std::sin(turn), s = x * x + y * y;
            const double r1 = conditions.first.radius, r2 = conditions.second.radius;
            const double z = body == 1 ? std::sqrt(r1 * r1 - s) - r1 : gap + r2 - std::sqrt(r2 * r2 - s);
            return fmt::format("{:.17g} {:.17g} {:.17g} constraint {}", x, y, z, body);
        };
        const auto lines = [&](const char* what, auto&& line) {
            text += what;
            for (int k = 0; k < sides; ++k) text += line(k, (k + 1) % sides);
        };
        lines("VERTICES\n", [&](int k, int) { return fmt::format("{} {}\n", k + 1, onSphere(1, k)); });
        lines("", [&](int k, int) { return fmt::format("{} {}\n", sides + k + 1, onSphere(2, k)); });
        lines("EDGES\n",
              [](int k, int next) { return fmt::format("{} {} {} constraint 1\n", k + 1, k + 1, next + 1); });
        lines("", [](int k, int next) {
            return fmt::format("{} {} {} constraint 2\n", sides + k + 1, sides + k + 1, sides + next + 1);
        });
        lines("",
              [](int k, int) { return fmt::format("{} {} {}\n", 2 * sides + k + 1, k + 1, sides + k + 1); });
        lines("FACES\n", [](int k, int next) {
            return fmt::format("{} {} {} {} {}\n", k + 1, k + 1, 2 * sides + next + 1, -(sides + k + 1),
                               -(2 * sides + k + 1));
        });
        text += fmt::format("BODIES\n1 1 2 3 4 5 6 volume {:.17g}\n", conditions.volume);
    }

    BridgeConditions conditions;
    double gap;
    std::string text;
};

}  // namespace pendular
