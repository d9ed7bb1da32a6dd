#pragma once

#include "Kernel/Core/Contacts/CapillaryWatch.h"
#include "Kernel/Core/Contacts/ContactGeometry.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactTiming.h"
#include "Kernel/Core/Contacts/OverlapWatch.h"
#include "Kernel/Core/Contacts/SampleTiming.h"
#include "Kernel/Laws/Concepts/BridgeDrag.h"
#include "Kernel/Laws/Species/Species.h"

namespace pendular {

/// The laws between two species, prepared for the step.
template <class S>
struct PreparedLaws {
    typename S::Normal::Prepared normal;
    typename S::Friction::Prepared friction;
    /// Bridges that resist motion are asked in each step; other ones are not.
    static constexpr bool asksAdhesion = bridgeResists<typename S::Adhesion> != BridgeResists::Nothing;
    [[no_unique_address]] std::conditional_t<asksAdhesion, typename S::Adhesion, NoAdhesion> adhesion;

    PreparedLaws() = default;
    explicit PreparedLaws(const typename S::Mixed& laws)
        : normal(static_cast<const typename S::Normal&>(laws).prepare()),
          friction(static_cast<const typename S::Friction&>(laws).prepare(
              static_cast<const typename S::Normal&>(laws))) {
        if constexpr (asksAdhesion) adhesion = static_cast<const typename S::Adhesion&>(laws);
    }
};

/// A geometry of grains that are no spheres: it says itself what follows from their arms.
template <class Geometry>
concept ShapedGeometry = requires(const Geometry& geometry) {
    geometry.lastNormal();
};

/// The batched contact kernel: geometry, then the three laws, on eight contacts at a time. It reads grains,
/// reads and writes the contacts' own memory, writes a force record for each contact, and adds the forces to
/// the totals of both grains.
template <class S>
class ContactKernel {
public:
    using Normal = typename S::Normal;
    using Friction = typename S::Friction;
    using Adhesion = typename S::Adhesion;
    template <class T>
    using History = typename Friction::template History<T>;
    template <class T>
    using NormalHistory = typename NormalHistoryOf<Normal>::template type<T>;
    template <class T>
    using Interaction = typename Adhesion::template Interaction<T>;
    static constexpr BridgeResists resists = bridgeResists<Adhesion>;

    /// @param accelerations m/s^2, of the grains in the last step
    ContactKernel(const PreparedLaws<S>& preparedLaws, double step, ContactTiming contactTiming,
                  const OverlapWatch& watch, ContactStore& contactStore, const Vector<double>* accelerations,
                  const OwnTotals& forceTotals, bool withSamples)
        : overlaps(watch),
          laws(preparedLaws),
          timeStep(step),
          implicitStep(contactTiming.implicitForces ? step : 0),
          timing(contactTiming),
          acceleration(accelerations),
          store(contactStore),
          memory(contactStore.memory),
          quantum(contactStore.totals.quantum),
          own(forceTotals),
          ledger(withSamples),
          amongTorques(S::hasTorque || contactStore.memory.getLayout().hasTorque) {}

    /// The overlaps and capillary numbers of the contacts that this kernel has computed.
    OverlapWatch overlaps;
    CapillaryWatch capillaryNumbers;
    double springsAhead = 0;           // s, as of ContactTask
    double unlisted = 0, longest = 0;  // m, the same

