#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Features/Insertion/BodyMixture.h"
#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Foundation/Math/BoxTree.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular {

class Scene;

/// Whether a grain overlaps no other one, and no wall.
bool hasRoomFor(const Scene& scene, const SphericalParticle& grain);

/// The grains of one of MercuryDPM's insertion boundaries. In each step grains are tried at random places,
/// one after the other, until one more than `maxFailed` tries have failed in the step, or the volume that is
/// due has come. The box may be flat, as it is in two dimensions.
class GrainSource {
public:
    /// A sort of grains, and its share in their number.
    struct Sort {
        SphericalParticle like;
        SizeDistribution sizes;
        double share = 1;
    };
    std::vector<Sort> sorts;
    unsigned maxFailed = 0;
    Vec3D lowest = Vec3D::Zero(), highest = Vec3D::Zero();  // m, the box
    /// A centre (m) for a radius (m), where the region is not the box; none: the centre does not fit.
    std::function<std::optional<Vec3D>(UniformRandom&, double)> place;
    Vec3D lowVelocity = Vec3D::Zero(), highVelocity = Vec3D::Zero();  // m/s, each part is even between
    double atOnce = 0, flow = 0;  // m^3, m^3/s; neither: as much as has room
    UniformRandom random{0};

    // What has come.
    std::uint64_t number = 0;
    double mass = 0, volume = 0;  // kg, m^3

    /// Lets grains come until a time (s).
    void letIn(ParticleHandler& particles, const WallHandler& walls, const PeriodicBox& box, double time);
    void compareSetUp(StateArchive& archive) const;
    void visitState(StateArchive& archive);

private:
    [[nodiscard]] double largestRadius() const;
    [[nodiscard]] Vec3D placeInBox(double radius);
    void drawNext();
    void add(ParticleHandler& particles, const Vec3D& at);

    // The next grain, which is tried until there is room for it.
    std::size_t nextSort = 0;
    double nextRadius = unset;  // m
};

/// The sources of a scene, which let in grains at the end of each step.
class MercuryInsertions : public StepPart {
public:
    /// The pointer stays valid. Throws InputError in a run that began without any.
    GrainSource* add(GrainSource source);
    /// From now on nothing comes of it any more.
    void stop(const GrainSource* source);

    [[nodiscard]] std::string_view name() const override { return "insertion boundaries"; }
    [[nodiscard]] Features features(const StepContext& /*scene*/) const override {
        return sources.empty() ? Features{} : Features{Feature::OwnPart};
    }
    [[nodiscard]] bool needsFinishedStep() const override { return false; }
    void begin(StepContext& /*scene*/, bool /*isRestarted*/) override { hasBegun = true; }
    void atEnd(StepContext& step) override;
    void compareSetUp(StateArchive& archive, StepContext& scene) override;
    void visitState(StateArchive& archive, StepContext& scene) override;

private:
    struct Kept {
        GrainSource source;
        bool isStopped = false;
    };
    std::deque<Kept> sources;           // also stopped ones, which a restart file has, too
    std::vector<GrainSource*> running;  // those that a step goes through
    bool hasBegun = false;
};

}  // namespace pendular
