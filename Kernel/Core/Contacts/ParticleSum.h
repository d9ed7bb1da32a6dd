#pragma once

#include <bit>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ForceTotals.h"

namespace pendular {

/// The sum over the contacts of the grain at a place, in the order of its partners: the same bits for any
/// number of threads. Contacts with memory that do not act at the moment add zeros, which is cheaper than to
/// ask. A record with torque is one Pack, weighted by the side's sign for the force and by the grain's lever
/// arm for the torque. A call: it is rare, and inlined it would take the registers of the end of a step.
/// @param radius of the grain, m
template <bool hasTorque, bool hasContactTorque>
[[gnu::noinline]] ForceAndTorque<hasTorque> sumInOrder(const ContactStore& store, std::size_t grain,
                                                       double radius) {
    static constexpr std::array<double, 2> signs{1, -1};  // on body 1, on body 2
    if constexpr (hasTorque) {
        const Mask torquePart = maskFromBits(0b01110000);
        Pack sum = 0;
        for (const std::uint32_t side : store.sidesOf(grain)) {
            const ForceTorqueRecord record = store.memory.records[side / 2];
            const Pack weight = select(torquePart, Pack(radius - record.halfOverlap), Pack(signs[side & 1]));
            sum = fma(Pack::load(&record.force.x), weight, sum);
        }
        auto result = std::bit_cast<ForceAndTorque<true>>(sum.toLanes());
        if constexpr (hasContactTorque)
            for (const std::uint32_t side : store.sidesOf(grain))
                result.torque += signs[side & 1] * loadFour(store.memory.torques[side / 2].torque);
        return result;
    } else {
        ForceAndTorque<false> sum;
        for (const std::uint32_t side : store.sidesOf(grain))
            sum.force += signs[side & 1] * loadFour(store.memory.forces[side / 2].force);
        return sum;
    }
}

/// The force (and torque) of a contact on one of its bodies, in quanta.
template <bool hasTorque, bool hasContactTorque>
class QuantaOfContact {
public:
    QuantaOfContact(const ContactStore& contacts, double grainRadius)
        : store(contacts),
          radius(grainRadius),
          perNewton(contacts.totals.quantum.perNewton(grainRadius)),
          quanta(
              select(forcePart(), Pack(perNewton),
                     select(torquePart(), Pack(ForceQuantum::perNewtonMetre(radius, perNewton)), Pack(0)))) {}

    [[nodiscard]] bool fits(std::size_t slot) const {
        if constexpr (hasTorque) return ForceQuantum::fits(store.memory.records.force(slot), perNewton);
        else return ForceQuantum::fits(store.memory.forces[slot].force, perNewton);
    }
    /// @param sign 1 on body 1, -1 on body 2
    [[nodiscard]] std::array<std::int64_t, Pack::lanes> of(std::size_t slot, double sign) const {
        if constexpr (hasTorque) {
            const ForceTorqueRecord record = store.memory.records[slot];
            const Pack weight = select(torquePart(), Pack(radius - record.halfOverlap), Pack(sign));
            Pack own = 0;
            if constexpr (hasContactTorque) {
                const Vector<double> couple = sign * store.memory.torques[slot].torque;
                own = Pack::fromLanes({0, 0, 0, 0, couple.x, couple.y, couple.z, 0});
            }
            return nearestIntegers(quanta * fma(Pack::load(&record.force.x), weight, own));
        } else {
            const Vector<double> force = sign * store.memory.forces[slot].force;
            return nearestIntegers(quanta * Pack::fromLanes({force.x, force.y, force.z, 0, 0, 0, 0, 0}));
        }
    }

private:
    static Mask forcePart() { return maskFromBits(0b00000111); }
    static Mask torquePart() { return maskFromBits(0b01110000); }

    const ContactStore& store;
    double radius, perNewton;
    Pack quanta;
};

/// The sum in quanta, as the kernel adds them to the totals; in order where a force does not fit.
template <bool hasTorque, bool hasContactTorque>
[[gnu::noinline]] ForceAndTorque<hasTorque> sumQuanta(const ContactStore& store, std::size_t grain,
                                                      double radius) {
    const QuantaOfContact<hasTorque, hasContactTorque> quanta(store, radius);
    std::array<std::int64_t, Pack::lanes> sum{};
    for (const std::uint32_t side : store.sidesOf(grain)) {
        if (!quanta.fits(side / 2)) return sumInOrder<hasTorque, hasContactTorque>(store, grain, radius);
        const auto own = quanta.of(side / 2, (side & 1) == 0 ? 1 : -1);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += own[k];
    }
    return store.totals.taker().inNewtons<hasTorque>(std::bit_cast<ForceTotal>(sum), radius);
}

/// The sums at the end of a step, of one grain after the other. What they read for each grain lies in here,
/// as a Taker has it.
template <bool hasTorque, bool hasContactTorque>
class SumTaker {
public:
    explicit SumTaker(const ContactStore& contacts)
        : store(contacts),
          sides(contacts.sides.awake()),
          totals(contacts.totals.taker()),
          keepsTotals(contacts.keepsTotals) {}

    /// Leaves the total of the grain at zero.
    /// @param radius of the grain, m
    [[gnu::always_inline]] ForceAndTorque<hasTorque> take(std::size_t grain, double radius) const {
        // Nothing has been added to the total of a grain without contacts.
        if (!sides.any(grain)) return {};
        if (keepsTotals) [[likely]] {
            ForceTotal total = totals.take(grain);
            if (total.fits()) [[likely]]
                return totals.template inNewtons<hasTorque>(total, radius);
        }
        return sumInOrder<hasTorque, hasContactTorque>(store, grain, radius);
    }

private:
    const ContactStore& store;
    ContactSides::Awake sides;
    ForceTotals::Taker totals;
    bool keepsTotals;
};

/// The sum of the records at any time, whatever is kept of a contact: N, and N m about the grain's centre.
struct ContactSum {
    Vector<double> force, torque;
};
inline ContactSum contactSum(const ContactStore& store, std::size_t grain, double radius) {
    const auto sum = [&]<bool hasTorque, bool hasContactTorque>() -> ContactSum {
        const auto found = store.keepsTotals ? sumQuanta<hasTorque, hasContactTorque>(store, grain, radius)
                                             : sumInOrder<hasTorque, hasContactTorque>(store, grain, radius);
        if constexpr (hasTorque) return {vectorOf(found.force), vectorOf(found.torque)};
        else return {vectorOf(found.force), {0, 0, 0}};
    };
    const ContactLayout& layout = store.memory.getLayout();
    return !layout.hasTorque         ? sum.template operator()<false, false>()
           : layout.hasContactTorque ? sum.template operator()<true, true>()
                                     : sum.template operator()<true, false>();
}

}  // namespace pendular
