#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

namespace pendular {

/// A run that was asked to end before its time. Its files are complete. what() is a sentence for the user.
struct RunStopped : std::runtime_error {
    RunStopped(const std::string& sentence, int code) : std::runtime_error(sentence), exitCode(code) {}
    int exitCode;  // of the program, as shells give it: 128 + the number of the signal
};

/// The times at which a run writes restart files.
struct RestartSchedule {
    bool kept = false;
    std::size_t count = 0;  // steps from one restart file to the next; 0: none for the steps
    double interval = 0;    // s of the clock on the wall from one to the next; 0: none for the time

    friend bool operator==(const RestartSchedule&, const RestartSchedule&) = default;
};

/// Ends whatever run this program is in, as SIGTERM does, when the program has run for this time (s of the
/// clock on the wall).
void setWallTimeLimit(double seconds);

/// From now on SIGUSR1 is heard also outside of a run, which it would end by default: the next run writes the
/// restart file at its start. A program that ignores it goes on to do so. One that was started with it
/// blocked (env --block-signal=USR1 PROGRAM) takes it from now on, and with it what has been sent before:
/// while the system loads a program, nothing in that can hear a signal.
void hearRestartSignal();

/// From now on a log that goes into a pipe whose reader has gone does not end the program (SIGPIPE): what is
/// written there fails. A program that handles the signal goes on to do so.
void ignoreClosedPipes();

/// SIGUSR1 does again what it did before hearRestartSignal().
void forgetRestartSignal();

/// Listens, for as long as it lives, to what is asked of a run from outside. SIGINT, SIGTERM and the limit of
/// wall time end the run after the step, the first two at once when one of them comes again a second later or
/// more; SIGUSR1 writes a restart file and goes on. In a program of somebody else (setHosted()) signals are
/// left to that.
class RunControl {
public:
    enum class Request { None, WriteRestart, Stop };
    /// What was heard: nothing, that the user may be shown how far the run is, that a restart file is asked
    /// for, that the time is over or requestStop() was called, or a signal that ends the run, whose number is
    /// added. The larger one goes before the others.
    enum Heard : int { Nothing, Show, Restart, OutOfTime, StopCall, Signal };

    explicit RunControl(const RestartSchedule& given = {});
    ~RunControl();
    RunControl(const RunControl&) = delete;
    RunControl& operator=(const RunControl&) = delete;

    /// Follows this schedule from now on, and by the limit of wall time as it is now.
    void follow(const RestartSchedule& given);
    [[nodiscard]] const RestartSchedule& schedule() const { return restarts; }

    /// What has been heard when so many steps have been done. Costs two loads; looks at the clock, where
    /// there is a limit, some twenty times a second.
    [[nodiscard]] int heard(std::size_t steps);
    /// The request that holds when so many steps have been done and this was heard, here or on another rank;
    /// asked again at the same step, it writes no file for the count of steps.
    [[nodiscard]] Request request(std::size_t steps, int heard);
    [[nodiscard]] Request request(std::size_t steps) { return request(steps, heard(steps)); }

    /// The exception that ends a run which was asked to stop.
    /// @param time s; @param restartFile empty: none is kept; @param heard what has stopped it
    [[nodiscard]] static RunStopped stopped(double time, std::size_t steps, const std::string& restartFile,
                                            int heard);

private:
    using Clock = std::chrono::steady_clock;

    void lookAtClock(std::size_t steps);

    RestartSchedule restarts;
    bool listens;  // to signals
    bool outOfTime = false, restartDue = false;
    std::size_t nextLook = 0;             // steps
    std::optional<std::size_t> counted;   // steps for which the count was looked at
    std::optional<std::size_t> lastLook;  // steps; a run that goes on does not begin at 0
    Clock::time_point lastLooked = Clock::now(), lastRestart = lastLooked;
};

}  // namespace pendular
