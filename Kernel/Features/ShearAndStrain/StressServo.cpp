#include "Kernel/Features/ShearAndStrain/StressServo.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Features/RigidBodies/BodyArms.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Features/Servos/DampedServo.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {
namespace {

std::array<double, 3> alongAxes(const Vector<double>& v) { return {v.x, v.y, v.z}; }

/// Pa, of the velocities against the flow and the mean of all: along each axis, and between the two axes of a
/// shear.
struct KineticStress {
    std::array<double, 3> along{};
    double across = 0;
};
KineticStress kineticStress(const ParticleStore& grains, const AllRanks& ranks, const PeriodicBox& box,
                            const LeesEdwards& shear, double volume) {
    const auto f = static_cast<std::size_t>(shear.flow), g = static_cast<std::size_t>(shear.gradient);
    ExactSum masses, mixed;
    std::array<ExactSum, 3> momentum, twiceEnergy;
    KineticStress stress;
    const auto add = [&](double inverseMass, const Vector<double>& position, const Vector<double>& of) {
        const auto velocity = alongAxes(of - box.flowAt(position));
        masses.add(1 / inverseMass);
        for (std::size_t a = 0; a < 3; ++a) {
            momentum[a].add(velocity[a] / inverseMass);
            twiceEnergy[a].add(velocity[a] * velocity[a] / inverseMass);
        }
        mixed.add(velocity[f] * velocity[g] / inverseMass);
    };
    for (std::size_t place = 0; place < grains.ownSize(); ++place) {
        const TranslationRecord& grain = grains.translation[place];
        if (grains.isFree(place)) add(grain.inverseMass, grain.position, grain.velocity);
    }
    forEachRigidBody(grains, [&](double own, const Vector<double>& position, const Vector<double>& of) {
        add(1 / own, position, of);
    });
    ranks.addUp({&masses, &mixed, &momentum[0], &momentum[1], &momentum[2], &twiceEnergy[0], &twiceEnergy[1],
                 &twiceEnergy[2]});
    const double mass = masses.value();
    if (mass == 0) return stress;
    const std::array<double, 3> all{momentum[0].value(), momentum[1].value(), momentum[2].value()};
    for (std::size_t a = 0; a < 3; ++a)
        stress.along[a] = std::max(0.0, twiceEnergy[a].value() - all[a] * all[a] / mass) / volume;
    stress.across = (mixed.value() - all[f] * all[g] / mass) / volume;
    return stress;
}

/// The spring of a contact between grains.
struct PressedContact {
    Vector<double> along;  // m, its normal, as long as the way from centre to centre
    Bodies bodies;
    double overlap;  // m
};

/// The dashpots of a contact between grains that overlap or whose bridge resists motion, and its tangential
/// springs.
ContactStiffness rateStiffness(const ContactLaws& ofAll, const Bucket& bucket, const ParticleStore& grains,
                               std::uint32_t first, std::uint32_t second, const PressedContact& contact) {
    const ContactLaws& laws = ofAll.ofPair(bucket.species1, bucket.species2);
    const double mobility = grains.translation[first].inverseMass + grains.translation[second].inverseMass;
    ContactStiffness found;
    if (!(contact.overlap > 0 || laws.resistsMotion) || !(mobility > 0)) return found;
    const PressedPair pair{contact.bodies, 1 / mobility,
                           std::max(contact.overlap, 1e-6 * contact.bodies.effectiveRadius())};
    laws.stiffnesses(bucket.species1, bucket.species2, {&pair, 1}, {&found, 1});
    if (!(contact.overlap > 0)) found.sliding.spring = 0;
    return found;
}

/// Sums over contacts (N m s, N m) of what answers to a rate besides the normal springs: along the axes and
/// in shear.
struct RateSums {
    std::array<ExactSum, 3> dashpots, tangential;
    ExactSum shearDashpot, shearTangential;

