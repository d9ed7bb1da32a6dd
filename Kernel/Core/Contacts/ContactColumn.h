#pragma once

#include <cstddef>

namespace pendular {

struct ObservedContact;
class ContactSystem;

/// A column of numbers, one for each contact that acts, by the contact as it was observed in this step:
/// for (const ObservedContact& contact : interactions()) age[contact] += getTimeStep().
class ContactColumnReference {
public:
    ContactColumnReference(ContactSystem& system, std::size_t column) : contacts(&system), number(column) {}

    /// Throws InputError where contacts have been listed again since the contact was observed.
    [[nodiscard]] double& operator[](const ObservedContact& contact) const;

private:
    ContactSystem* contacts;
    std::size_t number;
};

}  // namespace pendular
