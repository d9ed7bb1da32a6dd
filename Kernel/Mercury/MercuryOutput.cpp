#include "Kernel/Mercury/MercuryOutput.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/EnergyLedger/GrainSums.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {
namespace {

std::string words(const Vector<double>& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// MercuryDPM's indices: of the grain at each place its row in the frame of the .data file, and of each
/// wall its place among those that there are. Neither has gaps after a removal, as identities have.
struct Indices {
    std::vector<std::uint32_t> ofGrain;  // by place
    std::span<const PresentWall> walls;

    Indices(const ParticleStore& grains, const WallHandler& wallHandler)
        : ofGrain(grains.size()), walls(wallHandler.present()) {
        std::uint32_t row = 0;
        for (const std::uint32_t place : grains.place) ofGrain[place] = row++;
    }
    [[nodiscard]] std::int64_t ofWall(int number) const {
        return std::ranges::lower_bound(walls, static_cast<std::size_t>(number), {}, &PresentWall::number) -
               walls.begin();
    }
};

/// time ene_gra ene_kin ene_rot ene_ela X_COM Y_COM Z_COM, of the grains that can move.
std::string energyLine(const Scene& scene) {
    const GrainSums sums = sumGrains(scene.particleHandler.store());
    return fmt::format("{} {} {} {} {} {}\n", scene.getTime(),
                       -dot(toVector(scene.getGravity()), sums.firstMoment.value()),
                       sums.translationalEnergy.value(), sums.rotationalEnergy.value(), scene.springEnergy(),
                       words(sums.centreOfMass()));
}

}  // namespace

MercuryOutput::MercuryOutput(std::string beginning) : name(std::move(beginning)) {
    if (!name.empty()) requireFileName("MercuryOutput", name);
}

FrameFile MercuryOutput::textOf(const std::string& ending) {
    return FrameFile(
        ending, ending.starts_with(".ene") ? "time ene_gra ene_kin ene_rot ene_ela X_COM Y_COM Z_COM\n" : "");
}

/// Where each frame has files of its own, these begin.
void MercuryOutput::beginFrame() {
    if (!many) return;
    const std::string number = fmt::format(".{:0{}}", frames++, digitsOfNumber);
    data = textOf(".data" + number), contacts = textOf(".fstat" + number), energies = textOf(".ene" + number);
}

void MercuryOutput::write(const Scene& scene) {
    if (times.isGiven() && scene.getTime() <= last) return;  // they have this state
    last = scene.getTime();
    beginFrame();
    const std::string beginning = nameIn(scene);
    const bool goesOn = scene.isRestarted() && !many;
    const auto& grains = scene.particleHandler.store();
    const Domain box = domainIn(scene);
    const auto frame = [&](FrameFile& file, auto&& writeInto) {
        file.begin(beginning, goesOn);
        writeInto();
        file.finish();
    };
    if (dataToo) frame(data, [&] { writeData(grains, box, scene.getTime()); });
    if (contactsToo)
        frame(contacts,
              [&] { writeContacts(scene.contacts(), grains, scene.wallHandler, box, scene.getTime()); });
    if (!energiesToo) return;
    if (!scene.keepsSpringEnergy())
        throw InputError(
            "MercuryOutput: the .ene file needs the elastic energy; call keepSpringEnergy() or "
            "keepEnergyLedger(); "
            "withEnergies(false) does without the file.");
    frame(energies, [&] { energies.text(energyLine(scene)); });
}

void MercuryOutput::visitState(StateArchive& archive, const Scene& scene) {
    const std::string beginning = nameIn(scene);
    if (dataToo && !many) data.visitState(archive, beginning);
    if (contactsToo && !many) contacts.visitState(archive, beginning);
    if (energiesToo && !many) energies.visitState(archive, beginning);
    if (times.isGiven() || many) visitOwn(archive, beginning);
}

/// The time of the last frame, and how many there are.
void MercuryOutput::visitOwn(StateArchive& archive, const std::string& beginning) {
    // Files of other intervals have an output of their own.
    const std::string_view ending = dataToo ? "data" : contactsToo ? "fstat" : "ene";
    const std::string own =
        fmt::format("{}.{}-", std::filesystem::path(beginning).filename().string(), ending);
    const auto visit = [&](const std::string& entry, auto& value, bool isThere) {
        if (archive.isWriting() ? isThere : archive.holds(entry)) archive.value(entry, value);
    };
    if (times.isGiven()) visit(own + "last-time", last, last >= 0);
    if (many) visit(own + "frames", frames, frames > 0);
}

std::string MercuryOutput::nameIn(const Scene& scene) const { return name.empty() ? scene.getName() : name; }

MercuryOutput::Domain MercuryOutput::domainIn(const Scene& scene) const {
    if (domain) return *domain;
    if (scene.hasDomain()) return {toVector(scene.getMin()), toVector(scene.getMax())};
    return domainOf(scene.particleHandler.store());
}

MercuryOutput::Domain MercuryOutput::domainOf(const ParticleStore& grains) {
    Domain box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        for (const auto axis : vectorAxes) {
            box.lowest.*axis = std::min(box.lowest.*axis, grain.position.*axis - grain.radius);
            box.highest.*axis = std::max(box.highest.*axis, grain.position.*axis + grain.radius);
        }
    }
    return grains.count() > 0 ? box : Domain{{0, 0, 0}, {0, 0, 0}};
}

