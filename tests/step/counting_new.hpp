#pragma once

namespace scarp::test {

/// How often operator new was called in this program.
long allocations();

}  // namespace scarp::test
