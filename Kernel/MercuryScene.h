#pragma once

/// A scene by MercuryDPM's names, so that one of its drivers compiles with few changes. Each name hands over
/// to the kernel's own word; HOW-DO-I.md lists both side by side ("Port a driver from MercuryDPM").

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Mercury/MercuryArguments.h"
#include "Kernel/Mercury/MercuryBonds.h"
#include "Kernel/Mercury/MercuryBoundaries.h"
#include "Kernel/Mercury/MercuryCG.h"
#include "Kernel/Mercury/MercuryCopyBoundaries.h"
#include "Kernel/Mercury/MercuryCurvedWalls.h"
#include "Kernel/Mercury/MercuryData.h"
#include "Kernel/Mercury/MercuryDroplets.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Mercury/MercuryForces.h"
#include "Kernel/Mercury/MercuryHelpers.h"
#include "Kernel/Mercury/MercuryInsertionBoundaries.h"
#include "Kernel/Mercury/MercuryInteractions.h"
#include "Kernel/Mercury/MercuryLogger.h"
#include "Kernel/Mercury/MercuryPSD.h"
#include "Kernel/Mercury/MercuryPaths.h"
#include "Kernel/Mercury/MercuryPlane.h"
#include "Kernel/Mercury/MercuryRestart.h"
#include "Kernel/Mercury/MercuryRestartScene.h"
#include "Kernel/Mercury/MercuryWalls.h"
#include "Kernel/MercuryNames.h"

namespace pendular {

/// `class X : public MercuryScene<SPECIES>`; with species of several types MercuryScene<A, B>, of any
/// MercuryScene<>, which is Mercury3D. It moves grains as MercuryDPM does (integrators::velocityVerlet).
template <class... Types>
class MercuryScene : public Simulation<Types...> {
public:
    MercuryScene() {
        this->setIntegrator(integrators::velocityVerlet);
        this->addOutput(MercuryFiles(settings));
        settings->atSetUp = [this] {
            settings->readsLedger = readsLedger;  // not before main(): a scene may be made then
            boundaryHandler.settle();
            requireOnePlane(this->particleHandler);
            findOwnForces();
            warnOfFiles();
        };
    }

    /// Texts with a % for each value, through the scene's own logger.
    MercuryLogger logger{Run::logger};

    /// A driver's own forces on a grain that can move, by grain->addForce(), at the end of each step; those
    /// of contacts and gravity act beside them (there it is gravity that one overrides). getTime() is the
    /// time at which they act, the end of the step, and 0 at the start of a run. This one adds nothing, so
    /// that an override may call it.
    virtual void computeExternalForces(MercuryForcedGrain /*grain*/) { plainForcesWereAsked = true; }
    /// Without effect: walls act by themselves.
    void computeForcesDueToWalls(const GrainReference& /*grain*/) {}

    /// Called whenever output is due: at the start, after every saveCount steps and at the end.
    virtual void printTime() const {}
    void writeOutput() override {
        boundaryHandler.requireSet();
        cgHandler.sample();
        printTime();
    }

    /// Called by solve() when the run is at its end.
    virtual void actionsAfterSolve() {}
    void solve() {
        Run::solve();
        actionsAfterSolve();
    }
    // Hooks of MercuryDPM that nothing calls here; a driver that has one does not compile. What is done
    // before the steps goes to the end of setupInitialConditions(), which a run that goes on from a file
    // calls, too; forces are those of contacts, gravity and hosts; files are those of addOutput().
    virtual void actionsBeforeTimeLoop() final {}
    virtual void actionsOnRestart() final {}
    virtual void computeAdditionalForces() final {}
    virtual void writeOutputFiles() final {}
    virtual void writeEneTimeStep(std::ostream&) const final {}
    virtual void writeEneHeader(std::ostream&) const final {}

    /// The arguments of main(): those of takeArguments(), and -xmin, ..., -zmax (m), -gravity X Y Z (m/s^2),
    /// -dim 2 or 3, -saveCountData, -saveCountFStat, -saveCountEne and -saveCountRestart STEPS.
    void solve(int argc, const char* const* argv) {
        takeArguments(*this, argc, argv, options(), [this](const std::filesystem::path& file) {
            if (file.empty()) readRestartFile();
            else readRestartFile(file);
        });
        solve();
    }

