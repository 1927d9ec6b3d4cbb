// Binds `_misalign.accepted` and `_misalign.verdicts`, which judge whole arrays of shifts in the
// lanes.
#include <algorithm>

#include "search/draws/decision_stream.hpp"
#include "search/python/arrays.hpp"
#include "search/python/bindings.hpp"
#include "search/python/model_shelf.hpp"
#include "search/python/shift_blocks.hpp"
#include "search/python/signals.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

using Source = std::shared_ptr<PatternSource>;

ModelKey key_for(const Source& source, ShiftBlocks& blocks, int threshold_sample) {
  const auto& campaign = source->campaign;
  const bool says_levels =
      campaign && campaign->misalignment.distribution == schema::ShiftDistribution::ternary;
  const double ternary_mm = threshold_sample == 0 ? 0
                            : says_levels         ? campaign->misalignment.amplitude_mm
                                                  : blocks.ternary_mm();
  return {source, source->usual, ternary_mm, threshold_sample};
}

ModelKey with_all_vertices(ModelKey key) {
  key.shifted = solver::all_vertices(key.source->pattern());
  return key;
}

// Judges sheets from `first` on, up to the end or a sheet with shifts at vertices that the model
// does not know. Returns the first sheet that was not judged. `each` gets a stream and a
// block, `rest` the stream at the end; Python's signals are checked in between.
template <class Each, class Rest>
std::uint64_t judge_from(std::uint64_t first, const ModelKey& key, ShiftBlocks& blocks,
                         const Each& each, const Rest& rest) {
  const ModelLoan loan(key);
  DecisionStream stream(loan.model(), loan.batch());
  Draws block;
  bool fits = true;
  while (fits && first < blocks.sheets()) {
    const std::uint64_t count = std::min(stream.next_block(), blocks.sheets() - first);
    const double* const rows = blocks.rows(first, count);
    unlocked([&] {
      fits = blocks.pack(rows, first, count, key.shifted, block);
      if (fits) each(stream, block);
    });
    if (fits) first += count;
    check_signals();
  }
  unlocked([&] { rest(stream); });
  return first;
}

template <class Each, class Rest>
void judge_all(const ModelKey& key, ShiftBlocks& blocks, const Each& each, const Rest& rest) {
  const std::uint64_t judged = judge_from(0, key, blocks, each, rest);
  if (judged < blocks.sheets()) judge_from(judged, with_all_vertices(key), blocks, each, rest);
}

// Returns [N]: 0 rejected, 1 accepted, 2 undecided.
py::array_t<std::uint8_t> accepted(const Source& source, const py::object& shifts_mm,
                                   double threshold_deg) {
  ShiftBlocks blocks(shifts_mm, *source);
  const int sample = threshold_sample_of(threshold_deg, source->sheet.sampling);
  py::array_t<std::uint8_t> decisions(static_cast<py::ssize_t>(blocks.sheets()));
  std::uint8_t* const to = decisions.mutable_data();
  const DecisionStream::TellDecision tell = [to](std::uint64_t number, Decision decision) {
    to[number] = static_cast<std::uint8_t>(decision);
  };
  judge_all(
      key_for(source, blocks, sample), blocks,
      [&](DecisionStream& stream, const Draws& block) { stream.accept(block, tell); },
      [&](DecisionStream& stream) { stream.finish(tell); });
  return decisions;
}

// Returns three arrays [N]: D in degrees, the fault's number in `faults`, the crease or diagonal or
// -1.
py::tuple verdicts(const Source& source, const py::object& shifts_mm) {
  ShiftBlocks blocks(shifts_mm, *source);
  const auto sheets = static_cast<py::ssize_t>(blocks.sheets());
  py::array_t<double> deploys_from_deg(sheets);
  py::array_t<std::uint8_t> fault(sheets);
  py::array_t<std::int32_t> where(sheets);
  const double sample_deg = source->sheet.sampling.sample_deg;
  double* const to_deg = deploys_from_deg.mutable_data();
  std::uint8_t* const to_fault = fault.mutable_data();
  std::int32_t* const to_where = where.mutable_data();
  judge_all(
      key_for(source, blocks, 0), blocks,
      [&](DecisionStream& stream, const Draws& block) {
        const std::vector<solver::Verdict>& judged = stream.judge(block.shifts);
        for (std::size_t k = 0; k < block.size(); ++k) {
          const std::uint64_t at = block.numbers[k];
          to_deg[at] = judged[k].deploys_from_sample * sample_deg;
          to_fault[at] = static_cast<std::uint8_t>(judged[k].first_fault);
          to_where[at] = judged[k].where;
        }
      },
      [](DecisionStream&) {});
  return py::make_tuple(deploys_from_deg, fault, where);
}

// Returns the names of faults by their numbers in verdicts.
py::tuple fault_names() {
  py::tuple names(solver::fault_table().size());
  for (const solver::FaultEntry& entry : solver::fault_table()) {
    names[static_cast<std::size_t>(entry.fault)] = py::str(entry.name);
  }
  return names;
}

}  // namespace

void bind_judging(py::module_& module) {
  module.attr("faults") = fault_names();
  module.def("judged_by", &judged_by, "sheet"_a.none(false), "accept"_a);
  module.def("accepted", &accepted, "sheet"_a.none(false), "shifts_mm"_a, "threshold_deg"_a);
  module.def("verdicts", &verdicts, "sheet"_a.none(false), "shifts_mm"_a);
}

}  // namespace misalign::search::python
