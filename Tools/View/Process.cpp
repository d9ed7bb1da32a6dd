#include "Tools/View/Process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstring>

#include "Kernel/Foundation/Base/InputError.h"

extern char** environ;

namespace pendular::view {

namespace {

/// How posix_spawn() starts a process here.
class Spawn {
public:
    Spawn() {
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&how);
        posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
        sigset_t none;  // what the server blocks, its children hear
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&how, &none);
        posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    }
    Spawn(const Spawn&) = delete;
    Spawn& operator=(const Spawn&) = delete;
    ~Spawn() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&how);
    }

    /// The process, or 0, and why.
    pid_t run(const std::filesystem::path& program, const std::vector<std::string>& arguments, int& problem) {
        std::vector<std::string> words{program.string()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        pid_t process = 0;
        problem = posix_spawn(&process, program.c_str(), &files, &how, argv.data(), environ);
        return problem ? 0 : process;
    }

    posix_spawn_file_actions_t files{};

private:
    posix_spawnattr_t how{};
};

/// Reads to the end, or until the time is over.
std::string readAll(int end, std::chrono::steady_clock::time_point until) {
    std::string text;
    std::array<char, 4096> buffer{};
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
        pollfd ready{end, POLLIN, 0};
        if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) <= 0) return {};
        const ssize_t bytes = read(end, buffer.data(), buffer.size());
        if (bytes <= 0) return text;
        text.append(buffer.data(), static_cast<std::size_t>(bytes));
        if (text.size() > (1u << 20)) return {};
    }
}

}  // namespace

pid_t startProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const Descriptor& folder, const Descriptor& output) {
    Spawn spawn;
    posix_spawn_file_actions_addfchdir_np(&spawn.files, folder.get());
    posix_spawn_file_actions_adddup2(&spawn.files, output.get(), 1);
    posix_spawn_file_actions_adddup2(&spawn.files, 1, 2);
    int problem = 0;
    // The folder changes before the program is found.
    const pid_t process = spawn.run(std::filesystem::absolute(program), arguments, problem);
    if (process == 0)
        throw InputError(fmt::format("view: {} cannot be started: {}.", program.filename().string(),
                                     std::strerror(problem)));
    return process;
}

std::string outputOf(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    std::array<int, 2> pipe{};
    if (pipe2(pipe.data(), O_CLOEXEC) != 0) return {};
    Spawn spawn;
    posix_spawn_file_actions_adddup2(&spawn.files, pipe[1], 1);
    posix_spawn_file_actions_addopen(&spawn.files, 2, "/dev/null", O_WRONLY, 0);
    int problem = 0, status = 1;
    const pid_t process = spawn.run(program, arguments, problem);
    close(pipe[1]);
    const std::string text =
        process == 0 ? "" : readAll(pipe[0], std::chrono::steady_clock::now() + std::chrono::seconds(10));
    close(pipe[0]);
    if (process == 0) return {};
    if (text.empty()) kill(process, SIGKILL);
    waitpid(process, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "";
}

}  // namespace pendular::view
