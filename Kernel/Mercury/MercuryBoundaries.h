#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "Kernel/Features/GhostImages/GrainCopies.h"
#include "Kernel/Mercury/MercuryActions.h"
#include "Kernel/Mercury/MercuryInsertion.h"
#include "Kernel/Scene/Scene.h"

// MercuryDPM's boundaries, as far as the kernel has what they do: each is handed to it when it is both added
// and set, in whichever order. What is set after that is refused.

namespace pendular {

/// The parts of a MercuryScene's step that its boundaries work by.
struct MercuryParts {
    GrainCopies* copies;
    MercuryInsertions* insertions;
    MercuryActions* actions;
};

class MercuryBoundary {
public:
    virtual ~MercuryBoundary() = default;

    /// Throws InputError for what the kernel refuses.
    void addTo(Scene& of, const MercuryParts& with);
    /// Called at set-up, when the driver has set all that it will: hands over what does without more.
    void settle();
    /// Throws InputError for one that was added and not set.
    void requireSet() const;
    /// It acts no more from now on. Throws InputError for one that the kernel keeps for good.
    virtual void stop();

protected:
    explicit MercuryBoundary(const char* ofName) : name(ofName) {}
    MercuryBoundary(const MercuryBoundary&) = default;
    MercuryBoundary& operator=(const MercuryBoundary&) = default;

    /// Throws InputError if the scene has it already. @param call for the sentence
    void requireChangeable(const char* call) const;
    /// Hands it to the scene, if it is added and set.
    void handOverWhenSet();
    /// Throws InputError unless the scene has it.
    [[nodiscard]] Scene& sceneThatHasIt() const;
    [[nodiscard]] virtual bool isSet() const = 0;
    /// Whether it has a meaning as it is, though more may be set.
    [[nodiscard]] virtual bool isEnough() const { return isSet(); }
    virtual void handOver(Scene& of) = 0;
    /// Of the scene that has it.
    [[nodiscard]] GrainCopies& copies() const { return *parts.copies; }
    [[nodiscard]] MercuryInsertions& insertions() const { return *parts.insertions; }
    [[nodiscard]] MercuryActions& actions() const { return *parts.actions; }
    [[nodiscard]] bool isAdded() const { return scene != nullptr; }

    const char* name;

private:
    Scene* scene = nullptr;  // null before it is added
    MercuryParts parts{};
    bool isHandedOver = false;
};

/// setPeriodic(axis, lowest, highest)
class PeriodicBoundary : public MercuryBoundary {
public:
    PeriodicBoundary() : MercuryBoundary("PeriodicBoundary") {}
    /// @param normal (1, 0, 0), (0, 1, 0) or (0, 0, 1); @param lowest m; @param highest m
    /// Throws InputError for another normal.
    void set(const Vec3D& normal, double lowest, double highest);
    /// Between two points (m).
    void set(const Vec3D& normal, const Vec3D& lowest, const Vec3D& highest) {
        set(normal, normal.dot(lowest), normal.dot(highest));
    }

private:
    [[nodiscard]] bool isSet() const override { return axis >= 0; }
    void handOver(Scene& of) override { of.setPeriodic(axis, low, high); }

    int axis = -1;
    double low = unset, high = unset;  // m
};

/// setLeesEdwards() of a scene that is periodic along x and y: images along y move along x.
class LeesEdwardsBoundary : public MercuryBoundary {
public:
    LeesEdwardsBoundary() : MercuryBoundary("LeesEdwardsBoundary") {}
    /// @param shift m, and @param velocity m/s, of the image above by the time (s): a steady flow that begins
    /// with no shift, or InputError is thrown; @param left m, and the other faces
    void set(const std::function<double(double)>& shift, const std::function<double(double)>& velocity,
             double left, double right, double down, double up);

private:
    [[nodiscard]] bool isSet() const override { return low.has_value(); }
    void handOver(Scene& of) override;

    std::optional<Vec3D> low, high;  // m
    double speed = 0;                // m/s
};

/// An outlet beyond a plane.
class DeletionBoundary : public MercuryBoundary {
public:
    DeletionBoundary() : DeletionBoundary("DeletionBoundary") {}
    /// Grains go whose centres have position.dot(normal) above the distance (m). @param normal of any length,
    /// of which the distance is measured in
    void set(const Vec3D& normal, double distance);
    [[nodiscard]] std::uint64_t getNumberOfParticlesDeleted() const { return count().number; }
    [[nodiscard]] double getMassOfParticlesDeleted() const { return count().mass; }  // kg
    [[nodiscard]] double getVolumeOfParticlesDeleted() const;                        // m^3

protected:
    explicit DeletionBoundary(const char* ofName) : MercuryBoundary(ofName) {}
    void setOutlet(const Outlet& where);

private:
    [[nodiscard]] bool isSet() const override { return outlet.has_value(); }
    void handOver(Scene& of) override { number = of.outletHandler.copyAndAddObject(*outlet); }
    [[nodiscard]] GrainTally::Entry count() const;

