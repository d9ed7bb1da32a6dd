#include "Kernel/Features/Fluid/FluidPart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fluidPartTest {
namespace {

using S = LinearViscoelasticSpecies;

constexpr FluidMaterial water{.density = 998.2, .viscosity = 1.002e-3};
constexpr double radius = 1e-3, density = 2500;
constexpr FluidGrid box{{0, 0, 0}, {0.03, 0.03, 0.04}, {3, 3, 4}};

S glass() {
    S species;
    species.setDensity(density), species.setStiffness(100);
    return species;
}

/// Water that turns about z and rises, whatever the grains do; its pressure is that of its weight and of the
/// drag.
struct Swirl : FluidHost {
    double rate = 3, rise = 0.05;  // 1/s, m/s
    void compareSetUp(StateArchive& archive, double /*now*/) override {
        archive.same("rate", rate, "1/s"), archive.same("rise", rise, "m/s");
    }
    void findVelocity(const FluidGrid& grid, FluidFields& fields, double /*time*/) override {
        for (std::size_t k = 0; k < grid.size(); ++k) {
            const double x = static_cast<double>(k % 3) - 1, y = static_cast<double>(k / 3 % 3) - 1;
            fields.velocity[k] = {-0.01 * rate * y, 0.01 * rate * x, rise};
        }
    }
    void findPressure(const FluidGrid& grid, FluidFields& fields, const Vector<double>& gravity) override {
        for (std::size_t k = 0; k < grid.size(); ++k)
            fields.pressureGradient[k] = water.density * gravity - 1 / fields.porosity[k] * fields.drag[k];
    }
};

/// Water at rest.
struct Still : Swirl {
    Still() { rate = 0, rise = 0; }
};

/// The same of any grid.
struct Rest : FluidHost {
    void compareSetUp(StateArchive&, double) override {}
    void findVelocity(const FluidGrid&, FluidFields& fields, double) override {
        fields.velocity.assign(fields.porosity.size(), {0, 0, 0});
    }
    void findPressure(const FluidGrid&, FluidFields& fields, const Vector<double>&) override {
        fields.pressureGradient.assign(fields.porosity.size(), {0, 0, 0});
    }
};

std::vector<scenes::GrainMotion> cloud() {
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < 64; ++k)
        grains.push_back(
            {.radius = radius * (0.8 + 0.1 * (k % 4)),
             .position = {0.003 + 0.007 * (k % 4), 0.004 + 0.007 * (k / 4 % 4), 0.005 + 0.009 * (k / 16)},
             .velocity = {0.01 * (k % 3), -0.02 * (k % 5), 0.01 * (k % 7)},
             .fixed = k % 9 == 0});
    return grains;
}

template <class Host>
FluidPart& addFluid(scenes::FewGrains<S>& scene, std::string_view law, PressureModel model) {
    return scene.addPart<FluidPart>(box, water, dragLaw(law), std::make_unique<Host>(), model);
}

// What the grains get of the drag, the cells give, to rounding: in each step, for any law and model. And what
// the grains get altogether is what their momentum has changed by, but for those that are held.
TEST(FluidPart, givesAndTakesTheSame) {
    for (const PressureModel model : {PressureModel::A, PressureModel::B})
        for (const std::string_view law : {"Gidaspow", "DiFelice", "Beetstra"}) {
            scenes::FewGrains<S> scene(glass(), cloud(), 1e-5);
            const FluidPart& fluid = addFluid<Swirl>(scene, law, model);
            scene.initialise();
            for (int k = 0; k < 20; ++k) {
                scene.step();
                Vector<double> given{0, 0, 0};
                for (const Vector<double>& source : fluid.fields().source)
                    given += scene.getTimeStep() * box.cellVolume() * source;
                EXPECT_GT(norm(given), 1e-9);
                EXPECT_LT(norm(given + fluid.dragImpulse()), 1e-13 * norm(given));
            }
        }
}

