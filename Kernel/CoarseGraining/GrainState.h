#pragma once

#include <cstdint>
#include <vector>

#include "Kernel/Math/Vector.h"
#include "Kernel/Particles/PeriodicBox.h"

namespace pendular {

/// Whether fields are made of grains and contacts, or of grains alone.
enum class FieldContent { All, WithoutContacts };

/// What fields are made of: the grains and contacts of a scene at one time, from a run or from a file.
struct GrainState {
    struct Grain {
        Vector<double> position, velocity;  // m, m/s
        double radius, mass;                // m, kg
        double liquid = 0;                  // m^3, of the film on it
        int species = 0;
    };
    /// Between two grains, or a grain and a wall.
    struct Contact {
        static constexpr std::uint32_t wall = ~std::uint32_t{0};

        std::uint32_t first, second;  // places in `grains`; second: `wall`
        Vector<double> shift;         // m, from the centre of the first to that of the second, nearest
                                      // image, or to the wall's surface
        Vector<double> force;         // N, on the first
        double adhesiveForce = 0;     // N, attraction positive
        double liquid = 0;            // m^3, of the bridge
        bool touching = true;
    };

    double time = 0;  // s
    std::vector<Grain> grains;
    std::vector<Contact> contacts;
    PeriodicBox periodic;
};

}  // namespace pendular
