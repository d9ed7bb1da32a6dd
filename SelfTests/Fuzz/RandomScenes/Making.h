#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "Kernel/Features/Superquadrics/SuperquadricHandler.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"

namespace pendular::fuzz {

/// Who has the species of a scene: a Simulation of one type, or of several.
class SpeciesOfScene {
public:
    virtual ~SpeciesOfScene() = default;
    /// A species of this type, of which nothing is set.
    virtual AnySpecies* add(std::string_view type) = 0;
    /// The contacts of two species of different types have the laws of this type.
    virtual void setPairType(int a, int b, std::string_view type) = 0;
};

/// How large the things of a scene are. From the seed alone, so that they do not depend on its features.
struct Scales {
    explicit Scales(const Recipe& recipe);

    double radius, density, modulus;  // m, kg/m^3, Pa; of the largest grains
    double speed;                     // m/s
    int steps, restartStep;
    double step, duration;     // s; of the scene, unless its stability limit is below
    std::array<int, 3> cells;  // in which the grains are
    double cell;               // m, the edge of one
    bool touching;             // grains in neighbouring cells touch
    Vec3D lowest;              // m, of the box
    bool isOneType;            // a Simulation<S>, where there is such a one

    [[nodiscard]] double mass() const { return sphereMass(radius, density); }      // kg, of a grain
    [[nodiscard]] double force() const { return mass() * speed / (10 * step); }    // N, of a touch
    [[nodiscard]] double liquid() const { return 0.004 * std::pow(radius, 3.0); }  // m^3, of a bridge
};

/// What happens in the steps of a scene, by features.
struct Actions {
    std::multimap<std::size_t, std::function<void()>> before;  // by the number of steps done
    std::vector<std::function<void()>> afterEach;
    std::function<void(const ContactEvent&)> onEvent;
    std::vector<std::function<void(StateArchive&)>> states;
};

/// A scene to which features are added, one after the other.
class Making {
public:
    Making(Scene& made, SpeciesOfScene& speciesOf, Actions& actionsOf, const Recipe& of, int restartStep);

    /// Adds all features of the recipe, and what every scene has. Throws InputError as Pendular does.
    void addAll();

    Scene& scene;
    SpeciesOfScene& species;
    Actions& actions;
    const Recipe& recipe;
    const Scales scales;
    /// The random numbers of the feature that is added now.
    Draws draw;
    /// Those of a scene of superquadrics; null: its grains are spheres.
    SuperquadricHandler* shapes = nullptr;
    /// Steps that had been done where the scene goes on from a restart file; 0: it begins.
    const int goesOnFrom;

    Vec3D lowest, highest;             // m, of the box
    double top = 0;                    // m, of the cells that have grains; above it is room
    std::array<bool, 3> isPeriodic{};  // along an axis
    std::array<bool, 3> isClosed{};    // by planes across an axis, which stay
    std::vector<AnySpecies*> materials;
    std::vector<std::string> typeOfMaterial;
    std::vector<SphericalParticle> grainsToCome;  // for the stability limit

    /// Whether a feature of this name or kind is in the recipe.
    [[nodiscard]] bool has(std::string_view word) const;
    /// What is not kept, of all features: bits of Loses.
    [[nodiscard]] unsigned loses() const;
    AnySpecies* anyMaterial() { return draw.oneOf(materials); }
    /// The middle of a cell in which nothing is yet; none when all are taken.
    std::optional<Vec3D> takeCell();
    /// A grain that fits into a cell, at a place in it; null without a cell.
    std::optional<SphericalParticle> newGrain();
    /// A grain of which Pendular may be told at any time: it can move or is held, and is in no body.
    /// @param share 0 to 1, of the way through all of them
    std::optional<GrainReference> someGrain(double share) const;
    void makePeriodic(int axis);
    /// Before a step that follows so many.
    void before(int steps, std::function<void()> action);
    int someStep() { return draw.whole(1, std::max(1, scales.steps - 2)); }
    /// Now, or later when all features are there.
    void atEnd(std::function<void()> action) { atEndOfSetUp.push_back(std::move(action)); }

    [[nodiscard]] std::string record() const { return records; }
    [[nodiscard]] bool usedWrong() const { return anyWrongUsed; }
    [[nodiscard]] bool gaveNoNumber() const { return anyNoNumber; }

private:
    void beginWith(std::string_view name) { draw = Draws(recipe, name); }
    void endOf(std::string_view name);
    void chooseStep();

    std::vector<Vec3D> freeCells;
    std::vector<std::function<void()>> atEndOfSetUp;
    std::string records;
    bool anyWrongUsed = false, anyNoNumber = false;
};

}  // namespace pendular::fuzz
