// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace hallway {

/// Sign (-1, 0, 1) of the determinant of three rows of three, in exact arithmetic on the finite doubles given.
int sign_of_determinant(const std::array<std::array<double, 3>, 3>& rows);
/// The same for four rows of four.
int sign_of_determinant(const std::array<std::array<double, 4>, 4>& rows);

}  // namespace hallway
