#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactColumn.h"
#include "Kernel/Core/Contacts/ContactEvent.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/HeldContacts.h"
#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Run/Run.h"
#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Features/FluxPlanes/FluxPlane.h"
#include "Kernel/Features/Inlets/Inlet.h"
#include "Kernel/Features/Insertion/ClumpInsertion.h"
#include "Kernel/Features/LiquidTransport/Evaporation.h"
#include "Kernel/Features/LiquidTransport/LiquidLedger.h"
#include "Kernel/Features/LiquidTransport/SprayHandler.h"
#include "Kernel/Features/Outlets/Outlet.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Scene/DomainBox.h"
#include "Kernel/Scene/OutputForm.h"
#include "Kernel/Scene/TimeStep/StabilityAdvice.h"
#include "Kernel/Scene/TimeStep/StepForError.h"
#include "Kernel/Scene/TimeStep/StepForFigure.h"

namespace pendular {

class AdaptiveStep;
class ContactSystem;
class ExactSum;
class Exchange;
struct GrainSizes;
struct RankCounts;
struct RankOptions;

/// A scene of grains, and its run, whatever its species: Simulation has these.
class Scene : public Run, public DomainBox {
public:
    ~Scene() override;

    [[nodiscard]] ContactLaws& laws() { return *contactLaws; }
    [[nodiscard]] const ContactLaws& laws() const { return *contactLaws; }

    virtual void setupInitialConditions() {}

    /// Called after a step, before actionsAfterTimeStep(), for each start and end of a touch or a bridge in
    /// it, in the order of identities; only after listenToContacts(). On several ranks each of them is called
    /// for the events of all.
    virtual void actionsOnContactEvent(const ContactEvent& /*event*/) {}

    /// Inserts grains that overlap nothing, at set-up or from a hook, after the walls that are to hold them.
    /// Dense starts (a solid fraction above 0.2, up to 0.6) take some 30 us of one core for each grain.
    ///
    /// Throws InputError if sizes, region and amount do not fit each other (Insertion.h), and at set-up if
    /// there is no room for all grains. In a run this is said once, and told by what is returned.
    /// @param like species, velocity, spin and film of all of them; sizes and places come from this
    Inserted insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                    const SphericalParticle& like, const InsertOptions& options = {});

