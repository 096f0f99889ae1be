// The kernel and its two programs, timed on the workloads' pairs.
#include "benchmarks/method.hpp"
#include "benchmarks/peers/clip.hpp"
#include "core/contact/kernel/kernel.hpp"

namespace voussoir::benchmarks {
namespace {

template <int Dim>
using Contacts = std::vector<Contact<Dim>>;

// ---- the kernel -----------------------------------------------------------------------------------------------------

// The data of a query. All methods share them, because only one runs at a time: differing data are copied in before.
template <int Dim>
struct Fixture {
  std::vector<Pair<Dim>> pairs;
  Contacts<Dim> contacts = Contacts<Dim>(pairs_per_workload);
  std::vector<Contact<Dim>*> slots;

  Fixture() : pairs(pairs_per_workload) {
    for (Contact<Dim>& c : contacts)
      slots.push_back(&c);
  }
};

template <int Dim>
Fixture<Dim>& fixture() {
  static Fixture<Dim> only;
  return only;
}

// errors: 1e-4 of the overlap in the point, 1e-6 in overlap and area (core/contact/centre_test.cpp)
constexpr ContactSettings published{.newton_tolerance = 1e-3};
constexpr ContactSettings on_central_path{
    .point = ContactPoint::central_path, .normal = ContactNormal::multipliers, .newton_tolerance = 1e-3};

template <int Dim>
void call_kernel(const ContactSettings& settings, std::size_t first, std::size_t count, bool batched,
                 KernelCounters& counters) {
  static const Solvers<Dim> solvers;
  const std::span<const Pair<Dim>> pairs = std::span<const Pair<Dim>>(fixture<Dim>().pairs).subspan(first, count);
  const std::span<Contact<Dim>* const> slots =
      std::span<Contact<Dim>* const>(fixture<Dim>().slots).subspan(first, count);
  if (batched)
    narrow_phase<Dim>(pairs, settings, solvers, slots, counters);
  else
    for (std::size_t i = 0; i < count; ++i)
      narrow_phase<Dim>(pairs.subspan(i, 1), settings, solvers, slots.subspan(i, 1), counters);
}

template <int Dim>
void lay_out(const std::vector<Pair<Dim>>& pairs, const Contacts<Dim>& contacts, QueryLevel level, std::size_t first,
             std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    fixture<Dim>().pairs[i] = pairs[i];
    fixture<Dim>().pairs[i].level = level;
    fixture<Dim>().contacts[i] = contacts[i];
  }
}

constexpr int cold = -1, near_move = 0, far_move = 1;

// the contacts after the previous step: resolved from cold at the previous poses, to the same stage
template <int Dim, class Work>
Contacts<Dim> contacts_before(const Work& work, const ContactSettings& settings, QueryLevel level, int move) {
  Contacts<Dim> start(pairs_per_workload);
  if (move == cold) return start;
  KernelCounters counters;
  lay_out<Dim>(work.previous[move], start, level, 0, pairs_per_workload);
  call_kernel<Dim>(settings, 0, pairs_per_workload, true, counters);
  return fixture<Dim>().contacts;
}

// `work` lives as long as the result
template <int Dim, class Work>
std::shared_ptr<Prepared> prepare_kernel(std::shared_ptr<const Work> work, const ContactSettings& settings,
                                         QueryLevel level, int move, bool batched) {
  const auto start = std::make_shared<const Contacts<Dim>>(contacts_before<Dim>(*work, settings, level, move));
  auto prepared = std::make_shared<Prepared>();
  prepared->counters = std::make_shared<KernelCounters>();
  prepared->restore = [work, start, level](std::size_t first, std::size_t count) {
    lay_out<Dim>(work->pairs, *start, level, first, count);
  };
  prepared->resolve = [settings, batched, counters = prepared->counters](std::size_t first, std::size_t count) {
    KernelCounters mine;  // of this thread
    call_kernel<Dim>(settings, first, count, batched, mine);
    if (first == 0) *counters = mine;
  };
  prepared->touching = [](std::size_t i) { return fixture<Dim>().contacts[i].touching(); };
  return prepared;
}

Method kernel(const char* name, QueryLevel level, int move, bool batched, int threads = 1,
              const ContactSettings& settings = published) {
  static const char* const stages[] = {"decision", "point", "overlap", "area"};
  static const char* const delivers[] = {"decision certificate", "decision certificate point",
                                         "decision certificate point normal overlap",
                                         "decision certificate point normal overlap area"};
  Method method;
  method.name = name;
  method.stage = stages[static_cast<int>(level)];
  method.delivers = delivers[static_cast<int>(level)];
  // if nothing touches, every query ends with the decision
  method.applies = level == QueryLevel::decision ? any_pair : overlapping;
  method.threads = threads;
  method.prepare = [=](const Workload& work) {
    // workloads are kept until the program ends
    return prepare_kernel<3>(std::shared_ptr<const Workload>(&work, [](const Workload*) {}), settings, level, move,
                             batched);
  };
  return method;
}

// prisms, and their polygons
void add_plane_methods(std::vector<Method>& list) {
  for (const QueryLevel level : {QueryLevel::overlap, QueryLevel::area}) {
    Method in_space = kernel(batched_warm, level, near_move, true), in_plane = in_space;
    in_plane.name = batched_warm_2d;
    in_plane.prepare = [=](const Workload& work) {
      return prepare_kernel<2>(in_the_plane(work), published, level, near_move, true);
    };
    for (Method* method : {&in_space, &in_plane}) {
      method->applies = prisms;
      list.push_back(*method);
    }
  }
}

// ---- its two programs separately
// -----------------------------------------------------------------------------------------

using Basis = std::array<int, 4>;

// the planes are assembled within the timing: every solver needs them
FeasibilityResult<3> run_lp(const Pair<3>& pair, const Basis& start, HalfSpaces<3>& planes) {
  assemble<3>(pair, 0.5 * pair.offset, planes);
  FeasibilityRequest<3> request;
  request.start = &start;
  return solve_feasibility<3>(planes, request);
}

// the kernel's: it assembles, pivots until the proof is complete, and stores it
std::shared_ptr<Prepared> prepare_lp(const Workload& work) {
  std::vector<Pair<3>> pairs = work.pairs;
  for (Pair<3>& pair : pairs)
    pair.level = QueryLevel::decision;
  return prepared_query(pairs_per_workload, [pairs](std::size_t i) {
    Contact<3> contact;
    KernelCounters counters;
    KernelTask<3> task = kernel_task(pairs[i], {}, contact);
    resolve_new(task, {}, counters);
    return contact.touching();
  });
}

// the general one, from the basis at the previous pose
std::shared_ptr<Prepared> prepare_warm_lp(const Workload& work) {
  std::vector<Basis> starts;
  HalfSpaces<3> planes;
  for (std::size_t i = 0; i < pairs_per_workload; ++i)
    starts.push_back(run_lp(work.previous[near_move][i], work.pairs[i].a->basis, planes).basis);
  return prepared_query(pairs_per_workload, [&work, starts, planes](std::size_t i) mutable {
    return run_lp(work.pairs[i], starts[i], planes).value < 0;
  });
}

std::shared_ptr<Prepared> prepare_centre(const Workload& work) {
  std::vector<Vector<3>> starts;
  HalfSpaces<3> planes;
  for (const Pair<3>& pair : work.pairs)
    starts.push_back(run_lp(pair, pair.a->basis, planes).point);
  return prepared_query(pairs_per_workload, [&work, starts, planes](std::size_t i) mutable {
    assemble<3>(work.pairs[i], 0.5 * work.pairs[i].offset, planes);
    CentreRequest<3> request;
    request.start = starts[i];
    return solve_analytic_centre<3>(planes, request).status == CentreStatus::converged;
  });
}

// ---- a single polyhedron (Boon 2013, section 4.7) --------------------------------------------------------------

constexpr double share_of_vertex = 0.95;  // start on the line from the centroid to a vertex, as in the thesis
constexpr double clip_error = 1e-12;      // of volume and centroid, whose size is 1

HalfSpaces<3> turned_planes(const Pair<3>& pair) {
  return shapes::placed<3>(pair.b->faces, pair.rotation, Vector<3>::Zero());
}

std::shared_ptr<Prepared> prepare_solid_centre(const Workload& work, bool feasible_start) {
  std::vector<HalfSpaces<3>> regions;
  std::vector<Vector<3>> starts;
  for (std::size_t i = 0; i < pairs_per_workload; ++i) {
    const Pair<3>& pair = work.pairs[i];
    regions.push_back(turned_planes(pair));
    starts.push_back(share_of_vertex * (pair.rotation * pair.b->vertices[i % pair.b->vertices.size()]));
  }
  return prepared_query(pairs_per_workload, [regions, starts, feasible_start](std::size_t i) {
    CentreRequest<3> request;
    request.start = feasible_start ? starts[i] : solve_feasibility<3>(regions[i], {}).point;
    return solve_analytic_centre<3>(regions[i], request).status == CentreStatus::converged;
  });
}

std::shared_ptr<Prepared> prepare_solid_centroid(const Workload& work) {
  std::vector<HalfSpaces<3>> regions;
  for (const Pair<3>& pair : work.pairs)
    regions.push_back(turned_planes(pair));
  const Polytope<3> around = box(Vector<3>::Constant(1));
  return prepared_query(pairs_per_workload, [&work, regions, around, clipper = Clipper()](std::size_t i) mutable {
    // the result must be the polyhedron itself, with its centroid at 0
    const Overlap found = clipper.clip(around, regions[i]);
    return std::abs(found.volume - work.pairs[i].b->mass.volume) < clip_error && found.centroid.norm() < clip_error;
  });
}

}  // namespace

