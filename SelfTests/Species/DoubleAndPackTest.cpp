#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/RandomLaw.h"

// A law gives the same bits on T = double and T = Pack: what is tested in double is what the kernel computes.

namespace pendular::doubleAndPackTest {
namespace {

using support::Draw;
using support::randomLaw;

constexpr int lanes = Pack::lanes;
constexpr int rounds = 2000;

/// A struct of nothing but T, as an array of T.
template <class T, template <class> class Columns>
using Numbers = std::array<T, sizeof(Columns<T>) / sizeof(T)>;

/// Eight structs of doubles as one of packs.
template <template <class> class Columns>
Columns<Pack> packed(const std::array<Columns<double>, lanes>& single) {
    Numbers<Pack, Columns> packs;
    for (std::size_t member = 0; member < packs.size(); ++member) {
        std::array<double, lanes> values;
        for (int k = 0; k < lanes; ++k)
            values[k] = std::bit_cast<Numbers<double, Columns>>(single[k])[member];
        packs[member] = Pack::fromLanes(values);
    }
    return std::bit_cast<Columns<Pack>>(packs);
}

/// That lane k of a struct of packs has the bits of a struct of doubles, which must be finite.
template <template <class> class Columns>
void expectSameBits(const Columns<Pack>& pack, std::size_t k, const Columns<double>& single,
                    std::string_view law) {
    const auto packs = std::bit_cast<Numbers<Pack, Columns>>(pack);
    const auto numbers = std::bit_cast<Numbers<double, Columns>>(single);
    for (std::size_t member = 0; member < numbers.size(); ++member) {
        ASSERT_TRUE(std::isfinite(numbers[member])) << law << ", member " << member;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(packs[member][k]),
                  std::bit_cast<std::uint64_t>(numbers[member]))
            << law << ", member " << member << ": " << packs[member][k] << " and " << numbers[member];
    }
}

template <class T>
struct One {
    T value;
};

Contact<double> randomContact(Draw& draw) {
    const double overlap = draw.oneIn(16) ? 0 : draw.logarithmic(1e-12, 1e-3);
    const double radius = draw.logarithmic(1e-6, 1);
    return {overlap, radius, draw.logarithmic(1e-15, 1)};
}

TEST(DoubleAndPack, normalLawsGiveTheSameBits) {
    NormalLaws::forEach([]<class Law>() {
        using Kind = NormalHistoryOf<Law>;
        Draw draw(1);
        for (int round = 0; round < rounds; ++round) {
            const auto prepared = randomLaw<Law>(draw).prepare();
            std::array<Contact<double>, lanes> contacts;
            std::array<typename Kind::template type<double>, lanes> histories{};
            for (int k = 0; k < lanes; ++k) {
                contacts[k] = randomContact(draw);
                // What a contact of another overlap has left behind.
                Contact<double> before = contacts[k];
                before.overlap *= draw.uniform(0, 3);
                normalForce<Law>(prepared, before, histories[k]);
            }
            const auto expectSame = [&](const NormalForce<Pack>& pack, std::size_t k,
                                        const NormalForce<double>& single) {
                expectSameBits<NormalForce>(pack, k, single, Law::name);
            };
            if constexpr (HasNormalHistory<Law>) {
                auto history = packed<Law::template History>(histories);
                const NormalForce<Pack> pack = Law::force(prepared, packed<Contact>(contacts), history);
                const double step = draw.logarithmic(1e-9, 1);  // s
                if constexpr (Creeps<Law>)
                    Law::creep(prepared, packed<Contact>(contacts), Pack(step), history);
                for (std::size_t k = 0; k < lanes; ++k) {
                    expectSame(pack, k, Law::force(prepared, contacts[k], histories[k]));
                    if constexpr (Creeps<Law>) Law::creep(prepared, contacts[k], step, histories[k]);
                    expectSameBits<Law::template History>(history, k, histories[k], Law::name);
                }
            } else {
                const NormalForce<Pack> pack = Law::force(prepared, packed<Contact>(contacts));
                for (std::size_t k = 0; k < lanes; ++k)
                    expectSame(pack, k, Law::force(prepared, contacts[k]));
            }
            if (::testing::Test::HasFailure()) return;
        }
    });
}

/// What one lane of a friction law reads and, in the history, writes.
template <class Law>
struct Sliding {
    Contact<double> contact;
    FrameRotation<double> rotation;
    Slip<double> slip;
    double normalForce;
    typename Law::template History<double> history;
};

template <class Law>
Sliding<Law> randomSliding(Draw& draw, const typename Law::Prepared& prepared) {
    Sliding<Law> lane;
    lane.contact = randomContact(draw);
    const Vector<double> normal = draw.direction();
    const auto tangential = [&](double size) {
        const Vector<double> v = size * draw.direction();
        return v - dot(v, normal) * normal;
    };
    lane.rotation = {normal, tangential(1e-2), draw.uniform(-1e-2, 1e-2)};
    const double step = draw.logarithmic(1e-9, 1e-3);
    lane.slip = {draw.oneIn(16) ? Vector<double>{0, 0, 0} : tangential(draw.logarithmic(1e-6, 1)), 0.5 * step,
                 0.5 * step};
    Numbers<double, Law::template History> numbers;
    for (double& number : numbers)
        number = draw.oneIn(8) ? 0 : draw.uniform(-1, 1) * draw.logarithmic(1e-9, 1e-3);
    lane.history = std::bit_cast<typename Law::template History<double>>(numbers);
    // About as often below as above the limit, by the size of what spring and dashpot would give without one.
    auto history = lane.history;
    const double size = norm(Law::force(prepared, lane.contact, 1e300, lane.slip, history));
    lane.normalForce = draw.oneIn(16) ? 0 : size * draw.logarithmic(1e-2, 1e2);
    return lane;
}

TEST(DoubleAndPack, frictionLawsGiveTheSameBitsOfForceAndHistory) {
    FrictionLaws::forEach([]<class Law>() {
        if constexpr (Law::acts) {
            Draw draw(2);
            int slid = 0, stuck = 0;
            for (int round = 0; round < rounds; ++round) {
                const auto prepared = randomLaw<Law>(draw).prepare(HertzianViscoelastic{});
                std::array<Contact<double>, lanes> contacts;
                std::array<FrameRotation<double>, lanes> rotations;
                std::array<Slip<double>, lanes> slips;
                std::array<typename Law::template History<double>, lanes> histories;
                std::array<double, lanes> normalForces;
                for (int k = 0; k < lanes; ++k) {
                    const Sliding<Law> lane = randomSliding<Law>(draw, prepared);
                    contacts[k] = lane.contact, rotations[k] = lane.rotation, slips[k] = lane.slip;
                    histories[k] = lane.history, normalForces[k] = lane.normalForce;
                }
                auto history = packed<Law::template History>(histories);
                constexpr bool turns = requires { history.turn(packed<FrameRotation>(rotations)); };
                if constexpr (turns) history.turn(packed<FrameRotation>(rotations));
                const Vector<Pack> force =
                    Law::force(prepared, packed<Contact>(contacts), Pack::fromLanes(normalForces),
                               packed<Slip>(slips), history);
                Vector<Pack> rotation;
                if constexpr (HasContactTorque<Law>)
                    rotation = Law::rotationForce(
                        prepared, packed<Contact>(contacts), Pack::fromLanes(normalForces),
                        packed<FrameRotation>(rotations).normal, packed<Slip>(slips), history);
                for (std::size_t k = 0; k < lanes; ++k) {
                    if constexpr (turns) histories[k].turn(rotations[k]);
                    auto free = histories[k];
                    const double wanted = norm(Law::force(prepared, contacts[k], 1e300, slips[k], free));
                    const auto single =
                        Law::force(prepared, contacts[k], normalForces[k], slips[k], histories[k]);
                    (norm(single) < 0.999 * wanted ? slid : stuck) += 1;
                    if constexpr (HasContactTorque<Law>)
                        expectSameBits<Vector>(
                            rotation, k,
                            Law::rotationForce(prepared, contacts[k], normalForces[k], rotations[k].normal,
                                               slips[k], histories[k]),
                            Law::name);
                    expectSameBits<Vector>(force, k, single, Law::name);
                    if (contacts[k].overlap > 0)  // without overlap there is no spring: the kernel drops it
                        expectSameBits<Law::template History>(history, k, histories[k], Law::name);
                }
                if (::testing::Test::HasFailure()) return;
            }
            EXPECT_GT(slid, rounds) << "too few contacts slid";
            EXPECT_GT(stuck, rounds) << "too few contacts stuck";
        }
    });
}

TEST(DoubleAndPack, otherAdhesionLawsGiveTheSameBits) {
    AdhesionLaws::forEach([]<class Law>() {
        if constexpr (Law::acts && !requires(Law law) { law.setLiquidBridgeVolume(0.0); }) {
            Draw draw(4);
            for (int round = 0; round < rounds; ++round) {
                std::array<typename Law::template Interaction<double>, lanes> contacts;
                std::array<double, lanes> separations;
                for (int k = 0; k < lanes; ++k) {
                    contacts[k] = randomLaw<Law>(draw).prepare(
                        Bodies{1, draw.oneIn(4) ? infinity : draw.uniform(0.1, 10)});
                    separations[k] = separationFor<Law>(draw.uniform(-1, 3) * contacts[k].range());
                }
                const Pack force =
                    packed<Law::template Interaction>(contacts).force(Pack::fromLanes(separations));
                for (std::size_t k = 0; k < lanes; ++k)
                    expectSameBits<One>({force}, k, {contacts[k].force(separations[k])}, Law::name);
                if (::testing::Test::HasFailure()) return;
            }
        }
    });
}

template <class Law>
Law randomBridge(Draw& draw) {
    Law law;
    law.setLiquidBridgeVolume(draw.oneIn(16) ? 0 : draw.logarithmic(1e-10, 1));
    law.setContactAngle(draw.oneIn(4) ? 0.0 : draw.uniform(0, 1.57));
    law.setSurfaceTension(draw.uniform(0.01, 0.1));
    return law;
}

TEST(DoubleAndPack, bridgesGiveTheSameBits) {
    forEachBridgeLaw([]<class Law>() {
        Draw draw(3);
        for (int round = 0; round < rounds; ++round) {
            std::array<typename Law::template Interaction<double>, lanes> bridges;
            std::array<double, lanes> separations;
            for (int k = 0; k < lanes; ++k) {
                bridges[k] = randomBridge<Law>(draw).prepare(
                    Bodies{1, draw.oneIn(4) ? infinity : draw.uniform(0.1, 10)});
                separations[k] = draw.oneIn(8) ? 0.0 : draw.logarithmic(1e-9, 1.2) * bridges[k].range();
            }
            const auto pack = packed<Law::template Interaction>(bridges);
            const Pack force = pack.force(Pack::fromLanes(separations));
            for (std::size_t k = 0; k < lanes; ++k) {
                expectSameBits<One>({force}, k, {bridges[k].force(separations[k])}, Law::name);
                expectSameBits<One>({pack.range()}, k, {bridges[k].range()}, Law::name);
            }
            if (::testing::Test::HasFailure()) return;
        }
    });
}

}  // namespace
}  // namespace pendular::doubleAndPackTest