    /// Inserts clumps, each turned at random: a size is the diameter of a sphere of a clump's volume, so that
    /// the template is scaled to it. Above a solid fraction of 0.2 they grow, push and turn each other. The
    /// orientation order of what was inserted is returned, and told at set-up. A clump of one sphere is one
    /// too.
    Inserted insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                    const Clump& like, const InsertOptions& options = {});
    /// Inserts superquadrics, each turned at random, into a scene of SuperquadricSimulation: a size is the
    /// diameter of a sphere of its volume. The spheres around them overlap nothing.
    Inserted insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                    const SuperquadricGrain& like, const InsertOptions& options = {});
    /// Inserts a mixture of grains, clumps and superquadrics, as exactly in its shares as their number
    /// allows.
    Inserted insert(const BodyMixture& mixture, const Region& region, const Amount& amount,
                    const InsertOptions& options = {});

    /// From now on output.write(*this) is called before each writeOutput(): addOutput(ParaViewOutput()). If
    /// it has a function prepare(*this), that is called at once, and again when the scene is set up;
    /// complete(*this) at the end; visitState(archive, *this) is what it remembers. One whose interval() is
    /// given is written at the steps nearest to its multiples instead, at the start and at the end, where it
    /// writes no state twice. OutputForm.h has the forms.
    template <class Output>
    void addOutput(Output output) {
        requireOutputForm<Output, Scene>();
        const auto kept = std::make_shared<Output>(std::move(output));
        KeptOutput calls{.write = [this, kept] { kept->write(*this); }};
        if constexpr (Prepares<Output, Scene>) {
            kept->prepare(*this);
            calls.prepare = [this, kept] { kept->prepare(*this); };
        }
        if constexpr (Completes<Output, Scene>) calls.complete = [this, kept] { kept->complete(*this); };
        if constexpr (VisitsState<Output, Scene>)
            calls.visitState = [this, kept](StateArchive& archive) { kept->visitState(archive, *this); };
        if constexpr (HasOwnInterval<Output>) calls.interval = kept->interval();
        if constexpr (WritesParts<Output>) calls.inParts = kept->writesParts();
        keepOutput(std::move(calls));
    }
    /// During a run, it holds from the next step on.
    /// @param acceleration m/s^2
    void setGravity(const Vec3D& acceleration);
    /// The scene repeats itself along an axis (0, 1, 2: x, y, z) from lowest to highest (m). The length must
    /// be at least twice the largest distance of two centres at which grains act on each other.
    void setPeriodic(int axis, double lowest, double highest);
    /// Shears a periodic scene without walls: images that follow each other along the axis `gradient` move
    /// past each other along the axis `flow`, so that the mean velocity along the flow grows by the rate
    /// (1/s) with each metre of the gradient. The scene must repeat itself along both axes, and have no walls
    /// and no gravity along the gradient. Grains begin with the velocities that they are given: those of
    /// shearFlowAt(), or momentum must first spread from the faces.
    void setLeesEdwards(int flow, int gradient, double rate);
    /// Strains a periodic scene without gravity: the logarithm of its length along an axis grows by the rate
    /// (1/s), about its middle. Walls can be planes whose normal is along an axis that is not periodic, as in
    /// an oedometer; their surface stretches along with the flow. Dashpots feel the flow, in which grains
    /// that are at rest go along: when a rate is set or changed, all grains get the change of their velocity
    /// that it makes where they are. In a run it holds from the next step on; the scene must have been set up
    /// with a rate (0 will do) or a stress along one of its axes.
    void setStrainRate(int axis, double rate);
    /// Strains the scene by a servo, so that the mean stress along the axis (Pa, compression positive; 0 is a
    /// target too) becomes the target: the rate is the difference over the stiffness of the contacts and the
    /// time (s), and what it takes to follow grains that flow or creep (see Servo.h), at most
    /// the largest rate (1/s), 0.1 / time if it is not given. The time must be more than half a step; take at
    /// least twice the time in which sound passes the scene. The stress is looked at 100 times in it, or at
    /// each step. A run in which the servo has strained the scene by a factor of e^3 in one direction ends.
    void setTargetStress(int axis, double stress, double time, std::optional<double> largestRate = {});
    /// Changes the rate (1/s) of the shear in a run, in a scene that was set up with setLeesEdwards(): it
    /// holds from the next step on, and all grains get the change of the flow.
    void setShearRate(double rate);
    /// Shears the scene by a servo, as setTargetStress() strains it, so that the shear stress (Pa, against
    /// the flow: positive for a positive rate) becomes the target. A run that stays at the largest rate over
    /// a strain of 20 ends.
    /// @param largestRate 1/s, 1 / time if it is not given
    void setTargetShearStress(double stress, double time, std::optional<double> largestRate = {});
    /// The shear rate (1/s) in the last step.
    [[nodiscard]] double getShearRate() const;
    /// The rate (1/s) of the logarithm of the length along an axis, in the last step.
    [[nodiscard]] double getStrainRate(int axis) const;
    /// The velocity (m/s) of the flow of shear and strain at a place (m); the flow is at rest in the middle
    /// of the box.
    [[nodiscard]] Vec3D shearFlowAt(const Vec3D& place) const;
    [[nodiscard]] const PeriodicBox& getPeriodicBox() const;
    /// Threads, at least 1; the results do not depend on their number.
    void setNumberOfThreads(int count);
    /// The scene shares its grains with other ranks (MPI): each sets up all of it, and from
    /// initialise() on has its own grains only; the results do not depend on the number of ranks. What needs
    /// all grains or contacts is refused until gather(); SumsOverRanks.h has sums over all. Before the run;
    /// the exchange must outlive it. Where mpirun or srun has started several processes, solve(), runTo() and
    /// runSteps() share the scene without this call.
    void setRanks(Exchange& exchange, const RankOptions& options);
    void gather() override;
    /// The exact sum, or the largest, of a number of which each rank gives its own part: for hooks, which all
    /// ranks call in the same order. On one rank it is the number itself.
    [[nodiscard]] double sumOverRanks(double own) const;
    /// Each of these sums of own parts becomes that of all ranks.
    void sumOverRanks(std::span<ExactSum* const> own) const;
    [[nodiscard]] double largestOfRanks(double own) const;
    /// What this rank has done; nothing without others.
    [[nodiscard]] RankCounts rankCounts() const;
    /// How velocities follow from forces; before the run. The page on the time step compares them.
    void setIntegrator(const Integrator& scheme);
    /// Runs also with a step above the stability limit. That is sound only where overlaps stay so small that
    /// the contacts are softer than those of the limit, or where no bed comes to rest; else the results mean
    /// nothing.
    void acceptUnstableTimeStep(bool accept = true);
    /// Grains may overlap each other and walls by up to this share of the smaller radius, and by no more than
    /// ends a run (0.5; 1 for laws that bond or sinter), at set-up and where they are added or put in a run;
    /// 0.05 without it. This is for soft grains that have
    /// settled in another run. The stability limit stays that of 0.05: beyond it contacts are stiffer
    /// (stabilityAdvice()).
    void acceptOverlaps(double share);
    /// Contacts between two grains that are both held along all axes (fixParticle(), prescribed motion), and
    /// of such a grain with a wall. WhereAsked, the default, lists them where something needs them: all of
    /// them for heat, those at walls that forces move, whose forces are kept, or that wear. All is for forces
    /// between held grains (contactForceOn(), interactions(), fields); None leaves them out everywhere. They
    /// do not change the motion of grains. Dashpots that are made for a restitution have the mass m1 m2 / (m1
    /// + m2) that both would have if they were free, or m of the grain at a wall. Also in a run, from the
    /// next step on; on several ranks after gather().
    void setHeldContacts(HeldContacts which);
    [[nodiscard]] HeldContacts getHeldContacts() const;
    /// Warns, once, if two held bodies overlap whose contact is not listed: for functions that show the
    /// contacts of the scene, as interactions() does. In a hook on several ranks it does so when all grains
    /// are together the next time: at gather(), an output or a restart file.
    void warnOfUnlistedContacts() const;
    /// Keeps account of the energy; costs time, and is off by default.
    void keepEnergyLedger(bool keep = true);
    /// Keeps what springEnergy() needs: less time than the ledger, which has it as well.
    void keepSpringEnergy();
    /// Something of the driver's own that acts in each step, behind all parts of the kernel (StepPart.h says
    /// when): addPart<Draught>(speed). At set-up only. Throws InputError if there is a part of its name.
    template <std::derived_from<StepPart> Part, class... Arguments>
    Part& addPart(Arguments&&... arguments) {
        static_assert(!std::is_abstract_v<Part>,
                      "A part of the step lists what a driver sets of it in compareSetUp(StateArchive&, "
                      "StepContext&), by archive.same(): a run is resumed with the same settings only.");
        auto part = std::make_unique<Part>(std::forward<Arguments>(arguments)...);
        Part& added = *part;
        addOwnPart(std::move(part));
        return added;
    }
    /// Whether a part of this name was added by addPart().
    [[nodiscard]] bool hasPart(std::string_view name) const;

    /// In a scene in which liquid moves: it dries so. At set-up only.
    void setEvaporation(const Evaporation& law);
    [[nodiscard]] const Evaporation& getEvaporation() const;
    /// In a scene in which liquid moves, an upper bound of the liquid (m^3) that will come to what is there
    /// at the start of the run, from a driver, sprays and wet walls: it sets the quantum in which liquid is
    /// counted. Without it, 2^20 bridges of the largest volume, and at least 6 for each grain, and what
    /// sprays emit until the end of the run.
    void setLiquidToCome(double volume);
    /// In a scene in which liquid moves: the mass of a film is part of its grain's, and its moment of inertia
    /// that of a thin shell; without this, films have no mass. What is in bridges has none. The velocity of a
    /// grain stays when its film changes, and the energy ledger counts that as given by the driver.
    /// @param density of the liquid, kg/m^3; 0: films have no mass
    void setLiquidDensity(double density);
    /// The account of the liquid that moves: where it is, and where it came from.
    [[nodiscard]] LiquidLedger liquidLedger() const;
    [[nodiscard]] bool movesLiquid() const;
    /// m^3, what a wet wall has got back from bridges minus what it gave.
    [[nodiscard]] double liquidOfWall(std::size_t wall) const;

    /// At the start of the run bridges join all bodies whose surfaces are not farther apart than the gap (m),
    /// as if they had touched before; without it only those that touch. This is for bridges of constant
    /// volume.
    void joinAtStart(double gap);

    /// From now on the starts and ends of touches and bridges are found in each step; off by default.
    void listenToContacts(bool listen = true);
    /// The events of the last step, and how many there have been; on several ranks those of all. All ranks
    /// must call contactEventCounts() together.
    [[nodiscard]] const std::vector<ContactEvent>& contactEvents() const;
    [[nodiscard]] ContactEventCounts contactEventCounts() const;

    /// A number that is kept of each contact from now on, by name: from its first touch or bridge, when it
    /// has the initial value, until it neither touches nor is bridged. It is in restart files and in the
    /// outputs of fields, there as NAME_UNIT. At set-up only. Throws InputError for a name that is there
    /// already.
    ContactColumnReference addContactColumn(const std::string& columnName, const std::string& unit,
                                            double initial = 0);

    /// All contacts that have a force, in the order of identities, as of the last step. Throws InputError
    /// where each rank has its own grains only: call gather() before, or take sumOverInteractions().
    [[nodiscard]] std::vector<ObservedContact> interactions() const;
    /// Those that count on this rank, which owns their grain 1; on one rank, and after gather(), all.
    [[nodiscard]] std::vector<ObservedContact> ownInteractions() const;
    /// All contacts of one grain, which this rank owns. Throws InputError if there is no such grain.
    [[nodiscard]] std::vector<ObservedContact> interactionsOf(std::size_t identity) const;
    /// The force (N) of all contacts on a grain, also on one that is held in place; without its weight.
    [[nodiscard]] Vec3D contactForceOn(std::size_t identity) const;

    // The grains that can move; on several ranks those of all, which all ranks ask for together:
    [[nodiscard]] double getTotalMass() const;         // kg
    [[nodiscard]] Vec3D getCentreOfMass() const;       // m
    [[nodiscard]] Vec3D getTotalMomentum() const;      // kg m/s
    [[nodiscard]] double getKineticEnergy() const;     // J, of the centres
    [[nodiscard]] double getRotationalEnergy() const;  // J
    /// The rows that parts of the step add to the summary of a run.
    void addPartsTo(SummaryRows& rows) const;

    [[nodiscard]] bool acceptsUnstableTimeStep() const;
    [[nodiscard]] int getNumberOfThreads() const;
    [[nodiscard]] Vec3D getGravity() const;
    [[nodiscard]] const ContactSystem& contacts() const;
    [[nodiscard]] bool keepsEnergyLedger() const;
    [[nodiscard]] const EnergyLedger& energyLedger() const;
    /// Whether springEnergy() is known.
    [[nodiscard]] bool keepsSpringEnergy() const;
    /// J, in the springs of the contacts, as EnergyLedger::springs(): summed up when it is called. Throws
    /// InputError unless keepSpringEnergy() or keepEnergyLedger() was called at set-up.
    [[nodiscard]] double springEnergy() const;
    /// J: what the ledger's total has changed by since the scene began, before any restart.
    [[nodiscard]] double energyUnaccountedFor() const;

    /// The time step (s) above which the stiffest possible contacts of this scene, in the densest bed, are no
    /// longer stable: by their springs and dashpots, and the integrator. With Hertz-Mindlin it is 0.03 to
    /// 0.24 of Rayleigh's time, by the damping, which the usual share of 0.2 does not know
    /// (the page on the time step).
    [[nodiscard]] double stabilityLimit();
    /// The limit (s) of a scene to which grains of these sizes and species will come.
    [[nodiscard]] double stabilityLimit(std::span<const SphericalParticle> toCome);
    /// The step (s) up to which the contacts that there are now are stable, with their overlaps, neighbours
    /// and directions, friction that sticks, and the spins (ContactBounds); infinite where none acts. It says
    /// nothing of contacts to come: take a share of it, or setAdaptiveTimeStep(). After initialise(); all
    /// ranks must call it together.
    [[nodiscard]] double stableStepOfContacts();
    /// Which assumption of stabilityLimit() binds, and what is there instead. After initialise().
    [[nodiscard]] StabilityAdvice stabilityAdvice();
    /// The time step follows the contacts (AdaptiveStep): a share (above 0, up to 1; with 0.9 bulk
    /// quantities were the same to 2.4 %) of what they and those that may come stand, at most 0.9 over the
    /// highest frequency of two grains (shortestContactTime() 0.9 / pi) and at most the largest step (s). The
    /// run begins with setTimeStep(). At set-up. The page on steps says what it does not go with.
    void setAdaptiveTimeStep(double share, std::optional<double> largestStep = {});
    [[nodiscard]] const AdaptiveStep& adaptiveTimeStep() const;
    /// The time step for an error (1) of collisions at a speed (m/s): findStepForError() says how it is
    /// found, and when it throws. At set-up, when species, integrator, walls and grains are there.
    /// @param speed that of estimateOverlaps() if it is not given
    [[nodiscard]] StepForError stepForError(double error, std::optional<double> speed = {});
    /// Takes the time step that stepForError() finds. One above the stability limit is accepted; the summary
    /// says what was found.
    void setStepFor(double error, std::optional<double> speed = {});
    /// What setStepFor() found, if the time step is still its own.
    [[nodiscard]] std::optional<StepForError> getStepForError() const;
    /// The longest time step with which a bulk quantity is right to an error (1): findStepForFigure() says
    /// where this was measured, and when it throws. At set-up, when species, integrator, walls and grains are
    /// there.
    [[nodiscard]] StepForFigure stepForError(WantedFigure figure, double error);
    /// Takes the time step that stepForError() finds for a bulk quantity. One above the stability limit is
    /// accepted; the summary says what was found.
    void setStepFor(WantedFigure figure, double error);
    /// What setStepFor() found for a bulk quantity, if the time step is still its own.
    [[nodiscard]] std::optional<StepForFigure> getStepForFigure() const;
    [[nodiscard]] const Integrator& getIntegrator() const;
    /// The integrator as the scene uses it: springsInStep where the friction lacks dashpots, or with the
    /// adaptive step.
    [[nodiscard]] Integrator scheme() const;
    /// The sizes of all these grains, and of those that inlets will bring.
    [[nodiscard]] GrainSizes grainSizes(const ParticleStore& grains) const;
    /// Half a period (s) of the fastest oscillation of two grains: about the shortest time of a contact, for
    /// steps that are as accurate as is wanted (the page on the time step says which).
    [[nodiscard]] double shortestContactTime();

