#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <string>

#include "Kernel/Features/PopularSpecies.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {

namespace {

/// Made when it is first asked for: static objects of other files register before this file's are made.
struct Registry {
    std::vector<SpeciesType> types;
    std::vector<std::string> refusals;  // of the library that is being loaded
    bool isLoading = false;
    std::recursive_mutex access;  // as a library registers while it is loaded
};
Registry& registry() {
    static Registry all;
    return all;
}

std::vector<SpeciesType> knownTypes() {
    std::vector<SpeciesType> known;
    PopularSpecies::forEach([&]<class S>() { known.push_back(speciesType<S>()); });
    const std::scoped_lock lock(registry().access);
    known.insert(known.end(), registry().types.begin(), registry().types.end());
    return known;
}

}  // namespace

void registerSpeciesType(const SpeciesType& type, const KernelLayout& layout) {
    if (layout != layoutOfThisFile())
        throw InputError(
            fmt::format("The species type {} was compiled for another version of Pendular, or with other "
                        "options; compile it with the headers and flags of this program.",
                        type.name));
    const std::scoped_lock lock(registry().access);
    if (std::ranges::count(knownTypes(), type.name, &SpeciesType::name) > 0)
        throw InputError(fmt::format(
            "There is a species type {} already; give the laws of the new one other names.", type.name));
    registry().types.push_back(type);
}

RegisteredSpeciesType::RegisteredSpeciesType(const SpeciesType& type, const KernelLayout& layout) noexcept {
    try {
        registerSpeciesType(type, layout);
    } catch (const std::exception& refusal) {
        const std::scoped_lock lock(registry().access);
        if (registry().isLoading) registry().refusals.emplace_back(refusal.what());
        else writeToLog(fmt::format("{}\n", refusal.what()), LogLevel::Warn);
    }
}

void loadSpeciesLibrary(const std::filesystem::path& library) {
    Registry& all = registry();
    const std::scoped_lock lock(all.access);
    const std::size_t before = all.types.size();
    all.refusals.clear();
    all.isLoading = true;
    const void* const handle = dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
    all.isLoading = false;
    if (!handle) {
        const char* const reason = dlerror();
        throw InputError(fmt::format("The library of species {} cannot be loaded: {}.", library.string(),
                                     reason ? reason : "for an unknown reason"));
    }
    if (!all.refusals.empty()) throw InputError(all.refusals.front());
    if (all.types.size() == before)
        throw InputError(
            fmt::format("The library {} registers no species type, or was loaded before; it needs a static "
                        "RegisteredSpecies<Type>.",
                        library.string()));
}

std::vector<std::string_view> registeredSpecies() {
    const std::scoped_lock lock(registry().access);
    std::vector<std::string_view> names;
    for (const SpeciesType& type : registry().types) names.push_back(type.name);
    return names;
}

bool isSpeciesOfTheKernel(std::string_view name) {
    const std::string wanted = canonicalLawName(name);
    const std::vector<std::string_view> frictions = lawNames<FrictionLaws>(""),
                                        adhesions = lawNames<AdhesionLaws>("");
    for (const std::string_view normal : lawNames<NormalLaws>(""))
        for (const std::string_view friction : frictions) {
            const std::string beginning = fmt::format("{}{}", normal, friction);
            if (!wanted.starts_with(beginning)) continue;
            for (const std::string_view adhesion : adhesions)
                if (wanted == fmt::format("{}{}{}", beginning, adhesion, speciesSuffix)) return true;
        }
    return false;
}

SpeciesType speciesTypeNamed(std::string_view name) {
    const std::string wanted = canonicalLawName(name);
    std::vector<std::string_view> names;
    for (const SpeciesType& type : knownTypes()) {
        if (type.name == wanted) return type;
        names.push_back(type.name);
    }
    if (isSpeciesOfTheKernel(wanted))
        throw InputError(fmt::format(
            "{} is a species of Pendular, but it is not compiled into this program; register it by "
            "registerSpecies<Type>(), or load a library that does by loadSpeciesLibrary().",
            wanted));
    unknownName("instantiated species", name, names);
}

}  // namespace pendular
