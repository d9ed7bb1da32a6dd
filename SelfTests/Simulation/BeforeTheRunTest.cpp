// Every function and class of the kernel that is given a scene, before the run has begun: it does its work,
// or throws one sentence. Each call has a process of its own, so that one that dies is known by its name.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "BuildFolders.h"
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/Clusters.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Analysis/Output/SceneBox.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Analysis/Output/TimedTable.h"
#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "Kernel/MercuryScene.h"
#include "Kernel/Scene/BridgeAdvice.h"
#include "Kernel/Scene/DomainWarnings.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/PendularState.h"
#include "Kernel/Scene/SumsOverRanks.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "Kernel/Scene/TimeStep/StepForError.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::beforeTheRunTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;
using Bridged = Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>;

constexpr double r = 1e-3, dt = 1e-7;  // m, s

Dry glass() {
    Dry species;
    species.setDensity(2500);
    species.setElasticModulusAndPoissonRatio(5e6, 0.25);
    species.setEffectiveShearModulus(1e6);
    species.setDissipation(1e-4);
    species.setSlidingFrictionCoefficient(0.4);
    return species;
}

template <class S>
S liquid() {
    S species;
    species.setDensity(2500);
    species.setStiffness(300);
    species.setDissipation(1e-3);
    species.setContactAngle(0.3);
    species.setSurfaceTension(0.05);
    return species;
}
Wet migrating() {
    Wet species = liquid<Wet>();
    species.setLiquidBridgeVolumeMax(1e-11);
    return species;
}
Bridged bridged() {
    Bridged species = liquid<Bridged>();
    species.setLiquidBridgeVolume(1e-11);
    return species;
}

/// Grains that touch each other and a wall, two of which are held.
template <class S, class Base = scenes::FewGrains<S>>
std::unique_ptr<Base> touching(const S& species) {
    auto scene = std::make_unique<Base>(
        species,
        std::vector<scenes::GrainMotion>{{r, {0, 0, 0.999 * r}},
                                         {r, {0, 0, 2.998 * r}},
                                         {r, {5 * r, 0, r}, Vec3D::Zero(), Vec3D::Zero(), true},
                                         {r, {6.99 * r, 0, r}, Vec3D::Zero(), Vec3D::Zero(), true}},
        dt, std::vector<scenes::PlaneAt>{{{0, 0, -1}, {0, 0, 0}}});
    scene->setQuiet();
    scene->setTimeMax(10 * dt);
    return scene;
}

struct Made {
    std::string name;
    std::function<std::unique_ptr<Scene>()> make;
};
std::vector<Made> kindsOfScenes() {
    return {{"dry", [] { return touching(glass()); }},
            {"wet", [] { return touching(migrating()); }},
            {"bridged", [] { return touching(bridged()); }},
            {"periodic",
             [] {
                 auto scene = touching(glass());
                 for (const int axis : {0, 1}) scene->setPeriodic(axis, -0.02, 0.02);
                 return scene;
             }},
            {"without species", [] { return std::make_unique<Simulation<>>(); }},
            {"by MercuryDPM's names", [] { return std::make_unique<MercuryScene<>>(); }}};
}

FieldOutput fields() {
    return {FieldGrid("XZ", {-0.01, -0.01, 0}, {0.01, 0.01, 0.01}, 2e-3), KernelShape::Gauss, 2e-3};
}

using Call = std::function<void(Scene&)>;

/// All functions that an output may have.
template <class Make>
Call whole(Make make) {
    return [make](Scene& scene) {
        auto output = make();
        using Output = decltype(output);
        if constexpr (Prepares<Output, Scene>) output.prepare(scene);
        output.write(scene);
        if constexpr (Completes<Output, Scene>) output.complete(scene);
    };
}
/// The same by a file for restarts, and of what was never written.
template <class Make>
Call kept(Make make) {
    return [make](Scene& scene) {
        auto output = make();
        writeRestartFile(scene.getName() + "-kept.h5",
                         [&](StateArchive& archive) { output.visitState(archive, scene); });
        output.complete(scene);
    };
}
template <class Output>
Output plain() {
    return Output();
}

