#pragma once

#include <algorithm>
#include <bit>
#include <utility>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/EnergyLedger/ContactAccount.h"
#include "Kernel/Features/EnergyLedger/WearOfStep.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/RigidBodies/BodyAccount.h"
#include "Kernel/Features/Wear/WornWall.h"
#include "Kernel/Foundation/Math/ExactRows.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// What a contact has lost in a step: heat, for who asks for it.
struct ContactLoss {
    std::uint32_t first, second;  // identities; second: none at a wall
    int wall;                     // -1: grain with grain
    double energy;                // J
};

/// Keeps the ledger of the energy. In a step h of velocity Verlet the kinetic energy of a grain changes by
/// exactly h/2 (F + F+) . (v + v+)/2, with the forces and velocities at its start and at its end; with spins
/// and torques alike. The work of each force of each contact is summed by the same formula, so that the
/// account closes to round-off for any number of steps, and what elastic forces did but is not found as
/// stored energy is told apart as the error of the time steps. The sums of a step are exact, so that no bit
/// depends on who adds up what first, and on the number of threads. Rigid bodies: see BodyAccount.h.
class EnergyAccount {
public:
    using Grains = ParticleStore;

    /// Called before the grains move by a step (s); without length at the start of a run.
    void begin(Grains& grains, const ContactSystem& contacts, const WallHandler& walls,
               const Vector<double>& gravity, double step, EnergyLedger& ledger) {
        atBegin = ledger;
        endedAtBegin = ended;
        ledger.driver -= std::exchange(ended, 0);
        const AllRanks& ranks = contacts.ranks();
        potential = ranks.sum(sumOfPotentialEnergy(grains, gravity));
        if (step > 0)
            ledger.driver += ranks.sum(sumOfKineticEnergy(grains)) - ledger.kinetic +
                             (energyOfPistons(walls) - ledger.pistons) +
                             (energyOfMembranes(walls) - ledger.membranes) +
                             (potential + ledger.carried - ledger.potential);
        grains.remembersStart = true;
        grains.atStart.resize(grains.size());
        for (std::size_t place = 0; place < grains.size(); ++place)
            grains.atStart[place] = motionOf(grains, place);
        takeHeldLoads(grains, contacts.store());
        bodies.begin(grains, contacts.store());
        allWereHere = !grains.isShared;
    }

    /// Membranes may have been added and removed in the run: what was stored in them came with them.
    static void wallsChanged(const WallHandler& walls, EnergyLedger& ledger) {
        const double now = elasticEnergyOfMembranes(walls);
        ledger.driver += now - ledger.membraneElastic;
        ledger.membraneElastic = now;
    }

    /// Contacts have been ended between two steps, with what was stored in them (J). The driver has it from
    /// the next step on, when the sums of what is stored no longer do.
    void endedBetweenSteps(double stored) { ended += stored; }

    /// Takes the ledger back to where the step began, which has failed.
    void takeBack(EnergyLedger& ledger) {
        ledger = atBegin;
        ended = endedAtBegin;
    }
    void visitState(StateArchive& archive) { archive.finite("endedBetweenSteps", ended); }

    /// Lets what the walls have taken note of in finish() count, at the end (s) of a step that has not
    /// failed.
    static void finishWear(const WallHandler& walls, double time) {
        for (const NumberedWornWall& worn : wornWalls(walls)) worn.wall->finishStep(time);
    }

    /// Called when the grains have moved.
    void moved(const Grains& grains, const AllRanks& ranks, const Vector<double>& gravity,
               EnergyLedger& ledger) {
        const double now = ranks.sum(sumOfPotentialEnergy(grains, gravity));
        ledger.stepError -= now - potential;
        potential = now;
    }

    /// Called when grains may have gone round a periodic scene, to places where their potential energy is
    /// lower: what the field gave them on their way stays in the account.
    void wentRound(const Grains& grains, const AllRanks& ranks, const Vector<double>& gravity,
                   EnergyLedger& ledger) {
        ledger.carried += potential - ranks.sum(sumOfPotentialEnergy(grains, gravity));
    }

