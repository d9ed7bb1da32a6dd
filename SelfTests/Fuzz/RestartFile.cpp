#include "Kernel/Foundation/State/RestartFile.h"

#include "Kernel/Foundation/State/Random.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

struct Memory {
    double time = 0.5;
    bool stopped = true;
    std::vector<double> curve{1, 2, 3};
    std::string remark = "a remark";
    UniformRandom random{1};

    void visitState(StateArchive& archive) {
        archive.value("time", time);
        archive.value("stopped", stopped);
        archive.column<double>("curve", curve);
        archive.text("remark", remark);
        archive.group("random", [&] { random.visitState(archive); });
    }
};

}  // namespace

/// Any bytes as a restart file: those whose checksum is wrong never come to the HDF5 library.
Target restartFile() {
    const auto visit = [](StateArchive& archive) { Memory().visitState(archive); };
    return {"RestartFile",
            [=] {
                return std::vector{written("a.h5", [&](const auto& path) { writeRestartFile(path, visit); })};
            },
            [=](std::string_view bytes) {
                return takesFile("a.h5", bytes, [&](const auto& path) { readRestartFile(path, visit); });
            }};
}

}  // namespace pendular::fuzz