/// What the kernel has for scenes, by the headers that declare it.
std::vector<std::pair<std::string, std::vector<std::pair<std::string, Call>>>> calls() {
    return {
        {"Analysis/CoarseGraining/FieldOutput.h",
         {{"write", whole(fields)},
          {"write alone", [](Scene& scene) { fields().write(scene); }},
          {"without contacts", whole([] { return fields().withoutContacts(); })},
          {"visitState", kept(fields)}}},
        {"Analysis/CoarseGraining/SceneState.h",
         {{"takeState",
           [](Scene& scene) {
               GrainState state;
               takeState(scene, state);
           }},
          {"stateOf", [](Scene& scene) { static_cast<void>(stateOf(scene)); }},
          {"stateOf, without contacts",
           [](Scene& scene) { static_cast<void>(stateOf(scene, FieldContent::WithoutContacts)); }}}},
        {"Analysis/Observables/MeanStress.h",
         {{"meanStress", [](Scene& scene) { static_cast<void>(meanStress(scene)); }},
          {"of a volume", [](Scene& scene) { static_cast<void>(meanStress(scene, 1e-6)); }}}},
        {"Analysis/Observables/Clusters.h",
         {{"within", [](Scene& scene) { static_cast<void>(clustersWithin(scene, 2.1 * r)); }},
          {"of contacts", [](Scene& scene) { static_cast<void>(clustersOfContacts(scene)); }}}},
        {"Analysis/Output/EnergyFile.h",
         {{"write", whole(plain<EnergyFile>)},
          {"write alone", [](Scene& scene) { EnergyFile().write(scene); }},
          {"visitState", kept(plain<EnergyFile>)}}},
        {"Analysis/Output/WallForceFile.h",
         {{"write", whole(plain<WallForceFile>)},
          {"write alone", [](Scene& scene) { WallForceFile().write(scene); }},
          {"visitState", kept(plain<WallForceFile>)}}},
        {"Analysis/Output/GrainFlowFiles.h",
         {{"inlets", whole(plain<InletFile>)},
          {"outlets", whole(plain<OutletFile>)},
          {"flux", whole(plain<FluxFile>)},
          {"visitState", kept(plain<FluxFile>)}}},
        {"Mercury/MercuryOutput.h",
         {{"write", whole(plain<MercuryOutput>)},
          {"without energies", whole([] { return MercuryOutput().withEnergies(false); })}}},
        {"Analysis/Output/FrameOutput.h",
         {{"ParaView", whole(plain<ParaViewOutput>)},
          {"ParaView alone", [](Scene& scene) { ParaViewOutput().write(scene); }},
          {"HDF5", whole(plain<Hdf5Output>)},
          {"HDF5 alone", [](Scene& scene) { Hdf5Output().write(scene); }},
          {"visitState", kept(plain<ParaViewOutput>)}}},
        {"Analysis/Output/SceneBox.h",
         {{"take",
           [](Scene& scene) {
               SceneBox box;
               box.take(scene);
           }}}},
        {"Analysis/Output/SceneFields.h",
         {{"of",
           [](Scene& scene) {
               FrameContent content;
               content.stress = content.contacts = content.contactPoints = true;
               static_cast<void>(content.of(scene));
           }}}},
        {"Analysis/Output/TimedTable.h",
         {{"of",
           [](Scene& scene) {
               TimedTable table("Table", "-table.csv", 0);
               table.of(scene, "a,b").row(1, 2);
           }}}},
        {"Analysis/Output/RunSummary.h",
         {{"write", whole(plain<RunSummary>)},
          {"write alone", [](Scene& scene) { RunSummary().write(scene); }},
          {"complete alone", [](Scene& scene) { RunSummary().complete(scene); }}}},
        {"Scene/DomainWarnings.h",
         {{"domainWarnings", [](Scene& scene) { static_cast<void>(domainWarnings(scene, true)); }},
          {"addWarningsTo",
           [](Scene& scene) {
               SummaryRows rows;
               addWarningsTo(rows, scene, false);
           }},
          {"bridgesOutOfDomain",
           [](Scene& scene) { static_cast<void>(bridgesOutOfDomain(scene) + hasBrokenLimits(scene)); }}}},
        {"Scene/PendularState.h",
         {{"pendularState", [](Scene& scene) { static_cast<void>(pendularState(scene, true)); }}}},
        {"Scene/SumsOverRanks.h",
         {{"over grains",
           [](Scene& scene) { sumOverGrains(scene, [](const GrainReference& g) { return g.getMass(); }); }},
          {"over interactions",
           [](Scene& scene) {
               sumOverInteractions(scene, [](const ObservedContact& seen) { return seen.overlap(); });
           }}}},
        {"Scene/TimeStep/ChosenTimeStep.h",
         {{"chosenTimeStep", [](Scene& scene) { static_cast<void>(chosenTimeStep(scene)); }}}},
        {"Scene/TimeStep/OverlapEstimate.h",
         {{"estimateOverlaps", [](Scene& scene) { static_cast<void>(estimateOverlaps(scene, 100)); }}}},
        {"Scene/TimeStep/StepForError.h",
         {{"findStepForError", [](Scene& scene) { static_cast<void>(findStepForError(scene, 0.1, 1)); }}}},
        {"Scene/TimeStep/StepForFigure.h",
         {{"stepForError",
           [](Scene& scene) { static_cast<void>(scene.stepForError(WantedFigure::SolidFraction, 0.1)); }}}},
        {"Scene/TimeStep/SoftestModulus.h",
         {{"softnessOf", [](Scene& scene) { static_cast<void>(softnessOf(scene)); }},
          {"softestModulus",
           [](Scene& scene) {
               SoftnessQuestion question = softnessOf(scene, 1000);
               question.modulus = 1e9;
               question.figures = {wantedFigure("friction")};
               static_cast<void>(softestModulus(scene, question));
           }}}},
        {"Scene/BridgeAdvice.h",
         {{"bridgeAdvice",
           [](Scene& scene) {
               if (auto* const one = dynamic_cast<scenes::FewGrains<Bridged>*>(&scene))
                   static_cast<void>(bridgeAdvice(*one, 0.1));
           }}}},
        {"Mercury/MercuryCG.h",
         {{"sample",
           [](Scene& scene) {
               MercuryCGHandler handler(scene);
               TimeAveragedCG<CGCoordinates::O> mean;
               handler.copyAndAddObject(mean);
               handler.sample();
           }},
          {"getPoint",
           [](Scene& scene) {
               MercuryCGHandler handler(scene);
               static_cast<void>(handler.copyAndAddObject(CG<CGCoordinates::O>())->getPoint(0));
           }}}},
        {"Mercury/MercuryInteractions.h",
         {{"of all",
           [](Scene& scene) {
               if (auto* const one = dynamic_cast<MercuryScene<>*>(&scene)) {
                   static_cast<void>(one->interactionHandler.getNumberOfObjects());
                   static_cast<void>(one->interactionHandler.getLastObject());
               }
           }}}},
        {"Mercury/MercuryInsertion.h",
         {{"hasRoomFor", [](Scene& scene) { static_cast<void>(hasRoomFor(scene, SphericalParticle())); }}}},
        {"Scene/ListedContacts.h",
         {{"requireListedContacts", [](Scene& scene) { requireListedContacts(scene, "a call"); }},
          {"boxOfContacts", [](Scene& scene) { static_cast<void>(boxOfContacts(scene)); }}}},
        {"Scene/Scene.h",
         {{"interactions", [](Scene& scene) { static_cast<void>(scene.interactions()); }},
          {"ownInteractions", [](Scene& scene) { static_cast<void>(scene.ownInteractions()); }},
          {"interactionsOf", [](Scene& scene) { static_cast<void>(scene.interactionsOf(0)); }},
          {"contactForceOn", [](Scene& scene) { static_cast<void>(scene.contactForceOn(2)); }},
          {"contactEvents", [](Scene& scene) { static_cast<void>(scene.contactEvents()); }},
          {"contactEventCounts", [](Scene& scene) { static_cast<void>(scene.contactEventCounts()); }},
          {"warnOfUnlistedContacts", [](Scene& scene) { scene.warnOfUnlistedContacts(); }},
          {"sums",
           [](Scene& scene) {
               static_cast<void>(scene.getTotalMass() + scene.getCentreOfMass().x() +
                                 scene.getTotalMomentum().x() + scene.getKineticEnergy() +
                                 scene.getRotationalEnergy() + scene.sumOverRanks(1) +
                                 scene.largestOfRanks(1));
           }},
          {"liquidLedger", [](Scene& scene) { static_cast<void>(scene.liquidLedger()); }},
          {"liquidOfWall", [](Scene& scene) { static_cast<void>(scene.liquidOfWall(0)); }},
          {"liquidOfWall, of none", [](Scene& scene) { static_cast<void>(scene.liquidOfWall(9)); }},
          {"energyLedger", [](Scene& scene) { static_cast<void>(scene.energyLedger().total()); }},
          {"springEnergy", [](Scene& scene) { static_cast<void>(scene.springEnergy()); }},
          {"energyUnaccountedFor", [](Scene& scene) { static_cast<void>(scene.energyUnaccountedFor()); }},
          {"addPartsTo",
           [](Scene& scene) {
               SummaryRows rows;
               scene.addPartsTo(rows);
           }},
          {"stabilityLimit", [](Scene& scene) { static_cast<void>(scene.stabilityLimit()); }},
          {"shortestContactTime", [](Scene& scene) { static_cast<void>(scene.shortestContactTime()); }},
          {"stableStepOfContacts", [](Scene& scene) { static_cast<void>(scene.stableStepOfContacts()); }},
          {"stabilityAdvice", [](Scene& scene) { static_cast<void>(scene.stabilityAdvice()); }},
          {"adaptiveTimeStep", [](Scene& scene) { static_cast<void>(scene.adaptiveTimeStep()); }},
          {"scheme", [](Scene& scene) { static_cast<void>(scene.scheme()); }},
          {"gather", [](Scene& scene) { scene.gather(); }},
          {"step", [](Scene& scene) { scene.step(); }},
          {"writeAll", [](Scene& scene) { scene.writeAll(); }},
          {"completeAll", [](Scene& scene) { scene.completeAll(); }},
          {"writeRestart", [](Scene& scene) { scene.writeRestart(scene.restartFile()); }},
          {"finishRun", [](Scene& scene) { scene.finishRun(); }},
          {"setShearRate", [](Scene& scene) { scene.setShearRate(1); }},
          {"setTargetShearStress", [](Scene& scene) { scene.setTargetShearStress(1, 1); }},
          {"contacts",
           [](Scene& scene) {
               const ContactSystem& contacts = scene.contacts();
               const ParticleStore& grains = scene.particleHandler.store();
               static_cast<void>(contacts.counts().acting + contacts.bytes());
               static_cast<void>(contacts.overlaps().largestOverlap());
               static_cast<void>(contacts.capillaryNumbers().largestNumber());
               static_cast<void>(contacts.liquidLedger(grains));
               static_cast<void>(contacts.filmReach() + contacts.laws().overlapLimit.largest);
               contacts.forEachListed([](const Bucket&, std::uint32_t) {});
               contacts.forEachActing(grains, [](const Bucket&, std::uint32_t) {});
           }}}},
    };
}

