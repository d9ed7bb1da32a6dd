// Periodic scenes, shear, strain, gravity.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

void addPeriods(Making& making) {
    const int first = making.draw.whole(0, 2), count = making.draw.whole(1, 3);
    for (int k = 0; k < count; ++k) making.makePeriodic((first + k) % 3);
}

void makeAllPeriodic(Making& making) {
    for (int axis = 0; axis < 3; ++axis) making.makePeriodic(axis);
}

/// The flow crosses the box by a part of its length in the run.
double rateOf(Making& making) {
    return making.draw.even(-1, 1) * making.scales.speed / (making.highest - making.lowest).norm();
}

/// Each grain goes along with the flow.
void addShear(Making& making) {
    makeAllPeriodic(making);
    const int flow = making.draw.whole(0, 2), gradient = (flow + making.draw.whole(1, 2)) % 3;
    making.scene.setLeesEdwards(flow, gradient, making.draw.give("rate", rateOf(making)));
    making.atEnd([&scene = making.scene] {
        for (GrainReference grain : scene.particleHandler)
            if (!grain.isFixed() && !scene.bodyHandler.bodyOf(grain.getId()))
                grain.setVelocity(grain.getVelocity() + scene.shearFlowAt(grain.getPosition()));
    });
}

void addShearServo(Making& making) {
    addShear(making);
    const double stress = making.draw.decades(1e-5, 1e-3) * making.scales.modulus;
    making.scene.setTargetShearStress(making.draw.give("stress", stress),
                                      making.draw.give("time", 0.1 * making.scales.duration),
                                      making.draw.give("largest", 2 * std::abs(rateOf(making))));
}

void addStrain(Making& making) {
    makeAllPeriodic(making);
    const int always = making.draw.whole(0, 2);
    for (int axis = 0; axis < 3; ++axis)
        if (making.draw.oneIn(2) || axis == always)
            making.scene.setStrainRate(axis, making.draw.give("rate", rateOf(making)));
}

/// Along x and y, between planes across z if there are any.
void addOedometer(Making& making) {
    for (const int axis : {0, 1}) {
        making.makePeriodic(axis);
        making.scene.setStrainRate(axis, making.draw.give("rate", 0.3 * rateOf(making)));
    }
}

void addStressServo(Making& making) {
    makeAllPeriodic(making);
    const double stress = making.draw.decades(1e-5, 1e-3) * making.scales.modulus;
    for (int axis = making.draw.whole(0, 2); axis < 3; ++axis)
        making.scene.setTargetStress(axis, making.draw.give("stress", stress),
                                     making.draw.give("time", 0.1 * making.scales.duration),
                                     making.draw.give("largest", std::abs(rateOf(making))));
}

void addShearRateChange(Making& making) {
    const double rate = making.draw.give("rate", rateOf(making));
    making.before(making.someStep(), [&scene = making.scene, rate] { scene.setShearRate(rate); });
}

void addStrainRateChange(Making& making) {
    const int axis = making.draw.whole(0, making.has("Oedometer") ? 1 : 2);
    const double rate = making.draw.give("rate", rateOf(making));
    making.before(making.someStep(),
                  [&scene = making.scene, axis, rate] { scene.setStrainRate(axis, rate); });
}

Vec3D anyGravity(Making& making) {
    const double size = making.draw.decades(0.1, 3) * making.scales.speed / making.scales.duration;
    return making.draw.give("gravity", Vec3D(size * making.draw.normal()));
}

void addGravity(Making& making) { making.scene.setGravity(anyGravity(making)); }

void addGravityChange(Making& making) {
    const Vec3D gravity = anyGravity(making);
    making.before(making.someStep(), [&scene = making.scene, gravity] { scene.setGravity(gravity); });
}

void addDomain(Making& making) {
    making.scene.setDomain(making.draw.give("lowest", making.lowest),
                           making.draw.give("highest", making.highest));
}

}  // namespace

std::vector<Feature> spaceFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    const std::vector<std::string_view> imagesExclude{"wall", "gravity", "membrane", "moving images"};
    const auto movesImages = [&](std::string name, double share, auto add,
                                 std::vector<std::string_view> kinds, std::string_view alsoExcluded) {
        kinds.push_back("moving images"), kinds.push_back("periodic");
        std::vector<std::string_view> excludes = imagesExclude;
        excludes.push_back(alsoExcluded);
        return Feature{.name = std::move(name),
                       .share = share,
                       .add = add,
                       .loses = both,
                       .kinds = kinds,
                       .excludes = excludes};
    };
    return {
        {.name = "Periods",
         .share = 0.25,
         .add = addPeriods,
         .loses = angularMomentum,
         .kinds = {"periodic"}},
        movesImages("Shear", 0.06, addShear, {"shear"}, "membrane"),
        movesImages("ShearServo", 0.03, addShearServo, {"shear"}, "body"),
        movesImages("Strain", 0.06, addStrain, {"strain"}, "membrane"),
        movesImages("StressServo", 0.04, addStressServo, {"strain"}, "body"),
        {.name = "Oedometer",
         .share = 0.06,
         .add = addOedometer,
         .loses = both,
         .kinds = {"strain", "moving images", "periodic"},
         .excludes = {"Cylinder", "Rod", "parts", "membrane", "gravity", "held", "moving images"}},
        {.name = "ShearRateChange",
         .share = 0.5,
         .add = addShearRateChange,
         .loses = both,
         .needs = {"Shear"}},
        {.name = "StrainRateChange",
         .share = 0.5,
         .add = addStrainRateChange,
         .loses = both,
         .needs = {"strain"}},
        {.name = "Gravity", .share = 0.35, .add = addGravity, .loses = both, .kinds = {"gravity"}},
        {.name = "GravityChange",
         .share = 0.08,
         .add = addGravityChange,
         .loses = both,
         .kinds = {"gravity"}},
        {.name = "Domain", .share = 0.1, .add = addDomain},
    };
}

}  // namespace pendular::fuzz
