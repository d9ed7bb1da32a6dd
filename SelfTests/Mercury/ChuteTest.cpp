// MercuryDPM's class Chute, by its names, and what its programs set up with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "Chute.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::mercuryChuteTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

LinearViscoelasticSpecies* addSpecies(Chute& chute) {
    auto* const species = chute.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(6.0 / constants::pi);
    species->setStiffness(2e5);
    species->setDissipation(25.0);
    return species;
}

void setUp(Chute& chute, RoughBottomType bottom) {
    chute.setFileType(FileType::NO_FILE);
    chute.setQuiet();
    chute.setTimeStep(1e-4);
    chute.setTimeMax(0.1);
    chute.setSaveCount(50);
    chute.setInflowParticleRadius(0.5);
    chute.setFixedParticleRadius(0.5);
    chute.setRoughBottomType(bottom);
    chute.setChuteAngleAndMagnitudeOfGravity(24.0, 1.0);
    chute.setChuteLength(3.0);
    chute.setChuteWidth(3.0);
}

// A chute with a bottom of several layers: what is held, which way it falls, what flows in.
TEST(MercuryPrograms, roughBottom) {
    Chute roughBottomSelfTest;
    setUp(roughBottomSelfTest, MULTILAYER);
    roughBottomSelfTest.setInflowHeight(3.0);  // not set there: 0.02, in which no grain has room
    addSpecies(roughBottomSelfTest);
    roughBottomSelfTest.solve();
    double held = 0;
    int flowing = 0, falling = 0;
    for (auto p : roughBottomSelfTest.particleHandler) {
        const Vec3D place = p->getPosition();
        EXPECT_GE(place.y(), 0.49);
        EXPECT_LE(place.y(), 2.51);
        if (p->isFixed()) {
            held += p->getVolume();
            EXPECT_LE(place.z(), 1e-9);
            EXPECT_GE(place.z(), -1.2 - 1e-9);
            continue;
        }
        ++flowing;
        // They have begun with 0.1 m/s along x and fall since: at most by g t, also after they met others.
        EXPECT_LT(p->getVelocity().norm(), 0.1 + 1.0 * 0.1 + 0.01);
        // Two grains came nearer by at most 2 (0.1 + g t) t = 0.04 m: one farther from all has met none.
        double gap = place.y() - 0.5;
        gap = std::min(gap, 2.5 - place.y());
        for (auto other : roughBottomSelfTest.particleHandler)
            if (other->getId() != p->getId())
                gap = std::min(gap, (other->getPosition() - place).norm() - 2 * 0.5);
        if (gap <= 0.04) continue;
        ++falling;
        EXPECT_GE(p->getVelocity().x(), 0.1);
        EXPECT_NEAR(p->getVelocity().x() - 0.1, -std::tan(24 * constants::degree) * p->getVelocity().z(),
                    1e-12);
    }
    EXPECT_GE(flowing, 1);
    EXPECT_GE(falling, 1);
    // Of a box of 3 x 3 x 2.2 m, among walls.
    EXPECT_GT(held, 0.38 * 3 * 3 * 2.2);
    EXPECT_LT(held, 0.56 * 3 * 3 * 2.2);
    EXPECT_LT((roughBottomSelfTest.getGravity() -
               Vec3D(std::sin(24 * constants::degree), 0, -std::cos(24 * constants::degree)))
                  .norm(),
              1e-15);
}

TEST(MercuryChute, hasBottomsOfOneLayer) {
    Chute rows, random, flat;
    setUp(rows, MONOLAYER_ORDERED), setUp(random, MONOLAYER_DISORDERED), setUp(flat, FLAT);
    for (Chute* chute : {&rows, &random, &flat}) {
        addSpecies(*chute);
        chute->setTimeMax(0);
        chute->setInflowParticleRadius(0.1, 0.2);
        chute->setInflowVelocityVariance(0.5);
        chute->makeChutePeriodic();
        chute->setChuteLength(9);
        chute->setInflowHeight(2);
        EXPECT_EQ(refusal([&] { chute->solve(); }), "");
    }
    EXPECT_EQ(flat.particleHandler.getSize(), 0u);
    ASSERT_EQ(rows.particleHandler.getSize(), 27u);
    EXPECT_EQ(rows.particleHandler.getObject(4)->getPosition(), Vec3D(1.5, 1.5, 0));
    // At random, a little more than half of the area is covered (0.547 where no room is left).
    const double covered = static_cast<double>(random.particleHandler.getSize()) * constants::pi * 0.25 / 27;
    EXPECT_GT(covered, 0.4);
    EXPECT_LT(covered, 0.65);
    for (auto p : random.particleHandler) EXPECT_TRUE(p->isFixed());
}

// What comes goes on along the chute, and goes at its end.
TEST(MercuryChute, feedsAndEmptiesItself) {
    Chute chute;
    setUp(chute, FLAT);
    addSpecies(chute);
    chute.setInflowHeight(3);
    chute.setInflowVelocity(20);
    chute.setTimeMax(0.4);
    chute.solve();
    EXPECT_GT(chute.particleHandler.getSize(), 3u);
    double lowest = 10;
    for (auto p : chute.particleHandler) {
        EXPECT_LE(p->getPosition().x(), 3.01);
        lowest = std::min(lowest, p->getPosition().x());
    }
    EXPECT_LT(lowest, 1);
    EXPECT_GT(chute.particleHandler.getLastObject()->getId(), chute.particleHandler.getSize() + 3);
}

TEST(MercuryChute, refusesWhatIsNoChute) {
    Chute chute;
    chute.setRoughBottomType("MULTILAYER");
    EXPECT_EQ(chute.getRoughBottomType(), MULTILAYER);
    for (const std::string& text :
         {refusal([&] { chute.setRoughBottomType("ROUGH"); }),
          refusal([&] { chute.setChuteAngleAndMagnitudeOfGravity(91, 1); }),
          refusal([&] { chute.setFixedParticleRadius(-1); }), refusal([&] { chute.setInflowHeight(0); }),
          refusal([&] { chute.setInflowParticleRadius(2, 1); }),
          refusal([&] { chute.setInflowVelocityVariance(2); })})
        EXPECT_TRUE(isOneSentence(text) && contains(text, "Chute")) << text;
    chute.setTimeStep(1e-4), chute.setTimeMax(0), chute.setQuiet();
    const std::string without = refusal([&] { chute.solve(); });
    EXPECT_TRUE(isOneSentence(without) && contains(without, "no species")) << without;
    const std::string noGravity = refusal([&] { chute.setChuteAngle(24); });
    EXPECT_TRUE(isOneSentence(noGravity) && contains(noGravity, "without gravity")) << noGravity;
    chute.setGravity({0, 0, -2});
    chute.setChuteAngle(30);
    EXPECT_LT((chute.getGravity() - Vec3D(1, 0, -std::sqrt(3))).norm(), 1e-15);
}

}  // namespace
}  // namespace pendular::mercuryChuteTest
