#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

/// The exact sum of numbers, or of vectors and arrays of numbers, of which each rank adds some. Rounded once,
/// it has the same bits for any number of ranks, and in whatever order numbers are added.
template <class Value>
class SumOverRanks {
public:
    void add(const Value& value) {
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(part(value, k));
    }
    /// Of all ranks, which call this together.
    [[nodiscard]] Value ofAll(const Scene& scene) {
        std::vector<ExactSum*> all;
        for (ExactSum& sum : sums) all.push_back(&sum);
        scene.sumOverRanks(all);
        Value found{};
        for (std::size_t k = 0; k < sums.size(); ++k) part(found, k) = sums[k].value();
        return found;
    }

private:
    static std::size_t size() {
        if constexpr (std::is_same_v<Value, double>) return 1;
        else return static_cast<std::size_t>(Value{}.size());
    }
    template <class Any>
    static auto& part(Any& value, std::size_t k) {
        if constexpr (std::is_same_v<Value, double>) return value;
        else return value[static_cast<decltype(value.size())>(k)];
    }

    std::vector<ExactSum> sums = std::vector<ExactSum>(size());
};

/// Calls of(grain) for each grain of a scene, on the rank that owns it, and returns the sum over all ranks of
/// what it returns: a double, a Vec3D or a std::array of doubles. In a hook all ranks must call it. A held
/// grain counts, too.
template <class Function>
auto sumOverGrains(Scene& scene, Function&& of) {
    SumOverRanks<std::decay_t<std::invoke_result_t<Function&, GrainReference>>> sum;
    for (const GrainReference grain : scene.particleHandler.ownGrains()) sum.add(of(grain));
    return sum.ofAll(scene);
}

/// The same of each contact that has a force (an ObservedContact), with grains and with walls.
template <class Function>
auto sumOverInteractions(const Scene& scene, Function&& of) {
    SumOverRanks<std::decay_t<std::invoke_result_t<Function&, const ObservedContact&>>> sum;
    for (const ObservedContact& contact : scene.ownInteractions()) sum.add(of(contact));
    return sum.ofAll(scene);
}

}  // namespace pendular
