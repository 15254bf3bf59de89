#include "symbolic/search/independent_monomials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "symbolic/search/modular/echelon.hpp"
#include "symbolic/search/modular/reconstruct.hpp"

namespace casimir::search {
namespace {

class MonomialChoice {
 public:
  MonomialChoice(const System& system, const Fields& fields, const MonomialList& list,
                 const Modulus& modulus, const Point& constants, Samples& samples,
                 const Watch& watch)
      : system_(system),
        fields_(fields),
        list_(list.monomials),
        limits_(list.limits),
        modulus_(modulus),
        constants_(constants),
        samples_(samples),
        watch_(watch),
        grading_(system, fields),
        result_{Monomials(list_.variables()), {}, true} {}

  IndependentMonomials run();

 private:
  struct Part {
    std::vector<std::uint32_t> kept, fresh;  ///< places in the list
  };
  bool follows(std::uint32_t c) const;
  bool leads_within_limits(const std::vector<std::uint32_t>& columns,
                           const std::vector<Residue>& combination, std::uint32_t lead) const;
  void settle(Part& part);
  bool is_proved(const std::vector<std::uint32_t>& columns,
                 const std::vector<Residue>& combination);

  const System& system_;
  const Fields& fields_;
  const Monomials& list_;
  const std::vector<DegreeLimit>& limits_;
  const Modulus& modulus_;
  const Point& constants_;
  Samples& samples_;
  const Watch& watch_;
  Grading grading_;
  std::map<std::vector<std::int64_t>, Part> parts_;
  std::vector<std::uint32_t> leading_;  ///< of combinations that are zero
  IndependentMonomials result_;
};

/// Whether it is a multiple of a leading monomial.
bool MonomialChoice::follows(std::uint32_t c) const {
  return std::ranges::any_of(leading_, [&](std::uint32_t own) {
    for (std::size_t i = 0; i < list_.variables(); ++i)
      if (list_[own][i] > list_[c][i]) return false;
    return true;
  });
}

/// Whether no monomial of a combination is higher than its leading one by any of the limits.
bool MonomialChoice::leads_within_limits(const std::vector<std::uint32_t>& columns,
                                         const std::vector<Residue>& combination,
                                         std::uint32_t lead) const {
  return std::ranges::all_of(limits_, [&](const DegreeLimit& limit) {
    const int highest = limit.of(list_[lead]);
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (combination[k] != 0 && limit.of(list_[columns[k]]) > highest) return false;
    return true;
  });
}

/// That it is zero as a function, with symbols for the parameters.
bool MonomialChoice::is_proved(const std::vector<std::uint32_t>& columns,
                               const std::vector<Residue>& combination) {
  Monomials support(list_.variables());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::uint8_t* own = list_[columns[k]];
    if (combination[k] != 0) support.add({own, own + list_.variables()}, 0);
  }
  const std::optional<Polynomial> f = reconstruct_from_values(
      system_, fields_, Samples::Goal::zero, support, system_.parameters(), watch_);
  // The last monomial has to be in it, as other combinations say nothing of that.
  if (!f) return false;
  const auto last = std::ranges::find_if(combination.rbegin(), combination.rend(),
                                         [](Residue r) { return r != 0; });
  const std::uint32_t lead = columns[static_cast<std::size_t>(combination.rend() - last) - 1];
  const auto has_lead = std::ranges::any_of(f->term_list(), [&](const auto& term) {
    for (std::size_t i = 0; i < list_.variables(); ++i)
      if (term.second[fields_.places[i]] != list_[lead][i]) return false;
    return true;
  });
  return has_lead && system_.is_zero_function(*f);
}

/// Keeps of what is new in a part what is independent of the rest.
void MonomialChoice::settle(Part& part) {
  constexpr std::size_t kMore = 8;
  std::vector<std::uint32_t> columns = part.kept;
  columns.insert(columns.end(), part.fresh.begin(), part.fresh.end());
  check_memory_of_values(columns.size(), watch_);
  if (!samples_.draw(columns.size() + kMore, &constants_, {}, watch_))
    throw ModelError("no points of the functions were found modulo a prime");
  const Echelon echelon(
      modulus_,
      samples_.rows(Samples::Goal::zero, list_, columns, fields_.places, columns.size() + kMore),
      columns.size(), watch_);
  std::vector<bool> leaves(columns.size(), false);
  if (echelon.nullity() > 0) {
    for (const std::vector<Residue>& combination : echelon.null_basis()) {
      std::size_t lead = combination.size() - 1;
      while (combination[lead] == 0) --lead;
      if (lead < part.kept.size()) continue;
      leaves[lead] = is_proved(columns, combination);
      if (!leaves[lead])
        result_.complete = false;
      else if (leads_within_limits(columns, combination, columns[lead]))
        leading_.push_back(columns[lead]);
    }
  }
  for (std::size_t k = part.kept.size(); k < columns.size(); ++k)
    if (!leaves[k]) part.kept.push_back(columns[k]);
  part.fresh.clear();
}

IndependentMonomials MonomialChoice::run() {
  for (std::uint32_t c = 0; c < list_.size();) {
    const int degree = list_.degree(c);
    for (; c < list_.size() && list_.degree(c) == degree; ++c)
      if (!follows(c)) parts_[grading_.part_of(list_[c])].fresh.push_back(c);
    for (auto& [key, part] : parts_)
      if (!part.fresh.empty()) settle(part);
  }
  std::vector<std::uint32_t> all;
  for (const auto& [key, part] : parts_) all.insert(all.end(), part.kept.begin(), part.kept.end());
  std::ranges::sort(all);
  std::map<std::uint32_t, std::uint32_t> column;
  for (const std::uint32_t c : all) {
    column.emplace(c, static_cast<std::uint32_t>(result_.monomials.size()));
    result_.monomials.add({list_[c], list_[c] + list_.variables()}, list_.degree(c));
  }
  for (const auto& [key, part] : parts_) {
    if (part.kept.empty()) continue;
    result_.parts.emplace_back();
    for (const std::uint32_t c : part.kept) result_.parts.back().push_back(column.at(c));
  }
  std::ranges::sort(result_.parts);  // by their first columns
  return std::move(result_);
}

}  // namespace

void check_memory_of_values(std::size_t functions, const Watch& watch) {
  const auto own = static_cast<double>(functions);
  const double bytes = 2. * sizeof(Entry) * own * own;  // and the elimination
  if (bytes <= watch.memory_limit) return;
  throw TooMuchWork(
      fmt::format("the values of {} functions would take {:.1f} GB, more than the limit of "
                  "{:.1f} GB",
                  functions, bytes / 1e9, watch.memory_limit / 1e9));
}

IndependentMonomials independent_monomials(const System& system, const Fields& fields,
                                           const MonomialList& list, const Modulus& modulus,
                                           const Point& constants, Samples& samples,
                                           const Watch& watch) {
  return MonomialChoice(system, fields, list, modulus, constants, samples, watch).run();
}

}  // namespace casimir::search
