// Others who come while a search stands still: readers, one of whom keeps his moment for long,
// another program that holds a lock, and a second search.
#pragma once

#include <memory>

#include "tests/simulation/endings.hpp"
#include "tests/simulation/told_file.hpp"

namespace misalign::simulation {

class Visitors {
 public:
  /// All must outlive this object; `has_copy` is set with each copy.
  Visitors(Scene& scene, ToldFile& file, const Share& share, Circumstances& circumstances,
           bool& has_copy)
      : scene_(scene),
        file_(file),
        share_(share),
        circumstances_(circumstances),
        has_copy_(has_copy) {}

  void receive(Visit visit, Random& random);
  /// Ends those who are still there.
  void end();

 private:
  void begin_long_look();
  void begin_lock();
  void search_too();
  void read(std::function<int(int)> reader);

  Scene& scene_;
  ToldFile& file_;
  const Share& share_;
  Circumstances& circumstances_;
  bool& has_copy_;
  std::unique_ptr<Process> reader_, locker_;
};

}  // namespace misalign::simulation
