#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Core/Ranks/Message.h"

namespace pendular {

/// What is said where ranks wait for each other in different calls, as when some gather grains and others go
/// on.
inline constexpr const char* inOtherCalls =
    "Ranks wait for each other in different calls: gather(), writeRestart(), sumOverRanks() and others that "
    "say so must be called on all ranks, in the same order (see the page on ranks).";

/// What a reduction is for: where ranks wait in different ones, the run ends with that sentence.
enum class Reduction { Number, Step, Decisions, SetUp };

/// What goes between the ranks of a run, as one of them sees it. All ranks call the same functions in the
/// same order.
class Exchange {
public:
    virtual ~Exchange() = default;

    [[nodiscard]] virtual std::size_t rank() const = 0;  // this one, counted from 0
    [[nodiscard]] virtual std::size_t count() const = 0;
    /// One message to each rank, and one from each, also from itself.
    [[nodiscard]] virtual std::vector<Message> swap(std::vector<Message> toEach) = 0;
    /// The same where each knows how many bytes come from each, none for most: these cost nothing then.
    [[nodiscard]] virtual std::vector<Message> swapWithNeighbours(
        std::vector<Message> toEach, const std::vector<std::size_t>& /*bytesFromEach*/) {
        return swap(std::move(toEach));
    }
    /// The largest of what the ranks give.
    [[nodiscard]] virtual double largest(double own) = 0;
    /// Each of these integers becomes the sum of those of all ranks.
    virtual void addUp(std::span<std::int64_t> integers) {
        Message message;
        for (const std::int64_t integer : integers) message.add(integer);
        std::ranges::fill(integers, 0);
        for (Message& from : swap(std::vector<Message>(count(), message)))
            for (std::int64_t& integer : integers) integer += from.take<std::int64_t>();
    }
    /// The largest of each of three numbers, none of which is NaN, in one message and in two calls: other
    /// messages may be on their way between them, so that ranks wait once.
    using Three = std::array<double, 3>;
    virtual void beginLargest(Reduction /*what*/, const Three& own) { begun = own; }
    [[nodiscard]] virtual Three endLargest() {
        for (double& number : begun) number = largest(number);
        return begun;
    }
    /// s, how long this rank has waited for others so far.
    [[nodiscard]] virtual double waited() const { return 0; }
    /// What each rank gives, in the order of ranks.
    template <class Value>
    [[nodiscard]] std::vector<Value> ofAll(const Value& own) {
        Message message;
        message.add(own);
        std::vector<Value> all;
        for (Message& from : swap(std::vector<Message>(count(), message))) all.push_back(from.take<Value>());
        return all;
    }
    [[nodiscard]] std::vector<std::string> textsOfAll(const std::string& own) {
        std::vector<std::string> all;
        for (const Message& from : swap(std::vector<Message>(count(), Message(own))))
            all.emplace_back(from.all());
        return all;
    }

private:
    Three begun{};
};

}  // namespace pendular
