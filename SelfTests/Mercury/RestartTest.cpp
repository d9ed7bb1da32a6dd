// Restart files of MercuryDPM's: real ones of several versions, and each form of line in texts of our own.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/MercuryScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryRestartTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

const RegisteredSpecies<LinearPlasticViscoelasticSpecies> plastic;

/// The numbers behind a word of a line, as streams read them; none where it is not there.
std::vector<double> numbersBehind(const std::string& line, const std::string& word) {
    std::vector<double> numbers;
    const std::size_t at = line.find(" " + word + " ");
    if (at == std::string::npos) return numbers;
    std::istringstream text(line.substr(at + word.size() + 2));
    for (double number = 0; text >> number;) numbers.push_back(number);
    return numbers;
}
Vec3D vectorBehind(const std::string& line, const std::string& word) {
    const std::vector<double> numbers = numbersBehind(line, word);
    return numbers.size() < 3 ? Vec3D(NAN, NAN, NAN) : Vec3D(numbers[0], numbers[1], numbers[2]);
}

/// The lines of the section of a file that begins with a word.
std::vector<std::string> sectionOf(const std::filesystem::path& path, const std::string& word) {
    std::ifstream file(path);
    std::vector<std::string> rows;
    std::size_t left = 0;
    for (std::string line; std::getline(file, line);) {
        if (left > 0) rows.push_back(line), --left;
        else if (line.starts_with(word + " ")) left = std::stoul(line.substr(word.size()));
    }
    return rows;
}

/// The particles of a scene are those of the file, to the last digit.
void expectParticles(Mercury3D& scene, const std::filesystem::path& file) {
    const std::vector<std::string> rows = sectionOf(file, "Particles");
    ASSERT_EQ(scene.particleHandler.getSize(), rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const GrainReference grain = scene.particleHandler.getObject(k);
        SCOPED_TRACE(rows[k].substr(0, 60));
        if (rows[k].starts_with("TSP")) {  // version 3: position, velocity, radius, angles, spin, 1/mass
            std::istringstream text(rows[k].substr(6));
            std::vector<double> row;
            for (double number = 0; text >> number;) row.push_back(number);
            EXPECT_EQ(grain.getPosition(), Vec3D(row.at(0), row.at(1), row.at(2)));
            EXPECT_EQ(grain.getVelocity(), Vec3D(row.at(3), row.at(4), row.at(5)));
            EXPECT_EQ(grain.getRadius(), row.at(6));
            EXPECT_EQ(grain.getAngularVelocity(), Vec3D(row.at(10), row.at(11), row.at(12)));
            EXPECT_EQ(grain.isFixed(), row.at(13) == 0);
            continue;
        }
        EXPECT_EQ(grain.getPosition(), vectorBehind(rows[k], "position"));
        EXPECT_EQ(grain.getVelocity(), vectorBehind(rows[k], "velocity"));
        EXPECT_EQ(grain.getRadius(), numbersBehind(rows[k], "radius").at(0));
        EXPECT_EQ(grain.getSpeciesIndex(), numbersBehind(rows[k], "indSpecies").at(0));
        const double inverseMass = numbersBehind(rows[k], "invMass").at(0);
        EXPECT_EQ(grain.isFixed(), inverseMass == 0);
        if (inverseMass == 0) continue;
        EXPECT_NEAR(grain.getMass() * inverseMass, 1, 1e-13);  // 15 digits, and a cube
    }
}

// Files that MercuryDPM's self-tests have left, of the versions 1.0, 0.14 and 3: read, or refused by the name
// of what is in them.
TEST(MercuryRestart, realFilesAreReadOrRefusedByName) {
    if (!support::hasSharedData("mercury-restart"))
        GTEST_SKIP() << support::withoutSharedData("mercury-restart");
    const std::map<std::string, std::string> refused{
        {"ConstantMassFlowMaserSelfTest.restart", "'ConstantMassFlowMaserBoundary'"},
        {"FullRestartSelfTestRestarted.restart", "'Coil'"},
        {"NurbsWallEdgeCaseSelfTest.restart", "'NurbsWall'"},
        {"SinterBed0.restart", "'SinterFrictionSpecies'"},
        {"SubcriticalMaserBoundaryTESTMPI2Test.restart0", "'SubcriticalMaserBoundaryTEST'"}};
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(support::sharedData("mercury-restart"))) {
        const std::string name = entry.path().filename().string();
        if (name.find(".restart") == std::string::npos) continue;
        SCOPED_TRACE(name);
        ++files;
        EXPECT_TRUE(isMercuryRestart(entry.path()));
        Mercury3D scene;
        scene.setQuiet();
        std::string said = refusal([&] { scene.readRestartFile(entry.path()); });
        // The path itself may have points.
        if (const auto at = said.find(entry.path().string()); at != std::string::npos)
            said.replace(at, entry.path().string().size(), "FILE");
        if (const auto found = refused.find(name); found != refused.end()) {
            EXPECT_TRUE(isOneSentence(said) && contains(said, found->second)) << said;
            continue;
        }
        EXPECT_EQ(said, "");
        expectParticles(scene, entry.path());
        EXPECT_EQ(scene.wallHandler.getSize(), sectionOf(entry.path(), "Walls").size());
        EXPECT_EQ(scene.boundaryHandler.getSize(), sectionOf(entry.path(), "Boundaries").size());
    }
    EXPECT_GE(files, 12u);
}

