// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace hallway {

/// Sign (-1, 0, 1) of the determinant of three rows of three, in exact arithmetic on the finite doubles given.
int sign_of_determinant(const std::array<std::array<double, 3>, 3>& rows);
/// The same for four rows of four.
int sign_of_determinant(const std::array<std::array<double, 4>, 4>& rows);

/// The x of the three equations row[0] x[0] + row[1] x[1] + row[2] x[2] = row[3] on the finite doubles given, computed exactly and
/// rounded once, towards zero. Their left sides must be linearly independent.
std::array<double, 3> exact_solution(const std::array<std::array<double, 4>, 3>& rows);

}  // namespace hallway
