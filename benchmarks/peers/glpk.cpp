// GLPK on the feasibility program: as in the core (primal form, everything rebuilt), and in its fastest form (the dual,
// four rows) with one object for all pairs of a first part, cold and from the basis of the previous pose.
#include <glpk.h>

#include <map>

#include "benchmarks/peers/peers.hpp"
#include "core/solvers/glpk.hpp"

namespace voussoir::benchmarks {
namespace {

// enough of them: a call takes 5 to 90 µs
constexpr std::size_t pairs_primal = 100, pairs_dual = 300;

struct DeleteProblem {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};

// min Σ d_i λ_i  subject to  Σ λ_i a_i = 0, Σ λ_i = 1, λ >= 0. Its optimum is -s (solvers/feasibility_program.hpp):
// positive if the parts overlap.
class DualProgram {
 public:
  // the basic variables: columns, and rows as their negative numbers (in a degenerate optimum some are)
  using Basis = std::vector<int>;

  // `most_faces`: of any second part; columns beyond those of the present pair are fixed at 0
  DualProgram(const Polytope<3>& a, std::size_t most_faces) : faces_a_(static_cast<int>(a.faces.size())) {
    glp_term_out(GLP_OFF);
    problem_.reset(glp_create_prob());
    glp_set_obj_dir(lp(), GLP_MIN);
    glp_add_rows(lp(), 4);
    for (int row = 1; row <= 4; ++row)
      glp_set_row_bnds(lp(), row, GLP_FX, row == 4, row == 4);
    columns_ = faces_a_ + static_cast<int>(most_faces);
    glp_add_cols(lp(), columns_);
    for (int i = 0; i < faces_a_; ++i)
      set_column(i + 1, a.faces[i].normal, a.faces[i].offset);
    for (int column = 1; column <= columns_; ++column)
      glp_set_col_bnds(lp(), column, column <= faces_a_ ? GLP_LO : GLP_FX, 0, 0);
    active_ = faces_a_;
    glp_init_smcp(&control_);
    control_.msg_lev = GLP_MSG_OFF;
  }

  void set_pair(const Pair<3>& pair) {
    const int wanted = faces_a_ + static_cast<int>(pair.b->faces.size());
    for (; active_ < wanted; ++active_)
      glp_set_col_bnds(lp(), active_ + 1, GLP_LO, 0, 0);
    for (; active_ > wanted; --active_)
      glp_set_col_bnds(lp(), active_, GLP_FX, 0, 0);
    int column = faces_a_;
    for (const HalfSpace<3>& face : pair.b->faces) {
      const Vector<3> normal = pair.rotation * face.normal;
      set_column(++column, normal, face.offset + normal.dot(pair.offset));
    }
  }

  bool solve_cold() {
    glp_std_basis(lp());
    return solve();
  }

  // a basis that is singular at the new pose cannot be used
  bool solve_from(const Basis& basis) {
    for (int column = 1; column <= columns_; ++column)
      glp_set_col_stat(lp(), column, GLP_NL);
    for (int row = 1; row <= 4; ++row)
      glp_set_row_stat(lp(), row, GLP_NS);
    for (const int basic : basis)
      basic > 0 ? glp_set_col_stat(lp(), basic, GLP_BS) : glp_set_row_stat(lp(), -basic, GLP_BS);
    return solve() || (failed_ && solve_cold());
  }

  Basis basis() const {
    Basis basic;
    for (int column = 1; column <= active_; ++column)
      if (glp_get_col_stat(lp(), column) == GLP_BS) basic.push_back(column);
    for (int row = 1; row <= 4; ++row)
      if (glp_get_row_stat(lp(), row) == GLP_BS) basic.push_back(-row);
    return basic;
  }

 private:
  glp_prob* lp() const { return problem_.get(); }

  // true if by the optimum the parts overlap
  bool solve() {
    failed_ = glp_simplex(lp(), &control_) != 0;
    return !failed_ && glp_get_obj_val(lp()) > 0;
  }

  void set_column(int column, const Vector<3>& normal, double offset) {
    const int rows[5] = {0, 1, 2, 3, 4};
    const double values[5] = {0, normal[0], normal[1], normal[2], 1};
    glp_set_mat_col(lp(), column, 4, rows, values);
    glp_set_obj_coef(lp(), column, offset);
  }

  std::unique_ptr<glp_prob, DeleteProblem> problem_;
  glp_smcp control_;
  int faces_a_, columns_ = 0, active_ = 0;
  bool failed_ = false;
};

struct DualPrograms {
  std::map<const Polytope<3>*, DualProgram> of_first_part;
  std::vector<DualProgram*> of_pair;

  explicit DualPrograms(const Workload& work) {
    std::size_t most_faces = 0;
    for (const Polytope<3>& part : *work.parts)
      most_faces = std::max(most_faces, part.faces.size());
    for (const Pair<3>& pair : work.pairs)
      of_pair.push_back(&of_first_part.try_emplace(pair.a, *pair.a, most_faces).first->second);
  }
};

std::shared_ptr<Prepared> prepare_primal(const Workload& work) {
  return prepared_query(pairs_per_workload, [&work, planes = HalfSpaces<3>()](std::size_t i) mutable {
    assemble<3>(work.pairs[i], 0.5 * work.pairs[i].offset, planes);
    return solve_feasibility_glpk<3>(planes, {}).value < 0;
  });
}

std::shared_ptr<Prepared> prepare_dual_cold(const Workload& work) {
  const auto programs = std::make_shared<DualPrograms>(work);
  return prepared_query(pairs_per_workload, [&work, programs](std::size_t i) {
    programs->of_pair[i]->set_pair(work.pairs[i]);
    return programs->of_pair[i]->solve_cold();
  });
}

std::shared_ptr<Prepared> prepare_dual_warm(const Workload& work) {
  const auto programs = std::make_shared<DualPrograms>(work);
  std::vector<DualProgram::Basis> bases;
  for (std::size_t i = 0; i < pairs_per_workload; ++i) {
    programs->of_pair[i]->set_pair(work.previous[0][i]);
    programs->of_pair[i]->solve_cold();
    bases.push_back(programs->of_pair[i]->basis());
  }
  return prepared_query(pairs_per_workload, [&work, programs, bases](std::size_t i) {
    programs->of_pair[i]->set_pair(work.pairs[i]);
    return programs->of_pair[i]->solve_from(bases[i]);
  });
}

}  // namespace

std::vector<Method> glpk_methods() {
  return {{glpk_primal, "lp", "decision", any_pair, prepare_primal, pairs_primal},
          {glpk_dual_cold, "lp", "decision", any_pair, prepare_dual_cold, pairs_dual},
          {glpk_dual_warm, "lp", "decision", any_pair, prepare_dual_warm, pairs_dual}};
}

}  // namespace voussoir::benchmarks