const std::string head =
    "MercuryDPM 1.0 name Small revision 1 repository here\n"
    "dataFile    fileType ONE_FILE saveCount 20 counter 3 lastSavedTimeStep 40\n"
    "interactionFile fileType NO_FILE saveCount 0 counter 0\n"
    "xMin -1 xMax 2 yMin -2 yMax 3 zMin -3 zMax 4\n"
    "timeStep 0.001 time 0.5 ntimeSteps 500 timeMax 0.6\n"
    "systemDimensions 3 particleDimensions 3 gravity 0 0 0 backgroundDrag 0 writeVTK 0 NO_FILE random 0 "
    "1103\n";
const std::string oneSpecies =
    "Species 1\nLinearViscoelasticSpecies id 0 density 3 stiffness 1000 dissipation 0\n";
const std::string noWalls = "Walls 0\nBoundaries 0\n";

std::string particle(int id, const std::string& place, const std::string& more = "", double radius = 0.5) {
    return fmt::format(
        "BaseParticle id {} indSpecies 0 position {} orientation 1 0 0 0 velocity 0 0 0 angularVelocity 0 0 "
        "0 force 0 0 0 "
        "torque 0 0 0 radius {} {}\n",
        id, place, radius, more);
}

/// A scene of a text.
struct Restarted : Mercury3D {
    explicit Restarted(const std::string& text) {
        setQuiet();
        helpers::writeToFile(folder.name() + ".restart", text);
        readRestartFile(folder.name() + ".restart");
        setName(folder.name());
        setFileType(FileType::NO_FILE);
    }
    TestFolder folder;
};

TEST(MercuryRestart, headTimeAndParticles) {
    // Ids may have gaps, and a fixed particle moves with the velocity that it has.
    Restarted scene(
        head + oneSpecies + noWalls + "Particles 2\n" + particle(7, "0 0 0") +
        "SphericalParticle id 1200 indSpecies 0 position 0 0 2 velocity 0.25 0 0 angularVelocity 0 0 2 "
        "radius 0.25 invMass 0 timeStamp 0\nInteractions 0\nhGrid method TOPDOWN\n");
    EXPECT_EQ(scene.getMin(), Vec3D(-1, -2, -3));
    EXPECT_EQ(scene.getMax(), Vec3D(2, 3, 4));
    EXPECT_EQ(scene.getTimeStep(), 1e-3);
    EXPECT_EQ(scene.getTimeMax(), 0.6);
    EXPECT_EQ(scene.getTime(), 0.5);
    const GrainReference fixed = scene.particleHandler.getObject(1);
    EXPECT_TRUE(fixed.isFixed());
    scene.solve();
    // It goes on from the time of the file: a hundred steps to its end.
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 100u);
    EXPECT_NEAR(scene.getTime(), 0.6, 1e-12);
    EXPECT_NEAR(fixed.getPosition().x(), 0.025, 1e-15);
}

// A plane by an orientation (the turn of the axis x), by a normal and a point, and by a normal and a
// distance.
TEST(MercuryRestart, planesOfAllForms) {
    const std::string motion = "velocity 0 0 0 angularVelocity 0 0 0 force 0 0 0 torque 0 0 0";
    const double half = std::sqrt(0.5);
    struct Case {
        std::string line;
        Vec3D normal, point;
    };
    for (const auto& [line, normal, point] :
         std::vector<Case>{{"position 0 0 -0.5 orientation 0.707106781186548 0 0.707106781186548 0 " + motion,
                            {0, 0, -1},
                            {0, 0, -0.5}},
                           {"position 1 0 0 orientation 1 0 0 0 " + motion, {1, 0, 0}, {1, 0, 0}},
                           {"position 0 2 0 orientation 0.707106781186548 0 0 0.707106781186548 " + motion,
                            {0, 1, 0},
                            {0, 2, 0}},
                           // A turn by 45 degrees about y: cos and sin of half of it.
                           {"position 0 0 0 orientation 0.923879532511287 0 0.38268343236509 0 " + motion,
                            {half, 0, -half},
                            {0, 0, 0}},
                           {"position 0 0 0.5 orientation 0 0 0 1 velocity 0 0 0 normal 0 0 1 factor 1",
                            {0, 0, 1},
                            {0, 0, 0.5}},
                           {"position 0 0 0 orientation 0 0 0 0 velocity 0 0 0 angularVelocity 0 0 0 0 force "
                            "0 0 0 torque 0 0 0 "
                            "normal 0 0 -1 position -1.5 factor 1",
                            {0, 0, -1},
                            {0, 0, 1.5}}}) {
        SCOPED_TRACE(line);
        Restarted scene(head + oneSpecies + "Walls 1\nInfiniteWall id 0 indSpecies 0 " + line +
                        "\nBoundaries 0\nParticles 0\nInteractions 0\n");
        const auto* const plane = dynamic_cast<const InfiniteWall*>(scene.wallHandler.getObject(0));
        ASSERT_TRUE(plane);
        EXPECT_LT((toEigen(plane->drivenNormal()) - normal).norm(), 4e-15);
        EXPECT_NEAR(normal.dot(toEigen(plane->pointOnPlane()) - point), 0, 1e-15);
        // Along an axis it is so to the bit, as the planes of a box must be.
        if (normal.cwiseAbs().maxCoeff() < 1) continue;
        EXPECT_EQ(toEigen(plane->drivenNormal()), normal);
    }
}

