#include "search/verbs/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <string_view>

#include "search/terminal/screen.hpp"

namespace misalign::search {
namespace {

// Writes messages on lines of their own, not behind a live one.
using ColorSink = spdlog::sinks::stderr_color_sink_mt;
class MessageSink : public ColorSink {
 public:
  explicit MessageSink(spdlog::color_mode mode) : ColorSink(mode) {}
  void log(const spdlog::details::log_msg& message) override {
    erase_live_line();
    const std::string_view text(message.payload.data(), message.payload.size());
    const std::string shown = on_lines_of_its_own(text);
    spdlog::details::log_msg printable = message;
    printable.payload = shown;
    ColorSink::log(printable);
  }

 private:
  // Names and values in it may come from anywhere: text after a line feed never looks like another
  // message.
  static std::string on_lines_of_its_own(std::string_view text) {
    std::string shown;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string_view line = text.substr(begin, end - begin);
      if (begin > 0) shown += line.starts_with("  ") ? "\n" : "\n  ";
      shown += schema::printable(line);
      begin = end + 1;
    }
    return shown;
  }
};

}  // namespace

void set_up_log(const std::string& level, ColorMode color) {
  auto sink = std::make_shared<MessageSink>(colors_wanted(color, is_terminal(STDERR_FILENO))
                                                ? spdlog::color_mode::always
                                                : spdlog::color_mode::never);
  sink->set_color(spdlog::level::info, "");
  auto logger = std::make_shared<spdlog::logger>("misalign", sink);
  logger->set_pattern("misalign: %^%v%$");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
}

}  // namespace misalign::search
