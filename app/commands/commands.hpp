// What the program can do. Each command returns its exit code and throws SceneError, BadInput, FolderInUse or
// OutputError.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/results.hpp"

namespace voussoir {

enum class ExitCode {
  done = 0,
  incomplete = 1,  // complete, but a goal was not reached: no equilibrium, no bracket
  bad_input = 2,
  in_use = 3,         // another run writes to the folder
  numerical = 4,      // a contact without an answer, a number that is not finite
  output = 5,         // a result could not be written or renamed
  disk_full = 6,      // or a quota or a limit on the size of files
  not_permitted = 7,  // a folder or file that must not be written
  no_memory = 8,
  signal = 128  // and the number of the signal that ended a run: 130 for SIGINT, 143 for SIGTERM
};

ExitCode exit_code(Outcome outcome);

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // key=value
};

struct RunArguments {
  SceneArguments scene;
  std::filesystem::path out;  // empty: results/<name of the scene's file>
  int threads = 1;
  std::optional<long long> checkpoint_steps;  // of RunOptions where they are stated
  std::optional<double> checkpoint_seconds;
  std::filesystem::path begin;  // folder of another run, at whose end this one begins; empty: at the start
  std::string until;            // the stage after which it ends, its state kept; empty: the last
  bool keep = false;            // the state at the end
  bool budget = false;          // as if the scene stated accuracy.budget
  bool view = false;            // as if the scene stated output.view
  bool overwrite = false;
  bool quiet = false;
};

struct ResumeArguments {
  std::filesystem::path folder;
  std::optional<int> threads;  // as before where they are not stated
  bool quiet = false;
};

struct ViewArguments {
  std::filesystem::path folder;
  std::filesystem::path out;     // empty: view.html in the folder
  bool fragment = false;         // for a page that holds the viewer once and many of these
  bool script = false;           // what such a page holds once; then no folder is read
  std::filesystem::path poster;  // a picture, PNG or WebP, to stand there until it is clicked; empty: none
  std::string look;              // what a fragment shows at first, as behind # in a page's address
  bool overwrite = false;
};

struct SliceArguments {
  SceneArguments scene;
  std::filesystem::path out;
  bool view = false;                              // view.html
  bool report = false;                            // on the joint sets, and joints.csv
  bool planes = false, stl = false, obj = false;  // further formats of the blocks
  bool overwrite = false;
};

struct LimitArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_limit
  std::string load;                     // gravity, left, right, applied; empty: the critical friction is sought
  std::vector<std::string> properties;  // whose friction is sought; none: all
  bool factor = false;                  // the factor of safety is sought
  std::vector<std::string> joints;      // of whose joint_properties; none: of all
  bool cohesion = false;                // joints have the cohesion that their properties state
  bool overwrite = false;
  bool quiet = false;
};

struct JointTestArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_joint_test
  std::vector<std::string> properties;  // of these joint_properties; none: of all
  std::string path = "shear";           // normal, shear, stiffness, cyclic
  std::vector<double> stresses;         // Pa; none: 0.1, 0.5, 1, 2, 5 MPa
  double slip = 1e-3;                   // m
  double surroundings = 1e9;            // Pa/m, of the path `stiffness`
  double dilation = 0.05;               // of the path `stiffness`
  int cycles = 2;                       // of the path `cyclic`
  int steps = 200;
  bool bonded = false;
  bool overwrite = false;
};

struct ImportArguments {
  std::filesystem::path file;
  std::string format;                     // facets, fab, dxf, traces
  std::filesystem::path out;              // a file
  std::vector<double> shift = {0, 0, 0};  // m, added to coordinates
  bool overwrite = false;
};

// how the runs of a study are done
struct WorkOptions {
  int jobs = 0;                // at the same time; 0: as many as there are cores
  int threads = 1;             // of each run
  double time_limit = 0;       // s of wall clock for each run; 0: none
  bool portable_math = false;  // with the C library's functions that every x86-64 processor has
  bool quiet = false;
};

struct ExportArguments {
  SceneArguments scene;
  std::string format;         // 3dec, yade
  std::filesystem::path out;  // a file
  bool overwrite = false;
};

struct StudyArguments {
  std::filesystem::path plan;
  std::filesystem::path out;
  bool overwrite = false;
  WorkOptions options = {};
};

// of a process that works at the rows of a planned study
struct WorkArguments {
  std::filesystem::path folder;
  std::string rows;          // "120-139,7"; empty: all
  std::string chunk;         // "k/n": that share of them
  bool any_program = false;  // though another one has planned it
  WorkOptions options = {};
};

// runs a scene and writes results.json, history.csv, scene.toml and ParaView's files
ExitCode run_command(const RunArguments& arguments);

// continues with a run that was interrupted, from its last checkpoint or from its begin; a complete one is left as it
// is
ExitCode resume_command(const ResumeArguments& arguments);

// the page in which the blocks of a run can be turned, from what the run has kept for it
ExitCode view_command(const ViewArguments& arguments);

// says what a scene activates, what follows from its numbers, and what looks wrong; writes nothing
ExitCode check_command(const SceneArguments& arguments);

// cuts the blocks and writes them with a table of their sizes; on request in other formats, and a report on the joints
ExitCode slice_command(const SliceArguments& arguments);

// the collapse load or critical friction of a scene in the plane by rigid-block limit analysis, with its forces and
// mechanism
ExitCode limit_command(const LimitArguments& arguments);

// takes the joints of a scene through laboratory tests: joint_test.csv and a figure of stress against displacement
ExitCode joint_test_command(const JointTestArguments& arguments);

// joints of another program's file as a table that scenes read, and a report on stdout
ExitCode import_command(const ImportArguments& arguments);

// a scene's blocks, joints and properties as text for another program
ExitCode export_command(const ExportArguments& arguments);

// runs a scene as it is and with one setting changed at a time, in processes side by side; writes study.csv. What was
// done before is kept while scene and program are the same.
ExitCode study_command(const StudyArguments& arguments);

// The same in parts: what is to be run, with its input, into a folder; its rows by any number of processes, here and on
// machines that share the folder or have a copy; study.csv; what is done and what is missing.
ExitCode study_plan_command(const StudyArguments& arguments);
ExitCode study_run_command(const WorkArguments& arguments);
ExitCode study_gather_command(const std::vector<std::filesystem::path>& folders);
ExitCode study_status_command(const std::filesystem::path& folder);

// every key a scene and a study may hold and every column of history.csv, as Markdown, on stdout
ExitCode docs_command();

}  // namespace voussoir
