// Each name of MercuryDPM in Kernel/MercuryScene.h does what the kernel's own word does.
#include "Kernel/MercuryScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <utility>

#include "BuildFolders.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryNamesTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Friction = LinearViscoelasticSlidingFrictionSpecies;

/// The text of the RunError that an action throws; empty if it throws none.
template <class Action>
std::string runError(Action&& action) {
    try {
        action();
    } catch (const RunError& error) {
        return error.what();
    }
    return {};
}

/// Two grains on a floor, one above the other, all a little pressed.
class Pile : public MercuryScene<Friction> {
public:
    int printed = 0;

    Pile() {
        auto species = speciesHandler.copyAndAddObject(Friction());
        species->setDensity(2000);
        species->setStiffness(1000);
        species->setSlidingStiffness(300);
        setDomain({-0.1, -0.1, 0}, {0.1, 0.1, 0.2});
        SphericalParticle grain(species);
        grain.setRadius(0.01);
        for (const double height : {0.0099, 0.0297}) {
            grain.setPosition({0, 0, height});
            particleHandler.copyAndAddObject(grain);
        }
        InfiniteWall floor;
        floor.setSpecies(species);
        floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setTimeStep(1e-5);
        setTimeMax(1e-4);
        setQuiet();
    }
    void printTime() const override { ++const_cast<Pile*>(this)->printed; }
};

TEST(MercuryNames, loggerPutsValuesInPlaceOfPercents) {
    std::string said;
    setLogSink([&](LogLevel, std::string_view line) { said += std::string(line) + '|'; });
    ::logger(INFO, "% grains at %, 5\\% wet, %", 3, Vec3D(1, 2, 0.5), std::string("name"));
    ::logger(DEBUG, "not shown");
    Pile quiet;
    quiet.logger(WARN, "of a scene that is quiet");
    quiet.setQuiet(false);
    quiet.logger(WARN, "100% plain");
    setLogSink({});
    EXPECT_TRUE(contains(said, "3 grains at 1 2 0.5, 5% wet, name"));
    EXPECT_TRUE(contains(said, "100% plain"));
    EXPECT_EQ(said.find("not shown"), std::string::npos);
    EXPECT_EQ(said.find("quiet"), std::string::npos);
}

TEST(MercuryNames, errorFatalAndAssertEndTheProgram) {
    EXPECT_EQ(runError([] { ::logger(ERROR, "it is %", 1.5); }), "it is 1.5");
    EXPECT_EQ(runError([] { ::logger(FATAL, "all over"); }), "all over");
    EXPECT_EQ(runError([] { ::logger.assert_always(1 + 1 == 3, "% is not %", 2, 3); }), "2 is not 3");
    EXPECT_EQ(runError([] { ::logger.assert_always(true, "%", 2), ::logger.assert_debug(true, "no"); }), "");
}

// %P has P digits, %P.W a field of W characters, as MercuryDPM's page on its logger has it.
TEST(MercuryNames, loggerTakesDigitsAndWidths) {
    std::string said;
    setLogSink([&](LogLevel, std::string_view line) { said += std::string(line) + '|'; });
    ::logger(INFO, "t=%3.6, %.8|%4, %", 0.001, 2.5, 1.0 / 3, 0.5);
    ::logger(INFO, "v=%3 n=%.5.", Vec3D(1.0 / 3, 2, 0), 7);
    ::logger(INFO, "p=%. 5\\% of %, %12", 1.5, "all", 1.0 / 3, Flusher::NO_FLUSH);
    setLogSink({});
    EXPECT_TRUE(contains(said, "t=0.001 , 2.5     |0.3333, 0.5")) << said;
    EXPECT_TRUE(contains(said, "v=0.333 2 0 n=7    .")) << said;
    EXPECT_TRUE(contains(said, "p=1.5. 5% of all, 0.333333333333")) << said;
    EXPECT_EQ(runError([] { ::logger(ERROR, "% of %2", 3, 0.123); }), "3 of 0.12");
}

// What MercuryDPM would write into files that are not written here is said, once.
TEST(MercuryNames, filesThatAreNotWrittenAreNamed) {
    const TestFolder folder;
    const auto saidBy = [&](bool asks) {
        std::string said;
        Pile scene;
        scene.setQuiet(false);
        scene.setName(folder.name());
        scene.setFileType(FileType::NO_FILE);
        auto* const cg = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::Z>(0.01, 2));
        if (asks) scene.getInteractionFile().setFileType(FileType::ONE_FILE);
        else cg->statFile.setFileType(FileType::NO_FILE);
        setLogSink([&](LogLevel level, std::string_view line) {
            if (level == LogLevel::Warn) said += line;
        });
        scene.boundaryHandler.setWriteVTK(asks);
        scene.solve();
        setLogSink({});
        return said;
    };
    const std::string asked = saidBy(true), plain = saidBy(false);
    for (const char* const name :
         {"interactionFile", "NAME.stat of its 1", "boundaryHandler.setWriteVTK()"}) {
        EXPECT_TRUE(contains(asked, name)) << asked;
        EXPECT_EQ(plain.find(name), std::string::npos) << plain;
    }
}

