#include "scarp/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace scarp::logging {
namespace {

spdlog::logger& logger() {
  static spdlog::logger instance = [] {
    spdlog::logger made("scarp", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made.set_pattern("scarp: %v");
    made.flush_on(spdlog::level::info);
    return made;
  }();
  return instance;
}

}  // namespace

void info(const std::string& text) {
  logger().info(text);
}
void warn(const std::string& text) {
  logger().warn("warning: {}", text);
}

}  // namespace scarp::logging
