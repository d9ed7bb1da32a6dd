/// Jets of grains hit plates at varied angles: what they wear off by Finnie's law, beside its curve.

#include <array>

#include "Drivers/Shared/CommandLine.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/MercuryNames.h"

namespace {

using Material = HertzianViscoelasticMindlinIncrementalSpecies;

/// Degrees, between the jets and the plates.
constexpr std::array angles{5.0, 10.0, 14.0, 18.0, 22.0, 27.0, 34.0, 42.0, 50.0, 60.0, 70.0, 80.0, 90.0};

struct Options {
    std::size_t number = 30;                      // grains of a jet
    double radius = 2.5e-4, speed = 5;            // m, m/s
    double spacing = 4;                           // of the grains in a jet, diameters
    double cuttingShare = 0.5, flowStress = 1e9;  // c, p in Pa
    RunOptions run{.output = "WornPlates-output"};
};

class WornPlates : public Simulation<Material> {
public:
    explicit WornPlates(const Options& given) : options(given) { options.run.apply(*this); }

    void setupInitialConditions() override {
        material = speciesHandler.copyAndAddObject({});
        material->setDensity(2650);
        material->setElasticModulusAndPoissonRatio(1e9, 0.25);
        material->setEffectiveShearModulus(computeEffectiveShearModulus(1e9, 0.25));
        material->setRestitutionCoefficient(0.6);
        material->setSlidingFrictionCoefficient(0.3);
        for (std::size_t k = 0; k < angles.size(); ++k) {
            addPlate(k);
            addJet(k);  // also of a run that goes on: the step is chosen for them
        }
        setTimeStep(shortestContactTime() / 15);
        setTimeMax((jetLength() + 1.5 * plateLength()) / options.speed);
        setSaveCount(stepsOf(getTimeMax() / 20, getTimeStep()));
    }
    void completeOutput() override {
        const double mass = static_cast<double>(options.number) * particleHandler.getObject(0).getMass();
        const double unit = options.cuttingShare * mass * options.speed * options.speed / options.flowStress;
        for (std::size_t k = 0; k < angles.size(); ++k) {
            const SurfaceWear wear = plates[k]->getWear().sum();
            const double a = angles[k] * constants::pi / 180;
            table.row(angles[k], wear.impacts, wear.impactWork, wear.slidingWork, wear.volume,
                      wear.volume / unit, finnieEnergy(1, std::sin(a), std::cos(a)));
        }
        table.close();
        if (!options.run.quiet) fmt::print("Wrote {}/worn.csv\n", options.run.output);
    }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    [[nodiscard]] double jetRadius() const { return 4 * options.radius; }
    [[nodiscard]] double jetLength() const {
        return 2 * options.radius * options.spacing * static_cast<double>(options.number);
    }
    /// m; at 5 degrees the jet covers three quarters of it.
    [[nodiscard]] double plateLength() const { return 32 * jetRadius(); }
    [[nodiscard]] double placeOf(std::size_t plate) const {
        return 6 * jetRadius() * static_cast<double>(plate);
    }

    /// Adds a plate. Its middle is below that of the jet, which goes along -z; its normal is (-cos a, 0, sin
    /// a).
    void addPlate(std::size_t number) {
        const double a = angles[number] * constants::pi / 180, half = 0.5 * plateLength(),
                     width = 4 * jetRadius();
        constexpr int along = 64, across = 8;
        const auto point = [&](int i, int j) {
            const double s = half * (2.0 * i / along - 1);
            return Vector<double>{s * std::sin(a), placeOf(number) + width * (1.0 * j / across - 0.5),
                                  s * std::cos(a)};
        };
        std::vector<Triangle> triangles;
        for (int i = 0; i < along; ++i)
            for (int j = 0; j < across; ++j) {
                triangles.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
                triangles.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
            }
        TriangleWall plate;
        plate.setSpecies(material);
        plate.set(triangles);
        plate.keepWear(WearLaw::finnie(options.cuttingShare, options.flowStress));
        plates[number] = wallHandler.copyAndAddObject(plate);
    }
    void addJet(std::size_t number) {
        UniformRandom random(1 + number);
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(options.radius);
        grain.setVelocity({0, 0, -options.speed});
        const double step = 2 * options.radius * options.spacing, first = 0.75 * plateLength();
        for (std::size_t k = 0; k < options.number;) {
            const double x = jetRadius() * random.uniform(-1, 1), y = jetRadius() * random.uniform(-1, 1);
            if (std::hypot(x, y) > jetRadius()) continue;
            grain.setPosition({x, placeOf(number) + y, first + step * static_cast<double>(k++)});
            particleHandler.copyAndAddObject(grain);
        }
    }

    Options options;
    Material* material = nullptr;
    std::array<TriangleWall*, angles.size()> plates{};
    RunTable table{options.run.output + "/worn.csv",
                   "angle_deg,impacts,impact_work_J,sliding_work_J,volume_m3,factor,factor_of_finnie"};
};

}  // namespace

int main(int argc, char** argv) {
    Options o;
    const DriverProgram driver{
        .name = "WornPlates",
        .description = "Jets of grains hit plates at varied angles: wear by impacts, beside Finnie's curve.",
        .options = o.run,
        .files = "worn.csv",
        .numbers = {{"number", "", &o.number, {1, 1e6, true, true}, "of the grains of each jet"},
                    {"radius", "m", &o.radius, {1e-5, 0.01}, "of the grains"},
                    {"speed", "m/s", &o.speed, {0.1, 30}, "of the grains"},
                    {"spacing", "", &o.spacing, {1.05, 1000}, "of the grains along a jet, in diameters"},
                    {"cutting-share", "", &o.cuttingShare, positiveUpTo(1), "c of Finnie's law"},
                    {"flow-stress", "Pa", &o.flowStress, positive, "p of Finnie's law"}}};
    return runDriver(driver, argc, argv, [&] { WornPlates(o).solve(); });
}
