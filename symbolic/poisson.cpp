#include "symbolic/poisson.hpp"

#include <fmt/format.h>

#include "symbolic/error.hpp"

namespace casimir {

PoissonStructure::PoissonStructure(std::vector<GiNaC::symbol> coordinates,
                                   std::vector<GiNaC::ex> upper)
    : coordinates_(std::move(coordinates)), upper_(std::move(upper)) {
  const std::size_t n = coordinates_.size();
  if (upper_.size() != n * (n - 1) / 2) {
    throw ModelError(fmt::format("{} coordinates need {} brackets, {} given", n, n * (n - 1) / 2,
                                 upper_.size()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (coordinates_[i].is_equal(coordinates_[j])) {
        throw ModelError(
            fmt::format("the coordinate {} is listed twice", coordinates_[i].get_name()));
      }
    }
  }
}

GiNaC::ex PoissonStructure::operator()(std::size_t i, std::size_t j) const {
  if (i == j) return 0;
  if (i > j) return -(*this)(j, i);
  const std::size_t n = dimension();
  return upper_[i * n - i * (i + 1) / 2 + (j - i - 1)];
}

GiNaC::ex PoissonStructure::bracket(const GiNaC::ex& f, const GiNaC::ex& g) const {
  GiNaC::ex sum = 0;
  const std::vector<GiNaC::ex> field = flow(g);
  for (std::size_t i = 0; i < dimension(); ++i) sum += f.diff(coordinates_[i]) * field[i];
  return sum;
}

std::vector<GiNaC::ex> PoissonStructure::flow(const GiNaC::ex& h) const {
  const std::size_t n = dimension();
  std::vector<GiNaC::ex> gradient;
  for (const GiNaC::symbol& x : coordinates_) gradient.push_back(h.diff(x));
  std::vector<GiNaC::ex> field(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (!gradient[j].is_zero()) field[i] += (*this)(i, j) * gradient[j];
    }
  }
  return field;
}

GiNaC::ex PoissonStructure::jacobi_defect(std::size_t i, std::size_t j, std::size_t k) const {
  const auto cyclic = [&](std::size_t a, std::size_t b, std::size_t c) {
    const GiNaC::ex inner = (*this)(b, c);
    GiNaC::ex sum = 0;
    for (std::size_t l = 0; l < dimension(); ++l) {
      const GiNaC::ex slope = inner.diff(coordinates_[l]);
      if (!slope.is_zero()) sum += (*this)(a, l) * slope;
    }
    return sum;
  };
  return cyclic(i, j, k) + cyclic(j, k, i) + cyclic(k, i, j);
}

}  // namespace casimir
