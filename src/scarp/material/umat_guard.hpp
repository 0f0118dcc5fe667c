// What a UMAT does to the whole program, undone: STOP, exit() and crashes become exceptions of the call.
#pragma once

#include <stdexcept>
#include <type_traits>

namespace scarp::umat {

/// Thrown out of call_guarded() where the routine ended the program (STOP, ERROR STOP, CALL EXIT, exit(), a run-time
/// error of Fortran).
class EndedProgram : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The same where it crashed: SIGSEGV, SIGBUS, SIGFPE, SIGILL or SIGABRT.
class Crashed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Calls f(data) and comes back whatever it does, save _exit() and endless loops; exceptions of f pass through. After
/// EndedProgram or Crashed the thread goes on, but what the routine's library and its run-time library hold (locks,
/// files, memory) is as they left it: no more calls of it, and the program ends by end_program().
void call_guarded(void (*f)(void*), void* data);

template <class F>
void call_guarded(F&& f) {
  call_guarded([](void* data) { (*static_cast<std::remove_reference_t<F>*>(data))(); }, &f);
}

/// Must have been called once, before any call_guarded(), and after a library with exit handlers was opened.
void watch_for_ends();

/// Has a routine ended the program, or crashed?
bool was_ended();

/// Ends the program without the destructors and handlers of libraries, after its own files are written.
[[noreturn]] void end_program(int status);

}  // namespace scarp::umat
