#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/KnownValues.h"
#include "Kernel/Laws/Species/SetValues.h"
#include "Kernel/Laws/Species/Species.h"
#include "Kernel/Laws/Species/SpeciesInScene.h"

namespace pendular {

/// InputErrors of the handlers below.
[[noreturn]] void refuseSpeciesWithoutLaws(int number);
[[noreturn]] void refuseSpeciesNumber(std::ptrdiff_t number, std::size_t count);

/// Refuses to go on with discs as spheres, or the other way round.
void visitForm(StateArchive& archive, const SpeciesOwner& species);

/// The species of a scene and the values of each pair of them. The laws of a pair are mixed from its two
/// species by the rule of each field, except for the values that getMixedObject(a, b)->set...() gives to that
/// pair.
template <class S>
class SpeciesHandler : public SpeciesOwner {
public:
    using Mixed = typename S::Mixed;

    SpeciesHandler() = default;
    SpeciesHandler(const SpeciesHandler&) = delete;
    SpeciesHandler& operator=(const SpeciesHandler&) = delete;

    /// Adds a copy; the pointer stays valid, and values may be set through it at any time: during a run, a
    /// new value holds from the next step on, for all contacts and bridges.
    S* copyAndAddObject(const S& species) {
        S& added = all.emplace_back(species);
        added.index.value = static_cast<int>(all.size()) - 1;
        added.index.owner = this;
        return &added;
    }
    /// A copy of what a pointer shows. (A template, so that {} is no pointer.)
    template <std::same_as<S> One>
    S* copyAndAddObject(const One* species) {
        return copyAndAddObject(*species);
    }
    [[nodiscard]] std::size_t getSize() const { return all.size(); }
    [[nodiscard]] bool isEmpty() const { return getSize() == 0; }
    [[nodiscard]] S* getObject(std::size_t index) { return &all.at(checked(index)); }
    [[nodiscard]] const S* getObject(std::size_t index) const { return &all.at(checked(index)); }
    [[nodiscard]] S* getLastObject() { return getObject(all.size() - 1); }

    /// The pair's own values: nothing is set in it but what the driver sets.
    Mixed* getMixedObject(const S* a, const S* b) { return getMixedObject(a->getIndex(), b->getIndex()); }
    Mixed* getMixedObject(int a, int b) {
        checked(static_cast<std::size_t>(a)), checked(static_cast<std::size_t>(b));
        return &own.try_emplace(std::minmax({a, b}), nothingSet<Mixed>()).first->second;
    }

    /// Derives what is unset, checks every species and mixes every pair. Throws InputError; all pairs then
    /// have the values that they had.
    void mixAll() {
        if (all.empty())
            throw InputError("The scene has no species; add one with speciesHandler.copyAndAddObject().");
        std::vector<S> complete(all.begin(), all.end());
        for (std::size_t k = 0; k < complete.size(); ++k) {
            complete[k].index.value = static_cast<int>(k);
            complete[k].deriveUnset();
            complete[k].check();
        }
        std::vector<std::optional<Mixed>> mixed;
        for (const S& a : complete)
            for (const S& b : complete) mixed.push_back(mixtureOf(a, b));
        mixtures = std::move(mixed);
        count = all.size();
        remember();
    }
    /// Whether a value has been set since mixAll().
    [[nodiscard]] bool hasChanges() const {
        return count != all.size() || mixedPairs != own.size() || mixedFrom.haveChanged();
    }
    /// The laws between species a and b, after mixAll(). Throws InputError if one of them was added since.
    [[nodiscard]] const Mixed& mixture(int a, int b) const {
        if (static_cast<std::size_t>(std::max(a, b)) >= count) refuseSpeciesWithoutLaws(std::max(a, b));
        return *mixtures[numberOf(a, b)];
    }
    /// Whether the pair has laws of this type: not all have, where a scene has species of several types.
    [[nodiscard]] bool hasMixture(int a, int b) const { return mixtures[numberOf(a, b)].has_value(); }
    /// Instead of mixAll(), in a scene of several types: it mixes the pairs itself.
    /// @param mixed of species a with all, then of the next; nothing where the pair has other laws
    void setMixtures(std::size_t speciesCount, std::vector<std::optional<Mixed>> mixed) {
        count = speciesCount;
        mixtures = std::move(mixed);
    }

