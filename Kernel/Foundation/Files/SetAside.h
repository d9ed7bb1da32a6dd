#pragma once

#include <filesystem>
#include <vector>

namespace pendular {

/// Files that are about to be replaced, set aside as NAME.before. Where what replaces them fails, they get
/// their names again; where the process is killed meanwhile, they are still there under the other one.
class SetAside {
public:
    /// Files that are not there are left out. Throws InputError where there is something else than a regular
    /// file, or where one cannot be renamed.
    explicit SetAside(std::vector<std::filesystem::path> paths);
    SetAside(const SetAside&) = delete;
    SetAside& operator=(const SetAside&) = delete;
    /// Gives the files their names again, except where there is a new one.
    ~SetAside();

    /// They have been replaced: removes them.
    void remove() noexcept;

private:
    void putBack() noexcept;

    std::vector<std::filesystem::path> files;
    bool areSet = true;
};

}  // namespace pendular
