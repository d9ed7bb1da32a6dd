#include "Kernel/Analysis/CoarseGraining/FieldSums.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <type_traits>
#include <utility>

#include "Kernel/Core/Contacts/Prefetch.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Base/SharedQuestion.h"
#include "Kernel/Foundation/Math/GaussLegendre.h"
#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

using Place = std::array<double, 3>;

Place componentsOf(const Vector<double>& v) { return {v.x, v.y, v.z}; }

constexpr double volumeOfBall(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

/// Adds factor a a to xx xy xz yy yz zz.
void addSquare(double factor, const Vector<double>& a, double* sums) {
    const Place p = componentsOf(a);
    std::size_t at = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) sums[at++] += factor * p[i] * p[j];
}

/// Adds the symmetric part of a b to xx xy xz yy yz zz.
void addSymmetric(const Vector<double>& a, const Vector<double>& b, double* sums) {
    const Place p = componentsOf(a), q = componentsOf(b);
    std::size_t at = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) sums[at++] += 0.5 * (p[i] * q[j] + p[j] * q[i]);
}

/// Calls function(k) for k = 0 ... count - 1, each a constant: what a loop would keep in memory stays in
/// registers.
template <std::size_t count, class Function>
[[gnu::always_inline]] inline void forEachIndex(Function&& function) {
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        (function(std::integral_constant<std::size_t, k>()), ...);
    }
    (std::make_index_sequence<count>());
}

/// The directions of r and theta at a place beside an axis along z.
struct RoundFrame {
    double r, cosine, sine;

    explicit RoundFrame(double x, double y)
        : r(std::hypot(x, y)), cosine(r > 0 ? x / r : 1), sine(r > 0 ? y / r : 0) {}
    [[nodiscard]] Vector<double> turned(const Vector<double>& v) const {
        return {cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
    }
};

}  // namespace

GrainGroups GrainGroups::bySpecies(std::size_t count) {
    GrainGroups groups;
    groups.species = true;
    groups.names.clear();
    for (std::size_t k = 0; k < std::max<std::size_t>(count, 1); ++k)
        groups.names.push_back(fmt::format("species_{}", k));
    return groups;
}

GrainGroups GrainGroups::bySize(std::vector<double> diameters) {
    GrainGroups groups;
    for (std::size_t k = 0; k < diameters.size(); ++k)
        checkValue("GrainGroups", "diameter between two groups", diameters[k], "m",
                   {k == 0 ? 0 : diameters[k - 1], infinity, false, false});
    groups.edges = std::move(diameters);
    groups.names.clear();
    for (std::size_t k = 0; k <= groups.edges.size(); ++k) groups.names.push_back(fmt::format("size_{}", k));
    return groups;
}

std::uint32_t GrainGroups::amongSeveral(const GrainState::Grain& grain) const {
    if (species)
        return grain.species >= 0 && static_cast<std::size_t>(grain.species) < names.size()
                   ? static_cast<std::uint32_t>(grain.species)
                   : 0;
    return static_cast<std::uint32_t>(std::upper_bound(edges.begin(), edges.end(), 2 * grain.radius) -
                                      edges.begin());
}

FieldSums::FieldSums(FieldGrid grid, SmoothingKernel kernel, GrainGroups groups, FieldContent content)
    : points(grid),
      weight(std::move(kernel)),
      kinds(std::move(groups)),
      stored(content == FieldContent::All ? count : countWithoutContacts) {
    if (weight.dimensions() != points.dimensions())
        throw InputError(fmt::format("FieldSums: the kernel has {} dimensions, and the grid {}.",
                                     weight.dimensions(), points.dimensions()));
    // Resolved axes last.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points.isResolved(a) < points.isResolved(b);
    });
    blocks = (points.counts()[order[2]] + Pack::lanes - 1) / Pack::lanes;
    const std::size_t rows = points.counts()[order[0]] * points.counts()[order[1]];
    sums.assign(kinds.size() * rows * blocks * stored, Eight{});
    for (std::size_t k = 0; k < 3; ++k) {
        perLength[k] = 1 / points.spacing(k);
        // Eight points can be taken from each one on.
        const std::size_t padded = k == 2 ? (blocks + 1) * Pack::lanes : points.counts()[order[k]];
        for (std::size_t at = 0; at < padded; ++at) places[k].push_back(points.at(order[k], at));
    }
}

std::vector<double> FieldSums::numbers() const {
    std::vector<double> all;
    all.reserve(sums.size() * Pack::lanes);
    for (const Eight& eight : sums) all.insert(all.end(), eight.points.begin(), eight.points.end());
    return all;
}

void FieldSums::setNumbers(const std::vector<double>& numbers, std::size_t states) {
    if (numbers.size() != sums.size() * Pack::lanes)
        throw InputError(fmt::format(
            "FieldSums: the run began with {} sums, and now has {}; go on with the same grid and groups.",
            numbers.size(), sums.size() * Pack::lanes));
    for (std::size_t k = 0; k < numbers.size(); ++k)
        sums[k / Pack::lanes].points[k % Pack::lanes] = numbers[k];
    added = states;
}

