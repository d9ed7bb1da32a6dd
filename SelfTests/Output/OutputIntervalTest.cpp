#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "Kernel/Core/Run/OutputInterval.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/OutputForm.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::outputIntervalTest {
namespace {

std::vector<std::size_t> dueSteps(double interval, double timeStep, std::size_t end) {
    OutputInterval output("Test", interval);
    std::vector<std::size_t> steps;
    for (std::size_t step = 0; step <= end; ++step)
        if (output.isDueAfter(step, timeStep)) steps.push_back(step);
    return steps;
}

TEST(OutputInterval, isDueAtTheStepNearestToEachMultiple) {
    using Steps = std::vector<std::size_t>;
    EXPECT_EQ(dueSteps(10, 1, 35), (Steps{0, 10, 20, 30}));
    EXPECT_EQ(dueSteps(29.6, 1, 100), (Steps{0, 30, 59, 89}));
    EXPECT_EQ(dueSteps(0.7, 1, 3), (Steps{0, 1, 2, 3}));
    EXPECT_EQ(dueSteps(1e-320, 1, 3), (Steps{0, 1, 2, 3}));
    EXPECT_EQ(dueSteps(1e300, 1e-6, 1000), (Steps{0}));
}

// The output is due at 3.05, 4.05, 5.05 s with another time step from 2.3 s on.
TEST(OutputInterval, goesOnWithAnotherTimeStep) {
    OutputInterval output("Test", 1);
    std::vector<std::size_t> steps;
    for (std::size_t step = 1; step <= 12; ++step)
        if (output.isDueAfter(step, 0.25, 2.3)) steps.push_back(step);
    EXPECT_EQ(steps, (std::vector<std::size_t>{3, 7, 11}));
}

// The time step grows or shrinks, by up to six times, every few steps: a multiple is told once, at a time
// within half of the longest step.
TEST(OutputInterval, tellsEachMultipleOnceWhereTheTimeStepChanges) {
    UniformRandom random(7);
    OutputInterval output("Test", 1);
    std::size_t told = 0;
    double before = 0;
    for (int stretch = 0; stretch < 1000; ++stretch) {
        const double timeStep = random.uniform(0.05, 0.3);
        const auto steps = static_cast<std::size_t>(random.uniform(1, 6));
        for (std::size_t step = stretch == 0 ? 0 : 1; step <= steps; ++step) {
            if (!output.isDueAfter(step, timeStep, before)) continue;
            ASSERT_NEAR(before + static_cast<double>(step) * timeStep, static_cast<double>(told), 0.3);
            ++told;
        }
        before += static_cast<double>(steps) * timeStep;
    }
    EXPECT_NEAR(static_cast<double>(told), before, 1);
}

/// Whatever the numbers, each multiple has its step, and no other step is due. A quotient of the order of 1e3
/// is rounded by some 1e-13: two steps may be called equally near to it.
TEST(OutputInterval, leavesNoMultipleOut) {
    UniformRandom random(5);
    for (int draw = 0; draw < 2000; ++draw) {
        const double timeStep = std::exp(random.uniform(-20, 0)), ratio = std::exp(random.uniform(0, 4));
        const double interval = ratio * timeStep;
        const std::vector<std::size_t> steps = dueSteps(interval, timeStep, 1000);
        for (std::size_t k = 0; k < steps.size(); ++k)
            ASSERT_NEAR(static_cast<double>(steps[k]), static_cast<double>(k) * ratio, 0.5 + 1e-9) << ratio;
        ASSERT_GE(static_cast<double>(steps.size()) * ratio, 1000.5 - 1e-9) << ratio;
    }
}

struct StepList : RemembersNothing {
    std::shared_ptr<std::vector<std::size_t>> steps = std::make_shared<std::vector<std::size_t>>();
    [[nodiscard]] OutputInterval interval() const { return {"StepList", 1e-5}; }
    template <class Scene>
    void write(const Scene& scene) {
        steps->push_back(scene.getNumberOfTimeSteps());
    }
};

// Where the first step after a restart file has another length, the multiple of 2e-5 s, 2 us after the file,
// is told in that step.
TEST(OutputInterval, leavesNoMultipleOutAfterARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP();
    using Smooth = Species<LinearViscoelastic>;
    struct Flight : scenes::FewGrains<Smooth> {
        explicit Flight(const std::string& name, double end)
            : FewGrains(ballast(), {{.radius = 1e-3}}, 1e-6) {
            setName(name);
            setQuiet();
            setTimeMax(end);
            keepRestartFile();
            addOutput(list);
        }
        static Smooth ballast() {
            Smooth species;
            species.setDensity(2500), species.setStiffness(1);
            return species;
        }
        void actionsBeforeTimeStep() override {
            if (getNumberOfTimeSteps() == 18) setTimeStep(5e-6);
        }
        StepList list;
    };
    const support::TestFolder folder;
    Flight whole(folder.path() / "whole", 5e-5);
    whole.solve();
    Flight first(folder.path() / "part", 18e-6);
    first.solve();
    Flight second(folder.path() / "part", 5e-5);
    second.restartFrom(first.restartFile());
    second.solve();
    const std::vector<std::size_t> all{0, 10, 19, 20, 22, 24, 25};  // 0, 10, 23, 28, 38, 48, 53 us
    EXPECT_EQ(*whole.list.steps, all);
    EXPECT_EQ(*second.list.steps, std::vector<std::size_t>(all.begin() + 2, all.end()));
}

TEST(OutputInterval, isNoneOrPositive) {
    EXPECT_FALSE(OutputInterval().isGiven());
    EXPECT_FALSE(OutputInterval("Test", 0).isGiven());
    EXPECT_TRUE(OutputInterval("Test", 1e-300).isGiven());
    for (const double wrong : std::vector<double>{-1, std::nan(""), INFINITY})
        EXPECT_NE(support::refusal([&] { OutputInterval("Test", wrong); }), "") << wrong;
}

}  // namespace
}  // namespace pendular::outputIntervalTest
