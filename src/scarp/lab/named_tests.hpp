// The laboratory tests that have names, as constraints on stress and strain.
#pragma once

#include <string>
#include <vector>

#include "scarp/lab/test.hpp"

namespace scarp::lab {

/// What drives a named test: the key in a test file, and the form that it stands for.
struct Drive {
  std::string key;    ///< such as "eps_a" or "q"
  std::string means;  ///< one line for messages and documents
  bool strain;        ///< counted from the start of the stage; a stress is the value to reach
  LinearForm form;
};

struct NamedTest {
  std::string type;
  std::vector<LinearForm>
      held;                   ///< five forms that do not change (six where nothing drives the test: creep, relaxation)
  std::vector<Drive> drives;  ///< the user chooses one
  std::optional<std::size_t> cell;
};

/// All of them, in the order of the documents.
const std::vector<NamedTest>& named_tests();

}  // namespace scarp::lab
