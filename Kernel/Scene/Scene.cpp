#include "Kernel/Scene/Scene.h"

#include <cstdlib>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/ContactEvents/EventsOfRanks.h"
#include "Kernel/Foundation/Base/Cache.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/DomainWarnings.h"
#include "Kernel/Scene/LastState.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/SceneInside.h"

namespace pendular {

Scene::Scene() : inside(std::make_unique<Inside>(*this)) {
    // Other programs have some of it, too.
    inside->contacts.setCache(lastCacheBytes() / (2 * startedTogether().count));
    // A grain that is removed takes the energy of its contacts with it; that of its motion the ledger sees.
    ParticleHandler::Inside::callBeforeRemoval(particleHandler, [this](std::uint32_t place) {
        ContactSystem& contacts = inside->contacts;
        if (contacts.isRemoving())
            return contacts.noteEnded(contacts.endContactsOf(particleHandler.store(), place));
        if (inside->isDistributed())
            throw InputError(
                "Grains can be removed in a run on several ranks (setRanks()) after gather() only; all ranks "
                "must call it, and remove the same ones.");
        inside->bookEnergyOfEnded(contacts.endContactsOf(particleHandler.store(), place));
    });
    ParticleHandler::Inside::callToFinishStep(particleHandler, [this] {
        const StepTimes::Within sum(stepTimer(), StepTimes::Part::Sum);
        GrainPart::finishLeftStep(inside->context);
    });
    ParticleHandler::Inside::callToCountAll(particleHandler,
                                            [this] { return inside->sharing->countOfAll(); });
    ParticleHandler::Inside::callForLoads(particleHandler, [this](std::uint32_t place) {
        warnOfUnlistedContacts();
        return inside->contacts.loadOn(inside->context.grains(), place);
    });
    wallHandler.callBeforeRemoval([this](int wall) {
        inside->bookEnergyOfEnded(inside->contacts.endContactsAtWall(particleHandler.store(), wall));
    });
}

Scene::~Scene() = default;

void Scene::setLaws(ContactLaws& of) {
    contactLaws = inside->context.laws = &of;
    ParticleHandler::Inside::setSpecies(particleHandler, of);
}

// Functions that Run asks for:

/// A driver that steps by itself looks at the grains as it likes: it shares them only where it says so.
void Scene::setUp() {
    if (hasCourse() && !inside->sharing)
        if (Exchange* const others = ranksOfProgram())
            setRanks(*others, {.cutsWander = std::getenv("PENDULAR_CUTS_WANDER") != nullptr});  // in tests
    static_cast<void>(agreeOnLargest(0));  // none writes files that others are still looking for
    inside->setUp();
}
void Scene::advanceByStep(bool another) { inside->advanceByStep(another); }
void Scene::visitAll(StateArchive& archive) {
    if (archive.isWriting()) requireListedContacts(*this, "writeRestart()");
    inside->visitAll(archive);
}
bool Scene::areGrainsOnRanks() const { return inside->isDistributed(); }
bool Scene::isShared() const { return inside->sharing.has_value(); }
void Scene::onFirstRank(const std::function<void()>& write) { inside->onFirstRank(write); }
double Scene::agreeOnLargest(double own) { return isShared() ? inside->sharing->largest(own) : own; }

double Scene::agreeOnDecisions(double own) { return isShared() ? inside->agreeOnDecisions(own) : own; }
void Scene::agreeOnSettings() { inside->agreeOnSettings(); }

void Scene::tellEvents() {
    if (!contacts().events().isListening()) return;
    if (inside->isDistributed())
        inside->eventsOfAll = pendular::eventsOfAll(contacts().events(), contacts().ranks());
    const std::vector<ContactEvent> events = contactEvents();  // a copy: the hook may end the listening
    for (const ContactEvent& event : events) actionsOnContactEvent(event);
}

RunNumbers Scene::numbers() const {
    if (inside->isDistributed()) return inside->numbersOfAll();
    return {particleHandler.getSize(), contacts().counts().acting, kineticEnergy(particleHandler.store())};
}

std::vector<RunWarning> Scene::warningsSoFar(bool atEnd) const { return domainWarnings(*this, atEnd); }

void Scene::addToStatus(SummaryRows& rows, bool atEnd) const {
    if (inside->isDistributed()) return;  // all ranks would have to count together
    rows.add("grains", particleHandler.getSize());
    addWarningsTo(rows, *this, atEnd);
}

void Scene::writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contactFile,
                           const std::string& remark) {
    writeGrains(grains, particleHandler.store(), laws(), remark);
    writeContacts(contactFile, contacts(), particleHandler.store(), remark);
}