    /// @param part shift times branch along each axis over the squared distance; @param squared m^2, the
    /// distance; @param inFlow n_f^2; @param across m^2, squared branch along the gradient
    void add(const ContactStiffness& s, const std::array<double, 3>& part, const HomogeneousStrain& strain,
             double squared, double inFlow, double across) {
        double amounts = 0;
        for (std::size_t a = 0; a < 3; ++a)
            if (strain.axes[a].isControlled) amounts += std::abs(part[a]);
        for (std::size_t a = 0; a < 3; ++a) {
            if (!strain.axes[a].isControlled) continue;
            const double own = std::abs(part[a]), along = squared * own * amounts,
                         beside = squared * own * (std::max(0.0, 1 - own) + amounts - own);
            addUnlessZero(dashpots[a], s.normal.dashpot * along + s.sliding.dashpot * beside);
            addUnlessZero(tangential[a], s.sliding.spring * beside);
        }
        const double beside = across * std::max(0.0, 1 - inFlow);
        addUnlessZero(shearDashpot, s.normal.dashpot * inFlow * across + s.sliding.dashpot * beside);
        addUnlessZero(shearTangential, s.sliding.spring * beside);
    }
    void addUpTo(DiagonalStress& found, const AllRanks& ranks, double volume) {
        ranks.addUp({&dashpots[0], &dashpots[1], &dashpots[2], &tangential[0], &tangential[1], &tangential[2],
                     &shearDashpot, &shearTangential});
        for (std::size_t a = 0; a < 3; ++a) {
            found.dashpot[a] = dashpots[a].value() / volume;
            found.tangential[a] = tangential[a].value() / volume;
        }
        found.shearDashpot = shearDashpot.value() / volume;
        found.shearTangential = shearTangential.value() / volume;
    }

private:
    static void addUnlessZero(ExactSum& sum, double value) {
        if (value != 0) sum.add(value);
    }
};
PressedContact pressedContact(const GrainShapes* shapes, const ParticleStore& grains, std::uint32_t first,
                              std::uint32_t second, const Vector<double>& apart) {
    const double distance = norm(apart);
    if (shapes) {
        const ShapedTouch touch = shapes->touch(grains, first, second, apart);
        return {distance * touch.normal, {touch.radius}, touch.depth};
    }
    const Bodies bodies{grains.translation[first].radius, grains.translation[second].radius};
    return {apart, bodies, bodies.radius1 + bodies.radius2 - distance};
}

}  // namespace

DiagonalStress diagonalStress(const ContactSystem& contacts, const ParticleStore& grains,
                              const HomogeneousStrain& strain, const LeesEdwards& shear) {
    const PeriodicBox& box = contacts.periodicBox();
    const double volume = box.length.x * box.length.y * box.length.z;
    const auto f = static_cast<std::size_t>(shear.flow), g = static_cast<std::size_t>(shear.gradient);
    const KineticStress kinetic = kineticStress(grains, contacts.ranks(), box, shear, volume);
    DiagonalStress found;
    found.stress = kinetic.along;
    found.shear = -kinetic.across;
    found.shearStiffness = kinetic.along[g];
    const auto controlled =
        std::count_if(strain.axes.begin(), strain.axes.end(), [](auto& axis) { return axis.isControlled; });
    for (std::size_t a = 0; a < 3; ++a)
        found.stiffness[a] = static_cast<double>(2 + controlled) * found.stress[a];
    const BodyArms arms(grains);
    const GrainShapes* const shapes = contacts.laws().shapes();
    // N m each: sums over the contacts of force times branch, and of spring times squared branch
    std::array<ExactSum, 3> moments, springs;
    ExactSum shearMoment, shearSpring;
    RateSums ofRates;
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const std::uint32_t place1 = contacts.firstOf(contact), place2 = contacts.secondOf(contact);
        const TranslationRecord &first = grains.translation[place1], &second = grains.translation[place2];
        const Vector<double> apart = box.nearest(second.position - first.position);
        const double distance = norm(apart);
        const PressedContact pressed = pressedContact(shapes, grains, place1, place2, apart);
        const auto& [along, bodies, overlap] = pressed;
        const double spring =
            overlap > 0 ? contacts.laws().normalStiffness(bucket.species1, bucket.species2, bodies, overlap)
                        : 0;
        const auto shift = alongAxes(along), force = alongAxes(contacts.forceOf(contact));
        const auto branch = alongAxes(apart + (arms.at(place1) - arms.at(place2)));
        double share = 0;  // of the controlled axes in the direction of the contact
        std::array<double, 3> part{};
        for (std::size_t a = 0; a < 3; ++a) {
            part[a] = shift[a] * branch[a] / (distance * distance);
            if (strain.axes[a].isControlled) share += part[a];
        }
        ofRates.add(rateStiffness(contacts.laws(), bucket, grains, place1, place2, pressed), part, strain,
                    distance * distance, shift[f] * shift[f] / (distance * distance), branch[g] * branch[g]);
        for (std::size_t a = 0; a < 3; ++a) {
            moments[a].add(force[a] * branch[a]);
            springs[a].add(spring * shift[a] * branch[a] * share);
        }
        shearMoment.add(force[f] * branch[g]);
        shearSpring.add(spring * shift[f] * shift[f] * branch[g] * branch[g] / (distance * distance));
        ++found.touches;
    });
    contacts.ranks().addUp({&moments[0], &moments[1], &moments[2], &springs[0], &springs[1], &springs[2],
                            &shearMoment, &shearSpring});
    found.touches = contacts.ranks().sum(found.touches);
    ofRates.addUpTo(found, contacts.ranks(), volume);
    for (std::size_t a = 0; a < 3; ++a) {
        found.stress[a] -= moments[a].value() / volume;
        found.stiffness[a] += springs[a].value() / volume;
    }
    found.shear += shearMoment.value() / volume;
    found.shearStiffness += shearSpring.value() / volume;
    return found;
}

