#pragma once

#include <cstddef>
#include <string_view>

#include "Kernel/Features/Insertion/Region.h"
#include "Kernel/MercuryScene.h"

/// What lies at the bottom of a Chute.
enum RoughBottomType { MONOLAYER_ORDERED, MONOLAYER_DISORDERED, MULTILAYER, FLAT };

namespace pendular {

/// A chute by MercuryDPM's names: a box with a bottom at its lowest z, grains that come at its lowest x and
/// go beyond x, and gravity that is turned by the angle of the chute. Sides along y are walls or periodic.
/// The bottom is flat, or of grains that are held: in rows, at random (until 500 tries fail), or a layer
/// of 2.4 radii, of a solid fraction up to 0.55. (There that layer is settled, and its grains lie denser.)
class Chute : public Mercury3D {
public:
    Chute();

    /// @param angle degrees, from -90 to 90; @param gravity m/s^2
    void setChuteAngleAndMagnitudeOfGravity(double angle, double gravity);
    /// The same with the gravity that is set. Throws InputError where none is.
    void setChuteAngle(double angle);
    [[nodiscard]] double getChuteAngle() const { return chuteAngle; }  // rad
    [[nodiscard]] double getChuteAngleDegrees() const { return chuteAngle / constants::degree; }
    /// m, along x and y, from where the box begins
    virtual void setChuteLength(double length) { setXMax(getXMin() + length); }
    void setChuteWidth(double width) { setYMax(getYMin() + width); }
    [[nodiscard]] double getChuteLength() const { return getXMax() - getXMin(); }
    [[nodiscard]] double getChuteWidth() const { return getYMax() - getYMin(); }
    void makeChutePeriodic() { isPeriodic = true; }
    [[nodiscard]] bool getIsPeriodic() const { return isPeriodic; }
    /// m; 0: the bottom is flat
    void setFixedParticleRadius(double radius);
    [[nodiscard]] double getFixedParticleRadius() const { return fixedRadius; }
    void setRoughBottomType(RoughBottomType type) { bottom = type; }
    /// By its name.
    void setRoughBottomType(std::string_view type);
    [[nodiscard]] RoughBottomType getRoughBottomType() const { return bottom; }

    /// m, of the grains that come: as many of each between two
    void setInflowParticleRadius(double radius) { setInflowParticleRadius(radius, radius); }
    void setInflowParticleRadius(double smallest, double largest);
    void setMinInflowParticleRadius(double radius) { setInflowParticleRadius(radius, largestInflow); }
    void setMaxInflowParticleRadius(double radius) { setInflowParticleRadius(smallestInflow, radius); }
    [[nodiscard]] double getInflowParticleRadius() const { return 0.5 * (smallestInflow + largestInflow); }
    [[nodiscard]] double getMinInflowParticleRadius() const { return smallestInflow; }
    [[nodiscard]] double getMaxInflowParticleRadius() const { return largestInflow; }
    /// m: the box is as high
    void setInflowHeight(double height);
    [[nodiscard]] double getInflowHeight() const { return inflowHeight; }
    /// m/s along x, and the share by which velocities differ from it
    void setInflowVelocity(double velocity) { inflowVelocity = velocity; }
    void setInflowVelocityVariance(double share);
    [[nodiscard]] double getInflowVelocity() const { return inflowVelocity; }
    [[nodiscard]] double getInflowVelocityVariance() const { return inflowVariance; }
    /// Tries that may fail in a step.
    void setMaxFailed(unsigned tries) { maxFailed = tries; }
    [[nodiscard]] unsigned getMaxFailed() const { return maxFailed; }

    void setupInitialConditions() override;

protected:
    /// Walls or periodic faces along y.
    void setupSideWalls();
    virtual void createBottom();
    /// What is beyond x goes.
    void setupOutflow();

private:
    void setupInflow();
    [[nodiscard]] SphericalParticle fixedGrain();
    void layInRows();
    void layAtRandom();
    void layDeep();
    void addFloor(double height);

    double chuteAngle = 0;                               // rad
    double fixedRadius = 1e-3;                           // m
    double smallestInflow = 1e-3, largestInflow = 1e-3;  // m
    double inflowHeight = 0.02;                          // m
    double inflowVelocity = 0.1, inflowVariance = 0;     // m/s, -
    unsigned maxFailed = 1;
    RoughBottomType bottom = MONOLAYER_DISORDERED;
    bool isPeriodic = false;
};

}  // namespace pendular