    /// Of each species, and of each pair with values of its own.
    [[nodiscard]] std::vector<SetValues> setValues() {
        std::vector<SetValues> found;
        for (S& species : all)
            found.push_back({species.getIndex(), species.getIndex(), S::name, namedFields<Mixed>(species)});
        for (auto& [pair, laws] : own)
            found.push_back({pair.first, pair.second, S::name, namedFields<Mixed>(laws)});
        return found;
    }

    /// A run goes on with the species that it began with: their fields and the pairs' own values. Where they
    /// have been changed during the run, it goes on with what they were changed to.
    /// @param changedInRun as the scene knows it; read from a file, as the file does
    void visitState(StateArchive& archive, bool& changedInRun) {
        archive.same("name", S::name);
        visitForm(archive, *this);
        archive.same("count", all.size());
        archive.value("changedInRun", changedInRun);
        for (S& species : all)
            archive.group(fmt::format("{}", species.getIndex()), [&] {
                if (changedInRun) archive.value("density", species.density);
                else archive.same("density", species.getDensity(), "kg/m^3");
                visitFields(archive, species, changedInRun);
            });
        archive.same("countOfPairsWithOwnValues", own.size());
        for (auto& [pair, laws] : own)
            archive.group(fmt::format("{}-{}", pair.first, pair.second),
                          [&, &values = laws] { visitFields(archive, values, changedInRun); });
    }

private:
    /// Takes note of what the pairs were mixed from.
    void remember() {
        mixedFrom.clear();
        const auto add = [&](const Mixed& laws) {
            laws.forEachLaw([&]<class Law>(const Law& law) {
                for (const auto& field : Law::fields()) mixedFrom.add(law.*field.member);
            });
        };
        for (const S& species : all) {
            mixedFrom.add(species.density);
            add(species);
        }
        for (const auto& [pair, laws] : own) add(laws);
        mixedPairs = own.size();
    }
    static void visitFields(StateArchive& archive, Mixed& laws, bool changedInRun) {
        laws.forEachLaw([&]<class Law>(Law& law) {
            for (const auto& field : Law::fields())
                archive.group(Law::name, [&] {
                    if (changedInRun) archive.value(field.name, law.*field.member);
                    else archive.same(field.name, law.*field.member, field.unit);
                });
        });
    }
    std::size_t checked(std::size_t index) const {
        if (index >= all.size()) refuseSpeciesNumber(static_cast<std::ptrdiff_t>(index), all.size());
        return index;
    }
    [[nodiscard]] std::size_t numberOf(int a, int b) const {
        return static_cast<std::size_t>(a) * count + static_cast<std::size_t>(b);
    }
    static std::size_t indexOf(const S& species) { return static_cast<std::size_t>(species.getIndex()); }
    /// Derives what no user has set, neither for the pair nor for its species, and a law takes from the
    /// normal law: from the normal law of the pair.
    template <class Law>
    static void deriveFromPair(Law& pair, const Law& a, const Law& b, const typename S::Normal& normal) {
        Law derived = pair;
        if constexpr (requires { derived.deriveUnset(normal); }) derived.deriveUnset(normal);
        for (const auto& field : Law::fields())
            if (!isSet(a.*field.member) && !isSet(b.*field.member))
                pair.*field.member = derived.*field.member;
    }
    Mixed mixtureOf(const S& a, const S& b) const {
        const auto found = own.find(std::minmax({a.getIndex(), b.getIndex()}));
        Mixed result = found == own.end() ? (a.getIndex() == b.getIndex() ? static_cast<const Mixed&>(a)
                                                                          : nothingSet<Mixed>())
                                          : found->second;
        using N = typename S::Normal;
        using F = typename S::Friction;
        using A = typename S::Adhesion;
        static_cast<N&>(result) = mixLaws<N>(result, a, b);
        if (found != own.end()) deriveFromPair<F>(result, all[indexOf(a)], all[indexOf(b)], result);
        static_cast<F&>(result) = mixLaws<F>(result, a, b);
        // An adhesion law takes what no user has set from the normal law of the pair.
        static_cast<A&>(result) = mixLaws<A>(result, all[indexOf(a)], all[indexOf(b)]);
        if constexpr (requires { result.A::deriveUnset(static_cast<const N&>(result)); })
            result.A::deriveUnset(static_cast<const N&>(result));
        result.check();
        return result;
    }

    std::deque<S> all;
    std::map<std::pair<int, int>, Mixed> own;
    std::size_t count = 0;  // of the species that were mixed
    std::vector<std::optional<Mixed>> mixtures;
    KnownValues mixedFrom;
    std::size_t mixedPairs = 0;  // with own values
};

}  // namespace pendular
