// Programs of MercuryDPM's public self-tests with coarse graining in their code, by its names, and what they
// give there or a closed form. README.md lists them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "CG/CG.h"
#include "CG/TimeAveragedCG.h"
#include "Mercury3D.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::mercuryFieldsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// The cut-off of a function of this variance, or of that of a sphere of this radius.
template <class One>
double cutoff(bool ofRadius) {
    One cg;
    if (ofRadius) cg.setRadius(1);
    else cg.setStandardDeviation(1);
    return cg.getFunction().getCutoff();
}

TEST(MercuryPrograms, cgStandardDeviation) {
    using namespace CGCoordinates;
    using namespace CGFunctions;
    for (const bool ofRadius : {false, true}) {
        const double x = ofRadius ? std::sqrt(.2) : 1, xy = ofRadius ? std::sqrt(.4) : 1,
                     xyz = ofRadius ? std::sqrt(.6) : 1;
        EXPECT_NEAR((cutoff<CG<X, Heaviside>>(ofRadius)), constants::sqrt_3 * x, 1e-11);
        EXPECT_NEAR((cutoff<CG<XY, Heaviside>>(ofRadius)), constants::sqrt_2 * xy, 1e-11);
        EXPECT_NEAR((cutoff<CG<XYZ, Heaviside>>(ofRadius)), std::sqrt(5. / 3.) * xyz, 1e-11);
        EXPECT_NEAR((cutoff<CG<X, Lucy>>(ofRadius)), std::sqrt(10.5) * x, 1e-11);
        EXPECT_NEAR((cutoff<CG<XY, Lucy>>(ofRadius)), std::sqrt(5.6) * xy, 1e-11);
        EXPECT_NEAR((cutoff<CG<XYZ, Lucy>>(ofRadius)), 2 * xyz, 1e-11);
        EXPECT_NEAR((cutoff<CG<X, Gauss>>(ofRadius)), 3 * x, 1e-11);
        EXPECT_NEAR((cutoff<CG<XY, Gauss>>(ofRadius)), 3 / std::sqrt(2) * xy, 1e-11);
        EXPECT_NEAR((cutoff<CG<XYZ, Gauss>>(ofRadius)), 3 / std::sqrt(3) * xyz, 1e-11);
    }
}

/// Grains of 1 kg and radius 1 that are pressed, at one time.
class Pressed : public MercuryScene<LinearViscoelasticSpecies> {
public:
    SphericalParticle p;

    Pressed() {
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(0.75 / constants::pi);  // such that mass = 1
        species->setStiffnessAndRestitutionCoefficient(2e5, 0.1, 1.0);
        setDomain({-1, -1, -2}, {1, 1, 2});
        p.setSpecies(species);
        p.setRadius(1.0);
        setTimeStep(1e-4);
        setTimeMax(0);
        acceptOverlaps(0.1);
        setQuiet();
    }
};

TEST(MercuryPrograms, cgParticleParticle) {
    Pressed dpm;
    dpm.p.setPosition({-0.05, 0, -0.95});
    dpm.particleHandler.copyAndAddObject(dpm.p);
    dpm.p.setPosition({0.05, 0, 0.95});
    dpm.particleHandler.copyAndAddObject(dpm.p);
    const Mdouble width = 0.15;
    auto O = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    auto Z = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::Z>(width, 1));
    Z->setMin({-1, -1, 0.95});
    Z->setMax({1, 1, 0.95});
    auto G = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::Z, CGFunctions::Gauss>(width, 1));
    G->setMin({-1, -1, 0.95});
    G->setMax({1, 1, 0.95});
    auto C = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::Z>(width, 1));
    auto XYZ = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::XYZ>(width, 1));
    XYZ->setMin({-0.95, -1, 0.95});
    XYZ->setMax({1.05, 1, 0.95});
    dpm.solve();

    helpers::check(O->getPoint(0).getDensity(), 0.125, 1e-15, "Average density");
    const Mdouble phiL0 = 1.25 / width;  // Lucy's in the middle
    helpers::check(Z->getPoint(0).getDensity(), phiL0 / 4.0, 1e-15, "density at the centre");
    const Mdouble phiG0 =
        1.0 / (constants::sqrt_2 * constants::sqrt_pi * std::erf(3.0 / constants::sqrt_2)) / width;
    helpers::check(G->getPoint(0).getDensity(), phiG0 / 4.0, 1e-15, "density with a Gauss");
    const Mdouble phi30 = 105.0 / 16.0 / constants::pi / mathsFunc::cubic(width);
    helpers::check(XYZ->getPoint(0).getDensity(), phi30, 1e-11, "density in x, y and z");
    const Vec3D way =
        dpm.particleHandler.getObject(1)->getPosition() - dpm.particleHandler.getObject(0)->getPosition();
    const Mdouble distance = way.norm(), overlap = 2.0 - distance;
    helpers::check(O->getPoint(0).getContactStress().trace(), 2e5 * overlap * distance / 16, 1e-11,
                   "Average stress");
    helpers::check(C->getPoint(0).getContactStress().trace(), 2e5 * overlap * distance / way.z() / 4, 1e-11,
                   "stress at the contact");
    EXPECT_EQ(C->getPoint(0).coordinates.getZ(), 0);
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(Z->getPoint(1)); })));
    Z->setTimeMin(1);
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(Z->getPoint(0)); }), "last step"));
}

