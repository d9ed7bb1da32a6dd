#include "Kernel/Core/Run/Program.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Run/RunControl.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Files/FileFault.h"

namespace pendular {

namespace {

/// Where a program was started with standard input, output or error closed, the next file that it opens would
/// get that number, and what is printed would be written into it.
void openClosedStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            // The lowest number that is free: this one.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY));
}

std::atomic<bool> hadScene{false};

/// Whether this code is part of the program itself, not of a library that it has loaded.
bool isInProgram() {
    Dl_info here{}, program{};
    return dladdr(&hadScene, &here) != 0 &&
           dladdr(reinterpret_cast<const void*>(getauxval(AT_PHDR)), &program) != 0 &&
           here.dli_fbase == program.dli_fbase;
}

/// Called before main(), and so before the command line is read.
const bool isPrepared = [] {
    if (isHosted() || !isInProgram()) return false;
    openClosedStreams();
    hearRestartSignal();
    silenceOtherRanks();
    return true;
}();

constexpr int brokenPipe = 128 + SIGPIPE;  // as a shell gives it of a program that SIGPIPE has ended

/// Says it in the log, and to other ranks.
void tellAll(const std::string& sentence) {
    writeToLog("Error: " + sentence + "\n");
    failOnRanks(sentence);
}

/// Returns the exit code that goes with it.
int printCurrentException() {
    try {
        throw;
    } catch (const RunStopped& stop) {
        writeToLog(std::string(stop.what()) + "\n");
        return stop.exitCode;
    } catch (const std::system_error& problem) {
        // Who reads the results has gone (PROGRAM | head): nobody is there to be told.
        if (problem.code() == std::error_code(EPIPE, std::generic_category())) return brokenPipe;
        tellAll(sentenceOf(problem));
    } catch (const std::exception& problem) {
        tellAll(sentenceOf(problem));
    } catch (...) {
        tellAll("of an unknown kind.");
    }
    return EXIT_FAILURE;
}

/// Results that were printed, and are not where they were to go, are an error.
void requirePrinted() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    const int reason = errno != 0 ? errno : EIO;
    if (reason == EPIPE) throw std::system_error(reason, std::generic_category());
    throw RunError(fmt::format("Standard output cannot be written: {}.", std::strerror(reason)));
}

}  // namespace

int runProgram(const std::function<int()>& body) {
    hearRestartSignal();
    ignoreClosedPipes();
    try {
        const int code = body();
        requirePrinted();
        return code;
    } catch (...) {
        return printCurrentException();
    }
}

void setHosted() {
    if (isHosted()) return;
    if (hadScene)
        throw InputError(
            "setHosted(): there has been a scene already, which has set the signals and the end of the "
            "program; "
            "call it before the first one.");
    markAsHosted();
    forgetRestartSignal();
}

void prepareProgram() {
    hadScene = true;
    if (isHosted()) return;
    reportUncaughtExceptions();
    hearRestartSignal();
}

void reportUncaughtExceptions() {
    std::set_terminate([] {
        if (!std::current_exception()) std::abort();
        const int code = endRanks(printCurrentException());
        std::fflush(nullptr);
        std::_Exit(code);
    });
}

}  // namespace pendular