    /// @return false if the block needs memory first; it is marked then
    /// @param geometryOf (block) its geometry, which is made in here: what would come from outside, or be
    /// handed out, would lie in memory
    template <class GeometryOf>
    [[gnu::flatten]] bool computeBlock(std::size_t number, const GeometryOf& geometryOf) {
        auto geometry = geometryOf(number);
        using Geometry = decltype(geometry);
        BlockState& state = store.states[number];
        const std::uint32_t block = store.slots[number];  // of the memory
        const Mask listed = maskFromBits(state.listed);
        Mask touching = geometry.overlapping() & listed;
        Mask joined = touching | maskFromBits(state.bridged);
        if constexpr (Adhesion::acts && !Adhesion::formsAtContact) joined = listed;
        if constexpr (HasFilmContactGap<Adhesion>)
            if (laws.adhesion.filmContactGap > 0)
                joined = joined | (listed & geometry.isWithin(laws.adhesion.filmContactGap));
        if (none(joined)) {
            clear(block, state);
            if constexpr (requires { geometry.approachUntilWithin(0.0); })
                if (block == ContactStore::asleep)
                    sleepOn(number, copyOf(geometry.approachUntilWithin(gapOfFirstForce())));
            return true;
        }
        if (block == ContactStore::asleep) {
            store.slots[number] = ContactStore::waking;
            return false;
        }

        ContactGeometry<Pack> g = geometry.complete();
        if constexpr (resists != BridgeResists::Nothing && S::hasTorque) geometry.completeSpins(g);
        if (any(touching & (g.overlap > overlaps.level() * g.effectiveRadius))) [[unlikely]]
            overlaps.note(bits(touching), copyOf(g.overlap), copyOf(g.effectiveRadius));
        // A step of no length, at the start of a scene, finds overlaps that did not begin in it.
        const Mask begins = maskFromBits(timeStep > 0 && timing.timesTouches ? 0xff : 0) & touching &
                            !maskFromBits(state.touching);

        Pack adhesive = 0, range = 0;  // N; m, of an attraction that jumps at its end
        Mask bridged = touching & !touching;
        if constexpr (Adhesion::acts) {
            if constexpr (ShapedGeometry<Geometry>) geometry.prepareAdhesion(memory, block, joined);
            const auto interaction = memory.interaction.load<Interaction>(block);
            const Pack separation = separationFor<Adhesion>(g.overlap);
            if constexpr (HasDynamicRupture<Adhesion>) {
                const Pack range = interaction.range(laws.adhesion, -dot(g.velocity, g.normal));
                bridged = joined & (separation < range);
                adhesive = select(bridged, interaction.force(laws.adhesion, separation, range), Pack(0));
            } else {
                bridged = joined & (separation < interaction.range());
                adhesive = select(bridged, interaction.force(separation), Pack(0));
                if constexpr (JumpsAtEnds<Adhesion>) range = interaction.range();
            }
            if constexpr (HasLargestCapillaryNumber<Adhesion>) {
                const Pack number =
                    interaction.numberAboveBound(laws.adhesion, separation, -dot(g.velocity, g.normal));
                if (any(bridged & (number > Pack(0)))) [[unlikely]]
                    capillaryNumbers.note(bits(bridged), number);
            }
        }
        if constexpr (bridgesPullAlone && !ShapedGeometry<Geometry>)
            if (none(touching) && state.touching == 0 && !ledger) {
                writeRecords(block, geometry, g.normal, max(g.overlap, Pack(0)), Pack(0) - adhesive, zero());
                state.bridged = bits(bridged);
                state.closing = 0;
                return true;
            }
        LastForces last = loadLastForces(block, geometry);
        Pack pull = 0;  // N, attraction of the normal law
        if constexpr (PullsInContact<Normal>) {
            pull = select(touching, Normal::pull(laws.normal, g.effectiveRadius), Pack(0));
            adhesive = adhesive + pull;
        }
        NormalPart normal = computeNormal(block, state, g, last.normalForce, touching, bridged, begins,
                                          adhesive, pull, range);
        if constexpr (JumpsAtEnds<Adhesion> || PullsInContact<Normal>) adhesive = normal.adhesive;
        Pack normalForce = normal.repulsion - adhesive;
        if constexpr (resists != BridgeResists::Nothing)
            normalForce = normalForce + select(bridged, normal.viscous, Pack(0));
        if (ledger) [[unlikely]] {
            writeSamples(block, copyOf(g.normal.x), copyOf(g.normal.y), copyOf(g.normal.z),
                         copyOf(normal.lever), copyOf(normal.contact.overlap), copyOf(g.effectiveRadius),
                         copyOf(normal.contact.effectiveMass), copyOf(normal.elastic),
                         copyOf(normal.repulsion), copyOf(adhesive),
                         resists != BridgeResists::Nothing ? copyOf(normal.viscous) : Pack(0), touching,
                         PullsInContact<Normal> ? bridged | touching : bridged);
            if constexpr (ShapedGeometry<Geometry>) geometry.writeArms(memory, block);
        }
        if constexpr (Creeps<Normal>)
            if (ledger) [[unlikely]]
                writeCreep(block, copyOf(normal.contact.overlap), copyOf(normal.contact.effectiveRadius),
                           copyOf(normal.contact.effectiveMass), touching, normal.creep);
        Vector<Pack> tangential = zero(), lastTorque = zero();
        if constexpr (resists >= BridgeResists::Rolling) lastTorque = loadTorques(block);
        if constexpr (Friction::acts) {
            tangential = computeFriction(number, block, geometryOf, geometry, g, last.leverless, lastTorque,
                                         touching, begins, normal);
        }
        if constexpr (resists >= BridgeResists::Sliding)
            tangential = tangential + computeDrag(block, g, last.leverless, lastTorque, bridged,
                                                  normal.resistance, tangential);

        if constexpr (ShapedGeometry<Geometry>) {
            Vector<Pack> couple = zero();
            if constexpr (S::hasContactTorque) {
                couple = loadTorques(block);
                geometry.keepTorque(memory, block, couple);
            }
            geometry.writeRecords(memory, block, touching | bridged, normalForce, tangential, couple);
        } else {
            writeRecords(block, geometry, g.normal, normal.lever, normalForce, tangential);
        }
        state.touching = bits(touching);
        state.bridged = bits(bridged);
        state.closing = bits(normal.closing);
        if constexpr (JumpsAtEnds<Adhesion>) state.closing |= bits(normal.snaps & !touching);
        return true;
    }

private:
    /// Between bodies that have a bridge and do not touch nothing acts but its pull, which depends on their
    /// distance alone; what contacts of a block remember is zero while none of them touches.
    static constexpr bool bridgesPullAlone = Adhesion::acts && resists == BridgeResists::Nothing &&
                                             !JumpsAtEnds<Adhesion> && !PullsInContact<Normal> &&
                                             !Creeps<Normal> && !S::hasContactTorque;

