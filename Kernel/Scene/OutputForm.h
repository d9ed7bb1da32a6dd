#pragma once

#include <concepts>
#include <type_traits>

#include "Kernel/Core/Run/OutputInterval.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// The base of an output that has members, and need not find them again after a restart.
struct RemembersNothing {};

/// Whether a class has a member of a name, whatever its form: a class that derives from it and from one that
/// has such a member too has two of them, so that the name alone is ambiguous.
namespace member {

struct Prepare {
    int prepare;
};
struct Complete {
    int complete;
};
struct VisitState {
    int visitState;
};
struct Interval {
    int interval;
};
template <class Output, class Name>
struct Both : Output, Name {};

template <class Output>
concept IsNotFinal = !std::is_final_v<Output>;
template <class Output>
concept HasPrepare = IsNotFinal<Output> && !requires {
    &Both<Output, Prepare>::prepare;
};
template <class Output>
concept HasComplete = IsNotFinal<Output> && !requires {
    &Both<Output, Complete>::complete;
};
template <class Output>
concept HasVisitState = IsNotFinal<Output> && !requires {
    &Both<Output, VisitState>::visitState;
};
template <class Output>
concept HasInterval = IsNotFinal<Output> && !requires {
    &Both<Output, Interval>::interval;
};

}  // namespace member

template <class Output, class Scene>
concept Writes = requires(Output& output, Scene& scene) {
    output.write(scene);
};
template <class Output, class Scene>
concept Prepares = requires(Output& output, Scene& scene) {
    output.prepare(scene);
};
template <class Output, class Scene>
concept Completes = requires(Output& output, Scene& scene) {
    output.complete(scene);
};
template <class Output, class Scene>
concept VisitsState = requires(Output& output, StateArchive& archive, Scene& scene) {
    output.visitState(archive, scene);
};
template <class Output>
concept HasOwnInterval = requires(const Output& output) {
    { output.interval() } -> std::convertible_to<OutputInterval>;
};
/// An output that all ranks may write together, each a part with its own grains.
template <class Output>
concept WritesParts = requires(const Output& output) {
    { output.writesParts() } -> std::same_as<bool>;
};
/// An output that has nothing to remember, or says so.
template <class Output>
concept IsForgetful = std::is_empty_v<Output> || std::derived_from<Output, RemembersNothing>;

/// Does not compile, with a sentence, unless an output has write(Scene&), has each of the functions that it
/// may have in a form that a scene can call, and says what it remembers: a function that is misspelt there
/// would be left out in silence.
template <class Output, class Scene>
consteval void requireOutputForm() {
    static_assert(Writes<Output, Scene>, "An output has a function write(const Scene&).");
    static_assert(!member::HasPrepare<Output> || Prepares<Output, Scene>,
                  "prepare() of an output has the form prepare(Scene&).");
    static_assert(!member::HasComplete<Output> || Completes<Output, Scene>,
                  "complete() of an output has the form complete(const Scene&).");
    static_assert(!member::HasInterval<Output> || HasOwnInterval<Output>,
                  "interval() of an output has the form OutputInterval interval() const.");
    static_assert(!member::HasVisitState<Output> || VisitsState<Output, Scene>,
                  "visitState() of an output has the form visitState(StateArchive&, const Scene&).");
    static_assert(VisitsState<Output, Scene> || IsForgetful<Output>,
                  "An output that has members lists in visitState(StateArchive&, const Scene&) what it "
                  "remembers from one output to the next, or derives from RemembersNothing.");
}

}  // namespace pendular