    /// In shear and strain: the grain at a place goes over to an image that moves otherwise (m/s). Returns
    /// the energy (J) that it gets, for givenByImages().
    static double changedImage(Grains& grains, std::uint32_t place, const Vector<double>& velocity) {
        Vector<double>& then = grains.atStart[place].velocity;
        const TranslationRecord& grain = grains.translation[place];
        const double given =
            grain.inverseMass > 0 ? dot(velocity, then + 0.5 * velocity) / grain.inverseMass : 0;
        then += velocity;
        return given;
    }
    /// The same of a rigid body; its grains are told one by one.
    double changedImageOfBody(const Grains& grains, std::size_t body, const Vector<double>& velocity) {
        return bodies.changeVelocity(grains.bodies[body], body, velocity);
    }
    static void givenByImages(const ExactSum& energy, const AllRanks& ranks, EnergyLedger& ledger) {
        ledger.images += ranks.sum(energy);
    }
    static void changedImageOfMember(Grains& grains, std::uint32_t place, const Vector<double>& velocity) {
        grains.atStart[place].velocity += velocity;
    }

    /// The account notes what each contact loses in a step, from now on.
    void noteLosses() { notesLosses = true; }
    /// Of the last step.
    [[nodiscard]] const std::vector<ContactLoss>& losses() const { return lossesOfStep; }

    /// Ends the account of the step.
    void finish(const Grains& grains, ContactSystem& contacts, const WallHandler& walls,
                const Vector<double>& gravity, double step, const Integrator& scheme, int threads,
                EnergyLedger& ledger) {
        // Grains may have gone to other ranks since the start of the step.
        const AllRanks& ranks = contacts.ranks();
        bodies.follow(grains, ranks, allWereHere);
        followHeldLoads(grains, ranks);
        ExactSum byHolders;
        addGivenByHolders(grains, contacts.store(), gravity, step, byHolders);
        ExactSum besides = workBesidesContacts(grains, contacts.store(), gravity, step, scheme, byHolders);
        ranks.addUp({&besides, &byHolders});
        ledger.stepError -= besides.value();
        ledger.walls += byHolders.value();
        const WearOfStep wear(walls);
        std::vector<WearOfContact> worn;
        lossesOfStep.clear();
        const StepOfScene scene{grains, contacts, walls, step};
        ExactRows<ledgerEntries>& sums = notesLosses ? sumInOrder(scene, contacts, wear, worn)
                                                     : sumOnThreads(scene, contacts, threads, wear, worn);
        wear.give(worn, ranks);
        addUp(sums, ranks);
        auto account = std::bit_cast<EnergyLedger>(sums.value());
        const LiquidEnergy byLiquid = contacts.takeLiquidEnergy();
        account.migration = byLiquid.migration;
        account.evaporation = byLiquid.evaporation;
        takeOver(account, step > 0, ledger);  // overlaps at the start are there without work
        takeInPistons(walls, gravity, step, scheme, ledger);
        takeInBodies(walls, step, ledger);
        takeInMembranes(walls, step, ledger);
        ledger.kinetic = ranks.sum(sumOfKineticEnergy(grains));
        ledger.potential = ledger.carried + ranks.sum(sumOfPotentialEnergy(grains, gravity));
    }

private:
    static constexpr std::size_t ledgerEntries = sizeof(EnergyLedger) / sizeof(double);
    using Row = ExactRows<ledgerEntries>::Row;

    using Motion = MotionAtStart;
    static Motion motionOf(const Grains& grains, std::size_t k) {
        Motion motion{grains.translation[k].velocity, grains.acceleration[k], {0, 0, 0}, {0, 0, 0}};
        if (grains.hasSpin) {
            motion.spin = grains.rotation[k].spin;
            motion.angularAcceleration = grains.rotation[k].angularAcceleration;
        }
        return motion;
    }

    struct StepOfScene {
        const Grains& grains;
        const ContactSystem& contacts;
        const WallHandler& walls;
        double step;  // s
    };
    using Sums = ExactRows<ledgerEntries>;
    struct PartOfSums {
        Sums sums;
        std::vector<WearOfContact> wear;

