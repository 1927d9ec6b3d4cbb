#include "search/watch/page_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "schema/files/input.hpp"
#include "search/terminal/failure.hpp"
#include "search/watch/connection_patience.hpp"

namespace misalign::search {
namespace {

// A client that sends or reads nothing holds a thread for kPatience_s; a slow one as long as
// ConnectionPatience allows.
constexpr int kThreads = 32, kPatience_s = 2;

const httplib::Headers& headers_of_all() {
  static const httplib::Headers headers = {{"Cache-Control", "no-store"},
                                           {"Cross-Origin-Opener-Policy", "same-origin"},
                                           {"Cross-Origin-Resource-Policy", "same-origin"},
                                           {"Referrer-Policy", "no-referrer"},
                                           {"X-Content-Type-Options", "nosniff"},
                                           {"X-Frame-Options", "DENY"}};
  return headers;
}

PageRequest request_of(const httplib::Request& request, const ConnectionPatience& patience) {
  PageRequest made;
  made.method = request.method;
  made.path = request.path;
  const auto [first, last] = request.headers.equal_range("Host");
  for (auto header = first; header != last; ++header) made.hosts.push_back(header->second);
  // The first of several counts; a browser sends one.
  made.origin = request.get_header_value("Origin");
  made.fetch_site = request.get_header_value("Sec-Fetch-Site");
  made.has_range = request.has_header("Range");
  made.has_gone = [&patience, port = request.remote_port] { return patience.has_gone(port); };
  return made;
}

// Sends the page through a provider: the library would compress a large body for seconds.
void give(const PageResponse& page, httplib::Response& response) {
  response.status = page.status;
  response.set_header("Content-Security-Policy", page.policy);
  const auto body = page.body;
  response.set_content_provider(
      body->size(), page.type,
      [body](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(body->data() + offset, length);
      });
}

}  // namespace

class PageServer::Impl {
 public:
  Impl(const std::string& address, std::optional<int> port, schema::NameParameter name_parameter)
      : name_parameter_(name_parameter) {
    // The library's options would allow two programs on one port.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_default_headers(headers_of_all());
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server_.set_keep_alive_max_count(1);
    server_.set_keep_alive_timeout(kPatience_s);
    server_.set_read_timeout(kPatience_s);
    server_.set_write_timeout(kPatience_s);
    server_.set_payload_max_length(0);
    place_ = {address, bound(address, port)};
  }

  int bound(const std::string& address, std::optional<int> port) {
    const int wanted = port.value_or(kUsualPort);
    if (wanted > 0 && server_.bind_to_port(address, wanted)) return wanted;
    if (wanted == 0 || !port) {
      const int free = server_.bind_to_any_port(address);
      if (free > 0) return free;
    }
    throw schema::UserError(
        schema::Cause::failure,
        fmt::format("{}: cannot listen on {} (is it taken, or below 1024?); choose another {}",
                    address, wanted > 0 ? fmt::format("port {}", wanted) : "any port",
                    schema::parameter("port")));
  }

  void serve(const PageHandler& handler) {
    ConnectionPatience patience(place_.port, kThreads);
    server_.set_pre_routing_handler([&](const httplib::Request& got, httplib::Response& response) {
      patience.heard(got.remote_port);
      const PageResponse response_page = response_to(request_of(got, patience), handler);
      if (response_page.status == 405) response.set_header("Allow", "GET, HEAD");
      give(response_page, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    const bool served = server_.listen_after_bind();
    has_ended_ = true;
    if (!served) {
      throw schema::UserError(schema::Cause::failure,
                              "connections cannot be accepted any more; start the server again");
    }
  }

  PageResponse response_to(const PageRequest& request, const PageHandler& handler) const {
    try {
      const std::optional<Refusal> refused = refusal(request, place_);
      return refused ? problem_response(refused->status, refused->sentence) : handler(request);
    } catch (const std::exception& error) {
      return problem_response(500, failure_of(error).sentence(name_parameter_));
    }
  }

  void stop() {
    while (!server_.is_running() && !has_ended_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    server_.stop();
  }

  const PagePlace& place() const { return place_; }

 private:
  const schema::NameParameter name_parameter_;
  httplib::Server server_;
  PagePlace place_;
  std::atomic<bool> has_ended_ = false;
};

PageServer::PageServer(const std::string& address, std::optional<int> port,
                       schema::NameParameter name_parameter)
    : impl_(std::make_unique<Impl>(address, port, name_parameter)) {}
PageServer::~PageServer() = default;
PagePlace PageServer::place() const { return impl_->place(); }
void PageServer::serve(const PageHandler& handler) { impl_->serve(handler); }
void PageServer::stop() { impl_->stop(); }

}  // namespace misalign::search
