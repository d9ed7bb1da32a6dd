#include "Kernel/Features/LiquidTransport/Evaporation.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfEvaporation = "Evaporation";
constexpr double gasConstant = 8.31446261815324;  // J/(mol K), exact in the SI since 2019

void require(std::string_view field, double value, std::string_view unit, const Range& range) {
    checkValue(ownerOfEvaporation, field, value, unit, range);
}

}  // namespace

void Evaporation::setFlux(double value) {
    require("flux", value, "m/s", notNegative);
    fastest = value;
    humidity = 0;
}

void Evaporation::setMassTransfer(double coefficient, double saturatedVapour, double liquidDensity,
                                  double relativeHumidity) {
    require("mass transfer coefficient", coefficient, "m/s", notNegative);
    require("density of saturated vapour", saturatedVapour, "kg/m^3", notNegative);
    require("density of the liquid", liquidDensity, "kg/m^3", positive);
    require("relative humidity", relativeHumidity, "", fromZeroTo(1));
    require("flux", coefficient * saturatedVapour / liquidDensity, "m/s", notNegative);
    fastest = coefficient * saturatedVapour / liquidDensity;
    humidity = relativeHumidity;
}

void Evaporation::setDiffusion(double diffusivity, double vapourDifference, double liquidDensity) {
    require("diffusivity", diffusivity, "m^2/s", notNegative);
    require("difference of vapour density", vapourDifference, "kg/m^3", notNegative);
    require("density of the liquid", liquidDensity, "kg/m^3", positive);
    require("fall of the squared radius of a droplet", 2 * diffusivity * vapourDifference / liquidDensity,
            "m^2/s", notNegative);
    drop = 2 * diffusivity * vapourDifference / liquidDensity;
}

void Evaporation::setKelvin(double molarVolume, double temperature) {
    require("molar volume", molarVolume, "m^3/mol", positive);
    require("temperature", temperature, "K", positive);
    require("molar volume over R_g T", molarVolume / (gasConstant * temperature), "1/Pa", positive);
    kelvin = molarVolume / (gasConstant * temperature);
}

void Evaporation::setInterval(std::size_t count) {
    require("interval", static_cast<double>(count), "steps", {1, 1e9});
    steps = count;
}

void Evaporation::setStartTime(double time) {
    require("start time", time, "s", anyFinite);
    start = time;
}

void Evaporation::visitState(StateArchive& archive) const {
    archive.same("fastest", fastest, "m/s");
    archive.same("humidity", humidity);
    archive.same("drop", drop, "m^2/s");
    archive.same("kelvin", kelvin, "1/Pa");
    archive.same("start", start, "s");
    archive.same("interval", steps, "steps");
}

}  // namespace pendular
