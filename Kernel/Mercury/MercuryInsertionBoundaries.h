#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "Kernel/Mercury/MercuryBoundaries.h"
#include "Kernel/Mercury/MercuryInsertion.h"
#include "Kernel/Mercury/MercuryPSD.h"

// MercuryDPM's boundaries that bring grains. A volume that comes at once is inserted by the kernel's
// insert(), but for mixtures and flat boxes; all else comes step by step, as GrainSource has it.

namespace pendular {

/// What insertion boundaries of all shapes have.
class InsertionBoundary : public MercuryBoundary {
public:
    void setPSD(const PSD& distribution) { setPSD(std::vector{distribution}, {1}); }
    /// A distribution for each of the sorts of grains that set() was given, and the share of each in their
    /// number.
    void setPSD(const std::vector<PSD>& distributions, const std::vector<double>& shares);
    /// m^3, of the grains that come at once
    void setInitialVolume(double volume);
    /// m^3/s, of the grains that come while the scene runs
    void setVolumeFlowRate(double rate);
    /// Without effect: what comes at once has the sizes of its distribution as exactly as their number
    /// allows.
    void setManualInsertion(bool /*manual*/) {}
    /// Lets grains come now, as in a step at the start; also before the boundary is added. Throws InputError
    /// where something is not set.
    void checkBoundaryBeforeTimeStep(Scene* scene);
    void stop() override;
    [[nodiscard]] double getInitialVolume() const { return plan.atOnce; }  // m^3
    [[nodiscard]] std::uint64_t getNumberOfParticlesInserted() const;
    [[nodiscard]] double getMassOfParticlesInserted() const;    // kg
    [[nodiscard]] double getVolumeOfParticlesInserted() const;  // m^3

protected:
    using MercuryBoundary::MercuryBoundary;
    /// @param likes species, radius (without a PSD) and film of the sorts of grains
    void setGrains(const std::vector<const SphericalParticle*>& likes, unsigned maxFailed,
                   const Vec3D& lowestVelocity, const Vec3D& highestVelocity);
    /// m, corners of the box, or of a box around the region
    void setBox(const Vec3D& lowest, const Vec3D& highest);
    /// As many grains of each radius (m) between two.
    void setRadii(double smallest, double largest);
    /// Sorts with sizes of their own, in place of a PSD.
    void addSort(const SphericalParticle& like, const PSD& sizes, double share);

    GrainSource plan;  // without its sorts, which follow when it is handed over
    bool isBox = true;

private:
    /// It has a region and one of the two volumes.
    [[nodiscard]] bool isSet() const override { return hasBox && (plan.atOnce > 0 || plan.flow > 0); }
    [[nodiscard]] bool isEnough() const override { return hasBox; }
    void handOver(Scene& of) override;
    [[nodiscard]] GrainSource sourceFor(const Scene& of) const;
    void insertAtOnce(Scene& of, const GrainSource::Sort& sort);

    // The sorts; a single radius where there is no distribution, and a share of 1 where there is none.
    std::vector<SphericalParticle> grains;
    std::vector<PSD> sizes;
    std::vector<double> shares;
    bool hasBox = false;
    std::uint64_t numberAtOnce = 0;
    double massAtOnce = 0, volumeAtOnce = 0;  // kg, m^3
    GrainSource* source = nullptr;
};

/// Grains that come into a box: a volume at once, and then a volume each second. With neither, the box is
/// filled again in each step. It may be flat, as in two dimensions.
class CubeInsertionBoundary : public InsertionBoundary {
public:
    CubeInsertionBoundary() : InsertionBoundary("CubeInsertionBoundary") {}
    /// @param like species, radius (without a PSD) and film of the grains
    /// @param maxFailed tries that may fail in a step, at random places
    /// @param lowestVelocity m/s: each part is even between the bounds
    void set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero()) {
        set(std::vector{&like}, maxFailed, lowest, highest, lowestVelocity, highestVelocity);
    }
    /// The same, with as many grains of each radius (m) between two.
    void set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity, const Vec3D& highestVelocity, double smallest, double largest) {
        set(like, maxFailed, lowest, highest, lowestVelocity, highestVelocity);
        setRadii(smallest, largest);
    }
    /// The same, with a pointer to the grain.
    void set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero()) {
        set(*like, maxFailed, lowest, highest, lowestVelocity, highestVelocity);
    }
    void set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity, const Vec3D& highestVelocity, double smallest, double largest) {
        set(*like, maxFailed, lowest, highest, lowestVelocity, highestVelocity, smallest, largest);
    }
    /// Several sorts of grains.
    template <class Grain>
    void set(const std::vector<Grain*>& likes, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero()) {
        setGrains({likes.begin(), likes.end()}, maxFailed, lowestVelocity, highestVelocity);
        setBox(lowest, highest);
    }
};

