#include "Kernel/Features/DomainDecomposition/ContactMigration.h"

#include <utility>

namespace pendular {

Luggage ContactMigration::luggage(std::size_t self) {
    return {.weightOf =
                [this](std::uint32_t place) { return 1 + static_cast<double>(remembered.countAt(place)); },
            .pack = [this, self](std::span<const std::size_t> owners,
                                 std::span<Message> toEach) { pack(self, owners, toEach); },
            .packAll = [this](Message& message) { packAll(message); },
            .unpack = [this](Message& message) { unpack(message); }};
}

void ContactMigration::pack(std::size_t self, std::span<const std::size_t> owners,
                            std::span<Message> toEach) const {
    std::vector<double> numbers(memory.numberCount());
    remembered.noteCounted(grains);
    for (std::uint32_t k = 0; k < remembered.size(); ++k) {
        const RememberedContacts::Entry& entry = remembered.entry(k);
        std::size_t last = self;  // the rank that has got it
        const auto sendWith = [&](std::uint32_t identity) {
            const std::uint32_t place = grains.place[identity];
            if (place == PlaceIndex::none || owners[place] == self || owners[place] == last) return;
            last = owners[place];
            add(toEach[last], entry, remembered.slotOf(k), numbers);
        };
        sendWith(entry.owner);
        if (entry.wall == 0) sendWith(entry.other);
    }
}

void ContactMigration::packAll(Message& message) const {
    std::vector<double> numbers(memory.numberCount());
    remembered.noteCounted(grains);
    for (std::uint32_t k = 0; k < remembered.size(); ++k) {
        const RememberedContacts::Entry& entry = remembered.entry(k);
        if (grains.place.contains(entry.owner)) add(message, entry, remembered.slotOf(k), numbers);
    }
}

void ContactMigration::add(Message& message, const RememberedContacts::Entry& entry, std::uint32_t slot,
                           std::vector<double>& numbers) const {
    memory.getNumbers(slot, numbers.data());
    message.add(entry);
    for (const double number : numbers) message.add(number);
    if (!memory.energies.empty()) message.add(std::as_const(memory.energies)[slot]);
}

void ContactMigration::unpack(Message& message) {
    std::vector<double> numbers(memory.numberCount());
    while (!message.isTaken()) {
        const auto entry = message.take<RememberedContacts::Entry>();
        for (double& number : numbers) message.take(number);
        remembered.add(entry, numbers, memory);
        if (memory.energies.empty()) continue;
        memory.energies.put(remembered.slotOf(static_cast<std::uint32_t>(remembered.size() - 1)),
                            message.take<EnergyRecord>());
    }
}

}  // namespace pendular