void MercuryOutput::writeData(const ParticleStore& grains, const Domain& box, double time) {
    data.text(fmt::format("{} {} {} {}\n", grains.count(), time, words(box.lowest), words(box.highest)));
    NumberText line;
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        Vector<double> spin{0, 0, 0};
        if (grains.hasSpin) spin = grains.rotation[place].spin;
        const int species = grains.species[place];
        data.line(line.of(grain.position, grain.velocity, grain.radius, 0, 0, 0, spin, species));
    }
}

void MercuryOutput::writeContacts(const ContactSystem& system, const ParticleStore& grains,
                                  const WallHandler& walls, const Domain& box, double time) {
    const Indices index(grains, walls);
    double largest = 0;
    for (const TranslationRecord& grain : grains.translation) largest = std::max(largest, grain.radius);
    contacts.text(fmt::format("# {} 1\n# {} {}\n# {} {} 0 0 0 0\n", time, words(box.lowest),
                              words(box.highest), grains.count() > 0 ? grains.smallestRadius() : 0, largest));
    const std::string timeWord = fmt::format("{} ", time);
    NumberText bodies, common, directions;
    system.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = system.observe(grains, bucket, contact);
        const std::uint32_t place = grains.place[seen.particle1];
        const TranslationRecord& first = grains.translation[place];
        const Vector<double> normal = -seen.normal();  // to body 1
        const Vector<double> across = seen.tangentialForce();
        const double fn = dot(seen.force, normal), ft = norm(across);
        const Vector<double> tangent = ft > 0 ? (1 / ft) * across : across;
        const std::string_view shared =
            common.of(seen.point, 0.0 - seen.separation, system.springLength(contact), fn, ft);
        const auto line = [&](std::uint32_t i, std::int64_t j, double sign) {
            contacts.line(timeWord, bodies.of(i, j), shared, directions.of(sign * normal, sign * tangent));
        };
        const bool moves = first.inverseMass > 0;
        if (bucket.wall >= 0) {
            if (moves) line(index.ofGrain[place], -index.ofWall(seen.wall) - 1, -1);
            return;
        }
        const std::uint32_t place2 = grains.place[seen.particle2];
        if (moves) line(index.ofGrain[place], index.ofGrain[place2], 1);
        if (grains.translation[place2].inverseMass > 0) line(index.ofGrain[place2], index.ofGrain[place], -1);
    });
}

}  // namespace pendular
