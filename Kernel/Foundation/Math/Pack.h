#pragma once

/// Pack: eight doubles that are computed together, and Mask: eight booleans.
///
/// Always eight lanes, whatever the machine: data layout and results do not depend on it. With AVX-512 a Pack
/// is one register; otherwise it is two registers (AVX), four (SSE2, NEON) or what the compiler makes of
/// them.
///
/// One formula serves both number types: a law is a template on T = double or T = Pack and uses only
///     + - * /  fma sqrt abs square min max nearestInteger
///     < <= > >= == !=  & | ^ !  select any all none bits
/// which have the same names, and give the same bits, for double (Scalar.h) and Pack. Two conditions:
/// the compiler must not contract a * b + c by itself (-ffp-contract=off): a law that wants it rounded once,
/// which is faster, writes fma(a, b, c). And NaN payloads are not compared.
///
///     const MaskOf<T> touching = overlap > 0.0;
///     if (none(touching)) return;
///     const T force = select(touching, stiffness * sqrt(overlap) * overlap, T(0.0));
///
/// Write (!a) & b with the brackets: g++ warns without them. Where a Pack is not one register, take it by
/// const reference in functions of your own: g++ then does not comment on the calling convention.
///
/// In the kernel's hot functions, leave structs, arrays and structured bindings of packs that an inlined
/// function returns without const: g++ 12 keeps const ones in memory ("Encountered a store to a read-only
/// decl" in -fdump-tree-sra-details), at one 64-byte store for each pack. Tools/count-stack-stores.py counts
/// them, and the test Contacts/PacksInRegisters bounds them.
///
/// A Mask has a different size on different machines: store bits(mask), and read it by maskFromBits.
///
/// Records: particles lie in memory as records of 8 (or 4) doubles. loadRecords takes eight of them and
/// transposes them in registers, so that column c of the result holds member c of the eight records;
/// storeRecords is the way back.

#include "Kernel/Foundation/Math/Scalar.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    #include "Kernel/Foundation/Math/PackAvx512.h"
#else
    #include "Kernel/Foundation/Math/PackGeneric.h"
#endif

namespace pendular {

/// The number types that laws are written for.
template <class T>
concept Number = std::same_as<T, double> || std::same_as<T, Pack>;

template <class T>
struct MaskOfNumber;
template <>
struct MaskOfNumber<double> {
    using Type = bool;
};
template <>
struct MaskOfNumber<Pack> {
    using Type = Mask;
};

/// The type of a comparison of two numbers: bool for double, Mask for Pack.
template <class T>
using MaskOf = typename MaskOfNumber<T>::Type;

/// The mask of which lane k is bit k.
template <Number T = Pack>
[[gnu::always_inline]] inline MaskOf<T> maskFromBits(std::uint8_t bits) {
    if constexpr (std::same_as<T, double>) return (bits & 1) != 0;
    else return Mask::fromBits(bits);
}

template <Number T>
[[gnu::always_inline]] inline T square(const T& value) {
    return value * value;
}

/// The nearest integer, ties to even, for |value| < 2^51.
template <Number T>
[[gnu::always_inline]] inline T nearestInteger(const T& value) {
    // From 2^52 on doubles have no fraction: the addition rounds, the subtraction is exact.
    return (value + 0x1.8p52) - 0x1.8p52;
}

static_assert(sizeof(Pack) == Pack::lanes * sizeof(double) && alignof(Pack) == 64);
static_assert(std::is_trivially_copyable_v<Pack> && std::is_trivially_copyable_v<Mask>);

}  // namespace pendular
