#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Core/Walls/WallSurface.h"
#include "Tools/Snapshot/Camera.h"
#include "Tools/Snapshot/Colours.h"
#include "Tools/Snapshot/Legend.h"

namespace pendular::snapshot {

/// The shape of a grain that is no ball: a superquadric (Kernel/Features/Superquadrics/Superquadric.h).
struct Solid {
    std::array<Vector<double>, 3> axes;  // m, the half axes in space
    double n1, n2;                       // exponents
};
struct Ball {
    Vector<double> centre;  // m
    double radius;          // m
    Colour colour;
    std::optional<Solid> solid = {};
};
struct Rod {
    Vector<double> begin, end;  // m
    double radius;              // m
    Colour colour;
    double transparency;
};
struct Picture {
    std::vector<Ball> balls;
    std::vector<Rod> rods;
    std::vector<Polygon> walls;
    std::vector<std::pair<Vector<double>, Vector<double>>> wallEdges;
    std::optional<Legend> legend;
    std::string caption;  // in the lower left corner
    double wallTransparency = 0.85;
    double size = 1;  // m, of the scene, about
};

/// A picture in the language of POV-Ray 3.7. One unit is the scene's size, so that nothing is below the
/// renderer's own tolerances, which are lengths; the eye is the origin.
class PovScene {
public:
    PovScene(const Picture& what, const Camera& from) : picture(what), camera(from) {}

