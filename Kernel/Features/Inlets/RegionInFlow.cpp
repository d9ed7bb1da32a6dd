#include "Kernel/Features/Inlets/RegionInFlow.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

RegionInFlow::RegionInFlow(std::shared_ptr<const Region> of, const PeriodicBox& atSetUp)
    : region(std::move(of)), then(atSetUp), open(region->openAxes()) {}

Vector<double> RegionInFlow::placeNow(const Vector<double>& place, const PeriodicBox& now) const {
    if (!now.imagesMove) return place;
    const Vector<double> middle = now.middle(), middleThen = then.middle();
    Vector<double> moved = place;
    for (std::size_t k = 0; k < 3; ++k)
        if (open[k] && now.length.*vectorAxes[k] != then.length.*vectorAxes[k])
            moved.*vectorAxes[k] =
                middle.*vectorAxes[k] + (place.*vectorAxes[k] - middleThen.*vectorAxes[k]) *
                                            (now.length.*vectorAxes[k] / then.length.*vectorAxes[k]);
    return moved;
}

PeriodicBox RegionInFlow::boxNow(const PeriodicBox& now) const {
    PeriodicBox box = now;
    box.lowest = placeNow(region->bounds().lowest, now);
    return box;
}

void RegionInFlow::requireRoom(const std::string& owner, const PeriodicBox& now) const {
    if (!now.imagesMove) return;
    const Box bounds = region->bounds();
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = bounds.highest.*vectorAxes[k] - bounds.lowest.*vectorAxes[k],
                     period = now.length.*vectorAxes[k];
        if (open[k] || period == 0 || length <= period * (1 + 1e-12)) continue;
        throw RunError(fmt::format(
            "{}: the scene has been strained to a period of {:.6g} m along {}, and its region, of {:.6g} m, "
            "is longer; take a smaller one, or one from face to face.",
            owner, period, "xyz"[k], length));
    }
}

}  // namespace pendular