    std::optional<Outlet> outlet;
    std::size_t number = 0;
};

/// An outlet in a box.
class CubeDeletionBoundary : public DeletionBoundary {
public:
    CubeDeletionBoundary() : DeletionBoundary("CubeDeletionBoundary") {}
    void set(const Vec3D& lowest, const Vec3D& highest);
};

/// A plane that counts the grains that go through it.
class FluxBoundary : public MercuryBoundary, public ActsInSteps {
public:
    FluxBoundary() : MercuryBoundary("FluxBoundary") {}
    /// @param normal of any length, of which the distance (m) is measured in
    void set(const Vec3D& normal, double distance);
    /// The plane is at this distance at the time (s): grains that it passes count, too. At set-up.
    void setPrescribedDistance(std::function<double(double)> distance);
    [[nodiscard]] std::uint64_t getNumberOfParticlesCrossedForw() const { return count().forwards; }
    [[nodiscard]] std::uint64_t getNumberOfParticlesCrossedBack() const { return count().backwards; }
    [[nodiscard]] std::int64_t getNumberOfParticlesCrossedNet() const { return count().net(); }
    [[nodiscard]] double getMassOfParticlesCrossedForw() const { return count().massForwards; }   // kg
    [[nodiscard]] double getMassOfParticlesCrossedBack() const { return count().massBackwards; }  // kg
    [[nodiscard]] double getMassOfParticlesCrossedNet() const { return count().netMass(); }       // kg
    // m^3; throw InputError in a scene of several densities, as the kernel counts masses.
    [[nodiscard]] double getVolumeOfParticlesCrossedForw() const { return volumeOf(count().massForwards); }
    [[nodiscard]] double getVolumeOfParticlesCrossedBack() const { return volumeOf(count().massBackwards); }
    [[nodiscard]] double getVolumeOfParticlesCrossedNet() const { return volumeOf(count().netMass()); }

    void act(StepContext& step) override;
    /// A distance that depends on the time is compared by its values at the start and now.
    void compareSetUp(StateArchive& archive, double now) const override;
    void visitState(StateArchive& archive) override;

private:
    [[nodiscard]] bool isSet() const override { return plane.has_value(); }
    void handOver(Scene& of) override;
    [[nodiscard]] FluxCount count() const;
    [[nodiscard]] double volumeOf(double mass) const;

    std::optional<FluxPlane> plane;
    std::size_t number = 0;
    // Of a plane that moves, which the kernel's do not: what it has counted, and who was beyond it.
    std::function<double(double)> prescribed;
    FluxCount own;
    std::set<std::uint32_t> beyond, known;
};

/// The boundaries of a MercuryScene.
class MercuryBoundaryHandler {
public:
    MercuryBoundaryHandler(Scene& ofScene, const MercuryParts& ofParts) : scene(&ofScene), parts(ofParts) {}
    MercuryBoundaryHandler(const MercuryBoundaryHandler&) = delete;

    /// Adds a copy, and hands it to the kernel when it is set; the pointer stays valid.
    template <std::derived_from<MercuryBoundary> Boundary>
    Boundary* copyAndAddObject(const Boundary& boundary) {
        auto copy = std::make_unique<Boundary>(boundary);
        Boundary* const added = copy.get();
        addObject(copy.release());
        return added;
    }
    /// Takes the boundary itself, which was made by `new`.
    template <std::derived_from<MercuryBoundary> Boundary>
    void addObject(Boundary* boundary) {
        std::unique_ptr<MercuryBoundary> own(boundary);
        own->addTo(*scene, parts);
        all.push_back(std::move(own));
    }
    /// Those behind it have a number less from then on, as there. Throws InputError for one that the kernel
    /// keeps for good.
    void removeObject(std::size_t number);
    void clear() {
        while (!all.empty()) removeObject(all.size() - 1);
    }
    /// Without effect: boundaries have no pictures, as a line of the log says.
    void setWriteVTK(bool write);
    template <std::derived_from<MercuryBoundary> Boundary>
    Boundary* copyAndAddObject(const Boundary* boundary) {
        return copyAndAddObject(*boundary);
    }
    template <class Other>
    requires(!std::derived_from<Other, MercuryBoundary> &&
             !std::is_pointer_v<Other>) void copyAndAddObject(const Other&) {
        static_assert(std::derived_from<Other, MercuryBoundary>,
                      "a boundary is added to boundaryHandler, a wall is added to wallHandler");
    }
    [[nodiscard]] std::size_t getNumberOfObjects() const { return all.size(); }
    [[nodiscard]] std::size_t getSize() const { return all.size(); }
    /// Throws InputError if there is none.
    [[nodiscard]] MercuryBoundary* getObject(std::size_t number) const;
    [[nodiscard]] MercuryBoundary* getLastObject() const;
    void settle() {
        for (const auto& boundary : all) boundary->settle();
    }
    /// Throws InputError if one of them was not set.
    void requireSet() const {
        for (const auto& boundary : all) boundary->requireSet();
    }

private:
    Scene* scene;
    MercuryParts parts;
    std::vector<std::unique_ptr<MercuryBoundary>> all;
    std::vector<std::unique_ptr<MercuryBoundary>> removed;  // drivers may still have pointers to them
};

}  // namespace pendular
