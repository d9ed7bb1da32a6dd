#pragma once

#include <cstddef>
#include <vector>

#include "Kernel/Ranks/Message.h"

namespace pendular {

/// What goes between the ranks of a run, as one of them sees it. All ranks call the same functions in the
/// same order.
class Exchange {
public:
    virtual ~Exchange() = default;

    [[nodiscard]] virtual std::size_t rank() const = 0;  // this one, counted from 0
    [[nodiscard]] virtual std::size_t count() const = 0;
    /// One message to each rank, and one from each, also from itself.
    [[nodiscard]] virtual std::vector<Message> swap(std::vector<Message> toEach) = 0;
    /// The largest of what the ranks give.
    [[nodiscard]] virtual double largest(double own) = 0;
    /// What each rank gives, in the order of ranks.
    template <class Value>
    [[nodiscard]] std::vector<Value> ofAll(const Value& own) {
        Message message;
        message.add(own);
        std::vector<Value> all;
        for (Message& from : swap(std::vector<Message>(count(), message))) all.push_back(from.take<Value>());
        return all;
    }
};

}  // namespace pendular
