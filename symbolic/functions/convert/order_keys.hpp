#pragma once

#include <ginac/ginac.h>

#include <string>
#include <unordered_map>

namespace casimir::functions {

/// Orders expressions in the same way in every process. GiNaC orders terms and factors by memory
/// addresses; where generators are made, their numbers, and with them every printed text, would
/// depend on that.
class OrderKeys {
 public:
  void sort(GiNaC::exvector& operands);

 private:
  const std::string& key(const GiNaC::ex& e);
  std::string key_of_sum(const GiNaC::ex& sum);

  std::unordered_map<GiNaC::ex, std::string> keys_;
};

}  // namespace casimir::functions