// The solid of a wedge, whose planes are turned and put with it: the distance of a grain from one of its
// faces.
TEST(MercuryRestart, wallsOfSeveralPlanes) {
    // Two half-spaces of the own frame, {x > 0} and {z < 0}, turned by 90 degrees about z, at (0, 0, 1).
    Restarted scene(
        head + oneSpecies +
        "Walls 1\nIntersectionOfWalls id 0 indSpecies 0 position 0 0 1 orientation 0.707106781186548 0 0 "
        "0.707106781186548 velocity 0 0 0 angularVelocity 0 0 0 force 0 0 0 torque 0 0 0 "
        "numIntersectionOfWalls 2 position 0.5 0 0 orientation 1 0 0 0 position 0 0 0 orientation "
        "0.707106781186548 0 0.707106781186548 0\nBoundaries 0\nParticles 0\nInteractions 0\n");
    // The solid is {y > 0.5, z < 1}.
    SphericalParticle grain(scene.speciesHandler.getObject(0));
    grain.setRadius(0.4);
    double distance = 0;
    Vec3D normal;
    grain.setPosition({0.3, 0.2, 0.1});
    ASSERT_TRUE(scene.wallHandler.getObject(0)->getDistanceAndNormal(grain, distance, normal));
    EXPECT_NEAR(distance, 0.3, 1e-14);
    EXPECT_LT((normal - Vec3D(0, 1, 0)).norm(), 1e-14);
    grain.setPosition({0.3, 1.2, 1.25});
    ASSERT_TRUE(scene.wallHandler.getObject(0)->getDistanceAndNormal(grain, distance, normal));
    EXPECT_NEAR(distance, 0.25, 1e-14);
    EXPECT_LT((normal - Vec3D(0, 0, -1)).norm(), 1e-14);
}

TEST(MercuryRestart, boundariesOfAllForms) {
    for (const char* const period :
         {"PeriodicBoundary id 0 normal 0 1 0 scaleFactor 1 distanceLeft -2 distanceRight 3 shift 0 5 0",
          "PeriodicBoundary normal 0 1 0 position_left -2 position_right 3 shift 0 5 0"}) {
        Restarted scene(
            head + oneSpecies + "Walls 0\nBoundaries 2\n" + std::string(period) +
            "\nDeletionBoundary id 1 normal 0 0 -1 scaleFactor 1 distance 2 numberOfParticlesDeleted 4 "
            "massDeleted 1 volumeDeleted 1 isActivated 1 trackOutflow 0\nParticles 2\n" +
            particle(0, "0 2.75 0") + particle(1, "0 0 -2.5") + "Interactions 0\n");
        GrainReference grain = scene.particleHandler.getObject(0);
        grain.setVelocity({0, 5, 0});
        scene.solve();  // 0.1 s
        // Up to the period, by which it is brought back some time.
        EXPECT_NEAR(std::remainder(grain.getPosition().y() - (2.75 + 0.5), 5.0), 0, 1e-12);
        EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    }
}

