#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Laws/Concepts/LiquidRules.h"

namespace pendular {

/// floor(total x part / whole), for part <= whole.
inline Quanta portion(Quanta total, Quanta part, Quanta whole) {
    __extension__ using Wide = __int128;
    return static_cast<Quanta>(static_cast<Wide>(total) * part / whole);
}

/// The liquid of a step moves: bridges that have ruptured give theirs to films and to other bridges, and
/// films give theirs to contacts that touch. The model is that of LiquidMigrationWillet (Thornton et al.,
/// "Recent advances in MercuryDPM", section 5; Mani, Kadau, Or and Herrmann 2012), in phases each of which
/// looks at all contacts before it changes any, so that nothing depends on the order of a list:
/// 1. absorb: what has come to films since the last step is in them already;
/// 2. rupture: the liquid of all bridges that have ruptured is pooled at their grains, half each; all of it
/// at
///    the grain if the other body is a dry wall;
/// 3. share out: of a pool p, (1 - c) p goes to the grain's film, and c p is offered to its other bridges.
/// One
///    that is offered more than its room V_max - V takes the same fraction of every offer; what is not taken
///    goes to the film of the grain that offered it;
/// 4. form: every touching contact without a bridge draws. A film serves all of these at its grain in equal
///    parts a; a wet wall offers w. Where T = a + a' > V_min, a bridge of min(T, V_max) forms, taken in
///    proportion a : a'.
/// Volumes are whole quanta. Shares of one volume are the differences of its rounded cumulative shares, in
/// the order of the partners, so that they sum to it and no crumb is left behind; of two takers the first
/// gets its share rounded down. That makes V_max and the sum of all liquid exact.
///
/// `Liquid` has, for grains and contacts by number:
///     Quanta filmOf(grain);  void addToFilm(grain, Quanta);
///     Quanta volumeOf(contact);  void setVolume(contact, Quanta);  void addToWall(contact, Quanta);
///     const QuantisedRules& rulesOf(contact);  bool touches(contact);
///     bool isAtWall(contact);  grainOf(contact, 0 or 1): body 1 is the one with the lower identity;
///     forEachContactOf(grain, function(contact)): those that touch or have a bridge and have rules, in the
///     order of the partners.
/// Where ranks share the grains, a grain's owner alone has all of its contacts, and so it alone forms shares.
/// Others have its contacts with their own grains: what they need to know is exchanged (LiquidOfRanks).
template <class Liquid>
class LiquidStep {
public:
    using Number = std::uint32_t;

    /// Phases 2 to 4.
    /// @param ruptured bridges that have ruptured in this step, with their volumes
    /// @param looked grains at which a contact may form a bridge: those at which a touch has begun or ended,
    /// or to whose film liquid has come, since the last step. On return those that are to be looked at in the
    /// next one. More grains than these change nothing.
    void run(Liquid& liquid, std::span<const Number> ruptured, std::vector<Number>& looked) {
        pools.clear(), offers.clear();
        for (const Number contact : ruptured) pool(liquid, contact, looked);
        offer(liquid, looked);
        if constexpr (isOfRanks) liquid.addOffersOfOthers(offers);
        take(liquid, looked);
        form(liquid, looked);
    }

    /// A bridge gives liquid to its films without a rupture, because a body is removed or changed: all of it,
    /// or so much.
    static void release(Liquid& liquid, Number contact, std::vector<Number>& looked) {
        release(liquid, contact, looked, liquid.volumeOf(contact));
    }
    static void release(Liquid& liquid, Number contact, std::vector<Number>& looked, Quanta volume) {
        const auto [own, rest] = halves(liquid, contact, volume);
        liquid.setVolume(contact, liquid.volumeOf(contact) - volume);
        wet(liquid, liquid.grainOf(contact, 0), own, looked);
        if (liquid.isAtWall(contact)) liquid.addToWall(contact, rest);
        else wet(liquid, liquid.grainOf(contact, 1), rest, looked);
    }

private:
    struct Pool {
        Number grain;
        Quanta volume;
    };
    struct Offer {
        Number contact, side;
        Quanta volume;
    };
    struct Receiver {
        Number contact;
        Quanta room;
    };
    struct Draw {
        Number contact;
        Quanta first, second;  // from body 1, and from body 2 or the wall
    };

