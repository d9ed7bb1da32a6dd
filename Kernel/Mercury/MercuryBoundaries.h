#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "Kernel/Mercury/MercuryPSD.h"
#include "Kernel/Simulation/Scene.h"

// MercuryDPM's boundaries, as far as the kernel has what they do: each is handed to it when it is added.

namespace pendular {

class MercuryBoundary {
public:
    virtual ~MercuryBoundary() = default;

protected:
    MercuryBoundary() = default;
    MercuryBoundary(const MercuryBoundary&) = default;
    MercuryBoundary& operator=(const MercuryBoundary&) = default;
};

/// setPeriodic(axis, lowest, highest)
class PeriodicBoundary : public MercuryBoundary {
public:
    /// @param normal (1, 0, 0), (0, 1, 0) or (0, 0, 1); @param lowest m; @param highest m
    /// Throws InputError for another normal.
    void set(const Vec3D& normal, double lowest, double highest);
    void addTo(Scene& scene) { scene.setPeriodic(axis, low, high); }

private:
    int axis = -1;
    double low = unset, high = unset;  // m
};

/// An outlet beyond a plane.
class DeletionBoundary : public MercuryBoundary {
public:
    /// Grains go whose centres have position.dot(normal) above the distance (m). @param normal of any length,
    /// of which the distance is measured in
    void set(const Vec3D& normal, double distance);
    void addTo(Scene& of);
    [[nodiscard]] std::uint64_t getNumberOfParticlesDeleted() const { return count().number; }
    [[nodiscard]] double getMassOfParticlesDeleted() const { return count().mass; }  // kg

protected:
    Outlet outlet;

private:
    [[nodiscard]] GrainTally::Entry count() const;

    Scene* scene = nullptr;  // null before it is added
    std::size_t number = 0;
};

/// An outlet in a box.
class CubeDeletionBoundary : public DeletionBoundary {
public:
    void set(const Vec3D& lowest, const Vec3D& highest) { outlet.setRegion(BoxRegion(lowest, highest)); }
};

/// A plane that counts the grains that go through it.
class FluxBoundary : public MercuryBoundary {
public:
    /// @param normal of any length, of which the distance (m) is measured in
    void set(const Vec3D& normal, double distance);
    void addTo(Scene& of);
    [[nodiscard]] std::uint64_t getNumberOfParticlesCrossedForw() const { return count().forwards; }
    [[nodiscard]] std::uint64_t getNumberOfParticlesCrossedBack() const { return count().backwards; }
    [[nodiscard]] std::int64_t getNumberOfParticlesCrossedNet() const { return count().net(); }
    [[nodiscard]] double getMassOfParticlesCrossedForw() const { return count().massForwards; }   // kg
    [[nodiscard]] double getMassOfParticlesCrossedBack() const { return count().massBackwards; }  // kg
    [[nodiscard]] double getMassOfParticlesCrossedNet() const { return count().netMass(); }       // kg

private:
    [[nodiscard]] FluxCount count() const;

    FluxPlane plane{Vec3D::Zero(), Vec3D::Zero()};
    const Scene* scene = nullptr;  // null before it is added
    std::size_t number = 0;
};

/// Grains that come into a box: a volume at once, by insert(), and then a volume each second, by an inlet.
class CubeInsertionBoundary : public MercuryBoundary {
public:
    /// @param like species, radius (without a PSD) and film of the grains
    /// @param maxFailed random places that a grain is tried at in a step, less one
    /// @param lowestVelocity m/s, of all of them: the other bound must be the same
    void set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity = Vec3D::Zero(), const Vec3D& highestVelocity = Vec3D::Zero());
    /// The same, with as many grains of each radius (m) between two.
    void set(const SphericalParticle& like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const Vec3D& lowestVelocity, const Vec3D& highestVelocity, double smallest, double largest);
    /// The same, with a pointer to the grain.
    template <class... More>
    void set(const SphericalParticle* like, unsigned maxFailed, const Vec3D& lowest, const Vec3D& highest,
             const More&... more) {
        set(*like, maxFailed, lowest, highest, more...);
    }
    void setPSD(const PSD& distribution) { sizes = distribution.sizes(); }
    /// m^3, of the grains that come at once
    void setInitialVolume(double volume);
    /// m^3/s, of the grains that come while the scene runs
    void setVolumeFlowRate(double rate);
    /// Throws InputError unless it has one of the two; insert() says what else.
    void addTo(Scene& of);
    [[nodiscard]] std::uint64_t getNumberOfParticlesInserted() const;
    [[nodiscard]] double getMassOfParticlesInserted() const;  // kg

private:
    [[nodiscard]] SizeDistribution sizesOfGrains() const;

    SphericalParticle grain;
    std::optional<BoxRegion> region;
    std::optional<SizeDistribution> sizes;
    std::uint32_t tries = 1;
    double initialVolume = 0, flow = 0;  // m^3, m^3/s
    const Scene* scene = nullptr;        // null before it is added
    Inserted atOnce;
    std::optional<std::size_t> inlet;
};

/// The boundaries of a MercuryScene.
class MercuryBoundaryHandler {
public:
    explicit MercuryBoundaryHandler(Scene& ofScene) : scene(&ofScene) {}
    MercuryBoundaryHandler(const MercuryBoundaryHandler&) = delete;

    /// Adds a copy, and hands it to the kernel; the pointer stays valid.
    template <std::derived_from<MercuryBoundary> Boundary>
    Boundary* copyAndAddObject(const Boundary& boundary) {
        auto copy = std::make_unique<Boundary>(boundary);
        copy->addTo(*scene);
        Boundary* const added = copy.get();
        all.push_back(std::move(copy));
        return added;
    }
    [[nodiscard]] std::size_t getNumberOfObjects() const { return all.size(); }
    [[nodiscard]] std::size_t getSize() const { return all.size(); }
    /// Throws InputError if there is none.
    [[nodiscard]] MercuryBoundary* getObject(std::size_t number) const;
    [[nodiscard]] MercuryBoundary* getLastObject() const { return getObject(all.size() - 1); }

private:
    Scene* scene;
    std::vector<std::unique_ptr<MercuryBoundary>> all;
};

}  // namespace pendular
