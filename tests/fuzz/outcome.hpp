// What a reader may make of any bytes: an answer, or an error that a user can act on. All else ends the program.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "scarp/base/error.hpp"

namespace scarp::fuzz {

/// Calls `read`, which may throw InputErrors that say what is wrong, in the file `name`, and what to do about it.
template <class Read>
void expect_answer_or_error(const char* name, Read&& read) {
  const auto fail = [](const char* lack, const InputError& error) {
    fmt::print(stderr, "{}: {}\n", lack, error.what());
    std::abort();
  };
  try {
    read();
  } catch (const InputError& error) {
    if (error.problem().empty()) fail("an error that does not say what is wrong", error);
    if (error.remedy().empty()) fail("an error without a remedy", error);
    if (error.position().file != name) fail("an error that does not name the file", error);
  }
}

}  // namespace scarp::fuzz
