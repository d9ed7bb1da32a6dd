#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/MercuryNames.h"

namespace pendular {

struct RunOptions;

/// Grains of nearly one size, with linear contacts, in a box that repeats itself along all axes, or in a
/// volume of their own; the rows of the table, stress.csv, are means over the states between them.
class StressCell : public Simulation<LinearViscoelasticSlidingFrictionSpecies> {
public:
    void actionsAfterTimeStep() override;
    void writeOutput() override;
    void completeOutput() override;
    void visitState(StateArchive& archive) override;

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
    [[nodiscard]] virtual double volume() const;

    StressCell(const RunOptions& run, const std::string& columns);
    /// @param stiffness N/m
    void addMaterial(double stiffness, double restitution, double friction);
    /// @param radius of the largest sizes, 1: half a diameter
    /// @param speed m/s, up to which each component of a velocity against the flow is drawn
    void addGrain(const Vec3D& position, double radius, double speed);
    /// @param interval s, between two rows, for which this many states are seen
    void setInterval(double interval, std::size_t states);

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