TEST(MercuryPrograms, cgParticleWall) {
    Pressed dpm;
    dpm.p.setPosition({0.05, 0, 0.95});
    dpm.particleHandler.copyAndAddObject(dpm.p);
    dpm.wallHandler.copyAndAddObject(
        InfiniteWall({-0.05, 0, -0.95}, {0, 0, 0}, dpm.speciesHandler.getLastObject()));
    auto O = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    auto C = dpm.cgHandler.copyAndAddObject(CG<CGCoordinates::Z>(0.075, 1));
    C->setMin({-1, -1, 0.25});
    C->setMax({1, 1, 0.25});
    dpm.solve();
    const auto contact = dpm.interactionHandler.getObject(0);
    const Vec3D position = dpm.particleHandler.getObject(0)->getPosition();
    // The contact point is on the surface of the wall here, there in the middle of the overlap.
    const Mdouble distance = std::hypot(0.05, 0.95), overlap = 1 - distance;  // m
    EXPECT_NEAR(contact->getDistance(), distance, 1e-15);
    EXPECT_NEAR((contact->getContactPoint() - position).norm(), distance, 1e-15);
    helpers::check(O->getPoint(0).getContactStress().trace(), 2e5 * overlap * distance / 16, 1e-11,
                   "Average stress");
    helpers::check(C->getPoint(0).getContactStress().trace(), 2e5 * overlap * distance / position.z() / 4,
                   1e-11, "stress at the contact");
    // The wall bears the grain: the force density of all of it is that of the contact.
    EXPECT_LT((O->getPoint(0).getInteractionForceDensity() - contact->getForce() / 16).norm(), 1e-10);
}

// A cubic packing with all forces 1 N in a periodic box.
TEST(MercuryPrograms, cg3DPacking) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    const unsigned n = 5;
    const Mdouble distance = 0.99;
    LinearViscoelasticSpecies species;
    species.setStiffnessAndRestitutionCoefficient(100.0, 0.5, 1.0);
    species.setDensity(6.0 / constants::pi);
    scene.speciesHandler.copyAndAddObject(species);
    SphericalParticle p(scene.speciesHandler.getObject(0));
    p.setRadius(0.5);
    for (unsigned i = 0; i < n; i++)
        for (unsigned j = 0; j < n; j++)
            for (unsigned k = 0; k < n; k++) {
                p.setPosition(distance * Vec3D(i + .5, j + .5, k + .5));
                scene.particleHandler.copyAndAddObject(p);
            }
    scene.setMin(0, 0, 0);
    scene.setMax(n * distance, n * distance, n * distance);
    PeriodicBoundary b;
    for (const Vec3D& normal : {Vec3D(1, 0, 0), Vec3D(0, 1, 0), Vec3D(0, 0, 1)}) {
        b.set(normal, scene.getMin(), scene.getMax());
        scene.boundaryHandler.copyAndAddObject(b);
    }
    scene.setTimeStep(0.02 * species.getCollisionTime(1.0));
    scene.setTimeMax(10 * scene.getTimeStep());
    auto cg = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    scene.setQuiet();
    scene.solve();
    const Mdouble volume = mathsFunc::cubic(n * distance);
    helpers::check(cg->getPoint(0).getDensity(), n * n * n / volume, 1e-10, "density");
    for (int axis = 0; axis < 3; ++axis)
        helpers::check(cg->getPoint(0).getContactStress()(axis, axis), n * n * n * 0.99 / volume, 1e-10,
                       "pressure");
}

