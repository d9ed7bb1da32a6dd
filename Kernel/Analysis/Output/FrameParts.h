#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Ranks/AllRanks.h"

namespace pendular {

/// What a rank has of a file that all write together.
struct FramePart {
    std::filesystem::path index;  // NAME-KIND-STEP.pvtp
    PolyData data;
};

/// NAME-KIND-STEP-rankN.vtp, beside the index.
std::filesystem::path pieceOf(const std::filesystem::path& index, std::size_t rank);

/// The names of the pieces, in the text of an index. Throws std::runtime_error where there are none, one is
/// no file beside it, or one comes twice.
std::vector<std::string> pieceNames(std::string_view text);

/// Each rank writes a piece of each file, beside its name; when all have done so, the pieces get their names,
/// and then the first rank writes the indices. Where a rank cannot, all throw InputError with its sentence,
/// and there are no new files. The ranks must have the files in the same order, with the same fields.
/// @param threads that compress
void writeInParts(const std::vector<FramePart>& parts, int threads, const AllRanks& ranks);

/// Removes a file of a frame, and its pieces: as many as it names, and what follows them without a gap.
void removeWithPieces(const std::filesystem::path& file) noexcept;

}  // namespace pendular