// Settings.

void Scene::setGravity(const Vec3D& acceleration) {
    for (const double part : acceleration) checkValue("Simulation", "gravity", part, "m/s^2", anyFinite);
    particleHandler.finishStep();  // with the gravity that it had
    takeUnlessRefused(inside->context.gravity, toVector(acceleration), [&] {
        if (getPeriodicBox().imagesMove || hasBegun()) inside->refuseForMovingImages();
    });
    ParticleHandler::Inside::setGravity(particleHandler, inside->context.gravity);
    inside->adaptive.chooseAnew();
    inside->gravityChanged |= hasBegun();
}

void Scene::setPeriodic(int axis, double lowest, double highest) {
    requireSetUp("periodic length");
    inside->flow.setPeriodic(inside->box, axis, lowest, highest, getTime());
    inside->lowestAtSetUp = inside->box.lowest;
    inside->lengthAtSetUp = inside->box.length;
    inside->context.boxAtSetUp = {inside->box.lowest, inside->box.length};
}

void Scene::setLeesEdwards(int flow, int gradient, double rate) {
    requireSetUp("shear");
    inside->flow.setLeesEdwards(inside->box, flow, gradient, rate, getTime());
}

void Scene::setShearRate(double rate) { inside->flow.setShearRate(inside->contextNow(0), rate, hasBegun()); }

std::function<void()> Scene::refusalInRun() {
    if (!hasBegun()) return {};
    return [this] { inside->refuseForMovingImages(); };
}

void Scene::setTargetShearStress(double stress, double time, std::optional<double> largestRate) {
    inside->flow.setTargetShearStress(stress, time, largestRate, refusalInRun());
}

void Scene::setStrainRate(int axis, double rate) {
    inside->flow.setStrainRate(inside->box, axis, rate, refusalInRun());
}

void Scene::setTargetStress(int axis, double stress, double time, std::optional<double> largestRate) {
    inside->flow.setTargetStress(inside->box, axis, stress, time, largestRate, refusalInRun());
}

void Scene::setNumberOfThreads(int count) {
    checkValue("Simulation", "number of threads", count, "", {1, 4096});
    inside->context.threads = count;
    inside->contacts.setThreads(count);
}

void Scene::setRanks(Exchange& exchange, const RankOptions& options) {
    requireSetUp("ranks");
    if (exchange.count() == 1) return;  // all grains are here
    inside->sharing.emplace(exchange, options);
    inside->contacts.share(&*inside->sharing);
}

void Scene::setIntegrator(const Integrator& scheme) {
    requireSetUp("integrator");
    checkIntegrator(scheme);
    inside->integrator = scheme;
    inside->stepForError.reset();
    inside->stepForFigure.reset();
}

void Scene::acceptUnstableTimeStep(bool accept) { inside->context.acceptsUnstableStep = accept; }

void Scene::acceptOverlaps(double share) {
    checkValue("Simulation", "accepted overlap", share, "of the smaller radius", fromZeroTo(1));
    inside->acceptedOverlap = share;
}

void Scene::setHeldContacts(HeldContacts which) {
    if (which != getHeldContacts()) inside->heldContactsChanged |= hasBegun();
    inside->contacts.setHeldContacts(which);
}
HeldContacts Scene::getHeldContacts() const { return inside->contacts.getHeldContacts(); }

