// The fuzzers' common parts: dice, small changes of JSON documents and of bytes, and the loop that
// counts inputs, times them, and keeps the one at which something was found.
#pragma once

#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "schema/files/input.hpp"

// Sanitizers call it before they end the program; null without them.
extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace misalign::stress {

using schema::Json;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : words_(seed) {}
  std::size_t below(std::size_t end) { return end == 0 ? 0 : words_() % end; }
  double log_uniform(double least, double most) {
    return least *
           std::exp(std::uniform_real_distribution<double>(0, std::log(most / least))(words_));
  }
  template <class List>
  auto& one_of(List& list) {
    return list[below(std::size(list))];
  }
  std::mt19937_64& words() { return words_; }

 private:
  std::mt19937_64 words_;
};

/// Any value of a document, and its parent if it has one.
struct Place {
  Json *value, *parent;
};
inline Place some_place(Json& document, Dice& dice) {
  Place at{&document, nullptr};
  while (at.value->is_structured() && !at.value->empty() &&
         (at.parent == nullptr || dice.below(8) != 0)) {
    at.parent = at.value;
    auto child = at.value->begin();
    std::advance(child, static_cast<std::ptrdiff_t>(dice.below(at.value->size())));
    at.value = &*child;
  }
  return at;
}

/// Any value of the document becomes another (one of `other`'s, too), goes, or is there twice.
inline void change_something(Json& document, Dice& dice, const std::function<Json()>& other) {
  const auto [at, parent] = some_place(document, dice);
  switch (dice.below(5)) {
    case 0:
      *at = other();
      break;
    case 1:
      if (parent && parent->is_array()) {
        parent->push_back(Json(*at));
        break;
      }
      [[fallthrough]];
    case 2:
      if (parent && parent->is_array()) {
        parent->erase(dice.below(parent->size()));
        break;
      }
      [[fallthrough]];
    case 3: {
      static const Json kOdd = Json::parse(
          R"([null, true, "", "M", {}, [], [[]], -1, 0, 1, 3, 1e308, -1e-308, 5e-324, 0.1,
              18446744073709551615, -9223372036854775808, 4294967296, [1, 2], [0, 1, 2, 3]])");
      *at = dice.one_of(kOdd);
      break;
    }
    default:
      if (at->is_number_float()) {
        *at = at->get<double>() * dice.log_uniform(1e-9, 1e9);
      } else if (at->is_number_integer()) {
        *at = dice.below(60);
      } else {
        *at = nullptr;
      }
  }
}

/// A few bytes of a text become others, go, or are there twice.
inline void change_bytes(std::string& bytes, Dice& dice) {
  static constexpr const char* kTokens[] = {"NaN",   "1e999", "-1",   "null", "[",        "]",
                                            "{",     "}",     "\"",   ",",    "1e308",    "0.1",
                                            "1e-99", "[[[[",  "true", "\\u",  "\xf0\x9f", "-"};
  const std::size_t at = dice.below(bytes.size());
  switch (dice.below(5)) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(dice.words()());
      break;
    case 1:
      bytes.erase(at, 1 + dice.below(20));
      break;
    case 2:
      bytes.insert(at, bytes.substr(dice.below(bytes.size()), dice.below(200)));
      break;
    case 3:
      bytes.insert(at, dice.one_of(kTokens));
      break;
    default:
      if (!bytes.empty()) bytes[at] = static_cast<char>('0' + dice.below(10));
  }
}

/// The input that is being read, kept as a file if it is the last one.
class Running {
 public:
  static void set(const std::string* input) { input_ = input; }
  static void name_file(const std::string& name) {
    std::snprintf(file_, sizeof file_, "%s", name.c_str());
  }
  /// Safe in a signal handler.
  static void keep() {
    if (!input_) return;
    const int file = ::open(file_, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0) {
      const bool whole = ::write(file, input_->data(), input_->size()) >= 0;
      ::close(file);
      say(whole ? "the input is in " : "the input could not be written to ");
      say(file_);
      say("\n");
    }
    input_ = nullptr;
  }
  static void say(const char* text) {
    if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) std::_Exit(1);
  }

 private:
  inline static const std::string* input_ = nullptr;
  inline static char file_[100] = "found.input";
};

[[noreturn]] inline void found(const std::string& what) {
  std::fprintf(stderr, "FOUND: %s\n", what.c_str());
  Running::keep();
  std::signal(SIGABRT, SIG_DFL);
  std::abort();
}

/// What may be shown to people: nothing in it that a terminal acts on, and no flood.
inline void check_shown(const std::string& text, std::size_t most_bytes = 1 << 16) {
  if (schema::printable_lines(text) != text) found("not printable: " + schema::printable(text));
  if (text.size() > most_bytes)
    found(std::to_string(text.size()) + " bytes: " + text.substr(0, 300));
}