/// What is wrong with what comes of a call, in a process of its own; empty where it returns or throws a
/// sentence of the kernel.
std::string faultOf(const std::function<void()>& call) {
    int ends[2];
    if (pipe(ends) != 0) return "no pipe";
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        std::string said;
        try {
            call();
        } catch (const InputError& error) {
            if (!isOneSentence(error.what())) said = error.what();
        } catch (const RunError& error) {
            if (!isOneSentence(error.what())) said = error.what();
        } catch (const std::exception& error) {
            said = std::string("another error: ") + error.what();
        }
        const ssize_t written = write(ends[1], said.data(), said.size());
        _exit(written == static_cast<ssize_t>(said.size()) ? 0 : 1);
    }
    close(ends[1]);
    std::string said;
    char letters[256];
    for (ssize_t count = 0; (count = read(ends[0], letters, sizeof letters)) > 0;)
        said.append(letters, static_cast<std::size_t>(count));
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
    if (WEXITSTATUS(status) != 0) return "exit code " + std::to_string(WEXITSTATUS(status));
    return said;
}

TEST(BeforeTheRun, everythingThatTakesASceneAnswersOrSaysWhatIsMissing) {
    int made = 0;
    for (const Made& kind : kindsOfScenes())
        for (const auto& [header, ofHeader] : calls())
            for (const auto& [name, call] : ofHeader) {
                const TestFolder folder = TestFolder::inMemory();
                const std::string fault = faultOf([&, &call = call] {
                    const std::unique_ptr<Scene> scene = kind.make();
                    scene->setName(folder.name());
                    call(*scene);
                });
                EXPECT_EQ(fault, "") << kind.name << ": " << header << ", " << name;
                ++made;
            }
    EXPECT_GT(made, 300);
}

