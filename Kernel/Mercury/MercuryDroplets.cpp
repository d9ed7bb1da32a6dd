#include "Kernel/Mercury/MercuryDroplets.h"

#include <array>

#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

void DropletBoundary::setGenerateDroplets(std::function<void(DropletBoundary&)> function) {
    requireChangeable("setGenerateDroplets()");
    generate = std::move(function);
    handOverWhenSet();
}

void DropletBoundary::handOver(Scene& /*of*/) { actions().add(this); }

bool DropletBoundary::meets(StepContext& step, const Droplet& droplet) {
    const double volume = sphereMass(droplet.radius, 1);
    for (GrainReference grain : step.particles) {
        const Vector<double> way = step.box.nearest(toVector(grain.getPosition() - droplet.position));
        if (norm(way) > grain.getRadius() + droplet.radius) continue;
        grain.setLiquidVolume(grain.getLiquidVolume() + volume);
        caught += volume;
        return true;
    }
    if (!touchesWall(step.walls, step.box, toVector(droplet.position), droplet.radius)) return false;
    lost += volume;
    return true;
}

void DropletBoundary::act(StepContext& step) {
    generate(*this);
    const Vec3D gravity = toEigen(step.gravity);
    for (Droplet& droplet : droplets_) {
        droplet.position += step.length * (droplet.velocity + 0.5 * step.length * gravity);
        droplet.velocity += step.length * gravity;
    }
    std::erase_if(droplets_, [&](const Droplet& droplet) { return meets(step, droplet); });
}

void DropletBoundary::visitState(StateArchive& archive) {
    std::vector<std::array<double, 7>> rows;
    for (const Droplet& d : droplets_)
        rows.push_back({d.position.x(), d.position.y(), d.position.z(), d.velocity.x(), d.velocity.y(),
                        d.velocity.z(), d.radius});
    archive.column<double>("droplets", rows);
    droplets_.clear();
    for (const auto& row : rows)
        droplets_.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, row[6]});
    archive.finite("caught", caught);
    archive.finite("lost", lost);
}

}  // namespace pendular
