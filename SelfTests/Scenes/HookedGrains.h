#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::scenes {

/// A few grains, with hooks that a test gives.
template <class S>
class HookedGrains : public FewGrains<S> {
public:
    using FewGrains<S>::FewGrains;
    void actionsBeforeTimeStep() override {
        if (hook) hook(*this);
    }
    void actionsOnContactEvent(const ContactEvent& event) override {
        heard.push_back(event);
        if (onEvent) onEvent(*this);
    }
    /// A grain of the first species.
    SphericalParticle grain(double radius, const Vec3D& position, const Vec3D& velocity = Vec3D::Zero()) {
        SphericalParticle result;
        result.setSpecies(this->speciesHandler.getObject(0));
        result.setRadius(radius);
        result.setPosition(position);
        result.setVelocity(velocity);
        return result;
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) this->step();
    }
    std::function<void(HookedGrains&)> hook, onEvent;
    std::vector<ContactEvent> heard;
};

/// The sentence with which a run ends that does this in its fifth step; empty if it does not end by it.
template <class S>
std::string endOf(HookedGrains<S>& scene, std::function<void(HookedGrains<S>&)> action) {
    const support::TestFolder folder;
    scene.setName(folder.name());
    scene.setQuiet();
    scene.setTimeMax(20 * scene.getTimeStep());
    scene.hook = [action = std::move(action)](HookedGrains<S>& s) {
        if (s.getNumberOfTimeSteps() == 5) action(s);
    };
    try {
        scene.solve();
    } catch (const RunError& error) {
        EXPECT_TRUE(std::filesystem::exists(folder.name() + "-last-state.csv"));
        return error.what();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace pendular::scenes
