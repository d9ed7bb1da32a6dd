#pragma once

#include "Kernel/Analysis/CoarseGraining/GrainState.h"

namespace pendular {

class Scene;
struct PolyData;

/// Velocities from now on against the flow with which the images of a scene move, so that all images have the
/// same.
void takeFlowAway(GrainState& state);

/// The grains and contacts of a scene, as of the last step: all contacts that have a force. With contacts it
/// throws InputError before initialise().
/// @param state keeps its memory from one time to the next
void takeState(const Scene& scene, GrainState& state, FieldContent content = FieldContent::All);

GrainState stateOf(const Scene& scene, FieldContent content = FieldContent::All);

/// The grains and contacts of a frame for ParaView. In periodic directions (a length above 0) a contact leads
/// to the nearest image. Throws InputError where a field is missing that is needed: with rigid bodies, those
/// that tell where their grains are in them.
GrainState stateOf(const PolyData& grains, const PolyData& contacts, const PeriodicBox& periodic);

}  // namespace pendular
