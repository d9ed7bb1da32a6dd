#include <gtest/gtest.h>

#include <array>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Scenes/FewGrains.h"

// What is kept of contacts for the wear of walls takes memory for contacts with walls only.

namespace pendular::samplesOfWallsTest {
namespace {

using S = Species<LinearViscoelastic, SlidingFriction>;

/// A cubic lattice of 1000 grains that overlap by 2 % of a radius, on a plate.
struct Lattice : scenes::FewGrains<S> {
    static constexpr double r = 1e-3, spacing = 1.98e-3;
    static constexpr int side = 10;
    static constexpr std::size_t pairs = 3 * side * side * (side - 1);

    explicit Lattice(bool wears, bool hasLedger = false) : FewGrains(material(), grains(), 1e-7) {
        const double far = 0.1;
        const std::array<Triangle, 2> square{{{{{-far, -far, 0}, {far, -far, 0}, {far, far, 0}}},
                                              {{{-far, -far, 0}, {far, far, 0}, {-far, far, 0}}}}};
        TriangleWall plate;
        plate.set(square);
        plate.setSpecies(speciesHandler.getObject(0));
        if (wears) plate.keepWear(WearLaw::archard(1e-3, 1e9));
        wallHandler.copyAndAddObject(plate);
        if (hasLedger) keepEnergyLedger();
        setQuiet();
        setGravity({0, 0, -9.81});
        run(20);
    }
    [[nodiscard]] std::size_t bytes() { return contacts().store().bytes(); }

private:
    static S material() {
        S species;
        species.setDensity(2500), species.setStiffness(1e3), species.setDissipation(0.01);
        species.setSlidingStiffness(300), species.setSlidingFrictionCoefficient(0.4);
        return species;
    }
    static std::vector<scenes::GrainMotion> grains() {
        std::vector<scenes::GrainMotion> all;
        for (int k = 0; k < side * side * side; ++k)
            all.push_back({.radius = r,
                           .position = {spacing * (k % side), spacing * (k / side % side),
                                        0.99 * r + spacing * (k / side / side)},
                           .velocity = {0.1, 0, 0}});
        return all;
    }
};

TEST(SamplesOfWalls, takeMemoryOfContactsWithWallsOnly) {
    Lattice none(false), worn(true), whole(true, true);
    const std::size_t record = sizeof(EnergyRecord), atWall = Lattice::side * Lattice::side;
    const std::size_t more = worn.bytes() - none.bytes();
    // One for each contact with the plate at least; those of pairs would be five times as many as this at
    // least.
    EXPECT_GE(more, atWall * record);
    EXPECT_LT(more, Lattice::pairs * record / 5);
    EXPECT_GE(whole.bytes() - none.bytes(), Lattice::pairs * record);
}

}  // namespace
}  // namespace pendular::samplesOfWallsTest
