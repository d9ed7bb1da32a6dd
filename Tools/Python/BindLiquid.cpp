#include <fmt/format.h>

#include "Kernel/Features/LiquidTransport/Evaporation.h"
#include "Kernel/Features/LiquidTransport/Spray.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

std::size_t addSpray(PythonScene& scene, double flow, double dropletRadius, double speed, const Vec3D& nozzle,
                     const Vec3D& direction, std::optional<double> coneAngle, std::optional<double> fanAngle,
                     const std::optional<Vec3D>& across, const std::optional<Vec3D>& edge1,
                     const std::optional<Vec3D>& edge2, double volumeSpread, double start, double end,
                     double liquidDensity, double longestFlight, std::uint64_t seed) {
    const bool isRain = edge1 && edge2, isFan = fanAngle && across;
    const bool isIncomplete =
        edge1.has_value() != edge2.has_value() || fanAngle.has_value() != across.has_value();
    if (isRain + isFan + coneAngle.has_value() != 1 || isIncomplete)
        throw InputError(
            "add_spray() takes cone_angle (rad), or fan_angle (rad) and across, or edge1 and edge2 (m) of a "
            "rain.");
    Spray spray;
    if (isRain) spray.setRain(nozzle, *edge1, *edge2, direction);
    else if (isFan) spray.setFlatFan(nozzle, direction, *across, *fanAngle);
    else spray.setCone(nozzle, direction, *coneAngle);
    spray.setFlow(flow), spray.setDropletRadius(dropletRadius), spray.setSpeed(speed);
    // All but the defaults, so that what is out of range is refused there.
    if (volumeSpread != 0) spray.setVolumeSpread(volumeSpread);
    if (start != 0 || end != infinity) spray.setTimes(start, end);
    if (liquidDensity != 0) spray.setMomentum(liquidDensity);
    spray.setLongestFlight(longestFlight), spray.setSeed(seed);
    return scene.scene().sprayHandler.copyAndAddObject(spray);
}

void setEvaporation(PythonScene& scene, std::optional<double> flux, std::optional<double> massTransfer,
                    std::optional<double> saturatedVapour, std::optional<double> liquidDensity,
                    double humidity, std::optional<double> molarVolume, std::optional<double> temperature,
                    std::optional<double> diffusivity, std::optional<double> vapourDifference,
                    std::size_t interval, double start) {
    Evaporation law;
    if (flux.has_value() == massTransfer.has_value())
        throw InputError("set_evaporation() takes one of flux (m/s) and mass_transfer (m/s).");
    if (flux && (saturatedVapour || humidity != 0))
        throw InputError(
            "set_evaporation(): saturated_vapour and humidity are of mass_transfer, and flux does not need "
            "them; leave them out.");
    if (flux && liquidDensity && !diffusivity && !vapourDifference)
        throw InputError(
            "set_evaporation(): liquid_density is of mass_transfer, or of droplets with diffusivity and "
            "vapour_difference; flux alone does not need it; leave it out.");
    if (flux) law.setFlux(*flux);
    else
        law.setMassTransfer(*massTransfer, saturatedVapour.value_or(unset), liquidDensity.value_or(unset),
                            humidity);
    if (molarVolume || temperature) law.setKelvin(molarVolume.value_or(unset), temperature.value_or(unset));
    if (diffusivity || vapourDifference)
        law.setDiffusion(diffusivity.value_or(unset), vapourDifference.value_or(unset),
                         liquidDensity.value_or(unset));
    law.setInterval(interval), law.setStartTime(start);
    scene.scene().setEvaporation(law);
}

py::dict liquidLedger(const PythonScene& scene) {
    const LiquidLedger ledger = scene.scene().liquidLedger();
    py::dict made;
    made["films_m3"] = ledger.films, made["bridges_m3"] = ledger.bridges, made["walls_m3"] = ledger.walls;
    made["removed_m3"] = ledger.removed, made["airborne_m3"] = ledger.airborne, made["lost_m3"] = ledger.lost;
    made["evaporated_m3"] = ledger.evaporated, made["initial_m3"] = ledger.initial;
    made["absorbed_m3"] = ledger.absorbed, made["emitted_m3"] = ledger.emitted;
    made["unaccounted_m3"] = ledger.unaccounted();
    return made;
}

}  // namespace