        void clear() {
            sums.clear();
            wear.clear();
        }
    };
    /// The sums over the contacts of a step; exact ones need no order.
    Sums& sumOnThreads(const StepOfScene& scene, ContactSystem& contacts, int threads, const WearOfStep& wear,
                       std::vector<WearOfContact>& worn) {
        constexpr std::size_t worthAThread = 1024, share = 512;
        if (parts.size() < static_cast<std::size_t>(threads)) parts.resize(static_cast<std::size_t>(threads));
        for (PartOfSums& part : parts) part.clear();
        inShares(
            contacts.energyRecordCount(), threads,
            [&](int number, std::size_t first, std::size_t end) {
                PartOfSums& part = parts[static_cast<std::size_t>(number)];
                contacts.forEachEnergyRecord(
                    scene.grains, first, end,
                    [&](const Bucket& bucket, const ContactBlock& block, std::size_t lane,
                        EnergyRecord& record) {
                        const EnergyLedger account =
                            accountOf(scene, wear, bucket, block, lane, record, part.wear);
                        if (block.first[lane] < scene.grains.ownSize())  // else it counts on another rank
                            part.sums.add(std::bit_cast<Row>(account));
                    });
            },
            worthAThread, shareOf(share));
        for (std::size_t k = 0; k < parts.size(); ++k) {
            worn.insert(worn.end(), parts[k].wear.begin(), parts[k].wear.end());
            if (k > 0) parts[0].sums.add(parts[k].sums);
        }
        return parts[0].sums;
    }
    static void addUp(Sums& sums, const AllRanks& ranks) {
        if (!ranks.areSeveral()) return;
        std::vector<ExactSum*> columns;
        for (ExactSum& column : sums.exact()) columns.push_back(&column);
        ranks.addUp(columns);
    }
    /// The same in the order of identities, in which grains are heated.
    Sums& sumInOrder(const StepOfScene& scene, ContactSystem& contacts, const WearOfStep& wear,
                     std::vector<WearOfContact>& worn) {
        parts.resize(std::max<std::size_t>(parts.size(), 1));
        PartOfSums& part = parts[0];
        part.clear();
        contacts.forEachEnergyRecordInOrder(scene.grains, [&](const Bucket& bucket, const ContactBlock& block,
                                                              std::size_t lane, EnergyRecord& record) {
            const EnergyLedger account = accountOf(scene, wear, bucket, block, lane, record, part.wear);
            const std::uint32_t first = block.first[lane];
            if (first >= scene.grains.ownSize()) return;
            part.sums.add(std::bit_cast<Row>(account));
            if (scene.step == 0) return;
            const std::vector<std::uint32_t>& identity = scene.grains.identity;
            lossesOfStep.push_back({identity[first],
                                    bucket.wall >= 0 ? ObservedContact::none : identity[block.second[lane]],
                                    bucket.wall, account.lost()});
        });
        worn = part.wear;
        return part.sums;
    }

    /// The account of a contact in a step, and what it wears off.
    static EnergyLedger accountOf(const StepOfScene& scene, const WearOfStep& wear, const Bucket& bucket,
                                  const ContactBlock& block, std::size_t lane, EnergyRecord& record,
                                  std::vector<WearOfContact>& worn) {
        const Grains& grains = scene.grains;
        const PeriodicBox& box = scene.contacts.periodicBox();
        const ContactLaws& laws = scene.contacts.laws().ofPair(bucket.species1, bucket.species2);
        ContactKind kind{.isWall = bucket.wall >= 0,
                         .isPlastic = laws.isPlastic,
                         .adhesionBreaks = laws.breaks,
                         .hasCouples = scene.contacts.layout().hasContactTorque,
                         .resistsMotion = laws.resistsMotion,
                         .keepsForce = laws.keepsForce,
                         .isShaped = scene.contacts.laws().shapes() != nullptr};
        if (kind.isWall) {
            kind.lastPiston = pistonMotion(scene.walls, static_cast<int>(record.lastWall), record.last, true);
            kind.piston = pistonMotion(scene.walls, bucket.wall, record.now, false);
            record.lastWall = bucket.wall;
            kind.isMembrane =
                scene.walls.getObject(static_cast<std::size_t>(bucket.wall)).membrane() != nullptr;
        }
        const std::uint32_t first = block.first[lane], second = block.second[lane];
        BodyMotion other = kind.isWall ? BodyMotion{} : meanMotion(grains, second);
        if (!kind.isWall && box.imagesMove) {
            const Vector<double> apart =
                grains.translation[second].position - grains.translation[first].position;
            other.slide = -box.velocityBetweenImages(apart, box.nearest(apart));
        }
        const BodyMotion grain = meanMotion(grains, first);
        EnergyLedger account;  // of this contact in the step
        addContact(record, grain, other, kind, scene.step, account);
        if (scene.step > 0 && wear.wears(bucket.wall) && WearOfStep::isWorn(record, account.sliding))
            worn.push_back(WearOfStep::of(grains, box, bucket, block, lane, record, grain, account.sliding));
        takeNowAsLast(record, kind);
        return account;
    }

