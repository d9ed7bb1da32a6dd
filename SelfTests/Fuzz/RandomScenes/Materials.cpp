// Species: one feature for each type that is compiled into the kernel, and for other laws of dry adhesion.
#include <numbers>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// A value for a field of a law; none: it is left unset.
std::optional<double> valueOf(const NamedField& field, const Scales& scales, Draws& draw) {
    const std::string_view name = field.name;
    const double stiffness = 0.3 * scales.modulus * scales.radius;  // N/m
    const auto often = [&](double value) { return draw.oneIn(4) ? 0 : value; };
    if (name == "effectiveElasticModulus") return scales.modulus * draw.decades(0.5, 1);
    if (name == "effectiveShearModulus") return scales.modulus * draw.even(0.2, 1);
    if (name == "stiffness") return stiffness * draw.decades(0.5, 1);
    if (name == "dissipation" && field.unit.empty()) return often(draw.even(0.05, 1.5));
    if (name == "dissipation") return often(draw.even(0, 0.5)) * std::sqrt(stiffness * scales.mass());
    if (name == "slidingStiffness") return 0.28 * stiffness * draw.even(0.5, 1);
    if (name == "slidingDissipation" && field.unit.empty()) {
        if (draw.oneIn(2)) return std::nullopt;
        return often(draw.even(0.1, 1));
    }
    if (name.ends_with("lidingDissipation") || name.ends_with("ollingDissipation") ||
        name.ends_with("orsionDissipation"))
        return often(draw.even(0, 0.2)) * std::sqrt(stiffness * scales.mass());
    if (name.ends_with("FrictionCoefficient")) return often(draw.even(0.05, 1));
    if (name == "staticFrictionRatio") return draw.even(1, 1.5);
    if (name == "springFactor") return draw.even(0.4, 1);
    if (name == "rollingStiffness" || name == "torsionStiffness") return 0.1 * stiffness;
    if (name == "liquidBridgeVolume" || name == "liquidBridgeVolumeMax")
        return scales.liquid() * draw.decades(0.1, 1);
    if (name == "liquidBridgeVolumeMin") return often(0.02 * scales.liquid());
    if (name == "wallLiquidVolume") return often(0.3 * scales.liquid());
    if (name == "contactAngle") return often(draw.even(0, 0.6));
    // 2 pi R gamma is at most a tenth of the force of a touch.
    if (name == "surfaceTension")
        return scales.force() * draw.decades(0.003, 0.1) / (2 * std::numbers::pi * scales.radius);
    if (name == "distributionCoefficient") return draw.even(0, 1);
    if (name == "shareByRoom" || name == "shareWithDryContacts" || name == "dynamicRupture" ||
        name == "viscousInContact" || name == "viscousVolumeCorrection" || name == "pinned" ||
        name == "formsAtFilmContact")
        return draw.whole(0, 1);
    if (name == "viscousScheme" || name == "tangentialLubrication") return draw.whole(0, 2);
    if (name == "roughness") return 1e-3 * scales.radius * draw.decades(0.5, 10);
    // 6 pi eta R^2 v / h at a gap h of a hundredth of the radius.
    if (name == "viscosity")
        return scales.force() * draw.decades(1e-4, 1e-2) /
               (6 * std::numbers::pi * scales.radius * scales.speed);
    if (name == "surfaceDistance") return 1e-3 * scales.radius * draw.decades(0.5, 5);
    if (name == "adhesionForceMax") return scales.force() * draw.decades(0.003, 0.1);
    if (name == "adhesionStiffness") return 0.1 * stiffness * draw.decades(0.5, 1);
    if (name == "workOfAdhesion") return often(scales.force() * draw.decades(0.001, 0.05) / scales.radius);
    return std::nullopt;
}

void fill(AnySpecies& species, Making& making) {
    species.setDensity(making.draw.give("density", making.scales.density * making.draw.decades(0.5, 1)));
    for (const NamedField& field : species.fields())
        if (const auto value = valueOf(field, making.scales, making.draw))
            species.set(field.name, making.draw.give(field.name, *value));
}

/// One or two species of a type; with those of other types they have the laws of one of the two.
void addMaterials(Making& making, const std::string& type) {
    for (int count = making.draw.oneIn(3) ? 2 : 1; count > 0; --count) {
        AnySpecies* const added = making.species.add(type);
        fill(*added, making);
        for (std::size_t k = 0; k < making.materials.size(); ++k) {
            const bool asOther = making.draw.oneIn(2);
            const std::string& other = making.typeOfMaterial[k];
            if (other == type) continue;
            making.species.setPairType(making.materials[k]->getIndex(), added->getIndex(),
                                       asOther ? other : type);
        }
        making.materials.push_back(added);
        making.typeOfMaterial.push_back(type);
    }
}

std::vector<std::string_view> kindsOf(std::string_view type) {
    std::vector<std::string_view> kinds{"material"};
    const auto has = [&](std::string_view part) { return type.find(part) != type.npos; };
    if (has("Mindlin") || has("Friction")) kinds.push_back("friction");
    if (has("LiquidMigration")) kinds.push_back("moving liquid");
    if (has("LiquidBridge")) kinds.push_back("bridges");
    if (has("ViscousLiquid")) kinds.push_back("viscous bridges");
    if (has("JKR")) kinds.push_back("JKR");
    if (!has("Liquid")) kinds.push_back("dry");
    return kinds;
}

/// The types of the kernel, and some that are made known here.
std::vector<std::string_view> allTypes() {
    static const RegisteredSpecies<HertzianViscoelasticDMTSpecies> one;
    static const RegisteredSpecies<HertzianViscoelasticReversibleAdhesiveSpecies> two;
    static const RegisteredSpecies<HertzianViscoelasticIrreversibleAdhesiveSpecies> three;
    std::vector<std::string_view> types = instantiatedSpecies();
    for (const std::string_view type : registeredSpecies()) types.push_back(type);
    return types;
}

}  // namespace

std::vector<Feature> materialFeatures() {
    std::vector<Feature> table;
    for (const std::string_view type : allTypes()) {
        std::string name(type.substr(0, type.size() - std::string_view("Species").size()));
        table.push_back({.name = std::move(name),
                         .share = 0,  // a scene gets one, two or three of them
                         .add = [type = std::string(type)](Making& making) { addMaterials(making, type); },
                         .kinds = kindsOf(type)});
    }
    return table;
}

}  // namespace pendular::fuzz