    static constexpr bool isOfRanks = requires(Liquid liquid) { liquid.isOwn(Number{}); };
    /// Whether this rank counts the film of a grain.
    static bool isOwn([[maybe_unused]] Liquid& liquid, [[maybe_unused]] Number grain) {
        if constexpr (isOfRanks) return liquid.isOwn(grain);
        else return true;
    }

    static void wet(Liquid& liquid, Number grain, Quanta volume, std::vector<Number>& looked) {
        if (volume == 0 || !isOwn(liquid, grain)) return;
        liquid.addToFilm(grain, volume);
        looked.push_back(grain);
    }
    /// The parts of a volume that body 1 gets, and that body 2 or the wall gets.
    static std::pair<Quanta, Quanta> halves(Liquid& liquid, Number contact, Quanta volume) {
        const bool isDryWall = liquid.isAtWall(contact) && liquid.rulesOf(contact).wallDose == 0;
        const Quanta own = isDryWall ? volume : volume / 2;
        return {own, volume - own};
    }

    void pool(Liquid& liquid, Number contact, std::vector<Number>& looked) {
        const auto [own, rest] = halves(liquid, contact, liquid.volumeOf(contact));
        const double share = liquid.rulesOf(contact).share;
        liquid.setVolume(contact, 0);
        const auto add = [&](Number grain, Quanta volume) {
            if (!isOwn(liquid, grain)) return;
            const auto offered = static_cast<Quanta>(std::floor(share * static_cast<double>(volume)));
            wet(liquid, grain, volume - offered, looked);
            if (offered > 0) pools.push_back({grain, offered});
        };
        add(liquid.grainOf(contact, 0), own);
        if (liquid.isAtWall(contact)) liquid.addToWall(contact, rest);
        else add(liquid.grainOf(contact, 1), rest);
    }

    void offer(Liquid& liquid, std::vector<Number>& looked) {
        std::ranges::sort(pools, {}, &Pool::grain);
        for (std::size_t k = 0, next = 0; k < pools.size(); k = next) {
            const Number grain = pools[k].grain;
            Quanta volume = 0;
            for (next = k; next < pools.size() && pools[next].grain == grain; ++next)
                volume += pools[next].volume;
            offer(liquid, grain, volume, looked);
        }
    }
    void offer(Liquid& liquid, Number grain, Quanta volume, std::vector<Number>& looked) {
        receivers.clear();
        bool byRoom = false;
        liquid.forEachContactOf(grain, [&](Number contact) {
            const QuantisedRules& rules = liquid.rulesOf(contact);
            const Quanta held = liquid.volumeOf(contact);
            if (held == 0 && !(rules.toDry && rules.largest > 0 && liquid.touches(contact))) return;
            receivers.push_back({contact, std::max<Quanta>(rules.largest - held, 0)});
            byRoom |= rules.byRoom;
        });
        const auto weightOf = [&](const Receiver& receiver) { return byRoom ? receiver.room : 1; };
        Quanta weights = 0, reached = 0, given = 0;
        for (const Receiver& receiver : receivers) weights += weightOf(receiver);
        if (weights == 0) return wet(liquid, grain, volume, looked);
        for (const Receiver& receiver : receivers) {
            reached += weightOf(receiver);
            const Quanta before = given;
            given = portion(volume, reached, weights);
            const Number side = liquid.grainOf(receiver.contact, 0) == grain ? 0 : 1;
            offers.push_back({receiver.contact, side, given - before});
        }
    }

