#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "Kernel/Features/SpeciesByName/SeveralSpeciesHandler.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// A species type that can be chosen by its name at run time.
struct SpeciesType {
    std::string_view name;
    AnySpecies* (*add)(SeveralSpeciesHandler&);
    AnyLaws* (*setPair)(SeveralSpeciesHandler&, int a, int b);
};

template <class S>
SpeciesType speciesType() {
    return {S::name, [](SeveralSpeciesHandler& handler) { return handler.addOfType<S>(); },
            [](SeveralSpeciesHandler& handler, int a, int b) { return handler.setPairOfType<S>(a, b); }};
}

/// What compiled laws and the kernel that calls them must have in common: sizes, instruction set, compiler.
struct KernelLayout {
    std::array<std::size_t, 6> sizes;
    friend bool operator==(const KernelLayout&, const KernelLayout&) = default;
};
/// The layout of the source file in which it is called.
static constexpr KernelLayout layoutOfThisFile() {
    std::size_t instructions = 0;
#ifdef __FMA__
    instructions += 1;
#endif
#ifdef __AVX2__
    instructions += 2;
#endif
#ifdef __AVX512F__
    instructions += 4;
#endif
    return {{sizeof(Pack), alignof(Pack), sizeof(ContactLaws), sizeof(SeveralSpeciesHandler), instructions,
             __GNUC__}};
}

/// From now on addByName() and setPairTypeByName() know this type. Throws InputError where they know one of
/// this name already, or where the type was compiled for another kernel.
void registerSpeciesType(const SpeciesType& type, const KernelLayout& layout);
template <class S>
void registerSpecies() {
    registerSpeciesType(speciesType<S>(), layoutOfThisFile());
}

/// A static object of this class in a library registers a species type as the library is loaded:
///     const RegisteredSpecies<Species<MyNormal, Mindlin>> mine;
/// Nothing may be thrown then: loadSpeciesLibrary() says what is wrong, and the log where another loads it.
class RegisteredSpeciesType {
protected:
    RegisteredSpeciesType(const SpeciesType& type, const KernelLayout& layout) noexcept;
};
template <class S>
class RegisteredSpecies : RegisteredSpeciesType {
public:
    RegisteredSpecies() noexcept : RegisteredSpeciesType(speciesType<S>(), layoutOfThisFile()) {}
};

/// Loads a library with species types, for as long as the program lasts. Throws InputError where it cannot be
/// loaded, where it registers none, and what registerSpecies() would throw.
///
/// The library is compiled with the headers and flags of the kernel and not linked to it: the program has the
/// kernel, all of it, and lets the library use it (the page on the kernel says how), so that nothing is there
/// twice.
void loadSpeciesLibrary(const std::filesystem::path& library);

/// The names of those that were registered, in this order.
[[nodiscard]] std::vector<std::string_view> registeredSpecies();

/// Whether laws of the kernel make a species type of this name, compiled into the program or not.
[[nodiscard]] bool isSpeciesOfTheKernel(std::string_view name);

/// The type with this name among instantiatedSpecies() and registeredSpecies(). Throws InputError: that it is
/// not compiled in, and how to get it, or with the nearest names.
[[nodiscard]] SpeciesType speciesTypeNamed(std::string_view name);

}  // namespace pendular