void Scene::keepEnergyLedger(bool keep) {
    if (keep != keepsEnergyLedger()) requireSetUp("energy ledger");
    if (!hasBegun()) inside->account.keep(keep);
}

void Scene::keepSpringEnergy() {
    if (keepsSpringEnergy()) return;
    requireSetUp("energy of the springs");
    inside->account.keepSprings();
}

void Scene::setEvaporation(const Evaporation& law) {
    requireSetUp("evaporation");
    inside->contacts.setEvaporation(law);
}

void Scene::setLiquidToCome(double volume) {
    requireSetUp("liquid to come");
    inside->liquid.setToCome(volume);
}

void Scene::setLiquidDensity(double density) {
    requireSetUp("density of the liquid");
    inside->filmMass.setDensity(inside->context, density);
}

void Scene::joinAtStart(double gap) {
    requireSetUp("gap of bridges at the start");
    checkValue("Simulation", "gap of bridges at the start", gap, "m", notNegative);
    inside->gapOfFirstBridges = gap;
}

void Scene::listenToContacts(bool listen) { inside->contacts.listen(listen); }

ContactColumnReference Scene::addContactColumn(const std::string& columnName, const std::string& unit,
                                               double initial) {
    requireSetUp("columns of contacts");
    return {inside->contacts, inside->contacts.addColumn({columnName, unit, initial})};
}

void Scene::addOwnPart(std::unique_ptr<StepPart> part) {
    requireSetUp("parts of the step");
    inside->parts.add(std::move(part));
}

bool Scene::hasPart(std::string_view name) const { return inside->parts.hasOwn(name); }

// Functions that say what the scene has:

double Scene::getShearRate() const { return inside->flow.shearRate(); }
double Scene::getStrainRate(int axis) const { return inside->flow.strainRate(axis); }
Vec3D Scene::shearFlowAt(const Vec3D& place) const { return toEigen(inside->box.flowAt(toVector(place))); }
const PeriodicBox& Scene::getPeriodicBox() const { return inside->box; }
const Evaporation& Scene::getEvaporation() const { return contacts().movingLiquid().evaporation(); }
bool Scene::movesLiquid() const { return contacts().movesLiquid(); }
double Scene::liquidOfWall(std::size_t wall) const { return contacts().liquidOfWall(wall); }
LiquidLedger Scene::liquidLedger() const { return inside->liquidLedger(); }
const std::vector<ContactEvent>& Scene::contactEvents() const {
    return inside->isDistributed() ? inside->eventsOfAll : contacts().events().ofStep();
}
ContactEventCounts Scene::contactEventCounts() const {
    return countsOfAll(contacts().events(), contacts().ranks());
}
bool Scene::acceptsUnstableTimeStep() const { return inside->context.acceptsUnstableStep; }
int Scene::getNumberOfThreads() const { return inside->context.threads; }
Vec3D Scene::getGravity() const { return toEigen(inside->context.gravity); }
const ContactSystem& Scene::contacts() const { return inside->contacts; }
void Scene::gather() { inside->gather(); }
RankCounts Scene::rankCounts() const { return inside->sharing ? inside->sharing->counts() : RankCounts{}; }
bool Scene::keepsEnergyLedger() const { return inside->account.isKept(); }
const EnergyLedger& Scene::energyLedger() const {
    if (hasBegun() && inside->account.keepsSpringsAlone())
        throw InputError(
            "Simulation: the energy ledger is not known, as this run keeps the energy of the springs alone; "
            "call keepEnergyLedger() at set-up.");
    return inside->account.energies();
}
bool Scene::keepsSpringEnergy() const { return keepsEnergyLedger() || inside->account.keepsSpringsAlone(); }
double Scene::springEnergy() const {
    if (!keepsSpringEnergy())
        throw InputError(
            "Simulation: the energy of the springs is not known in this run; call keepSpringEnergy() or "
            "keepEnergyLedger() at set-up.");
    return inside->account.springs(inside->context);
}
double Scene::energyUnaccountedFor() const { return inside->account.changeSinceStart(); }
const AdaptiveStep& Scene::adaptiveTimeStep() const { return inside->adaptive.step(); }
const Integrator& Scene::getIntegrator() const { return inside->integrator; }
Integrator Scene::scheme() const { return contactScheme(inside->context); }
GrainSizes Scene::grainSizes(const ParticleStore& grains) const { return inside->sizesOf(grains); }
void Scene::addPartsTo(SummaryRows& rows) const { inside->parts.addTo(rows); }

