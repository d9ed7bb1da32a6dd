#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

namespace pendular {

/// A thing that a scene can have, and that something else may not go together with (Conflicts.h).
enum class Feature : std::uint8_t {
    Walls,
    WallsInStrain,
    Membranes,
    DrivenWalls,
    TurnedWalls,
    WornWalls,
    ImpactWear,
    Grains,
    HeldGrains,
    RigidBodies,
    Superquadrics,
    PeriodicFaces,
    Shear,
    Strain,
    StressServo,
    Gravity,
    GravityAlongGradient,
    EarlierAccelerations,
    SpringsInStep,
    AdaptiveStep,
    EnergyLedger,
    MovingLiquid,
    ViscousBridges,
    FilmMass,
    Sprays,
    Inlets,
    Outlets,
    FluxPlanes,
    OwnPart,
    ContactEvents,
    Ranks,
    Count
};

/// The feature's name in a sentence: "shear (setLeesEdwards())".
[[nodiscard]] std::string_view nameOf(Feature feature);

/// The features of a scene or of a part of its step.
class Features {
public:
    Features() = default;
    Features(std::initializer_list<Feature> given) {
        for (const Feature feature : given) add(feature);
    }

    /// @param which of them, for the sentence of a conflict: "wall 2"
    void add(Feature feature, std::string which = {}) {
        if (std::string& told = found[feature]; told.empty()) told = std::move(which);
    }
    void add(const Features& others) { found.insert(others.found.begin(), others.found.end()); }

    [[nodiscard]] bool isEmpty() const { return found.empty(); }
    [[nodiscard]] bool has(Feature feature) const { return found.contains(feature); }
    /// The feature's name in a sentence, with which of them it is ("wall 2"), where that was said.
    [[nodiscard]] std::string shown(Feature feature) const;

private:
    std::map<Feature, std::string> found;
};

}  // namespace pendular