std::vector<Method> own_methods() {
  std::vector<Method> list;
  for (const QueryLevel level : {QueryLevel::decision, QueryLevel::point, QueryLevel::overlap, QueryLevel::area}) {
    list.push_back(kernel(single_cold, level, cold, false));
    list.push_back(kernel(single_warm, level, near_move, false));
    list.push_back(kernel(batched_cold, level, cold, true));
    list.push_back(kernel(batched_warm, level, near_move, true));
  }
  for (const QueryLevel level : {QueryLevel::overlap, QueryLevel::area}) {
    list.push_back(kernel(single_warm_far, level, far_move, false));
    list.push_back(kernel(batched_warm_far, level, far_move, true));
  }
  for (const QueryLevel level : {QueryLevel::decision, QueryLevel::area})
    list.push_back(kernel(batched_warm_threads, level, near_move, true, 2));

  list.push_back(kernel(single_warm_path, QueryLevel::overlap, near_move, false, 1, on_central_path));
  list.push_back(kernel(batched_warm_path, QueryLevel::overlap, near_move, true, 1, on_central_path));
  add_plane_methods(list);

  list.push_back({own_lp, "lp", "decision certificate", any_pair, prepare_lp});
  list.push_back({own_lp_warm, "lp", "decision", any_pair, prepare_warm_lp});
  list.push_back({own_centre, "centre", "point", overlapping, prepare_centre});
  list.push_back(
      {solid_centre, "centre", "point", solid, [](const Workload& work) { return prepare_solid_centre(work, true); }});
  list.push_back({solid_lp_and_centre, "centre", "point", solid,
                  [](const Workload& work) { return prepare_solid_centre(work, false); }});
  list.push_back({solid_centroid, "centre", "point", solid, prepare_solid_centroid});
  return list;
}

}  // namespace voussoir::benchmarks