TEST(MercuryRestart, speciesAndPairsByTheirNames) {
    Restarted scene(head +
                    "Species 2\n"
                    "HertzianViscoelasticMindlinSpecies id 0 density 2500 elasticModulus 5e8 dissipation 0.5 "
                    "slidingDissipation 0 "
                    "slidingFrictionCoefficient 0.3 slidingFrictionCoefficientStatic 0.3 shearModulus 1e8\n"
                    "HertzianViscoelasticMindlinSpecies id 1 density 2000 elasticModulus 3e8 dissipation "
                    "0.25 slidingDissipation 0 "
                    "slidingFrictionCoefficient 0.4 slidingFrictionCoefficientStatic 0.4 shearModulus 6e7\n"
                    "HertzianViscoelasticMindlinMixedSpecies idA 1 idB 0 elasticModulus 2e8 dissipation "
                    "0.125 slidingDissipation 0 "
                    "slidingFrictionCoefficient 0.2 slidingFrictionCoefficientStatic 0.2 shearModulus 4e7\n" +
                    noWalls + "Particles 0\nInteractions 0\n");
    EXPECT_EQ(scene.speciesHandler.getObject(1)->get("effectiveElasticModulus"), 3e8);
    EXPECT_EQ(scene.speciesHandler.getObject(0)->get("effectiveShearModulus"), 1e8);
    EXPECT_EQ(scene.speciesHandler.getObject(0)->getDensity(), 2500);
    AnyLaws* const pair =
        scene.speciesHandler.setPairTypeByName(0, 1, "HertzianViscoelasticMindlinSpecies");  // what it has
    EXPECT_EQ(pair->get("effectiveElasticModulus"), 2e8);
    EXPECT_EQ(pair->get("slidingFrictionCoefficient"), 0.2);
    // Without friction a stiffness of 0 is none.
    Restarted plain(
        head +
        "Species 1\nLinearViscoelasticSlidingFrictionSpecies id 0 density 1 stiffness 10 dissipation 0 "
        "slidingStiffness 0 slidingDissipation 0 slidingFrictionCoefficient 0 "
        "slidingFrictionCoefficientStatic 0\n" +
        noWalls + "Particles 0\nInteractions 0\n");
    EXPECT_FALSE(isSet(plain.speciesHandler.getObject(0)->get("slidingStiffness")));
}

/// Two particles that touch along x, with the ids 7 and 3, and what their contact remembers.
Restarted twoOfFriction(const std::string& contact) {
    return Restarted(
        head +
        "Species 1\nLinearViscoelasticFrictionSpecies id 0 density 3 stiffness 1000 dissipation 0 "
        "slidingStiffness 300 "
        "slidingDissipation 0 slidingFrictionCoefficient 50 slidingFrictionCoefficientStatic 50 "
        "rollingStiffness 200 "
        "rollingDissipation 0 rollingFrictionCoefficient 50 rollingFrictionCoefficientStatic 50 "
        "torsionStiffness 100 "
        "torsionDissipation 0 torsionFrictionCoefficient 50 torsionFrictionCoefficientStatic 50\n" +
        noWalls + "Particles 2\n" + particle(7, "0 0 0") + particle(3, "0.98 0 0") +
        "Interactions 1\nLinearViscoelasticFrictionInteraction particleIds " + contact + "\n");
}

// Springs give their forces at once: of a contact by its bodies in either order. In MercuryDPM the force on P
// is -k_t s, and n x (-k_r r) and -k_o t times the lever 2 R* the torques (FrictionInteraction), n from I to
// P.
TEST(MercuryRestart, contactsHaveTheirSprings) {
    const Vec3D sliding(0, 2e-3, -1e-3), rolling(0, 1e-3, 3e-3), torsion(4e-3, 0, 0);
    for (const bool turned : {false, true}) {
        const double sign = turned ? -1 : 1;
        const auto text = [&](const Vec3D& v) {
            return fmt::format("{} {} {}", sign * v.x(), sign * v.y(), sign * v.z());
        };
        // Rolling is -L n x (w_P - w_I): both n and the spin change their sign with the order.
        Restarted scene = twoOfFriction(fmt::format(
            "{} timeStamp 500 contactPoint 0.49 0 0 force 0 0 0 torque 0 0 0 slidingSpring {} rollingSpring "
            "{} {} {} "
            "torsionSpring {}",
            turned ? "3 7" : "7 3", text(sliding), rolling.x(), rolling.y(), rolling.z(), text(torsion)));
        scene.initialise();
        const GrainReference p = scene.particleHandler.getObject(0), i = scene.particleHandler.getObject(1);
        const Vec3D n(-1, 0, 0), tangential = -300 * sliding;
        const Vec3D force = 1000 * 0.02 * n + tangential;
        EXPECT_LT((p.getForce() - force).norm(), 1e-13 * force.norm());
        EXPECT_LT((i.getForce() + force).norm(), 1e-13 * force.norm());
        const double lever = 0.5;  // m, 2 R* of equal grains: their radius
        const Vec3D turning = lever * (n.cross(Vec3D(-200 * rolling)) - 100 * torsion);
        const Vec3D arm = (0.5 - 0.01) * -n;  // m, from the centre of P to the middle of the overlap
        EXPECT_LT((p.getTorque() - (arm.cross(tangential) + turning)).norm(), 1e-13);
        EXPECT_LT((i.getTorque() - (arm.cross(tangential) - turning)).norm(), 1e-13);
    }
}