// The volume of all grains, and where it goes, are in the cells.
TEST(FluidPart, spreadsAllVolume) {
    scenes::FewGrains<S> scene(glass(), cloud(), 1e-5);
    const FluidPart& fluid = addFluid<Still>(scene, "WenYu", PressureModel::A);
    scene.initialise();
    double volume = 0;
    Vector<double> flux{0, 0, 0};
    for (const GrainReference grain : scene.particleHandler) {
        volume += grain.getVolume();
        flux += grain.getVolume() * toVector(grain.getVelocity());
    }
    scene.step();
    for (std::size_t k = 0; k < box.size(); ++k) {
        volume -= (1 - fluid.fields().porosity[k]) * box.cellVolume();
        flux += -box.cellVolume() * fluid.fields().solidFlux[k];
    }
    EXPECT_LT(std::abs(volume), 1e-20);
    EXPECT_LT(norm(flux), 1e-21);
}

/// Water that rises everywhere at one speed, which the time can change; its pressure is as in Swirl.
struct Rising : Swirl {
    Rising() { rate = 0; }
};

// A grain that rests on a floor in a flow that carries some of its weight: the spring of the contact bears
// what is left, and its dashpot nothing, at any step and with any integrator. (A velocity that the fluid had
// changed before the step, and contacts saw, left a share c h / 2 m of the drag in the dashpot.)
TEST(FluidPart, leavesADampedContactAtRest) {
    for (const Integrator& scheme :
         {integrators::predictedVelocityVerlet, integrators::velocityVerlet, integrators::springsInStep})
        for (const double step : {1e-5, 1e-4}) {
            S species = glass();
            const double mass = 4 * std::numbers::pi / 3 * std::pow(radius, 3) * density;
            species.setDissipation(2 * std::sqrt(100 * mass));  // critical at a wall
            scenes::FewGrains<S> scene(species, {{.radius = radius, .position = {0.015, 0.015, radius}}},
                                       step);
            scene.setIntegrator(scheme);
            addFluid<Rising>(scene, "Gidaspow", PressureModel::A);
            InfiniteWall floor;
            floor.set({0, 0, -1}, {0, 0, 0});
            floor.setSpecies(scene.speciesHandler.getObject(0));
            scene.wallHandler.copyAndAddObject(floor)->keepForces();
            scene.setGravity({0, 0, -9.81});
            scene.acceptUnstableTimeStep();
            scene.initialise();
            scene.step(static_cast<std::size_t>(std::lround(0.2 / step)));  // 600 sqrt(m/k)
            const double force = -scene.wallHandler.getObject(0).getForce().z(),
                         overlap = radius - scene.particleHandler.getObject(0).getPosition().z();
            EXPECT_GT(force, 0.2 * mass * 9.81);
            EXPECT_LT(force, 0.59 * mass * 9.81);  // the flow carries some beside the buoyancy
            EXPECT_NEAR(100 * overlap / force, 1, 1e-9) << scheme.name << ' ' << step;
            EXPECT_LT(scene.particleHandler.getObject(0).getVelocity().norm(), 1e-12);
        }
}

// The energy that the fluid gives is what grains have got, to rounding.
TEST(FluidPart, booksItsWork) {
    scenes::FewGrains<S> scene(glass(), cloud(), 1e-5);
    const FluidPart& fluid = addFluid<Swirl>(scene, "DiFelice", PressureModel::A);
    scene.setGravity({0, 0, -9.81});
    scene.keepEnergyLedger();
    scene.initialise();
    scene.step(200);
    EXPECT_GT(std::abs(fluid.ledger().work), 1e-9);
    EXPECT_EQ(scene.energyLedger().driver, fluid.ledger().work);
    EXPECT_LT(std::abs(scene.energyUnaccountedFor()), 1e-12 * std::abs(fluid.ledger().work));
}