void FieldSums::clear() {
    std::fill(sums.begin(), sums.end(), Eight{});
    added = 0;
}

double FieldSums::of(std::size_t sum, std::size_t group, std::size_t point) const {
    if (sum >= stored)
        throw InputError(fmt::format(
            "FieldSums: sum {} is not there; it must be below {}{}.", sum, stored,
            hasContacts() ? "" : ", because sums of contacts were left out (FieldContent::WithoutContacts)"));
    const auto& n = points.counts();
    const std::array<std::size_t, 3> k{point / (n[1] * n[2]), point / n[2] % n[1], point % n[2]};
    const std::size_t row = (group * n[order[0]] + k[order[0]]) * n[order[1]] + k[order[1]];
    const std::size_t inner = k[order[2]];
    const std::size_t block = row * blocks + inner / Pack::lanes;
    const double total = sums[block * stored + sum].points[inner % Pack::lanes];
    return total / (static_cast<double>(std::max<std::size_t>(added, 1)) * points.measure(k[0]));
}

double FieldSums::ofAll(std::size_t sum, std::size_t point) const {
    double total = 0;
    for (std::size_t group = 0; group < kinds.size(); ++group) total += of(sum, group, point);
    return total;
}

/// Calls use(number) for each image along an axis of a body (m, from `low` to `high`) that the grid can see:
/// along a resolved axis up to the cut-off beyond the box; else within it.
template <class Use>
void FieldSums::forImagesAlong(std::size_t axis, double period, double low, double high, Use&& use) const {
    const bool isAround = points.isCylindrical() && axis < 2;
    const double reach = points.isResolved(axis) ? weight.cutOff() : 0;
    const double from = points.low(axis) - reach, to = points.high(axis) + reach;
    if (isAround || period == 0) {
        if (isAround || (high >= from && low <= to)) use(0.0);
        return;
    }
    // Within a box that is no longer than a period: no other image is in it.
    if (low >= from && high < to && to - from <= period) return use(0.0);
    const double last = std::floor((to - low) / period);
    for (double image = std::ceil((from - high) / period); image <= last; ++image) {
        // What lies at the upper end of a box that is averaged over is its own image at the lower end.
        if (!points.isResolved(axis) && low + image * period >= points.high(axis)) break;
        use(image);
    }
}

/// Calls use(shift, velocity), in m and m/s, for each image that the grid can see, along all three axes.
/// @param slid m, of images along the gradient of a shear, which has no period here
template <class Use>
void FieldSums::forImagesAlongAxes(const PeriodicBox& periodic, const Vector<double>& low,
                                   const Vector<double>& high, const Vector<double>& slid, Use&& use) const {
    const Vector<double>&length = periodic.length, &across = periodic.across;
    const auto along = [&](std::size_t axis, double period, double gradient, double begin, double end,
                           auto&& inner) {
        forImagesAlong(axis, gradient > 0 ? 0 : period, begin, end,
                       [&](double image) { inner(image * period); });
    };
    const Vector<double> lows = low + slid, highs = high + slid;
    along(0, length.x, across.x, lows.x, highs.x, [&](double x) {
        along(1, length.y, across.y, lows.y, highs.y, [&](double y) {
            along(2, length.z, across.z, lows.z, highs.z, [&](double z) {
                // The rate along the flow of a shear is 0, so what has slid changes nothing.
                const Vector<double>& rate = periodic.strainRate;
                const Vector<double> shift = slid + Vector<double>{x, y, z};
                use(shift, Vector<double>{rate.x * shift.x, rate.y * shift.y, rate.z * shift.z});
            });
        });
    });
}

/// Calls use(shift, velocity) for each image of a body (m, from `low` to `high`) that the grid can see. In
/// shear the images along the gradient come first, and have slid along the flow.
template <class Use>
void FieldSums::forImages(const PeriodicBox& periodic, const Vector<double>& low, const Vector<double>& high,
                          Use&& use) const {
    if (!periodic.isSheared()) return forImagesAlongAxes(periodic, low, high, {0, 0, 0}, use);
    const Place gradient = componentsOf(periodic.across);
    const std::size_t axis = gradient[0] > 0 ? 0 : gradient[1] > 0 ? 1 : 2;
    forImagesAlong(axis, componentsOf(periodic.length)[axis], componentsOf(low)[axis],
                   componentsOf(high)[axis], [&](double image) {
                       const auto ofImage = [&](const Vector<double>& shift, const Vector<double>& velocity) {
                           use(shift, velocity + image * periodic.imageVelocity);
                       };
                       forImagesAlongAxes(periodic, low, high, image * periodic.imageShift, ofImage);
                   });
}

