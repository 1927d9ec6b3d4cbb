#include "search/sheets/bought_springs.hpp"

#include <algorithm>

#include "search/sheets/deploy_input.hpp"
#include "search/sheets/studies.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::search {
namespace {

// Choices that are made until panels that bend leave the margin.
constexpr int kMostRounds = 16;
// Friction that is required beyond what bending panels take.
constexpr double kBeyond = 1.02, kMostAtOnce = 2;
// Largest permitted force after one that bends panels too much, as a share of it.
constexpr double kLessForce = 0.7;

class SpringBuyer {
 public:
  SpringBuyer(const solver::Sheet& sheet, const schema::Design& design, const BuyInput& input)
      : sheet_(sheet), design_(design), order_{input.table, {}, 0, 0, {}} {
    order_.friction_n_mm_per_mm = hinge_friction_n_mm_per_mm(design, sheet);
    order_.wanted_margin = design.static_margin.value_or(solver::kWantedMargin);
    options_.from_deg = design.from_deg;
    options_.to_deg = design.margin_to_deg.value_or(solver::kMarginTo_deg);
    options_.required_n_mm_per_mm = required_n_mm_per_mm();
    options_.pushes = input.pushes;
    options_.links = input.links;
    options_.links.largest_force_n = design.largest_force_n;
    options_.goal = input.goal;
    if (design.springs_on == solver::SpringsOn::one_a_hole) {
      options_.never_both = diagonals_of_one_hole(sheet.mechanism());
    }
  }

  schema::SpringOrder run() {
    choose();
    if (order_.choice.drives() && bends()) seek_margin();
    find_way();
    return std::move(order_);
  }

 private:
  void find_way() {
    if (!order_.choice.drives()) return;
    const double from_deg = order_.choice.from_deg;
    if (auto faces = solver::spring_faces(sheet_, *spring_bodies(design_bought()), from_deg)) {
      order_.way = *std::move(faces);
    }
  }

  double required_n_mm_per_mm() const {
    return order_.friction_n_mm_per_mm * (1 + order_.wanted_margin);
  }

  // Seeks springs that leave the margin where panels bend: it requires more of rigid panels while
  // that helps. Where more tension only bends them, it permits smaller forces, of more springs.
  void seek_margin() {
    const double first_n_mm_per_mm = options_.required_n_mm_per_mm;
    order_.bent_n_mm_per_mm = bent_friction();
    schema::SpringOrder best = order_;
    double before = 0;
    for (int round = 1; round < kMostRounds && !has_margin(best); ++round) {
      const double overcome = *order_.bent_n_mm_per_mm;
      const bool raises = overcome > before;
      if (raises) {
        const double lacks = overcome > 0 ? required_n_mm_per_mm() / overcome : kMostAtOnce;
        options_.required_n_mm_per_mm *= std::clamp(kBeyond * lacks, kBeyond, kMostAtOnce);
      } else {
        options_.required_n_mm_per_mm = first_n_mm_per_mm;
        options_.links.largest_force_n = kLessForce * largest_force_n();
      }
      before = raises ? overcome : 0;
      const schema::SpringOrder previous = order_;
      choose();
      if (order_.choice.drives()) {
        order_.bent_n_mm_per_mm = bent_friction();
      } else if (raises) {
        order_ = previous;
        before = overcome;
      } else {
        break;
      }
      if (order_.bent_n_mm_per_mm > best.bent_n_mm_per_mm) best = order_;
    }
    order_ = std::move(best);
  }

  bool has_margin(const schema::SpringOrder& order) const {
    return *order.bent_n_mm_per_mm >= required_n_mm_per_mm();
  }

  double largest_force_n() const {
    return std::ranges::max(order_.choice.springs, {}, &solver::StockedSpring::largest_force_n)
        .largest_force_n;
  }

  // Chooses again while springs touch. All have the largest diameter there, so that thinner ones
  // of a table with several might be placed where these are not.
  void choose() {
    order_.bent_n_mm_per_mm.reset();
    bool touch = false;
    do {
      order_.choice =
          value_or_throw(solver::choose_stock(sheet_, schema::springs_of(order_.table), options_),
                         sheet_.name(), "no springs are chosen");
      touch = order_.choice.drives() && forbid_touching();
      touched_ |= touch;
    } while (touch);
    const auto outer_mm = [](const schema::SpringRow& row) { return row.spring.outer_mm; };
    const auto [least, most] = std::ranges::minmax_element(order_.table, {}, outer_mm);
    if (touched_ && outer_mm(*least) < outer_mm(*most)) order_.choice.is_proven = false;
  }

  // Returns whether springs touch each other or panels; then they are not taken again.
  bool forbid_touching() {
    schema::Design with = design_bought();
    with.from_deg = std::min(order_.choice.from_deg, sheet_.deploys_from_deg());
    const auto study = solver::contact(sheet_, contact_options(with, {}, {}));
    if (!study || !study->springs) return false;  // D is 0, or the ends leave nothing of a spring
    for (const solver::SpringMeeting& met : study->springs->springs.touching) {
      options_.never_both.emplace_back(met.spring, met.other);
    }
    for (const solver::SpringMeeting& met : study->springs->panels.touching) {
      options_.barred.push_back(met.spring);
    }
    return !study->springs->springs.touching.empty() || !study->springs->panels.touching.empty();
  }

  schema::Design design_bought() const {
    return order_.design_with(design_, sheet_.base(), sheet_.mechanism());
  }

  bool bends() const {
    return order_.friction_n_mm_per_mm > 0 && design_.thickness_mm &&
           sheet_.base().springs.at_vertices();
  }

  double bent_friction() const {
    schema::Design with = design_bought();
    with.from_deg = order_.choice.from_deg;
    return bent_sheet(sheet_, deploy_options(with, sheet_), with, Advice::none)
        .panels.friction.static_n_mm_per_mm;
  }

  const solver::Sheet& sheet_;
  const schema::Design& design_;
  schema::SpringOrder order_;
  solver::StockOptions options_;
  bool touched_ = false;  // true: options_ bar springs that touch with the largest diameter
};

}  // namespace

std::optional<solver::StockGoal> goal_of_purchase(const std::string& name) {
  if (name == "types") return solver::StockGoal::fewest_types;
  if (name == "price") return solver::StockGoal::least_price;
  return {};
}

schema::SpringOrder bought_springs(const solver::Sheet& sheet, const schema::Design& design,
                                   const BuyInput& input) {
  return SpringBuyer(sheet, design, input).run();
}

schema::Json bought_pattern(const Subject& subject, const schema::SpringOrder& order) {
  const ChosenSheet& chosen = subject.chosen;
  const schema::Design bought =
      order.design_with(subject.model.design(), subject.sheet.base(), subject.sheet.mechanism());
  return schema::pattern_file_json(chosen.base, chosen.shifts_mm, chosen.sampling, bought,
                                   chosen.target);
}

}  // namespace misalign::search
