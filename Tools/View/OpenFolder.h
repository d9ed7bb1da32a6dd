#pragma once

#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::view {

// All files below the root of the server are opened by these classes: by the handle of their folder and their
// own name, one part of a path after the other, without following symbolic links (openat(2) with O_NOFOLLOW).
// A handle stays with its folder or file, whatever its name leads to later, so that a folder that is swapped
// for a link while it is read never yields anything from outside. No part is "..", so that openat2() with
// RESOLVE_BENEATH would add nothing.

/// A file descriptor, which is closed at the end.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int open) : number(open) {}
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number, other.number);
        return *this;
    }
    ~Descriptor();

    [[nodiscard]] bool isOpen() const { return number >= 0; }
    [[nodiscard]] int get() const { return number; }
    /// Whoever is given it closes it.
    [[nodiscard]] int release() { return std::exchange(number, -1); }
    /// A name that leads to what is open, in this process and its copies (proc(5)).
    [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", number); }

private:
    int number = -1;
};

/// A sentence in which a descriptor is called by the name that the user knows.
std::string withName(std::string sentence, const std::string& descriptor, const std::string& name);

/// Calls a function of the kernel, which takes a name, with that of a descriptor. Its sentences have the name
/// that the user knows.
template <class Use>
auto byDescriptor(const Descriptor& open, const std::filesystem::path& name, Use&& use) {
    try {
        return use(std::filesystem::path(open.path()));
    } catch (const InputError& problem) {
        throw InputError(withName(problem.what(), open.path(), name.string()));
    }
}

/// s since 1970, when a file or folder was changed.
double changedAt(const struct stat& status);

/// A regular file that is open for reading.
class OpenFile {
public:
    OpenFile(Descriptor opened, std::filesystem::path called)
        : file(std::move(opened)), name(std::move(called)) {}

    [[nodiscard]] const Descriptor& descriptor() const { return file; }
    [[nodiscard]] struct stat status() const;
    [[nodiscard]] std::uintmax_t size() const { return static_cast<std::uintmax_t>(status().st_size); }
    /// Bytes from a place on, fewer where the file ends.
    [[nodiscard]] std::string bytes(std::uintmax_t from, std::uintmax_t most) const;
    /// What a reader of the kernel makes of it.
    template <class Reader>
    auto readBy(Reader&& reader) const {
        return byDescriptor(file, name, std::forward<Reader>(reader));
    }

private:
    Descriptor file;
    std::filesystem::path name;
};

/// A folder that is open. Names are those of what is in it, never paths.
class OpenFolder {
public:
    /// The root, by its path. Throws InputError unless it is a folder that can be read.
    explicit OpenFolder(const std::filesystem::path& path);

    /// Where it was when it was opened: for sentences, and for programs that are started.
    [[nodiscard]] const std::filesystem::path& path() const { return place; }
    [[nodiscard]] const Descriptor& descriptor() const { return open; }

    /// A folder in it; nothing where there is none, or a link.
    [[nodiscard]] std::optional<OpenFolder> folder(const std::string& name) const;
    /// A new folder in it. Throws InputError where it cannot be made.
    [[nodiscard]] OpenFolder makeFolder(const std::string& name) const;
    void removeFolder(const std::string& name) const noexcept;
    /// A regular file in it; nothing where there is none, or a link.
    [[nodiscard]] std::optional<OpenFile> file(const std::string& name) const;
    [[nodiscard]] bool hasFile(const std::string& name) const;
    /// s since 1970, of a regular file; 0: there is none.
    [[nodiscard]] double changed(const std::string& name) const;
    /// Of what has the name, of a link itself; nothing where there is nothing.
    [[nodiscard]] std::optional<struct stat> status(const std::string& name) const;
    /// Whether the name leads to what is open.
    [[nodiscard]] bool isAt(const std::string& name, const Descriptor& file) const;
    /// Of the folder itself.
    [[nodiscard]] struct stat status() const;

    enum class Kind { Folder, File };
    /// Calls a function with all folders and regular files in it, in no order, until it returns false.
    void forEach(const std::function<bool(const std::string& name, Kind kind)>& use) const;
    /// The names of the regular files in it, in no order.
    void forEachFile(const std::function<void(const std::string& name)>& use) const;

    /// What a reader of the kernel makes of a file. A file that was replaced meanwhile, as a run replaces its
    /// lists of frames, is read again. Throws InputError where there is none, as well as the reader's.
    template <class Reader>
    auto read(const std::string& name, Reader&& reader) const {
        for (int tries = 1;; ++tries) {
            const std::optional<OpenFile> file = this->file(name);
            if (!file) refuse(name, "is not there, or is no regular file");
            try {
                return file->readBy(reader);
            } catch (const InputError&) {
                if (tries == 3 || !hasFile(name) || isAt(name, file->descriptor())) throw;
            }
        }
    }

    /// Writes a file: as NAME.part, which is then renamed. Throws InputError where that fails; the file of
    /// before is kept then.
    void write(const std::string& name, std::string_view text) const;
    /// Opens a regular file to add to it; it is made where there is none. Throws InputError.
    [[nodiscard]] Descriptor append(const std::string& name) const;
    void remove(const std::string& name) const noexcept;

    /// Throws InputError: "The file FOLDER/NAME WHAT.", with the reason of the system where it is given.
    [[noreturn]] void refuse(const std::string& name, std::string_view what, int reason = 0) const;

private:
    OpenFolder(Descriptor opened, std::filesystem::path at) : open(std::move(opened)), place(std::move(at)) {}

    Descriptor open;
    std::filesystem::path place;
};

}  // namespace pendular::view