// Two species that press each other: the force on one is that on the other.
TEST(MercuryPrograms, cgForceDensity) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    LinearViscoelasticSpecies species;
    species.setDensity(1.0);
    species.setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
    auto first = scene.speciesHandler.copyAndAddObject(species),
         second = scene.speciesHandler.copyAndAddObject(species);
    scene.setMax(Vec3D(1, 0.5, 0.5));
    scene.setMin(Vec3D(-1, -0.5, -0.5));
    SphericalParticle p0(first);
    p0.setRadius(0.5);
    p0.setPosition(Vec3D(-0.49, 0.0, 0.0));
    scene.particleHandler.copyAndAddObject(p0);
    p0.setSpecies(second);
    p0.setPosition(Vec3D(0.49, 0.0, 0.0));
    scene.particleHandler.copyAndAddObject(p0);
    auto cg0 = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    cg0->selectSpecies(0);
    auto cg1 = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    cg1->selectSpecies(1);
    scene.setTimeStep(1e-4);
    scene.setTimeMax(0);
    scene.setQuiet();
    scene.solve();
    const Vec3D force0 = cg0->evaluateAverage().getInteractionForceDensity(),
                force1 = cg1->evaluateAverage().getInteractionForceDensity();
    scene.logger.assert_always(force0.x() < -1 && force1.x() > 1, "wrong direction: % %", force0, force1);
    helpers::check(Vec3D(force0 + force1), Vec3D(0, 0, 0), 1e-10, "sum of the force densities");
    // Of an overlap of 0.02 in a box of 2 m^3.
    EXPECT_NEAR(force1.x(), 0.02 * first->getStiffness() / 2, 1e-9 * first->getStiffness());
}

// Two grains on a held one, which counts as a wall: a mass of 2, a stress of nearly 2, and a force of 2, in
// 2.5 m^3.
class Stack : public MercuryScene<LinearViscoelasticSpecies> {
public:
    Stack() {
        setGravity(Vec3D(0., 0., -1.));
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(6.0 / constants::pi);
        species->setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
        setTimeStep(.0002);
        setTimeMax(0.5);
        setSaveCount(20);
        setQuiet();
    }
    void setupInitialConditions() override {
        setXMax(1);
        setYMax(1);
        setZMax(2);
        setZMin(-0.5);
        SphericalParticle P0;
        P0.setSpecies(speciesHandler.getLastObject());
        P0.setRadius(0.5);
        P0.setPosition(Vec3D(0.5, 0.5, 0.5));
        particleHandler.copyAndAddObject(P0);
        P0.setPosition(Vec3D(0.5, 0.5, 1.5));
        particleHandler.copyAndAddObject(P0);
        P0.setPosition(Vec3D(0.5, 0.5, -0.5));
        P0.fixParticle();
        particleHandler.copyAndAddObject(P0);
    }
};