    // The box, m: each bound by itself, 0 where it is not set.
    void setXMin(double value) { domain.setLowest(0, value); }
    void setYMin(double value) { domain.setLowest(1, value); }
    void setZMin(double value) { domain.setLowest(2, value); }
    void setXMax(double value) { domain.setHighest(0, value); }
    void setYMax(double value) { domain.setHighest(1, value); }
    void setZMax(double value) { domain.setHighest(2, value); }
    void setMin(const Vec3D& low) { domain.set(low, domain.getHighest()); }
    void setMax(const Vec3D& high) { domain.set(domain.getLowest(), high); }
    void setMin(double x, double y, double z) { setMin({x, y, z}); }
    void setMax(double x, double y, double z) { setMax({x, y, z}); }
    void setDomain(const Vec3D& low, const Vec3D& high) { domain.set(low, high); }
    [[nodiscard]] Vec3D getMin() const { return domain.getLowest(); }
    [[nodiscard]] Vec3D getMax() const { return domain.getHighest(); }
    [[nodiscard]] double getXMin() const { return getMin().x(); }
    [[nodiscard]] double getYMin() const { return getMin().y(); }
    [[nodiscard]] double getZMin() const { return getMin().z(); }
    [[nodiscard]] double getXMax() const { return getMax().x(); }
    [[nodiscard]] double getYMax() const { return getMax().y(); }
    [[nodiscard]] double getZMax() const { return getMax().z(); }

    /// Without effect: how MercuryDPM's viewer shows grains, how it looks for neighbours, how many processes
    /// share the box, and whether a restarted run goes on in its files (it does).
    void setXBallsAdditionalArguments(const std::string& /*arguments*/) {}
    void setHGridMaxLevels(unsigned /*levels*/) {}
    void setHGridMinCellSize(double /*size*/) {}
    void setNumberOfDomains(const std::vector<unsigned>& /*alongEachAxis*/) {}
    void setAppend(bool /*append*/) {}
    void removeOldFiles() {}  // a run replaces those of its name
    MercuryNoFile& getInteractionFile() { return interactionFile; }
    /// 2 or 3. With 2 all grains are held in the plane of x and y: their velocity along z and their spins
    /// about x and y are 0 to the bit (ParticleHandler::holdAll()), and all begin at one z. In MercuryDPM
    /// this only chooses the columns of files, which have all three dimensions here.
    void setSystemDimensions(int dimensions) {
        requireTwoOrThree("system", dimensions);
        this->particleHandler.holdAll(dimensions == 2 ? HeldAxes::inPlane() : HeldAxes{});
        systemDimensions = dimensions;
    }
    /// 2: grains are discs, of a density by area, which the log says (SpeciesOwner::setGrainsAreDiscs());
    /// they are in a scene of two dimensions.
    void setParticleDimensions(int dimensions) {
        requireTwoOrThree("particle", dimensions);
        this->speciesHandler.setGrainsAreDiscs(dimensions == 2);
    }
    void setDimension(int dimensions) { setSystemDimensions(dimensions), setParticleDimensions(dimensions); }
    [[nodiscard]] int getSystemDimensions() const { return systemDimensions; }
    [[nodiscard]] int getParticleDimensions() const { return this->speciesHandler.grainsAreDiscs() ? 2 : 3; }

    /// All files at once: NAME.data, NAME.fstat, NAME.ene, and the kernel's restart file.
    void setFileType(FileType type) {
        for (MercuryFile* file : {&dataFile, &fStatFile, &eneFile, &restartFile}) file->setFileType(type);
    }
    /// Files for ParaView, of grains, contacts and walls together.
    void setParticlesWriteVTK(bool write) { settings->picturesOfGrains = write; }
    void setWallsWriteVTK(bool write) { settings->picturesOfWalls = write; }
    void setParticlesWriteVTK(FileType type) { setParticlesWriteVTK(type != FileType::NO_FILE); }
    void setWallsWriteVTK(FileType type) { setWallsWriteVTK(type != FileType::NO_FILE); }

