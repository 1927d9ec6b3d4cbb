// Optimises accepted draws, the second half of an optimising search, or brings draws to a shape.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "schema/campaign/campaign.hpp"
#include "schema/records/fault_sample.hpp"
#include "schema/records/unit_record.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

/// The ascent from an accepted draw to its optimum, or the descent of a draw to a shape: a pure
/// function of the campaign and the draw.
class DrawAscent {
 public:
  virtual ~DrawAscent() = default;
  virtual bool finished() const = 0;
  /// Evaluates one more sheet.
  virtual void advance() = 0;
  /// The verdict on the end, by which it is accepted or not; none where draws were judged before.
  virtual std::optional<solver::Verdict> verdict() const { return {}; }
  /// Returns the candidate to keep: the optimum, its metrics and the ascent.
  virtual schema::Candidate take() = 0;
};

/// Begins with a draw, and ignores its metrics. The model outlives the ascent.
using BeginAscent = std::unique_ptr<DrawAscent> (*)(const schema::Campaign& campaign,
                                                    const solver::Model& model,
                                                    schema::Candidate start);

/// Usual size of an ascent's record in a message, in bytes.
inline constexpr std::size_t kUsualAscent_bytes = 4096;

/// The ascents from a block's draws, or a piece's sheets, one after the other.
class Ascents {
 public:
  /// Campaign and model outlive this object.
  Ascents(BeginAscent ascend, const schema::Campaign& campaign, const solver::Model& model)
      : ascend_(ascend), campaign_(campaign), model_(model) {}

  /// Begins with a block whose candidates are accepted draws, or any draws whose ends are judged,
  /// and sampled by this rule.
  void begin(schema::UnitRecord block,
             const schema::FaultSampleRule& sampled = schema::FaultSampleRule());
  bool under_way() const { return block_.has_value(); }
  /// Evaluates sheets for about a tenth of a second. `kept` is called with each optimum, in turn.
  void advance(const std::function<void(schema::Candidate&)>& kept);
  /// Returns whether all ascents of the block have ended.
  bool finished() const { return next_ == block_->candidates.size(); }
  schema::UnitRecord take();

 private:
  schema::Candidate* look();
  bool is_kept(std::uint64_t draw);

  const BeginAscent ascend_;
  const schema::Campaign& campaign_;
  const solver::Model& model_;
  std::optional<schema::UnitRecord> block_;
  schema::FaultSampleRule sampled_;
  std::size_t next_ = 0;
  std::unique_ptr<DrawAscent> ascent_;
};

}  // namespace misalign::search
