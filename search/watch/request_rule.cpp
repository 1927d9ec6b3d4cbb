#include "search/watch/request_rule.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <string_view>

namespace misalign::search {
namespace {

// The largest integer of SQLite, and so of a catalogue's draws.
constexpr std::uint64_t kLastDraw = std::numeric_limits<std::int64_t>::max();

std::string lower(std::string text) {
  for (char& letter : text) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

// Returns the Host headers of this address; without the port for HTTP's default.
std::vector<std::string> own_hosts(const PagePlace& place) {
  std::vector<std::string> hosts;
  const bool six = place.address.find(':') != std::string::npos;
  for (const std::string& name :
       {std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]"),
        six ? "[" + place.address + "]" : place.address}) {
    hosts.push_back(fmt::format("{}:{}", name, place.port));
    if (place.port == 80) hosts.push_back(name);
  }
  return hosts;
}

}  // namespace

std::optional<std::uint64_t> sheet_asked(const std::string& path) {
  const std::string_view begin = kSheetPath;
  if (path.compare(0, begin.size(), begin) != 0) return {};
  std::uint64_t draw = 0;
  const char* const end = path.data() + path.size();
  const auto [read, fault] = std::from_chars(path.data() + begin.size(), end, draw);
  if (fault != std::errc() || read != end || draw > kLastDraw) return {};
  return draw;
}

std::optional<Refusal> refusal(const PageRequest& request, const PagePlace& place) {
  const std::vector<std::string> ours = own_hosts(place);
  const auto is_ours = [&](const std::string& host) {
    return std::find(ours.begin(), ours.end(), lower(host)) != ours.end();
  };
  if (request.hosts.size() != 1 || !is_ours(request.hosts[0])) {
    return Refusal{421, fmt::format("the request names another host than {}; open http://{}/ "
                                    "(through ssh -L with the same port at both ends)",
                                    ours[0], ours[0])};
  }
  const bool own_origin =
      request.origin.empty() || lower(request.origin) == "http://" + lower(request.hosts[0]);
  const bool own_site = request.fetch_site.empty() || request.fetch_site == "same-origin" ||
                        request.fetch_site == "none";
  if (!own_origin || !own_site) {
    return Refusal{
        403,
        "the request comes from a page of another site; open this page by its address instead"};
  }
  if (request.method != "GET" && request.method != "HEAD") {
    return Refusal{405, "this page is read only; use GET or HEAD"};
  }
  if (request.path != kPagePath && request.path != kLivePath && !sheet_asked(request.path)) {
    return Refusal{404, fmt::format("there is no such page; use {}, {} or {}NUMBER", kPagePath,
                                    kLivePath, kSheetPath)};
  }
  if (request.has_range) return Refusal{416, "answers are sent whole; omit the Range header"};
  return {};
}

}  // namespace misalign::search