/// Each thread adds to its own grains, in the order of contacts.
void FieldSums::gatherContactsOfGrains(const GrainState& state, int threads) {
    constexpr std::size_t ahead = 16;
    ofGrains.assign(state.grains.size(), {});
    inParts(
        state.grains.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            const auto isOwn = [&](std::uint32_t grain) { return grain >= begin && grain < end; };
            for (std::size_t k = 0; k < state.contacts.size(); ++k) {
                const GrainState::Contact& c = state.contacts[k];
                if (k + ahead < state.contacts.size()) {
                    const std::uint32_t later = state.contacts[k + ahead].second;
                    if (later < ofGrains.size()) prefetch<true>(&ofGrains[later], sizeof(Eight));
                }
                const bool atWall = c.second == GrainState::Contact::wall;
                const bool ownFirst = isOwn(c.first), ownSecond = !atWall && isOwn(c.second);
                if (!ownFirst && !ownSecond) continue;
                const Vector<double>& s = c.shift;
                const double factor = c.touching && !atWall ? 1 / squaredNorm(s) : 0;
                const Vector<double> n = factor * s;
                const Eight one{{n.x * s.x, n.x * s.y, n.x * s.z, n.y * s.y, n.y * s.z, n.z * s.z,
                                 c.touching ? 1.0 : 0.0, atWall ? c.liquid : 0.5 * c.liquid}};
                const auto add = [own = Pack::load(one.points.data())](Eight& sum) {
                    (Pack::load(sum.points.data()) + own).store(sum.points.data());
                };
                if (ownFirst) add(ofGrains[c.first]);
                if (ownSecond) add(ofGrains[c.second]);
            }
        },
        1024);
}

/// Finds within which box (m) the grid sees a body by itself alone: no image of it, and all of it.
void FieldSums::findAlone(const PeriodicBox& periodic) {
    const Place periods = componentsOf(periodic.length);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool resolved = points.isResolved(axis);
        const double reach = resolved ? weight.cutOff() : 0;
        aloneLow[axis] = resolved && periods[axis] == 0 ? -infinity : points.low(axis) - reach;
        aloneHigh[axis] = resolved && periods[axis] == 0 ? infinity : points.high(axis) + reach;
        if (points.isCylindrical() || (periods[axis] > 0 && aloneHigh[axis] - aloneLow[axis] > periods[axis]))
            aloneHigh[axis] = -infinity;
    }
}

[[gnu::always_inline]] inline bool FieldSums::isAlone(const Vector<double>& one,
                                                      const Vector<double>& other) const {
    const auto isWithin = [&](const Vector<double>& p) {
        return p.x >= aloneLow[0] && p.x < aloneHigh[0] && p.y >= aloneLow[1] && p.y < aloneHigh[1] &&
               p.z >= aloneLow[2] && p.z < aloneHigh[2];
    };
    return isWithin(one) && isWithin(other);
}

/// The points along an axis that are within the cut-off of what reaches from `low` to `high` (m).
[[gnu::always_inline]] inline FieldSums::Range FieldSums::pointsNear(double low, double high,
                                                                     std::size_t axis) const {
    const double n = static_cast<double>(points.counts()[axis]), start = points.low(axis),
                 reach = weight.cutOff();
    const double from = std::ceil((low - reach - start) * perLength[axis] - 0.5 - 1e-9),
                 to = std::floor((high + reach - start) * perLength[axis] - 0.5 + 1e-9) + 1;
    if (!(from < n && to > 0)) return {0, 0};
    return {from > 0 ? static_cast<std::size_t>(from) : 0,
            to < n ? static_cast<std::size_t>(to) : points.counts()[axis]};
}

[[gnu::always_inline]] inline FieldSums::Near FieldSums::nearAlong(double low, double high,
                                                                   std::uint32_t group) const {
    const Range near = pointsNear(low, high, order[2]);
    const std::size_t before = group * points.counts()[order[2]];
    return {static_cast<std::uint32_t>(before + near.begin), static_cast<std::uint32_t>(before + near.end)};
}

void FieldSums::addGrain(const GrainState& state, std::size_t number, Items& items) const {
    const GrainState::Grain& grain = state.grains[number];
    if (isAlone(grain.position, grain.position))
        return addGrainAt(grain.position, grain.velocity, grain, number, items);
    forImages(state.periodic, grain.position, grain.position,
              [&](const Vector<double>& shift, const Vector<double>& ofImage) {
                  addGrainAt(grain.position + shift, grain.velocity + ofImage, grain, number, items);
              });
}

