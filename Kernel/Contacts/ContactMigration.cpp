#include "Kernel/Contacts/ContactMigration.h"

#include <utility>

namespace pendular {

Luggage ContactMigration::luggage(std::size_t self) {
    return {.pack = [this, self](std::span<const std::size_t> owners,
                                 std::span<Message> toEach) { pack(self, owners, toEach); },
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
            memory.getNumbers(remembered.slotOf(k), numbers.data());
            toEach[last].add(entry);
            for (const double number : numbers) toEach[last].add(number);
            if (!memory.energies.empty()) toEach[last].add(memory.energies[remembered.slotOf(k)]);
        };
        sendWith(entry.owner);
        if (entry.wall == 0) sendWith(entry.other);
    }
}

void ContactMigration::unpack(Message& message) {
    std::vector<double> numbers(memory.numberCount());
    while (!message.isTaken()) {
        const auto entry = message.take<RememberedContacts::Entry>();
        for (double& number : numbers) message.take(number);
        remembered.add(entry, numbers, memory);
        if (memory.energies.empty()) continue;
        message.take(memory.energies[remembered.slotOf(static_cast<std::uint32_t>(remembered.size() - 1))]);
    }
}

}  // namespace pendular