    /// Goes on from the kernel's restart file of this name, for a scene that is set up as it was; where there
    /// is none, starts from NAME.restart, one of MercuryDPM's in text.
    void readRestartFile() {
        const std::filesystem::path text = this->getName() + ".restart";
        const bool isOwn = std::filesystem::exists(Run::restartFile()) || !isMercuryRestart(text);
        readRestartFile(isOwn ? Run::restartFile() : text);
    }
    /// The same of a file; one of MercuryDPM's in text (MercuryRestart) is a start, from the time that it
    /// has, and a line of the log says what was taken over; setupInitialConditions() is not called after it.
    /// For scenes of any species (Mercury3D) that have none yet. The name may lack its ending ".restart".
    void readRestartFile(const std::filesystem::path& given) {
        const std::filesystem::path file = withRestartEnding(given);
        if (!isMercuryRestart(file)) return this->restartFrom(file);
        takeOver(readMercuryRestart(file));
    }
    void writeRestartFile() { this->writeRestart(Run::restartFile()); }
    /// Adds the grains of a .data file, and takes its box: readMercuryData(). Their species must be there.
    void readDataFile(const std::filesystem::path& file);

    /// With keepEnergyLedger() or the file NAME.ene: a program in which this, getElasticEnergy() or
    /// getTotalEnergy() is called keeps the ledger for that file, too. Without them the file has the energy
    /// of the springs alone, which costs less.
    [[nodiscard]] const EnergyLedger& energyLedger() const {
        static_cast<void>(&isReader);
        return Scene::energyLedger();
    }
    /// J, what is stored in the contacts, their adhesion included (NAME.ene has that of the springs alone).
    [[nodiscard]] double getElasticEnergy() const { return energyLedger().stored(); }
    /// J, of the grains that can move, against the origin.
    [[nodiscard]] double getGravitationalEnergy() const {
        return this->getTotalMass() > 0
                   ? -this->getTotalMass() * this->getGravity().dot(this->getCentreOfMass())
                   : 0;
    }
    /// J, all of the four.
    [[nodiscard]] double getTotalEnergy() const {
        return getElasticEnergy() + this->getKineticEnergy() + this->getRotationalEnergy() +
               getGravitationalEnergy();
    }

    /// Whether a grain would overlap nothing that is there.
    [[nodiscard]] bool checkParticleForInteraction(const SphericalParticle& grain) const {
        return hasRoomFor(*this, grain);
    }
    /// The grains that stand for others at ThinPeriodicBoundary, AngledPeriodicBoundary and their like.
    [[nodiscard]] const GrainCopies& getCopies() const { return copies; }