/// A grain or an image of it, with its position (m) and velocity (m/s).
void FieldSums::addGrainAt(const Vector<double>& position, Vector<double> velocity,
                           const GrainState::Grain& grain, std::size_t number, Items& items) const {
    const std::uint32_t group = kinds.of(grain);
    Near near{0, 0};
    if (isAlongAxis()) {
        const double at = componentsOf(position)[order[2]];
        near = nearAlong(at, at, group);
        if (near.begin == near.end) return;
    }
    PointItem& item = items.grains.emplace_back();
    item.at = componentsOf(position), item.group = group, item.near = near;
    const double volume = volumeOfBall(grain.radius);
    std::array<double, 8> own{};
    if (hasContacts()) {
        own = ofGrains[number].points;
        for (std::size_t k = 0; k < 6; ++k) own[k] *= volume;
    }
    if (points.isCylindrical()) {
        const RoundFrame frame(position.x - points.centre().x, position.y - points.centre().y);
        item.at[0] = frame.r;
        velocity = frame.turned(velocity);
        // Fabric about the new axes: T' = Q T Q^T.
        const std::array<double, 8> f = own;
        const Vector<double> rows[] = {frame.turned({f[0], f[1], f[2]}), frame.turned({f[1], f[3], f[4]}),
                                       frame.turned({f[2], f[4], f[5]})};
        const Vector<double> a = frame.turned({rows[0].x, rows[1].x, rows[2].x}),
                             b = frame.turned({rows[0].y, rows[1].y, rows[2].y}),
                             c = frame.turned({rows[0].z, rows[1].z, rows[2].z});
        own = {a.x, a.y, a.z, b.y, b.z, c.z, f[6], f[7]};
    }
    auto& values = item.values;
    values[Number] = 1;
    values[Volume] = volume;
    values[Mass] = grain.mass;
    values[Momentum] = grain.mass * velocity.x;
    values[Momentum + 1] = grain.mass * velocity.y;
    values[Momentum + 2] = grain.mass * velocity.z;
    addSquare(grain.mass, velocity, values.data() + Flux);
    std::copy(own.begin(), own.end(), values.begin() + Fabric);
    values[Liquid] += grain.liquid;
}

/// A part of a branch (m) from a place on. @param share of the branch; @param force N
[[gnu::always_inline]] inline void FieldSums::addAxisLine(const Vector<double>& from,
                                                          const Vector<double>& branch, double share,
                                                          const Vector<double>& force,
                                                          const std::array<double, 6>& adhesive,
                                                          std::uint32_t group, Items& items) const {
    const double start = componentsOf(from)[order[2]], way = share * componentsOf(branch)[order[2]];
    const Near near = nearAlong(std::min(start, start + way), std::max(start, start + way), group);
    if (near.begin == near.end) return;
    items.along.push_back({start, way, componentsOf(share * force), componentsOf(branch), near});
    if (!items.isAdhesive) return;
    items.adhesive.resize(items.along.size());
    for (std::size_t k = 0; k < 6; ++k) items.adhesive.back()[k] = share * adhesive[k];
}

/// A line from `end` + branch, where the force acts on the grain, back to `end`.
void FieldSums::addLine(const GrainState& state, const Vector<double>& end, const Vector<double>& branch,
                        std::size_t number, std::uint32_t group, Items& items) const {
    const GrainState::Contact& contact = state.contacts[number];
    std::array<double, 6> adhesive{};
    if (contact.adhesiveForce != 0) {
        if (state.branches.empty()) {
            addSquare(-contact.adhesiveForce * norm(branch) / squaredNorm(contact.shift), contact.shift,
                      adhesive.data());
        } else {
            const bool hasNormal = !state.shapes.empty() && state.shapes[number].normal;
            addSymmetric(hasNormal ? contact.adhesiveForce * *state.shapes[number].normal
                                   : (contact.adhesiveForce / norm(contact.shift)) * contact.shift,
                         branch, adhesive.data());
        }
        items.isAdhesive = true;
    }
    const Vector<double> other = end + branch;
    if (isAlongAxis() && isAlone(end, other))
        return addAxisLine(end, branch, 1, contact.force, adhesive, group, items);
    const Vector<double> low{std::min(end.x, other.x), std::min(end.y, other.y), std::min(end.z, other.z)},
        high{std::max(end.x, other.x), std::max(end.y, other.y), std::max(end.z, other.z)};
    const Place b = componentsOf(branch), f = componentsOf(contact.force);
    std::array<double, 15> values{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) values[3 * i + j] = f[i] * b[j];
    std::copy(adhesive.begin(), adhesive.end(), values.begin() + 9);
    forImages(state.periodic, low, high, [&](const Vector<double>& shift, const Vector<double>&) {
        const Place from = componentsOf(end + shift);
        // The part of the line within the box, in the directions that are averaged over.
        double begin = 0, stop = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (points.isResolved(axis) || (points.isCylindrical() && axis < 2)) continue;
            const double to = from[axis] + b[axis];
            if (std::min(from[axis], to) >= points.low(axis) && std::max(from[axis], to) <= points.high(axis))
                continue;
            if (b[axis] == 0) continue;  // forImages() has seen that it is within
            const double one = (points.low(axis) - from[axis]) / b[axis],
                         two = (points.high(axis) - from[axis]) / b[axis];
            begin = std::max(begin, std::min(one, two));
            stop = std::min(stop, std::max(one, two));
        }
        if (!(begin < stop)) return;
        const Vector<double> start = end + shift + begin * branch;
        if (isAlongAxis())
            return addAxisLine(start, branch, stop - begin, contact.force, adhesive, group, items);
        std::array<double, 15> part = values;
        for (double& value : part) value *= stop - begin;
        const Vector<double> way = (stop - begin) * branch;
        if (points.isCylindrical()) return addRoundLine(start, way, part, group, items);
        LineItem line{componentsOf(start), componentsOf(way), 0, group, part};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!points.isResolved(axis)) line.from[axis] = line.branch[axis] = 0;
            line.length += line.branch[axis] * line.branch[axis];
        }
        line.length = std::sqrt(line.length);
        items.lines.push_back(line);
    });
}

