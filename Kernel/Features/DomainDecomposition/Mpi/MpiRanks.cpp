/// Ranks that are processes of MPI-3.1. This file is a module of its own, which the kernel loads where
/// mpirun or srun has started several processes: the kernel and all programs need no MPI.

// The bindings of C alone.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <thread>

#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Base/Stopwatch.h"

namespace pendular {

namespace {

/// So long (s) a rank that has failed waits for the first one to say so, and one for another that has ended.
constexpr double patience = 30;
/// After so long (s) a rank that waits tells another one what it waits for.
constexpr double silence = 2;

/// The bytes of a message that MPI, which counts them by an int, sends at once; longer ones go in parts. The
/// environment variable is for tests.
std::size_t largestPart() {
    const char* const chosen = std::getenv("PENDULAR_MPI_PART_BYTES");
    const std::size_t bytes = chosen ? std::strtoul(chosen, nullptr, 10) : 0;
    return bytes > 0 ? std::min(bytes, std::size_t{1} << 30) : std::size_t{1} << 30;
}

void require(int result) {
    if (result != MPI_SUCCESS) throw AnotherRankFailed("MPI has failed.");
}

/// What all ranks ask for together.
enum class Call : std::int64_t { Swap, SwapWithNeighbours, Largest, AddUp };

/// A call that a rank waits in. All ranks make the same calls in the same order.
struct Waiting {
    std::int64_t number = 0;
    Call call = Call::Swap;
};

class MpiRanks final : public ProcessRanks {
public:
    MpiRanks() {
        int threads = 0, number = 0, all = 1;
        // Only the thread that does the steps sends.
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &threads);
        MPI_Comm_dup(MPI_COMM_WORLD, &work);
        MPI_Comm_dup(MPI_COMM_WORLD, &reductions);
        MPI_Comm_dup(MPI_COMM_WORLD, &additions);
        MPI_Comm_dup(MPI_COMM_WORLD, &failures);
        MPI_Comm_set_errhandler(work, MPI_ERRORS_RETURN);
        MPI_Comm_set_errhandler(reductions, MPI_ERRORS_RETURN);
        MPI_Comm_set_errhandler(additions, MPI_ERRORS_RETURN);
        MPI_Comm_set_errhandler(failures, MPI_ERRORS_RETURN);
        MPI_Comm_rank(work, &number);
        MPI_Comm_size(work, &all);
        own = static_cast<std::size_t>(number);
        ranks = static_cast<std::size_t>(all);
        if (ranksOfMachine() > sysconf(_SC_NPROCESSORS_ONLN)) keptTries = 100;
    }

    [[nodiscard]] std::size_t rank() const override { return own; }
    [[nodiscard]] std::size_t count() const override { return ranks; }

    // NOLINTNEXTLINE(bugprone-exception-escape): it exchanges messages, not what two names stand for
    [[nodiscard]] std::vector<Message> swap(std::vector<Message> toEach) override {
        begin(Call::Swap);
        lengthsTo.resize(ranks), lengthsFrom.resize(ranks);
        for (std::size_t q = 0; q < ranks; ++q) lengthsTo[q] = static_cast<std::int64_t>(toEach[q].size());
        wait([&](MPI_Request* request) {
            return MPI_Ialltoall(lengthsTo.data(), 1, MPI_INT64_T, lengthsFrom.data(), 1, MPI_INT64_T, work,
                                 request);
        });
        std::vector<Message> fromEach =
            sendAndTake(std::move(toEach), {lengthsFrom.begin(), lengthsFrom.end()});
        sent.clear();  // it may be the whole scene
        return fromEach;
    }

    [[nodiscard]] std::vector<Message> swapWithNeighbours(
        std::vector<Message> toEach, const std::vector<std::size_t>& bytesFromEach) override {
        begin(Call::SwapWithNeighbours);
        return sendAndTake(std::move(toEach), bytesFromEach);
    }

    [[nodiscard]] double largest(double value) override {
        // MPI_MAX need not pass on what is not a number.
        beginLargest(Reduction::Number, {std::isnan(value) ? INFINITY : value, 0, 0});
        return endLargest()[0];
    }

    /// All reductions have the same length, and carry their purpose: ranks that wait in different ones
    /// receive a result, and detect the difference by it.
    void beginLargest(Reduction what, const Three& three) override {
        begin(Call::Largest);
        const auto purpose = static_cast<double>(what);
        given = {three[0], three[1], three[2], purpose, -purpose};
        require(MPI_Iallreduce(given.data(), most.data(), static_cast<int>(given.size()), MPI_DOUBLE, MPI_MAX,
                               reductions, &reduction.emplace_back()));
    }
    [[nodiscard]] Three endLargest() override {
        wait(reduction);
        reduction.clear();
        if (most[3] != -most[4]) throw RunError(inOtherCalls);
        return {most[0], most[1], most[2]};
    }
    [[nodiscard]] double waited() const override { return waiting.seconds(); }