    static double energyOfPistons(const WallHandler& walls) {
        double sum = 0;  // J
        for (const PresentWall& wall : walls.present()) {
            if (const PlaneDrive* const drive = wall.object->drive()) sum += drive->kineticEnergy();
            if (const WallBody* const body = wall.object->body()) sum += body->kineticEnergy();
        }
        return sum;
    }
    static double energyOfMembranes(const WallHandler& walls) {
        double sum = 0;  // J
        for (const PresentWall& wall : walls.present())
            if (const Membrane* const membrane = wall.object->membrane()) sum += membrane->getKineticEnergy();
        return sum;
    }
    static double elasticEnergyOfMembranes(const WallHandler& walls) {
        double sum = 0;  // J
        for (const PresentWall& wall : walls.present())
            if (const Membrane* const membrane = wall.object->membrane()) sum += membrane->getElasticEnergy();
        return sum;
    }
    static void takeInMembranes(const WallHandler& walls, double step, EnergyLedger& ledger) {
        ledger.membraneElastic = elasticEnergyOfMembranes(walls);
        for (const PresentWall& wall : walls.present()) {
            const Membrane* const membrane = wall.object->membrane();
            if (!membrane || step == 0) continue;
            const MembraneWork& work = membrane->work;
            ledger.pressures += work.byLoads;
            ledger.walls += work.byHolders;
            ledger.membraneDamping += work.damped;
            ledger.stepError -= work.byGrains + work.missing;
        }
        ledger.membranes = energyOfMembranes(walls);
    }
    /// The mean motion in the step of a piston, or a wall that is a body, where a contact is; zero for other
    /// walls.
    static RigidVelocity pistonMotion(const WallHandler& walls, int number, const ContactSample& contact,
                                      bool wasAtStart) {
        if (number < 0) return {};
        const Wall& wall = walls.getObject(static_cast<std::size_t>(number));
        if (const WallBody* const body = wall.body())
            return {.linear = wasAtStart ? body->meanVelocityAtStart(contact.wallPoint)
                                         : body->meanVelocityAt(contact.wallPoint),
                    .spin = body->mean.spin};
        const PlaneDrive* const drive = wall.drive();
        return drive && drive->isPiston() ? RigidVelocity{.linear = drive->meanVelocity * wall.drivenNormal()}
                                          : RigidVelocity{};
    }
    static void takeInBodies(const WallHandler& walls, double step, EnergyLedger& ledger) {
        for (const PresentWall& wall : walls.present()) {
            const WallBody* const body = wall.object->body();
            if (!body || step == 0) continue;
            ledger.loads += body->work.byLoads;
            ledger.bearings += body->work.inFriction;
            ledger.stepError -= body->work.missing;
        }
    }
    /// The kinetic energy of a piston changes as that of a grain; load and weight are the same at both ends
    /// of a step.
    static void takeInPistons(const WallHandler& walls, const Vector<double>& gravity, double step,
                              const Integrator& scheme, EnergyLedger& ledger) {
        for (const PresentWall& present : walls.present()) {
            const Wall& wall = *present.object;
            const PlaneDrive* const drive = wall.drive();
            if (!drive || !drive->isPiston() || step == 0) continue;
            const double mass = drive->asked.mass;
            if (drive->waits) {  // it was stopped
                ledger.driver -= 0.5 * mass * drive->startVelocity * drive->startVelocity;
                continue;
            }
            ledger.loads +=
                step * drive->meanVelocity * (mass * dot(gravity, wall.drivenNormal()) - drive->asked.load);
            if (!scheme.takesMeanAcceleration())
                ledger.stepError -= mass * drive->meanVelocity *
                                    (drive->velocity - drive->startVelocity -
                                     0.5 * step * (drive->earlier + drive->acceleration));
        }
        ledger.pistons = energyOfPistons(walls);
    }