// A grain that is held has the force and the torque of its contacts: those of the other one, reversed, and of
// equal arms the same.
TEST(MercuryNames, heldGrainsHaveForceAndTorque) {
    MercuryScene<Friction> scene;
    auto* const species = scene.speciesHandler.copyAndAddObject(Friction());
    species->setDensity(2000), species->setStiffness(1000), species->setDissipation(0);
    species->setSlidingStiffness(300), species->setSlidingFrictionCoefficient(0.5);
    SphericalParticle grain(species);
    grain.setRadius(0.01), grain.setPosition({0, 0, 0.0198}), grain.setVelocity({0.1, 0, 0});
    const GrainReference above = scene.particleHandler.copyAndAddObject(grain);
    grain.setPosition({0, 0, 0}), grain.fixParticle();
    const GrainReference held = scene.particleHandler.copyAndAddObject(grain);
    scene.setTimeStep(1e-5);
    scene.setTimeMax(1e-3);
    scene.setQuiet();
    scene.solve();
    EXPECT_LT(held.getForce().z(), -0.1);
    EXPECT_GT(held.getForce().x(), 1e-3);
    // Forces are sums in whole quanta, 2^-56 of the largest ones.
    EXPECT_LT((held.getForce() + above.getForce()).norm(), 1e-13);
    EXPECT_GT(above.getTorque().norm(), 1e-5);
    EXPECT_LT((held.getTorque() - above.getTorque()).norm(), 1e-15);
}

// Before a grain is added it has a mass by its species, and handlers take what a pointer shows.
TEST(MercuryNames, grainsHaveAMassBeforeTheyAreAdded) {
    MercuryScene<Friction> scene;
    Friction own;
    own.setDensity(2000), own.setStiffness(1000);
    Friction* const species = scene.speciesHandler.copyAndAddObject(&own);
    EXPECT_EQ(species->getDensity(), 2000);
    SphericalParticle grain;
    for (const std::string& said : {refusal([&] { static_cast<void>(grain.getMass()); }),
                                    refusal([&] { static_cast<void>(grain.getVolume()); })})
        EXPECT_TRUE(isOneSentence(said) && contains(said, "radius")) << said;
    grain.setRadius(0.01);
    const std::string none = refusal([&] { static_cast<void>(grain.getMass()); });
    EXPECT_TRUE(isOneSentence(none) && contains(none, "species")) << none;
    grain.setSpecies(species);
    EXPECT_EQ(grain.getMass(), sphereMass(0.01, 2000));
    EXPECT_EQ(grain.getVolume(), sphereMass(0.01, 1));
    EXPECT_EQ(scene.particleHandler.copyAndAddObject(&grain)->getMass(), grain.getMass());
    species->setDensity(1000);
    EXPECT_EQ(grain.getMass(), sphereMass(0.01, 1000));
    scene.setDimension(2);
    EXPECT_EQ(grain.getMass(), discMass(0.01, 1000));
    Mercury3D any;
    const Friction* const added = any.speciesHandler.copyAndAddObject(&own);
    EXPECT_EQ(SphericalParticle(any.speciesHandler.getObject(0)).getSpeciesIndex(), added->getIndex());
}

TEST(MercuryNames, helpersCheckAndWrite) {
    EXPECT_EQ(runError([] { helpers::check(1, 1.0625, 0.0625, "v"); }), "");
    EXPECT_EQ(runError([] { helpers::check(1, 1.5, 0.25, "v"); }), "v is 1; it must be 1.5 up to 0.25.");
    EXPECT_TRUE(contains(runError([] { helpers::check({1, 2, 3}, {1, 2, 4}, 0.5, "x"); }), "x, z is 3"));
    EXPECT_FALSE(mathsFunc::isEqual(std::nan(""), 1, 1e9));
    const TestFolder folder;
    helpers::writeToFile(folder.name(), "set grid\n");
    EXPECT_EQ(support::contentOf(folder.name()), "set grid\n");
    EXPECT_TRUE(isOneSentence(refusal([&] { helpers::writeToFile(folder.name() + "/no/folder", ""); })));
}

TEST(MercuryNames, theScriptMakesTheMechanicalChanges) {
    const TestFolder folder;
    const std::string driver = folder.name() + ".cpp";
    const auto ported = [&](const std::string& line) {
        helpers::writeToFile(driver, line + '\n');
        const support::ProgramResult result =
            support::run((folders::source / "Tools/port-from-mercury.sh").string() + " --driver " + driver);
        EXPECT_EQ(result.exitCode, 0);
        return result.output;
    };
    for (const auto& [there, here] : std::array<std::pair<const char*, const char*>, 20>{{
             {"double z = p->getPosition().Z + v[2].X;", "double z = p->getPosition().z() + v[2].x();"},
             {"// v.X stays in a comment", "// v.X stays in a comment"},
             {"Vec3D::dot(a, getMax()) * Vec3D::cross(b, c).getLength()",
              "(a).dot(getMax()) * (b).cross(c).norm()"},
             {"for (BaseParticle* p : particleHandler)", "for (auto p : particleHandler)"},
             {"BaseParticle p0; const BaseWall *w = f();", "SphericalParticle p0; auto w = f();"},
             {"s.XX - s.ZY", "s(0, 0) - s(2, 1)"},
             {"x.speciesHandler.addObject(own);", "own = x.speciesHandler.copyAndAddObject(*own);"},
             {"if (!(*pIt)->getPosition().isEqualTo(goodPos, 1e-10))",
              "if (!mathsFunc::isEqual((*pIt)->getPosition(), goodPos, 1e-10))"},
             {"if (place.isEqualTo(other(1), e)) p->addVelocity(v);",
              "if (mathsFunc::isEqual(place, other(1), e)) p->accelerate(v);"},
             {"std::vector<BaseParticle*>::iterator pIt = all.begin();", "auto pIt = all.begin();"},
             {"std::vector<BaseParticle*> all{new BaseParticle};",
              "std::vector<SphericalParticle*> all{new SphericalParticle};"},
             {"void computeExternalForces(BaseParticle* p) override",
              "void computeExternalForces(MercuryForcedGrain p) override"},
             {"void computeExternalForces (BaseParticle *CI)",
              "void computeExternalForces(MercuryForcedGrain CI)"},
             {"Vec3D::getDistance (p->getPosition() - o, q) + Vec3D::getDistanceSquared(a, b)",
              "((p->getPosition() - o) - (q)).norm() + ((a) - (b)).squaredNorm()"},
             {"Vec3D::getLength(a + f(b)) * Vec3D::getUnitVector(c) + Vec3D::getLengthSquared(d)",
              "(a + f(b)).norm() * (c).normalized() + (d).squaredNorm()"},
             {"v.getX() + p->getPosition().getZ() - s.getXMax()",
              "v.x() + p->getPosition().z() - s.getXMax()"},
             {"v.setX(f(1)); s.setXMax(3); v.normalise();", "v.x() = f(1); s.setXMax(3); v.normalize();"},
             {"v.getComponent(k) + v.getLength ()", "v[k] + v.norm()"},
             {"setXMax(MIN.Xa, atX)", "setXMax(MIN.Xa, atX)"},
             {"auto i = dynamic_cast<BondedInteraction*>(interactionHandler.getInteraction(f(p), q, 0));",
              "auto i = interactionHandler.getInteraction(f(p), q, 0);"},
         }})
        EXPECT_EQ(ported(there), std::string(here) + '\n');
}

