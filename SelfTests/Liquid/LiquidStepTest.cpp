#include "Kernel/Features/LiquidTransport/LiquidStep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/PlainLiquid.h"

namespace pendular::liquidStepTest {
namespace {

using support::PlainLiquid;
using Pair = PlainLiquid::Pair;

// The sequences of given_migration.csv, found by an independent program in exact fractions. Their unit, 1e-12
// m^3, is 2^44 quanta here.
constexpr double unit = 0x1p44;

struct Row {
    int step;
    std::vector<Pair> part, touch;
    std::map<std::uint32_t, double> absorb, films;
    std::map<std::string, double> bridges;
    double wall, absorbed;
};
using Sequences = std::vector<std::pair<std::string, std::vector<Row>>>;

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::stringstream stream(text);
    for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
    return parts;
}
Pair pairOf(const std::string& text) {
    const auto bodies = split(text, '-');
    return {static_cast<std::uint32_t>(std::stoul(bodies[0])),
            bodies[1] == "W" ? PlainLiquid::wall : static_cast<std::uint32_t>(std::stoul(bodies[1]))};
}
std::vector<Pair> pairsOf(const std::string& text) {
    std::vector<Pair> pairs;
    for (const std::string& part : split(text, ' ')) pairs.push_back(pairOf(part));
    return pairs;
}
template <class Key, class KeyOf>
std::map<Key, double> numbersOf(const std::string& text, KeyOf&& keyOf) {
    std::map<Key, double> numbers;
    for (const std::string& part : split(text, ' ')) {
        const auto sides = split(part, ':');
        numbers[keyOf(sides[0])] = std::stod(sides[1]);
    }
    return numbers;
}
std::uint32_t grainOf(const std::string& text) { return static_cast<std::uint32_t>(std::stoul(text)); }

Sequences given() {
    std::ifstream file(folders::source / "SelfTests/Liquid/given_migration.csv");
    Sequences sequences;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        const auto cells = split(line, ',');
        if (sequences.empty() || sequences.back().first != cells[0]) sequences.push_back({cells[0], {}});
        sequences.back().second.push_back(
            {std::stoi(cells[1]), pairsOf(cells[2]), pairsOf(cells[3]),
             numbersOf<std::uint32_t>(cells[4], grainOf), numbersOf<std::uint32_t>(cells[5], grainOf),
             numbersOf<std::string>(cells[6], [](const std::string& pair) { return pair; }),
             std::stod(cells[7]), std::stod(cells[8])});
    }
    return sequences;
}

/// The fields that the name of a sequence gives: "vmax 3.5 / c 1".
PlainLiquid liquidOf(const std::string& name) {
    const auto value = [&](const std::string& field, double standard) {
        std::smatch match;
        return std::regex_search(name, match, std::regex(field + R"( ([0-9.]+))")) ? std::stod(match[1])
                                                                                   : standard;
    };
    PlainLiquid liquid;
    liquid.rules = QuantisedRules({.largest = value("vmax", 100),
                                   .least = value("vmin", 0),
                                   .share = value("c", 1),
                                   .wallDose = value("dose", 0)},
                                  1 / unit);
    return liquid;
}

void begin(PlainLiquid& liquid, const Row& row) {
    liquid.films.assign(11, 0);
    for (const auto& [grain, film] : row.films) liquid.films[grain] = std::llround(film * unit);
    for (const auto& [pair, volume] : row.bridges) {
        auto& contact = liquid.contacts[liquid.contactOf(pairOf(pair))];
        contact.volume = std::llround(volume * unit);
        contact.touching = true;
    }
}
void advance(PlainLiquid& liquid, const Row& row) {
    for (const auto& [grain, volume] : row.absorb) liquid.absorb(grain, std::llround(volume * unit));
    liquid.run(row.part, row.touch);
}

/// Whether a number is a multiple of 2^-16, so that all its shares so far were whole.
bool isDyadic(double number) { return number * 0x1p16 == std::floor(number * 0x1p16); }

