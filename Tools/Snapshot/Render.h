#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"
#include "Tools/Snapshot/PovScene.h"

namespace pendular::snapshot {

/// Runs a program in a folder, without a shell; returns its exit code, or 127 if there is no such program.
/// The output of the program goes to a file of the folder.
inline int runQuietly(std::vector<std::string> words, const std::filesystem::path& folder, const char* log) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log, O_WRONLY | O_CREAT | O_EXCL, 0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    pid_t child = 0;
    const int problem = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (problem != 0 || waitpid(child, &status, 0) != child) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// A new folder beside a file, which is gone at the end, with what is in it.
class FolderBeside {
public:
    explicit FolderBeside(const std::filesystem::path& file) {
        std::string name = (file.parent_path() / ".snapshot-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw InputError(
                fmt::format("No files can be written beside {}: {}.", file.string(), std::strerror(errno)));
        place = name;
    }
    FolderBeside(const FolderBeside&) = delete;
    FolderBeside& operator=(const FolderBeside&) = delete;
    ~FolderBeside() {
        std::error_code ignored;
        std::filesystem::remove_all(place, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return place; }

private:
    std::filesystem::path place;
};

/// Renders NAME.pov to NAME.png, and removes what is not needed any more. POV-Ray reads a ; or a blank in a
/// name as the end of it, and follows links: it works in a folder of its own, with names without.
inline void render(const std::filesystem::path& scene, const std::filesystem::path& picture, int width,
                   int height) {
    const FolderBeside folder(scene);
    std::error_code problem;
    if (!std::filesystem::copy_file(scene, folder.path() / "scene.pov", problem))
        throw InputError(fmt::format("The file {} cannot be copied for POV-Ray to {}: {}.", scene.string(),
                                     folder.path().string(), problem.message()));
    const int code = runQuietly({"povray", "+Iscene.pov", "+Opicture.png", fmt::format("+W{}", width),
                                 fmt::format("+H{}", height), "+A0.1", "+AM2", "+R3", "-D", "+FN8", "-GA"},
                                folder.path(), "log");
    if (code == 127)
        throw InputError(fmt::format(
            "POV-Ray is not installed (Debian package povray); the scene for it is in {}.", scene.string()));
    if (code != 0) {
        const std::string log = scene.string() + ".log";
        renameFile(folder.path() / "log", log);
        throw InputError(fmt::format("POV-Ray failed on {}; what it said is in {}.", scene.string(), log));
    }
    renameFile(folder.path() / "picture.png", picture);
    std::filesystem::remove(scene, problem);
}

/// Writes what POV-Ray reads beside a picture, and renders it unless only that is wanted; returns the file
/// that there is then.
inline std::filesystem::path draw(const Picture& picture, const Camera& camera,
                                  const std::filesystem::path& target, int width, int height,
                                  bool sceneOnly) {
    std::filesystem::path scene = target;
    WrittenBeside out(scene.replace_extension(".pov"));
    out.write(PovScene(picture, camera).text());
    out.close();
    if (!sceneOnly) render(scene, target, width, height);
    return sceneOnly ? scene : target;
}

}  // namespace pendular::snapshot