/// "problem (why); suggestion", and no angle in it that is no number (a quoted text may be
/// anything).
inline void check_sentence(const std::string& sentence) {
  check_shown(sentence);
  if (sentence.find(" (") == std::string::npos || sentence.find("); ") == std::string::npos) {
    found("no sentence: " + sentence);
  }
  if (sentence.find("does not fold rigidly") == std::string::npos) return;
  for (const char* bad : {"nan deg", "inf deg"}) {
    if (sentence.find(bad) != std::string::npos) found("no number: " + sentence);
  }
}

/// One fuzzer: `next` makes inputs, `read` finds something or says which of `outcomes` it was.
struct Fuzzer {
  const char* name;
  std::vector<const char*> outcomes;
  /// Processor seconds: one input may not take longer than `hang_s` (ten times that under the
  /// sanitizers), and is told if `slow_s`.
  double slow_s, hang_s;
  std::vector<std::string> corpus;  ///< inputs to start from
  std::function<std::string(Dice&)> next;
  std::function<int(const std::string&)> read;
};

inline double processor_s() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline void end_by_signal(int signal) {
  Running::say(signal == SIGPROF ? "FOUND: it takes too long\n" : "FOUND: a crash\n");
  Running::keep();
  std::signal(signal == SIGPROF ? SIGABRT : signal, SIG_DFL);
  std::raise(signal == SIGPROF ? SIGABRT : signal);
}

inline void watch() {
  std::signal(SIGPROF, end_by_signal);
  if (__sanitizer_set_death_callback) {
    __sanitizer_set_death_callback(Running::keep);
  } else {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
      std::signal(signal, end_by_signal);
    }
  }
}

inline int read_watched(const Fuzzer& fuzzer, const std::string& input) {
  const auto limit = [](double seconds) {
    itimerval timer{};
    timer.it_value.tv_sec = static_cast<time_t>(seconds);
    ::setitimer(ITIMER_PROF, &timer, nullptr);
  };
  Running::set(&input);
  limit(fuzzer.hang_s * (__sanitizer_set_death_callback ? 10 : 1));
  int outcome = 0;
  try {
    outcome = fuzzer.read(input);
  } catch (const std::exception& error) {
    found(std::string("it escaped: ") + error.what());
  }
  limit(0);
  Running::set(nullptr);
  return outcome;
}

inline void fuzz(const Fuzzer& fuzzer, std::uint64_t inputs, std::uint64_t seed) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  std::fflush(stdout);
  Dice dice(seed);
  std::vector<std::uint64_t> counts(fuzzer.outcomes.size());
  double slowest_s = 0;
  const double start_s = processor_s();
  for (std::uint64_t i = 0; i < inputs; ++i) {
    const std::string file =
        std::string(fuzzer.name) + "-" + std::to_string(seed) + "-" + std::to_string(i) + ".input";
    Running::name_file(file);
    const std::string input = fuzzer.next(dice);
    const double before_s = processor_s();
    ++counts.at(static_cast<std::size_t>(read_watched(fuzzer, input)));
    const double took_s = processor_s() - before_s;
    slowest_s = std::max(slowest_s, took_s);
    if (took_s > fuzzer.slow_s) {
      std::printf("slow: %.1f s, ", took_s);
      std::fflush(stdout);
      Running::set(&input);
      Running::keep();
    }
  }
  std::printf("%llu inputs in %.0f s of processor time:", static_cast<unsigned long long>(inputs),
              processor_s() - start_s);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    std::printf(" %llu %s,", static_cast<unsigned long long>(counts[k]), fuzzer.outcomes[k]);
  }
  std::printf(" the slowest %.3f s\n", slowest_s);
}

inline void write_corpus(const Fuzzer& fuzzer, const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  int number = 0;
  for (const std::string& input : fuzzer.corpus) {
    std::ofstream(directory / std::to_string(number++), std::ios::binary) << input;
  }
}

/// NAME INPUTS [SEED] | NAME --input FILE | NAME --corpus DIRECTORY
inline int fuzz_main(int argc, char** argv, const Fuzzer& fuzzer) {
  watch();
  if (argc == 3 && std::strcmp(argv[1], "--input") == 0) {
    std::stringstream bytes;
    bytes << std::ifstream(argv[2], std::ios::binary).rdbuf();
    const std::string input = bytes.str();
    const double before_s = processor_s();
    const int outcome = read_watched(fuzzer, input);
    std::printf("%s, %.3f s\n", fuzzer.outcomes.at(static_cast<std::size_t>(outcome)),
                processor_s() - before_s);
    return 0;
  }
  if (argc == 3 && std::strcmp(argv[1], "--corpus") == 0) {
    write_corpus(fuzzer, argv[2]);
    return 0;
  }
  char* end = nullptr;
  const auto inputs = argc > 1 ? std::strtoull(argv[1], &end, 10) : 0;
  if (inputs == 0 || *end != '\0' || argc > 3) {
    std::fprintf(stderr, "%s INPUTS [SEED] | --input FILE | --corpus DIRECTORY\n", fuzzer.name);
    return 2;
  }
  fuzz(fuzzer, inputs, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::random_device()());
  return 0;
}

}  // namespace misalign::stress