namespace {

void refuseEndlessStrain(const HomogeneousStrain& strain, const LeesEdwards& shear, double now) {
    constexpr double largestStrain = 3, largestShear = 20;
    constexpr std::array<char, 3> names{'x', 'y', 'z'};
    for (std::size_t a = 0; a < 3; ++a)
        if (std::abs(strain.axes[a].oneWay) > largestStrain)
            throw RunError(fmt::format(
                "At time {:.6g} s the servo of the stress along {} has {} the scene by a factor of e^3, and "
                "the target of {:.6g} Pa is not reached: the grains cannot bear it; take another target.",
                now, names[a], strain.axes[a].oneWay > 0 ? "stretched" : "squeezed", strain.axes[a].stress));
    if (shear.atLargest > largestShear)
        throw RunError(fmt::format(
            "At time {:.6g} s the servo of the shear stress has sheared the scene by {} at its largest rate "
            "of {:.6g} 1/s, and the target of {:.6g} Pa is not reached: the grains cannot bear it; take a "
            "lower target, or a larger rate.",
            now, largestShear, shear.largestRate, shear.stress));
}

}  // namespace

void controlStress(HomogeneousStrain& strain, LeesEdwards& shear, const DiagonalStress& stress,
                   double interval, double now) {
    for (std::size_t a = 0; a < 3; ++a) {
        AxisStrain& axis = strain.axes[a];
        if (!axis.isControlled) continue;
        axis.oneWay += interval * axis.servo.speed;
        lookBesideDashpots(axis.servo, stress.stress[a], axis.stress, stress.stiffness[a],
                           stress.dashpot[a] + 0.5 * interval * stress.tangential[a], interval, axis.time,
                           servoDriftTimes * axis.time, axis.largestRate);
        axis.rate = axis.servo.speed;
        if (axis.oneWay * axis.rate <= 0) axis.oneWay = 0;
    }
    if (shear.isControlled) {
        shear.atLargest += interval * std::abs(shear.servo.speed);
        // A larger rate makes the stress larger: both with the sign of a value that a speed makes smaller.
        lookBesideDashpots(shear.servo, -stress.shear, -shear.stress, stress.shearStiffness,
                           stress.shearDashpot + 0.5 * interval * stress.shearTangential, interval,
                           shear.time, servoDriftTimes * shear.time, shear.largestRate);
        shear.rate = shear.servo.speed;
        if (std::abs(shear.rate) < shear.largestRate) shear.atLargest = 0;
    }
    refuseEndlessStrain(strain, shear, now);
}

}  // namespace pendular
