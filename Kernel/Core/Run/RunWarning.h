#pragma once

#include <string>

namespace pendular {

/// What a run warns of: a law that is used where it is not made for it.
struct RunWarning {
    std::string kind;      // a run warns of each once, though the numbers of the sentence go on
    std::string sentence;  // without its full stop
};

}  // namespace pendular
