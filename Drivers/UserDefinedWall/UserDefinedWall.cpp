/// A wall outside the kernel: a closed tube, in which a ball rolls along the ring and across it.

#include <cmath>

#include "Drivers/Shared/CommandLine.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Simulation.h"

using namespace pendular;

/// A torus around the axis z, with grains in it.
struct Torus final : RigidWall {
    Torus(double ofRing, double ofTube) : ring(ofRing), tube(ofTube) { takePlace(); }
    /// m, from the circle in the middle of the tube, at its nearest point, to a grain's centre
    [[nodiscard]] Vector<double> fromRing(const Vector<double>& c) const {
        return c - (ring / std::hypot(c.x, c.y)) * Vector<double>{c.x, c.y, 0};
    }
    [[nodiscard]] double gap(const Vector<double>& centre) const { return tube - norm(fromRing(centre)); }
    void listInBody(const Vector<double>& c, double reach, std::vector<std::uint32_t>& parts) const override {
        if (gap(c) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& c, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        points[0] = {(1 / norm(fromRing(c))) * fromRing(c), gap(c), {0, 0, 0}};
    }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& a, const Vector<double>& b) const override {
        return gap(a) >= 0 && gap(b) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::Axis, {0, 0, 0}, ring + tube, {0, 0, 1}};
    }
    void visitShape(StateArchive& archive) const override {
        archive.same("shape", "Torus"), archive.same("ring", ring, "m"), archive.same("tube", tube, "m");
    }
    double ring, tube;  // m, radii
};

int main(int argc, char** argv) {
    RunOptions options{.output = "UserDefinedWall-output"};
    double endTime = 1;  // s
    const DriverProgram driver{.name = "UserDefinedWall",
                               .description = "A ball rolls in a torus, a wall of this driver.",
                               .options = options,
                               .files = "what the run writes",
                               .numbers = {{"end-time", "s", &endTime, notNegative, "end of the run"}}};
    return runDriver(driver, argc, argv, [&] {
        Simulation<LinearViscoelasticSlidingFrictionSpecies> scene;
        options.apply(scene);
        auto* const glass = scene.speciesHandler.copyAndAddObject({});
        glass->setDensity(2500), glass->setStiffness(1e4), glass->setDissipation(1);
        glass->setSlidingStiffness(3e3), glass->setSlidingFrictionCoefficient(0.5);
        Torus torus(0.05, 0.02);
        torus.setSpecies(glass), scene.wallHandler.copyAndAddObject(torus);
        SphericalParticle ball;  // it begins 0.02 rad from the lowest point, along the ring and across it
        ball.setSpecies(glass), ball.setRadius(0.005), ball.setPosition({1.3e-3, -0.064984, 3e-4});
        auto rolling = scene.particleHandler.copyAndAddObject(ball);
        scene.setGravity({0, -9.81, 0}), scene.setTimeStep(1e-5), scene.setTimeMax(endTime);
        scene.solve();
        if (!options.quiet) fmt::print("position: {:.7f} m\n", fmt::join(rolling.getPosition(), " "));
    });
}
