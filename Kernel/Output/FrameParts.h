#pragma once

#include <filesystem>
#include <vector>

#include "Kernel/Output/PolyData.h"
#include "Kernel/Ranks/AllRanks.h"

namespace pendular {

/// What a rank has of a file that all write together.
struct FramePart {
    std::filesystem::path index;  // NAME-KIND-STEP.pvtp
    PolyData data;
};

/// NAME-KIND-STEP-rankN.vtp, beside the index.
std::filesystem::path pieceOf(const std::filesystem::path& index, std::size_t rank);

/// Each rank writes a piece of each file, beside its name; when all have done so, the pieces get their names,
/// and then the first rank writes the indices. Where a rank cannot, all throw InputError with its sentence,
/// and there are no new files. The ranks must have the files in the same order, with the same fields.
/// @param threads that compress
void writeInParts(const std::vector<FramePart>& parts, int threads, const AllRanks& ranks);

/// Removes a file of a frame, and its pieces, however many ranks have written them.
void removeWithPieces(const std::filesystem::path& file) noexcept;

}  // namespace pendular
