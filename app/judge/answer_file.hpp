// An answer to a problem and the problem's references, as files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verification/comparison/comparison.hpp"

namespace voussoir {

enum class AnswerModel { rigid, joint_stiffness };

enum class AnswerKind { number, not_run, cannot_state, faulty };

struct AnswerRow {
  int line = 0;
  std::string quantity, unit, note;
  AnswerKind kind = AnswerKind::not_run;
  double value = 0;               // of kind number: finite
  std::optional<double> seconds;  // of the processor
  std::string fault;              // of kind faulty: what and how to repair it, one line
};

struct AnswerFile {
  std::filesystem::path file;
  std::string code, setting;
  AnswerModel model = AnswerModel::rigid;
  std::vector<AnswerRow> rows;
  bool empty = true;  // as it was handed out: no code and no value
};

// Reads answer.csv: comment lines `# code:`, `# model: rigid | joint stiffness`, `# setting:`, then rows under the
// header quantity,unit,value,seconds,note. Rows with a fault of their own are kept as faulty ones. Throws BadInput,
// which names file and line, if the file as a whole cannot be read: no such file, another header, no model.
AnswerFile read_answer(const std::filesystem::path& file);

// What is right for a model: between the ends, which for a code with joint stiffness are one value.
struct ProblemReference {
  double lower = 0, upper = 0;
  verification::Tolerance tolerance;
  std::string because, source;
};

struct ReferenceRow {
  std::string quantity, unit;
  std::optional<ProblemReference> joints, rigid;
};

struct ReferenceFile {
  std::string problem;
  std::vector<ReferenceRow> rows;
};

// Throws BadInput, which names file and key, if it is not a reference.json of a problem.
ReferenceFile read_reference(const std::filesystem::path& file);

}  // namespace voussoir
