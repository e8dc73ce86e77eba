// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

#include "unit/wall_follower/plan_world.hpp"

namespace hallway::wall_follower {

/// A plan and where the robot begins in it.
struct Scene {
  Plan plan;
  Place start;
};

/// An empty room of 5 m by 4 m.
inline Scene room() {
  return {Plan().box(0, 0, 5, 4), {{1.0, 0.6}, 0.0}};
}

/// A room with a block in its middle, which the robot has on its right.
inline Scene block() {
  return {Plan().box(0, 0, 20, 20).box(8, 8, 12, 11), {{9.0, 7.5}, std::numbers::pi}};
}

/// A hallway of 1.6 m round a block.
inline Scene ring() {
  return {Plan().box(1.6, 1.6, 9.6, 7.6).box(0, 0, 11.2, 9.2), {{3.0, 1.0}, std::numbers::pi}};
}

/// A hallway round a block, with two rooms in its southern wall and one in its eastern one, which the robot has on its right.
inline Scene doors() {
  Plan plan;
  plan.box(1.6, 1.6, 9.6, 7.6);
  plan.line({{4.5, -0.1},
             {4.5, -2.6},
             {0.5, -2.6},
             {0.5, -0.1},
             {2, -0.1},
             {2, 0},
             {0, 0},
             {0, 9.2},
             {11.2, 9.2},
             {11.2, 3.9}});
  plan.line({{11.2, 3.9},
             {11.3, 3.9},
             {11.3, 5},
             {13.5, 5},
             {13.5, 2},
             {11.3, 2},
             {11.3, 3},
             {11.2, 3},
             {11.2, 0},
             {6.9, 0}});
  plan.line({{6.9, 0},
             {6.9, -0.1},
             {9, -0.1},
             {9, -2.6},
             {5, -2.6},
             {5, -0.1},
             {6, -0.1},
             {6, 0},
             {2.9, 0},
             {2.9, -0.1},
             {4.5, -0.1}});
  return {plan, {{1.0, 0.6}, 0.0}};
}

/// A hallway round a block, with a room whose doorway is entered from the hallway, since the wall behind it stands back by 0.6 m, and passed from within.
inline Scene trap() {
  return {Plan()
              .ring({{0, 0},
                     {5, 0},
                     {5, -0.7},
                     {3, -0.7},
                     {3, -3.5},
                     {8, -3.5},
                     {8, -0.7},
                     {6.1, -0.7},
                     {6.1, -0.6},
                     {11, -0.6},
                     {11, 8},
                     {4, 8},
                     {4, 7.8},
                     {2.5, 7.8},
                     {2.5, 8},
                     {0, 8}})
              .box(2, 1.8, 9.2, 6.2),
          {{1.0, 0.6}, 0.0}};
}

/// A room whose walls stagger by up to 0.3 m.
inline Scene staggered() {
  return {Plan().ring({{0, 0},    {2, 0}, {2, 0.3}, {3.5, 0.3}, {3.5, 0},   {5, 0},   {5, -0.3},
                       {6, -0.3}, {6, 0}, {7, 0},   {7, 0.2},   {8.5, 0.2}, {8.5, 0}, {10, 0},
                       {10, 6},   {4, 6}, {4, 5.7}, {2, 5.7},   {2, 6},     {0, 6}}),
          {{1.0, 0.6}, 0.0}};
}

/// Two hallways at a right angle, each with a dead end.
inline Scene dead_ends() {
  return {Plan().ring({{0, 0}, {8, 0}, {8, 1.4}, {1.4, 1.4}, {1.4, 5}, {0, 5}}), {{1.0, 0.5}, 0.0}};
}

/// A room with a thin wall that ends in its middle.
inline Scene ending_wall() {
  return {Plan().ring({{0, 0}, {5, 0}, {5, 4}, {5.1, 4}, {5.1, 0}, {9, 0}, {9, 7}, {0, 7}}),
          {{1.0, 0.6}, 0.0}};
}

/// A room with two dark cabinets at its walls.
inline Scene cabinets() {
  return {Plan().box(0, 0, 8, 6).box(3, 0, 4, 0.45, true).box(7.6, 3, 8, 4, true), {{1.0, 0.6}, 0.0}};
}

/// A room that looks the same from its other side: half of the way round reads like the other half.
inline Scene symmetric() {
  return {Plan().ring({{0, 0},
                       {2, 0},
                       {2, -0.2},
                       {4, -0.2},
                       {4, 0},
                       {8, 0},
                       {8, 5},
                       {6, 5},
                       {6, 5.2},
                       {4, 5.2},
                       {4, 5},
                       {0, 5}}),
          {{1.0, 0.6}, 0.0}};
}

}  // namespace hallway::wall_follower
