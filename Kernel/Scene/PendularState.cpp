#include "Kernel/Scene/PendularState.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"

namespace pendular {

namespace {

/// The place of a bridge on a grain.
struct BridgeOnGrain {
    std::uint32_t grain;
    Vector<double> direction;  // unit, from the grain's centre
    double fillingAngle;       // rad
    std::size_t bridge;
};

std::vector<BridgeOnGrain> bridgesOnGrains(const Scene& scene) {
    std::vector<BridgeOnGrain> all;
    const ContactSystem& contacts = scene.contacts();
    const ParticleStore& grains = scene.particleHandler.store();
    std::size_t number = 0;
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        if (!(seen.bridgeVolume > 0)) return;
        const double r1 = grains.translation[grains.place[seen.particle1]].radius;
        const double r2 = seen.wall < 0 ? grains.translation[grains.place[seen.particle2]].radius : infinity;
        const BridgeSurface surface =
            scene.laws().bridgeSurface(bucket.species1, bucket.species2, {std::min(r1, r2), std::max(r1, r2)},
                                       seen.bridgeVolume, seen.separation, true);
        const double smaller = surface.fillingAngle1, larger = surface.fillingAngle2;
        all.push_back({seen.particle1, seen.normal(), r1 <= r2 ? smaller : larger, number});
        if (seen.wall < 0)
            all.push_back({seen.particle2, -seen.normal(), r1 <= r2 ? larger : smaller, number});
        ++number;
    });
    std::ranges::stable_sort(all, {}, &BridgeOnGrain::grain);
    return all;
}

/// Two bridges of a grain meet where the sum of their filling angles is above the angle between them.
double overlappingShare(const Scene& scene) {
    const std::vector<BridgeOnGrain> all = bridgesOnGrains(scene);
    std::vector<bool> meets;
    for (std::size_t k = 0; k < all.size(); ++k) {
        meets.resize(std::max(meets.size(), all[k].bridge + 1));
        for (std::size_t other = k + 1; other < all.size() && all[other].grain == all[k].grain; ++other) {
            meets.resize(std::max(meets.size(), all[other].bridge + 1));
            const double cosine = std::clamp(dot(all[k].direction, all[other].direction), -1.0, 1.0);
            if (all[k].fillingAngle + all[other].fillingAngle <= std::acos(cosine)) continue;
            meets[all[k].bridge] = meets[all[other].bridge] = true;
        }
    }
    if (meets.empty()) return 0;
    return static_cast<double>(std::ranges::count(meets, true)) / static_cast<double>(meets.size());
}

}  // namespace

PendularState pendularState(const Scene& scene, bool withOverlaps) {
    scene.contacts().ranks().requireAllGrains("figures of the pendular state");
    PendularState found;
    const ParticleStore& grains = scene.particleHandler.store();
    const GrainFilms& films = scene.particleHandler.films();
    for (const std::uint32_t place : grains.place)
        found.thickFilms += films.thicknessOf(grains, place) > 0.1 * grains.translation[place].radius ? 1 : 0;
    const std::size_t bridges = scene.contacts().counts().bridged;
    const LiquidLedger ledger = scene.liquidLedger();
    const double onGrains = ledger.films + ledger.bridges;
    if (const double solid = volumeOfBodies(grains); solid > 0) found.liquidOverSolid = onGrains / solid;
    if (onGrains > 0) found.shareInFilms = ledger.films / onGrains;
    if (grains.count() > 0)
        found.bridgesOfAGrain = 2 * static_cast<double>(bridges) / static_cast<double>(countBodies(grains));
    for (int a = 0; a < static_cast<int>(scene.laws().speciesCount()); ++a)
        for (int b = 0; b <= a; ++b)
            found.bridgesForm |= scene.laws().liquidRules(a, b).value_or(LiquidRules{}).largest > 0;
    if (withOverlaps) found.overlappingShare = overlappingShare(scene);
    return found;
}

std::vector<RunWarning> PendularState::kindsOfWarnings() const {
    std::vector<RunWarning> found;
    constexpr double usualDensity = 0.6;  // of a random packing
    if (saturation(usualDensity) > 0.1)
        found.push_back(
            {"saturation", fmt::format("liquid would fill {:.3g} % of the pores of a packing of density 0.6; "
                                       "above some 10 % forces are not those of separate bridges",
                                       100 * saturation(usualDensity))});
    if (overlappingShare > 0)
        found.push_back({"bridges that meet",
                         fmt::format("{:.3g} % of the bridges meet another one at a grain; their forces are "
                                     "not those of separate bridges",
                                     100 * overlappingShare)});
    if (bridgesForm && shareInFilms > 0.2)
        found.push_back(
            {"share in films", fmt::format("{:.3g} % of the liquid is in films; where grains touch "
                                           "liquidBridgeVolumeMax is too small for so much liquid",
                                           100 * shareInFilms)});
    if (thickFilms > 0)
        found.push_back(
            {"thick films",
             fmt::format("{} grains have a film thicker than 0.1 of their radius; contacts do not feel it",
                         thickFilms)});
    return found;
}

std::vector<std::string> PendularState::warnings() const {
    std::vector<std::string> sentences;
    for (RunWarning& warning : kindsOfWarnings()) sentences.push_back(std::move(warning.sentence));
    return sentences;
}

}  // namespace pendular
