#include "Tools/Studies/AccuracyVersusCost/CriticalChart.h"

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalStep.h"

namespace pendular {
namespace {

/// zeta of linear dashpots: restitution 1, 0.85, 0.53, 0.1, 0 and far beyond.
constexpr std::array dampingRatios{0.0, 0.05, 0.2, 0.6, 1.0, 3.0};

template <class S>
void writeCriticalSteps(CsvFile& file, const CriticalCase& given) {
    for (const RestingGrains& scene :
         {resting::pair(), resting::onWall(), resting::between(), resting::covered(), resting::crystal()}) {
        const double mass = scene.effectiveMass();
        const S species = criticalMaterial::make<S>(given, scene.bodies(), mass);
        const double frequency =
            std::sqrt(contactStiffness(static_cast<const typename S::Mixed&>(species), scene.bodies(), mass)
                          .normal.spring /
                      mass);
        for (const Integrator& integrator : integrators::all) {
            const CriticalStep step = criticalStep(species, scene, integrator);
            file.line(fmt::format("{},{},{},{},{},{:.4g},{:.4g},{:.4g}", S::name, scene.name, integrator.name,
                                  given.dampingRatio, given.frictionStiffness, frequency * step.advice,
                                  frequency * step.critical, 100 * step.advice / step.critical));
        }
    }
}

}  // namespace

void chartCriticalSteps(const CriticalChartOptions& options) {
    CsvFile file(
        options.file,
        "species,scene,integrator,damping_ratio,friction_stiffness_factor,advised_step_times_frequency,"
        "critical_step_times_frequency,advised_over_critical_percent");
    using Held = ReversibleAdhesive;
    for (const double zeta : dampingRatios) {
        NormalLaws::forEach([&]<class N>() {
            writeCriticalSteps<Species<N, Mindlin, Held>>(file, {zeta, 1});
        });
        FrictionLaws::forEach([&]<class F>() {
            using S = Species<HertzianViscoelastic, F, Held>;
            if constexpr (!std::is_same_v<F, Mindlin>) writeCriticalSteps<S>(file, {zeta, 1});
            if constexpr (HasContactTorque<F>) writeCriticalSteps<S>(file, {zeta, 10});
        });
        const auto attraction = [&]<class A>() {
            writeCriticalSteps<Species<HertzianViscoelastic, NoFriction, A>>(file, {zeta, 1});
        };
        attraction.operator()<JKR>();
        attraction.operator()<DMT>();
        attraction.operator()<LiquidBridgeWillett>();
    }
    file.close();
}

}  // namespace pendular
