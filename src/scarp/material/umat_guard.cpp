#include "scarp/material/umat_guard.hpp"

#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

namespace scarp::umat {
namespace {

/// Where a call in progress on this thread goes back to. Plain data: exit() destroys what threads own before it calls
/// handlers.
struct Return {
  sigjmp_buf place;
  bool open = false;
};
thread_local Return back;
thread_local bool has_stack = false;

std::atomic<bool> ended{false};

// Sanitizers have handlers and stacks for signals of their own, and more to say about a crash.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool crashes_watched = false;
#else
constexpr bool crashes_watched = true;
#endif

constexpr int by_exit = -1;        ///< the value of a jump back from exit(); that from a signal is its number
constexpr unsigned patience = 60;  ///< seconds from the end of a routine to that of the program

/// What a crash or exit() left locked may hold up the end of the run for ever.
void end_in_time() {
  std::signal(SIGALRM, [](int) {
    constexpr char text[] = "scarp: the run does not end after its UMAT did; summary.json may not say so\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
    _exit(3);
  });
  alarm(patience);
}

void go_back(int how) {
  back.open = false;
  if (!ended.exchange(true)) end_in_time();
  siglongjmp(back.place, how);
}

/// Called by exit(): anywhere but in a call it does nothing. A handler is called once, and other threads may be in a
/// call, too.
void on_exit_of_program() {
  if (!back.open) return;
  std::atexit(on_exit_of_program);
  go_back(by_exit);
}

constexpr std::array<std::pair<int, const char*>, 5> crashes{{{SIGSEGV, "segmentation fault (SIGSEGV)"},
                                                              {SIGBUS, "bus error (SIGBUS)"},
                                                              {SIGFPE, "arithmetic exception (SIGFPE)"},
                                                              {SIGILL, "illegal instruction (SIGILL)"},
                                                              {SIGABRT, "it aborted (SIGABRT)"}}};

void on_crash(int signal) {
  if (back.open) go_back(signal);
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// A routine may crash because the stack is full: the handler has one of its own, which stays as long as the thread.
void give_stack() {
  if (has_stack || !crashes_watched) return;
  has_stack = true;
  constexpr std::size_t size = 1 << 16;
  stack_t stack{};
  stack.ss_sp = std::malloc(size);
  stack.ss_size = size;
  if (stack.ss_sp) sigaltstack(&stack, nullptr);
}

/// Lets out what the routine has written and gfortran's run time still holds: the program ends without its clean-up.
/// Beside the call and not for long, since a routine may have ended in the middle of writing.
void flush_fortran() {
  void* const library = dlopen("libgfortran.so.5", RTLD_LAZY | RTLD_NOLOAD);
  if (!library) return;
  using Flush = void (*)(const int* unit);  // no unit: all of them
  const auto flush = reinterpret_cast<Flush>(dlsym(library, "_gfortran_flush_i4"));
  if (!flush) return;
  auto done = std::make_shared<std::promise<void>>();
  const auto ready = done->get_future();
  std::thread([done, flush] {
    flush(nullptr);
    done->set_value();
  }).detach();
  ready.wait_for(std::chrono::seconds(1));
}

/// Closes the way back when an exception leaves, too.
struct Opening {
  Opening() { back.open = true; }
  ~Opening() { back.open = false; }
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;
};

}  // namespace

void watch_for_ends() {
  // Anew for each library: handlers are called from the last to the first, and its own shall not go before this one.
  std::atexit(on_exit_of_program);
  static std::once_flag once;
  std::call_once(once, [] {
    at_quick_exit(on_exit_of_program);
    if (!crashes_watched) return;
    for (const auto& [signal, name] : crashes) {
      struct sigaction action {};
      action.sa_handler = on_crash;
      action.sa_flags = SA_ONSTACK | SA_NODEFER;  // the jump out of the handler leaves no signal blocked
      sigaction(signal, &action, nullptr);
    }
  });
}

void call_guarded(void (*f)(void*), void* data) {
  give_stack();
  const int how = sigsetjmp(back.place, 0);
  if (how == 0) {
    const Opening opening;
    f(data);
    return;
  }
  flush_fortran();
  if (how == by_exit) throw EndedProgram("it ended the program (STOP, CALL EXIT, exit() or an error of its run time)");
  for (const auto& [signal, name] : crashes) {
    if (signal == how) throw Crashed(name);
  }
  throw Crashed("a signal");
}

bool was_ended() {
  return ended;
}

void end_program(int status) {
  std::fflush(nullptr);
  std::_Exit(status);
}

}  // namespace scarp::umat
