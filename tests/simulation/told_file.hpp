// A catalogue of a story: what readers have seen of it, what they may say of it, and what people do
// with its file.
#pragma once

#include "tests/simulation/campaigns.hpp"
#include "tests/simulation/process.hpp"

namespace misalign::simulation {

bool contains(const std::string& text, std::string_view part);

/// The parts of a story that all who act in it share.
struct Scene {
  const Told& told;
  Disk& disk;
  Tally& tally;
  const Expected* expected = nullptr;
  std::string wrong = {};  ///< the first thing that went wrong

  void fail(const std::string& why);
  std::string path(const std::string& name) const { return disk.folder() + "/" + name; }
  bool is_there(const std::string& name) const;
};

class ToldFile {
 public:
  enum class Begins { told, empty };
  /// Puts the catalogue of an older program there, if the story begins with one.
  ToldFile(Scene& scene, std::string name, Begins begins);

  const std::string& name() const { return name_; }
  const Kept& kept() const { return kept_; }
  /// The process of a reader; `between` is called once its moment is fixed.
  Life looking(void (*between)() = nullptr) const;

  /// Looks, and compares with what is known.
  schema::Json look();
  /// Looks after a life that ended so. Of a search that had the time to commit its draws `made` is
  /// their number; 0 of others.
  schema::Json look_after(const LifeEnd& end, std::uint64_t made);
  /// Compares the end of a reader that kept its moment for long.
  void take_long_look(const LifeEnd& end, bool lost_index);
  /// Compares with what a finished campaign must hold; a merged one may have no end of its own.
  void expect_finished(bool is_merged);
  /// Expects one file without journals.
  void expect_alone() const;
  /// Returns whether a reader may end with this sentence.
  bool may_say(const std::string& sentence, bool may_be_empty) const;
  bool may_say(const std::string& sentence) const { return may_say(sentence, kept_.is_empty()); }

  /// Copies the file, with its log or alone, as a backup script does, and looks at the copy.
  /// Returns whether it is a catalogue.
  bool copy(bool with_log);
  /// Takes the file away from the search that writes it, and puts it back.
  void take_away();
  bool is_away() const { return is_away_; }
  void put_back();
  /// Loses the log, or the file and not its log.
  void harm(Random& random);
  bool is_harmed() const { return is_harmed_; }
  /// Takes a refusal of the harmed file, which must contradict itself: its owner begins anew.
  void take_refusal();
  /// Notes that a program has taken the file for sound, and is held to that.
  void take_for_sound() { is_harmed_ = false; }
  void lose_power() { kept_.lose_power(); }
  void take_studies(const ToldFile& other) { kept_.take_studies(other.kept_); }

 private:
  void begin_anew();
  void expect_printed(const LifeEnd& end, std::uint64_t done) const;

  Scene& scene_;
  const std::string name_;
  Kept kept_;
  int least_runs_ = 0;  // with which it shows what a power cut must not undo
  std::uint64_t done_ = 0;
  bool is_harmed_ = false, is_away_ = false, is_new_ = false;
};

}  // namespace misalign::simulation
