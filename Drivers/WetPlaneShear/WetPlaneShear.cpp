/// Wet grains between rough walls that shear them under a pressure: friction and solid fraction over the
/// reduced pressure P* = P d / (pi gamma). Khamseh, Roux and Chevoir, Phys. Rev. E 92 (2015) 022201.

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = LinearViscoelasticSlidingFrictionLiquidBridgeBagheriSpecies;

struct Options {
    double reducedPressure = 1, inertialNumber = 0.1, strain = 20;
    double stiffness = 1e3;  // times (force of a bridge + pressure x diameter^2) / diameter
    std::size_t seed = 1;
    RunOptions run{.output = "WetPlaneShear-output"};
};

class WetPlaneShear : public Simulation<Material> {
public:
    explicit WetPlaneShear(const Options& given) : options(given) { options.run.apply(*this); }

    void setupInitialConditions() override {
        // A contact that carries a bridge and the pressure overlaps by diameter / options.stiffness.
        const double force = constants::pi * tension * diameter + pressure * diameter * diameter;
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(density);
        material->setStiffnessAndRestitutionCoefficient(options.stiffness * force / diameter, 0.5, mass);
        material->setSlidingStiffness(2.0 / 7 * material->getStiffness());
        material->setSlidingDissipation(2.0 / 7 * material->getDissipation());
        material->setSlidingFrictionCoefficient(0.3);
        material->setLiquidBridgeVolume(1e-3 * std::pow(diameter, 3));
        material->setContactAngle(0);
        material->setSurfaceTension(tension);
        setPeriodic(0, 0, width), setPeriodic(1, 0, width);
        if (!isRestarted()) addGrains();
        setTimeStep(material->getCollisionTime(mass) / 20);
        setTimeMax(options.strain / rate);
        setSaveCount(stepsOf(0.1 / rate, getTimeStep()));
    }
    /// The pressure, the grains' push and a brake that acts within a fifth of the inertial time move the
    /// upper wall; along x it keeps to the shear rate.
    void actionsAfterTimeStep() override {
        const Vec3D push = pushOnWall();
        const double wallMass = static_cast<double>(wallCount) * mass;
        const double force = push.z() - pressure * width * width;
        rise = (rise + getTimeStep() * force / wallMass) / (1 + 5 * getTimeStep() / inertialTime);
        const double distance = height();
        for (std::size_t k = 0; k < wallCount; ++k)
            if (particleHandler.contains(k))  // it is on this rank
                particleHandler.getObject(k).setVelocity({rate * distance, 0, rise});
        sums[0].steps += 1, sums[0].shear -= push.x(), sums[0].normal += push.z(), sums[0].height += distance;
    }
    void writeOutput() override {
        const auto [steps, shear, normal, height] = std::exchange(sums, {})[0];
        if (steps == 0) return;
        // Half of each wall is inside.
        const double inside = static_cast<double>(particleHandler.getSize() - wallCount);
        const double area = width * width, solid = inside * mass / density;
        table.row(getTime(), getTime() * rate, options.reducedPressure, shear / normal,
                  normal / (steps * pressure * area), solid * steps / (area * height));
    }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override {
        archive.value("rise", rise);
        archive.record<double>("sums", sums);
        table.visitState(archive);
    }

private:
    static constexpr double diameter = 1e-3, density = 2500, tension = 0.0728;  // m, kg/m^3, N/m
    static constexpr int across = 8;                                            // grains
    static constexpr double width = across * latticeLooseness * diameter;       // m
    const double mass = constants::pi / 6 * density * std::pow(diameter, 3);    // kg

    /// The upper wall's grains come first, those of the lower one last.
    void addGrains() {
        UniformRandom random(options.seed);
        auto cells = latticeCells({0, 0, 0}, {width, width, 1.5 * width}, latticeLooseness * diameter,
                                  [](const Vec3D&) { return true; });
        std::reverse(cells.begin(), cells.end());
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const GrainRow place = jittered(0.5 * diameter, cells[k], random);
            SphericalParticle grain;
            grain.setSpecies(material);
            grain.setRadius(place.radius);
            grain.setPosition(place.position);
            grain.setVelocity({rate * place.position.z(), 0, 0});
            auto added = particleHandler.copyAndAddObject(grain);
            if (k < wallCount || k >= cells.size() - wallCount)
                added.fixParticle(), added.setVelocity({0, 0, 0});
        }
    }
    // Of all ranks:
    [[nodiscard]] Vec3D pushOnWall() {
        return sumOverGrains(*this, [this](const GrainReference& grain) {
            return grain.getId() < wallCount ? contactForceOn(grain.getId()) : Vec3D(0, 0, 0);
        });
    }
    [[nodiscard]] double height() {  // m, between the walls' centres
        const std::size_t last = particleHandler.getSize() - 1;
        return sumOverGrains(*this, [last](const GrainReference& grain) {
            if (grain.getId() == 0) return grain.getPosition().z();
            return grain.getId() == last ? -grain.getPosition().z() : 0;
        });
    }

    static constexpr std::size_t wallCount = across * across;
    Options options;
    double pressure = options.reducedPressure * constants::pi * tension / diameter;  // Pa
    double inertialTime = diameter * std::sqrt(density / pressure);                  // s
    double rate = options.inertialNumber / inertialTime;                             // 1/s
    Material* material = nullptr;
    double rise = 0;                                          // m/s
    struct Sums {                                             // since the last row, on the wall
        double steps = 0, shear = 0, normal = 0, height = 0;  // N, N, m
    };
    std::array<Sums, 1> sums{};
    RunTable table{options.run.output + "/shear.csv",
                   "time_s,strain,reduced_pressure,friction,normal_stress_over_pressure,solid_fraction"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "WetPlaneShear",
        .description = "Wet grains are sheared under a pressure.",
        .options = o.run,
        .files = "shear.csv",
        .numbers = {
            {"reduced-pressure", "", &o.reducedPressure, {0.01, 1000}, "P d / (pi gamma)"},
            {"inertial-number", "", &o.inertialNumber, {1e-4, 1}, "shear rate times d sqrt(density / P)"},
            {"stiffness",
             "",
             &o.stiffness,
             {10, 1e6},
             "of a contact, over (force of a bridge + pressure x diameter^2) / diameter: a mean contact "
             "overlaps "
             "by the diameter over it; below 100 the largest overlaps may end the run"},
            {"seed", "", &o.seed, {0, 1e9}, "of the grains' places at the start"},
            {"strain", "", &o.strain, {0.1, 1e4}, "of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        try {
            WetPlaneShear(o).solve();
        } catch (const RunError& error) {
            // Of what the sentence of too deep an overlap says to take, only one is an option of this
            // program.
            if (std::string_view(error.what()).find(" overlap by ") == std::string_view::npos) throw;
            throw RunError(fmt::format(
                "{}: give this program a larger --stiffness than {:g}, 100 or more (1000 if it is "
                "not given).",
                withoutFullStop(error.what()), o.stiffness));
        }
    });
}
