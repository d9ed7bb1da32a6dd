#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Step/GrainPart.h"
#include "Kernel/Core/Step/StepList.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptivePart.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Features/EnergyLedger/AccountPart.h"
#include "Kernel/Features/FluxPlanes/FluxPlanePart.h"
#include "Kernel/Features/Inlets/InletPart.h"
#include "Kernel/Features/LiquidTransport/LiquidPart.h"
#include "Kernel/Features/LiquidTransport/SprayPart.h"
#include "Kernel/Features/Membranes/MembranePart.h"
#include "Kernel/Features/MovingWalls/DrivePart.h"
#include "Kernel/Features/Outlets/OutletPart.h"
#include "Kernel/Features/PeriodicWalls/PeriodicWalls.h"
#include "Kernel/Features/RigidBodies/BodyPart.h"
#include "Kernel/Features/ShearAndStrain/FlowPart.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/UnlistedContacts.h"

namespace pendular {

/// The inside of a scene: the contacts, the parts of its step, and what it does with them. SceneSetUp.cpp,
/// SceneStep.cpp, SceneChanges.cpp, SceneInsertion.cpp and SceneRestart.cpp have one thing each.
class Scene::Inside {
public:
    explicit Inside(Scene& of);

    // SceneSetUp.cpp

    void setUp();
    /// Called when species, walls and grains are known.
    void prepare();
    /// Throws InputError where set-up would.
    void check();
    /// Whether contacts work with springs at the end of the step.
    [[nodiscard]] bool takesSpringsInStep(const GrainSizes& sizes) const;
    /// The features that the scene has; parts without any sleep from now on.
    [[nodiscard]] Features wakeParts();
    /// The same, and all parts stay as they are.
    [[nodiscard]] Features featuresNow() const;
    /// Throws InputError where a change of gravity, shear or strain does not go together with the scene.
    void refuseForMovingImages();
    void warn() const;

    // SceneStep.cpp

    void advanceByStep(bool another);
    /// A step of this length (s); at the start of a run one without length, which finds the forces.
    void advance(double length, bool another);
    /// The context of a step that begins now.
    StepContext& contextNow(double length);

    // SceneRanks.cpp

    /// Whether each rank has its own grains only.
    [[nodiscard]] bool isDistributed() const { return sharing && sharing->areDistributed(); }
    /// All grains and contacts come to all ranks, until the next step.
    void gather();
    /// They come to the first rank alone while it calls the function.
    void onFirstRank(const std::function<void()>& write);
    /// Of all ranks together; all must call it.
    [[nodiscard]] RunNumbers numbersOfAll();
    // These throw RunError where ranks differ in what they must have alike; all must call them. At set-up it
    // is an InputError.
    /// The largest of what the ranks give, if they have decided alike.
    [[nodiscard]] double agreeOnDecisions(double own);
    /// Species, walls and parts, which hooks may have changed; where each rank has all grains, these, too.
    void agreeOnSettings();

    // SceneChanges.cpp

    /// Checks as at set-up what hooks have changed since the last step; it holds from now on. Throws RunError
    /// with the sentence of set-up.
    void takeOverChanges();
    void mixChangedLaws();
    /// Books the energy (J) that was stored in contacts which the driver has ended.
    void bookEnergyOfEnded(double stored);

    // SceneInsertion.cpp

    /// Images of meshes that the scene will repeat, also before it has looked at its walls.
    /// @param mixture to come
    [[nodiscard]] ImagesForNow imagesFor(const BodyMixture& mixture);
    [[nodiscard]] Inserted reportShortfall(const Inserted& made);

    // SceneRestart.cpp

    void visitAll(StateArchive& archive);

    // Scene.cpp

    [[nodiscard]] GrainSizes sizesOf(const ParticleStore& grains) const {
        return sizesOfScene(*context.laws, grains, scene.inletHandler, contacts.getHeldContacts(),
                            grains.isShared ? contacts.ranks() : AllRanks());
    }
    [[nodiscard]] LiquidLedger liquidLedger() const;

    Scene& scene;
    PeriodicBox box;
    ContactSystem contacts;
    PeriodicWalls periodicWalls;
    Integrator integrator = integrators::predictedVelocityVerlet;
    StepContext context;

    AccountPart account;
    AdaptivePart adaptive;
    FluxPlanePart fluxPlanes;
    FlowPart flow;
    GrainPart grainMotion;
    BodyPart bodies;
    LiquidPart liquid;
    DrivePart drives;
    MembranePart membranes;
    OutletPart outlets;
    InletPart inlets;
    SprayPart sprays;
    FilmMassPart filmMass;
    /// The order in which they act: it fixes the bits.
    StepList parts{{&account, &adaptive, &fluxPlanes, &flow, &grainMotion, &bodies, &liquid, &drives,
                    &membranes, &outlets, &inlets, &sprays, &filmMass}};