/// Grains that come into a region that can be put elsewhere.
class RoundInsertionBoundary : public InsertionBoundary {
public:
    /// m
    void shiftBoundary(const Vec3D& shift);
    [[nodiscard]] const Vec3D& getOrigin() const { return origin; }
    [[nodiscard]] const Eigen::Matrix3d& getOrientationMatrix() const { return rotation; }

protected:
    using InsertionBoundary::InsertionBoundary;
    /// In its own frame: whether the centre (m) of a grain of a radius (m) is in it, and a box around it,
    /// of the centres or of whole grains.
    using Contains = std::function<bool(const Vec3D&, double)>;
    enum class BoxOf { Centres, WholeGrains };
    void setRegion(const Vec3D& lowest, const Vec3D& highest, BoxOf boxOf, Contains contains);
    void setRotation(const Eigen::Matrix3d& of) { rotation = of; }
    void turn(const Eigen::Matrix3d& by);
    /// Throws InputError unless a range (m or rad) of a region is one. @param what "radii"
    void checkRange(const char* what, double lowest, double highest, const char* unit) const;

private:
    void place();

    Vec3D origin = Vec3D::Zero(), low = Vec3D::Zero(), high = Vec3D::Zero();  // m
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    BoxOf isBoxOf = BoxOf::Centres;
    Contains isIn;
};

/// Grains that come into a ball.
class SphereInsertionBoundary : public RoundInsertionBoundary {
public:
    SphereInsertionBoundary() : RoundInsertionBoundary("SphereInsertionBoundary") {}
    /// Whole grains. @param centre m, and the radius (m)
    void set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& centre, double radius,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero());
    /// Centres between two distances (m) from the origin and in these angles (rad): theta around z from x on,
    /// up to 2 pi, and phi from z.
    void set(const SphericalParticle* like, unsigned maxFailed, double lowestRadius, double highestRadius,
             double lowestTheta, double highestTheta, double lowestPhi, double highestPhi,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero());
};

/// Grains that come into a cylinder.
class CylinderInsertionBoundary : public RoundInsertionBoundary {
public:
    CylinderInsertionBoundary() : RoundInsertionBoundary("CylinderInsertionBoundary") {}
    /// Centres between two distances (m) from the axis, two heights (m) along it, and two angles (rad) around
    /// it. @param axis x, y or z; along y the heights go backwards, as there. Turns of before are forgotten.
    void set(const SphericalParticle* like, unsigned maxFailed, double lowestRadius, double highestRadius,
             double lowestHeight, double highestHeight, const Vec3D& axis, double lowestTheta = 0,
             double highestTheta = 2 * std::numbers::pi, const Vec3D& lowestVelocity = Vec3D::Zero(),
             const Vec3D& highestVelocity = Vec3D::Zero());
    /// Turns it about its origin: about x, then about y, then about z, by these angles (rad).
    void rotateBoundary(const Vec3D& angles);
};

/// Several sorts of grains in a box, each with radii of its own.
class PolydisperseInsertionBoundary : public InsertionBoundary {
public:
    PolydisperseInsertionBoundary() : InsertionBoundary("PolydisperseInsertionBoundary") {}
    void setGeometry(unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
                     const Vec3D& lowestVelocity, const Vec3D& highestVelocity);
    /// @param share in the number of grains; @param spread radii are even in the radius times 1 - spread to
    /// 1 + spread
    void addGenerandum(const SphericalParticle* like, double share, double spread);
};

}  // namespace pendular
