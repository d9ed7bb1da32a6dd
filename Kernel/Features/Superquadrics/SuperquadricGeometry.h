#pragma once

#include <array>
#include <atomic>

#include "Kernel/Core/Contacts/ContactGeometry.h"
#include "Kernel/Features/Superquadrics/SuperquadricPair.h"

namespace pendular {

class ContactLaws;
struct ContactTask;

/// Eight superquadrics, each of its own shape.
struct EightSuperquadrics {
    SuperquadricLanes<Pack> shape;
    Axes<Pack> axes;
    Pack inverseMass;       // 1/kg
    Vector<Pack> inertia;   // kg m^2, principal
    Vector<Pack> position;  // m
    Vector<Pack> velocity;  // m/s, predicted for the end of the step
    Vector<Pack> spin;      // rad/s
    Pack radius;            // m, of the sphere around

    /// 1/kg, how much a force along a unit vector moves the point at an arm (m) along it.
    [[nodiscard]] Pack response(const Vector<Pack>& arm, const Vector<Pack>& along) const {
        const Vector<Pack> l = axes.turnBack(cross(arm, along));
        return inverseMass + (l.x * l.x / inertia.x + l.y * l.y / inertia.y + l.z * l.z / inertia.z);
    }
    /// 1/(kg m^2), how much a torque turns it about its own axis: the mean over all directions.
    [[nodiscard]] Pack turningResponse() const {
        return (Pack(1) / inertia.x + Pack(1) / inertia.y + Pack(1) / inertia.z) * Pack(1.0 / 3);
    }
};

/// Eight contacts that were found one by one, as those of blocks are. Of one that does not touch, only the
/// depth and the radii of the spheres around matter.
struct EightTouches {
    struct Lane {
        Vector<double> normal{1, 0, 0};               // unit, from body 1 to body 2
        double depth = -1;                            // m
        double effectiveRadius = 0;                   // m
        double radius1 = 0, radius2 = 0;              // m, of the spheres around
        double inverseMass = 1, response = 1;         // 1/kg, as of SuperquadricGeometry
        Vector<double> arm1{0, 0, 0}, arm2{0, 0, 0};  // m
        Vector<double> velocity{0, 0, 0};             // m/s, of the surfaces
        Vector<double> spinSum{0, 0, 0};              // rad/s
        Vector<double> spinDifference{0, 0, 0};       // rad/s
        double turningResponse = 0;                   // 1/(kg m^2)
    };
    static constexpr std::size_t numbers = sizeof(Lane) / sizeof(double);
    std::array<Lane, Pack::lanes> lanes;
};

/// The geometry of eight contacts of superquadrics with each other or with a plane, as the contact kernel
/// takes it. The velocity is that of the surfaces where they touch, and masses are what the contact feels,
/// turning included, so that dashpots that are made for a restitution give that of the contact point.
class SuperquadricGeometry {
public:
    /// Hertz's law takes Gauss' radius, which is infinite on flat faces, up to so many times that of the
    /// spheres around: ellipsoids up to 1 : 4 have their own everywhere, and a contact is at most twice as
    /// stiff as that of the spheres.
    static constexpr double mostRadii = 4;

    /// @param adhesion laws that attract; null if there are none. Bodies apart within their range are known,
    /// too: by their nearest points, and the curvatures there.
    SuperquadricGeometry(const ContactTask& task, std::size_t block, const EightSuperquadrics& first,
                         const EightSuperquadrics& second, const Vector<Pack>& shift,
                         const Vector<Pack>& imageVelocity, const ContactLaws* adhesion,
                         std::atomic<std::uint64_t>& fallbacks);
    SuperquadricGeometry(const ContactTask& task, std::size_t block, const EightSuperquadrics& first,
                         const WallPointColumns& wall, const ContactLaws* adhesion);
    SuperquadricGeometry(const ContactTask& task, std::size_t block, const EightTouches& touches);