    /// The forces of the last step on eight contacts. The tangential force in today's tangential plane is
    /// (n x F) x n.
    struct LastForces {
        Vector<Pack> leverless;  // N, n x F; zero without friction
        Pack normalForce;        // N
    };
    /// The normal history of eight contacts before and after their creep in the step.
    struct Creep {
        NormalHistory<Pack> before, after;
    };
    struct NoCreep {};
    struct NormalPart {
        Pack repulsion;  // N, elastic and damping
        Pack elastic;    // N
        Pack damping;    // kg/s
        Pack approach;   // m/s, at the sample
        Pack viscous;    // N, repulsion of a bridge that resists
        Pack adhesive;  // N, of an attraction that jumps at its ends, or of the normal law: its mean over the
                        // time of the sample
        BridgeResistance<Pack> resistance;
        Pack lever;  // m, of the overlap: half of it, each body's lever arm is shorter than its radius
        Contact<Pack> contact;
        SampleTiming<Pack> timing;
        Mask closing;  // the touch ends in the step that comes
        Mask snaps;    // the neck does, of an attraction that jumps at its ends
        [[no_unique_address]] std::conditional_t<Creeps<Normal>, Creep, NoCreep> creep;
    };

    /// The normal force with the approach speed at the end of the step. Grains carry the predicted velocity v
    /// + a dt, with the acceleration a of the last step; here it gets the change of this contact's own force,
    /// (F - F_last) dt / (2 m*), in which the dashpot is implicit. For two grains that makes the step exactly
    /// the trapezoidal rule.
    /// @param adhesive N, all attraction; @param pull N, of it that of the normal law
    /// @param range m, of an attraction that jumps at its end
    NormalPart computeNormal(std::size_t block, const BlockState& state, const ContactGeometry<Pack>& g,
                             const Pack& lastNormalForce, Mask touching, [[maybe_unused]] Mask bridged,
                             Mask begins, Pack adhesive, [[maybe_unused]] Pack pull,
                             [[maybe_unused]] Pack range) {
        NormalPart part;
        if constexpr (PullsInContact<Normal>) part.adhesive = adhesive;
        part.contact = {max(g.overlap, Pack(0)), g.effectiveRadius, g.effectiveMass};
        part.lever = part.contact.overlap;
        if constexpr (resists >= BridgeResists::Sliding) part.lever = g.lever;
        auto history = memory.normalHistory.load<NormalHistory>(block);
        if constexpr (Creeps<Normal>) {
            part.creep.before = history;
            Normal::creep(laws.normal, part.contact, Pack(timeStep), history);
            part.creep.after = history;
        }
        NormalForce<Pack> force = normalForce<Normal>(laws.normal, part.contact, history);
        memory.normalHistory.store<NormalHistory>(block, selectColumns<NormalHistory>(touching, history));
        force.damping = select(touching, force.damping, Pack(0));

        const Pack halfStep = Pack(implicitNeighbours<Adhesion> * 0.5 * implicitStep) * g.inverseMass;
        const Pack predicted = dot(g.velocity, g.normal);
        Pack known = -adhesive;  // N, the repulsion that needs no speed, without the elastic one
        if constexpr (resists != BridgeResists::Nothing) {
            const Pack push = select(touching, fma(force.damping, predicted, force.elastic), Pack(0));
            part.resistance = askResistance(block, g, bridged, maskFromBits(state.bridged), push - adhesive,
                                            lastNormalForce);
            known = part.resistance.force - adhesive;
        }
        const auto withBridge = [&](Pack damping) {
            if constexpr (resists != BridgeResists::Nothing) return damping + part.resistance.normal;
            else return damping;
        };
        const auto approachWith = [&](Pack damping) {
            return fma(-halfStep, force.elastic + known - lastNormalForce, predicted) /
                   fma(halfStep, withBridge(damping), Pack(1));
        };

        part.damping = force.damping;
        part.approach = approachWith(part.damping);
        part.timing = {Pack(0.5), Pack(0.5)};
        const Pack acceleration =
            Pack(-timeStep * timeStep) * g.inverseMass *
            (fma(withBridge(part.damping), part.approach, force.elastic) + known);  // m/step^2
        const Pack approachInStep = part.approach * timeStep;
        const Pack nextOverlap = fma(Pack(0.5), acceleration, g.overlap + approachInStep);
        part.closing = touching & (part.approach < Pack(0)) & (nextOverlap <= Pack(0)) &
                       maskFromBits(timing.timesTouches ? 0xff : 0);
        const auto sinceBegin = [&] {
            return select(predicted > Pack(0), min(g.overlap / (predicted * timeStep), Pack(1)), Pack(1));
        };
        if constexpr (JumpsAtEnds<Adhesion>) {
            const Pack left = g.overlap + range;
            part.snaps = bridged & (part.approach < Pack(0)) &
                         (fma(Pack(0.5), acceleration, left + approachInStep) <= Pack(0)) &
                         maskFromBits(timing.timesTouches ? 0xff : 0);
            SampleTiming<Pack> neck{Pack(0.5), Pack(0.5)};
            const Mask forms = begins & !maskFromBits(state.bridged);
            if (any(forms)) neck.before = select(forms, sinceBegin(), neck.before);
            if (any(part.snaps)) {
                const Mask covered = part.snaps & maskFromBits(state.closing & ~state.touching);
                neck.before = select(covered, Pack(0), neck.before);
                neck.after = select(part.snaps, timeToEnd(left, approachInStep, acceleration), neck.after);
            }
            if constexpr (PullsInContact<Normal>)
                part.adhesive = fma(adhesive - pull, neck.before + neck.after, pull);
            else part.adhesive = adhesive * (neck.before + neck.after);
            known = -part.adhesive;
            part.approach = approachWith(part.damping);
        }
        if (any(begins | part.closing)) {
            part.timing.before = select(begins, sinceBegin(), Pack(0.5));
            part.timing.after =
                select(part.closing, timeToEnd(g.overlap, approachInStep, acceleration), Pack(0.5));
            const Mask covered =
                part.closing & maskFromBits(state.closing);  // the last step stands for this time too
            part.timing.before = select(covered, Pack(0), part.timing.before);
            if constexpr (PullsInContact<Normal>) {
                const Pack missing = pull * (Pack(1) - part.timing.before - part.timing.after);
                part.adhesive = part.adhesive - missing, known = known + missing;
            }
            part.damping = force.damping * part.timing.factor(Normal::dampingExponent, begins, part.closing);
            force.elastic = force.elastic * part.timing.factor(Normal::elasticExponent, begins, part.closing);
            part.approach = approachWith(part.damping);
        }
        part.elastic = force.elastic;
        if constexpr (resists != BridgeResists::Nothing)
            part.viscous = fma(part.resistance.normal, part.approach, part.resistance.force);
        part.repulsion = select(touching, fma(part.damping, part.approach, force.elastic), Pack(0));
        return part;
    }

