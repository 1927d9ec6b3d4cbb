// The descent from a draw to the campaign's target, in a search among sheets of one shape.
#pragma once

#include "search/draws/ascents.hpp"
#include "solver/shape/shape_options.hpp"

namespace misalign::search {

/// The options of a draw's descent: its shifts begin it, and its random words choose the weight and
/// the turned diagonals, of which the model has `diagonals`.
solver::ShapeOptions shape_options_of(const schema::Campaign& campaign, std::size_t diagonals,
                                      std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm);

/// The verdict on an end: that of its path, unless it lies off the shape, farther than the campaign
/// allows or unknown, by an angle to which its path leads.
solver::Verdict verdict_on_shape(const schema::Campaign& campaign, const solver::Verdict& of_path,
                                 std::optional<double> shape_max_mm);

/// The descent of a draw; it advances by all its steps at once, mostly within a second.
std::unique_ptr<DrawAscent> shaped_draw(const schema::Campaign& campaign,
                                        const solver::Model& model, schema::Candidate start);

}  // namespace misalign::search