void bindLiquid(SceneClass& scene) {
    scene
        .def("add_spray", &addSpray, py::kw_only(), py::arg("flow"), py::arg("droplet_radius"),
             py::arg("speed"), py::arg("nozzle"), py::arg("direction"), py::arg("cone_angle") = py::none(),
             py::arg("fan_angle") = py::none(), py::arg("across") = py::none(), py::arg("edge1") = py::none(),
             py::arg("edge2") = py::none(), py::arg("volume_spread") = 0.0, py::arg("start") = 0.0,
             py::arg("end") = infinity, py::arg("liquid_density") = 0.0, py::arg("longest_flight") = 1.0,
             py::arg("seed") = 1,
             comment("Spray",
                     "flow: m^3/s; droplet_radius: m; speed: m/s, of a droplet as it starts. nozzle: m, of "
                     "rain its middle; direction: of any length. cone_angle: rad, at the tip of a cone; or "
                     "fan_angle: rad, and across, a vector in the plane of the fan; or edge1 and edge2: m, "
                     "of the parallelogram from which it rains. volume_spread: the relative standard "
                     "deviation of the volumes, at most 0.5. start, end: s, between which droplets come "
                     "out. liquid_density: kg/m^3, droplets hand over their momentum; 0: they do not. "
                     "longest_flight: s, after which one is lost. seed: of all that is random. Returns its "
                     "number. Raises InputError."))
        .def("set_evaporation", &setEvaporation, py::kw_only(), py::arg("flux") = py::none(),
             py::arg("mass_transfer") = py::none(), py::arg("saturated_vapour") = py::none(),
             py::arg("liquid_density") = py::none(), py::arg("humidity") = 0.0,
             py::arg("molar_volume") = py::none(), py::arg("temperature") = py::none(),
             py::arg("diffusivity") = py::none(), py::arg("vapour_difference") = py::none(),
             py::arg("interval") = 100, py::arg("start") = 0.0,
             comment("Evaporation",
                     "flux: m/s, k itself; or mass_transfer: m/s, h_m in k = h_m (1 - humidity) "
                     "saturated_vapour / liquid_density, with saturated_vapour and liquid_density in "
                     "kg/m^3, humidity 0 to 1. molar_volume: m^3/mol, and temperature: K: the vapour above "
                     "bridges is thinner, by Kelvin. diffusivity: m^2/s, and vapour_difference: kg/m^3: "
                     "droplets in flight dry by the d^2 law, with liquid_density. interval: steps between "
                     "two updates; start: s, before which nothing dries. At set-up. Raises InputError."))
        .def(
            "set_liquid_to_come", [](PythonScene& s, double volume) { s.scene().setLiquidToCome(volume); },
            py::arg("volume"), comment("Scene::setLiquidToCome"))
        .def(
            "set_liquid_density", [](PythonScene& s, double density) { s.scene().setLiquidDensity(density); },
            py::arg("density"), comment("Scene::setLiquidDensity"))
        .def("liquid", &liquidLedger, comment("LiquidLedger"))
        .def(
            "droplets_of",
            [](const PythonScene& s, std::size_t spray) { return s.scene().sprayHandler.countOf(spray); },
            py::arg("spray"), comment("SprayHandler::countOf"))
        .def(
            "droplets",
            [](const PythonScene& s) {
                std::vector<Vector<double>> places, velocities;
                std::vector<double> radii;
                for (const Droplet& droplet : s.scene().sprayHandler.droplets()) {
                    places.push_back(droplet.position), velocities.push_back(droplet.velocity);
                    radii.push_back(droplet.radius);
                }
                py::dict made;
                made["position_m"] = arrayOf(std::move(places));
                made["velocity_m_per_s"] = arrayOf(std::move(velocities));
                made["radius_m"] = arrayOf(std::move(radii));
                return made;
            },
            "Columns of the droplets in flight.")
        .def(
            "join_at_start", [](PythonScene& s, double gap) { s.scene().joinAtStart(gap); }, py::arg("gap"),
            comment("Scene::joinAtStart"));
}

}  // namespace pendular::python
