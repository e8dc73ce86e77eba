// SPDX-License-Identifier: MIT
#include "geom/exact_sign.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "support/random_doubles.hpp"

namespace hallway {
namespace {

template <std::size_t N>
using Rows = std::array<std::array<double, N>, N>;

/// By elimination in fractions, which the code under test does not do.
template <std::size_t N>
int sign_by_elimination(const Rows<N>& rows) {
  std::array<std::array<mpq_class, N>, N> m;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t k = 0; k < N; ++k) m[i][k] = mpq_class(rows[i][k]);
  }
  int sign = 1;
  for (std::size_t column = 0; column < N; ++column) {
    std::size_t pivot = column;
    while (pivot < N && sgn(m[pivot][column]) == 0) ++pivot;
    if (pivot == N) return 0;
    if (pivot != column) {
      std::swap(m[pivot], m[column]);
      sign = -sign;
    }
    sign *= sgn(m[column][column]);
    for (std::size_t i = column + 1; i < N; ++i) {
      const mpq_class factor = m[i][column] / m[column][column];
      for (std::size_t k = column; k < N; ++k) m[i][k] -= factor * m[column][k];
    }
  }
  return sign;
}

/// Rows of which the last is nearly, or exactly, a sum of the others.
template <std::size_t N>
Rows<N> nearly_singular(std::mt19937_64& random, bool exactly) {
  Rows<N> rows{};
  std::array<double, N> sum{};
  for (std::size_t i = 0; i + 1 < N; ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      rows[i][k] = exactly ? static_cast<double>(static_cast<int>(random() % 21) - 10)
                           : std::uniform_real_distribution<double>(-1.0, 1.0)(random);
      sum[k] += rows[i][k];
    }
  }
  rows[N - 1] = sum;
  return rows;
}

template <std::size_t N>
void compare_many(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  int zeros = 0;
  for (int round = 0; round < 3000; ++round) {
    const Rows<N> rows = nearly_singular<N>(random, round % 2 == 0);
    const int wanted = sign_by_elimination<N>(rows);
    zeros += wanted == 0 ? 1 : 0;
    ASSERT_EQ(sign_of_determinant(rows), wanted) << "round " << round;
  }
  EXPECT_GE(zeros, 1500) << "whole rows add up exactly";
  EXPECT_LT(zeros, 3000) << "rounded ones do not";
}

TEST(ExactSign, OfThreeRowsThatNearlyDepend) {
  compare_many<3>(1);
}

TEST(ExactSign, OfFourRowsThatNearlyDepend) {
  compare_many<4>(2);
}

TEST(ExactSign, OfNumbersOfEveryMagnitude) {
  const auto values = test::random_doubles(900, 3);
  for (std::size_t i = 0; i + 16 <= values.size(); i += 16) {
    Rows<4> four{};
    Rows<3> three{};
    for (std::size_t k = 0; k < 16; ++k) four[k / 4][k % 4] = values[i + k];
    for (std::size_t k = 0; k < 9; ++k) three[k / 3][k % 3] = values[i + k];
    ASSERT_EQ(sign_of_determinant(four), sign_by_elimination<4>(four)) << "from value " << i;
    ASSERT_EQ(sign_of_determinant(three), sign_by_elimination<3>(three)) << "from value " << i;
  }
}

TEST(ExactSign, OrientationAndZeros) {
  EXPECT_EQ(sign_of_determinant(Rows<3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}), 1);
  EXPECT_EQ(sign_of_determinant(Rows<3>{{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}), -1);
  EXPECT_EQ(sign_of_determinant(Rows<3>{{{1, 2, 3}, {0, 0, 0}, {4, 5, 6}}}), 0);
  EXPECT_EQ(sign_of_determinant(Rows<3>{{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {4, 5, 6}}}), 0);
  // 0.1 + 0.2 is not the double 0.3
  EXPECT_EQ(sign_of_determinant(Rows<3>{{{0.1 + 0.2, 1, 0}, {0.3, 1, 0}, {0, 0, 1}}}), 1);
}

TEST(ExactSolution, SatisfiesEquationsThatNearlyDepend) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1000.0, 1000.0);
  for (int round = 0; round < 2000; ++round) {
    std::array<std::array<double, 4>, 3> rows{};
    for (auto& row : rows) {
      for (double& value : row) value = number(random);
    }
    const double off = std::pow(10.0, -1.0 - round % 14);
    for (std::size_t k = 0; k < 3; ++k) rows[1][k] = rows[0][k] + off * number(random);
    const Rows<3> left{{{rows[0][0], rows[0][1], rows[0][2]},
                        {rows[1][0], rows[1][1], rows[1][2]},
                        {rows[2][0], rows[2][1], rows[2][2]}}};
    if (sign_of_determinant(left) == 0) continue;
    const auto x = exact_solution(rows);
    for (const auto& row : rows) {
      // What is left comes from rounding x alone: less than a last bit of each term.
      mpq_class rest(-row[3]), bound(0);
      for (std::size_t k = 0; k < 3; ++k) {
        rest += mpq_class(row[k]) * mpq_class(x[k]);
        bound += abs(mpq_class(row[k]) * mpq_class(x[k])) / (mpz_class(1) << 52);
      }
      ASSERT_TRUE(abs(rest) <= bound) << "round " << round << ": " << mpq_class(abs(rest)).get_d();
    }
  }
}

}  // namespace
}  // namespace hallway
