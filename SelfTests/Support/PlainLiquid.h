#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "Kernel/Features/LiquidTransport/LiquidStep.h"

namespace pendular::support {

/// Films, bridges and walls as plain data, on which LiquidStep works.
struct PlainLiquid {
    using Number = std::uint32_t;
    static constexpr Number wall = 1u << 31;  // the first of any number of walls

    struct Contact {
        Number first, second;  // grains, the lower one first; second: `wall` + its number
        Quanta volume = 0;
        bool touching = false;
    };
    struct Pair {
        Number first, second;
        friend bool operator==(const Pair&, const Pair&) = default;
    };

    QuantisedRules rules;
    std::vector<Quanta> films;
    std::vector<Contact> contacts;
    Quanta wallAccount = 0;
    Quanta absorbed = 0;
    std::vector<Number> looked;
    LiquidStep<PlainLiquid> step;

    [[nodiscard]] Quanta filmOf(Number grain) const { return films[grain]; }
    void addToFilm(Number grain, Quanta volume) { films[grain] += volume; }
    [[nodiscard]] Quanta volumeOf(Number contact) const { return contacts[contact].volume; }
    void setVolume(Number contact, Quanta volume) { contacts[contact].volume = volume; }
    void addToWall(Number, Quanta volume) { wallAccount += volume; }
    [[nodiscard]] const QuantisedRules& rulesOf(Number) const { return rules; }
    [[nodiscard]] bool touches(Number contact) const { return contacts[contact].touching; }
    [[nodiscard]] bool isAtWall(Number contact) const { return contacts[contact].second >= wall; }
    [[nodiscard]] Number grainOf(Number contact, Number which) const {
        return which == 0 ? contacts[contact].first : contacts[contact].second;
    }
    template <class Function>
    void forEachContactOf(Number grain, Function&& function) const {
        std::vector<std::pair<Number, Number>> own;  // partner, contact
        for (Number c = 0; c < contacts.size(); ++c) {
            const Contact& contact = contacts[c];
            if (!contact.touching && contact.volume == 0) continue;
            if (contact.first == grain) own.emplace_back(contact.second, c);
            else if (contact.second == grain) own.emplace_back(contact.first, c);
        }
        std::ranges::sort(own);
        for (const auto& [partner, contact] : own) function(contact);
    }

    Number contactOf(const Pair& pair) {
        const auto found = std::ranges::find_if(
            contacts, [&](const Contact& c) { return c.first == pair.first && c.second == pair.second; });
        if (found != contacts.end()) return static_cast<Number>(found - contacts.begin());
        contacts.push_back({pair.first, pair.second});
        return static_cast<Number>(contacts.size() - 1);
    }
    void absorb(Number grain, Quanta volume) {
        films[grain] += volume;
        absorbed += volume;
        looked.push_back(grain);
    }
    /// A step in which these contacts part, to beyond their rupture distance, and these begin to touch.
    void run(const std::vector<Pair>& parting, const std::vector<Pair>& touching) {
        std::vector<Number> ruptured;
        const auto change = [&](const Pair& pair, bool touches) {
            const Number number = contactOf(pair);
            contacts[number].touching = touches;
            looked.push_back(pair.first);
            if (pair.second < wall) looked.push_back(pair.second);
            return number;
        };
        for (const Pair& pair : parting)
            if (const Number number = change(pair, false); contacts[number].volume > 0)
                ruptured.push_back(number);
        for (const Pair& pair : touching) change(pair, true);
        step.run(*this, ruptured, looked);
    }
    [[nodiscard]] Quanta total() const {
        Quanta sum = std::accumulate(films.begin(), films.end(), wallAccount);
        for (const Contact& contact : contacts) sum += contact.volume;
        return sum;
    }
};

}  // namespace pendular::support
