#pragma once

#include "Kernel/Walls/RigidWall.h"
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

/// Superquadrics that may touch plates.
class ShapesAtPlates final : public GrainShapes {
public:
    explicit ShapesAtPlates(const SuperquadricHandler& of) : shapes(of) {}

    [[nodiscard]] ShapedTouch touch(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                                    const Vector<double>& shift) const override {
        return shapes.touch(grains, first, second, shift);
    }
    [[nodiscard]] ShapedTouch touchAtPlane(const ParticleStore& grains, std::uint32_t grain,
                                           const Vector<double>& normal, double distance) const override {
        return shapes.touchAtPlane(grains, grain, normal, distance);
    }
    [[nodiscard]] const Superquadric& shapeAt(const ParticleStore& grains,
                                              std::uint32_t place) const override {
        return shapes.shapeAt(grains, place);
    }
    [[nodiscard]] ShapeExtremes extremesAt(const ParticleStore& grains, std::uint32_t place) const override {
        return shapes.extremesAt(grains, place);
    }
    [[nodiscard]] double thickness(const ParticleStore& grains, std::uint32_t grain) const override {
        return shapes.thickness(grains, grain);
    }
    void check(const WallHandler&) const override { shapes.requireAll(); }

private:
    const SuperquadricHandler& shapes;
};

template <class S>
class LawsAtPlates final : public SuperquadricLaws<S> {
public:
    LawsAtPlates(SpeciesHandler<S>& species, SuperquadricHandler& superquadrics)
        : SuperquadricLaws<S>(species, superquadrics), atPlates(superquadrics) {}
    [[nodiscard]] const GrainShapes* shapes() const override { return &atPlates; }

private:
    ShapesAtPlates atPlates;
};

template <class S>
class SuperquadricsAtPlates : public FewSuperquadrics<S> {
public:
    SuperquadricsAtPlates(const S& material, const std::vector<SuperquadricMotion>& grains, double step)
        : FewSuperquadrics<S>(material, grains, step) {
        this->setLaws(laws);
    }
    ~SuperquadricsAtPlates() override { this->completeLeftRun(); }
    Plate* addPlate(Plate plate) {
        plate.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(plate);
    }

private:
    LawsAtPlates<S> laws{this->speciesHandler, this->superquadricHandler};
};

}  // namespace pendular::scenes
