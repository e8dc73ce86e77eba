// SPDX-License-Identifier: MIT
#include "geom/exact_sign.hpp"

#include <gmp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hallway {
namespace {

/// A whole number of any length.
class Whole {
 public:
  Whole() { mpz_init(value_); }
  ~Whole() { mpz_clear(value_); }
  Whole(const Whole&) = delete;
  Whole& operator=(const Whole&) = delete;
  mpz_ptr get() { return value_; }
  mpz_srcptr get() const { return value_; }

 private:
  mpz_t value_;
};

template <std::size_t Rows, std::size_t Columns = Rows>
using Matrix = std::array<std::array<Whole, Columns>, Rows>;

/// The exponent of the last bit of a number's 53.
int last_bit(double value) {
  return std::ilogb(value) - std::numeric_limits<double>::digits + 1;
}

/// Each row times the power of two that makes all its numbers whole: the determinant keeps its sign.
template <std::size_t Rows, std::size_t Columns>
void set_rows(Matrix<Rows, Columns>& matrix, const std::array<std::array<double, Columns>, Rows>& rows) {
  for (std::size_t i = 0; i < Rows; ++i) {
    int least = std::numeric_limits<int>::max();
    for (const double value : rows[i]) {
      if (value != 0.0) least = std::min(least, last_bit(value));
    }
    for (std::size_t j = 0; j < Columns; ++j) {
      if (rows[i][j] == 0.0) continue;  // as it is
      // Not scaled in one step: numbers of very different magnitude would overflow.
      const int own = last_bit(rows[i][j]);
      mpz_set_d(matrix[i][j].get(), std::scalbn(rows[i][j], -own));
      mpz_mul_2exp(matrix[i][j].get(), matrix[i][j].get(), static_cast<mp_bitcnt_t>(own - least));
    }
  }
}

/// out = the minor of rows (r0, r1) and columns (c0, c1).
template <typename Rows>
void minor2(Whole& out, const Rows& m, std::size_t r0, std::size_t r1, std::size_t c0, std::size_t c1) {
  mpz_mul(out.get(), m[r0][c0].get(), m[r1][c1].get());
  mpz_submul(out.get(), m[r0][c1].get(), m[r1][c0].get());
}

/// out = the determinant of three columns.
template <typename Rows>
void determinant3(Whole& out, const Rows& m, std::size_t c0, std::size_t c1, std::size_t c2) {
  Whole minor;
  minor2(minor, m, 1, 2, c1, c2);
  mpz_mul(out.get(), m[0][c0].get(), minor.get());
  minor2(minor, m, 1, 2, c0, c2);
  mpz_submul(out.get(), m[0][c1].get(), minor.get());
  minor2(minor, m, 1, 2, c0, c1);
  mpz_addmul(out.get(), m[0][c2].get(), minor.get());
}

/// The quotient as a double, rounded towards zero.
double quotient(const Whole& numerator, const Whole& denominator) {
  mpq_t value;
  mpq_init(value);
  mpq_set_num(value, numerator.get());
  mpq_set_den(value, denominator.get());
  mpq_canonicalize(value);
  const double result = mpq_get_d(value);
  mpq_clear(value);
  return result;
}

}  // namespace

int sign_of_determinant(const std::array<std::array<double, 3>, 3>& rows) {
  Matrix<3> m;
  set_rows(m, rows);
  Whole value;
  determinant3(value, m, 0, 1, 2);
  return mpz_sgn(value.get());
}

std::array<double, 3> exact_solution(const std::array<std::array<double, 4>, 3>& rows) {
  Matrix<3, 4> m;
  set_rows(m, rows);
  // Cramer's rule; a row's scale is that of both sides of its equation.
  Whole all, x, y, z;
  determinant3(all, m, 0, 1, 2);
  determinant3(x, m, 3, 1, 2);
  determinant3(y, m, 0, 3, 2);
  determinant3(z, m, 0, 1, 3);
  return {quotient(x, all), quotient(y, all), quotient(z, all)};
}

int sign_of_determinant(const std::array<std::array<double, 4>, 4>& rows) {
  Matrix<4> m;
  set_rows(m, rows);
  // Laplace expansion over pairs of rows: minors of rows 0, 1 times the complementary minors of rows 2, 3.
  struct Term {
    std::size_t c0, c1, d0, d1;
    int sign;
  };
  constexpr std::array<Term, 6> kTerms{{{0, 1, 2, 3, 1},
                                        {0, 2, 1, 3, -1},
                                        {0, 3, 1, 2, 1},
                                        {1, 2, 0, 3, 1},
                                        {1, 3, 0, 2, -1},
                                        {2, 3, 0, 1, 1}}};
  Whole sum, upper, lower;
  for (const Term& term : kTerms) {
    minor2(upper, m, 0, 1, term.c0, term.c1);
    minor2(lower, m, 2, 3, term.d0, term.d1);
    if (term.sign > 0) {
      mpz_addmul(sum.get(), upper.get(), lower.get());
    } else {
      mpz_submul(sum.get(), upper.get(), lower.get());
    }
  }
  return mpz_sgn(sum.get());
}

}  // namespace hallway
