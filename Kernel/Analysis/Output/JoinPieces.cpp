#include "Kernel/Analysis/Output/JoinPieces.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pendular {

namespace {

using Order = std::vector<std::size_t>;

void append(std::vector<PolyDataField>& all, const std::vector<PolyDataField>& more) {
    const auto refuse = [] { throw std::runtime_error("has pieces with different fields"); };
    if (all.size() != more.size()) refuse();
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].name != more[k].name || all[k].components != more[k].components ||
            all[k].numbers.index() != more[k].numbers.index())
            refuse();
        std::visit(
            [&]<class Numbers>(Numbers& numbers) {
                const Numbers& others = std::get<Numbers>(more[k].numbers);
                numbers.insert(numbers.end(), others.begin(), others.end());
            },
            all[k].numbers);
    }
}

void append(PolyData& all, const PolyData& more) {
    if (all.ends.empty()) all.kind = more.kind;  // one without cells does not say which
    const auto points = static_cast<std::int32_t>(all.points.size()),
               corners = static_cast<std::int32_t>(all.corners.size());
    all.points.insert(all.points.end(), more.points.begin(), more.points.end());
    for (const std::int32_t corner : more.corners) all.corners.push_back(points + corner);
    for (const std::int32_t end : more.ends) all.ends.push_back(corners + end);
    append(all.pointFields, more.pointFields);
    append(all.cellFields, more.cellFields);
}

/// By the whole numbers of a field; none where it is not there.
Order orderBy(const PolyDataField* field) {
    const auto* const keys =
        field && field->components == 1 ? std::get_if<std::vector<std::int32_t>>(&field->numbers) : nullptr;
    if (!keys) return {};
    Order order(keys->size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
        return std::pair((*keys)[a], a) < std::pair((*keys)[b], b);
    });
    return order;
}

void sort(std::vector<PolyDataField>& fields, const Order& order) {
    for (PolyDataField& field : fields)
        std::visit(
            [&]<class Numbers>(Numbers& numbers) {
                Numbers sorted;
                sorted.reserve(numbers.size());
                for (const std::size_t k : order)
                    for (std::size_t c = 0; c < field.components; ++c)
                        sorted.push_back(numbers[k * field.components + c]);
                numbers = std::move(sorted);
            },
            field.numbers);
}

/// All points are one cell, as in a frame of one process.
void sortPoints(PolyData& data) {
    std::iota(data.corners.begin(), data.corners.end(), 0);
    data.ends.clear();
    if (!data.corners.empty()) data.ends = {static_cast<std::int32_t>(data.corners.size())};
    const Order order = orderBy(data.pointField("identity"));
    if (order.empty()) return;
    std::vector<Vector<double>> points;
    for (const std::size_t k : order) points.push_back(data.points[k]);
    data.points = std::move(points);
    sort(data.pointFields, order);
}

void sortCells(PolyData& data) {
    const PolyDataField* const first = data.cellField("particle1");
    const Order order = orderBy(first ? first : data.cellField("identity"));
    if (order.empty()) return;
    std::vector<std::int32_t> corners, ends;
    for (const std::size_t k : order) {
        const std::int32_t begin = k == 0 ? 0 : data.ends[k - 1];
        corners.insert(corners.end(), data.corners.begin() + begin, data.corners.begin() + data.ends[k]);
        ends.push_back(static_cast<std::int32_t>(corners.size()));
    }
    data.corners = std::move(corners), data.ends = std::move(ends);
    sort(data.cellFields, order);
}

}  // namespace

PolyData joined(std::vector<PolyData> pieces) {
    PolyData all = std::move(pieces.at(0));
    for (std::size_t k = 1; k < pieces.size(); ++k) append(all, pieces[k]);
    const bool isOneCell = all.kind == PolyData::Cells::Vertices && all.corners.size() == all.points.size() &&
                           all.cellFields.empty();
    isOneCell ? sortPoints(all) : sortCells(all);
    return all;
}

}  // namespace pendular
