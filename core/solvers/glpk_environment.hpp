// The environment for every call of GLPK; included only by the files that call it.
#pragma once

#include <glpk.h>

#include <memory>

namespace voussoir {

// GLPK keeps one environment per thread and frees it only on request
struct GlpkEnvironment {
  GlpkEnvironment() {
    glp_init_env();
    glp_term_out(GLP_OFF);
  }
  ~GlpkEnvironment() { glp_free_env(); }
};

struct DeleteGlpkProblem {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using GlpkProblem = std::unique_ptr<glp_prob, DeleteGlpkProblem>;

}  // namespace voussoir
