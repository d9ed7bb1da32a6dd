#include "SelfTests/Fuzz/RandomScenes/Composition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/Core/Step/Conflicts.h"
#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::fuzz {

namespace {

using support::contains;

constexpr std::string_view wetShapes = "HertzianViscoelasticMindlinLiquidBridgeWillett";

constexpr std::array<std::string_view, 68> composed{
    // materials
    "HertzianViscoelasticMindlinJKR", wetShapes, "HertzianViscoelasticMindlinViscousLiquidBridgeWillett",
    "LinearViscoelasticSlidingFrictionLiquidMigrationWillett",
    // methods
    "VelocityVerlet", "SpringsInStep", "AdamsMoulton", "AdaptiveStep", "Ledger", "Events", "ContactColumn",
    // space
    "Periods", "Shear", "ShearServo", "Strain", "StressServo", "Oedometer", "Gravity", "GravityChange",
    "Domain",
    // bodies
    "HeldGrains", "HeldAxes", "HeldBodies", "Clumps", "Superquadrics", "Blocks", "JoinInRun", "BodyChange",
    // walls
    "Planes", "Cylinder", "Rod", "Tube", "Funnel", "MovingPlane", "VibratingPlane", "Belt", "WallThatComes",
    "Mesh", "HalfSpaces", "MovingMesh", "Wear", "WornVertices", "Membrane", "Piston", "ForceServo", "Slider",
    "Rotor", "FreeWall",
    // liquid
    "Films", "LiquidDensity", "Evaporation", "Spray", "JoinAtStart",
    // grains that come and go
    "Insert", "InsertedClumps", "DenseClumps", "DenseSuperquadrics", "InsertInRun", "Inlet", "ClumpInlet",
    "SuperquadricInlet", "Outlet", "FluxPlane",
    // changes in the run
    "TimeStepChange", "MaterialChange", "Remove",
    // outputs
    "ParaView", "Fields"};

/// A sentence that is not in the table of conflicts.
struct RefusedElsewhere {
    std::string_view partOfSentence, why;
};
constexpr std::array refusedElsewhere{
    RefusedElsewhere{"need steps of one length; set it before the run begins",
                     "refused where the step is changed"},
    RefusedElsewhere{"needs steps of one length; set it before the run begins",
                     "refused where the step is changed"},
    RefusedElsewhere{"along this axis stays; strain", "a matter of axes: others can be strained"},
    RefusedElsewhere{"of a TriangleWall from behind",
                     "a grain comes below the floor through a period: a matter of places"},
    RefusedElsewhere{"is above the stability limit", "a matter of the numbers of a scene"},
    RefusedElsewhere{"and wall 0: initial overlap",
                     "a wall comes where a grain has gone: a matter of places"},
    RefusedElsewhere{"take a smaller amount", "a dense start finds no room beside what is there"},
    RefusedElsewhere{"blocks cannot be in a scene with superquadrics", "a matter of what touches what"},
    RefusedElsewhere{"superquadrics cannot be in a scene with blocks", "a matter of what touches what"},
    RefusedElsewhere{"blocks do not adhere", "faces attract by their area"},
    RefusedElsewhere{"blocks touch walls by their corners", "edges and faces do not touch walls"},
    RefusedElsewhere{"only meshes are repeated", "a shape that is no mesh has no images"},
};

/// A seed with which grains are many, and fill their box.
std::uint64_t fullScene(std::uint64_t seed) {
    for (seed *= 1000;; ++seed) {
        Recipe recipe;
        recipe.seed = seed;
        const Scales scales(recipe);
        const int cells = scales.cells[0] * scales.cells[1] * scales.cells[2];
        if (scales.touching && cells >= 36 && Draws(recipe, "Grains").whole(0, 40) > 28) return seed;
    }
}

bool hasAnyOf(const std::vector<std::string>& features, const std::vector<std::string_view>& words) {
    return std::ranges::any_of(features, [&](const std::string& name) {
        return std::ranges::any_of(words, [&](std::string_view w) { return featureNamed(name).is(w); });
    });
}

/// The first of the composed features that is what a feature needs, and that no other one excludes.
void addNeeded(std::vector<std::string>& features, const Feature& feature) {
    if (feature.needs.empty() || hasAnyOf(features, feature.needs)) return;
    for (const std::string_view name : composed) {
        const Feature& other = featureNamed(name);
        const bool isIt =
            std::ranges::any_of(feature.needs, [&](std::string_view word) { return other.is(word); });
        if (!isIt || exclude(other, feature)) continue;
        features.emplace_back(name);
        return;
    }
}

/// Whether a feature is a liquid that shapes do not have, or is there with one only.
bool isOtherLiquid(const Feature& feature) {
    const auto needs = [&](std::string_view word) {
        return std::ranges::find(feature.needs, word) != feature.needs.end();
    };
    if (feature.is("material")) return !feature.is("dry") && feature.name != wetShapes;
    return needs("moving liquid") || needs("bridges");
}

bool isConflict(const std::string& sentence) {
    return std::ranges::any_of(conflicts(), [&](const Conflict& conflict) {
        return contains(sentence, "cannot be combined") && contains(sentence, conflict.why) &&
               contains(sentence, conflict.advice);
    });
}

}  // namespace