    void addUp(std::span<std::int64_t> integers) override {
        if (integers.size() > std::numeric_limits<int>::max())
            throw RunError("Ranks cannot add up so many numbers at once: MPI counts them by an int.");
        begin(Call::AddUp);
        sums.assign(integers.begin(), integers.end());
        wait([&](MPI_Request* request) {
            return MPI_Iallreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_INT64_T,
                                  MPI_SUM, additions, request);
        });
        std::ranges::copy(sums, integers.begin());
    }

    void fail(std::string_view sentence) noexcept override {
        if (hasFailed) return;
        hasFailed = true;
        toldFailure = ranks > 1 && own > 0 ? sentence : std::string_view();
        message = std::string(sentence.substr(0, longest));
        for (std::size_t q = 0; q < ranks; ++q)
            if (q != own)
                MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_CHAR, static_cast<int>(q), 0,
                          failures, &sending.emplace_back());
    }

    [[nodiscard]] std::string end() noexcept override {
        std::string sentences;
        if (!hasFailed) sayGoodbye();
        MPI_Request all = MPI_REQUEST_NULL;
        MPI_Ibarrier(failures, &all);
        double waited = 0;
        double begin = MPI_Wtime();
        for (int isThere = 0; MPI_Test(&all, &isThere, MPI_STATUS_IGNORE), isThere == 0; sched_yield()) {
            const bool before = hasFailed;
            if (const std::string sentence = failure(); !sentence.empty() && !before) {
                sentences = sentence;
                begin = MPI_Wtime();  // from now on the others come here, too
            }
            waited = MPI_Wtime() - begin;
            if (hasFailed && waited > patience) abort(sentences.empty() ? toldFailure : sentences);
        }
        // What has come at the last moment.
        if (const bool before = hasFailed; !before) sentences = failure();
        while (!failure().empty()) {}
        while (takeGoodbye()) {}
        while (isThereNews()) {}
        MPI_Finalize();
        return sentences;
    }

