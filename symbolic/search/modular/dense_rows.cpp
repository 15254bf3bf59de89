#include "symbolic/search/modular/dense_rows.hpp"

#include <algorithm>
#include <array>

// The inner loops, compiled for several instruction sets; the program chooses when it starts.
#if defined(__clang__)
#define CASIMIR_VECTORISED
#elif defined(__x86_64__) && defined(__gnu_linux__)
#define CASIMIR_VECTORISED \
  __attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))
#else
#define CASIMIR_VECTORISED
#endif

namespace casimir::search {
namespace {

constexpr std::size_t kTile = 512;  // columns of a tile: its sums stay in the first-level cache

/// sums[j] += sum_k factors[k] * rows[k * stride + j], four rows at a time.
CASIMIR_VECTORISED void add_products(std::uint64_t* sums, const Residue* factors,
                                     const Residue* rows, std::size_t stride, std::size_t count,
                                     std::size_t width) {
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    const std::uint64_t f0 = factors[k], f1 = factors[k + 1], f2 = factors[k + 2],
                        f3 = factors[k + 3];
    const Residue* r0 = rows + k * stride;
    const Residue* r1 = r0 + stride;
    const Residue* r2 = r1 + stride;
    const Residue* r3 = r2 + stride;
    for (std::size_t j = 0; j < width; ++j)
      sums[j] += f0 * r0[j] + f1 * r1[j] + f2 * r2[j] + f3 * r3[j];
  }
  for (; k < count; ++k) {
    const std::uint64_t f = factors[k];
    const Residue* r = rows + k * stride;
    for (std::size_t j = 0; j < width; ++j) sums[j] += f * r[j];
  }
}

/// Makes the sums smaller, modulo the prime: at most 2^61 + 2^32, where `power` is 2^32 modulo it.
CASIMIR_VECTORISED void fold(std::uint64_t* sums, std::uint64_t power, std::size_t width) {
  for (std::size_t j = 0; j < width; ++j)
    sums[j] = (sums[j] & 0xFFFFFFFFU) + (sums[j] >> 32) * power;
}

/// x += factor * y by Montgomery's reduction: `scaled` is the factor times 2^32 modulo the prime,
/// `inverse` is -1/prime modulo 2^32.
CASIMIR_VECTORISED void add_multiple(Residue* x, const Residue* y, std::uint64_t scaled,
                                     std::uint32_t inverse, std::uint32_t prime,
                                     std::size_t width) {
  for (std::size_t j = 0; j < width; ++j) {
    const std::uint64_t product = scaled * y[j];
    const std::uint64_t times = static_cast<std::uint32_t>(product) * inverse;
    auto sum = static_cast<std::uint32_t>((product + std::uint64_t{prime} * times) >> 32) + x[j];
    sum = std::min(sum, sum - prime);  // unsigned: the larger one is the wrapped one
    x[j] = std::min(sum, sum - prime);
  }
}

std::uint32_t montgomery_inverse(std::uint32_t prime) {
  std::uint32_t inverse = 1;
  for (int i = 0; i < 5; ++i) inverse *= 2 - prime * inverse;
  return 0 - inverse;
}

}  // namespace

void subtract_product(DenseRows& c, const DenseRows& a, const DenseRows& b,
                      const Modulus& modulus) {
  // 2^61 + 48 * 2^58 is below 2^64.
  constexpr std::size_t kBetweenFolds = 48;
  const std::uint64_t power = modulus.reduce(std::uint64_t{1} << 32);
  DenseRows factors(a.rows, a.columns);
  std::transform(a.entries.begin(), a.entries.end(), factors.entries.begin(),
                 [&](Residue r) { return modulus.negative(r); });
  std::array<std::uint64_t, kTile> sums{};
  for (std::size_t left = 0; left < c.columns; left += kTile) {
    const std::size_t width = std::min(kTile, c.columns - left);
    for (std::size_t i = 0; i < c.rows; ++i) {
      Residue* out = c.row(i) + left;
      std::copy(out, out + width, sums.begin());
      for (std::size_t k = 0; k < b.rows; k += kBetweenFolds) {
        if (k > 0) fold(sums.data(), power, width);
        add_products(sums.data(), factors.row(i) + k, b.row(k) + left, b.columns,
                     std::min(kBetweenFolds, b.rows - k), width);
      }
      for (std::size_t j = 0; j < width; ++j) out[j] = modulus.reduce(sums[j]);
    }
  }
}

std::vector<std::size_t> reduce_rows(DenseRows& matrix, const Modulus& modulus) {
  const std::uint32_t inverse = montgomery_inverse(modulus.prime());
  const Residue power = modulus.reduce(std::uint64_t{1} << 32);
  const auto add = [&](std::size_t to, std::size_t from, Residue factor) {
    add_multiple(matrix.row(to), matrix.row(from), modulus.multiply(factor, power), inverse,
                 modulus.prime(), matrix.columns);
  };
  std::vector<std::size_t> pivots;
  std::size_t done = 0;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    for (std::size_t k = 0; k < done; ++k) {
      const Residue factor = matrix.row(i)[pivots[k]];
      if (factor != 0) add(i, k, modulus.negative(factor));
    }
    const Residue* row = matrix.row(i);
    const Residue* first =
        std::find_if(row, row + matrix.columns, [](Residue r) { return r != 0; });
    if (first == row + matrix.columns) continue;
    const auto pivot = static_cast<std::size_t>(first - row);
    if (done != i) std::copy(row, row + matrix.columns, matrix.row(done));
    const Residue scale = modulus.inverse(matrix.row(done)[pivot]);
    for (std::size_t j = 0; j < matrix.columns; ++j)
      matrix.row(done)[j] = modulus.multiply(matrix.row(done)[j], scale);
    for (std::size_t k = 0; k < done; ++k) {
      const Residue factor = matrix.row(k)[pivot];
      if (factor != 0) add(k, done, modulus.negative(factor));
    }
    pivots.push_back(pivot);
    ++done;
  }
  matrix.rows = done;
  matrix.entries.resize(done * matrix.columns);
  return pivots;
}

DenseRows take_columns(DenseRows& matrix, const std::vector<std::size_t>& columns) {
  DenseRows taken(matrix.rows, columns.size());
  const std::size_t width = matrix.columns - columns.size();
  Residue* out = matrix.entries.data();
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    const Residue* row = matrix.entries.data() + i * matrix.columns;
    std::size_t from = 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      taken.row(i)[k] = row[columns[k]];
      // Forwards in place: what is read was not yet written over.
      out = std::copy(row + from, row + columns[k], out);
      from = columns[k] + 1;
    }
    out = std::copy(row + from, row + matrix.columns, out);
  }
  matrix.columns = width;
  matrix.entries.resize(matrix.rows * width);
  return taken;
}

}  // namespace casimir::search
