#pragma once

#include "Kernel/Core/Walls/RigidWall.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

namespace pendular::scenes {

/// A plane surface with a size, so that it can be a body that moves in space. Grains must not reach its rim.
class Plate final : public RigidWall {
public:
    /// @param outward into it; @param point m, its centre; @param size m, its radius
    void set(const Vec3D& outward, const Vec3D& point, double size) {
        normal = checkedDirection("Plate", "normal", outward);
        centre = toVector(point), radius = size;
        takePlace();
    }
    [[nodiscard]] bool hasConvexParts() const override { return true; }

protected:
    void listInBody(const Vector<double>& place, double reach,
                    std::vector<std::uint32_t>& parts) const override {
        if (gap(place) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& place, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        points[0] = {normal, gap(place), {0, 0, 0}};
    }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override {
        return gap(from) >= 0 && gap(to) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::None, centre, radius};
    }

private:
    [[nodiscard]] double gap(const Vector<double>& place) const { return dot(normal, centre - place); }

    Vector<double> normal{0, 0, -1}, centre{0, 0, 0};
    double radius = 0;  // m
};

/// A few superquadrics and plates.
template <class S>
class SuperquadricsAtPlates : public FewSuperquadrics<S> {
public:
    SuperquadricsAtPlates(const S& material, const std::vector<SuperquadricMotion>& grains, double step)
        : FewSuperquadrics<S>(material, grains, step) {}
    Plate* addPlate(Plate plate) {
        plate.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(plate);
    }
};

}  // namespace pendular::scenes
