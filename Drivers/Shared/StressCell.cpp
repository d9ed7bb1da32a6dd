#include "Drivers/Shared/StressCell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

void StressCell::actionsAfterTimeStep() {
    if (getNumberOfTimeSteps() % samplePeriod != 0) return;
    const MeanStress now = meanStress(*this, volume());
    for (int k = 0; k < 9; ++k) sums.stress[static_cast<std::size_t>(k)] += now.total()(k / 3, k % 3);
    sums.kinetic += now.kinetic.trace() / 3;
    sums.contacts +=
        sumOverInteractions(*this, [](const ObservedContact& seen) {  // of grains with each other
            return seen.touching && seen.particle2 != ObservedContact::none ? 2.0 : 0.0;
        });
    sums.samples += 1;
}

void StressCell::writeOutput() {
    if (sums.samples == 0) return;
    const Sums seen = std::exchange(sums, {});
    Means means{.kinetic = seen.kinetic / seen.samples,
                .contacts = seen.contacts / seen.samples / static_cast<double>(particleHandler.getSize())};
    for (int k = 0; k < 9; ++k)
        means.stress(k / 3, k % 3) = seen.stress[static_cast<std::size_t>(k)] / seen.samples;
    writeRow(means);
}

void StressCell::completeOutput() {
    table.close();
    if (!isQuiet()) fmt::print("Wrote {}\n", path);
}

void StressCell::visitState(StateArchive& archive) {
    archive.record<double>("sums", sums);
    table.visitState(archive);
}

double StressCell::volume() const {
    const auto length = getPeriodicBox().length;
    return length.x * length.y * length.z;
}

StressCell::StressCell(const RunOptions& run, const std::string& columns)
    : path(run.output + "/stress.csv"), table(path, columns) {
    run.apply(*this);
}

void StressCell::addMaterial(double stiffness, double restitution, double friction) {
    material = speciesHandler.copyAndAddObject({});
    material->setDensity(density);
    material->setStiffnessAndRestitutionCoefficient(stiffness, restitution,
                                                    density * constants::pi / 6 * std::pow(diameter, 3));
    material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
    material->setSlidingDissipation(material->getDissipation());
    material->setSlidingFrictionCoefficient(friction);
}

void StressCell::addGrain(const Vec3D& position, double radius, double speed) {
    SphericalParticle grain;
    grain.setSpecies(material);
    grain.setRadius(0.5 * diameter * radius);
    grain.setPosition(position);
    const auto component = [&] { return random.uniform(-1, 1) * speed; };
    const double x = component(), y = component();
    grain.setVelocity(shearFlowAt(position) + Vec3D(x, y, component()));
    particleHandler.copyAndAddObject(grain);
}

void StressCell::setInterval(double interval, std::size_t states) {
    const std::size_t steps = stepsOf(interval, getTimeStep());
    setSaveCount(steps);
    samplePeriod = std::max<std::size_t>(steps / states, 1);
}

}  // namespace pendular
