#pragma once

#include "Kernel/Scene/DomainBox.h"

namespace pendular {

/// The box of a MercuryScene (m), whose bounds are set one by one. As in MercuryDPM each is 0 at first. The
/// scene's own box follows as soon as it can: when no lowest bound is above the highest one.
class MercuryDomain {
public:
    explicit MercuryDomain(DomainBox& ofScene) : scene(&ofScene) {}

    void setLowest(int axis, double value) { lowest[axis] = value, pass(); }
    void setHighest(int axis, double value) { highest[axis] = value, pass(); }
    void set(const Vec3D& low, const Vec3D& high) { lowest = low, highest = high, pass(); }
    [[nodiscard]] const Vec3D& getLowest() const { return lowest; }
    [[nodiscard]] const Vec3D& getHighest() const { return highest; }

private:
    void pass() {
        const bool ordered = !(lowest.array() > highest.array()).any();
        if (ordered) scene->setDomain(lowest, highest);
    }

    DomainBox* scene;
    Vec3D lowest = Vec3D::Zero(), highest = Vec3D::Zero();
};

}  // namespace pendular
