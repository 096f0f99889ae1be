// The Python module `voussoir._core`: README.md in this folder shows its use.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cstring>

#include "core/base/bad_input.hpp"
#include "core/base/version.hpp"
#include "core/output/output_error.hpp"
#include "core/scene/effective_scene.hpp"
#include "core/scene/scene.hpp"
#include "python/stepped_run.hpp"
#include "text/angle.hpp"

namespace py = pybind11;

namespace voussoir::python {
namespace {

// ---- scenes: a file, or a dict as TOML would state it ------------------------------------------------------------

constexpr int deepest = 16;  // tables in tables, as in a file

Node node_of(const py::handle& value, const Place& place, int depth = 0) {
  if (depth > deepest)
    throw py::value_error("a scene's tables and lists must not nest so deeply; four levels are enough");
  // numbers and arrays of numpy
  if (py::hasattr(value, "tolist")) return node_of(value.attr("tolist")(), place, depth + 1);
  Node node;
  node.place = place;
  if (py::isinstance<py::bool_>(value)) {
    node.kind = Node::Kind::boolean;
    node.boolean = value.cast<bool>();
  } else if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) {
    node.kind = py::isinstance<py::int_>(value) ? Node::Kind::integer : Node::Kind::number;
    node.number = value.cast<double>() + 0.0;  // -0 is 0, as in a file
  } else if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__")) {
    node.kind = Node::Kind::text;
    node.text = py::module_::import("os").attr("fspath")(value).cast<std::string>();
  } else if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value)) {
      if (!py::isinstance<py::str>(key)) throw py::type_error("the keys of a scene are str");
      node.set(key.cast<std::string>(), node_of(item, place, depth + 1));
    }
  } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    node.kind = Node::Kind::list;
    for (const py::handle& item : value)
      node.items.push_back(node_of(item, place, depth + 1));
  } else {
    throw py::type_error("a scene contains numbers, bool, str, list and dict, not " +
                         py::str(py::type::of(value).attr("__name__")).cast<std::string>());
  }
  return node;
}

std::string toml_of(const py::object& value) {
  return toml_value(node_of(value, Place{std::make_shared<const std::string>("dict")}));
}

// str, bytes or anything with a path, with any bytes
std::string path_of(const py::object& path) {
  return py::module_::import("os").attr("fsencode")(path).cast<std::string>();
}

std::shared_ptr<const OpenedScene> scene_of(const py::object& source, const py::dict& set) {
  const std::string name = "dict";
  const Place place{std::make_shared<const std::string>(name)};
  std::vector<std::string> overrides;
  for (const auto& [key, value] : set)
    overrides.push_back(key.cast<std::string>() + "=" + toml_of(py::reinterpret_borrow<py::object>(value)));
  if (py::isinstance<py::dict>(source)) {
    Node tree = node_of(source, place);
    const py::gil_scoped_release others_may_run;
    return open_scene(read_tree(std::move(tree), name, overrides));
  }
  const std::string file = path_of(source);
  const py::gil_scoped_release others_may_run;
  return open_scene(read_scene(file, overrides));
}

// ---- runs --------------------------------------------------------------------------------------------------------

// shared by a run and its state; only the interpreter's lock guards it
struct Run {
  std::unique_ptr<SteppedRun> stepped;
  bool advances = false;
};

SteppedRun& at_rest(const Run& run) {
  if (run.advances)
    throw std::runtime_error("this run is being advanced by another thread; wait until it has returned");
  return *run.stepped;
}

struct State {
  std::shared_ptr<Run> run;
};

// Ctrl-C, and other signal handlers of Python: checked a few times a second
class Signals {
 public:
  bool raised() {
    const auto now = std::chrono::steady_clock::now();
    if (now - asked_ < std::chrono::milliseconds(200)) return raised_;
    asked_ = now;
    const py::gil_scoped_acquire interpreter;
    raised_ = PyErr_CheckSignals() != 0;
    return raised_;
  }

 private:
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
  bool raised_ = false;
};

bool advance(Run& run, long long steps) {
  if (steps < 1) throw py::value_error("steps must be at least 1");
  SteppedRun& stepped = at_rest(run);
  struct Guard {
    Run& run;
    explicit Guard(Run& r) : run(r) { run.advances = true; }
    ~Guard() {
      run.advances = false;
      run.stepped->show_motions();
    }
  };
  const Guard guard(run);
  Signals signals;
  bool more = false;
  {
    const py::gil_scoped_release others_may_run;
    more = stepped.advance(steps, [&] { return signals.raised(); });
  }
  if (PyErr_Occurred()) throw py::error_already_set();
  return more;
}

