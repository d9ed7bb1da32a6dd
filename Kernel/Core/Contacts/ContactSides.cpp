#include "Kernel/Core/Contacts/ContactSides.h"

namespace pendular {

void ContactSides::sort(std::vector<Keyed>& keyed, std::uint32_t begin) {
    std::ranges::sort(keyed, {}, &Keyed::key);
    std::ranges::transform(keyed, sides.begin() + begin, &Keyed::side);
}

}  // namespace pendular
