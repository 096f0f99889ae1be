// The exact referee's programs and vertices: cddlib with rational numbers.
#include "core/testing/exact_referee.hpp"

#include <algorithm>
#include <stdexcept>

// after GMP's C++ header: cddlib includes GMP's C header inside the block, where its overloads would fail
#define GMPRATIONAL
extern "C" {
#include <cddlib/setoper.h>
// after its own types
#include <cddlib/cdd.h>
}

namespace voussoir::exact {
namespace {

Rational dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational determinant(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// ---- cddlib ---------------------------------------------------------------------------------------------------------

// cddlib's constants live as long as the process
void prepare_cdd() {
  static const bool once = [] {
    dd_set_global_constants();
    return true;
  }();
  (void)once;
}

struct Matrix_ {
  dd_MatrixPtr p;
  Matrix_(std::size_t rows, int columns) {
    prepare_cdd();
    p = dd_CreateMatrix(static_cast<dd_rowrange>(rows), columns);
    p->representation = dd_Inequality;
  }
  ~Matrix_() { dd_FreeMatrix(p); }
  Matrix_(const Matrix_&) = delete;
  Matrix_& operator=(const Matrix_&) = delete;
  void set(std::size_t row, int column, const Rational& value) { mpq_set(p->matrix[row][column], value.get_mpq_t()); }
};

// rows [d, -a, 1]: d - a·x + s >= 0
void set_row(Matrix_& m, std::size_t row, const Plane& plane, int slack) {
  m.set(row, 0, plane.offset);
  for (int k = 0; k < 3; ++k)
    m.set(row, 1 + k, -plane.normal[k]);
  m.set(row, 4, slack);
}

Program solve(const Planes& planes, const Plane* joint) {
  if (planes.empty()) throw std::logic_error("no planes");
  Matrix_ m(planes.size() + (joint ? 1 : 0), 5);
  for (std::size_t i = 0; i < planes.size(); ++i)
    set_row(m, i, planes[i], 1);
  if (joint) {
    set_row(m, planes.size(), *joint, 0);
    set_addelem(m.p->linset, static_cast<long>(planes.size()) + 1);
  }
  m.p->objective = dd_LPmin;
  mpq_set_si(m.p->rowvec[4], 1, 1);
  dd_ErrorType error;
  dd_LPPtr lp = dd_Matrix2LP(m.p, &error);
  dd_LPSolve(lp, dd_DualSimplex, &error);
  Program result;
  const bool solved = error == dd_NoError;
  const dd_LPStatusType status = lp->LPS;
  if (solved && status == dd_Optimal) mpq_set(result.value.get_mpq_t(), lp->optvalue);
  dd_FreeLPData(lp);
  // s can always be raised, so the program is feasible: without an optimum it is unbounded
  result.bounded = status == dd_Optimal;
  if (!solved) throw std::logic_error("cddlib: no answer");
  return result;
}

}  // namespace

Program feasibility(const Planes& planes) {
  return solve(planes, nullptr);
}

Program section_feasibility(const Planes& planes, const Plane& joint) {
  return solve(planes, &joint);
}

ProgramBounds feasibility_bounds(const Planes& planes, const std::array<int, 4>& basis) {
  // multipliers: Σ λ a = 0, Σ λ = 1, by the determinants of the other three normals
  for (const int b : basis)
    if (b < 0) return {};
  std::array<Rational, 4> lambda;
  Rational sum = 0;
  for (int k = 0; k < 4; ++k) {
    std::array<int, 3> others;
    for (int j = 0, place = 0; j < 4; ++j)
      if (j != k) others[place++] = basis[j];
    lambda[k] = determinant(planes[others[0]].normal, planes[others[1]].normal, planes[others[2]].normal);
    if (k % 2) lambda[k] = -lambda[k];
    sum += lambda[k];
  }
  if (sgn(sum) == 0) return {};
  ProgramBounds bounds{true, 0, 0};
  for (int k = 0; k < 4; ++k) {
    lambda[k] /= sum;
    if (sgn(lambda[k]) < 0) return {};
    bounds.low -= lambda[k] * planes[basis[k]].offset;
  }
  // the point where the four hold with s = low: differences of their equations
  const Plane& last = planes[basis[3]];
  std::array<Point, 3> rows;
  Point right, x;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k)
      rows[r][k] = planes[basis[r]].normal[k] - last.normal[k];
    right[r] = planes[basis[r]].offset - last.offset;
  }
  const Rational whole = determinant(rows[0], rows[1], rows[2]);
  if (sgn(whole) == 0) return {};
  for (int k = 0; k < 3; ++k) {
    std::array<Point, 3> replaced = rows;
    for (int r = 0; r < 3; ++r)
      replaced[r][k] = right[r];
    x[k] = determinant(replaced[0], replaced[1], replaced[2]) / whole;
  }
  bounds.high = bounds.low;
  for (const Plane& p : planes)
    bounds.high = std::max(bounds.high, Rational(dot(p.normal, x) - p.offset));
  return bounds;
}

std::vector<Point> vertices(const Planes& planes) {
  Matrix_ m(planes.size(), 4);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    m.set(i, 0, planes[i].offset);
    for (int k = 0; k < 3; ++k)
      m.set(i, 1 + k, -planes[i].normal[k]);
  }
  dd_ErrorType error;
  dd_PolyhedraPtr poly = dd_DDMatrix2Poly(m.p, &error);
  if (error != dd_NoError) throw std::logic_error("cddlib: no vertices");
  dd_MatrixPtr generators = dd_CopyGenerators(poly);
  std::vector<Point> list;
  bool closed = true;
  for (dd_rowrange r = 0; r < generators->rowsize; ++r) {
    closed = closed && mpq_sgn(generators->matrix[r][0]) != 0;
    Point v;
    for (int k = 0; k < 3; ++k)
      v[k] = Rational(generators->matrix[r][1 + k]);
    list.push_back(std::move(v));
  }
  dd_FreeMatrix(generators);
  dd_FreePolyhedra(poly);
  if (!closed) throw std::logic_error("the solid is not closed");
  return list;
}

}  // namespace voussoir::exact
