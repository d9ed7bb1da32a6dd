#pragma once

#include "Kernel/Core/Contacts/ContactSample.h"
#include "Kernel/Core/Walls/Pose.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Features/Wear/WearLaw.h"

namespace pendular {

/// The mean motion in a step of a body that a contact joins.
struct BodyMotion {
    Vector<double> velocity{0, 0, 0};  // m/s
    Vector<double> spin{0, 0, 0};      // rad/s
    double radius = 0;                 // m
    bool isHeld = false;               // a wall, or a grain without motion of its own
    Vector<double> slide{0, 0, 0};     // m/s, where images move: of the one that is met, against itself
};

/// The properties of the laws of a contact that its energy depends on.
struct ContactKind {
    bool isWall = false;
    bool isMembrane = false;      // a wall that has an account of its own of the work of contacts
    bool isPlastic = false;       // the normal law has a history
    bool adhesionBreaks = false;  // else it is a function of the separation, which loses nothing
    bool hasCouples = true;       // torques besides those of its force
    bool resistsMotion = true;    // a bridge
    bool keepsForce = false;      // tangential springs follow the contact radius
    bool isShaped = true;         // between bodies that are no spheres
    // Of a wall whose kinetic energy is in the ledger, where it is touched, in the step; and of the wall that
    // was touched before, if a contact has gone on with another one.
    RigidVelocity piston{}, lastPiston{};
};

/// The wear of a wall by a contact with it in a step, from a record before takeNowAsLast().
/// @param slidingWork J, that the slider dissipates in the step; @param velocity of the grain at the start of
/// the step, m/s; @param mass of the grain, kg
ContactWear contactWear(const EnergyRecord& record, double slidingWork, const Vector<double>& velocity,
                        double mass);

/// J: what the slider of a contact with a wall dissipates in a step (s), as addContact() has it.
double slidingWorkAtWall(const EnergyRecord& record, const BodyMotion& grain, const ContactKind& kind,
                         double step);

/// Adds to an account what one contact did in a step (s).
void addContact(EnergyRecord& record, const BodyMotion& first, const BodyMotion& second,
                const ContactKind& kind, double step, EnergyLedger& account);
/// The present sample becomes the last one: of it, what a contact of this kind has.
void takeNowAsLast(EnergyRecord& record, const ContactKind& kind);

}  // namespace pendular
