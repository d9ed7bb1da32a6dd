#include "Kernel/Analysis/Output/FrameFile.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"

namespace pendular {

void FrameFile::begin(const std::string& beginning, bool goesOn) {
    waiting.clear();
    if (file) return;
    path = beginning + ending;
    open(goesOn);
}

void FrameFile::open(bool goesOn) {
    std::error_code ignored;
    if (goesOn && kept) cutBack(path, *kept);
    std::FILE* opened = goesOn ? goOnWithFile(path) : createFile(path);
    if (!opened) fail();
    file.reset(opened, std::fclose);
    if (std::filesystem::file_size(path, ignored) == 0) text(header);
}

void FrameFile::write() {
    if (std::fwrite(waiting.data(), 1, waiting.size(), file.get()) != waiting.size()) fail();
    waiting.clear();
}

void FrameFile::finish() {
    write();
    if (std::fflush(file.get()) != 0) fail();
}

void FrameFile::fail() const {
    throw InputError(fmt::format("The file {} cannot be written: {}.", path, std::strerror(errno)));
}

void FrameFile::visitState(StateArchive& archive, const std::string& beginning) {
    const std::string entry = std::filesystem::path(beginning + ending).filename().string() + "-bytes";
    if (archive.isWriting() && file) {
        if (fsync(fileno(file.get())) != 0 && errno != EINVAL) fail();
        kept = sizeOf(path);
    } else if (archive.isReading() && archive.holds(entry)) {
        kept = 0;
    }
    if (kept) archive.value(entry, *kept);
}

}  // namespace pendular
