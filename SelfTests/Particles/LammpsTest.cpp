// Files of LAMMPS and LIGGGHTS as grains, and grains by their types.
#include <gtest/gtest.h>

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::lammpsTest {
namespace {

using scenes::FewGrains;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TemporaryFile;

std::vector<GrainRow> read(const std::string& text, std::optional<std::int64_t> timestep = {}) {
    return readGrainFile(TemporaryFile(".data", text).path, timestep);
}

/// Two grains, by all that a row has.
void expectBoth(const std::vector<GrainRow>& grains) {
    ASSERT_EQ(grains.size(), 2u);
    EXPECT_EQ(grains[0].radius, 0.5e-3);
    EXPECT_EQ(grains[0].position, Vec3D(0.25, -0.5, 1));
    EXPECT_EQ(grains[0].velocity, Vec3D(1, 2, 3));
    EXPECT_EQ(grains[0].angularVelocity, Vec3D(40, 50, 60));
    EXPECT_EQ(grains[0].type, 1);
    EXPECT_EQ(grains[0].density, 2500);
    EXPECT_EQ(grains[1].radius, 1e-3);
    EXPECT_EQ(grains[1].position, Vec3D(-1, 0, 0.125));
    EXPECT_EQ(grains[1].velocity, Vec3D(-1, 0, 0));
    EXPECT_EQ(grains[1].angularVelocity, Vec3D(0, 0, 7));
    EXPECT_EQ(grains[1].type, 2);
    EXPECT_EQ(grains[1].density, 7850);
}

const std::string header =
    "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 500\n\n2 atoms\n2 atom types\n\n"
    "-1 1 xlo xhi\n-1 1 ylo yhi\n0 2.5 zlo zhi\n0.0 0.0 0.0 xy xz yz\n\n";
const std::string velocities = "\nVelocities\n\n2 -1 0 0 0 0 7\n1 1 2 3 40 50 60 # the first\n";

TEST(LammpsData, readsSpheresInAnyOrder) {
    const std::string masses = "Masses\n\n1 1\n2 1\n\n", rest = "\nPair Coeffs # hooke\n\n1 7 8\n2 7 8\n";
    for (const std::string style : {"", " # sphere", " # granular"})
        expectBoth(read(header + masses + "Atoms" + style +
                        "\n\n2 2 0.002 7850 -1 0 0.125\n1 1 0.001 2500 0.25 -0.5 1\n" + rest + velocities));
    // A file with image flags, and one with hybrids.
    expectBoth(read(header +
                    "Atoms # sphere\n\n1 1 0.001 2500 0.25 -0.5 1 0 0 -1\n2 2 2e-3 7.85e3 -1 0 .125 1 0 0\n" +
                    velocities));
    expectBoth(read(header + "Atoms # hybrid\n\n1 1 0.25 -0.5 1 0.001 2500\n2 2 -1 0 0.125 0.002 7850\n" +
                    velocities));
    expectBoth(read(header +
                    "Atoms # hybrid sphere charge\n\n1 1 0.25 -0.5 1 0.001 2500 0.1\n"
                    "2 2 -1 0 0.125 0.002 7850 0.2\n" +
                    velocities));
    // A file as the scripts that compare with these codes write it: no velocities, no units.
    const auto still = read(
        "bed\n\n1 atoms\n1 atom types\n\n-0.05 0.05 xlo xhi\n-0.03 0.03 ylo yhi\n"
        "-0.1 0.05 zlo zhi\n\nAtoms\n\n1 1 0.002 2500 0.01 0.02 0.03\n");
    ASSERT_EQ(still.size(), 1u);
    EXPECT_EQ(still[0].velocity, Vec3D(0, 0, 0));
}

std::string dump(const std::string& columns, const std::string& rows, int timestep = 500, int atoms = 2,
                 const std::string& bounds = "pp pp ff\n-1 1\n-1 1\n0 2.5\n") {
    return "ITEM: TIMESTEP\n" + std::to_string(timestep) + "\nITEM: NUMBER OF ATOMS\n" +
           std::to_string(atoms) + "\nITEM: BOX BOUNDS " + bounds + "ITEM: ATOMS " + columns + "\n" + rows;
}

TEST(LammpsDump, readsColumnsByTheirNames) {
    expectBoth(read(dump("id type x y z vx vy vz fx fy fz omegax omegay omegaz radius density ",
                         "2 2 -1 0 0.125 -1 0 0 9 9 9 0 0 7 0.001 7850 \n"
                         "1 1 0.25 -0.5 1 1 2 3 9 9 9 40 50 60 0.0005 2500\n")));
    expectBoth(read(dump("density diameter zs ys xs type omegaz omegay omegax vz vy vx id c_ke f_a[1]",
                         "7850 0.002 0.05 0.5 0 2 7 0 0 0 0 -1 2 0.5 inf\n"
                         "2500 0.001 0.4 0.25 0.625 1 60 50 40 3 2 1 1 0.5 nan\n")));
    const auto byMass =
        read(dump("id radius mass xu yu zu", "1 0.001 1.0472e-05 0 0 0\n2 0.001 1e-5 0 0 1\n"));
    EXPECT_NEAR(byMass[0].density, 2500, 2500 * 5e-6);  // six digits of the mass
    EXPECT_EQ(byMass[0].type, 0);
}

TEST(LammpsDump, readsTheLastSnapshotOrTheChosenOne) {
    std::string text = "ITEM: UNITS\nsi\n";
    for (const int step : {0, 1000, 2000})
        text += dump("radius x y z", "0.001 " + std::to_string(step) + " 0 0\n0.001 0 0 0\n", step);
    EXPECT_EQ(read(text)[0].position.x(), 2000);
    EXPECT_EQ(read(text, 1000)[0].position.x(), 1000);
    EXPECT_EQ(read(text, 0)[0].position.x(), 0);
    EXPECT_TRUE(contains(refusal([&] { read(text, 500); }),
                         "no snapshot of time step 500; it has 3, from 0 to 2000"));
    // A run that was killed leaves a part of the last one.
    const std::string cut = text + dump("radius x y z", "0.001 0 0 0\n", 3000);
    EXPECT_TRUE(contains(refusal([&] { read(cut); }), "has 1 of 2 grains in its snapshot of time step 3000"));
    EXPECT_EQ(read(cut, 2000)[0].position.x(), 2000);
}

TEST(LammpsFiles, refuseWithFilePlaceAndReason) {
    struct Case {
        std::string text, place, reason;
    };
    const auto atoms = [](const std::string& rows) { return header + "Atoms # sphere\n\n" + rows; };
    const std::string first = "1 1 0.001 2500 0 0 0\n";
    const std::vector<Case> cases{
        {atoms(first), "", "2 atoms by its header, and 1 rows"},
        {atoms(first + first), "", "has grain 1 twice"},
        {atoms(first + "2 1 0.001 2500 0 0\n"), "line 14", "6 columns; a row of Atoms has 7"},
        {atoms(first + "2 1 0 2500 0 0 0\n"), "line 14", "the radius 0 m"},
        {atoms(first + "2 1 0.001 0 0 0 0\n"), "line 14", "the density 0 kg/m^3 must be greater"},
        {atoms(first + "2 sand 0.001 2500 0 0 0\n"), "line 14", "'sand' is not a whole number"},
        {atoms(first + "2 0 0.001 2500 0 0 0\n"), "line 14", "the type 0"},
        {atoms(first + "2 1 0.001 2500 0 0 1e300\n"), "line 14", "above 1e+09 m"},
        {header + "Atoms # atomic\n\n1 1 0 0 0\n", "line 11", "the style 'atomic'"},
        {header + "Atoms # hybrid bond sphere\n\n1 1 0 0 0\n", "line 11", "the style 'bond'"},
        {header + "Atoms # hybrid\n\n1 1 0 0 0 7 0.001 2500\n", "line 13", "8 columns"},
        {header + "Velocities\n\n1 0 0 0\n", "line 13", "no atom 1 in a section Atoms before"},
        {atoms(first + "2 1 0.001 2500 0 0 1\n") + "\nVelocities\n\n1 0 0 0 0 0 0\n", "",
         "1 rows in its section Velocities, and 2 in Atoms"},
        {"data, units = lj\n" + header.substr(header.find('\n') + 1) + "Atoms\n\n" + first, "", "units 'lj'"},
        {"ITEM: UNITS\nmetal\n" + dump("x y z radius", ""), "", "units 'metal'"},
        {dump("x y z", "0 0 0\n0 0 1\n"), "", "no column radius or diameter"},
        {dump("x y radius", "0 0 1\n0 0 1\n"), "", "no columns x, y and z"},
        {dump("x y z radius", "0 0 0 1\n0 0 1\n"), "line 11", "3 numbers; the dump has 4 columns"},
        {dump("x y z radius", "0 0 nan 1\n"), "line 10", "not finite"},
        {dump("xs ys zs radius", "0 0 0 1\n", 0, 1, "xy xz yz pp pp pp\n0 1 0\n0 1 0.5\n0 1 0\n"), "",
         "tilted"},
        {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n2\nITEM: ENTRIES index\n1\n2\n", "", "has no atoms"},
        {dump("x y z radius", "", 0, -3), "line 4", "there are -3 atoms"},
        {dump("x y z radius", "", 0, 2000000000), "", "has 0 of 2000000000 grains"},
    };
    for (const Case& c : cases) {
        const std::string text = refusal([&] { read(c.text); });
        EXPECT_TRUE(isOneSentence(text)) << c.reason;
        EXPECT_TRUE(contains(text, "The grain file "));
        EXPECT_TRUE(contains(text, c.place)) << c.reason;
        EXPECT_TRUE(contains(text, c.reason));
    }
    EXPECT_TRUE(contains(refusal([] { read("1e-3 0 0 0\n", 7); }), "is no dump"));
}

using Grain = Species<LinearViscoelastic>;

Grain material(double density) {
    Grain species;
    species.setDensity(density);
    species.setStiffness(1e3);
    return species;
}

TEST(AddGrains, givesTypesTheirSpecies) {
    FewGrains<Grain> scene(material(2500), {}, 1e-6);
    const Grain* const glass = scene.speciesHandler.getObject(0);
    const Grain* const steel = scene.speciesHandler.copyAndAddObject(material(7850));
    const auto rows =
        read(header + "Atoms # sphere\n\n2 2 0.002 7850 -1 0 0.125\n1 1 0.001 2500.04 0.25 -0.5 1\n" +
             velocities);  // 1.6e-5 of the density is what six digits leave open
    addGrains(scene.particleHandler, rows, glass, steel);
    ASSERT_EQ(scene.particleHandler.getSize(), 2u);
    const GrainReference first = scene.particleHandler.getObject(0),
                         second = scene.particleHandler.getObject(1);
    EXPECT_EQ(first.getSpeciesIndex(), 0);
    EXPECT_EQ(second.getSpeciesIndex(), 1);
    EXPECT_EQ(first.getPosition(), Vec3D(0.25, -0.5, 1));
    EXPECT_EQ(first.getVelocity(), Vec3D(1, 2, 3));
    EXPECT_EQ(second.getRadius(), 1e-3);
    EXPECT_NEAR(second.getMass() / sphereMass(1e-3, 7850), 1, 1e-14);

    const auto refused = [&](const auto*... species) {
        return refusal([&] { addGrains(scene.particleHandler, rows, species...); });
    };
    EXPECT_TRUE(isOneSentence(refused(glass)));
    EXPECT_TRUE(contains(refused(glass), "grain 1 (counted from 0) has type 2, and there is one species"));
    EXPECT_TRUE(
        contains(refused(glass, glass), "grain 1 (counted from 0), of type 2, has a density of 7850 kg/m^3"));
    EXPECT_TRUE(
        contains(refused(steel, glass), "species 7850 kg/m^3; all grains of a species have its density"));
    EXPECT_EQ(scene.particleHandler.getSize(), 2u) << "all or none";
    const auto untyped = read("1e-3 0 0 0\n");
    EXPECT_TRUE(
        contains(refusal([&] { addGrains(scene.particleHandler, untyped, glass, steel); }), "has no type"));
    addGrains(scene.particleHandler, untyped, glass);
    SphericalParticle held;
    held.setSpecies(steel), held.fixParticle();
    addGrains(scene.particleHandler, untyped, std::vector{held});
    EXPECT_EQ(scene.particleHandler.getSize(), 4u);
    EXPECT_TRUE(scene.particleHandler.getObject(3).isFixed());
}

}  // namespace
}  // namespace pendular::lammpsTest