// A program whose headers are missing is of no class by its lines, all of the headers are named, and the
// lines behind them are counted; a header beside a program is a part of it.
TEST(MercuryNames, theScriptNamesMissingHeaders) {
    const TestFolder folder;
    const auto write = [&](const char* name, const char* text) {
        helpers::writeToFile((folder.path() / name).string(), text);
    };
    write("missing.cpp",
          "#include \"None.h\"\n#include <None/Other.h>\n#include \"../../None/Third.h\"\n"
          "int main() {\n    return gone() + away();\n}\nint other() {\n    return lost();\n}\n");
    write("beside.h", "inline int f() {\n    return gone();\n}\n");
    write("more.cpp", "#include \"beside.h\"\nint main() {\n    return f() + away();\n}\n");
    write("unchanged.cpp", "int main() {}\n");
    const support::ProgramResult result =
        support::run((folders::source / "Tools/port-from-mercury.sh").string() + " --classify " +
                     folder.path().string() + " --build " + folders::binary.string() + " 2>&1");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    for (const char* const row : {"\nunknown\t2\tmissing\tnot known: headers None.h, None/Other.h, "
                                  "../../None/Third.h are missing; 2 lines",
                                  "\nfew\t2\tmore\t", "\nunchanged\t0\tunchanged\t"})
        EXPECT_TRUE(contains(result.output, row)) << result.output;
}

// Each row names tests that there are, and the page says what the table does.
TEST(MercuryNames, theTableOfProgramsIsWhole) {
    const support::ProgramResult result =
        support::run("python3 " + (folders::source / "Tools/mercury-programs.py").string() + " --check 2>&1");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, " of 175")) << result.output;
}

// A program counts as ported only with a figure and what it was compared with, and where it was run.
TEST(MercuryNames, theTableOfProgramsIsChecked) {
    const TestFolder folder;
    const auto faultsOf = [&](const std::string& row) {
        helpers::writeToFile(
            folder.name(),
            "program\tlines\tfrom\trun whole, figures compared\ttests\tchanged or missing\n" + row + '\n');
        const support::ProgramResult result =
            support::run("python3 " + (folders::source / "Tools/mercury-programs.py").string() +
                         " --check --table " + folder.name() + " 2>&1");
        EXPECT_EQ(result.exitCode, 1) << result.output;  // the page is that of the whole table
        return result.output;
    };
    for (const char* const row :
         {"A\t1\trun\tyes: place to 1e-3 m, by its .restart\t\t", "A\t12\trun\tin part: to 1 s of 2 s\t\t",
          "A\t-\tread\tno: refused\t\tcharges", "A\t3\tread\tno\t\t"})
        EXPECT_FALSE(contains(faultsOf(row), "A: ")) << row;
    for (const auto& [row, fault] : std::array<std::pair<const char*, const char*>, 8>{
             {{"A\t1\trun\tyes\t\t", "A: 'yes' lacks a figure"},
              {"DropletBoundarySelfTest\t3\ttest\tin part: a droplet\tdropletBoundary\t",
               "it has 'in part', but its test is another scene"},
              {"A\t3\ttest\tno\tfreeFall\t", "A: it is a test, and has 'no' without a reason"},
              {"A\t1\trun\tyes: place to 1e-3 m\t\t", "lacks a figure, or what it was compared with"},
              {"A\t1\tread\tyes: place, by its source\t\t", "A: it has 'yes', but 1 lines from 'read'"},
              {"A\t-\trun\tyes: place, by its source\t\t", "A: it has 'yes', but - lines"},
              {"A\t1\trun\tin part\t\t", "A: 'in part' does not say of what"},
              {"A\t1\trun\tperhaps\t\t", "A: 'perhaps' is not"}}})
        EXPECT_TRUE(contains(faultsOf(row), fault)) << row << ": " << faultsOf(row);
}

TEST(MercuryNames, helpersReadTheCommandLine) {
    const char* const given[] = {"program", "-n", "7.5", "-quick", "-name", "bed", "-last"};
    EXPECT_EQ(helpers::readFromCommandLine(7, given, "-n", 2), 7.5);
    EXPECT_EQ(helpers::readFromCommandLine(7, given, "-m", 2), 2);
    EXPECT_EQ(helpers::readFromCommandLine(7, given, "-name", "none"), "bed");
    EXPECT_EQ(helpers::readFromCommandLine(7, given, "-other", "none"), "none");
    EXPECT_TRUE(helpers::readFromCommandLine(7, given, "-quick"));
    EXPECT_FALSE(helpers::readFromCommandLine(7, given, "-slow"));
    for (const std::string& said :
         {refusal([&] { static_cast<void>(helpers::readFromCommandLine(7, given, "-name", 1)); }),
          refusal([&] { static_cast<void>(helpers::readFromCommandLine(7, given, "-last", 1)); })})
        EXPECT_TRUE(isOneSentence(said)) << said;
    // 11 saves of 1 s in steps of 1 ms: one each 100 steps.
    EXPECT_EQ(helpers::getSaveCountFromNumberOfSavesAndTimeMaxAndTimeStep(11, 1, 1e-3), 100u);
    EXPECT_EQ(helpers::getSaveCountFromNumberOfSavesAndTimeMaxAndTimeStep(100, 1e-3, 1e-3), 1u);
    EXPECT_FALSE(helpers::fileExists("/no/such/file"));
}

