#include "Kernel/Analysis/Output/ShapeFields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"

namespace pendular {
namespace {

constexpr int circles = 12, corners = 20;  // of latitude, without the poles; on each of them

/// Unit, from one pole to the other: that one, the circles, the other one. The circles avoid the axes
/// between, where edges of sharp shapes are nearest to them.
std::vector<Vector<double>> normals() {
    std::vector<Vector<double>> all{{0, 0, 1}};
    for (int k = 0; k < circles; ++k)
        for (int j = 0; j < corners; ++j) {
            const double down = std::numbers::pi * (k + 1) / (circles + 1);
            const double around = 2 * std::numbers::pi * (j + 0.5) / corners;
            all.push_back(
                {std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)});
        }
    all.push_back({0, 0, -1});
    return all;
}

/// Outward polygons on the points of normals(), which begin at a place.
void addPolygons(PolyData& data, std::int32_t first) {
    const auto at = [&](int circle, int corner) { return first + 1 + circle * corners + corner % corners; };
    const auto add = [&](std::initializer_list<std::int32_t> polygon) {
        data.corners.insert(data.corners.end(), polygon);
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
    };
    const std::int32_t last = first + 1 + circles * corners;
    for (int j = 0; j < corners; ++j) {
        add({first, at(0, j), at(0, j + 1)});
        for (int k = 0; k + 1 < circles; ++k) add({at(k, j), at(k + 1, j), at(k + 1, j + 1), at(k, j + 1)});
        add({last, at(circles - 1, j + 1), at(circles - 1, j)});
    }
}

}  // namespace

void addShapeFields(const ParticleStore& grains, const GrainShapes& shapes, PolyData& points) {
    std::vector<float> lengths, orientation;
    std::vector<std::int32_t> first, second;
    for (const std::uint32_t place : grains.place) {
        const auto [shape, axes, edgeRadius] = shapes.shapeAt(grains, place);
        for (const double length : {shape.a, shape.b, shape.c}) lengths.push_back(static_cast<float>(length));
        first.push_back(shape.n1), second.push_back(shape.n2);
        for (const auto part : vectorAxes)
            for (const Vector<double>* axis : {&axes.x, &axes.y, &axes.z})
                orientation.push_back(static_cast<float>((*axis).*part));
    }
    points.pointFields.push_back({"half_lengths_m", 3, std::move(lengths)});
    points.pointFields.push_back({"n1", 1, std::move(first)});
    points.pointFields.push_back({"n2", 1, std::move(second)});
    points.pointFields.push_back({"orientation", 9, std::move(orientation)});
}

PolyData shapeSurfaces(const ParticleStore& grains, const GrainShapes& shapes) {
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    std::vector<std::int32_t> identity, body;
    const std::vector<Vector<double>> directions = normals();
    for (const std::uint32_t place : grains.place) {
        if (!shapes.isShaped(grains, place)) continue;
        const auto [shape, axes, edgeRadius] = shapes.shapeAt(grains, place);
        const auto lanes = SuperquadricLanes<double>::from(shape);
        const auto first = static_cast<std::int32_t>(data.points.size());
        for (const Vector<double>& n : directions)
            data.points.push_back(grains.translation[place].position +
                                  (edgeRadius > 0 ? shapes.farthest(grains, place, axes.turn(n))
                                                  : axes.turn(supportPoint(lanes, n).point)));
        addPolygons(data, first);
        const std::uint32_t own = grains.identity[place];
        identity.resize(data.ends.size(), static_cast<std::int32_t>(own));
        body.resize(data.ends.size(), static_cast<std::int32_t>(grains.bodies.bodyOf(own)));
    }
    data.cellFields = {{"identity", 1, std::move(identity)}, {"body", 1, std::move(body)}};
    return data;
}

std::optional<PolyData> shapeSurfaces(const PolyData& points) {
    const PolyDataField
        *const lengths = points.pointField("half_lengths_m"),
               *const first = points.pointField("n1"), *const second = points.pointField("n2"),
               *const turns = points.pointField("orientation"), *const own = points.pointField("identity");
    if (!lengths || !first || !second || !turns || !own || lengths->components != 3 ||
        first->components != 1 || second->components != 1 || turns->components != 9 || own->components != 1)
        return {};
    PolyData data;
    data.kind = PolyData::Cells::Polygons;
    std::vector<std::int32_t> identity;
    const auto* const identities = std::get_if<std::vector<std::int32_t>>(&own->numbers);
    const std::vector<Vector<double>> directions = normals();
    for (std::size_t k = 0; identities && k < points.points.size(); ++k) {
        const auto exponent = [](double n) { return n >= 2 ? static_cast<int>(std::min(n, 8.0)) : 2; };
        const Superquadric shape{lengths->at(3 * k), lengths->at(3 * k + 1), lengths->at(3 * k + 2),
                                 exponent(first->at(k)), exponent(second->at(k))};
        const bool isBall = shape.isEllipsoid() && shape.a == shape.b && shape.b == shape.c;
        if (isBall || !(shape.a > 0 && shape.b > 0 && shape.c > 0)) continue;
        const auto lanes = SuperquadricLanes<double>::from(shape);
        const auto place = static_cast<std::int32_t>(data.points.size());
        for (const Vector<double>& n : directions) {
            const Vector<double> p = supportPoint(lanes, n).point;
            const auto row = [&](std::size_t r) {
                return turns->at(9 * k + 3 * r) * p.x + turns->at(9 * k + 3 * r + 1) * p.y +
                       turns->at(9 * k + 3 * r + 2) * p.z;
            };
            data.points.push_back(points.points[k] + Vector<double>{row(0), row(1), row(2)});
        }
        addPolygons(data, place);
        identity.resize(data.ends.size(), (*identities)[k]);
    }
    data.cellFields = {{"identity", 1, std::move(identity)}};
    return data;
}

}  // namespace pendular