    /// The motion of a grain in the axes in which it is held, and the forces on it there.
    struct HeldLoad {
        std::uint32_t identity;
        Vector<double> velocity, spin;  // m/s, rad/s
        ContactSum contacts;
    };
    static ContactSum loadOf(const Grains& grains, const ContactStore& contacts, std::size_t place) {
        if (place >= contacts.sides.grainCount()) return {{0, 0, 0}, {0, 0, 0}};  // it came after the list
        return contactSum(contacts, place, grains.translation[place].radius);
    }
    /// Of grains that are held along or about some axes, and move in these.
    void takeHeldLoads(const Grains& grains, const ContactStore& contacts) {
        heldLoads.clear();
        if (grains.held.empty()) return;
        for (const std::uint32_t place : grains.place) {
            const HeldBits held = grains.held[place];
            const Motion now = motionOf(grains, place);
            const Vector<double> velocity = now.velocity - held.partAlong(now.velocity),
                                 spin = now.spin - held.partAbout(now.spin);
            if (held.any() && grains.isFree(place) && squaredNorm(velocity) + squaredNorm(spin) > 0)
                heldLoads.push_back(
                    {grains.identity[place], velocity, spin, loadOf(grains, contacts, place)});
        }
    }
    /// The loads of grains that have gone to other ranks go with them.
    void followHeldLoads(const Grains& grains, const AllRanks& ranks) {
        if (!ranks.areSeveral()) return;
        std::vector<HeldLoad> left;
        for (const HeldLoad& load : heldLoads)
            if (!grains.place.contains(load.identity)) left.push_back(load);
        const auto isElsewhere = [&](const HeldLoad& load) { return !grains.place.contains(load.identity); };
        if (!allWereHere)
            for (const HeldLoad& load : ranks.gather(left)) heldLoads.push_back(load);
        std::erase_if(heldLoads, isElsewhere);
    }
    /// J: what keeps their motion there does against contacts and weight.
    void addGivenByHolders(const Grains& grains, const ContactStore& contacts, const Vector<double>& gravity,
                           double step, ExactSum& given) const {
        for (const HeldLoad& load : heldLoads) {
            const std::uint32_t place = grains.place[load.identity];
            const ContactSum now = loadOf(grains, contacts, place);
            const Vector<double> weight = (1 / grains.translation[place].inverseMass) * gravity;
            given.add(-step * (dot(0.5 * (load.contacts.force + now.force) + weight, load.velocity) +
                               0.5 * dot(load.contacts.torque + now.torque, load.spin)));
        }
    }

    /// The work (J) of the field of gravity, and of what an integrator other than velocity Verlet adds to the
    /// mean of the two accelerations.
    ExactSum workBesidesContacts(const Grains& grains, const ContactStore& contacts,
                                 const Vector<double>& gravity, double step, const Integrator& scheme,
                                 ExactSum& byHolders) const {
        ExactSum sum;
        for (std::size_t k = 0; k < grains.ownSize(); ++k) {
            const TranslationRecord& grain = grains.translation[k];
            if (!grains.isFree(k)) continue;
            const BodyMotion mean = meanMotion(grains, k);
            sum.add(step / grain.inverseMass * dot(gravity, mean.velocity));
            if (scheme.takesMeanAcceleration()) continue;
            const Motion &then = grains.atStart[k], now = motionOf(grains, k);
            const Vector<double> gained =
                now.velocity - then.velocity - (0.5 * step) * (then.acceleration + now.acceleration);
            sum.add(dot(gained, mean.velocity) / grain.inverseMass);
            if (grains.hasSpin) {
                const Vector<double> turned =
                    now.spin - then.spin -
                    (0.5 * step) * (then.angularAcceleration + now.angularAcceleration);
                sum.add(dot(turned, mean.spin) / grains.rotation[k].inverseInertia);
            }
        }
        bodies.addGainBesidesContacts(grains, contacts, gravity, step, sum, byHolders,
                                      [&](std::uint32_t place) {
                                          const BodyMotion mean = meanMotion(grains, place);
                                          return std::pair(mean.velocity, mean.spin);
                                      });
        return sum;
    }

    /// Replaces what is stored, and adds what a step has lost and given.
    static void takeOver(const EnergyLedger& account, bool isStep, EnergyLedger& ledger) {
        using L = EnergyLedger;
        for (double L::*stored :
             {&L::elastic, &L::tangentialElastic, &L::rollingElastic, &L::torsionElastic, &L::adhesive})
            ledger.*stored = account.*stored;
        if (!isStep) return;
        for (double L::*summed :
             {&L::normalDashpots, &L::plastic, &L::sintering, &L::tangentialDashpots, &L::sliding,
              &L::rolling, &L::torsion, &L::brokenAdhesion, &L::viscousBridges, &L::stiffening, &L::walls,
              &L::images, &L::migration, &L::evaporation, &L::stepError})
            ledger.*summed += account.*summed;
    }

    std::vector<HeldLoad> heldLoads;
    bool allWereHere = true;  // at the start of the step: ranks did not share the grains
    BodyAccount bodies;
    std::vector<PartOfSums> parts;  // of each thread
    std::vector<ContactLoss> lossesOfStep;
    bool notesLosses = false;
    EnergyLedger atBegin;
    double ended = 0, endedAtBegin = 0;  // J
    double potential = 0;                // J, at the places where the grains are
};

}  // namespace pendular
