#include "Kernel/Analysis/Output/FrameParts.h"

#include <fmt/format.h>

#include <deque>
#include <exception>
#include <set>
#include <stdexcept>

#include "Kernel/Analysis/Output/VtkArrays.h"
#include "Kernel/Analysis/Output/XmlText.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

namespace {

/// The pieces of this rank, while they are written.
class Pieces {
public:
    explicit Pieces(const AllRanks& all) : ranks(all) {}

    /// Does it, and returns when all ranks have done so. Throws InputError on all where one could not.
    template <class Body>
    void onAll(Body&& body) {
        std::string problem;
        try {
            body();
        } catch (const std::exception& fault) {
            problem = sentenceOf(fault) + "\n";
        }
        const std::vector<char> all = ranks.gather(std::vector<char>(problem.begin(), problem.end()));
        if (all.empty()) return;
        for (WrittenBeside& piece : files) piece.discard();
        const std::string sentences(all.begin(), all.end());
        throw InputError(sentences.substr(0, sentences.find('\n')));
    }
    std::deque<WrittenBeside> files;

private:
    const AllRanks& ranks;
};

/// All, or none.
void writeIndices(const std::vector<FramePart>& parts, std::size_t ranks) {
    try {
        for (const FramePart& part : parts) {
            std::vector<std::string> names;
            for (std::size_t rank = 0; rank < ranks; ++rank)
                names.push_back(pieceOf(part.index, rank).filename().string());
            writePieces(part.index, part.data, names);
        }
    } catch (...) {
        for (const FramePart& part : parts) removeFile(part.index);
        throw;
    }
}

/// How many pieces an index names; 0 where it cannot be read.
std::size_t countPieces(const std::filesystem::path& index) noexcept {
    try {
        return pieceNames(loadInputFile("VTK file", index).text).size();
    } catch (...) {
        return 0;
    }
}

}  // namespace

std::filesystem::path pieceOf(const std::filesystem::path& index, std::size_t rank) {
    return index.parent_path() / fmt::format("{}-rank{}.vtp", index.stem().string(), rank);
}

std::vector<std::string> pieceNames(std::string_view text) {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const vtk::Tag& tag : vtk::parseTags(text)) {
        if (tag.name != "Piece") continue;
        const std::string& name = names.emplace_back(unescaped(std::string(vtk::valueOf(tag, "Source"))));
        if (!name.ends_with(".vtp") || name.find('/') != name.npos)
            throw std::runtime_error(
                fmt::format("has a piece '{}', which is no .vtp file beside it", shown(name)));
        if (!known.insert(name).second)
            throw std::runtime_error(fmt::format("has the piece '{}' more than once", shown(name)));
    }
    if (names.empty()) throw std::runtime_error("has no pieces");
    return names;
}

void writeInParts(const std::vector<FramePart>& parts, int threads, const AllRanks& ranks) {
    Pieces pieces(ranks);
    pieces.onAll([&] {
        for (const FramePart& part : parts) {
            WrittenBeside& piece =
                pieces.files.emplace_back(pieceOf(part.index, ranks.rank()), WrittenBeside::OfEachRank());
            writePolyData(piece, part.data, threads);
            piece.finish();
        }
    });
    pieces.onAll([&] {
        for (WrittenBeside& piece : pieces.files) piece.close();
    });
    pieces.onAll([&] {
        if (ranks.isFirst()) writeIndices(parts, ranks.count());
    });
}

void removeWithPieces(const std::filesystem::path& file) noexcept {
    const std::size_t named = file.extension() == ".pvtp" ? countPieces(file) : 0;
    removeFile(file);
    if (file.extension() != ".pvtp") return;
    std::error_code ignored;
    for (std::size_t rank = 0; rank < named || std::filesystem::exists(pieceOf(file, rank), ignored); ++rank)
        removeFile(pieceOf(file, rank));
}

}  // namespace pendular
