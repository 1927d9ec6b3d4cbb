#include "search/watch/loopback.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <memory>

#include "schema/files/input.hpp"
#include "schema/files/printable.hpp"

namespace misalign::search {
namespace {

bool is_loopback(const sockaddr* address) {
  if (address->sa_family == AF_INET) {
    const auto* const four = reinterpret_cast<const sockaddr_in*>(address);
    return ntohl(four->sin_addr.s_addr) >> 24 == 127;
  }
  if (address->sa_family != AF_INET6) return false;
  return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr) != 0;
}

std::string numbers_of(const addrinfo& found) {
  std::array<char, NI_MAXHOST> numbers{};
  const int failed = getnameinfo(found.ai_addr, found.ai_addrlen, numbers.data(), numbers.size(),
                                 nullptr, 0, NI_NUMERICHOST);
  return failed ? "" : numbers.data();
}

}  // namespace

std::string loopback_address(const std::string& asked, int port) {
  if (asked == "localhost") return "127.0.0.1";  // a browser's first choice
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICHOST;  // other names may lead to any machine
  addrinfo* list = nullptr;
  const int failed = getaddrinfo(asked.c_str(), nullptr, &hints, &list);
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> found(failed ? nullptr : list,
                                                                 freeaddrinfo);
  if (found && is_loopback(found->ai_addr)) return numbers_of(*found);
  throw schema::UserError(solver::OptionFault{
      "address", asked,
      "is no loopback address (others could read the catalogue under another one)",
      fmt::format("omit it; from another machine use ssh -L {}:127.0.0.1:{} THIS_MACHINE", port,
                  port)});
}

std::string url_of(const std::string& address, int port) {
  const bool six = address.find(':') != std::string::npos;
  return fmt::format("http://{}:{}/", six ? "[" + address + "]" : address, port);
}

}  // namespace misalign::search
