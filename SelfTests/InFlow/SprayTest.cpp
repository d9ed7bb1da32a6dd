// Sprays in shear and strain: a droplet meets a grain across a face as in the middle of the box.
#include <gtest/gtest.h>

#include "Kernel/Features/Laws.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::sprayTest {
namespace {

using Wet = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;
using scenes::GrainMotion;

constexpr double side = 0x1p-6;         // m
constexpr double r = 1e-3;              // m
constexpr double stepLength = 0x1p-17;  // s
constexpr double drop = 1e-4;           // m
constexpr double firstAt = 1e-4;        // s

Wet material() {
    Wet species;
    species.setDensity(2500), species.setStiffness(100), species.setDissipation(0);
    species.setLiquidBridgeVolumeMax(1e-11), species.setContactAngle(0), species.setSurfaceTension(0.07);
    return species;
}

struct How {
    std::string_view name;
    void (*setFlow)(Scene&);
    int axis;                      // along which images move against each other
    double shear = 0, strain = 0;  // 1/s, until the droplet comes out
};
const std::vector<How> hows{{"shear", [](Scene& s) { s.setLeesEdwards(0, 1, 50); }, 1, 50},
                            {"widens", [](Scene& s) { s.setStrainRate(2, 40); }, 2, 0, 40},
                            {"narrows", [](Scene& s) { s.setStrainRate(2, -40); }, 2, 0, -40},
                            {"shear that changes", [](Scene& s) { s.setLeesEdwards(0, 1, 50); }, 1, 50}};

/// One droplet, which flies to a grain at rest against the flow, 4 mm ahead.
class OneDroplet : public scenes::FewGrains<Wet> {
public:
    OneDroplet(const How& how, const Vec3D& place) : FewGrains<Wet>(material(), {}, stepLength), flow(how) {
        periodic::repeatAlongAllAxes(*this, side);
        how.setFlow(*this);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(r);
        // The nozzle stays where it is, while the flow carries the grain until the droplet comes out.
        const Vec3D aside = place - Vec3D::Constant(side / 2);
        const Vec3D carried(how.shear * aside.y() * firstAt, 0,
                            aside.z() * (1 - std::exp(-how.strain * firstAt)));
        const Vector<double> inside =
            getPeriodicBox().wrap(toVector(place + Vec3D(1e-3, 2.5e-3, 3e-3) - carried));
        grain.setPosition(toEigen(inside));
        grain.setVelocity(toEigen(getPeriodicBox().flowAt(inside)));
        particleHandler.copyAndAddObject(grain);
        Spray spray;
        spray.setRain(place, Vec3D::Zero(), Vec3D::Zero(), {1, 2.5, 3});
        spray.setDropletRadius(drop);
        spray.setSpeed(2);
        spray.setMomentum(1000);
        spray.setFlow(spray.dropletVolume() / firstAt);
        spray.setTimes(0, 1.5 * firstAt);
        sprayHandler.copyAndAddObject(spray);
        setQuiet();
        setTimeMax(1);
        initialise();
    }
    /// Steps until it is caught.
    int fly() {
        for (int k = 0; k < 4000; ++k) {
            if (flow.name == "shear that changes" && k == 100) setShearRate(-20);
            step();
            EXPECT_EQ(liquidLedger().unaccounted(), 0);
            if (!sprayHandler.caught().empty()) return k;
        }
        return -1;
    }
    [[nodiscard]] Vec3D against() { return periodic::againstFlow(*this, motion(0)); }
    How flow;
};

TEST(SprayInFlow, dropletsMeetGrainsEverywhereAsInTheMiddle) {
    for (const How& how : hows) {
        OneDroplet expected(how, Vec3D::Constant(side / 2));
        const int caughtAt = expected.fly();
        ASSERT_GT(caughtAt, 150) << how.name;
        EXPECT_EQ(expected.sprayHandler.caught()[0].particle, 0u);
        const Vec3D speed = expected.against();
        EXPECT_GT(speed.norm(), 1e-4);
        int acrossFaces = 0;
        for (int shift = 0; shift < 16; ++shift) {
            Vec3D place = Vec3D::Constant(side / 2);
            place[how.axis] += side * shift / 16;
            SCOPED_TRACE(fmt::format("{}, {}", how.name, shift));
            OneDroplet scene(how, place);
            const double grainFrom = scene.motion(0).position[how.axis];
            EXPECT_EQ(scene.fly(), caughtAt);
            acrossFaces += std::abs(grainFrom - place[how.axis]) > side / 2 ? 1 : 0;
            ASSERT_EQ(scene.sprayHandler.caught().size(), 1u);
            EXPECT_EQ(scene.sprayHandler.caught()[0].particle, 0u);
            EXPECT_LT((scene.against() - speed).norm(), 1e-9);
        }
        EXPECT_GT(acrossFaces, 3);
    }
}

/// Momentum against the flow: m_d v_d over m + m_d.
TEST(SprayInFlow, aDropletBringsItsMomentumAgainstTheFlow) {
    OneDroplet scene({"shear", [](Scene& s) { s.setLeesEdwards(0, 1, 0); }, 1}, {0.005, 0.014, 0.014});
    ASSERT_GT(scene.fly(), 0);
    const double liquid = 1000 * sphereMass(drop, 1), mass = scene.particleHandler.getObject(0).getMass();
    const Vec3D expected = liquid / (mass + liquid) * 2 * Vec3D(1, 2.5, 3).normalized();
    EXPECT_LT((scene.against() - expected).norm(), 1e-5 * expected.norm());  // the droplet is whole quanta
}

/// Many droplets and grains: the same bits for any threads and across a restart.
TEST(SprayInFlow, hasTheSameBits) {
    const support::TestFolder folder;
    const auto make = [](scenes::FewGrains<Wet>& scene) {
        periodic::repeatAlongAllAxes(scene, side);
        scene.setLeesEdwards(0, 1, 50);
        scene.setStrainRate(2, 10);
        Spray spray;
        spray.setRain({side / 2, side / 2, 0.1 * side}, {side, 0, 0}, {0, side, 0}, {0, 0.5, 1});
        spray.setDropletRadius(drop);
        spray.setSpeed(1);
        spray.setMomentum(1000);
        spray.setFlow(2e5 * spray.dropletVolume());
        scene.sprayHandler.copyAndAddObject(spray);
        scene.setQuiet();
        scene.setTimeMax(0.1);
    };
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 64; ++k)
        grains.push_back(
            {.radius = r, .position = Vec3D::Constant(1.6e-3) + 3.8e-3 * Vec3D(k % 4, k / 4 % 4, k / 16)});
    scenes::FewGrains<Wet> whole(material(), grains, stepLength), resumed(material(), grains, stepLength);
    make(whole), make(resumed);
    whole.initialise();
    std::size_t caught = 0;
    for (int k = 0; k < 700; ++k) {
        whole.step();
        caught += whole.sprayHandler.caught().size();
        EXPECT_EQ(whole.liquidLedger().unaccounted(), 0);
    }
    EXPECT_GT(caught, 100u);
    EXPECT_GT(whole.sprayHandler.droplets().size(), 50u);
    whole.writeRestart(folder.path() / "spray.h5");
    resumed.restartFrom(folder.path() / "spray.h5");
    resumed.setNumberOfThreads(3);
    resumed.initialise();
    whole.step(500), resumed.step(500);
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
    ASSERT_EQ(resumed.sprayHandler.droplets().size(), whole.sprayHandler.droplets().size());
    for (std::size_t k = 0; k < whole.sprayHandler.droplets().size(); ++k)
        EXPECT_EQ(resumed.sprayHandler.droplets()[k].position, whole.sprayHandler.droplets()[k].position);
}

}  // namespace
}  // namespace pendular::sprayTest
