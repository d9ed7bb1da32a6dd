#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "Kernel/Laws/Species/LawNames.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::speciesNameTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

// Names, made by the compiler.

static_assert(Species<LinearViscoelastic>::name == "LinearViscoelasticSpecies");
static_assert(Species<HertzianViscoelastic>::name == "HertzianViscoelasticSpecies");
static_assert(Species<HertzianViscoelastic, Mindlin>::name == "HertzianViscoelasticMindlinSpecies");
static_assert(Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>::name ==
              "HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies");
static_assert(Species<HertzianViscoelastic, NoFriction, LiquidBridgeWillett>::name ==
              "HertzianViscoelasticLiquidBridgeWillettSpecies");
static_assert(Species<LinearViscoelastic, Mindlin, LiquidBridgeClassicalWillett>::name ==
              "LinearViscoelasticMindlinLiquidBridgeClassicalWillettSpecies");

// The named species, and the other spelling of Willett.
static_assert(std::is_same_v<HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies,
                             Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>>);
static_assert(std::is_same_v<LinearViscoelasticSpecies, Species<LinearViscoelastic>>);
static_assert(std::is_same_v<HertzianViscoelasticMindlinSpecies, Species<HertzianViscoelastic, Mindlin>>);
static_assert(std::is_same_v<HertzianViscoelasticMindlinLiquidBridgeWilletSpecies,
                             HertzianViscoelasticMindlinLiquidBridgeWillettSpecies>);
static_assert(std::is_same_v<HertzianViscoelasticMindlinLiquidBridgeClassicalWilletSpecies,
                             HertzianViscoelasticMindlinLiquidBridgeClassicalWillettSpecies>);
static_assert(std::is_same_v<LinearViscoelasticLiquidBridgeWilletSpecies,
                             Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>>);

TEST(SpeciesName, isTheConcatenationOfTheLawsNames) {
    support::forSpeciesWithEveryLaw([]<class S>() {
        const std::string expected = std::string(S::Normal::name) + std::string(S::Friction::name) +
                                     std::string(S::Adhesion::name) + "Species";
        EXPECT_EQ(S::name, expected);
        EXPECT_EQ(S{}.getName(), expected);
    });
}

TEST(SpeciesName, aLawIsFoundByItsNameInBothSpellings) {
    AdhesionLaws::forEach([]<class Law>() {
        std::string name(Law::acts ? Law::name : "none");
        const auto expectFound = [](const std::string& wanted) {
            int found = 0;
            withLawNamed<AdhesionLaws>("adhesion model", wanted, [&]<class Found>() {
                EXPECT_TRUE((std::is_same_v<Found, Law>));
                ++found;
            });
            EXPECT_EQ(found, 1) << wanted;
        };
        expectFound(name);
        if (const auto at = name.find("Willett"); at != std::string::npos) expectFound(name.erase(at + 6, 1));
    });
    EXPECT_EQ(canonicalLawName("LiquidBridgeWillet"), "LiquidBridgeWillett");
    EXPECT_EQ(canonicalLawName("LiquidBridgeWillett"), "LiquidBridgeWillett");
    EXPECT_EQ(canonicalLawName("HertzianViscoelasticMindlinLiquidBridgeClassicalWilletSpecies"),
              "HertzianViscoelasticMindlinLiquidBridgeClassicalWillettSpecies");
}

TEST(SpeciesName, anUnknownLawIsRefusedWithTheNearestNames) {
    const auto refused = [](const std::string& name) {
        return refusal([&] { withLawNamed<AdhesionLaws>("adhesion model", name, []<class>() { FAIL(); }); });
    };
    for (const std::string name : {"LiquidBridgeBaghery", "liquidbridgebagheri", "Bagheri", "JKRS", ""}) {
        const std::string message = refused(name);
        EXPECT_TRUE(isOneSentence(message));
        EXPECT_TRUE(contains(message, "adhesion model"));
        EXPECT_TRUE(contains(message, "\"" + name + "\""));
    }
    EXPECT_TRUE(contains(refused("LiquidBridgeBaghery"), "are LiquidBridgeBagheri,"));
    EXPECT_TRUE(contains(refused("liquidbridgebagheri"), "are LiquidBridgeBagheri,"));
    EXPECT_TRUE(contains(refused("LiquidBridgeWillets"), "are LiquidBridgeWillett,"));
    EXPECT_TRUE(contains(refused("nine"), "are none,"));
}

