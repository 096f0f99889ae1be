// Ipopt on the analytic centre, in the thesis' slack form (Eq. 3.38), from the point of the LP.
#include "core/solvers/ipopt.hpp"

#include "benchmarks/peers/peers.hpp"

namespace voussoir::benchmarks {
namespace {

// a solve takes milliseconds, and all take about as long
constexpr std::size_t few_pairs = 8;

// m, between its centre and ours: a fraction of an overlap of 1e-4
constexpr double agreement = 1e-7;

std::shared_ptr<Prepared> prepare(const Workload& work) {
  std::vector<Vector<3>> starts, centres;
  HalfSpaces<3> planes;
  for (std::size_t i = 0; i < few_pairs; ++i) {
    assemble<3>(work.pairs[i], 0.5 * work.pairs[i].offset, planes);
    starts.push_back(solve_feasibility<3>(planes, {}).point);
    CentreRequest<3> request;
    request.start = starts.back();
    centres.push_back(solve_analytic_centre<3>(planes, request).point);
  }
  return prepared_query(few_pairs, [&work, starts, centres, planes](std::size_t i) mutable {
    assemble<3>(work.pairs[i], 0.5 * work.pairs[i].offset, planes);
    CentreRequest<3> request;
    request.start = starts[i];
    const CentreResult<3> found = solve_analytic_centre_ipopt<3>(planes, request);
    return found.status == CentreStatus::converged && (found.point - centres[i]).norm() < agreement;
  });
}

}  // namespace

std::vector<Method> ipopt_methods() {
  return {{ipopt_centre, "centre", "point", overlapping, prepare, few_pairs}};
}

}  // namespace voussoir::benchmarks
