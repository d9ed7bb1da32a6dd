#include "Kernel/Scene/LikelySlips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Walls/RepeatedWall.h"
#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"

namespace pendular {

namespace {

using Sentences = std::vector<std::string>;

/// m: grains of scenes with units are smaller, those of scenes without them have radii of some 1.
constexpr double largestWithUnits = 0.03;

bool hasUnits(const SizeRange& sizes) { return !sizes.empty() && sizes.largest < largestWithUnits; }

/// Solids have 1 to 12 g/cm^3 (lead 11.3), few more; the lightest grains, foamed polystyrene, 15 kg/m^3, and
/// the lightest solid 0.16 kg/m^3 (aerographite, Mecklenburg et al., Adv. Mater. 24 (2012) 3486).
void lookAtDensity(const ContactLaws& laws, std::size_t species, double radius, Sentences& found) {
    constexpr double lightest = 0.16, leastInGrams = 0.5, mostInGrams = 12;
    const double density = laws.density(species);
    if (laws.grainsAreDiscs() || !(density > 0) || density > mostInGrams) return;
    const std::string grains = fmt::format(
        "species {}: density = {:.4g} kg/m^3, of grains with a radius of "
        "{:.3g} m: ",
        species, density, radius);
    if (density >= leastInGrams) found.push_back(grains + "if that is in g/cm^3, 1 g/cm^3 is 1000 kg/m^3");
    else if (density < lightest)
        found.push_back(grains + "no solid is as light; 1 g/mm^3 is 1e6 kg/m^3, and 1 t/mm^3 is 1e12 kg/m^3");
}

/// The softest grains that are used, beads of hydrogel, have some 1e4 Pa; softened ones have more.
void lookAtModuli(const ContactLaws& laws, int species, Sentences& found) {
    constexpr double softest = 5000;  // Pa
    for (const FieldValue& field : laws.fields(species, species)) {
        const bool isEffective = field.name == "effectiveElasticModulus",
                   isOfNormalLaw = isEffective || field.name == "loadingModulus";
        if (!isOfNormalLaw || !(field.value > 0 && field.value < softest)) continue;
        const char* const meaning = isEffective ? ", of Young's modulus E/(2 (1 - nu^2))," : "";
        found.push_back(fmt::format(
            "species {}: {} = {:.4g} Pa{} is softer than any grains are: they will sink into each other and "
            "through walls; if the modulus is in GPa or MPa, 1 GPa is 1e9 Pa",
            species, field.name, field.value, meaning));
    }
}

/// The largest surface tension of a liquid is that of molten tungsten, 2.5 N/m; the work of adhesion of two
/// surfaces of diamond some 20 J/m^2.
void lookAtSurface(const ContactLaws& laws, int species, Sentences& found) {
    struct Most {
        std::string_view name, unit;
        double most;
        std::string_view hint;
    };
    constexpr Most surfaces[] = {
        {"surfaceTension", "N/m", 3, "no liquid has as much; 1 mN/m is 0.001 N/m, and water has 0.072 N/m"},
        {"workOfAdhesion", "J/m^2", 20, "no solids have as much; 1 mJ/m^2 is 0.001 J/m^2"}};
    for (const FieldValue& field : laws.fields(species, species))
        for (const Most& surface : surfaces)
            if (field.name == surface.name && field.value > surface.most)
                found.push_back(fmt::format("species {}: {} = {:.4g} {}: {}", species, field.name,
                                            field.value, surface.unit, surface.hint));
}

/// The volume (m^3) of the bridges of a pair of species; empty where it follows from films.
std::optional<double> bridgeVolumeOf(const ContactLaws& laws, int a, int b) {
    std::optional<double> volume;
    for (const FieldValue& field : laws.fields(a, b)) {
        if (field.name == "filmThickness") return {};
        if (field.name == "liquidBridgeVolume" || field.name == "liquidBridgeVolumeMax") volume = field.value;
    }
    return volume;
}

void lookAtBridges(const ContactLaws& laws, const GrainSizes& sizes, const WallHandler& walls,
                   Sentences& found) {
    if (!laws.formsAtContact && !laws.actsApart) return;
    double largest = 0, volume = 0, radius = 0;
    forEachExtremePair(
        laws, sizes, walls,
        [&](const PairLaws& pair, const Bodies& bodies, double) {
            const double v = bridgeVolumeOf(pair.laws, pair.a, pair.b).value_or(0),
                         r = 2 * bodies.effectiveRadius();
            if (v > largest * r * r * r) largest = v / (r * r * r), volume = v, radius = r;
        },
        Pairs::OfGrains);
    if (largest > mostLikelyBridgeVolume)
        found.push_back(
            fmt::format("bridges: liquidBridgeVolume = {:.4g} m^3 is V* = V/R^3 = {:.4g} between two bodies "
                        "(R = {:.3g} m), "
                        "where both grains together have 8.4 R^3: above V* = {:g} it is no bridge between "
                        "grains; 1 mm^3 (1 ul) "
                        "is 1e-9 m^3",
                        volume, largest, radius, mostLikelyBridgeVolume));
}

double longest(const Vector<double>& lengths) { return std::max({lengths.x, lengths.y, lengths.z}); }

/// A mesh in mm that is read as one in m is 1000 times as large; its grains then are in a small part of it.
/// (Where no grains are there yet, only a mesh that no scene could fill is told of.)
void lookAtMesh(std::size_t number, double length, const GrainSizes& sizes, double largest, double smallest,
                Sentences& found) {
    constexpr double mostDiameters = 1000, mostWithoutGrains = 5000, leastPartOfIt = 0.002;
    const double ofGrains = longest(sizes.highest - sizes.lowest), diameter = 2 * largest;
    const bool areThere = ofGrains >= 0;
    const bool isLarge = areThere ? length > mostDiameters * diameter && ofGrains < leastPartOfIt * length
                                  : length > mostWithoutGrains * diameter;
    if (isLarge)
        found.push_back(
            fmt::format("wall {}, a mesh: it is {:.4g} m long, {:.3g} times the diameter of the largest "
                        "grain ({:.3g} m): "
                        "if its file is in mm, read it with a scale of 0.001",
                        number, length, length / diameter, diameter));
    else if (length > 0 && length < 0.1 * smallest)
        found.push_back(
            fmt::format("wall {}, a mesh: it is {:.4g} m long, {:.3g} of the radius of the smallest grain "
                        "({:.3g} m): look "
                        "at the unit of its file, and at the scale with which it is read",
                        number, length, length / smallest, smallest));
}

void lookAtMeshes(const GrainSizes& sizes, const WallHandler& walls, Sentences& found) {
    double largest = 0, smallest = infinity;  // m, radii
    for (const SizeRange& ofSpecies : sizes.all)
        if (!ofSpecies.empty()) {
            largest = std::max(largest, ofSpecies.largest);
            smallest = std::min(smallest, ofSpecies.smallest);
        }
    if (!(largest > 0)) return;
    for (const PresentWall& wall : walls.present())
        if (const auto* const mesh = dynamic_cast<const RepeatedWall*>(wall.object.get());
            mesh && mesh->canBeRepeated())  // meshes and membranes alone
            lookAtMesh(wall.number, 2 * longest(mesh->surroundings().half), sizes, largest, smallest, found);
}

}  // namespace

std::vector<std::string> likelySlips(const ContactLaws& laws, const GrainSizes& sizes,
                                     const WallHandler& walls) {
    Sentences found;
    const auto count = static_cast<int>(sizes.all.size());
    for (int a = 0; a < count; ++a) {
        const SizeRange& ofSpecies = sizes.all[static_cast<std::size_t>(a)];
        if (!hasUnits(ofSpecies)) continue;
        lookAtDensity(laws, static_cast<std::size_t>(a), ofSpecies.largest, found);
        lookAtModuli(laws, a, found);
        lookAtSurface(laws, a, found);
    }
    lookAtBridges(laws, sizes, walls, found);
    lookAtMeshes(sizes, walls, found);
    return found;
}

}  // namespace pendular