/// Around an axis there is no closed form: nodes of Gauss and Legendre along the line, each with the
/// directions of its own place. Their mean errs by less than 1e-8 of phi(0) (a Gauss cut at 3 w).
void FieldSums::addRoundLine(const Vector<double>& end, const Vector<double>& branch,
                             const std::array<double, 15>& values, std::uint32_t group, Items& items) const {
    const int count =
        static_cast<int>(std::clamp(6 + std::ceil(9 * norm(branch) / weight.cutOff()), 6.0, 64.0));
    for (const QuadratureNode& node : gaussLegendre(count)) {
        const Vector<double> at = end + 0.5 * (1 + node.position) * branch;
        const RoundFrame frame(at.x - points.centre().x, at.y - points.centre().y);
        PointItem item{.at = {frame.r, 0, at.z}, .group = group, .values = {}};
        const Vector<double> columns[] = {frame.turned({values[0], values[3], values[6]}),
                                          frame.turned({values[1], values[4], values[7]}),
                                          frame.turned({values[2], values[5], values[8]})};
        const Vector<double> rows[] = {frame.turned({columns[0].x, columns[1].x, columns[2].x}),
                                       frame.turned({columns[0].y, columns[1].y, columns[2].y}),
                                       frame.turned({columns[0].z, columns[1].z, columns[2].z})};
        const Vector<double> sticky[] = {frame.turned({values[9], values[10], values[11]}),
                                         frame.turned({values[10], values[12], values[13]}),
                                         frame.turned({values[11], values[13], values[14]})};
        const Vector<double> turned[] = {frame.turned({sticky[0].x, sticky[1].x, sticky[2].x}),
                                         frame.turned({sticky[0].y, sticky[1].y, sticky[2].y}),
                                         frame.turned({sticky[0].z, sticky[1].z, sticky[2].z})};
        const double all[] = {rows[0].x,   rows[0].y,   rows[0].z,   rows[1].x,   rows[1].y,
                              rows[1].z,   rows[2].x,   rows[2].y,   rows[2].z,   turned[0].x,
                              turned[0].y, turned[0].z, turned[1].y, turned[1].z, turned[2].z};
        for (std::size_t k = 0; k < 15; ++k) item.values[k] = 0.5 * node.weight * all[k];
        items.nodes.push_back(item);
    }
}

void FieldSums::addTraction(const GrainState& state, const Vector<double>& end, const Vector<double>& on,
                            std::uint32_t group, Items& items) const {
    forImages(state.periodic, end, end, [&](const Vector<double>& shift, const Vector<double>&) {
        PointItem item{.at = componentsOf(end + shift), .group = group, .values = {}};
        Vector<double> force = on;
        if (points.isCylindrical()) {
            const RoundFrame frame(end.x - points.centre().x, end.y - points.centre().y);
            item.at[0] = frame.r;
            force = frame.turned(force);
        }
        item.values[0] = force.x, item.values[1] = force.y, item.values[2] = force.z;
        items.tractions.push_back(item);
    });
}

void FieldSums::addContact(const GrainState& state, std::size_t number, Items& items) const {
    const GrainState::Contact& contact = state.contacts[number];
    const GrainState::Grain& first = state.grains[contact.first];
    const std::uint32_t group = kinds.of(first);
    const bool atWall = contact.second == GrainState::Contact::wall;
    if (!state.branches.empty()) {
        const auto& [toFirst, toSecond] = state.branches[number];
        const Vector<double> point = first.position - toFirst;
        addLine(state, point, toFirst, number, group, items);
        if (atWall) return addTraction(state, point, contact.force, group, items);
        addLine(state, point + toSecond, -toSecond, number, kinds.of(state.grains[contact.second]), items);
        return;
    }
    const Vector<double> end = first.position + contact.shift;
    if (atWall) {
        addLine(state, end, -contact.shift, number, group, items);
        return addTraction(state, end, contact.force, group, items);
    }
    const GrainState::Grain& second = state.grains[contact.second];
    const std::uint32_t other = kinds.of(second);
    if (other == group) {
        addLine(state, end, -contact.shift, number, group, items);
        return;
    }
    // The point in the middle of the overlap or of the gap, as a fraction of the shift.
    const double length = norm(contact.shift);
    const double middle = (first.radius + 0.5 * (length - first.radius - second.radius)) / length;
    addLine(state, first.position + middle * contact.shift, -middle * contact.shift, number, group, items);
    addLine(state, end, (middle - 1) * contact.shift, number, other, items);
}

