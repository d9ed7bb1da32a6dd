#include "Kernel/Features/RigidBodies/SphereGroups.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace pendular {

std::vector<std::vector<std::size_t>> groupsOfSpheres(std::span<const Ball> spheres, double share) {
    std::vector<std::vector<std::size_t>> groups;
    std::vector<std::size_t> left(spheres.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
    while (!left.empty()) {
        std::vector<std::size_t> group{left.front()};
        left.erase(left.begin());
        for (std::size_t next = 0; next < group.size(); ++next) {
            const Ball& own = spheres[group[next]];
            const auto others = std::stable_partition(left.begin(), left.end(), [&](std::size_t other) {
                const double reach = (1 + share) * (own.radius + spheres[other].radius);
                return (spheres[other].centre - own.centre).squaredNorm() > reach * reach;
            });
            // Not insert(), where g++ 14 warns of a copy to the memory in front of a vector.
            std::copy(others, left.end(), std::back_inserter(group));
            left.erase(others, left.end());
        }
        std::ranges::sort(group);
        groups.push_back(std::move(group));
    }
    return groups;
}

std::optional<std::string> gapInClump(std::span<const Ball> spheres) {
    const auto groups = groupsOfSpheres(spheres, 1e-3);
    if (groups.size() < 2) return std::nullopt;
    // The largest group is the clump; a sphere of the first other one is what has gone astray.
    const auto largest = std::ranges::max_element(groups, {}, &std::vector<std::size_t>::size);
    const std::vector<std::size_t>& astray = largest == groups.begin() ? groups[1] : groups[0];
    double gap = std::numeric_limits<double>::infinity();
    std::size_t named = astray.front();
    for (const std::size_t own : astray)
        for (std::size_t other = 0; other < spheres.size(); ++other) {
            if (std::ranges::binary_search(astray, other)) continue;
            const double apart = (spheres[other].centre - spheres[own].centre).norm() -
                                 (spheres[other].radius + spheres[own].radius);
            if (apart < gap) gap = apart, named = own;
        }
    const Ball& ball = spheres[named];
    return fmt::format(
        "the spheres of the clump do not hang together: sphere {} (counted from 0; centre {:.6g} {:.6g} "
        "{:.6g}, radius {:.6g} m) is {:.4g} m away from the nearest sphere of the rest, and they are in {} "
        "groups",
        named, ball.centre.x(), ball.centre.y(), ball.centre.z(), ball.radius, gap, groups.size());
}

}  // namespace pendular