protected:
    Scene();
    void setLaws(ContactLaws& of);
    /// The scene was set up by the state of another program: setupInitialConditions() is not called.
    void leaveOutInitialConditions() { hasInitialConditions = true; }

private:
    bool hasInitialConditions = false;  // of another program
    class Inside;
    friend class SettingNames;  // of SelfTests: all that parts of the step compare at a restart

    void setUp() override;
    void advanceByStep(bool another) override;
    void tellEvents() override;
    [[nodiscard]] RunNumbers numbers() const override;
    [[nodiscard]] std::vector<RunWarning> warningsSoFar(bool atEnd) const override;
    void addToStatus(SummaryRows& rows, bool atEnd) const override;
    [[nodiscard]] bool isShared() const override;
    void onFirstRank(const std::function<void()>& write) override;
    [[nodiscard]] bool areGrainsOnRanks() const override;
    [[nodiscard]] double agreeOnLargest(double own) override;
    [[nodiscard]] double agreeOnDecisions(double own) override;
    void agreeOnSettings() override;
    void visitAll(StateArchive& archive) override;
    void writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                        const std::string& remark) override;
    void addOwnPart(std::unique_ptr<StepPart> part);
    /// Of all ranks.
    [[nodiscard]] GrainSums sumAllGrains() const;
    /// A function that refuses a change which does not go together with moving images; empty at set-up.
    std::function<void()> refusalInRun();

    ContactLaws* contactLaws = nullptr;
    const std::unique_ptr<Inside> inside;  // before what refers to it

public:
    ParticleHandler particleHandler;
    /// Grains that are joined to rigid bodies.
    BodyHandler bodyHandler{particleHandler, getPeriodicBox()};
    WallHandler wallHandler;
    /// Droplets that come to the grains, in a scene in which liquid moves.
    SprayHandler sprayHandler;
    /// Inlets, at which grains come at a rate, outlets, at which they go, and planes that count them.
    InletHandler inletHandler;
    OutletHandler outletHandler;
    FluxPlaneHandler fluxPlaneHandler;
};

}  // namespace pendular
