#include "Kernel/Mercury/MercuryArguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {
namespace {

double numberOf(std::string_view option, std::string_view word) {
    double value = 0;
    if (!parseNumber(word, value))
        throw InputError(fmt::format("The option {} needs a number: {}.", option, whyNoNumber(word)));
    return value;
}

}  // namespace

std::size_t stepsOfOption(std::string_view option, double value) {
    if (!(value >= 0) || value > 1e18 || value != std::floor(value))
        throw InputError(fmt::format("The option {} is {}; it must be a whole number of steps, at least 0.",
                                     option, value));
    return static_cast<std::size_t>(value);
}

int dimensionsOfOption(std::string_view option, double value) {
    if (value != 2 && value != 3)
        throw InputError(fmt::format("The option {} is {}; it must be 2 or 3.", option, value));
    return static_cast<int>(value);
}

void takeArguments(Run& run, int argc, const char* const* argv, std::span<const MercuryOption> others,
                   const std::function<void(const std::filesystem::path&)>& restart) {
    std::vector<MercuryOption> options{
        {"-tmax", 1, [&](const std::vector<double>& v) { run.setTimeMax(v[0]); }},
        {"-dt", 1, [&](const std::vector<double>& v) { run.setTimeStep(v[0]); }}};
    for (const std::string_view name : {"-saveCount", "-savecount", "-save_count"})
        options.push_back({name, 1, [&run, name](const std::vector<double>& v) {
                               run.setSaveCount(stepsOfOption(name, v[0]));
                           }});
    options.insert(options.end(), others.begin(), others.end());
    int k = 1;
    const auto valueOf = [&](std::string_view option) -> std::string_view {
        if (k + 1 >= argc) throw InputError(fmt::format("The option {} needs a value behind it.", option));
        return argv[++k];
    };
    // The name comes first, as -r without a file means the file of this name, wherever the two stand.
    for (int n = 1; n + 1 < argc; ++n)
        if (std::string_view(argv[n]) == "-name") run.setName(argv[n + 1]);
    for (; k < argc; ++k) {
        const std::string_view option = argv[k];
        if (option == "-name") {
            run.setName(std::string(valueOf(option)));
            continue;
        }
        if (option == "-r" || option == "-restart") {
            const std::filesystem::path file = k + 1 < argc && argv[k + 1][0] != '-' ? argv[++k] : "";
            if (restart) restart(file);
            else run.restartFrom(file.empty() ? run.restartFile() : file);
            continue;
        }
        const auto found = std::ranges::find(options, option, &MercuryOption::name);
        if (found == options.end()) {
            std::vector<std::string_view> names{"-name"};
            for (const MercuryOption& one : options) names.push_back(one.name);
            throw InputError(fmt::format("There is no option {}; solve(argc, argv) knows {} and -r.", option,
                                         fmt::join(names, ", ")));
        }
        std::vector<double> values;
        while (values.size() < found->count) values.push_back(numberOf(option, valueOf(option)));
        found->set(values);
    }
}

}  // namespace pendular