// A run that began with such a file goes on from the kernel's own restart file, with the same bits.
TEST(MercuryRestart, aRunFromItGoesOnFromItsOwnRestartFile) {
    const std::string contact =
        "7 3 slidingSpring 0 2e-3 -1e-3 rollingSpring 0 1e-3 3e-3 torsionSpring 4e-3 0 0";
    Restarted whole = twoOfFriction(contact), resumed = twoOfFriction(contact);
    whole.runTo(0.52);
    whole.writeRestart(whole.folder.path() / "middle.h5");
    resumed.restartFrom(whole.folder.path() / "middle.h5");
    resumed.runTo(0.55);
    whole.runTo(0.55);
    EXPECT_EQ(resumed.getNumberOfTimeSteps(), 50u);
    EXPECT_EQ(resumed.getTime(), whole.getTime());
    for (const std::size_t k : {0, 1}) {
        const GrainReference one = whole.particleHandler.getObject(k),
                             other = resumed.particleHandler.getObject(k);
        EXPECT_EQ(one.getPosition(), other.getPosition());
        EXPECT_EQ(one.getAngularVelocity(), other.getAngularVelocity());
        EXPECT_GT(one.getAngularVelocity().norm(), 1e-3);
    }
    whole.finishRun(), resumed.finishRun();
}

// The force of a plastic contact with its largest overlap, as MercuryDPM's PlasticForceUnitTest1.1.restart
// has it.
TEST(MercuryRestart, plasticContactsAreFlattened) {
    const std::string species =
        "Species 1\nLinearPlasticViscoelasticSpecies id 0 density 1.90985931710274 loadingStiffness 100 "
        "maxUnloadingStiffness 500 cohesionStiffness 100 maxPenetration 0.05 dissipation 0\n";
    Restarted scene(head + species + noWalls + "Particles 2\n" +
                    particle(0, "1.00840467123501 1 1", "invMass 1") +
                    particle(1, "1.99159532876499 1 1", "invMass 1") +
                    "Interactions 1\nLinearPlasticViscoelasticInteraction particleIds 0 1 timeStamp 100 "
                    "contactPoint 1.5 1 "
                    "1 force -0.95281436606263 0 0 torque 0 0 0 maxOverlap 0.0196972734270182\n");
    scene.acceptOverlaps(0.1);
    scene.initialise();
    // The overlap is known to 1e-14 m by the 15 digits of both places, the slope of unloading is 352 N/m.
    EXPECT_NEAR(scene.particleHandler.getObject(0)->getForce().x(), -0.95281436606263, 4e-12);
    EXPECT_NEAR(scene.particleHandler.getObject(1)->getForce().x(), 0.95281436606263, 4e-12);
}

// Versions 2 and 3: numbers in a fixed order. A particle has its springs itself, against the one with the
// number behind them, or against a wall; those whose time is over do not count.
TEST(MercuryRestart, versionsWithFewNames) {
    const auto text = [](const std::string& version, const std::string& box, const std::string& particles) {
        return "restart_version " + version + "\nname old\nxmin 0 xmax 3 ymin 0 ymax 20 zmin 0 zmax 2\n" +
               "dt 0.001 t 0.5 tmax 1 save_count" + (version == "2" ? "" : "_data") +
               " 7\ndim 3 gravity 0 0 0\n" +
               "options_fstat 1 options_data 1\nSpecies 1\n"
               "k 1000 disp 0 kt 300 dispt 0 mu 50 rho 3 dim_particle 3\n" +
               box + "Particles " + particles + "NUM_BUCKETS 256\n";
    };
    const std::string of2 = text("2",
                                 "Walls 1\nnumFiniteWalls 0 normal 0 0 -1 position 1.7\nWallsPeriodic 1\n"
                                 "normal 0 1 0 pos_left 0 pos_right 20 shift 0 20 0\n",
                                 "2\n1 1 1 0 0 0 0.5 0 0 0 0 0 0 0 0 0\n"
                                 "1.98 1 1 0 0 0 0.5 0 0 0 0 0 0 0.636619772 6.36619772 2 "
                                 "0 2e-3 -1e-3 0 -1 0.5 9 9 9 0 -1 0.4\nFixedParticles 0\n"),
                      of3 = text(
                          "3",
                          "Walls 1\nInfiniteWall normal 0 0 -1 position 1.7\nBoundaries 1\n"
                          "PeriodicBoundary normal 0 1 0 position_left 0 position_right 20 shift 0 20 0\n",
                          "2\nTSP BP 1 1 1 0 0 0 0.5 0 0 0 0 0 0 0 0 0 0\n"
                          "TSP BP 1.98 1 1 0 0 0 0.5 0 0 0 0 0 0 0.636619772 6.36619772 0 2 "
                          "0 2e-3 -1e-3 0 0 0 0 0 0 0 -1 0.5 9 9 9 0 0 0 0 0 0 0 -1 0.4\n");
    for (const std::string& one : {of2, of3}) {
        Restarted scene(one);
        EXPECT_EQ(scene.speciesHandler.getObject(0)->getName(), "LinearViscoelasticSlidingFrictionSpecies");
        EXPECT_EQ(scene.wallHandler.getSize(), 1u);
        EXPECT_EQ(scene.boundaryHandler.getSize(), 1u);
        EXPECT_TRUE(scene.particleHandler.getObject(0)->isFixed());
        scene.initialise();
        // The spring is of the second one against the first.
        const Vec3D force = Vec3D(20, -0.6, 0.3);
        EXPECT_LT((scene.particleHandler.getObject(1)->getForce() - force).norm(), 1e-12 * force.norm());
        EXPECT_LT((scene.particleHandler.getObject(0)->getForce() + force).norm(), 1e-12 * force.norm());
    }
    const auto said = [&](const std::string& one) { return refusal([&] { Restarted scene(one); }); };
    std::string other = of3;
    other.replace(other.find("mu 50"), 5, "ForceType 3");
    EXPECT_TRUE(isOneSentence(said(other)) && contains(said(other), "'ForceType' = 3")) << said(other);
    other = of2;
    other.replace(other.find("FixedParticles 0"), 16, "FixedParticles 2");
    EXPECT_TRUE(isOneSentence(said(other)) && contains(said(other), "FixedParticles")) << said(other);
}

