// Blocks from their corners: planes, mass, centre, principal axes and moments.
#pragma once

#include <utility>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// A convex block of given corners (m) and faces, each a list of corners counter-clockwise from outside. Mass and
// moments are exact integrals over the tetrahedra below the faces. The principal axes are those of the integral; `axes`
// states them if they are known, since those of a cube are any. Throws std::invalid_argument if a face is not flat
// within 1e-9 of the block's size, or if a corner is outside a face.
Solid solid(std::string name, double density, std::vector<Point> vertices, std::vector<std::vector<int>> faces,
            const std::optional<Axes>& axes = {});

// A box between two corners, its edges along the axes of the world.
Solid box(std::string name, double density, const Point& least, const Point& greatest);

// A prism along y from -depth/2 to depth/2 over a polygon (x, z), counter-clockwise seen from -y with z up.
Solid prism(std::string name, double density, const std::vector<std::pair<double, double>>& polygon, double depth);

// A prism along x over a polygon (y, z), counter-clockwise seen from +x.
Solid prism_along_x(std::string name, double density, const std::vector<std::pair<double, double>>& polygon,
                    double length);

// The same block turned about a point; velocity and spin turn with it.
Solid turned(Solid block, const Eigen::Quaterniond& turn, const Point& about = Point::Zero());

}  // namespace voussoir::problems
