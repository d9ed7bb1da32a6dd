#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::support {

/// The text of the InputError that an action throws; empty if it throws none.
template <class Action>
std::string refusal(Action&& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// One line with one full stop, its last character. A point within a number or a name in code is no full
/// stop.
inline ::testing::AssertionResult isOneSentence(const std::string& text) {
    if (text.empty()) return ::testing::AssertionFailure() << "nothing was refused";
    if (text.find('\n') != std::string::npos)
        return ::testing::AssertionFailure() << "several lines: " << text;
    int fullStops = 0;
    for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '.' && !(k + 1 < text.size() && std::isalnum(static_cast<unsigned char>(text[k + 1]))))
            ++fullStops;
    if (text.back() != '.' || fullStops != 1)
        return ::testing::AssertionFailure() << "not one sentence: " << text;
    return ::testing::AssertionSuccess();
}

inline ::testing::AssertionResult contains(const std::string& text, std::string_view part) {
    if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "no '" << part << "' in: " << text;
}

}  // namespace pendular::support
