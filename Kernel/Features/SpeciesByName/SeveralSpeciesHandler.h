#pragma once

#include <concepts>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/SpeciesLaws.h"
#include "Kernel/Laws/Species/SetValues.h"
#include "Kernel/Laws/Species/SpeciesInScene.h"

namespace pendular {

/// The laws of one type in a scene of several types: their values for the pairs of species that have them.
class LawsOfType {
public:
    virtual ~LawsOfType() = default;

    [[nodiscard]] virtual ContactLaws& laws() = 0;
    [[nodiscard]] virtual std::unique_ptr<AnyLaws> nothingSetForPair() const = 0;
    /// Called before the pairs are mixed, with the number of species of the scene.
    virtual void begin(std::size_t speciesCount) = 0;
    /// Mixes the laws of a pair. Throws InputError.
    /// @param own null: the driver sets none
    virtual void mix(const AnySpecies& a, const AnySpecies& b, const AnyLaws* own, bool isOwn) = 0;
    /// All pairs have been mixed: from now on they have these values, and until now those of before.
    virtual void finish() = 0;
};

template <class S>
class LawsOf final : public LawsOfType {
public:
    [[nodiscard]] ContactLaws& laws() override { return ownLaws; }
    [[nodiscard]] std::unique_ptr<AnyLaws> nothingSetForPair() const override {
        return std::make_unique<OwnLawsOfPair<S>>();
    }
    void begin(std::size_t speciesCount) override {
        count = speciesCount;
        mixed.assign(count * count, {});
    }
    void mix(const AnySpecies& a, const AnySpecies& b, const AnyLaws* own, bool isOwn) override {
        const auto& set =
            own ? static_cast<const OwnLawsOfPair<S>*>(own)->laws : nothingSet<typename S::Mixed>();
        const auto first = static_cast<std::size_t>(a.getIndex()),
                   second = static_cast<std::size_t>(b.getIndex());
        mixed[first * count + second] = mixed[second * count + first] = mixTypes<S>(set, isOwn, a, b);
    }
    void finish() override { mixtures.setMixtures(count, std::move(mixed)); }

private:
    std::size_t count = 0;  // of species
    std::vector<std::optional<typename S::Mixed>> mixed;
    SpeciesHandler<S> mixtures;
    SpeciesLaws<S> ownLaws{mixtures};
};

/// The species of a scene that has species of several types, or of types that are chosen by name at run time.
/// Indices count all of them, in the order of adding. The contacts of two species of one type have its laws;
/// for two of different types the driver says which: setPairType<Type>(a, b). A law of that type which both
/// species have is mixed by the rule of each field, one that only one of them has is taken from that one, and
/// one that neither has must be set: getMixedObject<Type>(a, b)->set...().
class SeveralSpeciesHandler : public SpeciesOwner {
public:
    SeveralSpeciesHandler() = default;
    SeveralSpeciesHandler(const SeveralSpeciesHandler&) = delete;
    SeveralSpeciesHandler& operator=(const SeveralSpeciesHandler&) = delete;

    /// Adds a copy; the pointer stays valid, and values may be set through it at any time: during a run, a
    /// new value holds from the next step on. Species are added before the run.
    template <class S>
    requires(!std::is_pointer_v<S>) S* copyAndAddObject(const S& species) { return &add<S>(species).species; }
    /// A copy of what a pointer shows.
    template <class S>
    S* copyAndAddObject(const S* species) {
        return copyAndAddObject(*species);
    }
    /// Adds a species of this type of which nothing is set: its fields are set by their names.
    template <class S>
    AnySpecies* addOfType() {
        return &add<S>({});
    }
    /// Adds a species by the name of its type, which is one of instantiatedSpecies(), or of one that was
    /// registered (SpeciesRegistry.h). Throws InputError, with the nearest names, if there is none of this
    /// name.
    AnySpecies* addByName(std::string_view type);

    [[nodiscard]] std::size_t getSize() const { return all.size(); }
    [[nodiscard]] bool isEmpty() const { return getSize() == 0; }
    [[nodiscard]] AnySpecies* getObject(std::size_t index) const { return all[checked(index)].species.get(); }

    [[nodiscard]] AnySpecies* getLastObject() const { return getObject(all.size() - 1); }

