// Ranks that have set up another scene, or whose hooks do something else, end with one sentence on all of
// them that names the difference; none of them waits for ever.
#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "Kernel/Features/DomainDecomposition/GrainSharing.h"
#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "Tools/Reference/VirtualRanks.h"

namespace pendular::disagreementTest {
namespace {

using Dry = LinearViscoelasticSpecies;

/// Grains that fall. On one of the ranks something is done otherwise, at set-up or in a hook.
struct Box : scenes::SettlingBox<Dry> {
    Box() : SettlingBox<Dry>(4) {
        setQuiet();
        auto& heat = addPart<HeatPart>(particleHandler.addColumn("temperature", "K", 293));
        for (const std::size_t kind : {0u, 1u})
            heat.setMaterial(speciesHandler.getObject(kind), {.conductivity = 1, .heatCapacity = 800});
        heat.holdWall(0, 400);
        heated = &heat;
    }
    void actionsAfterTimeStep() override {
        if (hook) hook(*this);
    }
    HeatPart* heated;
    std::function<void(Box&)> hook;
};

/// What is thrown, whatever its kind; empty if nothing is.
template <class Function>
std::string told(Function&& function) {
    try {
        function();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

using Change = std::function<void(Box&)>;

/// Runs on three ranks, on one of which a change is made at set-up, or after 20 steps. Returns what each of
/// them says; all say the same.
std::string sentenceOf(
    const Change& atSetUp, const Change& inHook = {},
    const std::function<void(Box&, bool)>& run = [](Box& box, bool) { box.runSteps(400); }) {
    constexpr std::size_t ranks = 3, other = 1;
    std::vector<std::string> sentences(ranks);
    std::string outside;
    outside = told([&] {
        VirtualRanks(ranks).run([&](Exchange& exchange) {
            const bool isOther = exchange.rank() == other;
            sentences[exchange.rank()] = told([&] {
                Box box;
                if (isOther && atSetUp) atSetUp(box);
                if (inHook)
                    box.hook = [&, isOther](Box& in) {
                        if (isOther && in.getNumberOfTimeSteps() == 20) inHook(in);
                    };
                box.setRanks(exchange, {});
                run(box, isOther);
            });
        });
    });
    EXPECT_EQ(outside, "");
    for (const std::string& one : sentences) EXPECT_EQ(one, sentences[0]);
    return sentences[0];
}

void expectTold(const std::string& sentence, std::initializer_list<std::string_view> parts) {
    EXPECT_TRUE(support::isOneSentence(sentence)) << sentence;
    for (const std::string_view part : parts) EXPECT_TRUE(support::contains(sentence, part)) << sentence;
}

TEST(Disagreement, isNotFoundWhereRanksAreAlike) {
    EXPECT_EQ(sentenceOf({}), "");
    EXPECT_EQ(sentenceOf({}, {},
                         [](Box& box, bool) {
                             box.hook = [](Box& in) {
                                 if (in.getNumberOfTimeSteps() == 20)
                                     in.setGravity({0, 0, -5}), in.requestPause();
                                 if (in.getNumberOfTimeSteps() == 40) in.setTimeStep(0.5 * in.getTimeStep());
                             };
                             box.runSteps(100);
                             EXPECT_EQ(box.getNumberOfTimeSteps(), 20u);
                             box.gather();
                             box.particleHandler.removeObject(3);
                             box.runSteps(10);
                             box.finishRun();
                         }),
              "");
}

TEST(Disagreement, ofTheSetUpIsNamed) {
    const std::string_view where = "At set-up the ranks do not agree: ", ranks = " on rank 0 and ";
    expectTold(sentenceOf([](Box& box) { box.setTimeStep(0.5 * box.getTimeStep()); }),
               {where, "timeStep is ", ranks, " s on rank 1"});
    expectTold(sentenceOf([](Box& box) {
                   box.setGravity({0, 0, -5});
               }),
               {where, "gravity/z is ", ranks, "-5 m/s^2"});
    expectTold(sentenceOf([](Box& box) { box.particleHandler.removeObject(3); }),
               {where, "the number of particles is"});
    expectTold(sentenceOf([](Box& box) {
                   GrainReference grain = box.particleHandler.getObject(7);
                   grain.setRadius(0.999 * grain.getRadius());
               }),
               {where, "particle 7/radius is ", ranks, " m on rank 1"});
    expectTold(sentenceOf([](Box& box) {
                   box.particleHandler.getObject(7).setVelocity({0, 0, 0.123});
               }),
               {where, "particle 7/velocity is ", "(0, 0, 0.123) m/s on rank 1"});
    expectTold(sentenceOf([](Box& box) { box.speciesHandler.getObject(0)->setStiffness(123); }),
               {where, "stiffness is ", "123 N/m on rank 1"});
    expectTold(sentenceOf([](Box& box) {
                   InfiniteWall wall;
                   wall.set({0, 0, 1}, {0, 0, 1}), wall.setSpecies(box.speciesHandler.getObject(0));
                   box.wallHandler.copyAndAddObject(wall);
               }),
               {where, "the list of walls is ", "on rank 0 and "});
    expectTold(sentenceOf([](Box& box) { box.heated->holdWall(0, 500); }),
               {where, "parts/heat/wall0/temperature is 400 K on rank 0 and 500 K on rank 1"});
    expectTold(sentenceOf([](Box& box) { box.wallHandler.getObject(2).keepForces(); }),
               {where, "the list of walls whose forces are kept is empty on rank 0 and 2 on rank 1"});
    expectTold(sentenceOf([](Box& box) { box.setHeldContacts(HeldContacts::All); }),
               {where, "heldContacts is 0 on rank 0 and 1 on rank 1"});
    expectTold(sentenceOf([](Box& box) { box.setSaveCount(7); }), {where, "setSaveCount()"});
    expectTold(sentenceOf([](Box& box) { box.setIntegrator(integrators::velocityVerlet); }),
               {where, "integrator"});
}

TEST(Disagreement, ofHooksIsNamed) {
    const std::string_view where = "the ranks do not agree: ", after = "after 20 steps";
    expectTold(sentenceOf({},
                          [](Box& box) {
                              box.setGravity({0, 0, -5});
                          }),
               {where, after, "gravity is (0, 0, -9.81) m/s^2 on rank 0 and (0, 0, -5) m/s^2 on rank 1"});
    expectTold(sentenceOf({}, [](Box& box) { box.requestPause(); }),
               {where, "requestPause() is not called on rank 0 and called on rank 1"});
    expectTold(sentenceOf({}, [](Box& box) { box.setHeldContacts(HeldContacts::None); }),
               {where, after, "setHeldContacts() is WhereAsked on rank 0 and None on rank 1"});
    expectTold(sentenceOf({}, [](Box& box) { box.wallHandler.getObject(2).keepForces(); }),
               {where, after, "the list of walls whose forces are kept is empty on rank 0 and 2 on rank 1"});
    expectTold(sentenceOf({}, [](Box& box) { box.heated->holdWall(0, 500); }),
               {where, "parts/heat/settingsChanged is 0 on rank 0 and 1 on rank 1"});
    expectTold(sentenceOf({},
                          [](Box& box) {
                              if (InfiniteWall* const floor =
                                      dynamic_cast<InfiniteWall*>(&box.wallHandler.getObject(0)))
                                  floor->setVelocity({0, 0, 1e-3});
                          }),
               {where, "walls/0/"});
    expectTold(sentenceOf(
                   {}, [](Box& box) { box.setTimeMax(1e-9); },
                   [](Box& box, bool) {
                       box.setTimeMax(400 * box.getTimeStep());
                       box.solve();
                   }),
               {where, "the last step of this part of the run is 400 on rank 0 and "});
}

// The step is refused on the rank that changes it; the others end with it.
TEST(Disagreement, ofTheTimeStepInAHookIsRefused) {
    const std::string sentence = told([] {
        VirtualRanks(3).run([](Exchange& exchange) {
            Box box;
            if (exchange.rank() == 1)
                box.hook = [](Box& in) {
                    if (in.getNumberOfTimeSteps() == 20) in.setTimeStep(0.5 * in.getTimeStep());
                };
            box.setRanks(exchange, {});
            box.runSteps(400);
        });
    });
    expectTold(sentence, {"time step", "gather()"});
}

TEST(Disagreement, ofPartsOfTheRunIsNamed) {
    expectTold(
        sentenceOf({}, {}, [](Box& box, bool isOther) { box.runSteps(isOther ? 101 : 100); }),
        {"the ranks do not agree: the last step of this part of the run is 100 on rank 0 and 101 on rank 1"});
    expectTold(sentenceOf({}, {},
                          [](Box& box, bool isOther) {
                              box.initialise();
                              box.step(isOther ? 31 : 30);
                          }),
               {"the ranks do not agree: the number of steps that step() is to do is 30 on rank 0 and 31 on "
                "rank 1"});
    const auto between = [](auto&& change) {
        return [change](Box& box, bool isOther) {
            box.runSteps(30);
            if (isOther) change(box);
            box.runSteps(30);
        };
    };
    expectTold(sentenceOf({}, {}, between([](Box& box) { box.particleHandler.removeObject(3); })),
               {"the ranks do not agree: the number of particles is"});
    expectTold(
        sentenceOf({}, {}, between([](Box& box) { box.particleHandler.getObject(5).setRadius(0.9e-3); })),
        {"the ranks do not agree: particle 5/radius is "});
    expectTold(sentenceOf({}, {}, between([](Box& box) { box.wallHandler.removeObject(0); })),
               {"the ranks do not agree: the list of walls is 0, 1, ", " on rank 0 and 1, "});
    expectTold(sentenceOf({}, {}, between([](Box& box) { box.setTimeStep(0.9 * box.getTimeStep()); })),
               {"the ranks do not agree: "});
}

}  // namespace
}  // namespace pendular::disagreementTest