// What a file has and a driver must set up itself; each sentence has the line.
TEST(MercuryRestart, saysWhatItDoesNotTakeOver) {
    const auto said = [&](const std::string& text) { return refusal([&] { Restarted scene(text); }); };
    const std::string start = head + oneSpecies,
                      two = "Particles 2\n" + particle(0, "0 0 0") + particle(1, "0.99 0 0"),
                      apart = "Particles 2\n" + particle(0, "0 0 0") + particle(1, "1.25 0 0"),
                      contact = "Interactions 1\nLinearViscoelasticInteraction particleIds 0 1 timeStamp 3 ";
    EXPECT_EQ(said(start + noWalls + two + contact + "force 0 0 1 slidingSpring 0 0 0 wasInContact 1\n"), "");
    struct Case {
        std::string text, phrase;
        int line;  // 0: none
    };
    for (const auto& [text, phrase, line] : std::vector<Case>{
             {head + "Species 1\nThermalLinearViscoelasticSpecies id 0 density 1\n" + noWalls +
                  "Particles 0\n",
              "'ThermalLinearViscoelasticSpecies'", 8},
             {head + "Species 1\nLinearViscoelasticSpecies id 0 density 1 stiffness 0 dissipation 0\n" +
                  noWalls + "Particles 0\n",
              "stiffness = 0", 8},
             {head + "Species 1\nLinearViscoelasticSpecies id 0 density 1 hardness 3\n" + noWalls +
                  "Particles 0\n",
              "hardness", 8},
             {head +
                  "Species 1\nLinearViscoelasticFrictionSpecies id 0 density 1 stiffness 1 "
                  "rollingFrictionCoefficient 0.1 "
                  "rollingFrictionCoefficientStatic 0.2\n" +
                  noWalls + "Particles 0\n",
              "rollingFrictionCoefficientStatic is not", 8},
             {start + "Walls 1\nScrew id 0 indSpecies 0\n", "'Screw'", 10},
             {start + "Walls 1\nInfiniteWall id 0 indSpecies 0 position 0 0 0\n", "orientation nor normal",
              10},
             {start + "Walls 1\nInfiniteWall id 0 indSpecies 0 position 0 0 0 orientation 0 0 0 0\n",
              "0 0 0 0", 10},
             {start + "Walls 1\nInfiniteWall id 0 indSpecies 4 position 0 0 0 orientation 1 0 0 "
                      "0\nBoundaries 0\nParticles 0\n",
              "indSpecies is 4", 10},
             {start + "Walls 0\nBoundaries 1\nLeesEdwardsBoundary id 0 left 0\n", "'LeesEdwardsBoundary'",
              11},
             {start + "Walls 0\nBoundaries 1\nPeriodicBoundary id 0 normal 0.6 0.8 0 distanceLeft 0 "
                      "distanceRight 1\n",
              "(0.6, 0.8, 0)", 11},
             {start + "Walls 0\nBoundaries 1\nPeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 "
                      "distanceRight 1 shift 1 1 0\n",
              "the shift (1, 1, 0)", 11},
             {start + noWalls + "Particles 1\nSuperQuadric id 0\n", "'SuperQuadric'", 12},
             {start + noWalls + "Particles 1\n" + particle(0, "0 0 0", "temperature 300"),
              "'temperature' = 300", 12},
             {start + noWalls + "Particles 1\n" + particle(0, "0 0 0", "invMass 2"),
              "by the density of its species", 12},
             {start + noWalls +
                  "Particles 1\nBaseParticle indSpecies 0 position 0 0 1 velocity 0 0 0 radius\n",
              "a number is missing", 12},
             {start + noWalls +
                  "Particles 1\nBaseParticle indSpecies 0 position 0 0 1 velocity 0 0 0 radius big\n",
              "big", 12},
             {start + noWalls + "Particles 2\n" + particle(0, "0 0 0"), "the file ends here", 12},
             {start + noWalls + "Particles -1\n", "must be a whole number", 11},
             {start + noWalls + two + contact + "liquidBridgeVolume 1e-12\n", "'liquidBridgeVolume' = 1e-12",
              15},
             {start + noWalls + apart + contact + "wasInContact 1\n", "a bridge that is stretched", 15},
             {start + noWalls + two + "Interactions 1\nLinearViscoelasticInteraction particleIds 0 9\n",
              "the id 9", 15},
             {start + noWalls, "has no section Particles", 0},
             {head, "has no section Species", 0},
             {"MercuryDPM 1.0 name S\nbackgroundDrag 2\n", "backgroundDrag is 2", 2},
             {"MercuryDPM 1.0 name S\nxMax\n", "a number is missing", 2}}) {
        const std::string found = said(text);
        EXPECT_TRUE(isOneSentence(found) && contains(found, phrase)) << text << found;
        const std::string place = line > 0 ? fmt::format("line {}", line) : std::string("has no section");
        EXPECT_TRUE(contains(found, place)) << text << found;
    }
    // A spring that the friction of the species has not, when the contacts are there.
    Restarted scene(start + noWalls + two + contact + "slidingSpring 0 1e-9 0\n");
    const std::string spring = refusal([&] { scene.initialise(); });
    EXPECT_TRUE(isOneSentence(spring) && contains(spring, "particles 0 and 1")) << spring;
}

