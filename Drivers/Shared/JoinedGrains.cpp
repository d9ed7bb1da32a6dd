#include "Drivers/Shared/JoinedGrains.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Scene/Scene.h"

namespace pendular::scenes {

BodyMass massOfSpheres(Scene& scene, std::span<const std::uint32_t> identities) {
    BodyMass sum{.mass = 0};
    for (const std::uint32_t k : identities) {
        GrainReference grain = scene.particleHandler.getObject(k);
        sum.mass += grain.getMass();
        sum.centre += grain.getMass() * grain.getPosition();
    }
    sum.centre /= sum.mass;
    for (const std::uint32_t k : identities) {
        GrainReference grain = scene.particleHandler.getObject(k);
        const Vec3D arm = grain.getPosition() - sum.centre;
        const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
        sum.inertia += grain.getMass() * (0.4 * grain.getRadius() * grain.getRadius() * one +
                                          arm.squaredNorm() * one - arm * arm.transpose());
    }
    return sum;
}

void joinRows(Scene& scene, std::size_t size) {
    const std::size_t count = scene.particleHandler.getSize();
    if (count % size != 0)
        throw InputError(fmt::format("joinRows(): {} grains are not clumps of {} spheres.", count, size));
    std::vector<std::uint32_t> clump(size);
    for (std::size_t first = 0; first < count; first += size) {
        std::iota(clump.begin(), clump.end(), static_cast<std::uint32_t>(first));
        scene.bodyHandler.join(clump, massOfSpheres(scene, clump));
    }
}

void joinNeighbours(Scene& scene, std::size_t size) {
    const ParticleStore& grains = scene.particleHandler.store();
    const NeighbourSearch search(grains.translation, 0.1 * grains.smallestRadius(), {});
    std::vector<std::vector<std::uint32_t>> near(grains.size());
    for (std::uint32_t k = 0; k < grains.size(); ++k)
        search.forEachPartner(k, [&](std::uint32_t other) {
            near[k].push_back(other);
            near[other].push_back(k);
        });
    for (auto& list : near) std::ranges::sort(list);
    std::vector<bool> isJoined(grains.size(), false);
    std::vector<std::vector<std::uint32_t>> all;
    for (std::uint32_t k = 0; k < grains.size(); ++k) {
        if (isJoined[k]) continue;
        std::vector<std::uint32_t> clump{k};
        for (std::size_t next = 0; next < clump.size() && clump.size() < size; ++next)
            for (const std::uint32_t other : near[clump[next]])
                if (clump.size() < size && !isJoined[other] && std::ranges::count(clump, other) == 0)
                    clump.push_back(other);
        if (clump.size() < size) continue;
        for (const std::uint32_t place : clump) isJoined[place] = true;
        for (std::uint32_t& place : clump) place = grains.identity[place];
        all.push_back(clump);
    }
    for (const auto& clump : all) scene.bodyHandler.join(clump, massOfSpheres(scene, clump));
}

}  // namespace pendular::scenes