/// Adds phi times the values to the sums from `first` on, at all points within the cut-off of a box.
/// @param phi given the place of eight points of a row, m
template <std::size_t size, class Phi>
void FieldSums::overPoints(const Place& low, const Place& high, std::size_t first, std::uint32_t group,
                           const double* values, const Slab& slab, Phi&& phi) const {
    std::array<std::size_t, 3> begin{}, end{1, 1, 1};
    for (std::size_t place = 0; place < 3; ++place) {
        const std::size_t axis = order[place];
        if (!points.isResolved(axis)) continue;
        const Range near = pointsNear(low[axis], high[axis], axis);
        if (near.begin == near.end) return;
        begin[place] = near.begin;
        end[place] = near.end;
    }
    std::size_t firstBlock = begin[2] / Pack::lanes, lastBlock = (end[2] + Pack::lanes - 1) / Pack::lanes;
    const int dimensions = points.dimensions();
    auto& limited = dimensions == 3 ? begin[0] : dimensions == 2 ? begin[1] : firstBlock;
    auto& limitedEnd = dimensions == 3 ? end[0] : dimensions == 2 ? end[1] : lastBlock;
    limited = std::max(limited, slab.begin);
    limitedEnd = std::min(limitedEnd, slab.end);

    const auto& n = points.counts();
    for (std::size_t i = begin[0]; i < end[0]; ++i)
        for (std::size_t j = begin[1]; j < end[1]; ++j) {
            Eight* const row =
                slab.sums + ((group * n[order[0]] + i) * n[order[1]] + j) * blocks * stored + first;
            const auto weightsFrom = [&](std::size_t point) {
                std::array<double, Pack::lanes> along;
                std::copy_n(places[2].data() + point, Pack::lanes, along.data());
                return phi(places[0][i], places[1][j], Pack::fromLanes(along));
            };
            const auto add = [&](std::size_t block, const Pack& weights) {
                if (none(weights > 0.0)) return;
                for (std::size_t k = 0; k < size; ++k) {
                    double* const eight = row[block * stored + k].points.data();
                    fma(weights, Pack(values[k]), Pack::load(eight)).store(eight);
                }
            };
            if (end[2] - begin[2] <= Pack::lanes) {
                // Few points: one evaluation, wherever they begin, then brought to the blocks that they are
                // in.
                alignas(64) std::array<double, 2 * Pack::lanes> both{};
                const std::array<double, Pack::lanes> eight = weightsFrom(begin[2]).toLanes();
                std::copy_n(eight.data(), Pack::lanes, both.data() + begin[2] % Pack::lanes);
                const std::size_t left = begin[2] / Pack::lanes;
                for (std::size_t b = firstBlock; b < lastBlock; ++b)
                    add(b, Pack::load(both.data() + (b - left) * Pack::lanes));
            } else {
                for (std::size_t b = firstBlock; b < lastBlock; ++b) add(b, weightsFrom(b * Pack::lanes));
            }
        }
}

template <std::size_t first, std::size_t size>
void FieldSums::spread(const Place& at, std::uint32_t group, const double* values, const Slab& slab) const {
    const auto one = [&](const Place& place) {
        const auto phi = [&](double outer, double middle, const Pack& inner) {
            Pack square(0.0);
            if (points.isResolved(order[0]))
                square = Pack((outer - place[order[0]]) * (outer - place[order[0]]));
            if (points.isResolved(order[1])) {
                const double d = middle - place[order[1]];
                square = square + d * d;
            }
            if (points.isResolved(order[2])) {
                const Pack d = inner - place[order[2]];
                square = square + d * d;
            }
            return weight.value(square);
        };
        overPoints<size>(place, place, first, group, values, slab, phi);
    };
    one(at);
    // Beyond the axis is the other side.
    if (points.isCylindrical() && at[0] < weight.cutOff()) one({-at[0], at[1], at[2]});
}

template <std::size_t first, std::size_t size>
void FieldSums::spread(const LineItem& line, const Slab& slab) const {
    if (line.length < weight.shortestLine()) {
        const int nodes = line.length == 0 ? 1 : 3;
        for (const QuadratureNode& node : gaussLegendre(nodes)) {
            std::array<double, size> values;
            for (std::size_t k = 0; k < size; ++k) values[k] = 0.5 * node.weight * line.values[k];
            Place at{};
            for (std::size_t axis = 0; axis < 3; ++axis)
                at[axis] = line.from[axis] + 0.5 * (1 + node.position) * line.branch[axis];
            spread<first, size>(at, line.group, values.data(), slab);
        }
        return;
    }
    Place low{}, high{}, unit{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = line.from[axis] + std::min(line.branch[axis], 0.0);
        high[axis] = line.from[axis] + std::max(line.branch[axis], 0.0);
        unit[axis] = line.branch[axis] / line.length;
    }
    const auto phi = [&](double outer, double middle, const Pack& inner) {
        const Pack zero(0.0);
        const Vector<Pack> d{points.isResolved(order[0]) ? Pack(outer - line.from[order[0]]) : zero,
                             points.isResolved(order[1]) ? Pack(middle - line.from[order[1]]) : zero,
                             points.isResolved(order[2]) ? inner - line.from[order[2]] : zero};
        const Pack along = d.x * unit[order[0]] + d.y * unit[order[1]] + d.z * unit[order[2]];
        // Across by a difference of vectors: that of two squares would lose digits.
        const Vector<Pack> across{d.x - along * unit[order[0]], d.y - along * unit[order[1]],
                                  d.z - along * unit[order[2]]};
        const Pack square = across.x * across.x + across.y * across.y + across.z * across.z;
        if (none(square < weight.cutOff() * weight.cutOff())) return zero;
        return weight.lineMean(along, square, line.length);
    };
    overPoints<size>(low, high, first, line.group, line.values.data(), slab, phi);
}