// Damaged texts, and such as were made to do harm: one sentence each, whatever their numbers are.
TEST(MercuryRestart, damagedTextsAreRefused) {
    const auto said = [&](const std::string& text) { return refusal([&] { Restarted scene(text); }); };
    const std::string start = head + oneSpecies, one = particle(0, "0 0 0"), other = particle(0, "0.99 0 0"),
                      contact = "Interactions 1\nLinearViscoelasticInteraction particleIds 0 0 ",
                      old =
                          "name old\nxmin 0 xmax 3\ndt 0.001 t 0.5 tmax 1\nSpecies 1\nk 1000 disp 0 rho 3 "
                          "dim_particle 3\nWalls 0\nParticles 1\n";
    for (const auto& [text, phrase] : std::vector<std::pair<std::string, std::string>>{
             {start + noWalls + "Particles 999999999\n" + one, "the file ends here"},
             {start + noWalls + "Particles 1e300\n", "Particles is 1e+300"},
             {start + noWalls + "Particles nan\n", "Particles is nan; it must be finite"},
             {start + noWalls + "Particles 1\n" + particle(0, "0 nan 0"), "position is nan"},
             {start + noWalls + "Particles 1\n" + particle(0, "0 0 0", "invMass -1"), "invMass is -1"},
             {start + noWalls + "Particles 1\n" + particle(0, "0 0 0", "invMass inf"), "invMass is inf"},
             {start + noWalls + "Particles 1\n" + one + particle(1, "2 0 0"), "beyond the number"},
             {start + noWalls + "Particles 2\n" + one + other + contact,
              "more than one particle with the id 0"},
             {start + noWalls + "Particles 1\n" + one + contact + "slidingSpring 0 nan 0\n",
              "slidingSpring is nan"},
             {start + "Walls 1\nIntersectionOfWalls id 0 indSpecies 0 position 0 0 0 orientation 1 0 0 0 "
                      "numIntersectionOfWalls 999999999\n",
              "0 of its 999999999 planes"},
             {head + "Species 1\nLinearViscoelasticSpecies id 0 density nan stiffness 1\n" + noWalls +
                  "Particles 0\n",
              "density"},
             {start + "LinearViscoelasticMixedSpecies idMixed -1 1e300 stiffness 3\n", "idMixed is -1"},
             {"MercuryDPM 1.0 name S\ntimeStep nan\n", "timeStep is nan"},
             {"restart_version 2\n" + old + "1 1 1 0 0 0 0.5 0 0 0 0 0 0 0 0 1e300\n", "1e+300"},
             {"restart_version 3\n" + old + "BP 1 1 1 0 0 0 0.5 0 0 0 0 0 0 0 0 -3\n", "is -3"}}) {
        const std::string found = said(text);
        EXPECT_TRUE(isOneSentence(found) && contains(found, phrase)) << text << found;
    }
    // A long line, and a text of many words that are passed over.
    std::string many = start + noWalls + "Particles 0\n";
    for (int k = 0; k < 1000; ++k) many += fmt::format("word{} 1\n", k);
    TestFolder folder;
    helpers::writeToFile(folder.name(), many);
    const MercuryRestart read = readMercuryRestart(folder.name());
    EXPECT_EQ(read.passedOver.size(), 100u);
    EXPECT_EQ(read.passedOver.at("others"), 901u);
    std::string line = "MercuryDPM 1.0 name S\n";
    for (int k = 0; k <= 1'000'000; ++k) line += "0 ";
    const std::string tooLong = said(line + "\n");
    EXPECT_TRUE(isOneSentence(tooLong) && contains(tooLong, "line 2")) << tooLong;
}

