/// Tables of the charts of the eight benchmark tests of Chung and Ooi (2011), Granular Matter 13, 643: what
/// is simulated, and theory. Tools/Studies/ChungOoi/Tests/ChungOoiTest.cpp checks the same impacts.

#include <fmt/format.h>

#include <filesystem>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/ChungOoi/ChungOoiCases.h"

using namespace pendular;
using papers::ImpactCase;

namespace {

/// The largest error of a table, beside the one that the test allows.
class LargestError {
public:
    LargestError(int test, std::string what, double limit)
        : test(test), what(std::move(what)), limit(limit) {}
    /// The error in percent.
    double of(double simulated, double theory, double scale) {
        const double error = (simulated - theory) / scale;
        largest = std::max(largest, std::abs(error));
        return 100 * error;
    }
    void print() const {
        fmt::print("test {}, {}: error of at most {:.2g} %; {:.2g} % allowed\n", test, what, 100 * largest,
                   100 * limit);
    }

private:
    int test;
    std::string what;
    double limit, largest = 0;
};

std::string cell(double value) { return fmt::format("{:.6g}", value); }

/// The folder of the tables, and the table of one test in it.
struct Tables {
    std::filesystem::path folder;

    [[nodiscard]] CsvFile of(int test, std::string_view header) const {
        return CsvFile(folder / fmt::format("test-{}.csv", test), header);
    }
};

/// Tests 1 and 2: the force over the time.
void writeHistories(const Tables& tables, int test, const std::vector<ImpactCase>& cases) {
    auto file = tables.of(test,
                          "material,time_s,simulated_overlap_m,theory_overlap_m,simulated_force_N,"
                          "theory_force_N,error_of_force_percent_of_largest,allowed_error_percent");
    LargestError error(test, "force over time", papers::forceError);
    constexpr std::size_t every = 6;  // steps a row
    for (const ImpactCase& impact : cases) {
        const auto hertz = impact.hertz();
        const auto moments = impact.history();
        for (std::size_t k = 0; k < moments.size(); ++k) {
            const auto& [time, overlap, force] = moments[k];
            const double expected = hertz.overlapAt(time);
            const double percent = error.of(force, hertz.forceAt(expected), hertz.largestForce());
            if (k % every == 0)
                file.row(impact.material, cell(time), cell(overlap), cell(expected), cell(force),
                         cell(hertz.forceAt(expected)), cell(percent), cell(100 * papers::forceError));
        }
    }
    file.close();
    error.print();
}

/// Test 3: the restitution that comes out over the given one.
void writeRestitutions(const Tables& tables) {
    auto file =
        tables.of(3, "material,given_restitution,simulated_restitution,error_percent,allowed_error_percent");
    LargestError error(3, "restitution", papers::schemeError);
    for (const ImpactCase& impact : papers::chungOoi3()) {
        const double given = impact.contact.restitution;
        const double simulated = -impact.simulated().parting / impact.upper.velocity.z();
        file.row(impact.material, cell(given), cell(simulated), cell(error.of(simulated, given, given)),
                 cell(100 * papers::schemeError));
    }
    file.close();
    error.print();
}

/// The angle (degrees) of the contact point's way after an impact, from the normal.
double reboundAngle(const ImpactCase::Motion& after) {
    return std::atan2(after.sideways - after.rim, after.parting) * 180 / std::numbers::pi;
}
std::string motionCells(const std::optional<ImpactCase::Motion>& after, double radius) {
    if (!after) return ",,";
    return fmt::format("{:.6g},{:.6g},{:.6g}", after->sideways, after->rim / radius, reboundAngle(*after));
}

/// Tests 4 to 8: the motion of the upper sphere after an impact.
void writeMotions(const Tables& tables, int test, const std::vector<ImpactCase>& cases) {
    std::string header = "material,incidence_deg,normal_speed_m/s,tangential_speed_m/s,spin_rad/s";
    for (const char* way : {"simulated", "theory", "sliding"})
        header += fmt::format(",{0}_tangential_speed_m/s,{0}_spin_rad/s,{0}_rebound_of_contact_deg", way);
    header += ",error_of_tangential_speed_percent,error_of_spin_percent,allowed_error_of_spin_percent";
    auto file = tables.of(test, header);
    LargestError sidewaysError(test, "tangential speed", papers::slipError);
    LargestError spinError(test, "spin", papers::rimError);
    for (const ImpactCase& impact : cases) {
        const auto& [radius, velocity, spin, fixed] = impact.upper;
        const auto after = impact.simulated(), expected = impact.integrated();
        file.row(impact.material, cell(std::atan2(velocity.x(), -velocity.z()) * 180 / std::numbers::pi),
                 cell(-velocity.z()), cell(velocity.x()), cell(spin.y()), motionCells(after, radius),
                 motionCells(expected, radius), motionCells(impact.sliding(), radius),
                 cell(sidewaysError.of(after.sideways, expected.sideways, impact.slipTaken())),
                 cell(spinError.of(after.rim, expected.rim, impact.slipTaken())),
                 cell(100 * papers::rimError));
    }
    file.close();
    sidewaysError.print();
    spinError.print();
}

void writeTables(const std::filesystem::path& folder) {
    const Tables tables{folder};
    writeHistories(tables, 1, papers::chungOoi1());
    writeHistories(tables, 2, papers::chungOoi2());
    writeRestitutions(tables);
    writeMotions(tables, 4, papers::chungOoi4());
    writeMotions(tables, 5, papers::chungOoi5());
    writeMotions(tables, 6, papers::chungOoi6());
    writeMotions(tables, 7, papers::chungOoi7());
    writeMotions(tables, 8, papers::chungOoi8());
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "The eight benchmark tests of Chung and Ooi (2011), simulated and by theory, as CSV. Prints the "
        "largest errors.");
    std::string folder = "impact-figures";
    app.add_option("--output", folder, "folder for test-1.csv to test-8.csv")->capture_default_str();
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] {
        writeTables(folder);
        return 0;
    });
}
