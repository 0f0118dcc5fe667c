#include "scarp/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <mutex>

namespace scarp::logging {
namespace {

spdlog::logger& logger() {
  // Never destroyed: the program may go on from within exit() (material/umat_guard.hpp).
  static spdlog::logger* const instance = [] {
    auto* made = new spdlog::logger("scarp", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("scarp: %v");
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *instance;
}

std::mutex of_the_list;
std::vector<std::string> list;

}  // namespace

void info(const std::string& text) {
  logger().info(text);
}
void warn(const std::string& text) {
  logger().warn("warning: {}", text);
  const std::scoped_lock lock(of_the_list);
  list.push_back(text);
}

std::vector<std::string> warnings() {
  const std::scoped_lock lock(of_the_list);
  return list;
}
void forget_warnings() {
  const std::scoped_lock lock(of_the_list);
  list.clear();
}

}  // namespace scarp::logging
