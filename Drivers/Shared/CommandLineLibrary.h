#pragma once

// CLI11 without optimisation: it reads a command line once, and is nothing but headers, which every program
// compiles again. (clang knows neither of the two lines, and takes half of g++'s time for it.)
#include <fmt/format.h>

#if defined(__GNUC__) && !defined(__clang__)
    #pragma GCC push_options
    #pragma GCC optimize("O0")
#endif
#include <CLI/CLI.hpp>
#if defined(__GNUC__) && !defined(__clang__)
    #pragma GCC pop_options
#endif