LiquidLedger Scene::Inside::liquidLedger() const {
    LiquidLedger found = contacts.liquidLedger(scene.particleHandler.store());
    scene.sprayHandler.addTo(found);
    return found;
}

/// Two bodies of different ranks are on none of them together: they are looked for when all are.
void Scene::warnOfUnlistedContacts() const {
    if (inside->isDistributed()) {
        inside->unlistedAreAskedFor = true;
        return;
    }
    const std::string sentence =
        inside->unlisted.lookFor(contacts(), particleHandler.store(), wallHandler, getNumberOfTimeSteps());
    if (!sentence.empty()) inside->context.logger(LogLevel::Warn, "{}.", sentence);
}

std::vector<ObservedContact> Scene::interactions() const {
    ParticleHandler::Inside::requireAll(particleHandler, "interactions()");
    return ownInteractions();
}

std::vector<ObservedContact> Scene::ownInteractions() const {
    warnOfUnlistedContacts();
    std::vector<ObservedContact> all;
    const ParticleStore& grains = particleHandler.store();
    contacts().forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        all.push_back(contacts().observe(grains, bucket, contact));
    });
    return all;
}

std::vector<ObservedContact> Scene::interactionsOf(std::size_t identity) const {
    std::vector<ObservedContact> all;
    const std::uint32_t place = particleHandler.placeOf(identity);
    if (particleHandler.store().translation[place].inverseMass == 0) warnOfUnlistedContacts();
    contacts().forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
        all.push_back(contacts().observe(particleHandler.store(), bucket, contact));
    });
    return all;
}

Vec3D Scene::contactForceOn(std::size_t identity) const {
    Vector<double> sum{0, 0, 0};
    for (const ObservedContact& contact : interactionsOf(identity))
        sum += contact.particle1 == identity ? contact.force : -contact.force;
    return toEigen(sum);
}

GrainSums Scene::sumAllGrains() const {
    GrainSums sums = sumGrains(particleHandler.store());
    contacts().ranks().addUp({&sums.mass, &sums.firstMoment.x, &sums.firstMoment.y, &sums.firstMoment.z,
                              &sums.momentum.x, &sums.momentum.y, &sums.momentum.z, &sums.translationalEnergy,
                              &sums.rotationalEnergy});
    return sums;
}
double Scene::getTotalMass() const { return sumAllGrains().mass.value(); }
Vec3D Scene::getCentreOfMass() const { return toEigen(sumAllGrains().centreOfMass()); }
Vec3D Scene::getTotalMomentum() const { return toEigen(sumAllGrains().momentum.value()); }
double Scene::getKineticEnergy() const {
    return contacts().ranks().sum(sumOfTranslationalEnergy(particleHandler.store()));
}
double Scene::getRotationalEnergy() const { return sumAllGrains().rotationalEnergy.value(); }
double Scene::sumOverRanks(double own) const {
    ExactSum sum;
    sum.add(own);
    return contacts().ranks().sum(sum);
}
void Scene::sumOverRanks(std::span<ExactSum* const> own) const { contacts().ranks().addUp(own); }
double Scene::largestOfRanks(double own) const { return contacts().ranks().largest(own); }

}  // namespace pendular