// ---- arrays ------------------------------------------------------------------------------------------------------

// a view that keeps its data alive
py::array view_of(const Run& run, const std::vector<double> MotionArrays::*numbers, bool flat) {
  const std::shared_ptr<const MotionArrays> motions = at_rest(run).motions();
  const py::capsule owner(new std::shared_ptr<const MotionArrays>(motions),
                          [](void* held) { delete static_cast<std::shared_ptr<const MotionArrays>*>(held); });
  std::vector<py::ssize_t> shape{motions->bodies};
  if (!flat) shape.push_back(run.stepped->dimension());
  py::array_t<double> view(shape, ((*motions).*numbers).data(), owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

py::array array_of(const DataArray& data) {
  const auto rows = static_cast<py::ssize_t>(data.values.size()) / data.components;
  std::vector<py::ssize_t> shape{rows};
  if (data.components > 1) shape.push_back(data.components);
  const py::array_t<double> numbers(shape, data.values.data());
  return data.integer ? py::array(numbers.attr("astype")("int64")) : py::array(numbers);
}

py::array array_of(const std::vector<std::array<double, 3>>& points) {
  DataArray data{"points", 3, false, {}};
  for (const std::array<double, 3>& point : points)
    data.values.insert(data.values.end(), point.begin(), point.end());
  return array_of(data);
}

py::dict dict_of(const std::vector<DataArray>& arrays) {
  py::dict dict;
  for (const DataArray& array : arrays)
    dict[array.name.c_str()] = array_of(array);
  return dict;
}

// a record for each point: its position and data
py::array table_of(const PolyData& data) {
  py::list fields;
  fields.append(py::make_tuple("point", "f8", py::make_tuple(3)));
  for (const DataArray& array : data.point_data) {
    const char* type = array.integer ? "i8" : "f8";
    fields.append(array.components == 1 ? py::make_tuple(array.name, type)
                                        : py::make_tuple(array.name, type, py::make_tuple(array.components)));
  }
  const py::object numpy = py::module_::import("numpy");
  py::object table = numpy.attr("empty")(data.points.size(), numpy.attr("dtype")(fields));
  table["point"] = array_of(data.points);
  for (const DataArray& array : data.point_data)
    table[array.name.c_str()] = array_of(array);
  return table;
}

// as for VTK and pyvista: each face is the number of its points, then their indices
py::array faces_of(const PolyData& data) {
  std::vector<std::int64_t> faces;
  for (const std::vector<int>& cell : data.cells) {
    faces.push_back(static_cast<std::int64_t>(cell.size()));
    faces.insert(faces.end(), cell.begin(), cell.end());
  }
  return py::array_t<std::int64_t>(static_cast<py::ssize_t>(faces.size()), faces.data());
}

py::object results_of(const Run& run) {
  const SteppedRun& stepped = at_rest(run);
  py::object results = py::module_::import("json").attr("loads")(stepped.results());
  if (!stepped.done()) results["status"] = "under way";
  return results;
}

py::dict history_of(const Run& run) {
  const History history = at_rest(run).history();
  py::dict columns;
  for (std::size_t k = 0; k < history.columns.size(); ++k) {
    std::vector<double> column;
    for (const std::vector<double>& row : history.rows)
      column.push_back(row[k]);
    columns[history.columns[k].c_str()] = py::array_t<double>(static_cast<py::ssize_t>(column.size()), column.data());
  }
  return columns;
}

// ---- block theory ------------------------------------------------------------------------------------------------

// as the package reads the tables of a folder
py::object columns_of(const std::string& csv) {
  return py::module_::import("voussoir.folder").attr("columns_of")(py::module_::import("io").attr("StringIO")(csv));
}

std::optional<SeismicRequest> seismic_of(const py::object& seismic, double vertical) {
  if (seismic.is_none() && vertical == 0) return std::nullopt;
  SeismicRequest request;
  request.vertical = vertical;
  if (seismic.is_none()) {
    request.trend = 0;
  } else if (py::isinstance<py::tuple>(seismic)) {
    const auto [coefficient, trend] = seismic.cast<std::pair<double, double>>();
    request.coefficient = coefficient;
    request.trend = trend * degree;
  } else {
    request.coefficient = seismic.cast<double>();
  }
  return request;
}

// ---- errors ------------------------------------------------------------------------------------------------------

py::handle scene_error;  // the class; it lives as long as the module, which Python never unloads

py::object text_of(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const SceneError& error) {
    const py::object raised = scene_error(text_of(error.what()));
    raised.attr("file") = text_of(error.file);
    raised.attr("line") = error.line;
    raised.attr("key") = text_of(error.key);
    PyErr_SetObject(scene_error.ptr(), raised.ptr());
  } catch (const BadInput& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const FileInTheWay& error) {
    PyErr_SetString(PyExc_FileExistsError, error.what());
  } catch (const OutputError& error) {
    PyErr_SetString(error.kind == OutputError::Kind::not_permitted ? PyExc_PermissionError : PyExc_OSError,
                    error.what());
  }
}

// ---- the module --------------------------------------------------------------------------------------------------

void bind_scene(py::module_& module) {
  py::class_<OpenedScene, std::shared_ptr<OpenedScene>>(
      module, "Scene",
      "A scene, read, checked and cut into blocks: from a file, or from a dict with the content of a file.")
      .def(py::init([](const py::object& source, const py::dict& set) {
             return std::const_pointer_cast<OpenedScene>(scene_of(source, set));
           }),
           py::arg("source"), py::arg("set") = py::dict(),
           "`set` overrides keys, as --set: {\"joints.A.dip\": 65}. Raises SceneError.")
      .def(
          "start",
          [](const std::shared_ptr<OpenedScene>& scene, int threads) {
            if (threads < 1 || threads > 1024) throw py::value_error("threads must be from 1 to 1024");
            return std::make_shared<Run>(Run{start(scene, threads)});
          },
          py::arg("threads") = 1, "A run of the scene from its start. The number of threads changes no bit.")
      .def_property_readonly("title", [](const OpenedScene& s) { return s.stated.title; })
      .def_property_readonly("dimension", [](const OpenedScene& s) { return s.stated.dimension; })
      .def_property_readonly(
          "toml", [](const OpenedScene& s) { return s.text; }, "The effective scene, as a file.")
      .def_property_readonly(
          "hash", [](const OpenedScene& s) { return s.hash; }, "The input_hash of results.json.")
      .def_property_readonly(
          "warnings", [](const OpenedScene& s) { return s.warnings; },
          "Stated values that look like mistakes of unit or sign.");
}

void bind_blocks(py::module_& module, const py::object& surface) {
  const py::object verdicts =
      py::module_::import("collections")
          .attr("namedtuple")("Blocks", "verdicts table surface", py::arg("module") = "voussoir");
  module.attr("Blocks") = verdicts;
  module.def(
      "blocks",
      [verdicts, surface](const OpenedScene& scene, double required, const py::object& seismic, double vertical,
                          const std::optional<std::pair<double, double>>& bolt, const std::string& strength_of,
                          const std::string& after, bool frictionless) {
        SurveyRequest request{.required = required,
                              .seismic = seismic_of(seismic, vertical),
                              .strength_of = strength_of,
                              .after = after,
                              .frictionless = frictionless};
        if (bolt) request.bolt = std::pair(bolt->first * degree, bolt->second * degree);
        refuse_out_of_range(request);
        BlockVerdicts found;
        {
          const py::gil_scoped_release others_may_run;
          found = judge_blocks(scene, request);
        }
        return verdicts(py::module_::import("json").attr("loads")(found.json), columns_of(found.csv),
                        surface(array_of(found.surface.points), faces_of(found.surface),
                                dict_of(found.surface.cell_data), dict_of(found.surface.point_data)));
      },
      py::arg("scene"), py::kw_only(), py::arg("required") = 1.5, py::arg("seismic") = py::none(),
      py::arg("seismic_vertical") = 0.0, py::arg("bolt") = py::none(), py::arg("strength_of") = "",
      py::arg("after") = "", py::arg("frictionless") = false,
      "Block theory on every block of a scene, with the options of `voussoir blocks`: Blocks(verdicts, table, "
      "surface), the "
      "content of blocks_verdicts.json, the columns of blocks_verdicts.csv (NaN: does not apply) and the faces. "
      "`seismic` is k or (k, trend in deg), `bolt` (plunge, trend) in deg. Raises ValueError for scenes that it cannot "
      "judge.");
}

void bind_run(py::module_& module, const py::object& surface) {
  py::class_<Run, std::shared_ptr<Run>>(module, "Run", "A run of a scene; Scene.start makes it.")
      .def("advance", &advance, py::arg("steps") = 1000,
           "Continues by this number of steps; False when the scene is done. Ctrl-C raises KeyboardInterrupt between "
           "two steps: "
           "the "
           "run can be read, and continue.")
      .def_property_readonly("done", [](const Run& r) { return at_rest(r).done(); })
      .def_property_readonly(
          "stage", [](const Run& r) { return at_rest(r).stage(); }, "The present stage, or the last one.")
      .def_property_readonly("state", [](const std::shared_ptr<Run>& r) { return State{r}; })
      .def_property_readonly(
          "names", [](const Run& r) { return at_rest(r).body_names(); },
          "Of the bodies, in the order of the arrays; \"\" if the scene gives none.")
      .def(
          "contacts", [](const Run& r) { return table_of(at_rest(r).contacts()); },
          "The present contacts, as a structured array: the points of the program's contacts_….vtp. Forces in "
          "N, on "
          "body_b.")
      .def(
          "surface",
          [surface](const Run& r) {
            const PolyData data = at_rest(r).surface();
            return surface(array_of(data.points), faces_of(data), dict_of(data.cell_data), dict_of(data.point_data));
          },
          "The blocks as they are now: Surface(points, faces, cell_data, point_data), as the program's blocks_….vtp.")
      .def_property_readonly("results", &results_of,
                             "The content of results.json; its status is \"under way\" until the end.")
      .def_property_readonly("history", &history_of, "The columns of history.csv so far.")
      .def_property_readonly(
          "state_hash", [](const Run& r) { return at_rest(r).state_hash(); },
          "Equal hashes mean equal bits; at the end it is that of the program's run.")
      .def(
          "save",
          [](const Run& r, const py::object& folder, bool overwrite) { at_rest(r).save(path_of(folder), overwrite); },
          py::arg("folder"), py::arg("overwrite") = false,
          "Writes the files of `voussoir run`, with a frame of the present; results.json once the scene is done. Again "
          "into the "
          "same "
          "folder: one more frame, with output.view also in view.bin, of which voussoir.view makes the page.")
      .def("write_view", [](const Run& r, const py::object& folder) { at_rest(r).write_view(path_of(folder)); });
}

void bind_state(py::module_& module) {
  py::class_<State>(
      module, "State",
      "The motion of the bodies. Arrays are views, read only, that follow the run from one advance to the "
      "next; .copy() keeps their values. If a stage adds bodies (linings, blocks that an excavation divides), "
      "get them again.")
      .def_property_readonly(
          "time", [](const State& s) { return at_rest(*s.run).time(); }, "s")
      .def_property_readonly("steps", [](const State& s) { return at_rest(*s.run).steps(); })
      .def_property_readonly(
          "displacement", [](const State& s) { return view_of(*s.run, &MotionArrays::displacement, false); },
          "(bodies, dimension), m: of the centroids, since the start")
      .def_property_readonly(
          "rotation",
          [](const State& s) { return view_of(*s.run, &MotionArrays::rotation, at_rest(*s.run).dimension() == 2); },
          "(bodies, 3), rad: rotation vectors since the start; in the plane (bodies,), counter-clockwise")
      .def_property_readonly(
          "velocity", [](const State& s) { return view_of(*s.run, &MotionArrays::velocity, false); },
          "(bodies, dimension), m/s: of the centroids, half a step behind");
}

}  // namespace
}  // namespace voussoir::python

PYBIND11_MODULE(_core, module) {
  using namespace voussoir::python;
  module.doc() = "Distinct element modelling of jointed rock: scenes, run in portions of steps.";
  module.attr("__version__") = voussoir::version();
  scene_error = py::exception<voussoir::SceneError>(module, "SceneError", PyExc_ValueError).release();
  scene_error.attr("__doc__") = "An error in a scene, in one line, at `file`, `line` (0: none) and `key`.";
  py::register_exception_translator(&translate);
  const py::object surface =
      py::module_::import("collections")
          .attr("namedtuple")("Surface", "points faces cell_data point_data", py::arg("module") = "voussoir");
  module.attr("Surface") = surface;
  bind_scene(module);
  module.def("toml_value", &toml_of, py::arg("value"), "A value as a file states it, and as --set takes it.");
  bind_blocks(module, surface);
  bind_run(module, surface);
  bind_state(module);
}
