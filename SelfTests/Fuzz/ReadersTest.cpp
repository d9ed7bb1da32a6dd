// Every reader of files stands damaged ones: good files, changed by chance, are read or refused with one
// sentence. A short form, for every machine, of what libFuzzer does (preset fuzz; README of this folder).
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>

#include "Kernel/Foundation/Files/ReadingProcess.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Foundation/State/Random.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

/// The name that GoogleTest shows.
static void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

namespace {

class Damage {
public:
    explicit Damage(std::uint64_t seed) : random(seed) {}

    /// One to four changes: a bit, a byte, a stretch that is lost, doubled or taken from another place, or an
    /// end.
    std::string operator()(std::string bytes) {
        for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
            const std::size_t at = below(bytes.size()),
                              length = 1 + below(std::min<std::size_t>(bytes.size() - at, 32));
            switch (below(6)) {
                case 0:
                    bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                    break;
                case 1:
                    bytes[at] = static_cast<char>(below(256));
                    break;
                case 2:
                    bytes.erase(at, length);
                    break;
                case 3:
                    bytes.insert(at, bytes.substr(at, length));
                    break;
                case 4:
                    bytes.replace(at, length, bytes.substr(below(bytes.size()), length));
                    break;
                default:
                    if (below(8) == 0) bytes.resize(at);
            }
        }
        return bytes;
    }

private:
    std::size_t below(std::size_t end) {
        return static_cast<std::size_t>(random.uniform(0, static_cast<double>(end)));
    }

    UniformRandom random;
};

/// The most memory that this program has had, or one of its children, kB.
long peakMemory() {
    rusage own{}, children{};
    getrusage(RUSAGE_SELF, &own);
    getrusage(RUSAGE_CHILDREN, &children);
    return std::max(own.ru_maxrss, children.ru_maxrss);
}

class Readers : public testing::TestWithParam<Target> {};

TEST_P(Readers, standDamagedFiles) {
    const Target& target = GetParam();
    const bool isHdf5 = target.name.starts_with("Restart") || target.name.starts_with("Hdf5"),
               isContent = target.name == "RestartContent";
    if (isHdf5 && !Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library.";
    const std::vector<std::string> seeds = target.makeSeeds();
    EXPECT_TRUE(target.take(seeds[0]));
    Damage damage(1);
    std::size_t taken = 0, refused = 0;
    const std::size_t tries = isContent                         ? 200
                              : target.name.starts_with("Hdf5") ? 1000
                              : target.name == "RestartBytes"   ? 2000
                                                                : 3000;
    for (std::size_t k = 0; k < tries; ++k) {
        const std::string bytes = damage(seeds[k % seeds.size()]);
        try {
            ++(target.take(bytes) ? taken : refused);
        } catch (const std::exception& fault) {
            FAIL() << fault.what() << " at try " << k << ": " << testing::PrintToString(bytes);
        }
    }
    // Files of some kB may claim more, and get none of it.
    if (ReadingProcess::limitsMemory()) {
        EXPECT_LT(peakMemory(), 200'000);
    }
    EXPECT_GT(refused, tries / 20);
    EXPECT_GT(taken, target.name == "RestartFile" ? 0 : tries / 100);
    RecordProperty("taken", static_cast<int>(taken));
}
INSTANTIATE_TEST_SUITE_P(All, Readers, testing::ValuesIn(allTargets()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace pendular::fuzz