TEST(MercuryNames, boundsOfTheBoxAreSetOneByOne) {
    MercuryScene<Friction> scene;
    const DomainBox& kernel = scene;
    EXPECT_EQ(scene.getMax(), Vec3D(0, 0, 0));
    scene.setXMax(1);
    scene.setYMax(2);
    EXPECT_EQ(kernel.getMax(), Vec3D(1, 2, 0));  // flat, as in a program in two dimensions
    scene.setXMin(3);                            // above the highest bound, for now
    EXPECT_EQ(kernel.getMin(), Vec3D(0, 0, 0));
    scene.setMax(4, 5, 6);
    EXPECT_EQ(kernel.getMin(), Vec3D(3, 0, 0));
    EXPECT_EQ(kernel.getMax(), Vec3D(4, 5, 6));
    scene.setYMin(-1);
    scene.setZMin(-2);
    scene.setZMax(7);
    EXPECT_EQ(scene.getXMin() + 10 * scene.getYMin() + 100 * scene.getZMin(), -207);
    EXPECT_EQ(scene.getXMax() + 10 * scene.getYMax() + 100 * scene.getZMax(), 754);
    scene.setMin({0, 0, 0});
    EXPECT_EQ(kernel.getMin(), Vec3D(0, 0, 0));
}

TEST(MercuryNames, scenesHaveTwoOrThreeDimensions) {
    MercuryScene<Friction> scene;
    scene.setSystemDimensions(3);
    EXPECT_EQ(scene.particleHandler.axesOfAllHeld(), HeldAxes{});
    scene.setSystemDimensions(2);
    EXPECT_EQ(scene.particleHandler.axesOfAllHeld(), HeldAxes::inPlane());
    EXPECT_FALSE(scene.speciesHandler.grainsAreDiscs());
    scene.setDimension(2);
    EXPECT_TRUE(scene.speciesHandler.grainsAreDiscs());
    const std::string flat = refusal([&] { scene.setSystemDimensions(1); });
    EXPECT_TRUE(isOneSentence(flat));
    EXPECT_TRUE(contains(flat, "system dimensions = 1"));
    EXPECT_TRUE(contains(refusal([&] { scene.setParticleDimensions(4); }), "particle dimensions = 4"));
}

TEST(MercuryNames, eachFileHasItsSaveCount) {
    const TestFolder folder;
    {
        Pile scene;
        scene.setName(folder.name());
        scene.setFileType(FileType::NO_FILE);
        scene.dataFile.setFileType(FileType::MULTIPLE_FILES);
        scene.dataFile.setSaveCount(2);
        scene.fStatFile.setFileType(FileType::ONE_FILE);
        scene.eneFile.setFileType(FileType::ONE_FILE);
        scene.eneFile.setSaveCount(1);
        scene.eneFile.writeFirstAndLastTimeStep();
        scene.setNumberOfDomains({2, 1, 1});
        scene.solve();  // ten steps
    }
    const auto frames = [&](const char* end, const char* head) {
        const std::string text = support::contentOf(folder.name() + end);
        std::size_t count = 0;
        for (std::size_t at = text.find(head); at != std::string::npos; at = text.find(head, at + 1)) ++count;
        return count;
    };
    // At the start, and each second step, a file for each.
    for (const char* const end : {".data.0", ".data.1", ".data.5"})
        EXPECT_EQ(frames(end, " -0.1 -0.1 0 0.1 0.1 0.2\n"), 1u) << end;
    EXPECT_EQ(frames(".ene", "\n"), 3u);  // a head, the start and the end
    EXPECT_FALSE(std::filesystem::exists(folder.name() + ".data.6"));
    EXPECT_FALSE(std::filesystem::exists(folder.name() + ".data"));
    EXPECT_EQ(frames(".fstat", " 1\n# "), 2u);  // at the start and at the end
}