// What real files have that no other test does: outputs that are never written, and names of runs.
TEST(MercuryRestart, headsOfAllKinds) {
    const TestFolder folder;
    const std::string file = folder.name() + ".restart", rest = oneSpecies + noWalls + "Particles 0\n";
    const auto nameIn = [&](const std::string& first, const std::string& now) {
        std::string text = head + rest;
        text.replace(text.find(first), first.size(), now);
        helpers::writeToFile(file, text);
        Mercury3D scene;
        scene.setQuiet();
        scene.readRestartFile(folder.name());  // the ending may be left out, as there
        return scene.getName();
    };
    EXPECT_EQ(nameIn("saveCount 20", "saveCount 4294967295"), "Small");
    EXPECT_EQ(nameIn("name Small", "name time"), "time");
    EXPECT_EQ(nameIn("name Small", "name runs/Small"), "runs/Small");
    // Whoever wrote the file does not choose where this program writes.
    for (const char* const name : {"/other/Small", "../other/Small", "runs/../../Small"})
        EXPECT_EQ(nameIn("name Small", fmt::format("name {}", name)), "Small");
    // Species by their numbers in the file: there must be no others.
    Mercury3D scene;
    LinearViscoelasticSpecies own;
    own.setDensity(1), own.setStiffness(1);
    scene.speciesHandler.copyAndAddObject(own);
    const std::string said = refusal([&] { scene.readRestartFile(file); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "the scene has 1 already")) << said;
}

// A line of the log says what was read, and what was passed over.
TEST(MercuryRestart, theLogSaysWhatWasRead) {
    const TestFolder folder;
    std::string log;
    setLogSink([&](LogLevel, std::string_view line) { log += line; });
    helpers::writeToFile(folder.name(), head + oneSpecies + noWalls + "Particles 1\n" +
                                            particle(0, "0 0 0", "invMass 0") +
                                            "Interactions 0\nhGrid a\nInflowHeight 3\n");
    Mercury3D().readRestartFile(folder.name());
    setLogSink({});
    EXPECT_TRUE(contains(log, "1 particles (1 fixed)")) << log;
    EXPECT_TRUE(contains(log, "passed over: InflowHeight, hGrid")) << log;
}

// Others that restart from such a file: an option of a program, and a scene without MercuryDPM's names.
TEST(MercuryRestart, isTakenAsAnOptionAndNamedElsewhere) {
    const TestFolder folder;
    const std::string file = folder.name() + ".restart";
    helpers::writeToFile(
        file, head + oneSpecies + noWalls + "Particles 1\n" + particle(0, "0 0 0") + "Interactions 0\n");
    Mercury3D scene;
    scene.setQuiet();
    scene.setFileType(FileType::NO_FILE);
    const char* const arguments[] = {"program", "-r", file.c_str(), "-tmax", "0.51"};
    scene.solve(5, arguments);
    EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    EXPECT_NEAR(scene.getTime(), 0.51, 1e-12);  // what stands behind the file counts
    // Then a driver's own start is not made, as there.
    struct WithStart : Mercury3D {
        void setupInitialConditions() override { throw RunError("It is not called."); }
    } other;
    other.setQuiet();
    other.setFileType(FileType::NO_FILE);
    other.solve(5, arguments);
    EXPECT_EQ(other.particleHandler.getSize(), 1u);
    struct Plain : Simulation<LinearViscoelasticSpecies> {
        Plain() {
            setQuiet(), setTimeStep(1e-3), setTimeMax(0);
            LinearViscoelasticSpecies* const species =
                speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
            species->setDensity(3), species->setStiffness(1000), species->setDissipation(0);
        }
    } plain;
    plain.restartFrom(file);
    const std::string said = refusal([&] { plain.solve(); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "MercuryDPM's, in text")) << said;
}

}  // namespace
}  // namespace pendular::mercuryRestartTest
