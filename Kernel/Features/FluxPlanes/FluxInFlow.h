#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// What goes through a plane in a step in which the images of a periodic scene move. A body is kept at one of
/// its images, and all of them go straight. The plane stays where it is: of the images that follow each other
/// along its normal that one counts which is at the plane, and of those beside each other along the plane
/// that one which is inside the box. Where a body leaves the box through the face along the gradient of a
/// shear, its image inside goes on elsewhere, which is no passage.
class FluxInFlow {
public:
    struct Plane {
        Vector<double> normal;  // unit
        double offset;          // m
        int axis;               // along which it has images, along its normal; -1: it has none
    };
    /// @param before, after the box at the start and at the end of a step (s)
    FluxInFlow(const PeriodicBox& before, const PeriodicBox& after, double step, const Plane& of)
        : box0(before), box1(after), plane(of), shift0(before.imageShift), shift1(after.imageShift) {
        for (int k = 0; k < 3; ++k)
            if (after.across.*vectorAxes[k] > 0) gradient = k;
        if (gradient < 0) return;
        for (int k = 0; k < 3; ++k)
            if (k != gradient &&
                (after.imageVelocity.*vectorAxes[k] != 0 || before.imageShift.*vectorAxes[k] != 0 ||
                 after.imageShift.*vectorAxes[k] != 0))
                flow = k;
        if (flow < 0) return;
        // The box knows the shift up to whole periods.
        const auto along = vectorAxes[static_cast<std::size_t>(flow)];
        const double slid = shift0.*along + step * after.imageVelocity.*along;
        periodsSlid = std::nearbyint((slid - shift1.*along) / after.length.*along);
        shift1.*along += periodsSlid * after.length.*along;
    }

    /// Calls found(times along the normal, way in the step in m) for each way of a body (m) through the plane
    /// or its images.
    template <class Found>
    void forEachPassage(const Vector<double>& from, const Vector<double>& to, Found&& found) const {
        if (plane.axis < 0) return alongNoPeriod(from, to, found);
        if (plane.axis == flow) return alongFlow(from, to, found);
        const double first = imagesBehind(along(from, plane.axis), box0),
                     last = imagesBehind(along(to, plane.axis), box1);
        if (first == last) return;
        found(last - first, wayOf(from, to, acrossNumber(to), std::max(first, last)));
    }

private:
    static double along(const Vector<double>& v, int axis) {
        return v.*vectorAxes[static_cast<std::size_t>(axis)];
    }

    template <class Found>
    void alongNoPeriod(const Vector<double>& from, const Vector<double>& to, Found&& found) const {
        const auto isBehind = [&](const Vector<double>& p) {
            return dot(plane.normal, p) - plane.offset >= 0;
        };
        if (isBehind(from) == isBehind(to)) return;
        found(isBehind(to) ? 1.0 : -1.0, wayOf(from, to, acrossNumber(to), 0));
    }

    /// The image inside the box is another one where the body goes through the face along the gradient.
    template <class Found>
    void alongFlow(const Vector<double>& from, const Vector<double>& to, Found&& found) const {
        const double begin = box0.imageOf(from), end = box1.imageOf(to);
        const auto tell = [&](double first, double last, double number) {
            if (first != last) found(last - first, wayOf(from, to, number, 0));
        };
        const double first = behindOf(along(from, flow) - begin * along(shift0, flow), 0),
                     last = behindOf(along(to, flow) - end * along(box1.imageShift, flow), end * periodsSlid);
        if (begin == end) return tell(first, last, begin);
        const double share = shareAtFace(from, to, std::max(begin, end));
        const double place = along(from, flow) + share * (along(to, flow) - along(from, flow)),
                     shift = along(shift0, flow) + share * (along(shift1, flow) - along(shift0, flow));
        tell(first, behindOf(place - begin * shift, 0), begin);
        tell(behindOf(place - end * shift, 0), last, end);
    }

    /// The share of the step at which a body is at the lower face of an image along the gradient.
    [[nodiscard]] double shareAtFace(const Vector<double>& from, const Vector<double>& to,
                                     double image) const {
        const auto above = [&](const Vector<double>& p, const PeriodicBox& box) {
            return along(p, gradient) - along(box.lowest, gradient) - image * along(box.length, gradient);
        };
        const double first = above(from, box0), last = above(to, box1);
        return first == last ? 0 : std::clamp(first / (first - last), 0.0, 1.0);
    }

    /// The number of images of the plane behind a place along the flow, less so many periods.
    [[nodiscard]] double behindOf(double place, double periods) const {
        return imagesBehind(place, box1) - facing() * periods;
    }
    [[nodiscard]] double facing() const { return along(plane.normal, plane.axis) < 0 ? -1 : 1; }
    /// The number of images of the plane, counted along its normal, that are behind a place along its axis.
    [[nodiscard]] double imagesBehind(double place, const PeriodicBox& box) const {
        return std::floor((facing() * place - plane.offset) / along(box.length, plane.axis));
    }

    /// The number of images along the gradient by which a body is outside the box.
    [[nodiscard]] double acrossNumber(const Vector<double>& to) const {
        return gradient < 0 ? 0 : box1.imageOf(to);
    }

    /// The way of the image that counts. @param number of the image along the gradient; @param atPlane that
    /// along the normal, counted along it
    [[nodiscard]] Vector<double> wayOf(const Vector<double>& from, const Vector<double>& to, double number,
                                       double atPlane) const {
        const double own = facingNumber(atPlane);
        if (plane.axis >= 0 && plane.axis == gradient) number = own;
        Vector<double> way = to - from - number * (shift1 - shift0);
        const Vector<double> inside = gradient < 0 ? to : to - number * shift1;
        for (int k = 0; k < 3; ++k) {
            const auto axis = vectorAxes[static_cast<std::size_t>(k)];
            const double length = box1.length.*axis;
            if (k == gradient || length == 0 || length == box0.length.*axis) continue;
            const double images =
                k == plane.axis ? own : std::floor((inside.*axis - box1.lowest.*axis) / length);
            way.*axis -= images * (length - box0.length.*axis);
        }
        return way;
    }
    [[nodiscard]] double facingNumber(double atPlane) const {
        return plane.axis < 0 ? 0 : facing() * atPlane;
    }

    const PeriodicBox &box0, &box1;
    Plane plane;
    Vector<double> shift0, shift1;  // m, of the next image along the gradient
    double periodsSlid = 0;
    int gradient = -1, flow = -1;
};

}  // namespace pendular
