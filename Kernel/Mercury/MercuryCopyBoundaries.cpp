#include "Kernel/Mercury/MercuryCopyBoundaries.h"

namespace pendular {

void CopyBoundary::setFaces(std::function<void(GrainCopies&)> toTell) {
    requireChangeable("set()");
    tell = std::move(toTell);
    handOverWhenSet();
}

void CopyBoundary::handOver(Scene& of) {
    tell(copies());
    // A part that the run began without is looked at again where a grain has changed.
    if (of.getNumberOfTimeSteps() > 0 && !of.particleHandler.isEmpty()) {
        GrainReference grain = of.particleHandler.getLastObject();
        grain.setRadius(grain.getRadius());
    }
}

/// The unit normal, and its length, in which distances are measured. Throws InputError for the length 0.
static std::pair<Vec3D, double> unitOf(const char* boundary, const Vec3D& normal) {
    checkValue(boundary, "length of the normal", normal.norm(), "", positive);
    return {normal.normalized(), normal.norm()};
}

void ThinPeriodicBoundary::set(const Vec3D& normal, double lowest, double highest) {
    const auto& [unit, length] = unitOf(name, normal);
    setFaces([unit = unit, low = lowest / length, high = highest / length](GrainCopies& with) {
        with.addPeriod(unit, low, high);
    });
}

void AngledPeriodicBoundary::set(const Vec3D& left, const Vec3D& right, const Vec3D& origin) {
    setFaces([in = unitOf(name, left).first, out = unitOf(name, right).first, origin](GrainCopies& with) {
        with.addTurn(in, out, origin);
    });
}

void TimeDependentPeriodicBoundary::set(const Vec3D& normal, double left, double right,
                                        std::function<Vec3D(double)> shift,
                                        std::function<Vec3D(double)> velocity) {
    const auto& [unit, length] = unitOf(name, normal);
    setFaces([unit = unit, low = left / length, high = right / length, shift = std::move(shift),
              velocity = std::move(velocity)](GrainCopies& with) {
        with.addPeriod(unit, low, high, shift, velocity);
    });
}

void MaserBoundary::set(const Vec3D& normal, const Vec3D& shift, double left, double right) {
    requireChangeable("set()");
    const auto& [unit, length] = unitOf(name, normal);
    checkValue(name, "right", right, "m", {left, infinity, false, false});
    direction = unit, alongFaces = shift;
    lowest = left / length, highest = right / length;
}

void MaserBoundary::activateMaser() {
    if (!isEnough()) return requireSet();
    isOpen = true;
    handOverWhenSet();
}

void MaserBoundary::handOver(Scene& of) {
    isOpen = true;
    const double gap = gapIn(of), low = lowest - gap, high = highest - gap;
    if (gap > 0)
        for (GrainReference grain : of.particleHandler) {
            const double at = direction.dot(grain.getPosition());
            if (at >= lowest && at <= highest) grain.move(-gap * direction);
        }
    tell = [=, this](GrainCopies& with) { with.addMaser(direction, low, high, alongFaces, gap); };
    CopyBoundary::handOver(of);
}

double ConstantMassFlowMaserBoundary::gapIn(Scene& of) const {
    if (of.particleHandler.isEmpty()) return gap = 0;
    return gap = 6 * of.particleHandler.getLargestParticle().getRadius();
}

}  // namespace pendular