    /// The ways (m) of tangential springs that are at their place at the force, and so move for the time from
    /// the last force (or from the start of the touch) with the velocity in the middle of that time: the
    /// velocity that grains carry, less the acceleration for half the time. For springs without dashpots that
    /// is velocity Verlet, which neither feeds nor damps them.
    struct MovedSprings {
        Vector<Pack> sliding, turning;
    };
    /// What it takes of the geometry.
    struct SpringMotion {
        Vector<Pack> normal, velocity, spinLever, spinDifference;
        Pack lever, effectiveRadius;
    };
    static SpringMotion motionOf(const ContactGeometry<Pack>& g, const Pack& lever) {
        const auto copy = [](const Vector<Pack>& v) {
            return Vector<Pack>{copyOf(v.x), copyOf(v.y), copyOf(v.z)};
        };
        SpringMotion motion{copy(g.normal), copy(g.velocity), copy(g.spinLever),
                            zero(),         copyOf(lever),    Pack(0)};
        if constexpr (HasContactTorque<Friction>) {
            motion.spinDifference = copy(g.spinDifference);
            motion.effectiveRadius = copyOf(g.effectiveRadius);
        }
        return motion;
    }
    /// Not gnu::cold, which g++ compiles for size: adaptive steps take this in every step. It gets copies,
    /// and makes a geometry for what accelerations need of it, as one that is handed over costs all other
    /// schemes stores to the stack.
    /// @param steps of that time
    template <class GeometryOf>
    [[gnu::noinline]] MovedSprings moveSprings(std::size_t number, const GeometryOf& geometryOf,
                                               SpringMotion g, Pack steps) const {
        const auto geometry = geometryOf(number);
        const ContactAcceleration<Pack> a = geometry.accelerations(acceleration, g.lever);
        const Pack time = Pack(timeStep) * steps, half = Pack(-0.5) * time;
        const Vector<Pack> velocity =
            fma(half, a.velocity, g.velocity) + cross(fma(half, a.spinLever, g.spinLever), g.normal);
        MovedSprings moved{time * (velocity - dot(velocity, g.normal) * g.normal), zero()};
        if constexpr (HasContactTorque<Friction>)
            moved.turning = (time * g.effectiveRadius) * fma(half, a.spinDifference, g.spinDifference);
        return moved;
    }

