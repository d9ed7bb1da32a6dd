// Integrators, the step, and what a run keeps account of.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

void addAdaptiveStep(Making& making) {
    const double share = making.draw.even(0.3, 1), largest = making.draw.even(0.5, 2);
    const double step = making.scales.step;
    if (making.draw.oneIn(2)) making.scene.setAdaptiveTimeStep(making.draw.give("share", share));
    else
        making.scene.setAdaptiveTimeStep(making.draw.give("share", share),
                                         making.draw.give("largest", largest * step));
}

void addEvents(Making& making) {
    making.scene.listenToContacts();
    // What a driver makes of events, and remembers.
    const auto heard = std::make_shared<std::uint64_t>(0);
    making.actions.onEvent = [heard](const ContactEvent& event) {
        *heard = *heard * 31 + event.particle1 + static_cast<std::uint64_t>(event.kind);
    };
    making.actions.states.emplace_back([heard](StateArchive& archive) { archive.value("heard", *heard); });
}

void addGrainColumn(Making& making) {
    const auto column = making.scene.particleHandler.addColumn("way", "m", making.draw.give("initial", 0.5));
    making.actions.afterEach.emplace_back([&scene = making.scene, column] {
        for (const GrainReference grain : scene.particleHandler.ownGrains())
            column[grain.getId()] += grain.getVelocity().norm() * scene.getTimeStep();
    });
}

void addContactColumn(Making& making) {
    const ContactColumnReference age =
        making.scene.addContactColumn("age", "s", making.draw.give("initial", 0.0));
    making.actions.afterEach.emplace_back([&scene = making.scene, age] {
        for (const ObservedContact& contact : scene.ownInteractions()) age[contact] += scene.getTimeStep();
    });
}

}  // namespace

std::vector<Feature> methodFeatures() {
    const auto set = [](const Integrator& scheme) {
        return [scheme](Making& making) { making.scene.setIntegrator(scheme); };
    };
    return {
        {.name = "VelocityVerlet",
         .share = 0.1,
         .add = set(integrators::velocityVerlet),
         .kinds = {"integrator"},
         .excludes = {"integrator"}},
        {.name = "SpringsInStep",
         .share = 0.05,
         .add = set(integrators::springsInStep),
         .kinds = {"integrator"},
         .excludes = {"integrator"}},
        // Its positions are not those of velocity Verlet, which keeps angular momentum to round-off.
        {.name = "AdamsMoulton",
         .share = 0.1,
         .add = set(integrators::adamsMoulton),
         .loses = angularMomentum,
         .kinds = {"integrator"},
         .excludes = {"integrator"}},
        {.name = "AdaptiveStep",
         .share = 0.1,
         .add = addAdaptiveStep,
         .excludes = {"AdamsMoulton", "driven wall", "moved wall", "membrane", "viscous bridges",
                      "TimeStepChange"}},
        {.name = "UnstableStep",
         .share = 0.03,
         .add = [](Making& making) { making.scene.acceptUnstableTimeStep(); }},
        {.name = "Ledger",
         .share = 0.5,
         .add = [](Making& making) { making.scene.keepEnergyLedger(); },
         .kinds = {"ledger"}},
        {.name = "Events", .share = 0.2, .add = addEvents},
        {.name = "GrainColumn", .share = 0.1, .add = addGrainColumn},
        {.name = "ContactColumn", .share = 0.1, .add = addContactColumn},
    };
}

}  // namespace pendular::fuzz