/// The largest deviation (quanta) from a row; that of numbers that are multiples of 2^-16 must be 0.
double deviation(const PlainLiquid& liquid, const Row& row, bool mustBeExact) {
    double largest = 0;
    const auto compare = [&](Quanta own, double wanted) {
        const double off = std::abs(static_cast<double>(own) - wanted * unit);
        largest = std::max(largest, off);
        if (mustBeExact) {
            EXPECT_EQ(off, 0) << wanted;
        }
    };
    for (std::uint32_t grain = 0; grain < liquid.films.size(); ++grain)
        compare(liquid.films[grain], row.films.contains(grain) ? row.films.at(grain) : 0);
    std::size_t bridges = 0;
    for (const auto& contact : liquid.contacts) bridges += contact.volume > 0 ? 1 : 0;
    EXPECT_EQ(bridges, row.bridges.size());
    PlainLiquid copy = liquid;
    for (const auto& [pair, volume] : row.bridges)
        compare(copy.contacts[copy.contactOf(pairOf(pair))].volume, volume);
    compare(liquid.wallAccount, row.wall);
    compare(liquid.absorbed, row.absorbed);
    return largest;
}

bool isDyadic(const Row& row) {
    for (const auto& [grain, film] : row.films)
        if (!isDyadic(film)) return false;
    for (const auto& [pair, volume] : row.bridges)
        if (!isDyadic(volume)) return false;
    return true;
}

TEST(LiquidStep, followsAllGivenSequences) {
    const Sequences sequences = given();
    ASSERT_EQ(sequences.size(), 13u);
    int exactRows = 0, rows = 0;
    for (const auto& [name, steps] : sequences) {
        SCOPED_TRACE(name);
        PlainLiquid liquid = liquidOf(name);
        begin(liquid, steps.front());
        const Quanta before = liquid.total();
        bool isExact = true;
        for (std::size_t k = 1; k < steps.size(); ++k) {
            SCOPED_TRACE(steps[k].step);
            advance(liquid, steps[k]);
            isExact &= isDyadic(steps[k]);
            ++rows, exactRows += isExact;
            // A step rounds at most some ten shares, each by less than a quantum; what is rounded goes to
            // another taker, and later shares pass on errors without making them larger. The file has 16
            // digits: below 20 units, 2e-15 x 20 x 2^44 quanta = 0.7.
            EXPECT_LE(deviation(liquid, steps[k], isExact),
                      isExact ? 0.0 : 10.0 * static_cast<double>(k) + 1);
            EXPECT_EQ(liquid.total(), before + liquid.absorbed);
        }
    }
    EXPECT_EQ(rows, 128);
    EXPECT_EQ(exactRows, 66);  // the others have thirds, or smaller parts than 2^-16
}

/// A liquid with its contacts in another order of the list.
PlainLiquid shuffled(PlainLiquid liquid, std::mt19937& random) {
    std::shuffle(liquid.contacts.begin(), liquid.contacts.end(), random);
    return liquid;
}

TEST(LiquidStep, doesNotDependOnTheOrderOfAnyList) {
    std::mt19937 random(1);
    for (const auto& [name, steps] : given()) {
        SCOPED_TRACE(name);
        PlainLiquid liquid = liquidOf(name);
        begin(liquid, steps.front());
        PlainLiquid other = liquid;
        for (std::size_t k = 1; k < steps.size(); ++k) {
            advance(liquid, steps[k]);
            other = shuffled(other, random);
            Row row = steps[k];
            std::shuffle(row.part.begin(), row.part.end(), random);
            std::shuffle(row.touch.begin(), row.touch.end(), random);
            advance(other, row);
            EXPECT_EQ(other.films, liquid.films);
            EXPECT_EQ(other.wallAccount, liquid.wallAccount);
            for (const auto& contact : liquid.contacts)
                EXPECT_EQ(other.contacts[other.contactOf({contact.first, contact.second})].volume,
                          contact.volume);
        }
    }
}

/// All grains are looked at in each step, as the model says.
TEST(LiquidStep, needsToLookOnlyWhereSomethingChanged) {
    for (const auto& [name, steps] : given()) {
        SCOPED_TRACE(name);
        PlainLiquid liquid = liquidOf(name), full = liquid;
        begin(liquid, steps.front()), begin(full, steps.front());
        for (std::size_t k = 1; k < steps.size(); ++k) {
            advance(liquid, steps[k]);
            for (std::uint32_t grain = 0; grain < full.films.size(); ++grain) full.looked.push_back(grain);
            advance(full, steps[k]);
            EXPECT_EQ(full.films, liquid.films);
        }
    }
}

/// Random events on 50 grains and a wet wall, each step with several at once.
struct RandomEvents {
    std::mt19937_64 random{7};
    PlainLiquid liquid;