TEST(MercuryPrograms, cgHandlerAndStaticBalance) {
    Stack problem;
    auto now = problem.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    auto mean = problem.cgHandler.copyAndAddObject(TimeAveragedCG<CGCoordinates::O>());
    mean->setTimeMin(0.3);
    auto Z = problem.cgHandler.copyAndAddObject(CG<CGCoordinates::Z>());
    Z->setNZ(200);
    Z->setWidth(0.3);
    auto none = problem.cgHandler.copyAndAddObject(TimeAveragedCG<CGCoordinates::O>());
    none->setTimeMin(1);
    problem.solve();
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(none->getPoint(0)); })));
    const double k = problem.speciesHandler.getObject(0)->getStiffness();
    for (const CGPoint& point : {now->getPoint(0), mean->getPoint(0)}) {
        EXPECT_NEAR(point.getDensity(), 0.8, 1e-14);
        EXPECT_NEAR(point.getParticleNumber(), 0.8, 1e-14);
        // Force times branch: 2 (1/2 - 1/k) + 1 (1 - 1/k), which is 0.799984 in 2.5 m^3.
        EXPECT_NEAR(point.getContactStress()(2, 2), (2 - 3 / k) / 2.5, 1e-6);
        EXPECT_NEAR(point.getContactStress()(2, 2), 0.799984, 1e-6);
        EXPECT_LT((point.getInteractionForceDensity() + point.getDensity() * problem.getGravity()).norm(),
                  1e-6);
        EXPECT_LT(point.getMomentum().norm() + point.getMomentumFlux().norm(), 1e-6);
    }
    // Over z: the sum over points 1/80 m apart, of a function 0.6 m wide that is smooth.
    const CGPoint sum = Z->evaluateAverage();
    EXPECT_EQ(Z->getPoints().size(), 200u);
    EXPECT_NEAR(sum.getDensity(), 0.8, 1e-5);
    EXPECT_NEAR(Z->getPoint(0).coordinates.getZ(), -0.5 + 1.25 / 200, 1e-15);
    EXPECT_EQ(problem.cgHandler.getNumberOfObjects(), 4u);
    EXPECT_EQ(problem.cgHandler.getLastObject(), none);
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(problem.cgHandler.getObject(4)); })));
}

/// 5^3 spheres, or 5^2 discs, of 1 kg in a box of their size, under a small gravity.
class Packing : public MercuryScene<LinearViscoelasticSpecies> {
public:
    explicit Packing(int dimensions) {
        const bool flat = dimensions == 2;
        setDimension(dimensions);
        setDomain({0, 0, flat ? -0.5 : 0}, {5, 5, flat ? 0.5 : 5});
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(flat ? 6.0 / constants::pi * 2. / 3. : 1.9098593);
        species->setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
        setGravity(flat ? Vec3D(0, -1, 0) : Vec3D(0, 0, -1));
        SphericalParticle P0(species);
        P0.setRadius(0.5);
        for (int i = 0; i < 5; i++)
            for (int j = 0; j < 5; j++)
                for (int k = 0; k < (flat ? 1 : 5); k++) {
                    P0.setPosition(0.5 * Vec3D(1. + 2. * i, 1. + 2. * j, flat ? 0 : 1. + 2. * k));
                    particleHandler.copyAndAddObject(P0);
                }
        for (int axis = 0; axis < dimensions; ++axis)
            for (const double side : {-1.0, 1.0})
                wallHandler.copyAndAddObject(
                    InfiniteWall(side * Vec3D::Unit(axis), side < 0 ? getMin() : getMax(), species));
        setTimeStep(.0002);
        setQuiet();
    }
};

/// A grain of a column along an axis as in MercuryDPM's restart file, and the force on the floor (N).
struct InColumn {
    double place, speed;  // m, m/s
};
void expectColumns(Packing& scene, int axis, std::size_t floor, double force,
                   const std::array<InColumn, 5>& there) {
    for (const auto grain : scene.particleHandler) {
        // Of round-off: 1e-16 of 5 m, and what the stiffness makes of it in a step.
        const auto& [place, speed] = there[static_cast<std::size_t>(grain->getPosition()[axis])];
        EXPECT_NEAR(grain->getPosition()[axis], place, 1e-13);
        EXPECT_NEAR(grain->getVelocity()[axis], speed, 1e-12);
    }
    EXPECT_NEAR(scene.wallHandler.getObject(floor)->getForce()[axis], force, 1e-8);
}

// While it still settles, as in its file CubicPackingSelfTest.restart.
TEST(MercuryPrograms, cubicPacking) {
    Packing problem(3);
    problem.setTimeMax(0.2);
    auto Z = problem.cgHandler.copyAndAddObject(CG<CGCoordinates::Z, CGFunctions::Gauss>(0.1, 500));
    auto O = problem.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    problem.solve();
    const double density = 1.9098593 * constants::pi / 6;  // kg/m^3, of the box
    EXPECT_NEAR(O->getPoint(0).getDensity(), density, 1e-12);
    // A tenth of the width apart; what of the Gauss is cut off, at e^-4.5 of its peak, ends between points.
    EXPECT_NEAR(Z->evaluateAverage().getDensity(), density,
                0.1 * 2 * std::exp(-4.5) / std::sqrt(2 * constants::pi));
    expectColumns(problem, 2, 4, -142.116248235575,
                  {{{0.499925348298183, -8.89450904496229e-05},
                    {1.49986458715971, -0.000170684436175048},
                    {2.49981836718401, -0.000238596019239987},
                    {3.49978722890879, -0.000287178013207875},
                    {4.4997715590188, -0.000312494530746674}}});
}

