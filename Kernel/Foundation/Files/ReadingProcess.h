#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace pendular {

/// A child process (fork) that reads what others have written. A damaged file may end a library that reads it
/// by a signal, keep it busy for ever, or make it take any memory. Here that ends the child, and this program
/// has a sentence. What the child allocates is the child's: nothing of it stays in this program.
class ReadingProcess {
public:
    struct Limits {
        std::size_t memory;  // bytes, beyond what this program has when the child begins
        unsigned seconds;    // CPU time
    };

    /// One end of the connection between the two processes.
    class Channel {
    public:
        explicit Channel(int descriptor) : socket(descriptor) {}

        /// False: the other process has ended, or, received from a child, was silent for too long.
        [[nodiscard]] bool send(const void* bytes, std::size_t count) const;
        [[nodiscard]] bool receive(void* bytes, std::size_t count) const;
        /// A text with its length.
        [[nodiscard]] bool sendText(std::string_view text) const;
        /// @param most bytes; a longer text is none
        [[nodiscard]] bool receiveText(std::string& text, std::size_t most) const;

    private:
        int socket;
    };

    /// Starts the child. Throws InputError if the system allows no further process.
    /// @param work done in the child, which ends after it. It must take no lock that another thread of this
    /// program may hold, and start no threads.
    ReadingProcess(const Limits& most, const std::function<void(const Channel&)>& work);
    ReadingProcess(const ReadingProcess&) = delete;
    ReadingProcess& operator=(const ReadingProcess&) = delete;
    /// Ends the child.
    ~ReadingProcess();

    [[nodiscard]] const Channel& channel() const { return connection; }
    /// Once send() or receive() was false: what became of the child, "was ended by signal 11 (Segmentation
    /// fault)". Ends it if it only was silent.
    [[nodiscard]] const std::string& howItEnded();

    /// Whether memory is limited at all: under the sanitizers, which map terabytes of addresses, it is not.
    static bool limitsMemory();
    /// In the child: from now on so many bytes more than it has now, instead of Limits::memory.
    static void allowMemory(std::size_t bytes);

private:
    static constexpr unsigned shortestPatience = 120;  // s

    void closeChannel();
    /// s, after which this program waits no longer for the child: not before it could have had its CPU time.
    [[nodiscard]] unsigned longestSilence() const;

    Limits limits;
    int socket = -1;
    pid_t child = -1;  // -1: it has ended
    Channel connection{-1};
    std::string end;
};

}  // namespace pendular