    explicit RandomEvents(const LiquidRules& rules) {
        liquid.rules = QuantisedRules(rules, 1 / unit);
        liquid.films.resize(50);
        for (Quanta& film : liquid.films) film = std::llround(uniform() * unit);
        for (std::uint32_t a = 0; a < 50; ++a) {
            liquid.contacts.push_back({a, PlainLiquid::wall});
            for (const std::uint32_t b : {(a + 1) % 50, (a + 7) % 50})
                liquid.contacts.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    double uniform() { return static_cast<double>(random() >> 11) * 0x1p-53; }
    int advance() {
        std::vector<Pair> part, touch;
        for (int event = 0; event < 5; ++event) {
            const auto& contact = liquid.contacts[random() % liquid.contacts.size()];
            const Pair pair{contact.first, contact.second};
            if (std::ranges::count(part, pair) + std::ranges::count(touch, pair) > 0) continue;
            (contact.touching ? part : touch).push_back(pair);
        }
        liquid.run(part, touch);
        return static_cast<int>(part.size() + touch.size());
    }
};

TEST(HeavyLiquidStep, losesNoQuantumInAMillionEvents) {
    for (const bool option : {false, true}) {
        RandomEvents events({.largest = 0.7,
                             .least = 0.01,
                             .share = 0.9,
                             .wallDose = 1.0 / 3,
                             .byRoom = option,
                             .toDry = option});
        const Quanta before = events.liquid.total();
        int count = 0;
        while (count < 500000) {
            count += events.advance();
            if (events.liquid.total() != before) break;
            for (const Quanta film : events.liquid.films) ASSERT_GE(film, 0);
        }
        EXPECT_EQ(events.liquid.total(), before);
        for (const auto& contact : events.liquid.contacts) {
            EXPECT_GE(contact.volume, 0);
            EXPECT_LE(contact.volume, events.liquid.rules.largest);
        }
    }
}

TEST(LiquidStep, needsToLookOnlyWhereSomethingChangedInRandomEventsToo) {
    for (const double dose : {0.0, 1.0 / 3})
        for (const bool option : {false, true}) {
            const LiquidRules rules{.largest = 0.7,
                                    .least = 0.05,
                                    .share = 0.9,
                                    .wallDose = dose,
                                    .byRoom = option,
                                    .toDry = option};
            RandomEvents own(rules), full(rules);
            for (int step = 0; step < 1000; ++step) {
                own.advance();
                for (std::uint32_t grain = 0; grain < 50; ++grain) full.liquid.looked.push_back(grain);
                full.advance();
                ASSERT_EQ(own.liquid.films, full.liquid.films) << step;
                ASSERT_EQ(own.liquid.wallAccount, full.liquid.wallAccount);
            }
        }
}

/// A ring of 20 grains: contact k ruptures at the rate nu_k and touches again in the next step; c = 1, no
/// V_max. The mean volumes obey dV_k/dt = (nu_(k-1) V_(k-1) - 2 nu_k V_k + nu_(k+1) V_(k+1)) / 2, so that
/// V_k is proportional to 1 / nu_k. Rates 1 (ten) and 4 (ten), one unit a contact: 1.6 and 0.4.
TEST(LiquidStep, leavesContactsThatRuptureOften) {
    constexpr std::uint32_t count = 20;
    PlainLiquid liquid;
    liquid.rules = QuantisedRules({.largest = 1000, .share = 1}, 1 / unit);
    liquid.films.assign(count, 0);
    std::vector<Pair> pairs;
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t next = (k + 1) % count;
        pairs.push_back({std::min(k, next), std::max(k, next)});
        liquid.contacts.push_back({pairs[k].first, pairs[k].second, static_cast<Quanta>(unit), true});
    }
    std::mt19937_64 random(3);
    double sums[2] = {0, 0}, time = 0;
    const int ruptures = 400000, settling = 20000;
    for (int event = 0; event < ruptures; ++event) {
        // The next one to rupture, in proportion to the rates: 10 of 50 are of the slow ones.
        const std::uint64_t draw = random() % 50;
        const auto k = static_cast<std::uint32_t>(draw < 10 ? draw : 10 + (draw - 10) % 10);
        liquid.run({pairs[k]}, {});
        liquid.run({}, {pairs[k]});
        if (event < settling) continue;
        time += 1;
        for (std::uint32_t c = 0; c < count; ++c)
            sums[c < 10 ? 0 : 1] += static_cast<double>(liquid.contacts[c].volume) / unit / 10;
    }
    EXPECT_EQ(liquid.total(), static_cast<Quanta>(count * unit));
    // Volumes forget what they were after some 20^2 events a contact, 8000 in all, so that 380 000 are about
    // 50 independent states; the share of a half of the ring scatters by some 5 % from state to state.
    EXPECT_NEAR(sums[0] / time, 1.6, 0.02);
    EXPECT_NEAR(sums[1] / time, 0.4, 0.02);
}

// Options, by hand.

PlainLiquid chain(const LiquidRules& rules, std::vector<double> films) {
    PlainLiquid liquid;
    liquid.rules = QuantisedRules(rules, 1 / unit);
    for (const double film : films) liquid.films.push_back(std::llround(film * unit));
    return liquid;
}
double volume(PlainLiquid& liquid, const Pair& pair) {
    return static_cast<double>(liquid.contacts[liquid.contactOf(pair)].volume) / unit;
}

TEST(LiquidStep, sharesByRoomWhereThatIsAsked) {
    // Grain 1 pools 2 and offers it to bridges with room 1 and 3: 0.5 and 1.5.
    PlainLiquid liquid = chain({.largest = 4, .byRoom = true}, {0, 0, 0, 0});
    for (const auto& [second, held] : {std::pair(0u, 4.0), {2u, 3.0}, {3u, 1.0}})
        liquid.contacts.push_back(
            {std::min(1u, second), std::max(1u, second), std::llround(held * unit), true});
    liquid.run({{0, 1}}, {});
    EXPECT_EQ(volume(liquid, {1, 2}), 3.5);
    EXPECT_EQ(volume(liquid, {1, 3}), 2.5);
    EXPECT_EQ(liquid.films[1], 0);
    EXPECT_EQ(liquid.films[0], static_cast<Quanta>(2 * unit));
    // No room at all: the film takes it.
    PlainLiquid full = chain({.largest = 4, .byRoom = true}, {0, 0, 0});
    full.contacts = {{0, 1, static_cast<Quanta>(2 * unit), true},
                     {1, 2, static_cast<Quanta>(4 * unit), true}};
    full.run({{0, 1}}, {});
    EXPECT_EQ(volume(full, {1, 2}), 4);
    EXPECT_EQ(full.films[1], static_cast<Quanta>(unit));
}

TEST(LiquidStep, sharesWithDryContactsWhereThatIsAsked) {
    for (const bool toDry : {false, true})
        for (const double least : {0.0, 2.0}) {
            PlainLiquid liquid = chain({.largest = 4, .least = least, .toDry = toDry}, {0, 0, 0, 0});
            liquid.contacts = {{0, 1, static_cast<Quanta>(2 * unit), true}, {1, 2, 0, true}};
            liquid.run({{0, 1}}, {});
            // Without the option the pool of 1 goes to the film, from which 1-2 draws in the same step.
            EXPECT_EQ(volume(liquid, {1, 2}), least == 0 ? 1 : 0);
            EXPECT_EQ(liquid.films[1], static_cast<Quanta>(least == 0 ? 0 : unit));
        }
    // A wet receiver beside a dry one: half each, instead of all for the wet one.
    PlainLiquid liquid = chain({.largest = 4, .toDry = true}, {0, 0, 0, 0});
    liquid.contacts = {{0, 1, static_cast<Quanta>(2 * unit), true},
                       {1, 2, static_cast<Quanta>(unit), true},
                       {1, 3, 0, true}};
    liquid.run({{0, 1}}, {});
    EXPECT_EQ(volume(liquid, {1, 2}), 1.5);
    EXPECT_EQ(volume(liquid, {1, 3}), 0.5);
}

TEST(LiquidStep, leavesNoCrumbInAFilmThatServesThree) {
    // 2^44 is no multiple of 3; what is left over would be a bridge of a quantum at the next touch.
    PlainLiquid liquid = chain({.largest = 4}, {1, 0, 0, 0, 0});
    liquid.run({}, {{0, 1}, {0, 2}, {0, 3}});
    EXPECT_EQ(liquid.films[0], 0);
    liquid.run({}, {{0, 4}});
    EXPECT_EQ(volume(liquid, {0, 4}), 0);
}

TEST(LiquidStep, givesTheLiquidOfAContactThatEndsToItsFilms) {
    PlainLiquid liquid = chain({.largest = 4, .wallDose = 1}, {0, 0});
    liquid.contacts = {{0, 1, 5, true}, {0, PlainLiquid::wall, 4, true}};
    LiquidStep<PlainLiquid>::release(liquid, 0, liquid.looked);
    LiquidStep<PlainLiquid>::release(liquid, 1, liquid.looked);
    EXPECT_EQ(liquid.films, (std::vector<Quanta>{4, 3}));
    EXPECT_EQ(liquid.wallAccount, 2);
    EXPECT_EQ(liquid.looked, (std::vector<std::uint32_t>{0, 1, 0}));
}

}  // namespace
}  // namespace pendular::liquidStepTest