std::span<const std::string_view> composedFeatures() { return composed; }

std::string_view whyNoPair(std::string_view a, std::string_view b) {
    const Feature &first = featureNamed(a), &second = featureNamed(b);
    const auto both = [&](std::string_view word) { return first.is(word) && second.is(word); };
    if (both("integrator")) return "a scene has one integrator";
    if (both("dense")) return "one dense start leaves the other no room";
    if (both("shear") || both("strain")) return "a scene has one shear and one strain";
    const auto are = [&](std::string_view word, std::string_view other) {
        return (first.is(word) && second.is(other)) || (first.is(other) && second.is(word));
    };
    if (are("driven wall", "room")) return "a lid stands where grains would come";
    if ((first.is("shape") && isOtherLiquid(second)) || (second.is("shape") && isOtherLiquid(first)))
        return "superquadrics have no liquid that moves or resists";
    return {};
}

std::string_view whyNotTogether(std::span<const std::string_view> names) {
    const auto count = [&](std::string_view word) {
        return std::ranges::count_if(names,
                                     [&](std::string_view name) { return featureNamed(name).is(word); });
    };
    if (count("shape") > 0 && count("material") > 1) return "a scene of shapes has one type of species";
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = a + 1; b < names.size(); ++b) {
            if (names[a] == names[b]) return "it is the same one";
            if (const std::string_view why = whyNoPair(names[a], names[b]); !why.empty()) return why;
        }
    return {};
}

Recipe recipeWith(std::span<const std::string_view> names, std::uint64_t seed) {
    Recipe recipe;
    recipe.seed = fullScene(seed);
    recipe.steps = 80;
    std::vector<std::string> features(names.begin(), names.end());
    for (const std::string_view name : names) addNeeded(features, featureNamed(name));
    features.emplace_back("Grains");
    for (const Feature& feature : allFeatures())
        if (std::ranges::find(features, feature.name) != features.end())
            recipe.features.push_back(feature.name);
    return recipe;
}

Verdict judgeComposition(const Recipe& recipe) {
    Verdict verdict = judge(recipe, {.restarts = 3});
    const bool isKnown = verdict.end == "ended" || isConflict(verdict.sentence) ||
                         std::ranges::any_of(refusedElsewhere, [&](const RefusedElsewhere& one) {
                             return contains(verdict.sentence, one.partOfSentence);
                         });
    if (!isKnown)
        verdict.faults.push_back(
            fmt::format("no sentence of the table of conflicts: it {}: {}", verdict.end, verdict.sentence));
    return verdict;
}

}  // namespace pendular::fuzz
