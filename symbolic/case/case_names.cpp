#include "symbolic/case/case_names.hpp"

#include <fmt/format.h>

#include "symbolic/case/limits.hpp"

namespace casimir {

void CaseNames::declare(const Text& name, const std::string& what, Quantity quantity) {
  check_name(name, what);
  if (table_.contains(name.value) || pending_.contains(name.value)) {
    throw name.error(fmt::format("'{}' is declared twice", name.value));
  }
  table_[name.value] = std::move(quantity);
}

void CaseNames::define(const Entry& entry) {
  check_name(entry.first, "a definition");
  if (table_.contains(entry.first.value)) {
    throw entry.first.error(fmt::format("'{}' is declared twice", entry.first.value));
  }
  pending_[entry.first.value] = &entry;
}

void CaseNames::name_function(const Text& name, const Quantity& quantity) {
  const Quantity* known = find(name.value);
  if (known == nullptr) {
    table_[name.value] = quantity;
  } else if (!known->value.is_equal(quantity.value)) {
    throw name.error(
        fmt::format("'{}' is declared twice, and the two are not the same", name.value), 0,
        "a function may share a name only with what it is, as in F = \"F\"");
  }
}

const Quantity* CaseNames::find(const std::string& name) {
  const auto known = table_.find(name);
  if (known != table_.end()) return &known->second;
  const auto waiting = pending_.find(name);
  if (waiting == pending_.end()) return nullptr;
  const Entry& entry = *waiting->second;
  if (open_.contains(name) || static_cast<double>(open_.size()) > limits_.nesting / 2) {
    const bool itself = open_.contains(name);
    throw entry.second.error(fmt::format("the definition of '{}' {}", name,
                                         itself ? "uses itself" : "is nested too deep"),
                             0, itself ? "" : limits_.hint(&Limits::nesting),
                             itself ? nullptr : &Limits::nesting);
  }
  open_.insert(name);
  Quantity value = parse_expression(entry.second, *this);
  open_.erase(name);
  return &(table_[name] = std::move(value));
}

std::vector<std::string> CaseNames::known() const {
  std::vector<std::string> names;
  for (const auto& [name, quantity] : table_) names.push_back(name);
  for (const auto& [name, entry] : pending_) names.push_back(name);
  return names;
}

ExtendedNames::ExtendedNames(Scope& base, const std::vector<GiNaC::symbol>& extra)
    : base_(base), extra_(base.limits()) {
  for (const GiNaC::symbol& s : extra) extra_.add(s.get_name(), Quantity::symbol(s));
}

const Quantity* ExtendedNames::find(const std::string& name) {
  const Quantity* own = extra_.find(name);
  return own != nullptr ? own : base_.find(name);
}

std::vector<std::string> ExtendedNames::known() const {
  std::vector<std::string> names = base_.known();
  for (const std::string& name : extra_.known()) names.push_back(name);
  return names;
}

}  // namespace casimir
