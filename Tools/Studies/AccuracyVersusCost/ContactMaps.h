#pragma once

#include <filesystem>

namespace pendular {

struct ContactMapOptions {
    std::filesystem::path folder = "contact-maps";
    int offsets = 16;  // starts of the touch within a step
};

/// Maps where contact laws fail: a table for each question. contact-maps.gp draws them.
void mapContacts(const ContactMapOptions& options);

}  // namespace pendular
