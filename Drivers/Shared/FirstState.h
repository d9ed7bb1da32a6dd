#pragma once

#include <string>

#include "Kernel/Features/Meshes/TriangleReader.h"

namespace CLI {
class App;
}

namespace pendular {

/// What a published case begins with: the files of its authors, or a state that is generated.
struct FirstState {
    std::string grains, walls;  // files; both empty: a generated state
    std::size_t number = 0;     // of a generated state
    double softening = 1;
};

/// How the command line tells of it.
struct FirstStateTexts {
    std::string grains, walls, number;  // of the options with these names
};

void addFirstState(CLI::App& app, FirstState& o, const FirstStateTexts& texts);

/// Runs a scene within the walls of the file, or, where none is given, within a shape.
/// @param options of the scene, with a FirstState
template <class Scene, class Options, class Grains, class Shape>
void solveWithin(const Options& options, const Grains& grains, const Shape& shape) {
    if (options.walls.empty()) Scene(options, grains, shape).solve();
    else Scene(options, grains, readTriangles(options.walls)).solve();
}

}  // namespace pendular
