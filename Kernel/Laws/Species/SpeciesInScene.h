#pragma once

#include <utility>

#include "Kernel/Laws/Species/AnySpecies.h"
#include "Kernel/Laws/Species/Species.h"

namespace pendular {

template <class Mixed>
std::vector<NamedField> namedFields(Mixed& laws) {
    std::vector<NamedField> found;
    laws.forEachLaw([&]<class Law>(Law& law) {
        for (const auto& field : Law::fields())
            found.push_back({Law::name, field.name, field.unit, field.range, &(law.*field.member)});
    });
    return found;
}
template <class Mixed>
const void* lawOfType(const Mixed& laws, const std::type_info& type) {
    const void* found = nullptr;
    laws.forEachLaw([&]<class Law>(const Law& law) {
        if (typeid(Law) == type) found = &law;
    });
    return found;
}

/// A species of type S in a scene of several types. The index counts the species of all types.
template <class S>
class SpeciesInScene final : public AnySpecies {
public:
    SpeciesInScene(const S& from, int index, const SpeciesOwner* owner) : species(from) {
        species.index.value = index;
        species.index.owner = owner;
    }

    S species;  // as the driver sets it

    [[nodiscard]] std::string_view getName() const override { return S::name; }
    [[nodiscard]] std::vector<NamedField> fields() override { return namedFields<MixedOf>(species); }
    [[nodiscard]] std::vector<NamedSetter> derivedSetters() override {
        return namedSetters<MixedOf>(species);
    }
    [[nodiscard]] int getIndex() const override { return species.getIndex(); }
    [[nodiscard]] const SpeciesOwner* getOwner() const override { return species.getOwner(); }
    [[nodiscard]] const double& densityPlace() const override { return species.density; }
    void setDensity(double density) override { species.setDensity(density); }
    void complete() override {
        completed = species;
        completed.deriveUnset();
        completed.check();
    }

private:
    using MixedOf = typename S::Mixed;

    [[nodiscard]] const void* lawOf(const std::type_info& law) const override {
        return lawOfType<MixedOf>(species, law);
    }
    [[nodiscard]] const void* completeLawOf(const std::type_info& law) const override {
        return lawOfType<MixedOf>(completed, law);
    }

    S completed;
};

/// What a driver sets for one pair of species whose contacts have the laws of type S: nothing at first.
template <class S>
class OwnLawsOfPair final : public AnyLaws {
public:
    typename S::Mixed laws = nothingSet<typename S::Mixed>();

    [[nodiscard]] std::string_view getName() const override { return S::name; }
    [[nodiscard]] std::vector<NamedField> fields() override { return namedFields(laws); }
    [[nodiscard]] std::vector<NamedSetter> derivedSetters() override { return namedSetters(laws); }

private:
    [[nodiscard]] const void* lawOf(const std::type_info& law) const override { return lawOfType(laws, law); }
};

/// A law of a pair: what `own` sets; in all other fields the mixture of the two species, or the value of the
/// one that has this law; and a law that neither has as it is where nothing is set.
template <class Law>
Law mixFound(const Law& own, const Law* a, const Law* b) {
    const Law standard{};
    const Law& first = a ? *a : b ? *b : standard;
    const Law& second = b ? *b : first;
    return mixLaws<Law>(own, first, second);
}

/// The laws of type P between two species of any types, as SpeciesHandler mixes those of two species of its
/// type: a law is taken for the same if it has the same type. The result is the same for b and a.
/// @param isOwn derives what no user has set, neither for the pair nor for its species, from the normal law
/// of the pair instead of from those of the species
template <class P>
typename P::Mixed mixTypes(const typename P::Mixed& own, bool isOwn, const AnySpecies& a,
                           const AnySpecies& b) {
    using N = typename P::Normal;
    using F = typename P::Friction;
    using A = typename P::Adhesion;
    typename P::Mixed result = own;
    N& normal = result;
    normal = mixFound<N>(normal, a.findComplete<N>(), b.findComplete<N>());

    F& friction = result;
    if (isOwn) {
        F derived = friction;
        if constexpr (requires { derived.deriveUnset(std::as_const(normal)); })
            derived.deriveUnset(std::as_const(normal));
        const auto isSetBy = [](const AnySpecies& species, double F::*field) {
            const F* const law = species.find<F>();
            return law && isSet(law->*field);
        };
        for (const auto& field : F::fields())
            if (!isSetBy(a, field.member) && !isSetBy(b, field.member))
                friction.*field.member = derived.*field.member;
    }
    friction = mixFound<F>(friction, a.findComplete<F>(), b.findComplete<F>());

    A& adhesion = result;
    adhesion = mixFound<A>(adhesion, a.find<A>(), b.find<A>());
    if constexpr (requires { adhesion.deriveUnset(std::as_const(normal)); })
        adhesion.deriveUnset(std::as_const(normal));
    result.check();
    return result;
}

}  // namespace pendular
