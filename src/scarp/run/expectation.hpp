// What a case will take, said before it is run: memory, frames and time.
#pragma once

#include <string>

#include "scarp/input/case.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// How many frames a run writes whose stages take all their time.
template <int Dim>
double frame_count(const input::CaseOf<Dim>& input);

/// Of the frames of a run whose stages take all their time: how many, and bytes of all of them.
struct FramesExpected {
  double count = 0, bytes = 0;
};
template <int Dim>
FramesExpected frames_expected(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Lines of text: the memory that the case takes, its frames, and the wall time at the rate of a few steps of size `dt`
/// [s] that are tried out on `body`, for a fraction of a second or one step. The body is of no use afterwards.
template <int Dim>
std::string expectation(const input::CaseOf<Dim>& input, Body<Dim>& body, double dt);

}  // namespace scarp::run