// At rest nearly, as in its file SquarePackingSelfTest.restart.
TEST(MercuryPrograms, squarePacking) {
    Packing problem(2);
    problem.setTimeMax(1 + 2e-4);  // there is one step more, by round-off
    auto O = problem.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    problem.solve();
    EXPECT_NEAR(O->getPoint(0).getDensity(), 1, 1e-12);
    // The floor bears the discs. The slowest swing of a column of five on a floor has the stiffness 4 k
    // sin^2(pi / 22) = 0.081 k, and decays by its dashpots, g/2m = 115/s, with 9.3/s: to 1e-4 of the weight.
    EXPECT_NEAR(problem.wallHandler.getObject(2)->getForce().y(), -25, 25 * std::exp(-9.3));
    expectColumns(problem, 1, 2, -25.0017033096029,
                  {{{0.499934083168255, -2.30760505779415e-07},
                    {1.49988134925286, -4.42826070762204e-07},
                    {2.49984179853538, -6.19016735492553e-07},
                    {3.49981543124975, -7.45057968314721e-07},
                    {4.49980224756333, -8.10739198021876e-07}}});
    for (auto grain : problem.particleHandler) {
        EXPECT_NEAR(grain->getMass(), 1, 1e-14);
        EXPECT_EQ(grain->getVelocity().z(), 0);
        EXPECT_EQ(grain->getPosition().z(), 0);
    }
}

// 10 000 grains, normal in size, in a pile: the moments of their radii. The numbers are those of the C++
// library's mt19937 and normal_distribution, by g++.
TEST(MercuryPrograms, cgMoment) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(6.0 / constants::pi), species->setStiffness(1);
    scene.setDomain({0, 0, 0}, {1, 1, 1});
    std::mt19937 generator(0);
    std::normal_distribution<> sizes(1, 0.1);
    SphericalParticle p(species);
    double height = 0;
    for (int i = 0; i < 10000; ++i) {
        p.setRadius(std::min(2.0, std::max(0.0, sizes(generator))));
        p.setPosition({0, 0, height += 4 * p.getRadius()});
        scene.particleHandler.copyAndAddObject(p);
    }
    scene.setTimeStep(1e-4);
    scene.setTimeMax(0);
    scene.setQuiet();
    auto cg = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    scene.solve();
    const auto moments = cg->getStandardisedParticleSizeMomenta();
    helpers::check(moments[0], 10000, 1e-5, "number");
    helpers::check(moments[1], 1.001, 1e-5, "mean");
    helpers::check(moments[2], 0.0101141, 1e-5, "variance");
    helpers::check(moments[3], -0.0198724, 1e-5, "skewness");
    helpers::check(moments[4], 2.91938, 1e-5, "kurtosis");
    helpers::check(moments[5], -0.0762574, 1e-5, "fifth moment");
}

