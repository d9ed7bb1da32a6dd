#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pendular {

/// A summary that a run has written about itself (NAME-summary.csv), read again: that of RunSummary, or the
/// short one of a run without it.
class SummaryFile {
public:
    static constexpr std::string_view ending = "-summary.csv";

    /// The file of a run of this name (its setName()).
    static std::filesystem::path pathOf(const std::string& name) { return name + std::string(ending); }

    struct Row {
        std::string quantity, value, unit;
    };

    /// Throws InputError.
    explicit SummaryFile(const std::filesystem::path& file);

    [[nodiscard]] const std::vector<Row>& rows() const { return all; }
    /// The things that are wrong, a line each; empty if all is well.
    [[nodiscard]] std::vector<std::string> complaints() const;
    /// A remark on what is not wrong, and worth knowing, behind "healthy, and"; empty if there is nothing.
    [[nodiscard]] std::string remark() const;
    /// "at its end"
    [[nodiscard]] std::string state() const;

private:
    /// s, since it was written.
    [[nodiscard]] double age() const;
    [[nodiscard]] bool isAboveLimit() const;
    [[nodiscard]] bool limitIsAccepted() const;
    [[nodiscard]] bool isOnItsWay() const;
    [[nodiscard]] double longestSilence() const;
    [[nodiscard]] std::string value(std::string_view quantity) const;
    [[nodiscard]] double number(std::string_view quantity) const;

    std::filesystem::path path;
    std::vector<Row> all;
};

}  // namespace pendular