// Of the headers of the kernel none is left out that declares a function of a scene, but those that are
// called by the scene itself, in set-up.
TEST(BeforeTheRun, isAskedOfEachHeaderWithAFunctionOfAScene) {
    const std::vector<std::string> ofSetUp{
        "Mercury/MercuryBoundaries.h", "Mercury/MercuryCopyBoundaries.h",
        "Mercury/MercuryDroplets.h",   "Mercury/MercuryInsertionBoundaries.h",
        "Mercury/MercuryFiles.h",      "Scene/OutputForm.h",
        "Scene/SceneInside.h"};
    std::vector<std::string> asked = ofSetUp;
    for (const auto& [header, ofHeader] : calls()) asked.push_back(header);
    const std::filesystem::path kernel = folders::source / "Kernel";
    const std::regex takesScene(R"(\((.*, )?(const )?(Scene|Simulation<\w*>)& ?\w*[,)=])");
    int found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kernel)) {
        if (entry.path().extension() != ".h") continue;
        std::ifstream file(entry.path());
        bool takes = false;
        for (std::string line; std::getline(file, line);) takes |= std::regex_search(line, takesScene);
        if (!takes) continue;
        ++found;
        const std::string name = std::filesystem::relative(entry.path(), kernel).string();
        EXPECT_NE(std::find(asked.begin(), asked.end(), name), asked.end()) << name;
    }
    EXPECT_GT(found, 20);
}

