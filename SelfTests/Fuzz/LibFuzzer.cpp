// What libFuzzer calls (https://llvm.org/docs/LibFuzzer.html):
//   FuzzReaders --target=NAME --seeds=FOLDER FOLDER [options of libFuzzer]
// libFuzzer leaves options that begin with -- alone. The folder gets the target's seeds first.
#include <fmt/format.h>

#include <cstdlib>

#include "SelfTests/Fuzz/Target.h"

namespace {

using pendular::fuzz::Target;

Target chosen;

std::string valueOf(std::string_view option, int count, char** words) {
    for (int k = 1; k < count; ++k)
        if (std::string_view(words[k]).starts_with(option)) return words[k] + option.size();
    return {};
}

void writeSeeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    int number = 0;
    for (const std::string& seed : chosen.makeSeeds())
        pendular::fuzz::writeBytes(folder / fmt::format("seed-{}", number++), seed);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
    const std::string name = valueOf("--target=", *count, *words),
                      seeds = valueOf("--seeds=", *count, *words);
    std::string names;
    for (Target& target : pendular::fuzz::allTargets()) {
        names += " " + target.name;
        if (target.name == name) chosen = std::move(target);
    }
    if (!chosen.take) {
        fmt::print(stderr, "There is no target '{}'; --target= may be one of:{}\n", name, names);
        std::exit(2);
    }
    if (!seeds.empty()) writeSeeds(seeds);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    try {
        chosen.take({reinterpret_cast<const char*>(bytes), size});
    } catch (const std::exception& fault) {
        fmt::print(stderr, "A fault: {}\n", fault.what());
        std::abort();  // libFuzzer keeps the input
    }
    return 0;
}