/// By their first points, and of one first point in the order in which they came.
template <class Item>
void FieldSums::sortByPoints(const std::vector<Item>& items, std::vector<std::uint32_t>& sorted) const {
    std::vector<std::uint32_t> places(kinds.size() * points.counts()[order[2]] + 1);
    for (const Item& item : items) ++places[item.near.begin + 1];
    std::partial_sum(places.begin(), places.end(), places.begin());
    sorted.resize(items.size());
    for (std::uint32_t k = 0; k < items.size(); ++k) sorted[places[items[k].near.begin]++] = k;
}

/// Adds weights times values to the sums from `first` on where one axis is resolved. Items that begin at the
/// same point are added up in registers.
/// @param weights (item, places of eight points, m) phi there; @param carry (item, phi, totals) adds phi
/// times the values
template <std::size_t first, std::size_t size, class Item, class Weights, class Carry>
void FieldSums::spreadSorted(const std::vector<Item>& all, const std::vector<std::uint32_t>& sorted,
                             const Slab& slab, Weights&& weights, Carry&& carry) const {
    const std::size_t n = points.counts()[order[2]];
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        const std::uint32_t start = all[sorted[begin]].near.begin;
        std::uint32_t stop = start;  // behind the last point of all
        for (end = begin; end < sorted.size() && all[sorted[end]].near.begin == start; ++end)
            stop = std::max(stop, all[sorted[end]].near.end);
        for (std::uint32_t eight = start; eight < stop; eight += Pack::lanes) {
            slab.question.ask();
            const std::size_t point = eight % n, group = eight / n;
            std::array<double, Pack::lanes> along;
            std::copy_n(places[2].data() + point, Pack::lanes, along.data());
            const Pack inner = Pack::fromLanes(along);
            std::array<Pack, size> totals;
            forEachIndex<size>([&](auto k) { totals[k] = Pack(0.0); });
            for (std::size_t k = begin; k < end; ++k)
                if (all[sorted[k]].near.end > eight) carry(sorted[k], weights(sorted[k], inner), totals);
            Eight* const block = slab.sums + (group * blocks + point / Pack::lanes) * stored + first;
            const std::size_t left = point % Pack::lanes,
                              within = std::min<std::size_t>(Pack::lanes, n - point);
            forEachIndex<size>([&](auto k) {
                const std::array<double, Pack::lanes> own = totals[k].toLanes();
                for (std::size_t lane = 0; lane < within; ++lane) {
                    const std::size_t at = left + lane;
                    block[at / Pack::lanes * stored + k].points[at % Pack::lanes] += own[lane];
                }
            });
        }
    }
}

void FieldSums::spreadAlongAxis(Items& of, const Slab& slab) const {
    sortByPoints(of.grains, of.order);
    const auto atGrain = [&](std::uint32_t item, const Pack& inner) {
        const Pack d = inner - of.grains[item].at[order[2]];
        return weight.value(d * d);
    };
    const auto ofGrain = [&](std::uint32_t item, const Pack& phi, auto& totals) {
        constexpr std::size_t size = std::tuple_size_v<std::remove_reference_t<decltype(totals)>>;
        forEachIndex<size>([&](auto k) { totals[k] = fma(phi, Pack(of.grains[item].values[k]), totals[k]); });
    };
    if (hasContacts()) spreadSorted<Number, 20>(of.grains, of.order, slab, atGrain, ofGrain);
    else spreadSorted<Number, countWithoutContacts>(of.grains, of.order, slab, atGrain, ofGrain);
    sortByPoints(of.along, of.order);
    const auto onLine = [&](std::uint32_t item, const Pack& inner) {
        const AxisLine& line = of.along[item];
        const Pack d = inner - line.from;
        const double length = std::abs(line.way);
        if (length >= weight.shortestLine()) return weight.lineMean(line.way > 0 ? d : -d, Pack(0.0), length);
        Pack mean(0.0);
        for (const QuadratureNode& node : gaussLegendre(3)) {
            const Pack way = d - 0.5 * (1 + node.position) * line.way;
            mean += 0.5 * node.weight * weight.value(way * way);
        }
        return mean;
    };
    const auto ofLine = [&](std::uint32_t item, const Pack& phi, auto& totals) {
        const AxisLine& line = of.along[item];
        forEachIndex<9>(
            [&](auto k) { totals[k] = fma(phi * line.left[k / 3], Pack(line.right[k % 3]), totals[k]); });
    };
    if (!of.isAdhesive) {
        spreadSorted<ContactStress, 9>(of.along, of.order, slab, onLine, ofLine);
    } else {
        spreadSorted<ContactStress, 15>(
            of.along, of.order, slab, onLine, [&](std::uint32_t item, const Pack& phi, auto& totals) {
                ofLine(item, phi, totals);
                forEachIndex<6>(
                    [&](auto k) { totals[9 + k] = fma(phi, Pack(of.adhesive[item][k]), totals[9 + k]); });
            });
    }
    for (const PointItem& item : of.tractions)
        spread<Traction, 3>(item.at, item.group, item.values.data(), slab);
}