private:
    static constexpr std::size_t longest = 4000;  // bytes of a sentence: so much is sent without waiting
    static constexpr int goodbye = 1;             // the tag of a message without content
    static constexpr int stillWaits = 2;          // the tag of what a rank waits for

    void begin(Call call) { waitsIn = {waitsIn.number + 1, call}; }

    /// Calls start(first byte, bytes) for each part of a message.
    template <class Start>
    void startParts(std::size_t size, Start&& start) const {
        for (std::size_t at = 0; at < size; at += part)
            require(start(at, static_cast<int>(std::min(part, size - at))));
    }
    /// Between two ranks, messages come in the order in which they were sent.
    std::vector<Message> sendAndTake(std::vector<Message> toEach,
                                     const std::vector<std::size_t>& bytesFromEach) {
        got.assign(ranks, {});
        sent = std::move(toEach);
        std::vector<MPI_Request> requests;
        for (std::size_t q = 0; q < ranks; ++q) {
            if (q == own) continue;
            got[q].resize(bytesFromEach[q]);
            startParts(got[q].size(), [&](std::size_t at, int bytes) {
                return MPI_Irecv(got[q].data() + at, bytes, MPI_BYTE, static_cast<int>(q), 0, work,
                                 &requests.emplace_back());
            });
        }
        for (std::size_t q = 0; q < ranks; ++q) {
            if (q == own) continue;
            startParts(sent[q].size(), [&](std::size_t at, int bytes) {
                return MPI_Isend(sent[q].all().data() + at, bytes, MPI_BYTE, static_cast<int>(q), 0, work,
                                 &requests.emplace_back());
            });
        }
        wait(requests);
        std::vector<Message> fromEach;
        for (std::size_t q = 0; q < ranks; ++q)
            fromEach.push_back(q == own ? std::move(sent[q]) : Message(std::move(got[q])));
        return fromEach;
    }

    /// The sentence of a rank that has failed; empty if none has.
    std::string failure() noexcept {
        int isThere = 0, length = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, 0, failures, &isThere, &status);
        if (isThere == 0) return {};
        MPI_Get_count(&status, MPI_CHAR, &length);
        std::string sentence(static_cast<std::size_t>(length), ' ');
        MPI_Recv(sentence.data(), length, MPI_CHAR, status.MPI_SOURCE, 0, failures, MPI_STATUS_IGNORE);
        hasFailed = true;
        return sentence.empty() ? "another rank has failed." : sentence;
    }

    /// Tells the others that this rank does nothing with them any more.
    void sayGoodbye() noexcept {
        for (std::size_t q = 0; q < ranks; ++q)
            if (q != own)
                MPI_Isend(nullptr, 0, MPI_CHAR, static_cast<int>(q), goodbye, failures,
                          &sending.emplace_back());
    }
    /// Whether one more rank has ended.
    bool takeGoodbye() noexcept {
        int isThere = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, goodbye, failures, &isThere, &status);
        if (isThere == 0) return false;
        MPI_Recv(nullptr, 0, MPI_CHAR, status.MPI_SOURCE, goodbye, failures, MPI_STATUS_IGNORE);
        return true;
    }
    /// What is waited for from a rank that has ended never comes; what it sent before is on its way.
    void refuseToWaitForNobody() {
        if (takeGoodbye() && !hasLeft) hasLeft = MPI_Wtime();
        if (hasLeft && MPI_Wtime() - *hasLeft > patience)
            throw RunError("A rank has ended while others waited for it.");
    }

    /// Ranks that wait in different calls, as where only some call gather(), would do so for ever. Each that
    /// has waited for long tells the next one in what: somewhere in this ring two of them differ.
    void refuseOtherCalls(double waited) {
        if (waited > silence && tellsOf < waitsIn.number && ranks > 1) {
            tellsOf = waitsIn.number;
            told.push_back(waitsIn);
            MPI_Isend(&told.back(), sizeof(Waiting), MPI_BYTE, static_cast<int>((own + 1) % ranks),
                      stillWaits, failures, &sending.emplace_back());
        }
        if (isThereNews() && news.number == waitsIn.number && news.call != waitsIn.call)
            throw RunError(inOtherCalls);
    }
    /// What another rank waits in, or did.
    bool isThereNews() noexcept {
        int isThere = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, stillWaits, failures, &isThere, &status);
        if (isThere == 0) return false;
        MPI_Recv(&news, sizeof news, MPI_BYTE, status.MPI_SOURCE, stillWaits, failures, MPI_STATUS_IGNORE);
        return true;
    }

    /// Where the others do not end by themselves, as when one is stuck.
    [[noreturn]] static void abort(const std::string& sentence) noexcept {
        if (!sentence.empty()) std::fprintf(stderr, "Error: %s\n", sentence.c_str());
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
        std::_Exit(EXIT_FAILURE);
    }

    [[nodiscard]] int ranksOfMachine() const {
        MPI_Comm machine = MPI_COMM_NULL;
        int count = 1;
        MPI_Comm_split_type(work, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
        MPI_Comm_size(machine, &count);
        MPI_Comm_free(&machine);
        return count;
    }

    /// Waits until all is done: awake for a millisecond or two, and then mostly asleep, so that other
    /// programs get on. Ranks that share a processor let each other have it much sooner; others keep theirs
    /// until then: on a machine that has other work, who lets go comes back after some milliseconds. Where
    /// another rank has failed, it never will be done.
    void wait(std::vector<MPI_Request>& requests) {
        const Stopwatch::Within within(waiting);
        double began = 0;
        for (std::size_t tries = 0;; ++tries) {
            int isDone = 0;
            require(MPI_Testall(static_cast<int>(requests.size()), requests.data(), &isDone,
                                MPI_STATUSES_IGNORE));
            if (isDone != 0) return;
            if (tries < keptTries) continue;
            sched_yield();
            if (tries > keptTries + 2000) std::this_thread::sleep_for(std::chrono::microseconds(20));
            if (tries % 64 != 0) continue;
            if (const std::string sentence = failure(); !sentence.empty()) throw AnotherRankFailed(sentence);
            refuseToWaitForNobody();
            if (began == 0) began = MPI_Wtime();
            refuseOtherCalls(MPI_Wtime() - began);
        }
    }
    template <class Start>
    void wait(Start&& start) {
        std::vector<MPI_Request> request(1);
        require(start(request.data()));
        wait(request);
    }

    // What MPI reads and writes: it stays where a call that has begun is never done, as another rank fails.
    std::vector<std::int64_t> lengthsTo, lengthsFrom, sums;
    std::vector<std::string> got;
    std::vector<Message> sent;
    std::array<double, 5> given{}, most{};
    std::vector<MPI_Request> reduction;  // that has begun

    Stopwatch waiting;
    // Reductions that some ranks call and others do not take nothing from exchanges, or from those of the
    // other kind: all wait.
    MPI_Comm work = MPI_COMM_NULL, reductions = MPI_COMM_NULL, additions = MPI_COMM_NULL,
             failures = MPI_COMM_NULL;
    std::size_t part = largestPart();
    Waiting waitsIn, news;     // of this rank; of the one before it
    std::int64_t tellsOf = 0;  // the number of the call of which the next rank knows
    std::deque<Waiting> told;  // while it is sent
    std::size_t own = 0, ranks = 1;
    std::size_t keptTries = 10000;  // of a wait, before others may have the processor
    bool hasFailed = false;         // this rank or another one
    std::optional<double> hasLeft;  // s, when another one was found to have ended
    std::string toldFailure;        // by this rank, if it is not the first one, which says it by itself
    std::string message;
    std::vector<MPI_Request> sending;
};

}  // namespace

}  // namespace pendular

/// Its number is another one where Exchange or ProcessRanks have other functions (ProgramRanks.cpp).
extern "C" [[gnu::visibility("default")]] pendular::ProcessRanks* makePendularRanks3() {
    static pendular::MpiRanks ranks;
    return &ranks;
}