TEST(SpeciesName, everyLawSatisfiesItsConceptOnly) {
    NormalLaws::forEach([]<class L>() { static_assert(NormalLaw<L> && !FrictionLaw<L> && !AdhesionLaw<L>); });
    FrictionLaws::forEach([]<class L>() { static_assert(FrictionLaw<L> && !NormalLaw<L>); });
    AdhesionLaws::forEach([]<class L>() { static_assert(AdhesionLaw<L> && !NormalLaw<L>); });
}

// Each of these has all that a law needs except for the one thing that its name says.
namespace broken {

template <class Law>
struct WithoutName : Law {
    static constexpr int name = 0;
};
template <class Law>
struct WithoutDomain : Law {
    static constexpr int domain = 0;
};
template <class Law>
struct WithoutFields : Law {
    static constexpr auto fields() = delete;
};
template <class Law>
struct WithoutRange : Law {
    double range(const Bodies&) const = delete;
};
template <class Law>
struct WithRangeOfNothing : Law {
    double range() const { return 0; }
};

struct NormalWithoutForce : HertzianViscoelastic {
    template <class T>
    static NormalForce<T> force(const Prepared&, const Contact<T>&) = delete;
};
struct NormalForDoublesOnly : HertzianViscoelastic {
    static NormalForce<double> force(const Prepared& p, const Contact<double>& contact) {
        return HertzianViscoelastic::force(p, contact);
    }
};
struct NormalWithoutPrepare : HertzianViscoelastic {
    Prepared prepare() const = delete;
};
struct NormalWithoutEnergy : HertzianViscoelastic {
    static double elasticEnergy(const Prepared&, const Contact<double>&) = delete;
};
struct NormalWithoutStiffness : HertzianViscoelastic {
    static double stiffness(const Prepared&, const Contact<double>&) = delete;
};
struct NormalWithoutDampingExponent : HertzianViscoelastic {
    static void dampingExponent();
};
struct NormalWithoutElasticExponent : HertzianViscoelastic {
    static void elasticExponent();
};

template <class Law>
struct WithVariableActs : Law {
    bool acts = true;
};
struct FrictionWithoutForce : Mindlin {
    template <class T>
    static Vector<T> force(const Prepared&, const Contact<T>&, T, const Slip<T>&,
                           TangentialSpring<T>&) = delete;
};
struct FrictionWithoutStiffness : Mindlin {
    static double stiffness(const Prepared&, const Contact<double>&) = delete;
};
struct FrictionWithoutPrepare : Mindlin {
    template <class Normal>
    Prepared prepare(const Normal&) const = delete;
};

template <class T>
struct SpringWithMisspeltName {
    Vector<T> displacment;
    void turn(const FrameRotation<T>&) {}
    void move(const Vector<T>&) {}
};
struct FrictionWithoutSpring : Mindlin {
    template <class T>
    using History = SpringWithMisspeltName<T>;
};
template <class T>
struct SpringThatDoesNotTurn {
    [[nodiscard]] Vector<T> slidingSpring() const;
    void trun(const FrameRotation<T>&) {}
    void move(const Vector<T>&) {}
};
struct FrictionThatDoesNotTurn : Mindlin {
    template <class T>
    using History = SpringThatDoesNotTurn<T>;
};
template <class T>
struct SpringThatDoesNotMove {
    [[nodiscard]] Vector<T> slidingSpring() const;
    void turn(const FrameRotation<T>&) {}
};
struct FrictionThatDoesNotMove : Mindlin {
    template <class T>
    using History = SpringThatDoesNotMove<T>;
};
struct RollingThatDoesNotMove : Mindlin {
    static constexpr bool hasContactTorque = true;
};

struct AdhesionWithoutPrepare : LiquidBridgeBagheri {
    Interaction<double> prepare(const Bodies&) const = delete;
};
struct AdhesionWithoutForming : LiquidBridgeBagheri {
    static void formsAtContact();
};
struct AdhesionWithoutInteractionRange : LiquidBridgeBagheri {
    template <class T>
    struct Interaction {
        T force(T separation) const { return separation; }
    };
    Interaction<double> prepare(const Bodies&) const { return {}; }
};

}  // namespace broken

