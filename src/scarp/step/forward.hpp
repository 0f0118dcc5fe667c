// Names of what a step works on, for what is a part of it.
#pragma once

namespace scarp {

template <int Dim>
struct Body;
template <int Dim>
struct VelocityField;
struct StepSettings;

}  // namespace scarp