    /// A grain that is held altogether moves on this path (m, by the time in s), where it is put at once, or
    /// with this velocity (m/s). Contacts see the velocity with which it goes from step to step. Throw
    /// InputError for one that is not held.
    void setPrescribedPosition(const GrainReference& grain, std::function<Vec3D(double)> path) {
        paths.setPosition(grain, std::move(path), this->getTime());
    }
    void setPrescribedVelocity(const GrainReference& grain, std::function<Vec3D(double)> velocity) {
        paths.setVelocity(grain, std::move(velocity));
    }

private:
    [[nodiscard]] std::vector<MercuryOption> options();
    void takeOver(const MercuryRestart& state);
    void takeHistoriesOver(const MercuryRestart& state, const std::vector<std::uint32_t>& grains,
                           const std::vector<std::size_t>& walls);
    void addGrainsOf(const std::vector<GrainRow>& rows);
    /// Of output that MercuryDPM would write and that is not written here.
    void warnOfFiles() const {
        if (interactionFile.isWritten())
            Run::logger(LogLevel::Warn,
                        "interactionFile: its file is not written here; the contacts are in NAME.fstat, in "
                        "the restart "
                        "file, and in interactionHandler.");
        const std::size_t fields = cgHandler.countOfFiles();
        if (fields > 0 && isNamed())
            Run::logger(LogLevel::Warn,
                        "cgHandler: the files NAME.stat of its {} coarse grainings are not written here; "
                        "write fields by "
                        "addOutput(FieldOutput(...)) or from getPoints(), or call "
                        "statFile.setFileType(FileType::NO_FILE).",
                        fields);
    }
    /// Files of frames are written of a scene that was given a name.
    [[nodiscard]] bool isNamed() const { return this->getName() != MercuryFiles::nameOfUnnamed; }
    /// Forces cost nothing where the driver does not override the function above. GCC can tell that: an
    /// object's own function, and the one of this class, as plain pointers.
    void findOwnForces() {
#if defined(__GNUC__) && !defined(__clang__)
    #pragma GCC diagnostic push
    #pragma GCC diagnostic ignored "-Wpmf-conversions"
        using Plain = void (*)(MercuryScene*, MercuryForcedGrain);
        const auto own = (Plain)(this->*(&MercuryScene::computeExternalForces));
        const auto plain = (Plain)(&MercuryScene::computeExternalForces);
    #pragma GCC diagnostic pop
        forces.setKnown(own == plain ? MercuryForces::Known::None : MercuryForces::Known::Some);
#else
        askForForcesOnce();
#endif
    }
    /// With other compilers: a driver whose function calls the one of this class has perhaps none of its own.
    /// Where there are no grains yet one of a driver has nothing to look at, and throws.
    void askForForcesOnce() {
        const bool isEmpty = this->particleHandler.isEmpty();
        MercuryForcedGrain::Load unused;
        plainForcesWereAsked = false;
        try {
            const std::uint32_t first = isEmpty ? 0 : (*this->particleHandler.begin()).getId();
            computeExternalForces({GrainReference(this->particleHandler, first), unused});
        } catch (const InputError&) {
            if (!isEmpty) throw;
        }
        using Known = MercuryForces::Known;
        forces.setKnown(plainForcesWereAsked ? Known::Unknown : Known::Some);
    }
    static void requireTwoOrThree(const char* what, int dimensions) {
        if (dimensions != 2 && dimensions != 3)
            throw InputError(
                fmt::format("Simulation: {} dimensions = {}; it must be 2 or 3.", what, dimensions));
    }

    /// A program makes functions of a template, and variables that they name, only where it calls them: that
    /// it has made this one is known before main().
    static bool noteReader() { return readsLedger = true; }
    static inline bool readsLedger = false;
    static inline const bool isReader = noteReader();

    int systemDimensions = 3;
    bool plainForcesWereAsked = false;
    MercuryPaths& paths = this->template addPart<MercuryPaths>();
    MercuryForces& forces = this->template addPart<MercuryForces>(
        [this](const MercuryForcedGrain& grain) { computeExternalForces(grain); });
    MercuryBonds& bonds = this->template addPart<MercuryBonds>();
    MercuryInsertions& insertions = this->template addPart<MercuryInsertions>();
    MercuryActions& actions = this->template addPart<MercuryActions>();
    GrainCopies& copies = this->template addPart<GrainCopies>();

