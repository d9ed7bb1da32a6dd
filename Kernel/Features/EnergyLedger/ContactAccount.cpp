#include "Kernel/Features/EnergyLedger/ContactAccount.h"

#include <algorithm>

namespace pendular {
namespace {

/// How the two bodies of a contact move against each other.
struct RelativeMotion {
    double approach;         // m/s
    Vector<double> slip;     // m/s, at the contact point
    Vector<double> turning;  // m/s, effective radius times relative spin
};

/// m/s, of a wall where a grain touches it. The wall's velocity is that of its point below the centre, which
/// is not where a grain that is no sphere touches.
Vector<double> wallVelocityAt(const ContactSample& s) {
    if (!s.isShaped()) return s.wallVelocity;
    const double below = dot(s.arm1, s.normal) - s.halfOverlap;
    return s.wallVelocity + cross(s.wallSpin, s.arm1 - below * s.normal);
}

RelativeMotion relativeMotion(const ContactSample& sample, const BodyMotion& first, const BodyMotion& second,
                              const ContactKind& kind) {
    const bool isWall = kind.isWall;
    const Vector<double> turning =
        sample.effectiveRadius * (first.spin - (isWall ? sample.wallSpin : second.spin));
    if (kind.isShaped && sample.isShaped()) {
        Vector<double> velocity = first.velocity + cross(first.spin, sample.arm1);
        velocity -= isWall ? wallVelocityAt(sample)
                           : second.velocity + second.slide + cross(second.spin, sample.arm2);
        return {dot(velocity, sample.normal), velocity, turning};
    }
    const Vector<double> velocity =
        first.velocity - (isWall ? sample.wallVelocity : second.velocity + second.slide);
    Vector<double> lever = (first.radius - sample.halfOverlap) * first.spin;
    if (!isWall) lever += (second.radius - sample.halfOverlap) * second.spin;
    return {dot(velocity, sample.normal), velocity + cross(lever, sample.normal), turning};
}

Vector<double> tangentialForce(const ContactSample& s) {
    return s.sliding.spring + s.sliding.rest + s.bridge.drag;
}
/// N, on body 1
Vector<double> forceOnFirst(const ContactSample& s) {
    return (s.adhesiveForce - s.elasticForce - s.dashpotForce - s.bridge.normalForce) * s.normal +
           tangentialForce(s);
}

/// N m, besides that of the force
Vector<double> coupleOnFirst(const ContactSample& s) {
    return s.effectiveRadius *
           (s.rolling.spring + s.rolling.rest + s.torsion.spring + s.torsion.rest + s.bridge.torque);
}

/// W, that a wall gets from the contact where its kinetic energy is in the ledger, reversed.
double givenByPiston(const ContactSample& s, const RigidVelocity& piston) {
    return dot(forceOnFirst(s), piston.linear) + dot(coupleOnFirst(s), piston.spin);
}

/// W, that a wall gives to the contact.
double givenByWall(const ContactSample& s) {
    return dot(forceOnFirst(s), wallVelocityAt(s)) + dot(coupleOnFirst(s), s.wallSpin);
}

/// W, that bodies which are held give to the contact: the force on each times its velocity, reversed.
double givenByHeld(const ContactSample& s, const BodyMotion& first, const BodyMotion& second) {
    const Vector<double> force = forceOnFirst(s), own = coupleOnFirst(s);
    // N m, of the force on the first body about the centre of a body
    const Vector<double> leverless = cross(s.normal, tangentialForce(s));
    const auto torque = [&](const Vector<double>& arm, double radius, double side) {
        return s.isShaped() ? cross(arm, force) : side * (radius - s.halfOverlap) * leverless;
    };
    double given = 0;
    if (first.isHeld)
        given -= dot(force, first.velocity) + dot(torque(s.arm1, first.radius, 1) + own, first.spin);
    if (second.isHeld)
        given += dot(force, second.velocity + second.slide) +
                 dot(torque(s.arm2, second.radius, -1) + own, second.spin);
    return given;
}

/// J, by which the energy k s^2/2 of a spring grows in a step because its stiffness changes, at its mean
/// stretch. One that keeps its force as it gets stiffer loses k_1 s^2/2 (1 - k_1/k_2), with the stretch s
/// before that, which is s_1 of the last sample at first, and becomes s_2.
double gainedByStiffness(const SliderSample& last, const SliderSample& now, bool keepsForce) {
    const double k1 = last.stiffness, k2 = now.stiffness;
    if (!keepsForce || k2 <= k1) return 0.25 * (k2 - k1) * (now.stretch2 + last.stretch2);
    const double ratio = k2 / k1;
    const double before2 = ratio < 2 ? 0.5 * (last.stretch2 + ratio * ratio * now.stretch2) : last.stretch2;
    return -0.5 * k1 * (1 - 1 / ratio) * before2;
}

/// The entries of one spring with dashpot and slider.
struct SliderEntries {
    double &stored, &dashpot, &slider, &stiffening, &stepError;
};

/// @param before, after: velocities (m/s) against which the forces of the two samples work
void addSlider(const SliderSample& last, const SliderSample& now, const Vector<double>& before,
               const Vector<double>& after, bool lasts, bool keepsForce, double step, SliderEntries entries) {
    const double half = 0.5 * step;
    (last.slides > 0 ? entries.slider : entries.dashpot) -= half * dot(last.rest, before);
    (now.slides > 0 ? entries.slider : entries.dashpot) -= half * dot(now.rest, after);

    const double work = -half * (dot(last.spring, before) + dot(now.spring, after));
    // The stored energy k s^2/2 changes by the way, and by the stiffness. When in the step a spring that
    // keeps its force loses some of its stretch is the integrator's: what its energy is short of counts with
    // that.
    const double byStiffness = lasts ? gainedByStiffness(last, now, keepsForce) : 0;
    const double missing = work - (now.stored() - last.stored() - byStiffness);
    const bool follows = keepsForce && lasts && now.stiffness != last.stiffness;
    (now.slides + last.slides > 0 ? entries.slider
     : follows                    ? entries.stiffening
                                  : entries.stepError) += missing;
    entries.stiffening -= byStiffness;
    entries.stored += now.stored();
}

}  // namespace

double slidingWorkAtWall(const EnergyRecord& record, const BodyMotion& grain, const ContactKind& kind,
                         double step) {
    const ContactSample &last = record.last, &now = record.now;
    if (!(now.sliding.slides + last.sliding.slides > 0)) return 0;
    double stored = 0, dashpot = 0, slider = 0, stiffening = 0, stepError = 0;
    addSlider(last.sliding, now.sliding, relativeMotion(last, grain, {}, kind).slip,
              relativeMotion(now, grain, {}, kind).slip, last.touching > 0 && now.touching > 0,
              kind.keepsForce, step, {stored, dashpot, slider, stiffening, stepError});
    return slider;
}

/// The path slid is the work over the force of friction; by the sums of both samples of the step, this is
/// 1/mu of Coulomb's law, and stays bounded where a contact ends.
ContactWear contactWear(const EnergyRecord& record, double slidingWork, const Vector<double>& velocity,
                        double mass) {
    const ContactSample& now = record.now;
    ContactWear done{.slidingWork = slidingWork, .towards = now.acts() ? now.normal : record.last.normal};
    double load = 0, friction = 0;  // N
    for (const ContactSample* sample : {&record.last, &now}) {
        if (!(sample->sliding.slides > 0)) continue;
        load += std::max(sample->elasticForce + sample->dashpotForce, 0.0);
        friction += norm(sample->sliding.spring + sample->sliding.rest);
    }
    if (friction > 0) done.loadTimesPath = slidingWork * load / friction;
    if (!(now.touching > 0) || record.last.touching > 0) return done;
    const Vector<double> against = velocity - now.wallVelocity;
    const double approach = dot(against, now.normal);
    if (!(approach > 0)) return done;
    done.isImpact = true;
    done.mass = mass;
    done.normalSpeed = approach;
    done.tangentialSpeed = norm(against - approach * now.normal);
    return done;
}

void takeNowAsLast(EnergyRecord& record, const ContactKind& kind) {
    ContactSample& last = record.last;
    const ContactSample& now = record.now;
    static_cast<CoreSample&>(last) = now;
    if (kind.isWall) static_cast<WallSample&>(last) = now;
    if (kind.isShaped) static_cast<ArmSample&>(last) = now;
    if (kind.hasCouples) static_cast<CoupleSample&>(last) = now;
    if (kind.resistsMotion) last.bridge = now.bridge;
}

void addContact(EnergyRecord& record, const BodyMotion& first, const BodyMotion& second,
                const ContactKind& kind, double step, EnergyLedger& account) {
    const ContactSample &last = record.last, &now = record.now;
    const RelativeMotion before = relativeMotion(last, first, second, kind);
    const RelativeMotion after = relativeMotion(now, first, second, kind);
    const double half = 0.5 * step;
    const auto against = [&](double ContactSample::*force) {
        return half * (last.*force * before.approach + now.*force * after.approach);
    };
    if (kind.isWall) {
        const double given = half * (givenByWall(last) + givenByWall(now) -
                                     givenByPiston(last, kind.lastPiston) - givenByPiston(now, kind.piston));
        // A membrane's own account has this work, as it was done on the vertices.
        if (kind.isMembrane) account.stepError -= given;
        else account.walls += given;
    }
    if (first.isHeld || second.isHeld)
        account.walls += half * (givenByHeld(last, first, second) + givenByHeld(now, first, second));

    // An image that moves is moved by the shear or strain.
    if (!second.isHeld && second.slide != Vector<double>{0, 0, 0})
        account.images += half * dot(forceOnFirst(last) + forceOnFirst(now), second.slide);

    account.elastic += now.elasticEnergy;
    (kind.isPlastic ? account.plastic : account.stepError) +=
        against(&ContactSample::elasticForce) - (now.elasticEnergy + now.creepLoss - last.elasticEnergy);
    account.sintering += now.creepLoss;
    account.normalDashpots += against(&ContactSample::dashpotForce);

    record.adhesionWork -= against(&ContactSample::adhesiveForce);
    if (now.bridged > 0) account.adhesive += record.adhesionWork;
    else {
        (kind.adhesionBreaks ? account.brokenAdhesion : account.stepError) += record.adhesionWork;
        record.adhesionWork = 0;
    }

    const auto lostInBridge = [&](const BridgeSample& bridge, const RelativeMotion& motion) {
        return half * (bridge.normalForce * motion.approach - dot(bridge.drag, motion.slip) -
                       dot(bridge.torque, motion.turning));
    };
    if (kind.resistsMotion)
        account.viscousBridges += lostInBridge(last.bridge, before) + lostInBridge(now.bridge, after);

    const bool lasts = last.touching > 0 && now.touching > 0;
    const auto entriesOf = [&](double& stored, double& dashpot, double& slider) {
        return SliderEntries{stored, dashpot, slider, account.stiffening, account.stepError};
    };
    addSlider(last.sliding, now.sliding, before.slip, after.slip, lasts, kind.keepsForce, step,
              entriesOf(account.tangentialElastic, account.tangentialDashpots, account.sliding));
    if (kind.hasCouples) {
        addSlider(last.rolling, now.rolling, before.turning, after.turning, lasts, kind.keepsForce, step,
                  entriesOf(account.rollingElastic, account.rolling, account.rolling));
        addSlider(last.torsion, now.torsion, before.turning, after.turning, lasts, kind.keepsForce, step,
                  entriesOf(account.torsionElastic, account.torsion, account.torsion));
    }
}

}  // namespace pendular