    void take(Liquid& liquid, std::vector<Number>& looked) {
        std::ranges::sort(offers, {}, [](const Offer& o) { return std::pair(o.contact, o.side); });
        for (std::size_t k = 0, next = 0; k < offers.size(); k = next) {
            const Number contact = offers[k].contact;
            Quanta offered = 0;
            for (next = k; next < offers.size() && offers[next].contact == contact; ++next)
                offered += offers[next].volume;
            const QuantisedRules& rules = liquid.rulesOf(contact);
            const Quanta held = liquid.volumeOf(contact);
            Quanta taken = std::min(offered, std::max<Quanta>(rules.largest - held, 0));
            if (held == 0 && taken <= rules.least) taken = 0;
            Quanta left = taken;
            for (std::size_t o = k; o < next; ++o) {
                const bool isLast = o + 1 == next;
                const Quanta own = isLast || offered == 0 ? left : portion(offers[o].volume, taken, offered);
                left -= own;
                wet(liquid, liquid.grainOf(contact, offers[o].side), offers[o].volume - own, looked);
            }
            if (taken == 0) continue;
            liquid.setVolume(contact, held + taken);
            if (held > 0) continue;  // else a contact less draws from the films
            looked.push_back(liquid.grainOf(contact, 0));
            if (!liquid.isAtWall(contact)) looked.push_back(liquid.grainOf(contact, 1));
        }
    }

    static bool draws(Liquid& liquid, Number contact) {
        return liquid.touches(contact) && liquid.volumeOf(contact) == 0 &&
               liquid.rulesOf(contact).largest > 0;
    }
    /// The volume that the film of a grain offers to one of the contacts that draw from it.
    static Quanta partOfFilm(Liquid& liquid, Number grain, Number contact) {
        const Quanta film = liquid.filmOf(grain);
        if (film == 0) return 0;
        Quanta count = 0, number = 0;
        liquid.forEachContactOf(grain, [&](Number other) {
            if (other == contact) number = count;
            if (draws(liquid, other)) ++count;
        });
        return portion(film, number + 1, count) - portion(film, number, count);
    }

    void form(Liquid& liquid, std::vector<Number>& looked) {
        unique(looked);
        drawing.clear(), drawn.clear();
        for (const Number grain : looked) {
            if (!isOwn(liquid, grain)) continue;
            // Without a film only a wet wall offers something that the other body has not offered before.
            const bool isDry = liquid.filmOf(grain) == 0;
            liquid.forEachContactOf(grain, [&](Number contact) {
                const bool mayForm =
                    !isDry || (liquid.isAtWall(contact) && liquid.rulesOf(contact).wallDose > 0);
                if (mayForm && draws(liquid, contact)) drawing.push_back(contact);
            });
        }
        unique(drawing);
        const auto partOf = [&](Number grain, Number contact) { return partOfFilm(liquid, grain, contact); };
        std::vector<Quanta> partsOfOthers(drawing.size());
        if constexpr (isOfRanks) {
            liquid.addDrawingOfOthers(drawing);
            unique(drawing);
            partsOfOthers = liquid.partsOfOthers(drawing, partOf);
        }
        for (std::size_t k = 0; k < drawing.size(); ++k) {
            const Number contact = drawing[k];
            const QuantisedRules& rules = liquid.rulesOf(contact);
            const auto part = [&](Number grain) {
                return isOwn(liquid, grain) ? partOf(grain, contact) : partsOfOthers[k];
            };
            const Quanta a = part(liquid.grainOf(contact, 0));
            const Quanta b = liquid.isAtWall(contact) ? rules.wallDose : part(liquid.grainOf(contact, 1));
            const Quanta sum = a + b, volume = std::min(sum, rules.largest);
            if (sum <= rules.least) continue;
            const Quanta first = portion(a, volume, sum);
            drawn.push_back({contact, first, volume - first});
        }
        looked.clear();
        // What is left of a film serves fewer contacts in the next step.
        const auto draw = [&](Number grain, Quanta volume) {
            if (!isOwn(liquid, grain)) return;
            liquid.addToFilm(grain, -volume);
            looked.push_back(grain);
        };
        for (const Draw& d : drawn) {
            draw(liquid.grainOf(d.contact, 0), d.first);
            if (liquid.isAtWall(d.contact)) liquid.addToWall(d.contact, -d.second);
            else draw(liquid.grainOf(d.contact, 1), d.second);
            liquid.setVolume(d.contact, d.first + d.second);
        }
        std::erase_if(looked, [&](Number grain) { return liquid.filmOf(grain) == 0; });
    }

    static void unique(std::vector<Number>& numbers) {
        std::ranges::sort(numbers);
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }

    std::vector<Pool> pools;
    std::vector<Offer> offers;
    std::vector<Receiver> receivers;
    std::vector<Number> drawing;
    std::vector<Draw> drawn;
};

}  // namespace pendular
