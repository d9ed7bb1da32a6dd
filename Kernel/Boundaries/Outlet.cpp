#include "Kernel/Boundaries/Outlet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/InputError.h"
#include "Kernel/Parallel.h"
#include "Kernel/State/StateArchive.h"
#include "Kernel/Walls/RigidWall.h"

namespace pendular {

void Outlet::setPlane(const Vec3D& direction, const Vec3D& point) {
    normal = checkedDirection("Outlet", "length of the normal", direction);
    offset = dot(normal, checkedVector("Outlet", "point", point, "m"));
    region = nullptr;
    hasPlane = true;
}

std::size_t OutletHandler::copyAndAddObject(const Outlet& outlet) {
    if (hasBegun) throw InputError("Simulation: outlets can only be added before the run begins.");
    if (!outlet.region && !outlet.hasPlane)
        throw InputError(
            fmt::format("outlet {}: its place is not set; call setRegion() or setPlane() before it is added.",
                        outlets.size()));
    outlets.push_back(outlet);
    return outlets.size() - 1;
}

void OutletHandler::begin(const PeriodicBox& periodic) {
    hasBegun = true;
    const std::array<double, 3> periods{periodic.length.x, periodic.length.y, periodic.length.z};
    for (std::size_t o = 0; o < outlets.size(); ++o) {
        Outlet& outlet = outlets[o];
        if (outlet.region) {
            outlet.region = outlet.region->in(periodic);
            outlet.fromRegion = periodic;
            outlet.fromRegion.lowest = outlet.region->bounds().lowest;
            continue;
        }
        const std::array<double, 3> normal{outlet.normal.x, outlet.normal.y, outlet.normal.z};
        for (std::size_t k = 0; k < 3; ++k)
            if (periods[k] > 0 && normal[k] != 0)
                throw InputError(fmt::format(
                    "outlet {}: the normal of its plane has the part {:.6g} along {}, along which "
                    "the scene repeats itself; it must be across it, or take a region.",
                    o, normal[k], "xyz"[k]));
    }
}

const GrainTally& OutletHandler::tally(std::size_t number) const {
    if (number >= outlets.size())
        throw InputError(
            fmt::format("There is no outlet {}; the scene has {} (counted from 0).", number, outlets.size()));
    return outlets[number].tally;
}

std::uint64_t OutletHandler::removedNumber() const {
    std::uint64_t sum = 0;
    for (const Outlet& outlet : outlets) sum += outlet.tally.all().number;
    return sum;
}

double OutletHandler::removedMass() const {
    double sum = 0;
    for (const Outlet& outlet : outlets) sum += outlet.tally.all().mass;
    return sum;
}

void OutletHandler::letOut(ParticleHandler& particles, int threads) {
    const ParticleStore& grains = particles.storeInStep();
    found.resize(static_cast<std::size_t>(threads));
    for (auto& own : found) own.clear();
    inParts(
        grains.size(), threads,
        [&](int part, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                for (std::uint32_t o = 0; o < outlets.size(); ++o) {
                    const TranslationRecord& grain = grains.translation[k];
                    if (grain.radius == 0 || grain.inverseMass == 0 || !outlets[o].takes(grain.position))
                        continue;
                    found[static_cast<std::size_t>(part)].push_back({grains.identity[k], o});
                    break;
                }
        },
        16384);
    leaving.clear();
    for (const auto& own : found) leaving.insert(leaving.end(), own.begin(), own.end());
    std::ranges::sort(leaving, {}, &Leaving::identity);
    for (const auto& [identity, outlet] : leaving) {
        const GrainReference grain = particles.getObject(identity);
        const int species = grain.getSpeciesIndex();
        const double radius = grain.getRadius();
        particles.removeObject(identity);
        outlets[outlet].tally.add(static_cast<std::size_t>(species), radius,
                                  particles.massOf(radius, species));
    }
}

void OutletHandler::visitState(StateArchive& archive) {
    archive.same("count", outlets.size());
    for (std::size_t k = 0; k < outlets.size(); ++k)
        archive.group(std::to_string(k), [&] {
            Outlet& outlet = outlets[k];
            if (outlet.region) {
                archive.group("region", [&] { outlet.region->visitState(archive); });
            } else {
                archive.sameRecord<double>("normal", outlet.normal);
                archive.same("offset", outlet.offset, "m");
            }
            outlet.tally.visitState(archive);
        });
}

}  // namespace pendular