/// Fails in one of its steps, when velocities have all their shares.
struct Failing : StepPart {
    std::size_t at = 0;
    [[nodiscard]] std::string_view name() const override { return "failing"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
    void accelerate(StepContext& step) override {
        if (step.number == at) throw RunError("As was asked for.");
    }
};

// A step that fails leaves grains as they were, up to the round-off of their own motion, and the same step
// goes on from there when it is tried again.
TEST(FluidPart, takesAStepBackThatFails) {
    scenes::FewGrains<S> whole(glass(), cloud(), 1e-5), failed(glass(), cloud(), 1e-5);
    addFluid<Swirl>(whole, "DiFelice", PressureModel::A),
        addFluid<Swirl>(failed, "DiFelice", PressureModel::A);
    failed.addPart<Failing>().at = 20;
    whole.initialise(), failed.initialise();
    whole.step(20), failed.step(20);
    EXPECT_THROW(failed.step(), RunError);
    const auto expectAlike = [&](double error) {
        for (std::uint32_t k = 0; k < whole.particleHandler.getSize(); ++k) {
            const auto one = whole.particleHandler.getObject(k), other = failed.particleHandler.getObject(k);
            EXPECT_LT((one.getPosition() - other.getPosition()).norm(), error * 0.03) << k;
            EXPECT_LT((one.getVelocity() - other.getVelocity()).norm(), error * 0.1) << k;
        }
    };
    expectAlike(1e-15);
}

// In water at rest a grain at rest feels its weight and its buoyancy once, in both models: m dv/dt = (rho_s -
// rho) V g. Then it falls at the speed at which the drag is that: 0.3 mm glass, from an independent program.
TEST(FluidPart, countsBuoyancyOnce) {
    for (const PressureModel model : {PressureModel::A, PressureModel::B}) {
        scenes::FewGrains<S> scene(glass(), {{.radius = 1.5e-4, .position = {0.015, 0.015, 0.035}}}, 1e-6);
        addFluid<Still>(scene, "SchillerNaumann", model);
        scene.setGravity({0, 0, -9.81});
        scene.initialise();
        scene.step(2);
        // The drag is still 3e-4 of what it will be.
        const double after = scene.particleHandler.getObject(0).getVelocity().z();
        EXPECT_NEAR(after / (-2e-6 * 9.81 * (1 - water.density / density)), 1, 1e-3);
        scene.step(100000);
        // After 24 times the time of its drag, m v / weight = 4 ms: 1e-11 is left. The grain takes up
        // to 1.4e-5 of its cells, and the number is for none.
        EXPECT_NEAR(-scene.particleHandler.getObject(0).getVelocity().z() / 0.0402187764284, 1, 1.4e-5);
    }
}

// A grain that fills its cell: the drag is that of the law at the lowest porosity, which dragForce() has too.
TEST(FluidPart, asksALawAtTheLowestPorosity) {
    constexpr double edge = 1.7e-3;
    constexpr FluidGrid cell{{0, 0, 0}, {edge, edge, edge}, {1, 1, 1}};
    scenes::FewGrains<S> scene(
        glass(), {{.radius = radius, .position = {1e-3, 1e-3, 1e-3}, .velocity = {0, 0, 0.02}}}, 1e-6);
    const FluidPart& fluid =
        scene.addPart<FluidPart>(cell, water, dragLaw("Ergun"), std::make_unique<Rest>());
    scene.run(1);
    const double porosity = fluid.fields().porosity[0];
    EXPECT_NEAR(porosity, 1 - 4 * std::numbers::pi / 3 * std::pow(radius / edge, 3), 1e-14);
    ASSERT_LT(porosity, 0.2);
    const double force = dragForce(dragLaw("Ergun"), porosity, 0.02, 2 * radius, water);
    EXPECT_NEAR(fluid.fields().drag[0].z * cell.cellVolume() / -force, 1, 1e-12);
}

void expectSame(const std::vector<Vector<double>>& a, const std::vector<Vector<double>>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k], b[k]) << k;
}