    template <class GeometryOf, class Geometry>
    Vector<Pack> computeFriction([[maybe_unused]] std::size_t number, std::size_t block,
                                 [[maybe_unused]] const GeometryOf& geometryOf, const Geometry& geometry,
                                 ContactGeometry<Pack>& g, const Vector<Pack>& lastLeverless,
                                 [[maybe_unused]] const Vector<Pack>& lastTorque, Mask touching, Mask begins,
                                 const NormalPart& normal) {
        if constexpr (resists == BridgeResists::Nothing) geometry.completeSpins(g);
        const Pack approach = dot(g.velocity, g.normal);
        const Vector<Pack> sideways = fma(-approach, g.normal, g.velocity);
        // As in computeNormal, the predicted velocity gets the change of this contact's own force since the
        // last step; 1/m + r^2/I of a solid sphere is 7/2 of 1/m.
        Pack response;
        if constexpr (ShapedGeometry<Geometry>)
            response = Pack(0.5 * implicitStep) * geometry.slidingResponse();
        else response = Pack(3.5 * 0.5 * implicitStep) * g.inverseMass;
        const Vector<Pack> lever = fma(-response, lastLeverless, g.spinLever);
        const double before = timing.timesTouches ? 0.5 : 1;  // steps for which the spring has still to move
        Slip<Pack> slip{.velocity = sideways + cross(lever, g.normal),
                        .timeBefore = timeStep * select(begins, normal.timing.before, Pack(before)),
                        .timeAfter = Pack(timeStep * (1 - before)),
                        .response = response};
        // The last force that was taken out is that of the bridge, too: its drag is part of the motion.
        [[maybe_unused]] BridgeSlip<Pack> freely;
        if constexpr (resists >= BridgeResists::Sliding) {
            freely = {slip.velocity, zero(), response, Pack(0)};
            if constexpr (resists >= BridgeResists::Rolling) setRoll(freely, g, zero() - lastTorque);
            const MotionWithDrag<Pack> with(normal.resistance, freely);
            slip.velocity = with.slip, slip.response = with.slipResponse;
        }
        if (springsAhead > 0) [[unlikely]] {
            const Pack ahead = springsAhead;
            slip.timeBefore = select(maskFromBits(store.states[number].touching), -ahead, Pack(0));
            slip.timeAfter = ahead;
        }
        auto history = memory.history.load<History>(block);
        Vector<Pack> normalShift;
        if constexpr (ShapedGeometry<Geometry>) normalShift = geometry.normalShift();
        else normalShift = (Pack(-timeStep) * g.inverseDistance) * sideways;
        history.turn({.normal = g.normal,
                      .normalShift = normalShift,
                      .twist = Pack(0.5 * timeStep) * dot(g.spinSum, g.normal)});
        if (timing.springsInStep) [[unlikely]] {
            MovedSprings moved = moveSprings(number, geometryOf, motionOf(g, normal.lever),
                                             select(begins, normal.timing.before, Pack(1)));
            slip.timeBefore = slip.timeAfter = Pack(0);
            history.move(moved.sliding);
            if constexpr (HasContactTorque<Friction>) history.moveRotation(moved.turning, g.normal);
        }
        SliderForce<Pack> force = sliderForce<Friction>(laws.friction, normal.contact,
                                                        max(normal.repulsion, Pack(0)), slip, history);
        if (ledger) [[unlikely]]
            writeSample(block, &ContactSample::sliding, copyOf(force.force.x), copyOf(force.force.y),
                        copyOf(force.force.z), copyOf(force.spring.x), copyOf(force.spring.y),
                        copyOf(force.spring.z), copyOf(force.stiffness), force.slides | force.slips,
                        touching);
        if constexpr (HasContactTorque<Friction>) {
            Vector<Pack> byDrag = zero();  // m/s, R* times the change of the relative spin
            if constexpr (resists >= BridgeResists::Rolling) {
                freely.slip = fma(response, select(touching, force.force, zero()), freely.slip);
                byDrag = cross(MotionWithDrag<Pack>(normal.resistance, freely).roll - freely.roll, g.normal);
            }
            computeRotation(block, geometry, g, touching, normal, slip, byDrag, history);
        }
        memory.history.store<History>(block, selectColumns<History>(touching, history));
        return select(touching, force.force, zero());
    }

    /// The resistance of the bridges in this step; zero where there are none.
    /// @param push N, normal repulsion by what else acts in the contact; @param last N, by all that acted in
    /// it
    BridgeResistance<Pack> askResistance(std::size_t block, const ContactGeometry<Pack>& g, Mask bridged,
                                         Mask before, Pack push, Pack last) {
        const auto interaction = memory.interaction.load<Interaction>(block);
        Interaction<Pack> moved = interaction;
        Pack asymmetry = 0;
        if constexpr (resists >= BridgeResists::Rolling) asymmetry = g.asymmetry;
        BridgeResistance<Pack> r =
            moved.resist(laws.adhesion, {.separation = -g.overlap,
                                         .approach = dot(g.velocity, g.normal),
                                         .step = Pack(timeStep),
                                         .coming = Pack(timing.comingStep > 0 ? timing.comingStep : timeStep),
                                         .effectiveRadius = g.effectiveRadius,
                                         .inverseMass = g.inverseMass,
                                         .push = push,
                                         .last = last,
                                         .asymmetry = asymmetry,
                                         .forms = bridged & !before});
        for (Pack* part : {&r.normal, &r.sliding, &r.coupling, &r.rolling, &r.force})
            *part = select(bridged, *part, Pack(0));
        memory.interaction.store<Interaction>(block, selectColumns<Interaction>(bridged, moved, interaction));
        return r;
    }

