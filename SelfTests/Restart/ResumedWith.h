#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/State/StateDigest.h"
#include "Kernel/Scene/SceneInside.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular {

class SettingNames {
public:
    /// The names of all that the parts of a step compare: "parts/fluid/density".
    static std::vector<std::string> of(const Scene& scene) {
        StateDigest digest(StateDigest::Keep::Names);
        StateArchive archive(digest);
        archive.group("parts", [&] { scene.inside->parts.compareSetUps(archive, scene.inside->context); });
        std::vector<std::string> names;
        for (const StateDigest::Entry& entry : digest.entries()) names.push_back(entry.name);
        return names;
    }
};

}  // namespace pendular

/// Runs that are resumed with one setting that is not that of the restart file.
namespace pendular::resumed {

template <class Settings>
struct Change {
    std::string name;  // as the sentence has it
    std::function<void(Settings&)> make;
};

/// A scene of these settings writes a restart file after some steps. One of the same settings takes it; for
/// each change the refusal is one sentence with the name of the setting, its value in the file and that in
/// the scene. Returns the sentences.
/// @param make(settings) returns a pointer to a scene
template <class Settings, class Make>
std::vector<std::string> expectRefusals(const Make& make, const std::vector<Change<Settings>>& changes,
                                        std::size_t steps = 5) {
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
    EXPECT_EQ(resume(Settings()), "");
    std::vector<std::string> sentences;
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
        sentences.push_back(sentence);
    }
    return sentences;
}

/// Each value that these parts of a scene compare is that of one of the sentences.
/// @param others what no driver can set by itself, or what is changed elsewhere; without "parts/"
template <class S>
void expectAllHaveRows(S&& scene, const std::set<std::string>& parts,
                       const std::vector<std::string>& sentences, const std::set<std::string>& others = {}) {
    scene->initialise();
    std::set<std::string> found, names;
    for (const std::string& name : SettingNames::of(*scene)) {
        const std::string own = name.substr(name.find('/') + 1);
        if (!parts.contains(own.substr(0, own.find('/')))) continue;
        names.insert(own);
        const auto isOf = [&](const std::string& sentence) {
            return sentence.find(name + " is ") != std::string::npos ||
                   sentence.find(name + ", number ") != std::string::npos;
        };
        if (std::ranges::any_of(sentences, isOf)) found.insert(own);
        else EXPECT_TRUE(others.contains(own)) << own << " is compared, and no row changes it";
    }
    EXPECT_GT(names.size(), 0u);
    for (const std::string& other : others) {
        EXPECT_TRUE(names.contains(other)) << other << " is not compared";
        EXPECT_FALSE(found.contains(other)) << other << " has a row";
    }
}

}  // namespace pendular::resumed
