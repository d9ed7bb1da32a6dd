#pragma once

#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::support {

/// A scene that has taken some steps goes on with the bits that another one has from its restart file, and
/// that a third one has with three threads from the start on.
/// @param before steps that the first one has taken; @param after steps that it goes on for
template <class Scene>
void expectSameBits(Scene& first, Scene& resumed, Scene& threaded, int before, int after) {
    const TestFolder folder;
    first.writeRestart(folder.path() / "half.h5");
    for (int k = 0; k < after; ++k) first.step();
    first.writeRestart(folder.path() / "whole.h5");
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.run(after);
    resumed.writeRestart(folder.path() / "resumed.h5");
    {
        SCOPED_TRACE("resumed");
        expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
    }
    threaded.setNumberOfThreads(3);
    threaded.run(before + after);
    threaded.writeRestart(folder.path() / "threaded.h5");
    SCOPED_TRACE("threaded");
    expectSameState(folder.path() / "whole.h5", folder.path() / "threaded.h5");
}

}  // namespace pendular::support
