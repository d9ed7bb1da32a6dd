#pragma once

#include <fstream>

namespace {

/// One large triangle at x = 11.5 mm, as an STL file in mm.
inline void writeDrumFile() {
    std::ofstream("drum.stl") << "solid drum\nfacet normal -1 0 0\nouter loop\nvertex 11.5 -100 -100\n"
                                 "vertex 11.5 200 -100\nvertex 11.5 10 200\nendloop\nendfacet\n"
                                 "endsolid drum\n";
}

}  // namespace
