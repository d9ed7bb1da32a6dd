#include "Tools/View/OpenFolder.h"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace pendular::view {

namespace {

constexpr int folderFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
// O_NONBLOCK: the name may lead to a pipe by now, in which who opens it would wait for the other end.
constexpr int fileFlags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

bool isName(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == name.npos &&
           name.find('\0') == name.npos;
}

int closeList(DIR* list) { return list ? closedir(list) : 0; }

bool writeAll(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t bytes = ::write(descriptor, text.data(), text.size());
        if (bytes < 0 && errno == EINTR) continue;
        if (bytes <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(bytes));
    }
    return true;
}

}  // namespace

Descriptor::~Descriptor() {
    if (number >= 0) close(number);
}

std::string withName(std::string sentence, const std::string& descriptor, const std::string& name) {
    for (std::size_t at = 0; (at = sentence.find(descriptor, at)) != sentence.npos;) {
        const std::size_t end = at + descriptor.size();
        if (end < sentence.size() && std::isdigit(static_cast<unsigned char>(sentence[end]))) at = end;
        else sentence.replace(at, descriptor.size(), name), at += name.size();
    }
    return sentence;
}

double changedAt(const struct stat& status) {
    return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

struct stat OpenFile::status() const {
    struct stat found {};
    static_cast<void>(fstat(file.get(), &found));
    return found;
}

std::string OpenFile::bytes(std::uintmax_t from, std::uintmax_t most) const {
    const std::uintmax_t there = size();
    std::string text(from < there ? std::min(most, there - from) : 0, '\0');
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t more =
            pread(file.get(), text.data() + done, text.size() - done, static_cast<off_t>(from + done));
        if (more < 0 && errno == EINTR) continue;
        if (more <= 0) break;
        done += static_cast<std::size_t>(more);
    }
    text.resize(done);
    return text;
}

OpenFolder::OpenFolder(const std::filesystem::path& path)
    : open(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)), place(path) {
    if (!open.isOpen())
        throw InputError(fmt::format("The folder {} cannot be read: {}; give one with the folders of runs.",
                                     path.string(), std::strerror(errno)));
}

std::optional<OpenFolder> OpenFolder::folder(const std::string& name) const {
    if (!isName(name)) return {};
    Descriptor found(openat(open.get(), name.c_str(), folderFlags));
    if (!found.isOpen()) return {};
    return OpenFolder(std::move(found), place / name);
}

OpenFolder OpenFolder::makeFolder(const std::string& name) const {
    const auto fail = [&](int reason) {
        throw InputError(fmt::format("The folder {} cannot be made: {}.", name, std::strerror(reason)));
    };
    if (!isName(name)) fail(EINVAL);
    if (mkdirat(open.get(), name.c_str(), 0777) != 0) fail(errno);
    auto made = folder(name);
    if (!made) fail(errno);
    return std::move(*made);
}

void OpenFolder::removeFolder(const std::string& name) const noexcept {
    if (isName(name)) unlinkat(open.get(), name.c_str(), AT_REMOVEDIR);
}

std::optional<OpenFile> OpenFolder::file(const std::string& name) const {
    if (!hasFile(name)) return {};  // before it is opened: to open a device may do something
    Descriptor found(openat(open.get(), name.c_str(), fileFlags));
    struct stat status {};
    if (!found.isOpen() || fstat(found.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    return OpenFile(std::move(found), place / name);
}

bool OpenFolder::hasFile(const std::string& name) const {
    const auto found = status(name);
    return found && S_ISREG(found->st_mode);
}

double OpenFolder::changed(const std::string& name) const {
    const auto found = status(name);
    return found && S_ISREG(found->st_mode) ? changedAt(*found) : 0;
}

std::optional<struct stat> OpenFolder::status(const std::string& name) const {
    struct stat found {};
    if (!isName(name) || fstatat(open.get(), name.c_str(), &found, AT_SYMLINK_NOFOLLOW) != 0) return {};
    return found;
}

struct stat OpenFolder::status() const {
    struct stat found {};
    static_cast<void>(fstat(open.get(), &found));
    return found;
}

void OpenFolder::forEach(const std::function<bool(const std::string& name, Kind kind)>& use) const {
    // A handle of its own has a place of its own in the list of names.
    Descriptor own(openat(open.get(), ".", folderFlags));
    const std::unique_ptr<DIR, int (*)(DIR*)> list(own.isOpen() ? fdopendir(own.get()) : nullptr, closeList);
    if (!list) return;
    static_cast<void>(own.release());  // it is the list's
    while (const dirent* const entry = readdir(list.get())) {
        const std::string name = entry->d_name;
        mode_t type = DTTOIF(entry->d_type);
        if (entry->d_type == DT_UNKNOWN)
            if (const auto found = status(name)) type = found->st_mode;
        const bool isFolder = S_ISDIR(type);
        if (!isName(name) || (!isFolder && !S_ISREG(type))) continue;
        if (!use(name, isFolder ? Kind::Folder : Kind::File)) return;
    }
}

void OpenFolder::forEachFile(const std::function<void(const std::string& name)>& use) const {
    forEach([&](const std::string& name, Kind kind) {
        if (kind == Kind::File) use(name);
        return true;
    });
}

bool OpenFolder::isAt(const std::string& name, const Descriptor& file) const {
    const auto there = status(name);
    struct stat here {};
    return there && fstat(file.get(), &here) == 0 && here.st_ino == there->st_ino &&
           here.st_dev == there->st_dev;
}

void OpenFolder::write(const std::string& name, std::string_view text) const {
    const std::string part = name + ".part";
    unlinkat(open.get(), part.c_str(), 0);  // left by one that was killed
    const Descriptor file(
        openat(open.get(), part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    const bool isWritten = file.isOpen() && writeAll(file.get(), text) &&
                           (fsync(file.get()) == 0 || errno == EINVAL) &&
                           renameat(open.get(), part.c_str(), open.get(), name.c_str()) == 0;
    if (isWritten) return;
    const int reason = errno;
    unlinkat(open.get(), part.c_str(), 0);
    refuse(name, "cannot be written", reason);
}

Descriptor OpenFolder::append(const std::string& name) const {
    if (const auto there = status(name); there && !S_ISREG(there->st_mode))
        refuse(name, "is not a regular file: remove it");
    Descriptor file(openat(open.get(), name.c_str(),
                           O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0644));
    if (!file.isOpen()) refuse(name, "cannot be written", errno);
    return file;
}

void OpenFolder::remove(const std::string& name) const noexcept {
    if (isName(name)) unlinkat(open.get(), name.c_str(), 0);
}

void OpenFolder::refuse(const std::string& name, std::string_view what, int reason) const {
    throw InputError(fmt::format("The file {} {}{}{}.", (place / name).string(), what,
                                 reason == 0 ? "" : ": ", reason == 0 ? "" : std::strerror(reason)));
}

}  // namespace pendular::view
