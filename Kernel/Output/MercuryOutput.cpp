#include "Kernel/Output/MercuryOutput.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace pendular {

FrameFile::FrameFile(std::string given, bool goesOn) : path(std::move(given)) {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
    if (std::FILE* opened = std::fopen(path.c_str(), goesOn ? "ab" : "wb")) file.reset(opened, std::fclose);
    else throw InputError(fmt::format("The file {} cannot be written: {}.", path, std::strerror(errno)));
}

void FrameFile::add(std::string_view frame) {
    if (std::fwrite(frame.data(), 1, frame.size(), file.get()) != frame.size() ||
        std::fflush(file.get()) != 0)
        throw InputError(fmt::format("The file {} cannot be written: {}.", path, std::strerror(errno)));
}

void MercuryOutput::open(const std::string& standardName, bool goesOn) {
    const std::string beginning = name.empty() ? standardName : name;
    data.emplace(beginning + ".data", goesOn);
    if (contactsToo) contacts.emplace(beginning + ".fstat", goesOn);
    if (!energiesToo) return;
    energies.emplace(beginning + ".ene", goesOn);
    if (!goesOn) energies->add("time ene_gra ene_kin ene_rot ene_ela X_COM Y_COM Z_COM\n");
}

}  // namespace pendular
