#pragma once

#include <algorithm>
#include <functional>
#include <type_traits>
#include <vector>

#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

/// The part of rigid bodies in the account of a step h: their kinetic energies are those of the bodies, while
/// the work of each contact is counted with the mean velocities of the grains that it joins. The two differ
/// by the work of the field and by the error of the turn, which is of third order in h: the end of an arm
/// goes on a curve, and its mean velocity is not the mean of two.
class BodyAccount {
public:
    /// Called before the grains move. The contacts are those of the last step.
    void begin(const ParticleStore& grains, const ContactStore& contacts) {
        before.clear(), loads.clear();
        for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
            const RigidBody& body = grains.bodies[k];
            const std::uint32_t number = grains.bodies.numberOf(k);
            before.push_back(
                {number, body.velocity, body.rotationalEnergy(), body.angularMomentum, body.torque});
            for (const BodyMember& member : grains.bodies.membersOf(k))
                loads.push_back({number, sumOf(grains, contacts, member)});
        }
    }

    /// What was taken of bodies that have gone to other ranks goes with them.
    /// @param allWereHere when it was taken, as on all ranks: each keeps that of its own
    void follow(const ParticleStore& grains, const AllRanks& ranks, bool allWereHere) {
        if (!ranks.areSeveral()) return;
        const auto followOne = [&](auto& records) {
            const auto isElsewhere = [&](const auto& record) {
                return !(grains.bodies.find(record.number) < grains.bodies.size());
            };
            const auto stays =
                std::stable_partition(records.begin(), records.end(), std::not_fn(isElsewhere));
            const std::remove_reference_t<decltype(records)> left(stays, records.end());
            records.erase(stays, records.end());
            if (allWereHere) return;
            for (const auto& record : ranks.gather(left))
                if (!isElsewhere(record)) records.push_back(record);
            std::stable_sort(records.begin(), records.end(),
                             [](const auto& a, const auto& b) { return a.number < b.number; });
        };
        followOne(before);
        followOne(loads);
    }

    /// The energy (J) that the change of a body's velocity gives it.
    double changeVelocity(const RigidBody& body, std::size_t number, const Vector<double>& change) {
        Vector<double>& then = before[number].velocity;
        const double given = body.mass * dot(change, then + 0.5 * change);
        then += change;
        return given;
    }

    /// Called at the end of the step: what the bodies have gained (J), less the work of their contacts.
    /// Bodies that are held altogether gain nothing.
    /// @param meanOf (place of a grain) gives its mean velocity and spin in the step
    /// @param byHolders J, what holds bodies along and about axes gives them is added, and is not in the sum
    template <class MeanOf>
    void addGainBesidesContacts(const ParticleStore& grains, const ContactStore& contacts,
                                const Vector<double>& gravity, double step, ExactSum& sum,
                                ExactSum& byHolders, MeanOf&& meanOf) const {
        std::size_t number = 0;
        for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
            if (grains.bodies.isHeld(k)) {
                number += grains.bodies.membersOf(k).size();
                continue;
            }
            const double given = givenByHolders(grains, contacts, gravity, step, k, number);
            byHolders.add(given);
            sum.add(-given);
            const RigidBody& body = grains.bodies[k];
            const Vector<double>& then = before[k].velocity;
            sum.add(0.5 * body.mass * dot(body.velocity - then, body.velocity + then));
            sum.add(body.rotationalEnergy() - before[k].turning);
            for (const BodyMember& member : grains.bodies.membersOf(k)) {
                const ContactSum &last = loads[number++].sum, now = sumOf(grains, contacts, member);
                const auto [velocity, spin] = meanOf(grains.place[member.grain]);
                sum.add(-0.5 * step * dot(last.force + now.force, velocity));
                sum.add(-0.5 * step * dot(last.torque + now.torque, spin));
            }
        }
    }

private:
    struct Before {
        std::uint32_t number;
        Vector<double> velocity;                 // m/s
        double turning;                          // J
        Vector<double> angularMomentum, torque;  // kg m^2/s, N m
    };

    /// J: against the forces and torques of contacts, the weight, and what turns the axes of the body.
    /// @param number of the body's first grain in `loads`
    [[nodiscard]] double givenByHolders(const ParticleStore& grains, const ContactStore& contacts,
                                        const Vector<double>& gravity, double step, std::size_t k,
                                        std::size_t number) const {
        const HeldBits held = grains.bodies.heldAxesOf(k);
        if (!held.any()) return 0;
        const RigidBody& body = grains.bodies[k];
        const Vector<double> spin = grains.bodies.spinOf(k);
        const Vector<double> velocity = body.velocity - held.partAlong(body.velocity),
                             turning = spin - held.partAbout(spin);
        // Of a sphere the body knows the torques that it follows only.
        const Vector<double> torques =
            grains.bodies.isSphere(grains, k)
                ? loads[number].sum.torque + sumOf(grains, contacts, grains.bodies.membersOf(k)[0]).torque
                : before[k].torque + body.torque;
        double given =
            dot(turning, body.angularMomentum - before[k].angularMomentum - (0.5 * step) * torques);
        if (squaredNorm(velocity) == 0) return given;
        Vector<double> force = 2 * body.mass * gravity;
        for (const BodyMember& member : grains.bodies.membersOf(k))
            force += loads[number++].sum.force + sumOf(grains, contacts, member).force;
        return given - 0.5 * step * dot(force, velocity);
    }

    static ContactSum sumOf(const ParticleStore& grains, const ContactStore& contacts,
                            const BodyMember& member) {
        const std::uint32_t place = grains.place[member.grain];
        if (place >= contacts.sides.grainCount()) return {{0, 0, 0}, {0, 0, 0}};  // it came after the list
        return contactSum(contacts, place, grains.translation[place].radius);
    }

    std::vector<Before> before;  // in the order of bodies
    struct Load {
        std::uint32_t number;  // of the body
        ContactSum sum;
    };
    std::vector<Load> loads;  // of each grain of them
};

}  // namespace pendular
