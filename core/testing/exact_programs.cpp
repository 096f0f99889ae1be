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

// ---- planes of whole numbers ----------------------------------------------------------------------------------------

// Rationals multiplied by one number that makes them whole: sums and products then need no common divisors, which take
// most of the time of rational arithmetic.
using Whole = mpz_class;
using Row = std::array<Whole, 3>;

struct WholePlanes {
  Whole factor = 1;
  std::vector<Row> normals;
  std::vector<Whole> offsets;

  explicit WholePlanes(const Planes& planes) {
    for (const Plane& p : planes)
      for (const Rational* q : {&p.normal[0], &p.normal[1], &p.normal[2], &p.offset})
        mpz_lcm(factor.get_mpz_t(), factor.get_mpz_t(), q->get_den_mpz_t());
    for (const Plane& p : planes) {
      normals.push_back({times(p.normal[0], factor), times(p.normal[1], factor), times(p.normal[2], factor)});
      offsets.push_back(times(p.offset, factor));
    }
  }
  static Whole times(const Rational& q, const Whole& by) {
    Whole result;
    mpz_divexact(result.get_mpz_t(), by.get_mpz_t(), q.get_den_mpz_t());
    return result * q.get_num();
  }
};

Whole determinant(const Row& a, const Row& b, const Row& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Whole dot(const Row& a, const Row& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational quotient(const Whole& numerator, const Whole& denominator) {
  Rational q(numerator, denominator);
  q.canonicalize();
  return q;
}

// rows·x = right: x = result / determinant(rows)
Row cramer(const std::array<Row, 3>& rows, const Row& right) {
  Row x;
  for (int k = 0; k < 3; ++k) {
    std::array<Row, 3> replaced = rows;
    for (int r = 0; r < 3; ++r)
      replaced[r][k] = right[r];
    x[k] = determinant(replaced[0], replaced[1], replaced[2]);
  }
  return x;
}

// ---- cddlib ---------------------------------------------------------------------------------------------------------

// cddlib's constants exist as long as the process
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
  if (!solved) throw std::logic_error("cddlib: no result");
  return result;
}

}  // namespace

Program feasibility(const Planes& planes) {
  return solve(planes, nullptr);
}

Program section_feasibility(const Planes& planes, const Plane& joint) {
  return solve(planes, &joint);
}

Rational support(const Planes& planes, const Point& direction) {
  Matrix_ m(planes.size(), 4);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    m.set(i, 0, planes[i].offset);
    for (int k = 0; k < 3; ++k)
      m.set(i, 1 + k, -planes[i].normal[k]);
  }
  m.p->objective = dd_LPmax;
  for (int k = 0; k < 3; ++k)
    mpq_set(m.p->rowvec[1 + k], direction[k].get_mpq_t());
  dd_ErrorType error;
  dd_LPPtr lp = dd_Matrix2LP(m.p, &error);
  dd_LPSolve(lp, dd_DualSimplex, &error);
  const bool optimal = error == dd_NoError && lp->LPS == dd_Optimal;
  const Rational value = optimal ? Rational(lp->optvalue) : Rational(0);
  dd_FreeLPData(lp);
  if (!optimal) throw std::logic_error("the solid is empty or not closed");
  return value;
}

std::optional<Rational> proven_support(const Planes& planes, const std::array<int, 3>& corner, const Point& direction) {
  const WholePlanes whole(planes), ahead({{direction, 0}});
  const Row& u = ahead.normals[0];
  std::array<Row, 3> rows;
  Row right;
  for (int r = 0; r < 3; ++r) {
    rows[r] = whole.normals[corner[r]];
    right[r] = whole.offsets[corner[r]];
  }
  const Whole determinant_ = determinant(rows[0], rows[1], rows[2]);
  const int sign = sgn(determinant_);
  if (sign == 0) return {};
  // no other point of the corner's cone is farther: the direction is a positive sum of the three normals
  for (int r = 0; r < 3; ++r) {
    std::array<Row, 3> replaced = rows;
    replaced[r] = u;
    if (sgn(determinant(replaced[0], replaced[1], replaced[2])) * sign < 0) return {};
  }
  // and the corner belongs to the solid
  const Row x = cramer(rows, right);
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (sgn(Whole(dot(whole.normals[i], x) - whole.offsets[i] * determinant_)) * sign > 0) return {};
  return quotient(dot(u, x), determinant_ * ahead.factor);
}

ProgramBounds feasibility_bounds(const Planes& planes, const std::array<int, 4>& basis) {
  for (const int b : basis)
    if (b < 0) return {};
  const WholePlanes whole(planes);
  // multipliers: Σ λ a = 0, by the determinants of the other three normals; their sum is left in the denominator
  std::array<Whole, 4> lambda;
  Whole sum = 0, low = 0;
  for (int k = 0; k < 4; ++k) {
    std::array<int, 3> others;
    for (int j = 0, place = 0; j < 4; ++j)
      if (j != k) others[place++] = basis[j];
    lambda[k] = determinant(whole.normals[others[0]], whole.normals[others[1]], whole.normals[others[2]]);
    if (k % 2) lambda[k] = -lambda[k];
    sum += lambda[k];
    low -= lambda[k] * whole.offsets[basis[k]];
  }
  if (sgn(sum) == 0) return {};
  for (const Whole& l : lambda)
    if (sgn(l) * sgn(sum) < 0) return {};
  // the point where the four hold with s = low: differences of their equations
  std::array<Row, 3> rows;
  Row right;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k)
      rows[r][k] = whole.normals[basis[r]][k] - whole.normals[basis[3]][k];
    right[r] = whole.offsets[basis[r]] - whole.offsets[basis[3]];
  }
  const Whole volume = determinant(rows[0], rows[1], rows[2]);  // the sum again, but for its sign
  const Row x = cramer(rows, right);
  Whole most = 0;  // of s - low, times |volume|
  const Whole size = abs(volume), least = sgn(sum) * low;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Whole excess = sgn(volume) * dot(whole.normals[i], x) - whole.offsets[i] * size - least;
    if (excess > most) most = excess;
  }
  return {true, quotient(least, size * whole.factor), quotient(least + most, size * whole.factor)};
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
