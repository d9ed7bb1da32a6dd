#pragma once

#include <functional>
#include <utility>

#include "Kernel/Mercury/MercuryBoundaries.h"

// MercuryDPM's boundaries at which a scene goes on in another way than setPeriodic() has it: by copies of
// grains (Kernel/Features/GhostImages/GrainCopies.h).

namespace pendular {

/// What they have in common: GrainCopies is told of the faces.
class CopyBoundary : public MercuryBoundary {
protected:
    using MercuryBoundary::MercuryBoundary;
    /// @param toTell called when the boundary is handed over
    void setFaces(std::function<void(GrainCopies&)> toTell);
    void handOver(Scene& of) override;

    std::function<void(GrainCopies&)> tell;

private:
    [[nodiscard]] bool isSet() const override { return tell != nullptr; }
};

/// A period of any length down to a third of the distance at which grains act on each other, between planes
/// of any normal: for scenes that are as thin as a grain. PeriodicBoundary, which is faster and has no
/// copies, needs twice that distance.
class ThinPeriodicBoundary : public CopyBoundary {
public:
    ThinPeriodicBoundary() : CopyBoundary("ThinPeriodicBoundary") {}
    /// @param normal of any length, of which both distances are measured in
    void set(const Vec3D& normal, double lowest, double highest);
};

/// A wedge that is repeated by turning it.
class AngledPeriodicBoundary : public CopyBoundary {
public:
    AngledPeriodicBoundary() : CopyBoundary("AngledPeriodicBoundary") {}
    /// @param left normal of the first face, into the wedge, and @param right of the second one, out of it,
    /// of any length; @param origin m, on the line in which they meet
    void set(const Vec3D& left, const Vec3D& right, const Vec3D& origin);
};

/// A period whose images are moved along the faces as well.
class TimeDependentPeriodicBoundary : public CopyBoundary {
public:
    TimeDependentPeriodicBoundary() : CopyBoundary("TimeDependentPeriodicBoundary") {}
    /// @param shift m, of the image beyond the right face, and @param velocity m/s, its derivative, by the
    /// time (s)
    void set(const Vec3D& normal, double left, double right, std::function<Vec3D(double)> shift,
             std::function<Vec3D(double)> velocity);
    /// Without effect: where the scene is periodic along the faces, too, it is brought back there.
    void setMaxShift(double /*shift*/) {}
};

/// A box of grains that feeds a flow. It opens when the run begins, or by activateMaser().
class MaserBoundary : public CopyBoundary {
public:
    /// @param normal of any length, of which both distances are measured in; @param shift m, of the right
    /// face along the faces
    void set(const Vec3D& normal, const Vec3D& shift, double left, double right);
    void set(const Vec3D& normal, double left, double right) { set(normal, Vec3D::Zero(), left, right); }
    /// Opens the maser now, in a run.
    void activateMaser();
    [[nodiscard]] bool isActivated() const { return isOpen; }

protected:
    using CopyBoundary::CopyBoundary;

private:
    /// It waits until all grains are there.
    [[nodiscard]] bool isSet() const override { return isOpen; }
    [[nodiscard]] bool isEnough() const override { return highest > lowest; }
    void handOver(Scene& of) override;
    /// m, between box and flow
    [[nodiscard]] virtual double gapIn(Scene& of) const = 0;

    Vec3D direction = Vec3D::Zero(), alongFaces = Vec3D::Zero();
    double lowest = 0, highest = 0;  // m
    bool isOpen = false;
};

/// The box goes on into the flow without a gap, and what is in the flow acts on it.
class SubcriticalMaserBoundary : public MaserBoundary {
public:
    SubcriticalMaserBoundary() : MaserBoundary("SubcriticalMaserBoundary") {}

private:
    [[nodiscard]] double gapIn(Scene& /*of*/) const override { return 0; }
};

/// The box is moved back by a gap of six times the largest radius when it opens, as there, so that the flow
/// begins at the right face and nothing of it acts on the box.
class ConstantMassFlowMaserBoundary : public MaserBoundary {
public:
    ConstantMassFlowMaserBoundary() : MaserBoundary("ConstantMassFlowMaserBoundary") {}
    [[nodiscard]] double getGapSize() const { return gap; }  // m; 0 before it opens

private:
    [[nodiscard]] double gapIn(Scene& of) const override;

    mutable double gap = 0;
};

}  // namespace pendular
