// What hooks do to the time step and to the materials in the run.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

void addTimeStepChange(Making& making) {
    for (int k = making.draw.whole(1, 2); k > 0; --k) {
        const double factor = making.draw.give("factor", making.draw.even(0.5, 1));
        making.before(making.someStep(),
                      [&scene = making.scene, factor] { scene.setTimeStep(factor * scene.getTimeStep()); });
    }
}

/// A restart file does not keep the end, so a scene that goes on is set up with it.
void addTimeMaxChange(Making& making) {
    const double factor = making.draw.give("factor", making.draw.even(0.7, 1.1));
    const int step = making.someStep();
    const auto change = [&scene = making.scene, factor] { scene.setTimeMax(factor * scene.getTimeMax()); };
    if (making.goesOnFrom > step) making.atEnd(change);
    making.before(step, change);
}

/// Softer, lighter, wetter: what a scene bears at any time step that it has.
void addMaterialChange(Making& making) {
    AnySpecies* const material = making.anyMaterial();
    std::vector<std::string> fields;
    for (const NamedField& field : material->fields())
        if (isSet(*field.value) && *field.value > 0 && field.range.highest > 2)
            fields.emplace_back(field.name);
    if (fields.empty()) return;
    const std::string field = making.draw.oneOf(fields);
    const double factor = making.draw.give("factor", making.draw.even(0.8, 1));
    making.draw.note(field);
    // A choice between schemes, or a ratio of at least 1, is no amount.
    if (field.starts_with("viscousS") || field.starts_with("tangentialL") || field.starts_with("static") ||
        field.starts_with("viscousN"))
        return;
    making.before(making.someStep(),
                  [material, field, factor] { material->set(field, factor * material->get(field)); });
}

}  // namespace

std::vector<Feature> changeOfSceneFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "TimeStepChange", .share = 0.08, .add = addTimeStepChange, .kinds = {"change"}},
        {.name = "TimeMaxChange", .share = 0.05, .add = addTimeMaxChange, .kinds = {"change"}},
        {.name = "MaterialChange",
         .share = 0.1,
         .add = addMaterialChange,
         .loses = both,
         .kinds = {"change"}},
    };
}

}  // namespace pendular::fuzz