    /// The tangential force of the bridges; their torque is added to that of friction. As in
    /// computeFriction, velocities get the change of the contact's own force and torque since the last step.
    /// @param friction N, that acts on body 1 besides
    Vector<Pack> computeDrag(std::size_t block, const ContactGeometry<Pack>& g,
                             const Vector<Pack>& lastLeverless, const Vector<Pack>& lastTorque, Mask bridged,
                             const BridgeResistance<Pack>& resistance, const Vector<Pack>& friction) {
        const Pack response = Pack(implicitNeighbours<Adhesion> * 3.5 * 0.5 * implicitStep) * g.inverseMass;
        const Vector<Pack> sideways = fma(-dot(g.velocity, g.normal), g.normal, g.velocity);
        const Vector<Pack> lever = fma(-response, lastLeverless, g.spinLever);
        Vector<Pack> own = zero();  // N m, of friction
        BridgeSlip<Pack> motion{.slip = fma(response, friction, sideways + cross(lever, g.normal)),
                                .roll = zero(),
                                .slipResponse = response,
                                .rollResponse = Pack(0)};
        if constexpr (resists >= BridgeResists::Rolling) {
            if constexpr (HasContactTorque<Friction>) own = loadTorques(block);
            setRoll(motion, g, own - lastTorque);
        }
        BridgeDrag<Pack> drag = bridgeDrag(resistance, motion, g.normal);
        drag = {select(bridged, drag.force, zero()), select(bridged, drag.torque, zero())};
        if constexpr (resists >= BridgeResists::Rolling)
            storeTorques(block, own + g.effectiveRadius * drag.torque);
        if (ledger) [[unlikely]]
            writeDrag(block, drag, bridged);
        return drag.force;
    }

    /// The roll of two grains, with the change (N m, on body 1) of the torque of their contact.
    void setRoll(BridgeSlip<Pack>& motion, const ContactGeometry<Pack>& g, const Vector<Pack>& change) const {
        motion.rollResponse = Pack(0.5 * implicitStep) * g.rotationResponse;
        motion.roll = cross(g.normal, g.effectiveRadius * g.spinDifference +
                                          (motion.rollResponse / g.effectiveRadius) * change);
    }

    /// Writes the contact's own torque. Velocity and response are those of R* times the relative spin, as in
    /// computeFriction.
    /// @param sliding the times of its Slip are those of the rotation
    /// @param byDrag m/s, of the velocity, by the drag of a bridge
    template <class Geometry, class History>
    void computeRotation(std::size_t block, [[maybe_unused]] const Geometry& geometry,
                         const ContactGeometry<Pack>& g, Mask touching, const NormalPart& normal,
                         const Slip<Pack>& sliding, [[maybe_unused]] const Vector<Pack>& byDrag,
                         History& history) {
        const Pack response = Pack(0.5 * implicitStep) * g.rotationResponse;
        Vector<Pack> torque;
        if constexpr (ShapedGeometry<Geometry>) torque = geometry.lastTorque(memory, block);
        else torque = loadTorques(block);
        const Vector<Pack> last = (Pack(1) / g.effectiveRadius) * torque;
        Vector<Pack> velocity = g.effectiveRadius * g.spinDifference - response * last;
        if constexpr (resists >= BridgeResists::Rolling) velocity = velocity + byDrag;
        const Slip<Pack> turning{.velocity = velocity,
                                 .timeBefore = sliding.timeBefore,
                                 .timeAfter = sliding.timeAfter,
                                 .response = response};
        const auto forces = Friction::rotate(laws.friction, normal.contact, max(normal.repulsion, Pack(0)),
                                             g.normal, turning, history);
        if (ledger) [[unlikely]] {
            const auto write = [&](SliderSample ContactSample::*part, const SliderForce<Pack>& f) {
                writeSample(block, part, copyOf(f.force.x), copyOf(f.force.y), copyOf(f.force.z),
                            copyOf(f.spring.x), copyOf(f.spring.y), copyOf(f.spring.z), copyOf(f.stiffness),
                            f.slides | f.slips, touching);
            };
            write(&ContactSample::rolling, forces.rolling);
            write(&ContactSample::torsion, forces.torsion);
        }
        storeTorques(
            block, g.effectiveRadius * select(touching, forces.rolling.force + forces.torsion.force, zero()));
    }

    // N m, of eight contacts, on body 1.
    [[nodiscard]] Vector<Pack> loadTorques(std::size_t block) const {
        static constexpr std::array<std::uint32_t, Pack::lanes> each{0, 1, 2, 3, 4, 5, 6, 7};
        const auto* base = reinterpret_cast<const double*>(&memory.torques[block * Pack::lanes]);
        auto [x, y, z] = loadRecords<3>(base, 4, each.data());
        return {x, y, z};
    }
    void storeTorques(std::size_t block, const Vector<Pack>& torque) {
        auto* base = reinterpret_cast<double*>(&memory.torques[block * Pack::lanes]);
        storeRecords(base, std::array<Pack, 4>{torque.x, torque.y, torque.z, Pack(0)});
    }

    /// Whether the records of the scene have a torque: always so for laws that have one, and for others where
    /// another pair of species has one.
    [[nodiscard]] bool writesTorques() const { return S::hasTorque || amongTorques; }
    [[nodiscard]] double* forcesAt(std::size_t block) const {
        return reinterpret_cast<double*>(&memory.forces[block * Pack::lanes]);
    }
    /// A column of the records of a block.
    [[nodiscard]] double* columnAt(std::size_t block, std::size_t column) const {
        return memory.records.ofBlock(block) + column * Pack::lanes;
    }
    template <class Geometry>
    [[nodiscard]] LastForces loadLastForces(std::size_t block,
                                            [[maybe_unused]] const Geometry& geometry) const {
        if (!writesTorques()) return {{}, gatherColumn(forcesAt(block) + 3, 4)};
        const Pack normalForce = Pack::load(columnAt(block, RecordColumns::normalForce));
        if constexpr (S::hasTorque) {
            const auto load = [&](std::size_t column) __attribute__((always_inline)) {
                return Pack::load(columnAt(block, column));
            };
            if constexpr (ShapedGeometry<Geometry>)
                return {cross(geometry.lastNormal(), {load(0), load(1), load(2)}), normalForce};
            constexpr std::size_t first = RecordColumns::leverless;
            return {{load(first), load(first + 1), load(first + 2)}, normalForce};
        } else {
            return {{}, normalForce};
        }
    }

