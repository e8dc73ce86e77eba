// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "contact/separation.hpp"
#include "contact/shape.hpp"

namespace hallway::contact {

/// Where a body is against a triangle: the corners of what both have within 1 mm of a contact's plane, convex, in the world frame. Of a contact at a
/// corner the point alone, at an edge the ends of the common part; of a body with flat sides at a wall an area. Of a cylinder it is the line along its
/// side. Never empty. O(n log n) in the body's vertices.
/// @param pose    T_world_body
/// @param point   of the contact, on the body
/// @param normal  of the contact, unit, from the triangle to the body
std::vector<Vec3> contact_patch(const BodyShape& shape, const Pose& pose, const Triangle& triangle,
                                const Vec3& point, const Vec3& normal);

}  // namespace hallway::contact
