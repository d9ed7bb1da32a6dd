#pragma once

#include <array>
#include <utility>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/CoarseGraining/MeanStress.h"
#include "Kernel/Math/Random.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Output/RunTable.h"

namespace pendular {

/// Grains of nearly one size, with linear contacts, in a box that repeats itself along all axes, or in a
/// volume of their own; the rows of the table, stress.csv, are means over the states between them.
class StressCell : public Simulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % samplePeriod != 0) return;
        const MeanStress now = meanStress(*this, volume());
        for (int k = 0; k < 9; ++k) sums.stress[static_cast<std::size_t>(k)] += now.total()(k / 3, k % 3);
        sums.kinetic += now.kinetic.trace() / 3;
        for (const ObservedContact& seen : interactions())  // of grains with each other
            if (seen.touching && seen.particle2 != ObservedContact::none) sums.contacts += 2;
        sums.samples += 1;
    }
    void writeOutput() override {
        if (sums.samples == 0) return;
        const Sums seen = std::exchange(sums, {});
        Means means{
            .kinetic = seen.kinetic / seen.samples,
            .contacts = seen.contacts / seen.samples / static_cast<double>(particleHandler.getSize())};
        for (int k = 0; k < 9; ++k)
            means.stress(k / 3, k % 3) = seen.stress[static_cast<std::size_t>(k)] / seen.samples;
        writeRow(means);
    }
    void completeOutput() override {
        table.close();
        if (!isQuiet()) fmt::print("Wrote {}\n", path);
    }
    void visitState(StateArchive& archive) override {
        archive.record<double>("sums", sums);
        table.visitState(archive);
    }

protected:
    static constexpr double diameter = 1e-3, density = 2500;  // m, kg/m^3

    /// Over the states since the last row.
    struct Means {
        Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  // Pa, compression positive
        double kinetic = 0;                                // Pa, the part of the pressure that motion makes
        double contacts = 0;                               // of a grain
    };
    virtual void writeRow(const Means& means) = 0;
    /// m^3, of the grains: what stresses are means over. That of the periods, unless a cell has another one.
    [[nodiscard]] virtual double volume() const {
        const auto length = getPeriodicBox().length;
        return length.x * length.y * length.z;
    }

    StressCell(const RunOptions& run, const std::string& columns)
        : path(run.output + "/stress.csv"), table(path, columns) {
        run.apply(*this);
    }
    /// @param stiffness N/m
    void addMaterial(double stiffness, double restitution, double friction) {
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(density);
        material->setStiffnessAndRestitutionCoefficient(stiffness, restitution,
                                                        density * constants::pi / 6 * std::pow(diameter, 3));
        material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
        material->setSlidingDissipation(material->getDissipation());
        material->setSlidingFrictionCoefficient(friction);
    }
    /// @param radius of the largest sizes, 1: half a diameter
    /// @param speed m/s, up to which each component of a velocity against the flow is drawn
    void addGrain(const Vec3D& position, double radius, double speed) {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(0.5 * diameter * radius);
        grain.setPosition(position);
        const auto component = [&] { return random.uniform(-1, 1) * speed; };
        const double x = component(), y = component();
        grain.setVelocity(shearFlowAt(position) + Vec3D(x, y, component()));
        particleHandler.copyAndAddObject(grain);
    }
    /// @param interval s, between two rows, for which this many states are seen
    void setInterval(double interval, std::size_t states) {
        const std::size_t steps = stepsOf(interval, getTimeStep());
        setSaveCount(steps);
        samplePeriod = std::max<std::size_t>(steps / states, 1);
    }

    void forgetStates() { sums = {}; }

    UniformRandom random{1};
    std::string path;
    RunTable table;

private:
    struct Sums {
        std::array<double, 9> stress{};
        double kinetic = 0, contacts = 0, samples = 0;
    };
    Sums sums;
    LinearViscoelasticSlidingFrictionSpecies* material = nullptr;
    std::size_t samplePeriod = 1;
};

}  // namespace pendular
