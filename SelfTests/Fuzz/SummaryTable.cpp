#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

/// A row has no comma but in its value; what is said of a run is a line.
void read(const std::filesystem::path& path) {
    const SummaryFile summary(path);
    for (const SummaryFile::Row& row : summary.rows())
        if ((row.quantity + row.unit).find(',') != std::string::npos)
            throw std::logic_error("a column has a part of its neighbour");
    std::vector<std::string> sentences = summary.complaints();
    sentences.insert(sentences.end(), {summary.remark(), summary.state()});
    for (const std::string& sentence : sentences)
        if (sentence.find('\n') != std::string::npos) throw std::logic_error("a sentence has two lines");
}

std::string summaryOf(std::string_view state, double timeStep) {
    return written("run-summary.csv", [&](const auto& path) {
        SummaryRows rows;
        rows.add("state", state);
        rows.add("reason", "a grain, 1e9 m away, left");
        rows.addNumber("time step", timeStep, "s");
        rows.addNumber("stability limit", 2e-6, "s");
        rows.add("step above the stability limit", "accepted");
        for (const char* quantity : {"kinetic energy", "energy lost", "energy unaccounted for"})
            rows.addNumber(quantity, 1e-3, "J");
        rows.addNumber("wall time since the summary before", 1, "s");
        rows.add("warning", "2 bridges are out of the domain of their law");
        CsvFile file(path, "quantity,value,unit");
        rows.write(file);
        file.close();
    });
}

}  // namespace

Target summaryTable() {
    return {"SummaryTable",
            [] {
                return std::vector<std::string>{summaryOf("on its way", 1e-6),
                                                summaryOf("stopped by an error", 3e-6)};
            },
            [](std::string_view bytes) { return takesFile("run-summary.csv", bytes, read); }};
}

}  // namespace pendular::fuzz
