#include "SelfTests/Fuzz/RandomScenes/RandomScene.h"

#include <algorithm>
#include <deque>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/SpeciesInScene.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

namespace pendular::fuzz {

namespace {

/// Species of any types.
class SceneOfAny final : public Hooked<Simulation<>>, public SpeciesOfScene {
public:
    SpeciesOfScene& species() override { return *this; }
    AnySpecies* add(std::string_view type) override { return speciesHandler.addByName(type); }
    void setPairType(int a, int b, std::string_view type) override {
        speciesHandler.setPairTypeByName(a, b, type);
    }
};

/// A species of a Simulation<S>, by the names of its fields.
template <class S>
class SpeciesByName final : public AnySpecies {
public:
    explicit SpeciesByName(S& of) : own(of) {}
    [[nodiscard]] std::string_view getName() const override { return S::name; }
    [[nodiscard]] std::vector<NamedField> fields() override { return namedFields<typename S::Mixed>(own); }
    [[nodiscard]] int getIndex() const override { return own.getIndex(); }
    [[nodiscard]] const SpeciesOwner* getOwner() const override { return own.getOwner(); }
    [[nodiscard]] const double& densityPlace() const override { return density; }
    void setDensity(double value) override { own.setDensity(value), density = value; }
    void complete() override {}

private:
    [[nodiscard]] const void* lawOf(const std::type_info& law) const override {
        return lawOfType<typename S::Mixed>(own, law);
    }
    [[nodiscard]] const void* completeLawOf(const std::type_info& law) const override { return lawOf(law); }

    S& own;
    double density = unset;  // kg/m^3
};

template <class S, class Base = Simulation<S>>
class SceneOfOne : public Hooked<Base>, public SpeciesOfScene {
public:
    SpeciesOfScene& species() override { return *this; }
    AnySpecies* add(std::string_view) override {
        return &named.emplace_back(*this->speciesHandler.copyAndAddObject({}));
    }
    void setPairType(int, int, std::string_view) override {
        throw std::logic_error("A Simulation<S> has one type.");
    }

private:
    std::deque<SpeciesByName<S>> named;
};

template <class S>
class SceneOfShapes final : public SceneOfOne<S, SuperquadricSimulation<S>> {
public:
    SuperquadricHandler* shapes() override { return &this->superquadricHandler; }
};

/// Those of scenes with superquadrics or blocks, which have one type each.
using TypesOfShapes = TypeList<HertzianViscoelasticMindlinSpecies, HertzianViscoelasticMindlinJKRSpecies,
                               HertzianViscoelasticDMTSpecies, HertzianViscoelasticReversibleAdhesiveSpecies,
                               HertzianViscoelasticIrreversibleAdhesiveSpecies,
                               HertzianViscoelasticMindlinLiquidBridgeWillettSpecies>;

std::unique_ptr<RandomScene> sceneOfShapes(std::string_view type) {
    std::unique_ptr<RandomScene> made;
    TypesOfShapes::forEach([&]<class S>() {
        if (type == S::name) made = std::make_unique<SceneOfShapes<S>>();
    });
    if (!made) made = std::make_unique<SceneOfShapes<HertzianViscoelasticMindlinSpecies>>();
    return made;
}

/// Those of which most of the others are made: dry and wet, with a spin and without, liquid at rest and in
/// motion.
using OneTypes =
    TypeList<LinearViscoelasticSpecies, HertzianViscoelasticSpecies, HertzianViscoelasticMindlinSpecies,
             HertzianViscoelasticMindlinJKRSpecies, HertzianViscoelasticLiquidBridgeWillettSpecies,
             HertzianViscoelasticMindlinViscousLiquidBridgeWillettSpecies,
             LinearViscoelasticSlidingFrictionLiquidMigrationWillettSpecies,
             HertzianViscoelasticMindlinViscousLiquidMigrationLSSpecies>;

}  // namespace

std::unique_ptr<RandomScene> sceneOf(const Recipe& recipe) {
    std::vector<std::string> types;
    for (const std::string& name : recipe.features)
        if (featureNamed(name).is("material")) types.push_back(name + "Species");
    std::unique_ptr<RandomScene> made;
    if (std::ranges::any_of(recipe.features,
                            [](const std::string& name) { return featureNamed(name).is("shape"); }))
        return sceneOfShapes(types.empty() ? std::string() : types[0]);
    if (types.size() == 1 && Scales(recipe).isOneType)
        OneTypes::forEach([&]<class S>() {
            if (types[0] == S::name) made = std::make_unique<SceneOfOne<S>>();
        });
    if (!made) made = std::make_unique<SceneOfAny>();
    return made;
}

}  // namespace pendular::fuzz