/// Runs a pile of two grains that touch, with its energies in a file, in a scene of several types of species.
template <class Scene>
void runTwo(Scene& scene, const std::string& name) {
    scene.setName(name);
    auto species = scene.speciesHandler.copyAndAddObject(Friction());
    species->setDensity(2000);
    species->setStiffness(1000);
    species->setSlidingStiffness(300);
    species->setSlidingFrictionCoefficient(0.5);
    SphericalParticle grain(species);
    grain.setRadius(0.01);
    for (const double side : {-1.0, 1.0}) {
        grain.setPosition({side * 0.0099, 0, 0});
        grain.setVelocity({0, side, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    scene.eneFile.setSaveCount(7);
    scene.setTimeStep(1e-5);
    scene.setTimeMax(5e-4);
    scene.setQuiet();
    scene.solve();
}

// Nothing else in this program has scenes of these types.
TEST(MercuryNames, aProgramKeepsTheLedgerForItsFileIfItReadsIt) {
    const TestFolder folder;
    MercuryScene<LinearViscoelasticSpecies, Friction> unread;
    MercuryScene<Friction, LinearViscoelasticSpecies> read;
    runTwo(unread, folder.name() + "-unread");
    runTwo(read, folder.name() + "-read");
    EXPECT_FALSE(unread.keepsEnergyLedger());
    EXPECT_TRUE(read.keepsEnergyLedger());
    EXPECT_GT(read.getElasticEnergy(), 0);
    EXPECT_EQ(unread.springEnergy(), read.getElasticEnergy());  // there is no adhesion
    const std::string energies = support::contentOf(folder.name() + "-read.ene");
    EXPECT_EQ(std::count(energies.begin(), energies.end(), '\n'), 1 + 9);  // 0, 7, ... 49 and 50
    EXPECT_EQ(support::contentOf(folder.name() + "-unread.ene"), energies);
    const Scene& scene = unread;
    const std::string text = refusal([&] { static_cast<void>(scene.energyLedger()); });
    EXPECT_TRUE(isOneSentence(text) && contains(text, "keepEnergyLedger()")) << text;
}

TEST(MercuryNames, energiesAddUp) {
    Pile scene;
    scene.setGravity({0, 0, -10});
    scene.keepEnergyLedger();
    scene.solve();
    const double mass = scene.particleHandler.getObject(0)->getMass();
    EXPECT_NEAR(scene.getGravitationalEnergy(), mass * 10 * (0.0099 + 0.0297), 1e-6 * mass);
    EXPECT_NEAR(scene.getTotalEnergy(),
                scene.getElasticEnergy() + scene.getKineticEnergy() + scene.getGravitationalEnergy(), 1e-18);
    EXPECT_GT(scene.getElasticEnergy(), 0);
    EXPECT_EQ(Pile().particleHandler.getSmallestParticle().getId(), 0u);
    EXPECT_EQ(Pile().particleHandler.getLargestParticle().getVolume(), sphereMass(0.01, 1));
    scene.particleHandler.clear();
    EXPECT_TRUE(scene.particleHandler.isEmpty());
    EXPECT_TRUE(
        isOneSentence(refusal([&] { static_cast<void>(scene.particleHandler.getSmallestParticle()); })));
}

TEST(MercuryNames, grainsAreChangedByDifferences) {
    Pile scene;
    GrainReference grain = scene.particleHandler.getObject(1);
    grain.move({0.01, 0, 0});
    grain.accelerate({0, 1, 0});
    grain.accelerate({0, 2, 0});
    EXPECT_EQ(grain.getPosition(), Vec3D(0.01, 0, 0.0297));
    EXPECT_EQ(grain.getVelocity(), Vec3D(0, 3, 0));
    EXPECT_NEAR(grain.getInertia(), 0.4 * grain.getMass() * 1e-4, 1e-20);
    const std::string moving =
        refusal([&] { scene.setPrescribedVelocity(grain, [](double) { return Vec3D(0, 0, 0); }); });
    EXPECT_TRUE(isOneSentence(moving) && contains(moving, "fixParticle()")) << moving;
    grain.fixParticle();
    scene.setPrescribedVelocity(grain, [](double t) { return Vec3D(t, 0, 0); });
    scene.solve();
    // The middle of each step: exact for a velocity that grows evenly.
    EXPECT_NEAR(grain.getPosition().x(), 0.01 + 0.5e-8, 1e-17);
}

TEST(MercuryNames, grainsMoveByMercurysScheme) {
    EXPECT_EQ(MercuryScene<Friction>().getIntegrator(), integrators::velocityVerlet);
    EXPECT_EQ(Mercury3D().getIntegrator(), integrators::velocityVerlet);
}

TEST(MercuryNames, filesAreThoseThatAreAskedFor) {
    for (const bool energies : {true, false}) {
        const TestFolder folder;
        {
            Pile scene;
            scene.setName(folder.name());
            scene.fStatFile.setFileType(FileType::NO_FILE);
            if (!energies) scene.eneFile.setFileType(FileType::NO_FILE);
            scene.setParticlesWriteVTK(!energies);
            scene.solve();
            EXPECT_EQ(scene.printed, 2);  // at the start and at the end
        }
        const auto isThere = [&](const char* end) { return std::filesystem::exists(folder.name() + end); };
        EXPECT_TRUE(isThere(".data"));
        EXPECT_FALSE(isThere(".fstat"));
        EXPECT_EQ(isThere(".ene"), energies);
        EXPECT_EQ(isThere(".pvd"), !energies);
        EXPECT_FALSE(isThere("-restart.h5"));
    }
    Pile scene;
    EXPECT_EQ(scene.dataFile.getFileType(), FileType::ONE_FILE);
    scene.setFileType(FileType::NO_FILE);
    EXPECT_FALSE(scene.fStatFile.isWritten() || scene.eneFile.isWritten() || scene.restartFile.isWritten());
}

TEST(MercuryNames, aFrameOfADataFileIsAStart) {
    const TestFolder folder;
    {
        Pile scene;
        scene.setName(folder.name());
        scene.setFileType(FileType::NO_FILE);
        scene.dataFile.setFileType(FileType::ONE_FILE);
        scene.solve();
    }
    MercuryScene<Friction> scene;
    scene.speciesHandler.copyAndAddObject(Friction())->setDensity(2000);
    scene.readDataFile(folder.name() + ".data");
    EXPECT_EQ(scene.particleHandler.getNumberOfObjects(), 2u);
    EXPECT_EQ(scene.particleHandler.getObject(0)->getPosition(), Vec3D(0, 0, 0.0099));  // the first frame
    EXPECT_EQ(scene.particleHandler.getLastObject()->getPosition(), Vec3D(0, 0, 0.0297));
    EXPECT_EQ(scene.particleHandler.getLastObject()->getRadius(), 0.01);
    EXPECT_EQ(scene.getMax(), Vec3D(0.1, 0.1, 0.2));

    const auto said = [&](const std::string& text) {
        helpers::writeToFile(folder.name() + ".bad", text);
        return refusal([&] { readMercuryData(folder.name() + ".bad"); });
    };
    const std::string head = "2 0 0 0 0 1 1 1\n", row = "0 0 0 0 0 0 0.1 0 0 0 0 0 0 0\n";
    EXPECT_EQ(said(head + row + row), "");
    for (const std::string& bad : {said("2 0 0 0 1 1\n"), said(head + row), said(head + row + "0 0 0 x\n"),
                                   said("2.5 0 0 0 0 1 1 1\n"), said(head + row + "1 " + row)})
        EXPECT_TRUE(isOneSentence(bad)) << bad;
    EXPECT_TRUE(contains(said(head + row), "line 3"));
}

TEST(MercuryNames, interactionsAreTheKernelsContacts) {
    Pile scene;
    scene.solve();
    const std::vector<ObservedContact> contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 2u);
    std::size_t k = 0;
    for (auto i : scene.interactionHandler) {
        const ObservedContact& contact = contacts[k++];
        EXPECT_EQ(i->getOverlap(), contact.overlap());
        EXPECT_GT(i->getOverlap(), 0);
        EXPECT_EQ(i->getNormal(), toEigen(-contact.normal()));
        EXPECT_EQ(i->getForce(), toEigen(contact.force));
        EXPECT_EQ(i->getContactPoint(), toEigen(contact.point));
        EXPECT_EQ(i->getDistance() + i->getOverlap(), i->isWithWall() ? 0.01 : 0.02);
        // The spring of the last step: the force of a linear law without a dashpot.
        EXPECT_NEAR(i->getAbsoluteNormalForce(), 1000 * i->getOverlap(), 1e-12);
        EXPECT_EQ(i->getTangentialForce(), Vec3D(0, 0, 0));
        if (!i->isWithWall()) continue;
        // From the floor to the grain, which it carries.
        EXPECT_EQ(i->getP(), 0u);
        EXPECT_LT((i->getNormal() - Vec3D(0, 0, 1)).norm(), 1e-15);
        EXPECT_GT(i->getForce().z(), 0);
        EXPECT_LT(std::abs(i->getContactPoint().z()), 1e-5);
    }
    EXPECT_EQ(k, scene.interactionHandler.getNumberOfObjects());
    const auto low = scene.particleHandler.getObject(0), high = scene.particleHandler.getObject(1);
    const MercuryInteraction pair = scene.interactionHandler.getInteraction(high, low);
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->getP() + pair->getI(), 1u);
    EXPECT_FALSE(pair->isWithWall());
    EXPECT_FALSE(scene.interactionHandler.getInteraction(low, low));
    EXPECT_EQ(scene.interactionHandler.getLastObject()->getOverlap(), contacts.back().overlap());
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene.interactionHandler.getObject(2)); })));
    const RigidWall* const floor = scene.wallHandler.getObject(0);
    EXPECT_EQ(scene.interactionHandler.getInteraction(low, floor)->getForce().z(), -floor->getForce().z());
    EXPECT_FALSE(scene.interactionHandler.getInteraction(high, floor));
    // The forces on walls are kept, here without asking.
    EXPECT_LT(scene.wallHandler.getObject(0)->getForce().z(), 0);
}

