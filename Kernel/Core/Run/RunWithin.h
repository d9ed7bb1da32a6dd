#pragma once

#include <fmt/format.h>

#include <string_view>

#include "Kernel/Core/Run/Run.h"
#include "Kernel/Foundation/Base/InputError.h"

// Included by the sources of Run, and by no others.

namespace pendular {

class Run::Within {
public:
    enum Call : unsigned {
        Solving = 1,
        SettingUp = 2,
        Stepping = 4,
        Writing = 8,
        Completing = 16,
        Saving = 32,
        Whole = 64,  // the run of solve(), which has an end
        Any = 127
    };

    Within(Run& of, Call call, unsigned refusedIn, std::string_view name) : run(of), before(of.underWay) {
        if ((before & refusedIn) != 0)
            throw InputError(
                fmt::format("Simulation: {} cannot be called from this hook of the same scene.", name));
        run.underWay |= call;
    }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;
    ~Within() { run.underWay = before; }

private:
    Run& run;
    unsigned before;
};

}  // namespace pendular