// A leaning stack on a grain that is held: whatever is resolved, and by whichever function, the mean over the
// box is that of all, to what points along a direction can tell of a smooth function.
TEST(MercuryPrograms, cgBasic) {
    using namespace CGCoordinates;
    using namespace CGFunctions;
    MercuryScene<LinearViscoelasticSpecies> scene;
    scene.setGravity({-0.1, 0, -1.0});
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(6.0 / constants::pi);
    species->setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
    scene.setTimeStep(species->getCollisionTime(1.0) / 50.0);
    scene.setTimeMax(0.21);
    scene.setDomain({-0.1, 0, -0.6}, {1.1, 1, 2.1});
    SphericalParticle p(species);
    p.setRadius(0.5 * std::sqrt(1.01));
    p.setPosition({0.5, 0.5, 0.5});
    scene.particleHandler.copyAndAddObject(p);
    p.setPosition({0.6, 0.5, 1.5});
    scene.particleHandler.copyAndAddObject(p);
    p.setPosition({0.4, 0.5, -0.5});
    p.fixParticle();
    scene.particleHandler.copyAndAddObject(p);
    auto all = scene.cgHandler.copyAndAddObject(CG<O>());
    const double gauss = 0.5 / 3.01, other = 0.5 / 2.01;
    std::vector<MercuryCG*> resolved{scene.cgHandler.copyAndAddObject(CG<Z, Gauss>(gauss, 200)),
                                     scene.cgHandler.copyAndAddObject(CG<YZ, Gauss>(gauss, 33)),
                                     scene.cgHandler.copyAndAddObject(CG<XYZ, Gauss>(gauss, 20)),
                                     scene.cgHandler.copyAndAddObject(CG<Z, Heaviside>(other, 1000)),
                                     scene.cgHandler.copyAndAddObject(CG<Z, Lucy>(other, 200)),
                                     scene.cgHandler.copyAndAddObject(CG<YZ, Lucy>(other, 33)),
                                     scene.cgHandler.copyAndAddObject(CG<XYZ, Lucy>(other, 20)),
                                     scene.cgHandler.copyAndAddObject(CG<X, Lucy>(other, 200)),
                                     scene.cgHandler.copyAndAddObject(CG<X, Gauss>(gauss, 200)),
                                     scene.cgHandler.copyAndAddObject(CG<Y, Lucy>(other, 200)),
                                     scene.cgHandler.copyAndAddObject(CG<Y, Gauss>(gauss, 200))};
    scene.setQuiet();
    scene.solve();
    const double volume = 1.2 * 1 * 2.7, mass = 2 * std::pow(1.01, 1.5);
    const CGPoint whole = all->getPoint(0);
    helpers::check(whole.getDensity(), mass / volume, 1e-13, "mean density");
    for (std::size_t k = 0; k < resolved.size(); ++k) {
        const CGPoint mean = resolved[k]->evaluateAverage();
        EXPECT_NEAR(mean.getDensity() / whole.getDensity(), 1, 2e-3) << k;
        EXPECT_NEAR(mean.getContactStress()(2, 2) / whole.getContactStress()(2, 2), 1, 2e-3) << k;
    }
}

// A cubic packing of 5^3 grains: the share of their volume in a sphere about the middle, by the grains whose
// centres are in it, counted by hand and as a field.
TEST(MercuryPrograms, computeVolumeFraction) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(1), species->setStiffness(1);
    scene.setMax({5, 5, 5});
    SphericalParticle p(species);
    p.setRadius(0.5);
    int inside = 0;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            for (int k = 0; k < 5; ++k) {
                p.setPosition(Vec3D(.5 + i, .5 + j, .5 + k));
                scene.particleHandler.copyAndAddObject(p);
                inside += (i - 2) * (i - 2) + (j - 2) * (j - 2) + (k - 2) * (k - 2) <= 6 ? 1 : 0;
            }
    const double cutoff = 2.5;  // between the roots of 6 and of 8
    auto cg = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::XYZ, CGFunctions::Heaviside>(cutoff, 1));
    cg->setMin({2.5, 2.5, 2.5});
    cg->setMax({2.5, 2.5, 2.5});
    scene.setTimeStep(1e-3);
    scene.setTimeMax(0);
    scene.setQuiet();
    scene.solve();
    double counted = 0;
    for (auto grain : scene.particleHandler)
        if ((grain->getPosition() - Vec3D(2.5, 2.5, 2.5)).squaredNorm() < cutoff * cutoff)
            counted += grain->getVolume();
    const double sphere = 4. / 3. * constants::pi * mathsFunc::cubic(cutoff);
    EXPECT_EQ(inside, 81);
    EXPECT_NEAR(counted / sphere, inside * 0.001 * 8, 1e-13);
    helpers::check(cg->getPoint(0).getVolumeFraction(), counted / sphere, 1e-13, "volume fraction");
    // What a hook changes is in the fields at once.
    scene.particleHandler.getObject(62)->setRadius(0.25);
    EXPECT_NEAR(cg->getPoint(0).getVolumeFraction(), (counted - 7. / 8 * constants::pi / 6) / sphere, 1e-13);
}

}  // namespace
}  // namespace pendular::mercuryFieldsTest
