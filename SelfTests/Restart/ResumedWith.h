#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

/// Runs that are resumed with one setting that is not that of the restart file.
namespace pendular::resumed {

template <class Settings>
struct Change {
    std::string name;  // as the sentence has it
    std::function<void(Settings&)> make;
};

/// A scene of these settings writes a restart file after some steps. One of the same settings takes it; for
/// each change the refusal is one sentence with the name of the setting, its value in the file and that in
/// the scene.
/// @param make(settings) returns a pointer to a scene
template <class Settings, class Make>
void expectRefusals(const Make& make, const std::vector<Change<Settings>>& changes, std::size_t steps = 5) {
    const support::TestFolder folder;
    const std::filesystem::path file = folder.path() / "begun.h5";
    {
        auto scene = make(Settings());
        scene->initialise();
        scene->step(steps);
        scene->writeRestart(file);
    }
    const auto resume = [&](const Settings& settings) {
        return support::refusal([&] {
            auto scene = make(settings);
            scene->restartFrom(file);
            scene->initialise();
            scene->step();
        });
    };
    ASSERT_EQ(resume(Settings()), "");
    for (const Change<Settings>& change : changes) {
        SCOPED_TRACE(change.name);
        Settings other;
        change.make(other);
        const std::string sentence = resume(other);
        EXPECT_TRUE(support::isOneSentence(sentence)) << sentence;
        for (const std::string_view part :
             {std::string_view(change.name), std::string_view(" in the file and "),
              std::string_view(" in the scene")})
            EXPECT_TRUE(support::contains(sentence, part)) << sentence;
    }
}

}  // namespace pendular::resumed