    template <class Geometry>
    void writeRecords(std::size_t block, const Geometry& geometry, const Vector<Pack>& direction,
                      Pack overlap, Pack normalForce, const Vector<Pack>& tangential) {
        Vector<Pack> force = -normalForce * direction, leverless = zero();
        if constexpr (S::hasTorque) {
            force = fma(-normalForce, direction, tangential);
            leverless = cross(direction, tangential);
        }
        const Pack half = Pack(0.5) * overlap;
        if (writesTorques()) storeColumns(memory.records.ofBlock(block), force, half, leverless, normalForce);
        else storeRecords(forcesAt(block), std::array<Pack, 4>{force.x, force.y, force.z, normalForce});
        if (own.totals != nullptr) addToTotals(block, geometry, force, half, leverless);
    }

    /// Adds the forces to the totals of both bodies, as sumQuanta() does (ParticleSum.h).
    /// @param half m, of the overlap
    template <class Geometry>
    [[gnu::always_inline]] void addToTotals([[maybe_unused]] std::size_t block, const Geometry& geometry,
                                            const Vector<Pack>& force, Pack half,
                                            const Vector<Pack>& leverless) {
        Vector<Pack> couple = zero();
        if constexpr (S::hasContactTorque) couple = loadTorques(block);
        if constexpr (requires { geometry.radius2; }) {
            addToTotals(geometry.block.first, geometry.radius1, force, half, leverless, couple);
            addToTotals(geometry.block.second, geometry.radius2, -force, half, leverless, -couple);
        } else {
            // The grain of a lane without a contact may have been removed: its radius is zero, then.
            addToTotals(geometry.block.first, max(geometry.radius, Pack(1e-30)), force, half, leverless,
                        couple);
        }
    }
    [[gnu::always_inline]] void addToTotals(const std::array<std::uint32_t, Pack::lanes>& grains, Pack radius,
                                            const Vector<Pack>& force, Pack half,
                                            const Vector<Pack>& leverless,
                                            [[maybe_unused]] const Vector<Pack>& couple) {
        if (own.marks != nullptr)
            for (const std::uint32_t grain : grains) own.marks[grain / OwnTotals::grainsOfAMark] = 1;
        const Pack perNewton = quantum.perNewton(radius),
                   perNewtonMetre = ForceQuantum::perNewtonMetre(radius, perNewton);
        const Pack beyond = select(ForceQuantum::fits(force, perNewton), Pack(0), Pack(1));
        Vector<Pack> whole = perNewton * force, torque;
        if constexpr (S::hasContactTorque) torque = fma(radius - half, leverless, couple);
        else if constexpr (S::hasTorque) torque = (radius - half) * leverless;
        else torque = zero();
        torque = perNewtonMetre * torque;
        addNearestIntegers(
            reinterpret_cast<std::int64_t*>(own.totals), grains.data(),
            std::array<Pack, 8>{whole.x, whole.y, whole.z, beyond, torque.x, torque.y, torque.z, Pack(0)});
    }

    // Arguments are passed by value: what the kernel hands out by reference it would have to keep in memory
    // in every step.

