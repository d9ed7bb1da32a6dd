#pragma once

#include <filesystem>
#include <string_view>

namespace pendular {

class ContactLaws;
class ContactSystem;
class ParticleStore;

/// The grains of a scene as a table, a row each in the order of their identities; the force is the sum of the
/// contacts and the weight.
/// @param remark a line before the rows
void writeGrains(const std::filesystem::path& path, const ParticleStore& grains, const ContactLaws& laws,
                 std::string_view remark);

/// The contacts that have a force, as a table; particle2 is -1 at a wall, and wall is -1 between grains.
/// Forces are those computed last; x, y, z is the contact point.
void writeContacts(const std::filesystem::path& path, const ContactSystem& contacts,
                   const ParticleStore& grains, std::string_view remark);

}  // namespace pendular