template <class Law>
using TableErrors = TypeList<broken::WithoutName<Law>, broken::WithoutDomain<Law>, broken::WithoutFields<Law>,
                             broken::WithoutRange<Law>, broken::WithRangeOfNothing<Law>>;

TEST(SpeciesName, aBrokenNormalLawIsNone) {
    TableErrors<HertzianViscoelastic>::forEach([]<class L>() { static_assert(!NormalLaw<L>); });
    static_assert(!NormalLaw<broken::NormalWithoutForce> && !NormalLaw<broken::NormalForDoublesOnly>);
    static_assert(!NormalLaw<broken::NormalWithoutPrepare> && !NormalLaw<broken::NormalWithoutEnergy>);
    static_assert(!NormalLaw<broken::NormalWithoutStiffness>);
}

// The contact kernel reads both exponents.
TEST(SpeciesName, aNormalLawWithoutExponentsIsNone) {
    EXPECT_FALSE(NormalLaw<broken::NormalWithoutDampingExponent>);
    EXPECT_FALSE(NormalLaw<broken::NormalWithoutElasticExponent>);
}

TEST(SpeciesName, aBrokenFrictionLawIsNone) {
    TableErrors<Mindlin>::forEach([]<class L>() { static_assert(!FrictionLaw<L>); });
    static_assert(!FrictionLaw<broken::WithVariableActs<Mindlin>> &&
                  !FrictionLaw<broken::FrictionWithoutForce>);
    static_assert(!FrictionLaw<broken::FrictionWithoutStiffness>);
    EXPECT_FALSE(FrictionLaw<broken::FrictionWithoutPrepare>);
    // All else is Mindlin's: what these lack would leave a force without a spring, or a spring that stays
    // behind when its contact turns.
    EXPECT_TRUE((FrictionHistory<TangentialSpring<double>, double>));
    EXPECT_FALSE((FrictionHistory<broken::SpringWithMisspeltName<double>, double>));
    EXPECT_FALSE((FrictionHistory<broken::SpringThatDoesNotTurn<double>, double>));
    EXPECT_FALSE((FrictionHistory<broken::SpringThatDoesNotMove<double>, double>));
    EXPECT_FALSE(FrictionLaw<broken::FrictionWithoutSpring>);
    EXPECT_FALSE(FrictionLaw<broken::FrictionThatDoesNotTurn>);
    // These would have the stability limit of springs in the step, and springs ahead.
    EXPECT_FALSE(FrictionLaw<broken::FrictionThatDoesNotMove>);
    EXPECT_FALSE(FrictionLaw<broken::RollingThatDoesNotMove>);
}

TEST(SpeciesName, aBrokenAdhesionLawIsNone) {
    TableErrors<LiquidBridgeBagheri>::forEach([]<class L>() { static_assert(!AdhesionLaw<L>); });
    static_assert(!AdhesionLaw<broken::WithVariableActs<LiquidBridgeBagheri>>);
    static_assert(!AdhesionLaw<broken::AdhesionWithoutPrepare> &&
                  !AdhesionLaw<broken::AdhesionWithoutForming>);
    static_assert(!AdhesionLaw<broken::AdhesionWithoutInteractionRange>);
}

}  // namespace
}  // namespace pendular::speciesNameTest
