#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "Kernel/Features/PopularSpecies.h"
#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {

std::vector<std::string_view> instantiatedSpecies() { return lawNames<PopularSpecies>(); }

AnySpecies* SeveralSpeciesHandler::addByName(std::string_view type) {
    return speciesTypeNamed(type).add(*this);
}

AnyLaws* SeveralSpeciesHandler::setPairTypeByName(int a, int b, std::string_view type) {
    return speciesTypeNamed(type).setPair(*this, a, b);
}

std::size_t SeveralSpeciesHandler::checked(std::size_t index) const {
    if (index >= all.size())
        throw InputError(fmt::format("There is no species {}; the scene has {} (counted from 0).",
                                     static_cast<std::ptrdiff_t>(index), all.size()));
    return index;
}

AnyLaws& SeveralSpeciesHandler::ownOf(int a, int b, LawsOfType& type) {
    checked(static_cast<std::size_t>(a)), checked(static_cast<std::size_t>(b));
    OwnPair& pair = pairs[std::minmax({a, b})];
    if (!pair.own) pair = {type.nothingSetForPair(), &type};
    if (pair.laws != &type)
        throw InputError(
            fmt::format("The pair of species {} and {} has the laws of {} already, and cannot "
                        "have those of {} too.",
                        a, b, pair.own->getName(), type.laws().name));
    return *pair.own;
}

LawsOfType* SeveralSpeciesHandler::lawsOf(int a, int b) const {
    if (const auto found = pairs.find(std::minmax({a, b})); found != pairs.end()) return found->second.laws;
    LawsOfType* const first = all[checked(static_cast<std::size_t>(a))].laws;
    return first == all[checked(static_cast<std::size_t>(b))].laws ? first : nullptr;
}

std::string SeveralSpeciesHandler::sentenceOfNone(int a, int b) const {
    return fmt::format(
        "Species {} ({}) and {} ({}) can touch and are of different types: say which laws they have with "
        "speciesHandler.setPairType<Type>(a, b).",
        a, all[static_cast<std::size_t>(a)].species->getName(), b,
        all[static_cast<std::size_t>(b)].species->getName());
}

void SeveralSpeciesHandler::mixAll() {
    if (all.empty())
        throw InputError("The scene has no species; add one with speciesHandler.copyAndAddObject().");
    for (const Added& added : all) added.species->complete();
    for (const auto& type : types) type->begin(all.size());
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a; b < all.size(); ++b) {
            const AnySpecies &first = *all[a].species, &second = *all[b].species;
            const auto found = pairs.find({first.getIndex(), second.getIndex()});
            const bool isOwn = found != pairs.end();
            if (LawsOfType* const laws = lawsOf(first.getIndex(), second.getIndex()))
                laws->mix(first, second, isOwn ? found->second.own.get() : nullptr, isOwn);
        }
    for (const auto& type : types) type->finish();
    remember();
}

void SeveralSpeciesHandler::remember() {
    mixedFrom.clear();
    const auto add = [&](const std::vector<NamedField>& fields) {
        for (const NamedField& field : fields) mixedFrom.add(*field.value);
    };
    for (const Added& added : all) {
        add(added.species->fields());
        mixedFrom.add(added.species->densityPlace());
    }
    for (const auto& [pair, laws] : pairs) add(laws.own->fields());
    mixedSpecies = all.size();
    mixedPairs = pairs.size();
}

bool SeveralSpeciesHandler::hasChanges() const {
    return mixedSpecies != all.size() || mixedPairs != pairs.size() || mixedFrom.haveChanged();
}

std::vector<SetValues> SeveralSpeciesHandler::setValues() const {
    std::vector<SetValues> found;
    for (const Added& added : all) {
        AnySpecies& species = *added.species;
        found.push_back({species.getIndex(), species.getIndex(), species.getName(), species.fields()});
    }
    for (const auto& [pair, laws] : pairs)
        found.push_back({pair.first, pair.second, laws.own->getName(), laws.own->fields()});
    return found;
}

void SeveralSpeciesHandler::visitState(StateArchive& archive, bool& changedInRun) {
    visitForm(archive, *this);
    archive.same("count", all.size());
    archive.value("changedInRun", changedInRun);
    for (const Added& added : all)
        archive.group(fmt::format("{}", added.species->getIndex()),
                      [&] { added.species->visitState(archive, changedInRun); });
    archive.same("countOfPairsWithOwnLaws", pairs.size());
    for (const auto& [pair, laws] : pairs)
        archive.group(fmt::format("{}-{}", pair.first, pair.second),
                      [&, &values = laws] { values.own->visitState(archive, changedInRun); });
}

}  // namespace pendular
