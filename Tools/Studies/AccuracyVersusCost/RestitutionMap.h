#pragma once

#include <string>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/DampedCollisions.h"

// How far the restitution of a collision is from the one that its law was given, over the step and the loss.

namespace pendular {

inline constexpr std::array mappedSteps{5, 7, 10, 14, 20, 30, 50, 100, 200, 500};

struct RestitutionError {
    double largest = 0;  // of the restitution, with its sign
    bool allParted = true;
};

/// Over starts of the touch within a step. Grains that stick together for ten contact times count as e = 0.
template <class S>
RestitutionError restitutionError(CollisionCase<S> studied, const Loss& loss, int steps,
                                  const Integrator& integrator, int offsets) {
    const double step = studied.contactTime / steps;
    // A plastic contact flies through what is left of its flattening with e v, for 1 / (pi e^2) of these.
    const double longest =
        studied.contactTime * (loss.restitution > 0 ? 3 / std::pow(loss.restitution, 2) : 10);
    RestitutionError error;
    for (int k = 0; k < offsets; ++k) {
        studied.encounter.gap = (2 + (k + 0.5) / offsets) * step * studied.encounter.speed;
        StudiedCollision<S> collision(studied.species, studied.encounter, step, integrator);
        const SeenCollision seen =
            watchCollision(collision, studied.encounter, longest, [](const CollisionMoment&) {});
        const double found = seen.restitution - loss.restitution;
        if (std::abs(found) > std::abs(error.largest)) error.largest = found;
        error.allParted = error.allParted && seen.parted;
    }
    return error;
}

inline void mapRestitution(const std::filesystem::path& path, int offsets) {
    CsvFile file(path,
                 "law,integrator,damping_over_critical,set_restitution,steps_per_elastic_contact,"
                 "restitution_error,restitution_error_percent_of_set,parted");
    for (const Integrator& integrator : {integrators::predictedVelocityVerlet, integrators::velocityVerlet})
        for (const Loss& loss : losses) {
            // Given where nothing is left; elsewhere it follows from the restitution.
            const std::string damping =
                loss.restitution > 0 ? "" : fmt::format("{}", loss.dampingOverCritical);
            const auto write = [&](const auto& studied) {
                for (const int steps : mappedSteps) {
                    const auto error = restitutionError(studied, loss, steps, integrator, offsets);
                    const std::string share =
                        loss.restitution > 0 ? fmt::format("{:.4g}", 100 * error.largest / loss.restitution)
                                             : "";
                    file.line(fmt::format("{},{},{},{},{},{:.4g},{},{}", studied.name, integrator.name,
                                          damping, loss.restitution, steps, error.largest, share,
                                          error.allParted ? 1 : 0));
                }
            };
            forEachDampedCollision(loss, write);
            forEachPlasticCollision(loss, write);
        }
    file.close();
}

}  // namespace pendular