TEST(MercuryNames, speciesKnowMassStepAndTangentialRestitution) {
    Friction species;
    species.setDensity(2000);
    const double mass = species.getMassFromRadius(0.01);
    EXPECT_NEAR(mass, 2000 * 4.0 / 3.0 * constants::pi * 1e-6, 1e-17);
    const double time = 1e-3, e = 0.5, tangential = 0.25;
    species.setCollisionTimeAndNormalAndTangentialRestitutionCoefficient(time, e, tangential, mass);
    EXPECT_NEAR(species.getCollisionTime(mass), time, 1e-15);
    EXPECT_NEAR(species.getRestitutionCoefficient(mass), e, 1e-14);
    EXPECT_NEAR(species.computeTimeStep(mass), 0.02 * time, 1e-17);
    // 2/7 of the reduced mass on k_t and g_t: half a period takes the time, and leaves the share.
    const double swinging = mass / 7, rate = species.getSlidingDissipation() / (2 * swinging);
    EXPECT_NEAR(std::exp(-rate * time), tangential, 1e-14);
    EXPECT_NEAR(std::sqrt(species.getSlidingStiffness() / swinging - rate * rate) * time, constants::pi,
                1e-12);
    EXPECT_TRUE(contains(refusal([&] {
                             species.setCollisionTimeAndNormalAndTangentialRestitutionCoefficient(time, e, 0,
                                                                                                  mass);
                         }),
                         "tangential restitution coefficient"));

    LinearPlasticViscoelasticSpecies plastic;
    plastic.setPlasticParameters(100, 500, 100, 0.05);
    EXPECT_NEAR(plastic.computeTimeStep(2), 0.02 * constants::pi / std::sqrt(500), 1e-15);
}

TEST(MercuryNames, staticFrictionIsARatio) {
    Friction species;
    const std::string unset = refusal([&] { species.setSlidingFrictionCoefficientStatic(0.6); });
    EXPECT_TRUE(isOneSentence(unset));
    EXPECT_TRUE(contains(unset, "setSlidingFrictionCoefficient()"));
    species.setSlidingFrictionCoefficient(0);
    species.setSlidingFrictionCoefficientStatic(0);
    EXPECT_EQ(species.getSlidingFrictionCoefficientStatic(), 0);
    species.setSlidingFrictionCoefficient(0.5);
    species.setSlidingFrictionCoefficientStatic(0.75);
    EXPECT_EQ(species.getStaticFrictionRatio(), 1.5);
    EXPECT_EQ(species.getSlidingFrictionCoefficientStatic(), 0.75);
    EXPECT_TRUE(
        contains(refusal([&] { species.setSlidingFrictionCoefficientStatic(0.25); }), "at least 0.5"));
}

