// Films, bridges at the start, sprays, evaporation.
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// On some of the grains of the set-up.
void addFilms(Making& making) {
    const double share = making.draw.even(0.2, 1);
    std::vector<double> volumes;
    for (int k = 0; k < 60; ++k)
        volumes.push_back(making.draw.chance(share)
                              ? making.draw.give("volume", making.scales.liquid() * making.draw.even(0, 1))
                              : 0);
    making.atEnd([&scene = making.scene, volumes] {
        std::size_t k = 0;
        for (GrainReference grain : scene.particleHandler)
            if (const double volume = volumes[k++ % volumes.size()]; volume != 0)
                grain.setLiquidVolume(volume);
    });
}

void addFilmInRun(Making& making) {
    for (int k = making.draw.whole(1, 3); k > 0; --k) {
        const double volume = making.draw.give("volume", making.scales.liquid() * making.draw.even(0, 1)),
                     which = making.draw.even(0, 1);
        making.before(making.someStep(), [&making, volume, which] {
            if (auto grain = making.someGrain(which)) grain->setLiquidVolume(volume);
        });
    }
}

void addLiquidDensity(Making& making) {
    making.scene.setLiquidDensity(making.draw.give("density", 0.4 * making.scales.density));
}

void addLiquidToCome(Making& making) {
    making.scene.setLiquidToCome(making.draw.give("volume", 1000 * making.scales.liquid()));
}

/// A film on a grain dries in about the time of the run.
void addEvaporation(Making& making) {
    Evaporation drying;
    const double flux =
        making.draw.decades(0.01, 1) * std::cbrt(making.scales.liquid()) / making.scales.duration;
    if (making.draw.oneIn(2)) drying.setFlux(making.draw.give("flux", flux));
    else
        drying.setMassTransfer(making.draw.give("coefficient", flux), making.draw.give("vapour", 600.0),
                               making.draw.give("liquid", 1000.0), making.draw.give("humidity", 0.4));
    if (making.draw.oneIn(4))
        drying.setDiffusion(making.draw.give("diffusivity", flux * making.scales.radius),
                            making.draw.give("vapour", 10.0), making.draw.give("liquid", 1000.0));
    if (making.draw.oneIn(8))
        drying.setKelvin(making.draw.give("molar volume", 1.8e-5), making.draw.give("temperature", 300.0));
    drying.setInterval(static_cast<std::size_t>(making.draw.whole(1, 30)));
    if (making.draw.oneIn(4)) drying.setStartTime(making.draw.give("start", 0.3 * making.scales.duration));
    making.scene.setEvaporation(drying);
}

/// About twenty droplets from above the grains.
void addSpray(Making& making) {
    Spray spray;
    Vec3D from = 0.5 * (making.lowest + making.highest);
    from.z() = making.top + making.scales.cell;
    const Vec3D width = making.highest - making.lowest, down(0, 0, -1);
    switch (making.draw.whole(0, 2)) {
        case 0:
            spray.setRain(making.draw.give("middle", from), {0.9 * width.x(), 0, 0}, {0, 0.9 * width.y(), 0},
                          making.draw.give("direction", down));
            break;
        case 1:
            spray.setCone(making.draw.give("nozzle", from), down, making.draw.give("angle", 0.8));
            break;
        default:
            spray.setFlatFan(making.draw.give("nozzle", from), down, {1, 0, 0},
                             making.draw.give("angle", 1.0));
    }
    spray.setDropletRadius(making.draw.give("radius", making.draw.even(0.05, 0.15) * making.scales.radius));
    const double volume = 4.2 * std::pow(0.1 * making.scales.radius, 3.0);
    spray.setFlow(making.draw.give("flow", 20 * volume / making.scales.duration));
    const double needed = from.z() - making.lowest.z();
    spray.setSpeed(making.draw.give("speed", making.draw.even(0.5, 3) * needed / making.scales.duration));
    if (making.draw.oneIn(2)) spray.setVolumeSpread(making.draw.give("spread", making.draw.even(0, 0.5)));
    if (making.draw.oneIn(2)) spray.setMomentum(making.draw.give("density", 1000.0));
    if (making.draw.oneIn(3))
        spray.setLongestFlight(making.draw.give("longest", 0.5 * making.scales.duration));
    if (making.draw.oneIn(3))
        spray.setTimes(making.draw.give("first", 0.1 * making.scales.duration),
                       making.draw.give("last", 0.6 * making.scales.duration));
    spray.setSeed(static_cast<std::uint64_t>(making.draw.whole(0, 1000)));
    making.scene.sprayHandler.copyAndAddObject(spray);
}

void addJoinAtStart(Making& making) {
    making.scene.joinAtStart(making.draw.give("gap", making.draw.even(0, 0.3) * making.scales.radius));
}

}  // namespace

std::vector<Feature> liquidFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    const std::vector<std::string_view> moving{"moving liquid"};
    return {
        {.name = "Films", .share = 0.8, .add = addFilms, .needs = moving},
        {.name = "FilmInRun", .share = 0.2, .add = addFilmInRun, .kinds = {"change"}, .needs = moving},
        // Grains keep their velocities where their films change.
        {.name = "LiquidDensity", .share = 0.3, .add = addLiquidDensity, .loses = both, .needs = moving},
        {.name = "LiquidToCome", .share = 0.1, .add = addLiquidToCome, .needs = moving},
        {.name = "Evaporation", .share = 0.35, .add = addEvaporation, .needs = moving},
        {.name = "Spray",
         .share = 0.35,
         .add = addSpray,
         .loses = both,
         .kinds = {"spray", "room"},
         .needs = moving},
        {.name = "JoinAtStart",
         .share = 0.3,
         .add = addJoinAtStart,
         .excludes = {"moving liquid"},
         .needs = {"bridges"}},
    };
}

}  // namespace pendular::fuzz