// What is read of the fluid between two steps is that of the last step, also where a restart lies between.
// Then all goes on with the same bits.
TEST(FluidPart, hasItsFieldsAfterARestart) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    const auto expectAlike = [](const FluidPart& one, const FluidPart& other) {
        EXPECT_EQ(one.fields().porosity, other.fields().porosity);
        for (const auto field : {&FluidFields::solidFlux, &FluidFields::drag, &FluidFields::source,
                                 &FluidFields::velocity, &FluidFields::pressureGradient})
            expectSame(one.fields().*field, other.fields().*field);
        EXPECT_EQ(one.dragImpulse(), other.dragImpulse());
        EXPECT_EQ(one.ledger().work, other.ledger().work);
        EXPECT_EQ(one.ledger().impulse, other.ledger().impulse);
    };
    scenes::FewGrains<S> whole(glass(), cloud(), 1e-5), resumed(glass(), cloud(), 1e-5);
    const FluidPart& fluid = addFluid<Swirl>(whole, "DiFelice", PressureModel::B);
    const FluidPart& again = addFluid<Swirl>(resumed, "DiFelice", PressureModel::B);
    whole.run(25);
    for (const Vector<double>& source : fluid.fields().source) ASSERT_GT(norm(source), 0);
    whole.writeRestart(file);
    resumed.restartFrom(file);
    resumed.initialise();
    expectAlike(fluid, again);
    whole.step(25), resumed.step(25);
    expectAlike(fluid, again);
    EXPECT_EQ(stateHash(whole.particleHandler.store()), stateHash(resumed.particleHandler.store()));
}

TEST(FluidPart, refusesWhatCannotBe) {
    const auto refusal = [](const FluidGrid& grid, const FluidMaterial& fluid, bool hasHost = true) {
        return support::refusal([&] {
            const FluidPart part(grid, fluid, dragLaw("WenYu"),
                                 hasHost ? std::make_unique<Still>() : nullptr);
        });
    };
    EXPECT_TRUE(support::isOneSentence(refusal({{0, 0, 0}, {1, 1, 0}, {1, 1, 1}}, water)));
    EXPECT_TRUE(support::contains(refusal(box, {.density = 1000}), "viscosity"));
    EXPECT_TRUE(support::contains(refusal(box, water, false), "no host"));
    scenes::FewGrains<S> periodic(glass(), cloud(), 1e-5);
    addFluid<Still>(periodic, "WenYu", PressureModel::A);
    periodic.setPeriodic(0, 0, 0.03);
    EXPECT_TRUE(support::contains(support::refusal([&] { periodic.initialise(); }), "along x"));
    scenes::FewGrains<S> discs(glass(), {{.radius = radius, .position = {0.01, 0.01, 0}}}, 1e-5);
    discs.particleHandler.holdAll(HeldAxes::inPlane());
    discs.speciesHandler.setGrainsAreDiscs();
    discs.setIntegrator(integrators::velocityVerlet);
    addFluid<Still>(discs, "WenYu", PressureModel::A);
    const std::string ofDiscs = support::refusal([&] { discs.initialise(); });
    EXPECT_TRUE(support::isOneSentence(ofDiscs));
    EXPECT_TRUE(support::contains(ofDiscs, "grains are discs; take spheres"));
    scenes::FewGrains<S> outside(glass(), {{.radius = radius, .position = {0.5, 0, 0}}}, 1e-5);
    addFluid<Still>(outside, "WenYu", PressureModel::A);
    outside.initialise();
    try {
        outside.step();
        ADD_FAILURE();
    } catch (const RunError& error) {
        EXPECT_TRUE(support::contains(error.what(), "outside the grid"));
    }
}

}  // namespace
}  // namespace pendular::fluidPartTest