TEST(MercuryNames, namesOfSpeciesWithEachAdhesion) {
    static_assert(
        std::is_same_v<LinearViscoelasticFrictionSpecies, Species<LinearViscoelastic, pendular::Friction>>);
    static_assert(std::is_same_v<LinearPlasticViscoelasticFrictionReversibleAdhesiveSpecies,
                                 Species<LinearPlasticViscoelastic, pendular::Friction, ReversibleAdhesive>>);
    static_assert(std::is_same_v<LinearViscoelasticFrictionLiquidBridgeWilletSpecies,
                                 Species<LinearViscoelastic, pendular::Friction, LiquidBridgeWillett>>);
    EXPECT_EQ(LinearViscoelasticFrictionSpecies::name, "LinearViscoelasticFrictionSpecies");
}

TEST(MercuryNames, handlersCountAndGiveTheLast) {
    Pile scene;
    EXPECT_EQ(scene.particleHandler.getNumberOfObjects(), scene.particleHandler.getSize());
    EXPECT_EQ(scene.particleHandler.getLastObject()->getId(), 1u);
    scene.particleHandler.removeObject(1);
    EXPECT_EQ(scene.particleHandler.getLastObject()->getId(), 0u);
    scene.particleHandler.removeObject(0);
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene.particleHandler.getLastObject()); })));
    EXPECT_EQ(SphericalParticle(scene.speciesHandler.getLastObject()).getSpeciesIndex(), 0);

    InfiniteWall second;
    second.set({1, 0, 0}, {1, 0, 0});
    second.setSpecies(scene.speciesHandler.getObject(0));
    auto added = scene.wallHandler.copyAndAddObject(second);
    EXPECT_EQ(scene.wallHandler.getLastObject(), added);
    EXPECT_EQ(scene.wallHandler.getNumberOfObjects(), 2u);
    scene.wallHandler.removeObject(0);
    EXPECT_EQ(scene.wallHandler.getNumberOfObjects(), 1u);
    EXPECT_EQ(scene.wallHandler.getLastObject(), added);
    EXPECT_EQ(static_cast<WallHandler&>(scene.wallHandler).getSize(), 2u);  // numbers stay
    scene.wallHandler.removeObject(1);
    for (const std::string& none :
         {refusal([&] { static_cast<void>(scene.boundaryHandler.getObject(0)); }),
          refusal([&] { static_cast<void>(scene.boundaryHandler.getLastObject()); }),
          refusal([&] { static_cast<void>(scene.wallHandler.getLastObject()); })})
        EXPECT_TRUE(isOneSentence(none) && contains(none, "there is no")) << none;
}

TEST(MercuryNames, periodicBoundaryIsAPeriod) {
    MercuryScene<Friction> scene;
    PeriodicBoundary sides;
    sides.set({0, 1, 0}, -1, 2);
    scene.boundaryHandler.copyAndAddObject(sides);
    const PeriodicBox& box = scene.getPeriodicBox();
    EXPECT_EQ(box.length, (Vector<double>{0, 3, 0}));
    EXPECT_EQ(box.lowest.y, -1);
    const std::string oblique = refusal([&] { sides.set({1, 1, 0}, 0, 1); });
    EXPECT_TRUE(isOneSentence(oblique));
    EXPECT_TRUE(contains(oblique, "(1, 1, 0)"));
}

TEST(MercuryNames, boundariesAreSetBeforeOrAfterTheyAreAdded) {
    Pile scene;
    auto* const sides = scene.boundaryHandler.copyAndAddObject(PeriodicBoundary());
    sides->set({0, 1, 0}, -1, 2);
    EXPECT_EQ(scene.getPeriodicBox().length.y, 3);
    auto* const outlet = scene.boundaryHandler.copyAndAddObject(DeletionBoundary());
    outlet->set({0, 0, -1}, 5);
    EXPECT_EQ(scene.outletHandler.getSize(), 1u);
    auto* const plane = scene.boundaryHandler.copyAndAddObject(FluxBoundary());
    plane->set({0, 0, 1}, 0.5);
    EXPECT_EQ(plane->getNumberOfParticlesCrossedNet(), 0);
    // Too late: it would change nothing.
    for (const std::string& late : {refusal([&] {
                                        sides->set({0, 1, 0}, -1, 3);
                                    }),
                                    refusal([&] {
                                        outlet->set({0, 0, -1}, 6);
                                    }),
                                    refusal([&] {
                                        plane->set({0, 0, 1}, 0.6);
                                    })})
        EXPECT_TRUE(isOneSentence(late) && contains(late, "set() comes too late")) << late;
    scene.boundaryHandler.copyAndAddObject(CubeDeletionBoundary());
    const std::string unset = refusal([&] { scene.solve(); });
    EXPECT_TRUE(isOneSentence(unset) && contains(unset, "CubeDeletionBoundary: it was added and not set"));
}

TEST(MercuryNames, insertionSaysWhatItNeeds) {
    CubeInsertionBoundary box;
    const auto said = [&] {
        Pile scene;
        scene.boundaryHandler.copyAndAddObject(box);
        return refusal([&] { scene.solve(); });
    };
    EXPECT_TRUE(contains(said(), "set()"));
    SphericalParticle grain;
    grain.setRadius(1e-3);
    box.set(grain, 1, {0, 0, 0.1}, {0.1, 0.1, 0.2});
    EXPECT_TRUE(contains(said(), "species"));  // it would be filled again in each step
    EXPECT_TRUE(isOneSentence(said()));
    box.setInitialVolume(1e-6);
    Pile scene;
    EXPECT_TRUE(contains(refusal([&] { scene.boundaryHandler.copyAndAddObject(box); }), "species"));
    const std::string spread = refusal([&] {
        box.set(grain, 1, {0, 0, 0}, {1, 1, 1}, {0, 0, 1}, {0, 0, -1});
    });
    EXPECT_TRUE(isOneSentence(spread));
    EXPECT_TRUE(isOneSentence(refusal([&] { DeletionBoundary().set({0, 0, 0}, 1); })));
    EXPECT_TRUE(
        isOneSentence(refusal([&] { static_cast<void>(FluxBoundary().getNumberOfParticlesCrossedNet()); })));
}