    /// Writes what the ledger reads of eight contacts, without their friction. Not gnu::cold: with a ledger
    /// it is called for each block.
    [[gnu::noinline]] void writeSamples(std::size_t block, Pack normalX, Pack normalY, Pack normalZ,
                                        Pack lever, Pack overlap, Pack effectiveRadius, Pack effectiveMass,
                                        Pack elastic, Pack repulsion, Pack adhesive,
                                        [[maybe_unused]] Pack viscous, Mask touching, Mask bridged) {
        const Pack dashpot = repulsion - select(touching, elastic, Pack(0));
        for (int k = 0; k < Pack::lanes; ++k) {
            const std::size_t at = block * Pack::lanes + static_cast<std::size_t>(k);
            ContactSample& sample = memory.energies[at].now;
            static_cast<CoreSample&>(sample) = {};
            if constexpr (HasContactTorque<Friction>) static_cast<CoupleSample&>(sample) = {};
            if constexpr (resists != BridgeResists::Nothing) sample.bridge = {};
            const bool touches = laneOf(touching, k), joins = laneOf(bridged, k);
            if (!touches && !joins) continue;
            sample.touching = touches ? 1 : 0;
            sample.bridged = joins ? 1 : 0;
            sample.normal = {normalX[k], normalY[k], normalZ[k]};
            sample.halfOverlap = 0.5 * lever[k];
            sample.effectiveRadius = effectiveRadius[k];
            sample.adhesiveForce = adhesive[k];
            if constexpr (resists != BridgeResists::Nothing) sample.bridge.normalForce = viscous[k];
            if (!touches) continue;
            const Contact<double> contact{overlap[k], effectiveRadius[k], effectiveMass[k]};
            sample.elasticForce = elastic[k];
            sample.dashpotForce = dashpot[k];
            sample.elasticEnergy = elasticEnergyAt(at, contact);
        }
    }
    [[nodiscard]] double elasticEnergyAt(std::size_t at, const Contact<double>& contact) const {
        NormalHistory<double> history{};
        if constexpr (HasNormalHistory<Normal>)
            memory.normalHistory.get(at, reinterpret_cast<double*>(&history));
        return elasticEnergy<Normal>(laws.normal, contact, history);
    }
    /// Writes what the creep of the law has taken of the elastic energy.
    [[gnu::noinline, gnu::cold]] void writeCreep(std::size_t block, Pack overlap, Pack effectiveRadius,
                                                 Pack effectiveMass, Mask touching, Creep creep) {
        for (int k = 0; k < Pack::lanes; ++k) {
            if (!laneOf(touching, k)) continue;
            NormalHistory<double> before{}, after{};
            forEachNumber<NormalHistory>(
                [&](std::size_t c, const Pack& was, const Pack& is) {
                    reinterpret_cast<double*>(&before)[c] = was[k];
                    reinterpret_cast<double*>(&after)[c] = is[k];
                },
                creep.before, creep.after);
            const Contact<double> contact{overlap[k], effectiveRadius[k], effectiveMass[k]};
            memory.energies[block * Pack::lanes + static_cast<std::size_t>(k)].now.creepLoss =
                Normal::creepLoss(laws.normal, contact, before, after);
        }
    }
    [[gnu::noinline]] void writeSample(std::size_t block, SliderSample ContactSample::*part, Pack forceX,
                                       Pack forceY, Pack forceZ, Pack springX, Pack springY, Pack springZ,
                                       Pack stiffness, Mask slides, Mask touching) {
        const Vector<Pack> stretch{springX, springY, springZ},
            spring = -stiffness * stretch, rest = Vector<Pack>{forceX, forceY, forceZ} - spring;
        const Pack stretch2 = squaredNorm(stretch);
        for (int k = 0; k < Pack::lanes; ++k)
            if (laneOf(touching, k))
                memory.energies[block * Pack::lanes + static_cast<std::size_t>(k)].now.*
                    part = {laneOf(spring, k), laneOf(rest, k), stretch2[k], stiffness[k],
                            laneOf(slides, k) ? 1.0 : 0.0};
    }
    [[gnu::noinline, gnu::cold]] void writeDrag(std::size_t block, BridgeDrag<Pack> drag, Mask bridged) {
        for (int k = 0; k < Pack::lanes; ++k) {
            if (!laneOf(bridged, k)) continue;
            BridgeSample& sample =
                memory.energies[block * Pack::lanes + static_cast<std::size_t>(k)].now.bridge;
            sample.drag = laneOf(drag.force, k);
            if constexpr (resists >= BridgeResists::Rolling) sample.torque = laneOf(drag.torque, k);
        }
    }
    static Vector<Pack> zero() { return {Pack(0), Pack(0), Pack(0)}; }
    static bool laneOf(Mask mask, int k) { return (bits(mask) >> k & 1) != 0; }
    static Vector<double> laneOf(const Vector<Pack>& v, int k) { return {v.x[k], v.y[k], v.z[k]}; }

    /// m, the largest gap at which two bodies that have not touched can begin to act on each other.
    [[nodiscard]] double gapOfFirstForce() const {
        if constexpr (HasFilmContactGap<Adhesion>) return std::max(laws.adhesion.filmContactGap, 0.0);
        else return 0;
    }
    /// A block without memory in which nothing acts yet: it is looked at again when two of its bodies can
    /// have approached by the least (m) of what theirs have left, but by no more than the skin: where images
    /// move `unlisted` counts only for bodies that are not farther apart than it.
    [[gnu::noinline]] void sleepOn(std::size_t number, const Pack& left) {
        store.gaps[number] = unlisted + std::min(longest, smallestOf(left));
    }

    /// A block in which nothing touches or joins any more: its memory and its forces become zero, once.
    void clear(std::size_t block, BlockState& state) {
        if ((state.touching | state.bridged) == 0) return;
        memory.history.store<History>(block, {});
        memory.normalHistory.store<NormalHistory>(block, {});
        if (writesTorques())
            std::fill_n(memory.records.ofBlock(block), RecordColumns::numbers * Pack::lanes, 0.0);
        for (int k = 0; k < Pack::lanes; ++k) {
            if (!writesTorques()) memory.forces[block * Pack::lanes + k] = {};
            if (!memory.torques.empty()) memory.torques[block * Pack::lanes + k] = {};
            if (ledger) memory.energies[block * Pack::lanes + k].now = {};
        }
        state.touching = state.bridged = state.closing = 0;
    }

    const PreparedLaws<S>& laws;
    double timeStep;      // s
    double implicitStep;  // s: the time step, or 0
    ContactTiming timing;
    const Vector<double>* acceleration;  // m/s^2
    ContactStore& store;
    ContactMemory& memory;
    const ForceQuantum quantum;
    const OwnTotals own;
    const bool ledger, amongTorques;
};

}  // namespace pendular
