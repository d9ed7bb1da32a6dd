#include <fmt/format.h>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Laws/Species/SpeciesInScene.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "Python/ShapedSpecies.h"
#include "Tools/Python/PythonScene.h"

namespace pendular::python {

namespace {

/// A species of a scene of one type, by the names of its fields.
template <class S>
class SpeciesOfOneType final : public AnySpecies {
public:
    explicit SpeciesOfOneType(S* of) : species(of) {}

    [[nodiscard]] std::string_view getName() const override { return S::name; }
    [[nodiscard]] std::vector<NamedField> fields() override {
        return namedFields<typename S::Mixed>(*species);
    }
    [[nodiscard]] std::vector<NamedSetter> derivedSetters() override {
        return namedSetters<typename S::Mixed>(*species);
    }
    [[nodiscard]] int getIndex() const override { return species->getIndex(); }
    [[nodiscard]] const SpeciesOwner* getOwner() const override { return species->getOwner(); }
    [[nodiscard]] const double& densityPlace() const override { return density = species->getDensity(); }
    void setDensity(double density) override { species->setDensity(density); }
    void complete() override {}  // the scene does

private:
    [[nodiscard]] const void* lawOf(const std::type_info& law) const override {
        return lawOfType<typename S::Mixed>(*species, law);
    }
    [[nodiscard]] const void* completeLawOf(const std::type_info& law) const override { return lawOf(law); }

    S* species;
    mutable double density = unset;  // kg/m^3, as it was last asked for
};

/// The values of a pair of them.
template <class S>
class PairOfOneType final : public AnyLaws {
public:
    explicit PairOfOneType(typename S::Mixed* of) : laws(of) {}
    [[nodiscard]] std::string_view getName() const override { return S::name; }
    [[nodiscard]] std::vector<NamedField> fields() override { return namedFields(*laws); }
    [[nodiscard]] std::vector<NamedSetter> derivedSetters() override { return namedSetters(*laws); }

private:
    [[nodiscard]] const void* lawOf(const std::type_info& law) const override {
        return lawOfType(*laws, law);
    }

    typename S::Mixed* laws;
};

template <class S>
class ShapedScene final : public Hosted<SuperquadricSimulation<S>> {
public:
    AnySpecies& addSpecies(std::string_view type) override {
        requireType(type);
        S* const added = this->speciesHandler.copyAndAddObject({});
        return *all.emplace_back(std::make_unique<SpeciesOfOneType<S>>(added));
    }
    AnyLaws& lawsOfPair(const AnySpecies& a, const AnySpecies& b, std::string_view type) override {
        requireType(type);
        auto* const pair = this->speciesHandler.getMixedObject(a.getIndex(), b.getIndex());
        return *pairs.emplace_back(std::make_unique<PairOfOneType<S>>(pair));
    }
    SuperquadricHandler* superquadrics() override { return &this->superquadricHandler; }

private:
    static void requireType(std::string_view type) {
        if (canonicalLawName(type) != S::name)
            throw InputError(fmt::format(
                "This scene has superquadrics, and all of its species are {}; not {}.", S::name, type));
    }

    std::vector<std::unique_ptr<AnySpecies>> all;
    std::vector<std::unique_ptr<AnyLaws>> pairs;
};

}  // namespace

std::vector<std::string_view> shapedSpecies() {
    std::vector<std::string_view> names;
    ShapedSpecies::forEach([&]<class S>() { names.push_back(S::name); });
    return names;
}

/// With the list that the build takes: what it has already, and this one.
[[noreturn]] static void refuseUncompiled(std::string_view type) {
    std::vector<std::string_view> names = shapedSpecies();
    names.push_back(type);
    std::string list;
    for (const std::string_view name : names)
        list.append(list.empty() ? "" : ";").append(name.substr(0, name.size() - speciesSuffix.size()));
    throw InputError(
        fmt::format("{} is a species of Pendular, but superquadrics of it are not compiled into this module; "
                    "build the module with -DPENDULAR_PYTHON_SHAPED_SPECIES=\"{}\" "
                    "(see the page on Python).",
                    type, list));
}

std::shared_ptr<PythonScene> makeShapedScene(std::string_view type) {
    std::shared_ptr<PythonScene> made;
    ShapedSpecies::forEach([&]<class S>() {
        if (canonicalLawName(type) == S::name) made = ofThisProcess(std::make_unique<ShapedScene<S>>());
    });
    if (!made && isSpeciesOfTheKernel(type)) refuseUncompiled(type);
    if (!made) unknownName("species of superquadrics", type, shapedSpecies());
    return made;
}

}  // namespace pendular::python