    Vector<double> lowestAtSetUp{0, 0, 0}, lengthAtSetUp{0, 0, 0};  // m, of the box
    std::optional<StepForError> stepForError;                       // by which the time step was chosen
    GrainSizes checkedSizes;
    double checkedRadii = 1;                       // the largest ratio of radii of the shapes (GrainShapes.h)
    double checkedStep = unset;                    // s
    double acceptedOverlap = largestSoundOverlap;  // of the smaller radius
    double gapOfFirstBridges = 0;                  // m
    double approachUnseen = 0;                     // m, of two grains since deep overlaps were looked for
    bool overlapsAreSeen = false;                  // by the last forces: no body was changed since
    bool speciesChanged = false;                   // since the run began
    bool gravityChanged = false;                   // since the run began
    bool heldContactsChanged = false;              // setHeldContacts(), since the run began
    UnlistedContacts unlisted;
    bool unlistedAreAskedFor = false;       // by a hook of this rank, which has some of the grains only
    bool lawsAreNew = false;                // prepared ones are to be made again
    bool noRoomWasTold = false;             // of insert() in the run
    std::vector<ContactEvent> eventsOfAll;  // of the last step, where ranks have their own grains only
    std::optional<GrainSharing> sharing;    // none: the scene has all grains
    std::size_t listsAgreed = 0;            // of contacts, at which ranks have compared what they have
    std::optional<StepForFigure> stepForFigure;

private:
    [[nodiscard]] ContactLaws& laws() const { return *context.laws; }
    [[nodiscard]] Features featuresOfScene() const;
    void refuseUnlessBridgesJoin() const;
    /// Throws InputError where setStepFor() of a bulk quantity came before what makes its step too long.
    void refuseStepOfOtherScene() const;
    void warnOfEnergyGainOfSprings() const;
    void warnOfSeams() const;

    [[nodiscard]] double stepLength() const { return scene.getTimeStep(); }
    void choosePartsLength();
    void takeBack();
    void moveAndFindForces(double length);
    void finishStep(bool another);
    void moveAll(StepContext& step);
    /// Ghosts get the motion of the grains that they stand for.
    void exchangeMotion(StepContext& step);
    void findForces(StepContext& step);
    /// A grain that moves its radius in a step, or whose motion is not a number, ends the run.
    void refuseRunaway(double shift) const;
    /// Whenever grains can have approached by a tenth of the smallest radius: nothing that lasts goes deeper
    /// unseen by more. It does not depend on when contacts are listed.
    void lookForDeepOverlaps(const ParticleStore& grains, double approach);
    /// Whether two grains can overlap so deeply now that it ends the run, by what the forces have seen. All
    /// ranks ask together.
    /// @param approach m, of two grains in this step
    [[nodiscard]] bool canOverlapDeeply(double approach) const;
    void warnOfOverlaps() const;
    /// Brings grains that have left a periodic scene back into it; at fixed steps, so that no bit depends on
    /// when contacts are listed.
    void bringBack(StepContext& step);
    /// Brings grains back where walls have ends (see PeriodicWalls), after contacts have been listed.
    void bringBackAtWalls(StepContext& step);
    void wrapAll(ParticleStore& grains) const;
    void bookWentRound(const StepContext& step);

    /// The same of changes in the run; @param others besides those of grains
    void refuseForRanks(const GrainChanges& changes, bool others);
    void takeOverOnRanks(const GrainChanges& changes, bool lastBodyWent);
    /// Throws InputError where the time step was changed in a run that needs steps of one length.
    void refuseOtherStep() const;
    /// Grains that were put outside, and all of them where the first wall with ends has come, are inside
    /// before contacts with walls are listed.
    void wrapPlaced(ParticleStore& grains, const GrainChanges& changes, bool hadEnds);
    /// Whether the checks must be made again for grains that were added.
    [[nodiscard]] bool isNewToChecks(std::span<const std::uint32_t> added) const;
    void renewAccelerations(const GrainChanges& changes);
    /// Contacts that are changed have the forces of what they are now, and their energy is the driver's.
    void computeChanged(const GrainChanges& changes, int firstNewWall);
    void refuseOverlapsOf(const GrainChanges& changes, int firstNewWall) const;
    void refuseOtherMemory() const;

    // SceneRanks.cpp
    /// What all ranks must have alike: in each step, at each list of contacts, and at set-up.
    void visitStep(StateArchive& archive);
    void visitSettings(StateArchive& archive);
    void visitSetUp(StateArchive& archive);
    void agreeAtList();
    void agreeOnAll(bool isSetUp = false);
    [[nodiscard]] std::uint64_t hashOfStep();
    /// Whether a hook of any rank has asked for contacts since all grains were together last.
    [[nodiscard]] bool wereUnlistedAskedFor();
    [[noreturn]] void refuseDifference(const std::string& difference, bool isSetUp = false) const;

    void visitScene(StateArchive& archive);
    void visitSurroundings(StateArchive& archive);
};

}  // namespace pendular