TEST(MercuryNames, sizesAreRadiiThere) {
    PSD psd;
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(psd.getMinRadius()); })));
    psd.setDistributionUniform(0.001, 0.003, 50);
    EXPECT_EQ(psd.getMinRadius(), 0.001);
    EXPECT_EQ(psd.getMaxRadius(), 0.003);
    // The mean of r^3 over even radii: (b^4 - a^4) / (4 (b - a)).
    EXPECT_NEAR(psd.getVolumetricMeanRadius(), std::cbrt((81 - 1) / (4 * 2.0)) * 1e-3, 1e-15);
    for (int k = 0; k < 100; ++k) {
        const double radius = psd.drawSample();
        EXPECT_TRUE(radius >= 0.001 && radius <= 0.003);
    }
    psd.setDistributionNormal(0.01, 0.001);
    EXPECT_NEAR(psd.getMinRadius(), 0.007, 1e-16);
    EXPECT_NEAR(0.5 * psd.sizes().mean(1, 0), 0.01, 1e-12);  // cut alike on both sides
    psd.setPSDFromVector({{0.001, 0}, {0.002, 0.25}, {0.003, 0.75}},
                         PSD::TYPE::PROBABILITYDENSITY_NUMBER_DISTRIBUTION);
    EXPECT_NEAR(psd.sizes().cumulative(SizeBasis::Number, 0.004), 0.25, 1e-14);
    psd.setPSDFromVector({{0.001, 0}, {0.002, 0.25}, {0.003, 1}}, PSD::TYPE::CUMULATIVE_VOLUME_DISTRIBUTION);
    EXPECT_NEAR(psd.sizes().cumulative(SizeBasis::Volume, 0.004), 0.25, 1e-14);
    EXPECT_TRUE(isOneSentence(refusal([&] {
        psd.setPSDFromVector({{0.001, 0.5}, {0.002, 0.5}}, PSD::TYPE::PROBABILITYDENSITY_NUMBER_DISTRIBUTION);
    })));
}

TEST(MercuryNames, randomNumbersAreThoseOfTheKernel) {
    MercuryScene<Friction> scene;
    UniformRandom same(0);
    EXPECT_EQ(scene.random.getRandomNumber(2, 3), same.uniform(2, 3));
    EXPECT_EQ(scene.random.getRandomNumber(), same.uniform(0, 1));
    scene.random.setRandomSeed(7);
    EXPECT_EQ(scene.random.getRandomNumber(0, 1), UniformRandom(7).uniform(0, 1));
}

TEST(MercuryNames, argumentsOfMain) {
    const TestFolder folder;
    Pile scene;
    scene.setFileType(FileType::NO_FILE);
    const std::string name = folder.name();
    const char* const given[] = {"program", "-name",  name.c_str(), "-tmax", "3e-5",
                                 "-dt",     "1.5e-5", "-savecount", "1"};
    scene.solve(9, given);
    EXPECT_EQ(scene.getName(), name);
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 2u);
    EXPECT_EQ(scene.printed, 3);
    const auto said = [](const char* option, const char* value = nullptr) {
        Pile other;
        const char* const words[] = {"program", option, value};
        return refusal([&] { takeArguments(other, value ? 3 : 2, words); });
    };
    for (const std::string& text :
         {said("-threads", "2"), said("-tmax"), said("-dt", "much"), said("-savecount", "1.5")})
        EXPECT_TRUE(isOneSentence(text)) << text;
    for (const char* const option : {"-saveCount", "-savecount", "-save_count"}) {
        Pile other;
        other.setFileType(FileType::NO_FILE);
        const char* const words[] = {"program", option,     "5", "-zmax", "0.5", "-xmin",
                                     "-1",      "-gravity", "0", "-1",    "2.5", "-saveCountData",
                                     "3"};
        other.solve(13, words);  // ten steps
        EXPECT_EQ(other.printed, 3) << option;
        EXPECT_EQ(other.getZMax(), 0.5);
        EXPECT_EQ(other.getXMin(), -1);
        EXPECT_EQ(other.getGravity(), Vec3D(0, -1, 2.5));
        EXPECT_EQ(other.dataFile.getSaveCount(), 3u);
    }
    Pile again;
    const char* const restart[] = {"program", "-r", "-name", "other"};
    takeArguments(again, 4, restart);
    EXPECT_TRUE(again.isRestarted());
}

TEST(MercuryNames, aRunWithoutAnEndIsRefused) {
    for (const bool inHook : {false, true}) {
        struct Endless : MercuryScene<Friction> {
            bool inHook = false;
            void setupInitialConditions() override {
                speciesHandler.copyAndAddObject(Friction())->setDensity(1);
                speciesHandler.getObject(0)->setStiffness(1);
                speciesHandler.getObject(0)->setSlidingStiffness(1);
                SphericalParticle grain(speciesHandler.getObject(0));
                grain.setRadius(1);
                particleHandler.copyAndAddObject(grain);
                if (inHook) setTimeMax(0);
            }
        } scene;
        scene.inHook = inHook;
        scene.setTimeStep(1e-3);
        scene.setQuiet();
        const std::string said = refusal([&] { scene.solve(); });
        if (inHook) EXPECT_EQ(said, "");
        else EXPECT_TRUE(isOneSentence(said) && contains(said, "setTimeMax()")) << said;
    }
}

}  // namespace
}  // namespace pendular::mercuryNamesTest