TEST(BeforeTheRun, fieldsOfContactsNeedThem) {
    const auto scene = touching(glass());
    const std::string said = refusal([&] { static_cast<void>(stateOf(*scene)); });
    EXPECT_TRUE(isOneSentence(said));
    EXPECT_TRUE(contains(said, "needs a scene that has begun; call initialise() before it"));
    EXPECT_EQ(stateOf(*scene, FieldContent::WithoutContacts).grains.size(), 4u);
    scene->initialise();
    EXPECT_EQ(stateOf(*scene).contacts.size(), 2u);
}

// They are of the box that the scene has, also before its contacts know it.
TEST(BeforeTheRun, fieldsOfGrainsArePeriodic) {
    const auto scene = touching(glass());
    scene->setPeriodic(0, -0.02, 0.02);
    EXPECT_EQ(stateOf(*scene, FieldContent::WithoutContacts).periodic.length.x, 0.04);
}

/// A part of the step that calls something when it begins.
class Caller final : public StepPart {
public:
    explicit Caller(std::function<void()> toCall) : call(std::move(toCall)) {}
    [[nodiscard]] std::string_view name() const override { return "caller"; }
    void begin(StepContext& /*scene*/, bool /*isRestarted*/) override { call(); }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}

private:
    std::function<void()> call;
};

// The scene counts as begun then, but its contacts have no laws yet.
TEST(BeforeTheRun, partsOfTheStepBeginBeforeContactsAreListed) {
    const std::vector<std::pair<std::string, Call>> early{
        {"stateOf", [](Scene& scene) { static_cast<void>(stateOf(scene)); }},
        {"stableStepOfContacts", [](Scene& scene) { static_cast<void>(scene.stableStepOfContacts()); }},
        {"stabilityAdvice", [](Scene& scene) { static_cast<void>(scene.stabilityAdvice()); }},
        {"writeRestart", [](Scene& scene) { scene.writeRestart(scene.restartFile()); }}};
    for (const auto& [name, call] : early) {
        const TestFolder folder = TestFolder::inMemory();
        const std::string fault = faultOf([&, &call = call] {
            const auto scene = touching(glass());
            scene->setName(folder.name());
            scene->addPart<Caller>([&] { call(*scene); });
            const std::string said = refusal([&] { scene->initialise(); });
            if (!contains(said, "needs a scene that has begun")) throw std::runtime_error("it says: " + said);
        });
        EXPECT_EQ(fault, "") << name;
    }
}

TEST(BeforeTheRun, contactsHaveNoLaws) {
    const auto scene = touching(glass());
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene->contacts().laws()); })));
    EXPECT_FALSE(scene->laws().shapes());
    scene->initialise();
    EXPECT_EQ(&scene->contacts().laws(), &scene->laws());
}

TEST(BeforeTheRun, filmsHaveNoReach) {
    EXPECT_EQ(touching(glass())->contacts().filmReach(), 0);
    EXPECT_EQ(touching(bridged())->contacts().filmReach(), 0);
}

/// A wall whose motion looks at the fields of its scene.
TEST(BeforeTheRun, motionOfAWallGetsASentenceAtSetUpAndFieldsInTheRun) {
    const auto scene = touching(glass());
    std::vector<std::string> said;
    std::size_t contacts = 0;
    InfiniteWall wall;
    wall.set({0, 0, 1}, {0, 0, 0.1});
    wall.setSpecies(scene->speciesHandler.getObject(0));
    wall.setMotion([&](double) {
        said.push_back(refusal([&] { contacts = std::max(contacts, stateOf(*scene).contacts.size()); }));
        return Eigen::Isometry3d::Identity();
    });
    scene->wallHandler.copyAndAddObject(wall);
    scene->initialise();
    scene->step(3);
    ASSERT_GT(said.size(), 3u);
    for (const std::string& one : said) EXPECT_TRUE(one.empty() || contains(one, "has begun")) << one;
    EXPECT_EQ(said.back(), "");
    EXPECT_EQ(contacts, 2u);
}

}  // namespace
}  // namespace pendular::beforeTheRunTest
