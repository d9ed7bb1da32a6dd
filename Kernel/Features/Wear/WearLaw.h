#pragma once

#include <string>

#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// What one contact does to a wall in a step.
struct ContactWear {
    double slidingWork = 0;           // J, that the slider of friction dissipates
    double loadTimesPath = 0;         // N m, the normal force times the path that it slides
    bool isImpact = false;            // the touch begins in this step, as follows
    double mass = 0;                  // kg, of the grain; of a rigid body, what the contact feels of it
    double normalSpeed = 0;           // m/s, of the grain's centre against the surface; positive
    double tangentialSpeed = 0;       // m/s
    Vector<double> towards{0, 0, 0};  // unit, from the grain to the wall

    /// The work (J) that the normal force takes up until the grain stands still along the normal: m v_n^2 /
    /// 2.
    [[nodiscard]] double impactWork() const { return 0.5 * mass * normalSpeed * normalSpeed; }
};

/// m v^2 f (J) of an impact with the angle a between path and surface, by Finnie (1972), Wear 19, 81: f = sin
/// 2a - 3 sin^2 a for tan a <= 1/3, else cos^2 a / 3. It has its maximum, 0.3 m v^2, at tan 2a = 2/3, a
/// = 16.8 degrees.
double finnieEnergy(double mass, double normalSpeed, double tangentialSpeed);

/// How much of a wall (m^3) grains wear off.
class WearLaw {
public:
    /// Nothing: only work and impacts are counted.
    static WearLaw none() { return {}; }
    /// Reye (1860): V = k W, with the work W (J) of friction in sliding.
    /// @param factor k, m^3/J. Throws InputError if it is negative.
    static WearLaw reye(double factor);
    /// Archard (1953), J. Appl. Phys. 24, 981: V = K F_n s / H, with the normal force F_n (N) and the path
    /// slid s (m). Where the friction coefficient mu is constant, it is Reye's with k = K / (mu H).
    /// @param coefficient K, without unit; @param hardness H of the wall, Pa
    /// Throws InputError if one is out of its range.
    static WearLaw archard(double coefficient, double hardness);
    /// Finnie (1960), Wear 3, 87, and (1972), Wear 19, 81: each impact of a grain of mass m and speed v wears
    /// off V = c m v^2 f(a) / p; see finnieEnergy().
    /// @param cuttingShare c, the share of the grains that cut, 0 to 1
    /// @param flowStress p, the plastic flow stress of the wall, Pa
    /// Throws InputError if one is out of its range.
    static WearLaw finnie(double cuttingShare, double flowStress);

    /// m^3
    [[nodiscard]] double volume(const ContactWear& done) const;
    /// Whether it counts sliding.
    [[nodiscard]] bool needsFriction() const { return kind == Kind::Reye || kind == Kind::Archard; }
    /// Whether it counts impacts.
    [[nodiscard]] bool needsImpacts() const { return kind == Kind::Finnie; }
    /// The formula, with its number.
    [[nodiscard]] std::string text() const;
    void visitState(StateArchive& archive) const;

private:
    enum class Kind { None, Reye, Archard, Finnie };

    WearLaw() = default;
    WearLaw(Kind which, double ofLaw) : kind(which), factor(ofLaw) {}

    Kind kind = Kind::None;
    double factor = 0;  // k, m^3/J; K/H, 1/Pa; or c/p, 1/Pa
};

}  // namespace pendular
