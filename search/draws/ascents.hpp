// From draws that are accepted to where they end: the second half of an optimising search.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "schema/campaign/campaign.hpp"
#include "schema/records/unit_record.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

/// An accepted draw on its way to the sheet that is kept in its place: a pure function of the
/// campaign and the draw.
class DrawAscent {
 public:
  virtual ~DrawAscent() = default;
  virtual bool finished() const = 0;
  /// Looks at one more sheet.
  virtual void advance() = 0;
  /// As it is kept: the sheet at the end, its metrics, and how it came there.
  virtual schema::Candidate take() = 0;
};

/// Begins with an accepted draw, whose metrics are not looked at. The model outlives the ascent.
using BeginAscent = std::unique_ptr<DrawAscent> (*)(const schema::Campaign& campaign,
                                                    const solver::Model& model,
                                                    schema::Candidate start);

/// What the record of one takes in a message, as a rule, in bytes.
inline constexpr std::size_t kUsualAscent_bytes = 4096;

/// Those of a block's draws, or of a piece's sheets, one after the other.
class Ascents {
 public:
  /// Campaign and model outlive this object.
  Ascents(BeginAscent ascend, const schema::Campaign& campaign, const solver::Model& model)
      : ascend_(ascend), campaign_(campaign), model_(model) {}

  /// A block whose candidates are draws as they were accepted.
  void begin(schema::UnitRecord block);
  bool under_way() const { return block_.has_value(); }
  /// Looks at more sheets, for about a tenth of a second. `kept` is called with each candidate that
  /// is as it is kept now, in turn.
  void advance(const std::function<void(schema::Candidate&)>& kept);
  /// Whether all of the block's are.
  bool finished() const { return next_ == block_->candidates.size(); }
  schema::UnitRecord take();

 private:
  schema::Candidate* look();

  const BeginAscent ascend_;
  const schema::Campaign& campaign_;
  const solver::Model& model_;
  std::optional<schema::UnitRecord> block_;
  std::size_t next_ = 0;
  std::unique_ptr<DrawAscent> one_;
};

}  // namespace misalign::search