    [[nodiscard]] std::string text() {
        writeSurroundings();
        writeGrains();
        writeWalls();
        if (picture.legend) writeLegend(*picture.legend);
        if (!picture.caption.empty()) writeCaption();
        return std::move(out);
    }

private:
    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(out), format, std::forward<Values>(values)...);
    }
    /// A direction.
    static std::string vector(const Vector<double>& v) {
        return fmt::format("<{:.7g},{:.7g},{:.7g}>", v.x, v.y, v.z);
    }
    /// A point of the scene, relative to the eye.
    [[nodiscard]] std::string point(const Vector<double>& p) const {
        return vector((1 / picture.size) * (p - camera.eye));
    }
    static std::string colour(const Colour& c) {
        return fmt::format("srgb <{:.3f},{:.3f},{:.3f}>", c.red, c.green, c.blue);
    }

    void writeSurroundings() {
        put("#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level 40 }}\n"
            "background {{ color srgb 1 }}\n");
        put("camera {{ perspective location 0 direction {} right {} up {} }}\n", vector(camera.forward),
            vector(2 * Camera::slope() * camera.aspect() * camera.right),
            vector(2 * Camera::slope() * camera.up));
        // The sun behind the left shoulder, and light from the right and from below without shadows.
        const Vector<double> sun = 1.2 * camera.up - 0.7 * camera.right - camera.forward;
        const Vector<double> fill = camera.right - camera.forward - 0.4 * camera.up;
        put("light_source {{ {} color rgb 0.85 parallel point_at 0 }}\n", vector(1e3 * sun));
        put("light_source {{ {} color rgb 0.3 parallel point_at 0 shadowless }}\n", vector(1e3 * fill));
        put("#declare Grain = finish {{ ambient 0.22 diffuse 0.8 specular 0.2 roughness 0.03 }}\n"
            "#declare Glass = finish {{ ambient 0.5 diffuse 0.3 }}\n"
            "#declare Flat = finish {{ ambient 0 diffuse 0 emission 1 }}\n");
    }
    void writeGrains() {
        for (const Ball& ball : picture.balls) {
            if (ball.solid) {
                writeSolid(ball);
                continue;
            }
            put("sphere {{ {},{:.7g} pigment {{ {} }} finish {{ Grain }} }}\n", point(ball.centre),
                ball.radius / picture.size, colour(ball.colour));
        }
        for (const Rod& rod : picture.rods)
            if (norm(rod.end - rod.begin) > 0)
                put("cylinder {{ {},{},{:.7g} pigment {{ {} transmit {:.3f} }} finish {{ Grain }} }}\n",
                    point(rod.begin), point(rod.end), rod.radius / picture.size, colour(rod.colour),
                    rod.transparency);
    }
    /// POV-Ray's superellipsoid <e, n> has the exponents 2/e across its axis and 2/n along it.
    void writeSolid(const Ball& ball) {
        const Solid& solid = *ball.solid;
        const auto scaled = [&](std::size_t k) {
            const Vector<double> axis = (1 / picture.size) * solid.axes[k];
            return fmt::format("{:.7g},{:.7g},{:.7g}", axis.x, axis.y, axis.z);
        };
        const Vector<double> centre = (1 / picture.size) * (ball.centre - camera.eye);
        if (solid.n1 == 2 && solid.n2 == 2) put("sphere {{ 0,1");
        else put("superellipsoid {{ <{:.7g},{:.7g}>", 2 / solid.n2, 2 / solid.n1);
        put(" pigment {{ {} }} finish {{ Grain }} matrix <{},{},{},{:.7g},{:.7g},{:.7g}> }}\n",
            colour(ball.colour), scaled(0), scaled(1), scaled(2), centre.x, centre.y, centre.z);
    }
    void writeWalls() {
        if (picture.walls.empty()) return;
        put("mesh {{\n");
        for (const Polygon& polygon : picture.walls)
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
                if (norm(cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0])) >
                    1e-12 * picture.size * picture.size)
                    put("triangle {{ {},{},{} }}\n", point(polygon[0]), point(polygon[k]),
                        point(polygon[k + 1]));
        put("pigment {{ srgb <0.55,0.6,0.66> transmit {:.3f} }} finish {{ Glass }} no_shadow }}\n",
            picture.wallTransparency);
        for (const auto& [begin, end] : picture.wallEdges)
            put("cylinder {{ {},{},0.0015 pigment {{ srgb 0.35 }} finish {{ Flat }} no_shadow }}\n",
                point(begin), point(end));
    }

    /// The place of a point of the picture (x from -aspect to aspect, y from -1 to 1) right before the eye.
    [[nodiscard]] Vector<double> onScreen(double x, double y) const {
        return near * (camera.forward + Camera::slope() * (x * camera.right + y * camera.up));
    }
    [[nodiscard]] double onScreen(double length) const { return near * Camera::slope() * length; }

    void writeText(std::string_view text, double x, double y, double height, bool centred = false) {
        std::string quoted;
        for (const char c : text) quoted += c == '"' || c == '\\' ? std::string("'") : std::string(1, c);
        const std::string name = fmt::format("Text{}", texts++);
        put("#declare {0} = text {{ internal 2 \"{1}\" 0.01, 0 pigment {{ srgb 0.1 }} finish {{ Flat }} "
            "no_shadow }}\n",
            name, quoted);
        const double scale = onScreen(height);
        const Vector<double> corner = onScreen(x, y);
        put("object {{ {} {} matrix "
            "<{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},"
            "{:.7g}> }}\n",
            name, centred ? fmt::format("translate -0.5*max_extent({}).x*x", name) : std::string(),
            scale * camera.right.x, scale * camera.right.y, scale * camera.right.z, scale * camera.up.x,
            scale * camera.up.y, scale * camera.up.z, scale * camera.forward.x, scale * camera.forward.y,
            scale * camera.forward.z, corner.x, corner.y, corner.z);
    }
    void writeRectangle(double x0, double y0, double x1, double y1, const Colour& c) {
        const std::string a = vector(onScreen(x0, y0)), b = vector(onScreen(x1, y0)),
                          d = vector(onScreen(x1, y1)), e = vector(onScreen(x0, y1));
        put("mesh {{ triangle {{ {0},{1},{2} }} triangle {{ {0},{2},{3} }} pigment {{ {4} }} finish {{ Flat "
            "}} "
            "no_shadow }}\n",
            a, b, d, e, colour(c));
    }
    void writeLegend(const Legend& legend) {
        const LegendPlace place = placeOf(legend, camera.aspect());
        const double letters = place.letters, left = place.left, wide = place.bar, bottom = -0.6, top = 0.6;
        const bool isBar = legend.map || legend.marks.empty();
        const double titleHeight = isBar ? top : bottom + (top - bottom) * legend.marks.front().place;
        writeText(legend.title, camera.aspect() - 0.5 * place.strip, titleHeight + 0.12, letters, true);
        if (legend.map) {
            constexpr int shades = 128;
            for (int k = 0; k < shades; ++k)
                writeRectangle(left, bottom + (top - bottom) * k / shades, left + wide,
                               bottom + (top - bottom) * (k + 1) / shades,
                               legend.map->at((k + 0.5) / shades));
        }
        for (const Legend::Mark& mark : legend.marks) {
            const double y = bottom + (top - bottom) * mark.place;
            if (mark.square) writeRectangle(left, y - 0.5 * wide, left + wide, y + 0.5 * wide, *mark.square);
            else writeRectangle(left + wide, y - 0.003, left + 1.25 * wide, y + 0.003, {0.1, 0.1, 0.1});
            writeText(mark.text, place.textLeft(), y - 0.33 * letters, letters);
        }
    }
    void writeCaption() {
        constexpr double margin = 0.04;
        const double room = 2 * (camera.aspect() - margin) / widthOf(picture.caption);
        writeText(picture.caption, -camera.aspect() + margin, -0.96, std::min(0.07, room));
    }

    static constexpr double near = 0.3;  // of the scene's size: before all grains

    const Picture& picture;
    const Camera& camera;
    std::string out;
    int texts = 0;
};

}  // namespace pendular::snapshot