    static void prefetchBodies(const TranslationRecord* /*t*/, const RotationRecord* /*r*/,
                               const ContactBlock& /*b*/) {}

    [[nodiscard]] Mask overlapping() const { return depth > Pack(0); }
    [[nodiscard]] Mask isWithin(double gap) const { return depth > Pack(-gap); }
    [[nodiscard]] ContactGeometry<Pack> complete() const;
    void completeSpins(ContactGeometry<Pack>& /*g*/) const {}
    /// Of the surfaces where they touch; those of turning axes, of second order in the spin, are left out.
    [[nodiscard]] ContactAcceleration<Pack> accelerations(const Vector<double>* acceleration,
                                                          Pack lever) const;

    /// The response (1/kg) of the tangential velocity to a tangential force: the mean over all directions.
    [[nodiscard]] const Pack& slidingResponse() const { return response; }
    /// The normal of the last step, if they acted in it; else zero.
    [[nodiscard]] const Vector<Pack>& lastNormal() const { return normalBefore; }
    /// N m, the contact's own torque on body 1 in the last step, for laws that have one.
    [[nodiscard]] Vector<Pack> lastTorque(ContactMemory& memory, std::size_t block) const;
    /// The change of the normal since the last step, in the tangent plane of today.
    [[nodiscard]] Vector<Pack> normalShift() const {
        const Vector<Pack> shift = normal - normalBefore;
        return select(acted, shift - dot(normal, shift) * normal, zero());
    }

    /// Prepares the adhesion of these contacts for the radius that they have in this step.
    void prepareAdhesion(ContactMemory& memory, std::size_t block, Mask joined) const;

    /// The forces, with a lever arm and a torque of the contact's own that make the torques arm x force of
    /// both bodies, as the particle sum adds them up: (radius - halfOverlap) leverless +- torque.
    /// @param acts contacts that act; @param torque N m, of the contact's own, on body 1
    void writeRecords(ContactMemory& memory, std::size_t block, Mask acts, const Pack& normalForce,
                      const Vector<Pack>& tangential, const Vector<Pack>& torque) const;
    /// Keeps the contact's own torque for the next step.
    void keepTorque(ContactMemory& memory, std::size_t block, const Vector<Pack>& torque) const;

    /// Writes the arms, which the ledger of the energy reads, too.
    void writeArms(ContactMemory& memory, std::size_t block) const;

private:
    static Vector<Pack> zero() { return {Pack(0), Pack(0), Pack(0)}; }
    void takeLast(const ContactTask& task, std::size_t block);
    void takeHeldMasses(const ContactTask& task, std::size_t block);
    [[nodiscard]] Pack reachOf(const ContactTask& task, std::size_t block) const;
    void setRadius(const Pack& gauss, const Pack& around);

    const RotationRecord* rotation = nullptr;  // of all grains
    const ContactBlock* contacts = nullptr;
    const ContactLaws* adhesive = nullptr;
    int species1 = 0, species2 = 0;
    bool isAtWall;
    Mask acted, fellBack, known;  // in the last step; of which more than that they are apart is known
    Vector<Pack> normalBefore, normal;
    Pack depth, effectiveRadius = 1;            // m
    Pack own1 = 1, own2 = 1;                    // m, Gauss' radius of each body there
    Vector<Pack> arm1 = zero(), arm2 = zero();  // m, from the centres to the middle of the overlap
    Pack radius1, radius2;                      // m, of the spheres around
    Vector<Pack> velocity = zero();             // m/s
    Vector<Pack> spinSum = zero(), spinDifference = zero();  // rad/s
    Pack inverseMass = 1, response = 1;                      // 1/kg
    Pack turningResponse = 0;                                // 1/(kg m^2)
    Pack massIfHeld = 0;                                     // kg, of contacts of bodies that are held
    std::atomic<std::uint64_t>* fallbackCount = nullptr;
};

}  // namespace pendular
