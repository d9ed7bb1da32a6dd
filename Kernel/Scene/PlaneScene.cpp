#include "Kernel/Scene/PlaneScene.h"

#include <fmt/format.h>

#include <array>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {
namespace {

/// Throws InputError unless the vector is 0 along the axes along which all grains are held.
void refuse(std::string_view what, const Vector<double>& v, HeldBits held, std::string_view unit) {
    if (held.partAlong(v) == v) return;
    throw InputError(
        fmt::format("Simulation: {} = ({}, {}, {}) {} has a part along an axis along which all grains are "
                    "held (holdAll(), setSystemDimensions(2)); it must be 0 there.",
                    what, v.x, v.y, v.z, unit));
}

}  // namespace

void refuseOutOfPlane(const StepContext& scene) {
    const HeldBits held(scene.particles.axesOfAllHeld());
    if (!held.areAlong()) return;
    refuse("gravity", scene.gravity, held, "m/s^2");
    if (!scene.box.imagesMove) return;
    const Vector<double> middle = scene.box.lowest + 0.5 * scene.box.length;
    for (const Vector<double>& step : std::array<Vector<double>, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}})
        refuse("flow of the images", scene.box.flowAt(middle + step) - scene.box.flowAt(middle), held,
               "m/s over 1 m");
}

void refuseForDiscs(const StepContext& scene) {
    if (!scene.laws->grainsAreDiscs()) return;
    const auto refuseWith = [](std::string_view what, std::string_view advice) {
        throw InputError(fmt::format(
            "Simulation: grains that are discs (setGrainsAreDiscs(), setParticleDimensions(2)) do not go "
            "together with {}; {}.",
            what, advice));
    };
    const HeldAxes all = scene.particles.axesOfAllHeld();
    if (!(all.z && all.aboutX && all.aboutY))
        refuseWith("motion out of the plane of x and y",
                   "call particleHandler.holdAll(HeldAxes::inPlane()) or setSystemDimensions(2), too");
    constexpr std::string_view takeSpheres = "take spheres, and hold them in the plane";
    if (!scene.grains().bodies.empty() || scene.laws->shapes())
        refuseWith("rigid bodies and other shapes", takeSpheres);
    if (scene.laws->layout.liquid > 0) refuseWith("liquid that moves", takeSpheres);
    if (scene.hasInlets) refuseWith("inlets", "add grains in a hook");
    if (scene.scheme->contacts.implicitForces || scene.scheme->contacts.springsInStep)
        refuseWith("an integrator that predicts forces as of spheres",
                   "call setIntegrator(integrators::velocityVerlet)");
}

}  // namespace pendular