void FieldSums::Items::clear() {
    grains.clear(), tractions.clear(), lines.clear(), nodes.clear(), along.clear(), adhesive.clear();
    isAdhesive = false;
}

void FieldSums::makeItems(const GrainState& state, std::size_t share, std::size_t sharesOfAll, Items& of,
                          SharedQuestion& question) const {
    of.clear();
    const std::size_t grains = state.grains.size(), contacts = state.contacts.size();
    for (std::size_t k = grains * share / sharesOfAll; k < grains * (share + 1) / sharesOfAll; ++k) {
        question.ask();
        addGrain(state, k, of);
    }
    if (!hasContacts()) return;
    for (std::size_t k = contacts * share / sharesOfAll; k < contacts * (share + 1) / sharesOfAll; ++k) {
        question.ask();
        addContact(state, k, of);
    }
}

void FieldSums::spread(const Items& of, const Slab& slab) const {
    for (const PointItem& item : of.grains) {
        slab.question.ask();
        if (hasContacts()) spread<Number, 20>(item.at, item.group, item.values.data(), slab);
        else spread<Number, countWithoutContacts>(item.at, item.group, item.values.data(), slab);
    }
    for (const PointItem& item : of.tractions)
        spread<Traction, 3>(item.at, item.group, item.values.data(), slab);
    for (const PointItem& item : of.nodes) {
        slab.question.ask();
        spread<ContactStress, 15>(item.at, item.group, item.values.data(), slab);
    }
    for (const LineItem& line : of.lines) {
        slab.question.ask();
        if (of.isAdhesive) spread<ContactStress, 15>(line, slab);
        else spread<ContactStress, 9>(line, slab);
    }
}

std::size_t FieldSums::slabLength() const {
    const int dimensions = points.dimensions();
    return dimensions == 3 ? points.counts()[order[0]] : dimensions == 2 ? points.counts()[order[1]] : blocks;
}

void FieldSums::refuseMovingImages(const FieldGrid& grid, const PeriodicBox& periodic) {
    if (grid.isCylindrical() && periodic.imagesMove)
        throw InputError(
            "Fields around an axis (coordinates R or RZ) have no meaning where the images of a scene move "
            "(setLeesEdwards(), setStrainRate(), setTargetStress()); take coordinates of X, Y and Z.");
}

/// Each share has its own sums, and is summed as soon as it is made.
void FieldSums::addByShares(const GrainState& state, int threads, std::size_t sharesOfAll,
                            SharedQuestion& question) {
    items.resize(static_cast<std::size_t>(std::max(threads, 1)));
    sumsOfShares.resize(sharesOfAll);
    inParts(sharesOfAll, threads, [&](int thread, std::size_t begin, std::size_t end) {
        for (std::size_t share = begin; share < end; ++share) {
            Items& own = items[static_cast<std::size_t>(thread)];
            makeItems(state, share, sharesOfAll, own, question);
            sumsOfShares[share].assign(sums.size(), Eight{});
            const Slab slab{0, slabLength(), sumsOfShares[share].data(), question};
            if (isAlongAxis()) spreadAlongAxis(own, slab);
            else spread(own, slab);
        }
    });
    for (const std::vector<Eight>& ofShare : sumsOfShares)
        for (std::size_t k = 0; k < sums.size(); ++k)
            for (std::size_t lane = 0; lane < Pack::lanes; ++lane)
                sums[k].points[lane] += ofShare[k].points[lane];
}

/// All shares are made, and then each thread sums what falls into its part of the grid.
void FieldSums::addBySlabs(const GrainState& state, int threads, SharedQuestion& question) {
    items.resize(shares);
    inParts(shares, threads, [&](int, std::size_t begin, std::size_t end) {
        for (std::size_t share = begin; share < end; ++share)
            makeItems(state, share, shares, items[share], question);
    });
    inParts(slabLength(), threads, [&](int, std::size_t begin, std::size_t end) {
        for (const Items& ofShare : items) spread(ofShare, {begin, end, sums.data(), question});
    });
}

void FieldSums::add(const GrainState& state, int threads, const std::function<void()>& ask) {
    refuseMovingImages(points, state.periodic);
    findAlone(state.periodic);
    if (hasContacts()) gatherContactsOfGrains(state, threads);
    // Into how many shares goes by the points, so that fields of grains are the same bits with and without
    // those of contacts.
    const std::size_t size = sums.size() / stored * count;
    SharedQuestion question(ask);
    question.during([&] {
        if (size <= fewSums || isAlongAxis())
            addByShares(state, threads, std::clamp(fewSums * shares / size, std::size_t{1}, shares),
                        question);
        else addBySlabs(state, threads, question);
    });
    ++added;
}

}  // namespace pendular