    /// The contacts between the two species have the laws of this type.
    template <class Type, class First, class Second>
    void setPairType(const First* a, const Second* b) {
        static_cast<void>(ownOf<Type>(a->getIndex(), b->getIndex()));
    }
    /// Sets the laws of the contacts between two species; the fields of the pair can be set by their names.
    template <class Type>
    AnyLaws* setPairOfType(int a, int b) {
        return &ownOf<Type>(a, b);
    }
    /// Sets the laws of a pair by the name of their type, as in addByName().
    AnyLaws* setPairTypeByName(int a, int b, std::string_view type);
    /// The pair's own values, of laws of this type: nothing is set in them but what the driver sets.
    template <class Type, class First, class Second>
    typename Type::Mixed* getMixedObject(const First* a, const Second* b) {
        return &ownOf<Type>(a->getIndex(), b->getIndex()).laws;
    }
    template <class S>
    typename S::Mixed* getMixedObject(const S* a, const S* b) {
        return getMixedObject<S, S, S>(a, b);
    }

    /// Derives what is unset, checks every species and mixes every pair that has laws. Throws InputError; all
    /// pairs then have the values that they had.
    void mixAll();
    /// The laws of a pair; null where the driver has to say which.
    [[nodiscard]] LawsOfType* lawsOf(int a, int b) const;
    /// The sentence that says what to do where a pair has no laws.
    [[nodiscard]] std::string sentenceOfNone(int a, int b) const;
    /// Whether a value has been set, or a species added, since mixAll().
    [[nodiscard]] bool hasChanges() const;
    /// Of each species, and of each pair that the driver has spoken of.
    [[nodiscard]] std::vector<SetValues> setValues() const;
    /// A run goes on with the species that it began with, and with the laws of each pair; with their values
    /// as they have been changed during the run, where they have.
    void visitState(StateArchive& archive, bool& changedInRun);

private:
    struct Added {
        std::unique_ptr<AnySpecies> species;
        LawsOfType* laws;
    };
    struct OwnPair {
        std::unique_ptr<AnyLaws> own;
        LawsOfType* laws;
    };

    template <class S>
    LawsOf<S>& typeOf() {
        for (const auto& type : types)
            if (auto* const found = dynamic_cast<LawsOf<S>*>(type.get())) return *found;
        auto added = std::make_unique<LawsOf<S>>();
        LawsOf<S>& result = *added;
        types.push_back(std::move(added));
        return result;
    }
    template <class S>
    SpeciesInScene<S>& add(const S& species) {
        auto added = std::make_unique<SpeciesInScene<S>>(species, static_cast<int>(all.size()), this);
        SpeciesInScene<S>& result = *added;
        all.push_back({std::move(added), &typeOf<S>()});
        return result;
    }
    template <class Type>
    OwnLawsOfPair<Type>& ownOf(int a, int b) {
        return static_cast<OwnLawsOfPair<Type>&>(ownOf(a, b, typeOf<Type>()));
    }
    AnyLaws& ownOf(int a, int b, LawsOfType& type);
    std::size_t checked(std::size_t index) const;

    std::vector<std::unique_ptr<LawsOfType>> types;
    std::vector<Added> all;
    std::map<std::pair<int, int>, OwnPair> pairs;  // that the driver has spoken of

    void remember();

    KnownValues mixedFrom;
    std::size_t mixedSpecies = 0, mixedPairs = 0;
};

/// The handler for the types that a scene names, or for any where it names none.
template <class... Types>
class SpeciesHandlerOf : public SeveralSpeciesHandler {
public:
    template <class S>
    requires(!std::is_pointer_v<S> &&
             (sizeof...(Types) == 0 ||
              (std::same_as<S, Types> || ...))) S* copyAndAddObject(const S& species) {
        return SeveralSpeciesHandler::copyAndAddObject(species);
    }
    template <class S>
    S* copyAndAddObject(const S* species) {
        return copyAndAddObject(*species);
    }
};

/// The names of the species types whose laws are compiled into the kernel, and that can be chosen by name at
/// run time (the list is in Tools/CMake/GenerateLaws.cmake).
[[nodiscard]] std::vector<std::string_view> instantiatedSpecies();

}  // namespace pendular