    std::shared_ptr<MercurySettings> settings = std::make_shared<MercurySettings>();
    MercuryDomain domain{*this};

public:
    MercuryFile& dataFile = settings->data;
    MercuryFile& fStatFile = settings->fStat;
    MercuryFile& eneFile = settings->energies;
    MercuryFile& restartFile = settings->restart;
    MercuryNoFile interactionFile{FileType::NO_FILE};  // restart files have the contacts
    MercuryRandom& random = settings->random;
    MercuryWallHandler wallHandler{Scene::wallHandler, domain, settings};
    MercuryBoundaryHandler boundaryHandler{*this, {&copies, &insertions, &actions}};
    MercuryInteractionHandler interactionHandler{*this, settings, bonds};
    MercuryCGHandler cgHandler{*this};
};

template <class... Types>
std::vector<MercuryOption> MercuryScene<Types...>::options() {
    using Values = std::vector<double>;
    std::vector<MercuryOption> all{
        {"-xmin", 1, [this](const Values& v) { setXMin(v[0]); }},
        {"-ymin", 1, [this](const Values& v) { setYMin(v[0]); }},
        {"-zmin", 1, [this](const Values& v) { setZMin(v[0]); }},
        {"-xmax", 1, [this](const Values& v) { setXMax(v[0]); }},
        {"-ymax", 1, [this](const Values& v) { setYMax(v[0]); }},
        {"-zmax", 1, [this](const Values& v) { setZMax(v[0]); }},
        {"-gravity", 3,
         [this](const Values& v) {
             this->setGravity({v[0], v[1], v[2]});
         }},
        {"-dim", 1, [this](const Values& v) { setSystemDimensions(dimensionsOfOption("-dim", v[0])); }}};
    const auto addFile = [&](std::string_view name, MercuryFile& file) {
        all.push_back(
            {name, 1, [name, to = &file](const Values& v) { to->setSaveCount(stepsOfOption(name, v[0])); }});
    };
    addFile("-saveCountData", dataFile), addFile("-saveCountFStat", fStatFile);
    addFile("-saveCountEne", eneFile), addFile("-saveCountRestart", restartFile);
    return all;
}

template <class... Types>
void MercuryScene<Types...>::readDataFile(const std::filesystem::path& file) {
    const MercuryFrame frame = readMercuryData(file);
    addGrainsOf(frame.grains);
    setDomain(frame.lowest, frame.highest);
}

template <class... Types>
void MercuryScene<Types...>::addGrainsOf(const std::vector<GrainRow>& rows) {
    std::vector<SphericalParticle> ofTypes(this->speciesHandler.getSize());
    for (std::size_t k = 0; k < ofTypes.size(); ++k) ofTypes[k].setSpecies(this->speciesHandler.getObject(k));
    addGrains(this->particleHandler, rows, ofTypes);
}

template <class... Types>
void MercuryScene<Types...>::takeOver(const MercuryRestart& state) {
    if constexpr (sizeof...(Types) > 0) {
        throw InputError(fmt::format(
            "The restart file {} is one of MercuryDPM's, in text, with species of its own; take Mercury3D.",
            state.file.string()));
    } else {
        requireNoSpecies(state, this->speciesHandler);
        requireTouchingBridges(state);
        setSystemDimensions(state.systemDimensions);
        setParticleDimensions(state.particleDimensions);
        addSpeciesOf(state, this->speciesHandler);
        setDomain(state.lowest, state.highest);
        this->setGravity(state.gravity);
        this->startAt(state.time);
        this->leaveOutInitialConditions();
        if (state.timeStep > 0) this->setTimeStep(state.timeStep);
        this->setTimeMax(state.timeMax);
        this->setSaveCount(state.saveCount);
        if (!state.name.empty()) this->setName(nameInFolder(state, Run::logger));
        const std::vector<std::size_t> walls = addWallsOf(state, this->speciesHandler, wallHandler);
        addBoundariesOf(state, boundaryHandler);
        takeHistoriesOver(state, pendular::addGrainsOf(state, this->speciesHandler, this->particleHandler),
                          walls);
        Run::logger(LogLevel::Info, "{}", state.summary());
    }
}

/// The part that gives contacts their histories is there only where the file has some.
template <class... Types>
void MercuryScene<Types...>::takeHistoriesOver(const MercuryRestart& state,
                                               const std::vector<std::uint32_t>& grains,
                                               const std::vector<std::size_t>& walls) {
    MercuryHistories* histories = nullptr;
    for (const MercuryRestart::History& one : state.histories) {
        const MercuryHistories::OfContact contact = historyOf(one, grains, walls);
        if (one.isBonded)
            bonds.ask(
                {contact.first, contact.wall < 0 ? contact.second : ObservedContact::none, contact.wall}, -1);
        if (!one.remembers()) continue;
        if (!histories) histories = &this->template addPart<MercuryHistories>();
        histories->add(contact);
    }
}

/// Species of any types, as there.
using Mercury3D = MercuryScene<>;
using DPMBase = MercuryScene<>;

/// The same in two dimensions, of discs: setDimension(2). For spheres in a plane setParticleDimensions(3).
class Mercury2D : public Mercury3D {
public:
    Mercury2D() { setDimension(2); }
};

}  // namespace pendular

/// The levels that end a program: they throw a RunError with the text.
inline constexpr pendular::LevelThatEnds ERROR, FATAL;
/// The logger of main(); in a scene it is the scene's.
inline pendular::MercuryLogger logger;

#include "Kernel/Mercury/MercuryChute.h"  // a class derived from Mercury3D
