// Runs the scene of a file as a C++ driver does, with 1 and 2 threads, whole and with a restart, and prints
// the hash of the state of each: same_bits_test.py has the same of Python. With the word `time` behind the
// file: with 1 thread alone, and the processor's time (s) of as many steps again, for
// Tools/Python/measure-overheads.py. Lines of the file:
//     type NAME | set FIELD VALUE | grain X Y Z RADIUS FILM | plane NX NY NZ PX PY PZ | step S | steps N
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>

#include "Kernel/Core/Run/Program.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/StateHash.h"
#include "Tools/Python/MoreSpecies.h"

using namespace pendular;

namespace {

struct FileScene : Simulation<> {
    std::size_t steps = 0;

    FileScene(const std::string& file, int threads) {
        setQuiet();
        setNumberOfThreads(threads);
        setGravity({0, 0, -9.81});
        std::ifstream lines(file);
        for (std::string line; std::getline(lines, line);) read(line);
    }

private:
    AnySpecies* species = nullptr;

    static double number(std::istream& line) {
        std::string word;
        line >> word;
        return std::strtod(word.c_str(), nullptr);  // which reads hexadecimal numbers, too
    }
    static Vec3D vector(std::istream& line) {
        const double x = number(line), y = number(line), z = number(line);
        return {x, y, z};
    }
    void read(const std::string& text) {
        std::istringstream line(text);
        std::string what, name;
        line >> what;
        if (what == "type") line >> name, species = speciesHandler.addByName(name);
        if (what == "set") line >> name, species->set(name, number(line));
        if (what == "step") setTimeStep(number(line));
        if (what == "steps") steps = static_cast<std::size_t>(number(line));
        if (what == "grain") {
            SphericalParticle grain;
            grain.setSpecies(species);
            grain.setPosition(vector(line)), grain.setRadius(number(line)),
                grain.setLiquidVolume(number(line));
            particleHandler.copyAndAddObject(grain);
        }
        if (what == "plane") {
            InfiniteWall plane;
            plane.setSpecies(species);
            const Vec3D normal = vector(line);
            plane.set(normal, vector(line));
            wallHandler.copyAndAddObject(plane);
        }
    }
};

std::string hashOf(const FileScene& scene) {
    return fmt::format("{:016x}", stateHash(scene.particleHandler.store()));
}

void printTime(const std::string& file) {
    FileScene scene(file, 1);
    scene.runSteps(scene.steps);
    const std::clock_t begin = std::clock();
    scene.runSteps(scene.steps);
    const double taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    fmt::print("{} {:.6f}\n", hashOf(scene), taken);
}

void printHashes(const std::string& file) {
    const std::string state = file + ".h5";
    for (const int threads : {1, 2}) {
        FileScene whole(file, threads);
        whole.runSteps(whole.steps);
        FileScene first(file, threads), second(file, threads);
        first.runSteps(first.steps / 2);
        first.writeRestart(state);
        second.restartFrom(state);
        second.runSteps(second.steps - second.steps / 2);
        for (const FileScene* scene : {&whole, &second}) fmt::print("{}\n", hashOf(*scene));
    }
}

}  // namespace

int main(int count, char** argv) {
    return runProgram([&] {
        python::registerMoreSpecies();
        if (count > 2 && std::string_view(argv[2]) == "time") printTime(argv[1]);
        else printHashes(argv[1]);
        return 0;
    });
}
