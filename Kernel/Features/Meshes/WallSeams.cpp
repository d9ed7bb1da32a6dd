#include "Kernel/Features/Meshes/WallSeams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Walls/WallImages.h"
#include "Kernel/Features/Meshes/PartCover.h"

namespace pendular {

namespace {

class SeamSearch {
public:
    SeamSearch(const WallHandler& wallHandler, double smallest, double largest)
        : walls(wallHandler), joined(5e-4 * smallest), apart(0.25 * largest), told(walls.getSize()) {}

    std::vector<std::string> sentences() {
        for (const PresentWall& wall : walls.present()) {
            number = wall.number;
            for (const OpenEdge& edge : wall.object->openEdges()) {
                if (told[number] || asked > mostAsked) break;
                look(edge);
            }
        }
        return std::move(found);
    }

private:
    struct Near {
        std::size_t wall;
        std::uint32_t part;
        WallPoint point;
    };

    /// The parts within a distance (m) of a place.
    void findNear(const Vector<double>& place, double distance) {
        near.clear();
        for (const auto& [w, wall] : walls.present()) {
            parts.clear();
            wall->listParts(place, distance, parts);
            asked += 1 + parts.size();
            for (const std::uint32_t part : parts) {
                WallPoint point;
                wall->findPoints(place, distance, {&part, 1}, {&point, 1});
                if (std::abs(point.distance) < distance) near.push_back({w, part, point});
            }
        }
    }
    [[nodiscard]] bool isSame(const Near& one, std::size_t wall, std::uint32_t part) const {
        return one.wall == wall && one.part == part;
    }

    void look(const OpenEdge& edge) {
        const Vector<double> normal = *walls.getObject(number).facetNormal(edge.part);
        const Vector<double> middle = 0.5 * (edge.begin + edge.end);
        for (const Vector<double>& place : {edge.begin, middle, edge.end}) {
            findNear(place, apart);
            const std::vector<Near> around = near;
            for (const Near& other : around) {
                if (told[number] || isSame(other, number, edge.part)) continue;
                const auto facet = walls.getObject(other.wall).facetNormal(other.part);
                const Vector<double> otherNormal = facet ? *facet : other.point.normal;
                if (!(std::abs(dot(normal, otherNormal)) > smoothCosine)) continue;
                if (other.point.distance > joined) lookAtGap(edge, place, other);
                else if (other.wall != number) lookAtOverlap(edge, middle, normal, other);
            }
        }
    }

    /// Unless another part closes it.
    void lookAtGap(const OpenEdge& edge, const Vector<double>& place, const Near& other) {
        const double gap = other.point.distance;
        findNear(place + 0.5 * gap * other.point.normal, 0.25 * gap);
        for (const Near& between : near)
            if (!isSame(between, number, edge.part) && !isSame(between, other.wall, other.part)) return;
        const std::uint32_t otherPart =
            walls.getObject(other.wall).isRepeated() ? WallImages::partOf(other.part) : other.part;
        tell(other.wall,
             fmt::format(
                 "Part {} of wall {} and part {} of wall {} face the same way and are {:.3g} m apart "
                 "at ({:.4g}, {:.4g}, {:.4g}) m: to grains with wide contacts they are one surface, to "
                 "others two; close the gap, or make it wider than {:.3g} m, or leave it if it is meant",
                 edge.part, number, otherPart, other.wall, gap, place.x, place.y, place.z, apart));
    }

    /// Whether the other wall goes on at both sides of an edge.
    void lookAtOverlap(const OpenEdge& edge, const Vector<double>& middle, const Vector<double>& normal,
                       const Near& other) {
        const Wall &one = walls.getObject(number), &two = walls.getObject(other.wall);
        const Vector<double> across = cross(normal, edge.end - edge.begin);
        for (const double side : {-1.0, 1.0}) {
            findNear(middle + (side * 4 * joined / norm(across)) * across, joined);
            if (std::ranges::none_of(near, [&](const Near& n) { return n.wall == other.wall; })) return;
        }
        WallPoint own;
        one.findPoints(middle, apart, {&edge.part, 1}, {&own, 1});
        if (one.getSpeciesIndex() == two.getSpeciesIndex() && own.velocity == other.point.velocity) return;
        tell(
            other.wall,
            fmt::format("Walls {} and {} lie in one surface at ({:.4g}, {:.4g}, {:.4g}) m and have different "
                        "species or velocities: a grain there touches wall {} alone; put the one that it "
                        "must not touch lower",
                        number, other.wall, middle.x, middle.y, middle.z, std::min(number, other.wall)));
    }

    void tell(std::size_t other, std::string sentence) {
        if (!told[other]) found.push_back(std::move(sentence));
        told[number] = told[other] = true;
    }

    /// Some seconds; for meshes of many triangles that share no sides and are far smaller than grains.
    static constexpr std::size_t mostAsked = 20'000'000;

    const WallHandler& walls;
    std::size_t asked = 0;  // walls and parts
    double joined, apart;   // m, gaps that are none, and that are edges
    std::size_t number = 0;
    std::vector<bool> told;  // of each wall
    std::vector<std::string> found;
    std::vector<std::uint32_t> parts;
    std::vector<Near> near;
};

}  // namespace

std::vector<std::string> doubtfulSeams(const WallHandler& walls, double smallest, double largest) {
    return SeamSearch(walls, smallest, largest).sentences();
}

}  // namespace pendular
