#include "Kernel/Output/FrameParts.h"

#include <fmt/format.h>

#include <deque>
#include <exception>
#include <string>

#include "Kernel/Base/InputError.h"
#include "Kernel/Files/OwnFile.h"
#include "Kernel/Files/WrittenBeside.h"

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
            problem = fault.what() + std::string("\n");
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

std::string beginOfPieces(const std::filesystem::path& index) { return index.stem().string() + "-rank"; }

}  // namespace

std::filesystem::path pieceOf(const std::filesystem::path& index, std::size_t rank) {
    return index.parent_path() / fmt::format("{}{}.vtp", beginOfPieces(index), rank);
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
    if (!ranks.isFirst()) return;
    for (const FramePart& part : parts) {
        std::vector<std::string> names;
        for (std::size_t rank = 0; rank < ranks.count(); ++rank)
            names.push_back(pieceOf(part.index, rank).filename().string());
        writePieces(part.index, part.data, names);
    }
}

void removeWithPieces(const std::filesystem::path& file) noexcept {
    removeFile(file);
    if (file.extension() != ".pvtp") return;
    std::error_code ignored;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    for (std::filesystem::directory_iterator at(folder, ignored), end; !ignored && at != end;
         at.increment(ignored)) {
        const std::filesystem::path& found = at->path();
        if (found.filename().string().starts_with(beginOfPieces(file)) && found.extension() == ".vtp")
            removeFile(found);
    }
}

}  // namespace pendular
