// `misalign watch`: the report's page of a catalogue while a search writes it, on this machine.
#include <signal.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <ctime>
#include <exception>
#include <filesystem>
#include <thread>

#include "schema/files/features.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"
#include "search/watch/loopback.hpp"
#include "search/watch/page_server.hpp"
#include "search/watch/watched_catalogue.hpp"

namespace misalign::search {
namespace {

struct WatchCall {
  std::string path, address = "127.0.0.1";
  std::optional<int> port;
};

sigset_t end_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM}) sigaddset(&set, signal);
  return set;
}

// Waits until SIGINT or SIGTERM, of which a second one ends the program at once, or until `ended`.
void wait_for_the_end(const std::atomic<bool>& ended) {
  const sigset_t signals = end_signals();
  constexpr timespec kLook{0, 200'000'000};
  while (!ended && sigtimedwait(&signals, nullptr, &kLook) < 0) {
  }
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

// The command that folds one draw.
std::vector<std::string> words_that_fold(const std::string& path, std::uint64_t draw) {
  return {"/proc/self/exe",
          "report",
          std::filesystem::absolute(path).string(),
          "--json",
          "--rows",
          "0",
          "--details",
          "0",
          "--draw",
          std::to_string(draw),
          "--log-level",
          "error"};
}

void serve(PageServer& server, WatchedCatalogue& catalogue) {
  const PageHandler handler = [&](const PageRequest& request) {
    if (const auto draw = sheet_asked(request.path)) {
      return catalogue.sheet(*draw, request.has_gone);
    }
    return request.path == kLivePath ? catalogue.live() : catalogue.page();
  };
  std::atomic<bool> ended = false;
  std::exception_ptr failure;
  std::thread serving([&] {
    try {
      server.serve(handler);
    } catch (...) {
      failure = std::current_exception();
    }
    ended = true;
  });
  wait_for_the_end(ended);
  catalogue.end();
  server.stop();
  serving.join();
  if (failure) std::rethrow_exception(failure);
}

void watch(const WatchCall& call) {
  const std::string address = loopback_address(call.address, call.port.value_or(kUsualPort));
  WatchedCatalogue catalogue(call.path, option_of,
                             [&](std::uint64_t draw) { return words_that_fold(call.path, draw); });
  const sigset_t signals = end_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // before there are threads, which inherit it
  PageServer server(address, call.port, option_of);
  put(url_of(address, server.place().port) + "\n");
  std::fflush(stdout);
  if (!catalogue.exists()) {
    spdlog::info("{}: there is no such file yet; the page waits for it",
                 schema::printable(call.path));
  }
  spdlog::info("open this address in a browser of this machine; Ctrl-C ends");
  serve(server, catalogue);
}

}  // namespace

Action watch_verb(CLI::App& verb) {
  verb.description("the report's page while a campaign runs");
  verb.footer(
      "Prints the page's address, and serves it until Ctrl-C. The page is that of `misalign\n"
      "report`; its figures and charts follow the catalogue while a search writes it, and say\n"
      "when it is complete. The search may run already, begin later, end and resume. It never\n"
      "waits: the catalogue is only read, briefly. Only programs on this machine reach the page,\n"
      "those of its other users too. To look from another machine, with the same port at both\n"
      "ends: ssh -L 8617:127.0.0.1:8617 THE_MACHINE_OF_THE_SEARCH\n"
      "Needs a program built with cpp-httplib and Node.js (misalign --version).\n\n"
      "Examples:\n  misalign watch results/miura-6x6-1a2b3c4d.db\n"
      "  misalign watch results/miura-6x6-1a2b3c4d.db --port 8080");
  auto call = std::make_shared<WatchCall>();
  verb.add_option("CATALOGUE", call->path, "catalogue file, on a local disk")->required();
  add_value(
      verb, "--port", call->port,
      "TCP port; 0: any that is free [" + std::to_string(kUsualPort) + ", or any if that is taken]",
      counted(0, 65535), "N");
  verb.add_option("--address", call->address, "loopback address to listen on [127.0.0.1]")
      ->type_name("ADDRESS");
  return [call] {
    for (const char* library : {"cpp-httplib", "Node.js"}) schema::need(library);
    if constexpr (has("cpp-httplib")) watch(*call);
    return 0;
  };
}

}  // namespace misalign::search
