#pragma once

#include <functional>
#include <memory>

#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

/// A scene of a recipe, with the hooks by which its features act.
class RandomScene {
public:
    virtual ~RandomScene() = default;
    [[nodiscard]] virtual Scene& scene() = 0;
    [[nodiscard]] virtual SpeciesOfScene& species() = 0;
    /// Null where its grains are spheres.
    [[nodiscard]] virtual SuperquadricHandler* shapes() { return nullptr; }

    Actions actions;
    std::function<void()> beforeStep, afterStep;  // of the one who watches
    std::function<void()> afterMotion;            // the same, before features act after the step
    std::size_t stopAfter = 1'000'000;            // steps
    bool gathers = false;  // all grains come to all ranks before a hook that changes something

protected:
    void actBefore(std::size_t steps) {
        if (beforeStep) beforeStep();
        const auto [first, last] = actions.before.equal_range(steps);
        if (gathers && first != last) scene().gather();
        for (auto action = first; action != last; ++action) action->second();
    }
    void actAfter() {
        if (afterMotion) afterMotion();
        for (const auto& action : actions.afterEach) action();
        if (afterStep) afterStep();
    }
    void visitActions(StateArchive& archive) {
        for (const auto& visit : actions.states) visit(archive);
    }
};

template <class Base>
class Hooked : public Base, public RandomScene {
public:
    Scene& scene() override { return *this; }
    void actionsBeforeTimeStep() override { actBefore(this->getNumberOfTimeSteps()); }
    void actionsAfterTimeStep() override { actAfter(); }
    void actionsOnContactEvent(const ContactEvent& event) override {
        if (actions.onEvent) actions.onEvent(event);
    }
    void visitState(StateArchive& archive) override { visitActions(archive); }
    [[nodiscard]] bool continueSolve() const override { return this->getNumberOfTimeSteps() < stopAfter; }
};

/// A SuperquadricSimulation where the recipe asks for one, of its first type of species that can be, else of
/// HertzianViscoelasticMindlin. A Simulation<S> where the recipe has one type of
/// species that there is such a one for, and its seed says so; else a Simulation<>.
std::unique_ptr<RandomScene> sceneOf(const Recipe& recipe);

}  // namespace pendular::fuzz
