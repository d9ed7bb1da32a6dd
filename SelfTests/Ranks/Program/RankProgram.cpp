/// A run for tests of several processes: rank-program FOLDER STEPS [WHAT RANK]. It goes on where the folder
/// has a restart file. In the middle something happens to one of its ranks.
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "SelfTests/Scenes/SettlingBox.h"

using namespace pendular;

namespace {

class FaultyRun : public scenes::SettlingBox<HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies> {
public:
    FaultyRun(const std::string& folder, std::size_t steps, std::string event, std::size_t onRank)
        : SettlingBox(6), what(std::move(event)), rank(onRank), table(folder + "/table.csv", "time_s,z_m") {
        for (GrainReference grain : particleHandler) grain.setVelocity(0.2 * grain.getVelocity());
        setName(folder + "/run");
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        setSaveCount(50);
        keepRestartFile();
        if (what != "bare") addOutput(ParaViewOutput().withParts(what == "piece"));
        if (std::filesystem::exists(restartFile())) restartFrom(restartFile());
    }

    /// Of which one rank may have another number of steps.
    void runInParts() {
        runSteps(isDue("parts", 0) ? 121 : 120);
        runSteps(80);
        finishRun();
    }

private:
    [[nodiscard]] bool isDue(std::string_view event, std::size_t step) const {
        const ProcessRanks* const ranks = ranksOfProgram();
        return what == event && getNumberOfTimeSteps() == step && (ranks ? ranks->rank() : 0) == rank;
    }
    void setupInitialConditions() override {
        if (isDue("setup", 0)) throw InputError("The scene of this rank is wrong.");
        if (isDue("radius", 0)) particleHandler.getObject(3).setRadius(0.8e-3);
    }
    void actionsAfterTimeStep() override {
        if (isDue("step", 120) || isDue("early", 60)) throw RunError("A grain of this rank has gone.");
        if (isDue("kill", 120)) std::raise(SIGKILL);
        if (isDue("term", 120)) std::raise(SIGTERM);
        if (isDue("leave", 120)) std::exit(0);
        if (isDue("gather", 120)) gather();
        if (isDue("sum", 120)) static_cast<void>(sumOverRanks(1));
        if (isDue("largest", 120)) static_cast<void>(largestOfRanks(1));
        if (isDue("gravity", 120)) setGravity({0, 0, -5});
        if (isDue("pause", 120)) requestPause();
        if (isDue("disk", 120) || isDue("piece", 120)) {  // as a full disk: no file grows any more
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit none{0, 0};
            setrlimit(RLIMIT_FSIZE, &none);
        }
    }
    void writeOutput() override {
        if (isDue("output", 150)) throw InputError("This rank cannot write.");
        table.row(getTime(), particleHandler.getObject(3).getPosition().z());
    }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

    std::string what;
    std::size_t rank;
    RunTable table;
};

}  // namespace

int main(int argc, char** argv) {
    return runProgram([&] {
        const std::string what = argc > 4 ? argv[3] : "";
        FaultyRun scene(argv[1], std::strtoul(argv[2], nullptr, 10), what,
                        argc > 4 ? std::strtoul(argv[4], nullptr, 10) : 0);
        if (what == "pause" || what == "parts") scene.runInParts();
        else scene.solve();
        return 0;
    });
}
