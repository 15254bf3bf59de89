#include "symbolic/search/newton_faces.hpp"

#include <algorithm>
#include <numeric>
#include <random>

namespace casimir::search {
namespace {

/// All vectors with entries from -most to most.
std::vector<std::vector<long>> cube(std::size_t dimension, long most) {
  std::vector<std::vector<long>> result{{}};
  for (std::size_t i = 0; i < dimension; ++i) {
    std::vector<std::vector<long>> longer;
    for (const std::vector<long>& own : result) {
      for (long e = -most; e <= most; ++e) {
        longer.push_back(own);
        longer.back().push_back(e);
      }
    }
    result = std::move(longer);
  }
  return result;
}

/// Any list will do: more directions say more.
std::vector<std::vector<long>> directions(std::size_t dimension) {
  constexpr std::size_t kFew = 3, kSome = 6;
  constexpr int kRandom = 200;
  std::vector<std::vector<long>> result;
  if (dimension <= kFew)
    result = cube(dimension, 3);
  else if (dimension <= kSome)
    result = cube(dimension, 1);
  std::mt19937 random(3);
  for (int k = 0; k < kRandom; ++k) {
    result.emplace_back();
    for (std::size_t i = 0; i < dimension; ++i)
      result.back().push_back(static_cast<long>(random() % 19) - 9);
  }
  for (const long all : {1L, -1L}) result.emplace_back(dimension, all);
  for (std::size_t i = 0; i < dimension; ++i) {
    for (const long own : {1L, -1L}) {
      result.emplace_back(dimension, 0);
      result.back()[i] = own;
    }
  }
  return result;
}

}  // namespace

long product(const std::vector<long>& w, const std::vector<long>& a) {
  return std::inner_product(w.begin(), w.end(), a.begin(), 0L);
}

bool NewtonFaces::Face::contains(const Vector& a) const { return product(direction, a) == height; }

NewtonFaces::NewtonFaces(const std::vector<Polynomial>& field, std::size_t dimension) {
  for (std::size_t i = 0; i < dimension; ++i) {
    const PolynomialRing& ring = field[i].ring();
    for (auto [number, exponents] : field[i].term_list()) {
      Vector a;
      for (std::size_t k = 0; k < dimension; ++k) {
        a.push_back(static_cast<long>(exponents[k]) - (k == i ? 1 : 0));
        exponents[k] = 0;
      }
      TermCollector coefficient(ring);
      coefficient.add(number, exponents);
      const auto own =
          terms_.try_emplace(a, std::vector<Polynomial>(dimension, Polynomial(ring))).first;
      own->second[i] += coefficient.finish();
    }
  }
  for (const Vector& w : directions(dimension)) add_direction(w);
}

void NewtonFaces::add_direction(const Vector& w) {
  std::vector<Vector> highest;
  long height = 0;
  for (const auto& [a, field] : terms_) {
    const long own = product(w, a);
    if (!highest.empty() && own < height) continue;
    if (own > height) highest.clear();
    if (highest.empty()) height = own;
    highest.push_back(a);
  }
  if (highest.empty()) return;
  all_.push_back({w, height});
  if (highest.size() == 1)
    vertices_.push_back(highest[0]);
  else if (highest.size() < terms_.size() && known_.emplace(highest, faces_.size()).second)
    faces_.push_back(all_.back());
}

bool NewtonFaces::allows(const Vector& monomial) const {
  return std::ranges::all_of(
      all_, [&](const Face& face) { return product(face.direction, monomial) <= face.height; });
}

const std::vector<Polynomial>* NewtonFaces::vertex(const Vector& a) const {
  if (std::ranges::find(vertices_, a) == vertices_.end()) return nullptr;
  return &terms_.at(a);
}

}  // namespace casimir::search
